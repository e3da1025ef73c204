//! Colour scales, which can be read without colour vision too, and colour bars.

use std::ops::Range;

use super::canvas::{Anchor, Canvas, TEXT};
use super::number;
use super::style::Colour;

/// Room for a colour bar with its labels, right of a map.
pub(super) const BAR_ROOM: f64 = 76.0;

/// Width of a colour bar.
const BAR: f64 = 14.0;

/// Colour of a point without a number.
const NONE: Colour = Colour(150, 150, 150);

/// Blue for -1, white for 0, orange for 1; numbers outside this range have the colour of its ends.
pub(super) fn diverging(value: f64) -> Colour {
    const ENDS: [[f64; 3]; 5] = [
        [8.0, 48.0, 107.0],
        [86.0, 160.0, 220.0],
        [255.0, 255.0, 255.0],
        [240.0, 150.0, 50.0],
        [127.0, 39.0, 4.0],
    ];
    between(&ENDS, 0.5 * (value + 1.0))
}

/// From pale yellow for 0 through green to dark violet for 1 (after viridis, reversed).
pub(super) fn sequential(value: f64) -> Colour {
    const ENDS: [[f64; 3]; 5] = [
        [253.0, 231.0, 37.0],
        [94.0, 201.0, 98.0],
        [33.0, 145.0, 140.0],
        [59.0, 82.0, 139.0],
        [68.0, 1.0, 84.0],
    ];
    between(&ENDS, value)
}

fn between(ends: &[[f64; 3]; 5], share: f64) -> Colour {
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
    Colour(mix(0), mix(1), mix(2))
}

/// Draws a colour bar with its upper left corner at `corner`. The function `colour` gives the colour of a value in
/// `range`; the `title` names the values and their unit.
pub(super) fn bar(
    canvas: &mut Canvas,
    corner: (f64, f64),
    height: f64,
    range: &Range<f64>,
    colour: impl Fn(f64) -> Colour,
    title: &str,
) {
    let value = |share: f64| range.start + share * (range.end - range.start);
    let labels = [0.0, 0.5, 1.0].map(|share| (share, number(value(share))));
    labelled_bar(
        canvas,
        (corner, height),
        |share| colour(value(share)),
        &labels,
    );
    // Between the middle and the upper end.
    let middle = (corner.0 + BAR + 34.0, corner.1 + 0.25 * height);
    canvas.text(title, middle, TEXT, Anchor::Upright);
}

/// Draws a colour bar on any scale: the function `colour` gives the colour at a share of the height, and the `labels` stand at shares of it.
pub(super) fn labelled_bar(
    canvas: &mut Canvas,
    (corner, height): ((f64, f64), f64),
    colour: impl Fn(f64) -> Colour,
    labels: &[(f64, String)],
) {
    const STEPS: usize = 64;
    // Each rectangle reaches up to the top, so that no seams are visible between them.
    for i in 0..STEPS {
        let (low, middle) = (i as f64 / STEPS as f64, (i as f64 + 0.5) / STEPS as f64);
        canvas.rectangle(corner, (BAR, height * (1.0 - low)), colour(middle));
    }
    for (share, label) in labels {
        let at = (corner.0 + BAR + 4.0, corner.1 + height * (1.0 - share));
        canvas.text(label, at, TEXT, Anchor::Start);
    }
}
