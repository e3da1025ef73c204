//! Legends: rows of entries, each a symbol and a text.

use plotters::prelude::*;

use super::{Anchor, Canvas, Stroke, TEXT, fine, text_width};
use crate::figures::FigureError;
use crate::figures::style::{Fill, INK, Shape};

/// What a legend's entry shows.
#[derive(Clone, Copy)]
pub(in crate::figures) enum Key {
    Line(Stroke),
    Marker(RGBColor, Shape, bool),
    MarkedLine(Stroke, Shape),
    Dot,
    Sphere,
    Arrow(RGBColor),
    Patch(Fill),
}

/// One entry of a legend.
pub(in crate::figures) type Entry = (Key, String);

/// Length of a legend's symbol with the room after it, and the room after a whole entry.
const KEY: f64 = 34.0;
const KEY_ROOM: f64 = 8.0;
const ENTRY_ROOM: f64 = 20.0;
const ENTRY_HEIGHT: f64 = 22.0;

/// Entries in rows no wider than `width`, each group from a new row on, and each row's width.
fn legend_rows(groups: &[Vec<Entry>], width: f64) -> Vec<(f64, Vec<&Entry>)> {
    let mut rows: Vec<(f64, Vec<&Entry>)> = Vec::new();
    for group in groups {
        for (number, entry) in group.iter().enumerate() {
            let needed = KEY + KEY_ROOM + text_width(&entry.1, TEXT) + ENTRY_ROOM;
            match rows.last_mut() {
                Some((used, row)) if number > 0 && *used + needed <= width => {
                    *used += needed;
                    row.push(entry);
                }
                _ => rows.push((needed, vec![entry])),
            }
        }
    }
    rows
}

/// Height of a legend within `width`.
pub(in crate::figures) fn legend_height(groups: &[Vec<Entry>], width: f64) -> f64 {
    ENTRY_HEIGHT * legend_rows(groups, width).len() as f64 + 10.0
}

impl Canvas<'_> {
    /// A legend centred below `top`.
    pub(in crate::figures) fn legend(
        &self,
        groups: &[Vec<Entry>],
        top: f64,
        width: f64,
    ) -> Result<(), FigureError> {
        for (number, (used, row)) in legend_rows(groups, width).into_iter().enumerate() {
            let y = top + ENTRY_HEIGHT * (number as f64 + 0.5);
            let mut x = (width - used + ENTRY_ROOM) / 2.0;
            for (key, label) in row {
                self.key(*key, x, y)?;
                self.text(label, (x + KEY + KEY_ROOM, y), TEXT, Anchor::Left)?;
                x += KEY + KEY_ROOM + text_width(label, TEXT) + ENTRY_ROOM;
            }
        }
        Ok(())
    }

    fn key(&self, key: Key, x: f64, y: f64) -> Result<(), FigureError> {
        let middle = (x + KEY / 2.0, y);
        let ends = [(x, y), (x + KEY, y)];
        match key {
            Key::Line(stroke) => self.line(&ends, stroke),
            Key::Marker(colour, shape, filled) => self.marker(middle, colour, shape, filled),
            Key::MarkedLine(stroke, shape) => {
                self.line(&ends, stroke)?;
                self.marker(middle, stroke.colour, shape, true)
            }
            Key::Dot => self.dot(middle, INK),
            Key::Sphere => self.sphere(middle, 9.0, INK),
            Key::Arrow(colour) => self.arrow((x + 6.0, y), (1.0, 0.0), 22.0, colour),
            Key::Patch(fill) => {
                let (corner, size) = ((x + 10.0, y - 7.0), (22.0, 14.0));
                self.patch(corner, size, fill)?;
                let far = (corner.0 + size.0, corner.1 + size.1);
                let at = |(x, y)| (fine(x), fine(y));
                self.draw(&Rectangle::new([at(corner), at(far)], INK.stroke_width(2)))
            }
        }
    }
}
