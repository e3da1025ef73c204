//! The web page: sections of prose, pictures and tables in one self-contained HTML file.
//!
//! A new figure is a new [`Section`] in [`Page::sections`]. The template is the same for all sections.

mod cost;
mod table;
mod template;
#[cfg(test)]
mod tests;

pub use cost::MethodCost;
pub use table::Table;
pub(crate) use table::rounded;
pub use template::render;

/// Everything on the page.
#[derive(Clone, Debug, Default)]
pub struct Page {
    /// Title.
    pub title: String,
    /// Paragraphs under the title, which state the question.
    pub lead: Vec<String>,
    /// Sections in order.
    pub sections: Vec<Section>,
    /// Cost of each method. If empty, the page has no such section.
    pub costs: Vec<MethodCost>,
    /// Failures and other notes. If empty, the page has no such section.
    pub notes: Vec<String>,
    /// Provenance of the page.
    pub provenance: Provenance,
}

/// A section of the page.
#[derive(Clone, Debug, Default)]
pub struct Section {
    /// Anchor within the page: letters, digits and hyphens.
    pub id: String,
    /// Heading.
    pub title: String,
    /// The finding in one or two sentences, for the first screen of the page; empty if there is none.
    pub finding: String,
    /// Paragraphs.
    pub prose: Vec<String>,
    /// Pictures.
    pub figures: Vec<Figure>,
    /// Tables.
    pub tables: Vec<Table>,
}

/// A picture and its caption.
#[derive(Clone, Debug, Default)]
pub struct Figure {
    /// SVG text.
    pub svg: String,
    /// Caption.
    pub caption: String,
}

/// Provenance of a page, in words.
#[derive(Clone, Debug, Default)]
pub struct Provenance {
    /// The exact command.
    pub command: String,
    /// Version of the program.
    pub version: String,
    /// CPU model, cores and operating system.
    pub machine: String,
    /// Threads that were used.
    pub threads: String,
    /// Date and time.
    pub date: String,
    /// Total wall-clock time.
    pub total_time: String,
}
