//! The web page: sections of prose, pictures and tables in one self-contained HTML file.
//!
//! A new figure is a new [`Section`] in [`Page::sections`]; the template knows of none in particular.

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
    /// Paragraphs under the title: what this is, and the question.
    pub lead: Vec<String>,
    /// Sections in order.
    pub sections: Vec<Section>,
    /// What each method cost; no such section if empty.
    pub costs: Vec<MethodCost>,
    /// Failures and other notes; no such section if empty.
    pub notes: Vec<String>,
    /// Where the page comes from.
    pub provenance: Provenance,
}

/// A heading and what is under it.
#[derive(Clone, Debug, Default)]
pub struct Section {
    /// Anchor within the page: letters, digits and hyphens.
    pub id: String,
    /// Heading.
    pub title: String,
    /// What it found, in a sentence or two, for the first screen of the page; empty if nothing.
    pub finding: String,
    /// Paragraphs.
    pub prose: Vec<String>,
    /// Pictures.
    pub figures: Vec<Figure>,
    /// Tables.
    pub tables: Vec<Table>,
}

/// A picture and what it shows.
#[derive(Clone, Debug, Default)]
pub struct Figure {
    /// SVG text.
    pub svg: String,
    /// Caption.
    pub caption: String,
}

/// What made a page, in words.
#[derive(Clone, Debug, Default)]
pub struct Provenance {
    /// The exact command.
    pub command: String,
    /// Version of the program, with the commit if known.
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
