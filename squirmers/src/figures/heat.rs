//! Colours of numbers, told apart without colour vision too, and the bar that explains them.

use std::ops::Range;

use plotters::style::RGBColor;

use super::FigureError;
use super::canvas::Canvas;
use super::number;

/// Room for a colour bar with its labels, right of a map.
pub(super) const BAR_ROOM: f64 = 76.0;

/// Steps of a colour bar.
const STEPS: usize = 64;

/// Where there is no number.
const NONE: RGBColor = RGBColor(150, 150, 150);

/// Blue for -1, white for 0, orange for 1; those beyond are drawn as these.
pub(super) fn diverging(value: f64) -> RGBColor {
    const ENDS: [[f64; 3]; 5] = [
        [8.0, 48.0, 107.0],
        [86.0, 160.0, 220.0],
        [255.0, 255.0, 255.0],
        [240.0, 150.0, 50.0],
        [127.0, 39.0, 4.0],
    ];
    between(&ENDS, 0.5 * (value + 1.0))
}

/// The same over a bar from 0 to 1.
pub(super) fn diverging_bar(share: f64) -> RGBColor {
    diverging(2.0 * share - 1.0)
}

/// From pale yellow for 0 through green to dark violet for 1 (after viridis, reversed).
pub(super) fn sequential(value: f64) -> RGBColor {
    const ENDS: [[f64; 3]; 5] = [
        [253.0, 231.0, 37.0],
        [94.0, 201.0, 98.0],
        [33.0, 145.0, 140.0],
        [59.0, 82.0, 139.0],
        [68.0, 1.0, 84.0],
    ];
    between(&ENDS, value)
}

fn between(ends: &[[f64; 3]; 5], share: f64) -> RGBColor {
    if share.is_nan() {
        return NONE;
    }
    let place = 4.0 * share.clamp(0.0, 1.0);
    let index = (place as usize).min(3);
    let rest = place - index as f64;
    let mix = |k: usize| {
        let [a, b] = [ends[index][k], ends[index + 1][k]];
        (a + rest * (b - a)).round() as u8
    };
    RGBColor(mix(0), mix(1), mix(2))
}

/// A colour bar.
pub(super) struct Bar {
    /// Values at its lower and upper end.
    pub range: Range<f64>,
    /// Colour at a share of its height.
    pub colour: fn(f64) -> RGBColor,
    /// What the values are, with their unit.
    pub title: &'static str,
}

impl Bar {
    /// Draws it with its upper left corner at `corner`.
    pub(super) fn draw(
        &self,
        canvas: &Canvas<'_>,
        corner: (f64, f64),
        height: f64,
    ) -> Result<(), FigureError> {
        const WIDTH: f64 = 14.0;
        let step = height / STEPS as f64;
        // From below, each up to the top: no seam shows between two.
        for i in 0..STEPS {
            let colour = (self.colour)((i as f64 + 0.5) / STEPS as f64);
            canvas.rectangle(corner, (WIDTH, height - step * i as f64), colour)?;
        }
        for share in [0.0, 0.5, 1.0] {
            let value = self.range.start + share * (self.range.end - self.range.start);
            let y = corner.1 + height * (1.0 - share);
            canvas.label(&number(value), (corner.0 + WIDTH + 4.0, y))?;
        }
        let middle = (corner.0 + WIDTH + 34.0, corner.1 + 0.25 * height);
        canvas.upright_label(self.title, middle)
    }
}
