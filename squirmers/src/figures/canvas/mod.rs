//! The sheet of a picture: its size, title, places of panels, and texts. The modules below draw on it.
//!
//! Lengths are in pixels, x to the right and y downward from the upper left corner.

mod axes;
mod bodies;
mod fill;
mod legend;
mod marks;
mod panel;
mod ticks;

use maud::{Markup, PreEscaped, html};

use super::style::{INK, WHITE};

pub(super) use axes::{Axes, Axis};
pub(super) use fill::{Map, MapCell, whole_side};
pub(super) use legend::{Entry, Key, legend_height};
pub(super) use panel::Panel;

/// Text sizes: of tick labels, legends and axis titles; of panel titles; of the title of the picture.
pub(super) const TEXT: f64 = 12.0;
const PANEL_TEXT: f64 = 13.0;
const TITLE_TEXT: f64 = 16.0;

/// Room for the tick labels and the title of the y axis, left of a plot.
pub(super) const LEFT: f64 = 70.0;

/// Room for the tick labels and the title of the x axis, below a plot.
pub(super) const BELOW: f64 = 50.0;

/// Room for a panel's title, above a plot.
pub(super) const ABOVE: f64 = 30.0;

/// Room right of a plot.
pub(super) const RIGHT: f64 = 16.0;

/// Additional room right of all panels: half of a label at the end of an axis.
const EDGE: f64 = 8.0;

/// Height of the picture's title.
pub(super) const TITLE: f64 = 36.0;

/// Height of a line of a caption.
pub(super) const CAPTION_LINE: f64 = 17.0;

/// Estimated width of a character as a share of the text size, because no font is available to measure.
const CHARACTER: f64 = 0.55;

/// A length as SVG text, with two decimals.
fn px(length: f64) -> String {
    ((length * 100.0).round() / 100.0 + 0.0).to_string()
}

/// Estimated width of a text.
fn text_width(text: &str, size: f64) -> f64 {
    CHARACTER * size * text.chars().count() as f64
}

/// Position of a text relative to its point.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
    /// Centred, and reading upward.
    Upright,
}

/// Panels of equal size in columns and rows below the title of the picture.
pub(super) struct Layout {
    pub plot: (f64, f64),
    pub columns: usize,
    pub rows: usize,
    /// Additional room left of all panels, and right of each panel.
    pub left: f64,
    pub right: f64,
}

impl Layout {
    pub(super) fn new(plot: (f64, f64), columns: usize, rows: usize) -> Self {
        let (left, right) = (0.0, 0.0);
        Self {
            plot,
            columns,
            rows,
            left,
            right,
        }
    }

    /// Upper left corner of a plot.
    pub(super) fn corner(&self, column: usize, row: usize) -> (f64, f64) {
        let width = LEFT + self.plot.0 + RIGHT + self.right;
        let height = ABOVE + self.plot.1 + BELOW;
        let x = self.left + LEFT + width * column as f64;
        (x, TITLE + ABOVE + height * row as f64)
    }

    /// A sheet for these panels with a legend below them.
    pub(super) fn canvas(&self, title: &str, legend: &[Vec<Entry>]) -> Canvas {
        let end = self.corner(self.columns.max(1), self.rows);
        Canvas::new(title, (end.0 - LEFT, end.1 - ABOVE + 8.0), legend)
    }
}

/// A picture that is being drawn.
pub(super) struct Canvas {
    title: String,
    width: f64,
    height: f64,
    markup: String,
}

impl Canvas {
    /// A sheet of the given size with a title and a legend below. The `title` is also the text for screen readers.
    pub(super) fn new(title: &str, (width, top): (f64, f64), legend: &[Vec<Entry>]) -> Self {
        let width = (width + EDGE).round();
        let height = (top + legend_height(legend, width)).round();
        let mut canvas = Self {
            title: title.to_owned(),
            width,
            height,
            markup: "\n".to_owned(),
        };
        canvas.rectangle((0.0, 0.0), (width, height), WHITE);
        let (middle, room) = ((0.5 * width, 0.5 * TITLE), width - 8.0);
        canvas.fitted(title, middle, TITLE_TEXT, Anchor::Middle, room);
        canvas.legend(legend, top, width);
        canvas
    }

    /// The picture as SVG.
    pub(super) fn finish(self) -> String {
        let (width, height) = (self.width, self.height);
        let view = format!("0 0 {width} {height}");
        let picture = html! {
            svg role="img" aria-label=(self.title) width=(width) height=(height) viewBox=(view)
                xmlns="http://www.w3.org/2000/svg" font-family="sans-serif" {
                (PreEscaped(self.markup))
            }
        };
        picture.0
    }

    /// Draws an element.
    fn draw(&mut self, element: Markup) {
        self.markup += &element.0;
        self.markup.push('\n');
    }

    /// Writes a text at a point.
    pub(super) fn text(&mut self, text: &str, (x, y): (f64, f64), size: f64, anchor: Anchor) {
        if text.is_empty() {
            return;
        }
        let side = match anchor {
            Anchor::Start => None,
            Anchor::Middle | Anchor::Upright => Some("middle"),
            Anchor::End => Some("end"),
        };
        let turn = (anchor == Anchor::Upright).then(|| format!("rotate(-90 {} {})", px(x), px(y)));
        // The height of digits and capitals is 0.7 of the text size.
        let foot = px(y + 0.35 * size);
        self.draw(html! {
            text x=(px(x)) y=(foot) font-size=(px(size)) text-anchor=[side] transform=[turn] fill=(INK) { (text) }
        });
    }

    /// Writes lines of text below `top`, each over the whole width of the sheet.
    pub(super) fn caption(&mut self, lines: &[String], top: f64) {
        let (middle, room) = (0.5 * self.width, self.width - 8.0);
        for (index, line) in lines.iter().enumerate() {
            let at = (middle, top + CAPTION_LINE * (index as f64 + 0.5));
            self.fitted(line, at, TEXT, Anchor::Middle, room);
        }
    }

    /// Writes a text at a point, in a smaller size if the text does not fit into the room.
    fn fitted(&mut self, text: &str, at: (f64, f64), size: f64, anchor: Anchor, room: f64) {
        let shrunk = size * (room / text_width(text, size)).min(1.0);
        self.text(text, at, shrunk, anchor);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_escaped() {
        let svg = Canvas::new("a < \"b\" & c", (400.0, 100.0), &[]).finish();
        assert!(
            svg.contains("aria-label=\"a &lt; &quot;b&quot; &amp; c\""),
            "{svg}"
        );
        assert!(!svg.contains("< \"b"), "{svg}");
    }

    #[test]
    fn a_title_that_is_longer_than_the_sheet_is_smaller() {
        for (length, size) in [(20, "font-size=\"16\""), (80, "font-size=\"6.82\"")] {
            let svg = Canvas::new(&"x".repeat(length), (300.0, 100.0), &[]).finish();
            assert!(svg.contains(size), "{svg}");
        }
    }
}
