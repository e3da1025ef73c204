//! Axes of a panel: frame, grid lines, ticks and titles.

use std::ops::Range;

use maud::html;

use super::ticks::{LONGEST, Scale, Ticks};
use super::{ABOVE, Anchor, BELOW, CHARACTER, EDGE, LEFT, PANEL_TEXT, Panel, RIGHT, TEXT, px};
use crate::figures::range::sound;
use crate::figures::style::{INK, MESH};

/// Length of a tick, and room between a tick and its label or between two labels.
const TICK: f64 = 4.0;
const GAP: f64 = 4.0;

/// Distance of the middle of an axis title from the outer edge of its room.
const AXIS_TITLE: f64 = 9.0;

/// Largest width of a label. Such a label does not touch the title of the y axis, and stays on the sheet at the end
/// of the x axis.
const _: () = {
    let label = CHARACTER * TEXT * LONGEST as f64;
    assert!(TICK + GAP + label + AXIS_TITLE + 0.5 * TEXT <= LEFT);
    assert!(0.5 * label <= RIGHT + EDGE);
};

/// The x axis or y axis of a panel.
#[derive(Clone)]
pub(crate) struct Axis {
    pub(super) range: Range<f64>,
    /// Name and unit: `name (unit)`.
    title: &'static str,
    /// Largest number of ticks.
    most: usize,
    scale: Scale,
    /// Places with names, in place of numbers.
    named: Vec<(f64, String)>,
}

impl Axis {
    pub(crate) fn new(range: &Range<f64>, title: &'static str, most: usize) -> Self {
        let (range, scale) = (sound(range), Scale::Linear);
        Self {
            range,
            title,
            most,
            scale,
            named: Vec::new(),
        }
    }

    /// An axis of places with names; where there is no room for all, some are left out.
    pub(crate) fn named(
        range: &Range<f64>,
        title: &'static str,
        named: Vec<(f64, String)>,
    ) -> Self {
        Self {
            named,
            ..Self::new(range, title, 0)
        }
    }

    /// An axis of powers of ten. Its range is the range of the logarithms.
    pub(crate) fn powers(range: &Range<f64>, title: &'static str, most: usize) -> Self {
        let scale = Scale::Powers;
        Self {
            scale,
            ..Self::new(range, title, most)
        }
    }

    /// Position of a value as a share of the axis, from 0 to 1.
    pub(super) fn share(&self, value: f64) -> f64 {
        (value - self.range.start) / (self.range.end - self.range.start)
    }
}

/// Title and axes of a panel.
pub(crate) struct Axes {
    pub title: String,
    pub x: Axis,
    pub y: Axis,
}

impl Panel<'_> {
    /// Draws the axes, and the title of the panel.
    pub(super) fn draw_axes(&mut self, title: &str) {
        let ((left, top), (width, height)) = (self.corner, self.size);
        let (foot, middle) = (top + height, left + 0.5 * width);
        let across =
            |chars: usize, share: f64| CHARACTER * TEXT * chars as f64 + GAP <= share * width;
        let up = |_: usize, share: f64| TEXT <= share * height;
        let along_x = if self.x.named.is_empty() {
            Ticks::new(&self.x.range, self.x.most, self.x.scale, across)
        } else {
            Ticks::named(
                &self.x.named,
                |chars| CHARACTER * TEXT * chars as f64 + GAP,
                width,
            )
        };
        let along_y = if self.y.named.is_empty() {
            Ticks::new(&self.y.range, self.y.most, self.y.scale, up)
        } else {
            Ticks::named(&self.y.named, |_| TEXT, height)
        };
        let (mut mesh, mut ticks) = (String::new(), String::new());
        for (value, label) in along_x.values.iter().zip(&along_x.labels) {
            let x = left + width * self.x.share(*value);
            mesh += &format!("M{} {}v{}", px(x), px(foot), px(-height));
            ticks += &format!("M{} {}v{}", px(x), px(foot), px(TICK));
            let at = (x, foot + TICK + GAP + 0.5 * TEXT);
            self.canvas.text(label, at, TEXT, Anchor::Middle);
        }
        for (value, label) in along_y.values.iter().zip(&along_y.labels) {
            let y = foot - height * self.y.share(*value);
            mesh += &format!("M{} {}h{}", px(left), px(y), px(width));
            ticks += &format!("M{} {}h{}", px(left), px(y), px(-TICK));
            let at = (left - TICK - GAP, y);
            self.canvas.text(label, at, TEXT, Anchor::End);
        }
        self.canvas.draw(html! {
            path d=(mesh) stroke=(MESH) {}
            path d=(ticks) stroke=(INK) {}
        });
        self.canvas.frame(self.corner, self.size, 1.0);
        let room = LEFT + width + RIGHT;
        let at = (middle, top - 0.5 * ABOVE);
        self.canvas
            .fitted(title, at, PANEL_TEXT, Anchor::Middle, room);
        let at = (middle, foot + BELOW - AXIS_TITLE);
        let title = along_x.titled(self.x.title);
        self.canvas.fitted(&title, at, TEXT, Anchor::Middle, room);
        let at = (left - LEFT + AXIS_TITLE, top + 0.5 * height);
        let title = along_y.titled(self.y.title);
        self.canvas
            .fitted(&title, at, TEXT, Anchor::Upright, ABOVE + height + BELOW);
    }
}
