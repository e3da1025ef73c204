//! Colours, line styles and markers that tell series apart, with and without colour vision.

use plotters::style::RGBColor;

/// Text, frames and axes.
pub(super) const INK: RGBColor = RGBColor(34, 34, 34);

/// Mesh lines.
pub(super) const MESH: RGBColor = RGBColor(226, 226, 226);

/// Okabe & Ito (2008), the colours that are dark enough on white first.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// The colour of the series number `index`.
pub(super) fn colour(index: usize) -> RGBColor {
    COLOURS[index % COLOURS.len()]
}

/// How a line is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dash {
    Solid,
    Dashed,
    Dotted,
}

impl Dash {
    /// The line style of the series number `index`.
    pub(super) fn of(index: usize) -> Self {
        [Self::Solid, Self::Dashed, Self::Dotted][index % 3]
    }
}

/// Outline of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Circle,
    Square,
    Triangle,
    Diamond,
}

impl Shape {
    /// The marker of the series number `index`.
    pub(super) fn of(index: usize) -> Self {
        [Self::Circle, Self::Square, Self::Triangle, Self::Diamond][index % 4]
    }

    /// Half the marker's size in nominal pixels. They differ, so that of markers at the same place
    /// all are seen.
    pub(super) fn size(self) -> f64 {
        match self {
            Self::Circle => 5.5,
            Self::Square => 3.8,
            Self::Triangle => 3.4,
            Self::Diamond => 3.0,
        }
    }

    /// Corners for the size 1; none for a circle.
    pub(super) fn corners(self) -> &'static [(f64, f64)] {
        match self {
            Self::Circle => &[],
            Self::Square => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            Self::Triangle => &[(0.0, -1.25), (1.1, 0.75), (-1.1, 0.75)],
            Self::Diamond => &[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)],
        }
    }
}
