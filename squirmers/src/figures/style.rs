//! Colours, line styles and markers. They distinguish series with and without colour vision.

use maud::{Markup, PreEscaped, Render};

/// Red, green and blue of sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Colour(pub u8, pub u8, pub u8);

impl Render for Colour {
    fn render(&self) -> Markup {
        PreEscaped(format!("#{:02X}{:02X}{:02X}", self.0, self.1, self.2))
    }
}

pub(super) const WHITE: Colour = Colour(255, 255, 255);

/// Text, frames and axes.
pub(super) const INK: Colour = Colour(34, 34, 34);

/// Grid lines.
pub(super) const MESH: Colour = Colour(226, 226, 226);

/// Colours of Okabe & Ito (2008). Colours that are dark enough on white come first.
const COLOURS: [Colour; 7] = [
    Colour(0, 114, 178),
    Colour(213, 94, 0),
    Colour(0, 158, 115),
    Colour(204, 121, 167),
    Colour(230, 159, 0),
    Colour(86, 180, 233),
    Colour(0, 0, 0),
];

/// The colour of the series number `index`.
pub(super) fn colour(index: usize) -> Colour {
    COLOURS[index % COLOURS.len()]
}

/// Lines over a fill, which distinguish it from others without colour vision and in print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hatch {
    Plain,
    Rising,
    Falling,
    Crossed,
}

/// The fill of an area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fill {
    pub colour: Colour,
    pub hatch: Hatch,
}

/// Smallest lightness of a fill with a dark hatch.
const LIGHT: f64 = 50.0;

impl Fill {
    pub(super) const fn new(colour: Colour, hatch: Hatch) -> Self {
        Self { colour, hatch }
    }

    /// Colour of its hatch.
    pub(super) fn line(self) -> Colour {
        if lightness(self.colour) < LIGHT {
            WHITE
        } else {
            INK
        }
    }

    /// Whether its hatch has lines that rise, or fall, to the right.
    pub(super) fn has_lines(self, rising: bool) -> bool {
        let along = if rising {
            Hatch::Rising
        } else {
            Hatch::Falling
        };
        self.hatch == Hatch::Crossed || self.hatch == along
    }
}

/// Lightness of a colour from 0 to 100 (CIE L* of sRGB), as it appears in grey print.
pub(super) fn lightness(Colour(red, green, blue): Colour) -> f64 {
    let linear = |level: u8| {
        let v = f64::from(level) / 255.0;
        if v <= 0.04045 {
            v / 12.92
        } else {
            ((v + 0.055) / 1.055).powf(2.4)
        }
    };
    let y = 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
    if y > 0.008_856 {
        116.0 * y.cbrt() - 16.0
    } else {
        903.3 * y
    }
}

/// Dash pattern of a line.
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

    /// Lengths of a stroke and of the gap after it, in pixels.
    pub(super) fn pattern(self) -> Option<&'static str> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some("7 4"),
            Self::Dotted => Some("2 3.5"),
        }
    }
}

/// Style of a line.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub colour: Colour,
    pub width: f64,
    pub dash: Dash,
}

impl Stroke {
    pub(super) fn new(colour: Colour, width: f64, dash: Dash) -> Self {
        Self {
            colour,
            width,
            dash,
        }
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

    /// Corners around a place, in pixels; none for a circle. Sizes differ, so that markers at the same place are all
    /// visible.
    pub(super) fn corners(self) -> &'static [(f64, f64)] {
        match self {
            Self::Circle => &[],
            Self::Square => &[(-3.4, -3.4), (3.4, -3.4), (3.4, 3.4), (-3.4, 3.4)],
            Self::Triangle => &[(0.0, -4.25), (3.75, 2.55), (-3.75, 2.55)],
            Self::Diamond => &[(0.0, -3.9), (3.9, 0.0), (0.0, 3.9), (-3.9, 0.0)],
        }
    }
}
