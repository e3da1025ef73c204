//! Legends: rows of entries, each a symbol and a text.

use super::{Anchor, Canvas, TEXT, text_width};
use crate::figures::style::{Colour, Fill, INK, Shape, Stroke};

/// The symbol of an entry of a legend.
#[derive(Clone, Copy)]
pub(crate) enum Key {
    Line(Stroke),
    Marker(Colour, Shape, bool),
    MarkedLine(Stroke, Shape),
    Dot,
    Sphere,
    Arrow(Colour),
    Patch(Fill),
}

/// One entry of a legend.
pub(crate) type Entry = (Key, String);

/// Length of a legend's symbol, room after the symbol, and room after the whole entry.
const KEY: f64 = 29.0;
const KEY_ROOM: f64 = 8.0;
const ENTRY_ROOM: f64 = 24.0;
const ENTRY_HEIGHT: f64 = 22.0;

/// Width of an entry, including the room after it.
fn entry_width(entry: &Entry) -> f64 {
    KEY + KEY_ROOM + text_width(&entry.1, TEXT) + ENTRY_ROOM
}

/// The entries in rows of at most `width`. Each group begins a new row.
fn legend_rows(groups: &[Vec<Entry>], width: f64) -> Vec<Vec<&Entry>> {
    let mut rows = Vec::new();
    for group in groups {
        let mut row: Vec<&Entry> = Vec::new();
        let mut used = -ENTRY_ROOM;
        for entry in group {
            let needed = entry_width(entry);
            if !row.is_empty() && used + needed > width {
                rows.push(std::mem::take(&mut row));
                used = -ENTRY_ROOM;
            }
            used += needed;
            row.push(entry);
        }
        if !row.is_empty() {
            rows.push(row);
        }
    }
    rows
}

/// Height of a legend of at most `width`.
pub(crate) fn legend_height(groups: &[Vec<Entry>], width: f64) -> f64 {
    ENTRY_HEIGHT * legend_rows(groups, width).len() as f64 + 10.0
}

impl Canvas {
    /// A legend centred below `top`.
    pub(super) fn legend(&mut self, groups: &[Vec<Entry>], top: f64, width: f64) {
        let mut y = top + 0.5 * ENTRY_HEIGHT;
        for row in legend_rows(groups, width) {
            let used: f64 = row.iter().copied().map(entry_width).sum();
            let mut x = 0.5 * (width - used + ENTRY_ROOM);
            for entry in row {
                self.key(entry.0, x, y);
                self.text(&entry.1, (x + KEY + KEY_ROOM, y), TEXT, Anchor::Start);
                x += entry_width(entry);
            }
            y += ENTRY_HEIGHT;
        }
    }

    fn key(&mut self, key: Key, x: f64, y: f64) {
        let middle = (x + KEY / 2.0, y);
        let ends = [(x, y), (x + KEY, y)];
        match key {
            Key::Line(stroke) => self.line(&ends, stroke),
            Key::Marker(colour, shape, filled) => self.marker(middle, colour, shape, filled),
            Key::MarkedLine(stroke, shape) => {
                self.line(&ends, stroke);
                self.marker(middle, stroke.colour, shape, true);
            }
            Key::Dot => self.dot(middle, INK),
            Key::Sphere => self.sphere(middle, 9.0, INK),
            Key::Arrow(colour) => self.arrow((x + 6.0, y), (1.0, 0.0), 17.0, colour),
            Key::Patch(fill) => {
                let (corner, size) = ((x + KEY - 22.0, y - 7.0), (22.0, 14.0));
                self.patch(corner, size, fill);
                self.frame(corner, size, 0.5);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_within_the_sheet_and_have_each_entry_once() {
        let entry = |i: usize| (Key::Dot, "x".repeat(1 + i % 30));
        let groups = [(0..40).map(entry).collect(), vec![], vec![entry(99)]];
        let rows = legend_rows(&groups, 400.0);
        assert_eq!(rows.iter().map(Vec::len).sum::<usize>(), 41);
        assert_eq!(rows.last().map(Vec::len), Some(1), "a group of its own");
        for row in rows {
            let used: f64 = row.iter().copied().map(entry_width).sum();
            assert!(!row.is_empty() && used - ENTRY_ROOM <= 400.0, "{used}");
        }
    }
}
