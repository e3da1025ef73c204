//! The sheet of a picture: its size and title, texts and lines; panels, axes, marks, legends and maps in the modules below.
//!
//! Plotters rounds coordinates to whole pixels. Pictures are therefore drawn at [`FINENESS`] times
//! their nominal size, and the SVG's header scales them back. Lengths here are nominal pixels.

mod axes;
mod image;
mod legend;
mod marks;
mod panel;
mod ticks;

use std::cell::RefCell;

use plotters::coord::Shift;
use plotters::element::{DashedPathElement, Drawable, PointCollection};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::FigureError;
use super::style::{Dash, INK};

pub(super) use axes::Axes;
pub(super) use image::whole_side;
pub(super) use legend::{Entry, Key, legend_height};
pub(super) use panel::{MapCell, Panel};
pub(super) use ticks::Scale;

/// Drawn pixels per nominal pixel.
const FINENESS: f64 = 4.0;

/// Size of tick labels, legends and axis titles.
pub(super) const TEXT: f64 = 14.0;

/// Room for the tick labels and the title of the y axis, left of a plot.
pub(super) const LEFT: f64 = 62.0;

/// Room for the tick labels and the title of the x axis, below a plot.
pub(super) const BELOW: f64 = 50.0;

/// Room for a panel's title, above a plot.
pub(super) const ABOVE: f64 = 30.0;

/// Room right of a plot.
pub(super) const RIGHT: f64 = 16.0;

/// Height of the picture's title.
pub(super) const TITLE: f64 = 36.0;

/// Centres of the axis titles: right of the left edge of [`LEFT`], above the lower edge of [`BELOW`].
const AXIS_TITLE: f64 = 12.0;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Drawn pixels of a nominal length.
fn fine(length: f64) -> i32 {
    (length * FINENESS).round() as i32
}

/// The same as a width or a radius.
fn fine_size(length: f64) -> u32 {
    fine(length).unsigned_abs()
}

/// Estimated width of a text.
fn text_width(text: &str, size: f64) -> f64 {
    0.55 * size * text.chars().count() as f64
}

/// How a text lies about its point.
#[derive(Clone, Copy)]
enum Anchor {
    Left,
    Middle,
    Upright,
}

/// A picture in the making.
pub(super) struct Canvas<'a> {
    area: Area<'a>,
    /// Pixel pictures, which plotters cannot embed: they are added to the finished SVG.
    images: RefCell<String>,
}

/// Draws a picture of the nominal size `(width, height)` under a `title`, which also names it to
/// readers that cannot see it.
pub(super) fn picture(
    (width, height): (f64, f64),
    title: &str,
    paint: impl FnOnce(&Canvas<'_>) -> Result<(), FigureError>,
) -> Result<String, FigureError> {
    let mut svg = String::new();
    let images;
    let size = (fine_size(width), fine_size(height));
    {
        let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        area.fill(&WHITE).map_err(FigureError::drawing)?;
        let canvas = Canvas {
            area,
            images: RefCell::default(),
        };
        canvas.text(title, (width / 2.0, TITLE / 2.0), 18.0, Anchor::Middle)?;
        paint(&canvas)?;
        canvas.area.present().map_err(FigureError::drawing)?;
        images = canvas.images.take();
    }
    let svg = svg.replacen("</svg>", &format!("{images}</svg>"), 1);
    let drawn = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    let nominal =
        format!("role=\"img\" aria-label=\"{title}\" width=\"{width:.0}\" height=\"{height:.0}\"");
    Ok(svg.replacen(&drawn, &nominal, 1))
}

/// How a line is drawn.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub colour: RGBColor,
    pub width: f64,
    pub dash: Dash,
}

impl<'a> Canvas<'a> {
    fn text(
        &self,
        text: &str,
        (x, y): (f64, f64),
        size: f64,
        anchor: Anchor,
    ) -> Result<(), FigureError> {
        let across = match anchor {
            Anchor::Left => HPos::Left,
            Anchor::Middle | Anchor::Upright => HPos::Center,
        };
        let turn = match anchor {
            Anchor::Upright => FontTransform::Rotate270,
            Anchor::Left | Anchor::Middle => FontTransform::None,
        };
        let style = ("sans-serif", fine(size))
            .into_font()
            .transform(turn)
            .color(&INK)
            .pos(Pos::new(across, VPos::Center));
        let element = Text::new(text.to_owned(), (fine(x), fine(y)), style);
        self.area.draw(&element).map_err(FigureError::drawing)
    }

    /// A line through points of the canvas.
    fn line(&self, points: &[(f64, f64)], stroke: Stroke) -> Result<(), FigureError> {
        let style = stroke.colour.stroke_width(fine_size(stroke.width));
        let points: Vec<_> = points.iter().map(|&(x, y)| (fine(x), fine(y))).collect();
        let dashed = |on: f64, off: f64| {
            let element = DashedPathElement::new(points.clone(), fine(on), fine(off), style);
            self.area.draw(&element)
        };
        match stroke.dash {
            Dash::Solid => self.area.draw(&PathElement::new(points, style)),
            Dash::Dashed => dashed(7.0, 4.0),
            Dash::Dotted => dashed(2.0, 3.5),
        }
        .map_err(FigureError::drawing)
    }

    fn draw<E>(&self, element: &E) -> Result<(), FigureError>
    where
        for<'b> &'b E: PointCollection<'b, (i32, i32)>,
        E: Drawable<SVGBackend<'a>>,
    {
        self.area.draw(element).map_err(FigureError::drawing)
    }

    /// A text that begins at a point.
    pub(super) fn label(&self, text: &str, at: (f64, f64)) -> Result<(), FigureError> {
        self.text(text, at, TEXT, Anchor::Left)
    }

    /// A text that reads upward, centred at a point.
    pub(super) fn upright_label(&self, text: &str, at: (f64, f64)) -> Result<(), FigureError> {
        self.text(text, at, TEXT, Anchor::Upright)
    }
}
