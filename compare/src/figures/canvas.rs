//! Panels, lines, markers and legends on an SVG of plotters.
//!
//! Plotters rounds coordinates to whole pixels. Pictures are therefore drawn at [`FINENESS`] times
//! their nominal size, and the SVG's header scales them back. Lengths here are nominal pixels.

use std::cell::RefCell;
use std::ops::Range;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use plotters::coord::Shift;
use plotters::element::{DashedPathElement, Drawable, PointCollection};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::style::{Dash, INK, MESH, Shape};
use super::{FigureError, number};

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

/// What a panel shows.
pub(super) struct Axes {
    pub title: String,
    pub x: Range<f64>,
    pub y: Range<f64>,
    pub x_title: &'static str,
    pub y_title: &'static str,
    /// About how many ticks along x and y.
    pub ticks: (usize, usize),
}

/// Text of a tick.
type Label = fn(f64) -> String;

/// A plot in a picture: axes, and what lies between them.
pub(super) struct Panel<'c, 'a> {
    canvas: &'c Canvas<'a>,
    x: Range<f64>,
    y: Range<f64>,
    /// Upper left corner and size of the plot.
    corner: (f64, f64),
    size: (f64, f64),
}

/// How a line is drawn.
#[derive(Clone, Copy)]
pub(super) struct Stroke {
    pub colour: RGBColor,
    pub width: f64,
    pub dash: Dash,
}

/// What a legend's entry shows.
#[derive(Clone, Copy)]
pub(super) enum Key {
    Line(Stroke),
    Marker(RGBColor, Shape, bool),
    MarkedLine(Stroke, Shape),
    Dot,
    Sphere,
    Arrow(RGBColor),
    Patch(RGBColor),
}

/// One entry of a legend.
pub(super) type Entry = (Key, String);

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
pub(super) fn legend_height(groups: &[Vec<Entry>], width: f64) -> f64 {
    ENTRY_HEIGHT * legend_rows(groups, width).len() as f64 + 10.0
}

/// A square grid of colours as a PNG, its lines from the bottom upward.
fn png(colours: &[RGBColor]) -> Result<Vec<u8>, FigureError> {
    let side = colours.len().isqrt();
    if side == 0 || side * side != colours.len() {
        let what = "the map is not a square grid";
        return Err(FigureError::Empty { what });
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side as u32, side as u32);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().map_err(FigureError::drawing)?;
    let lines = colours.chunks(side).rev().flatten();
    let data: Vec<u8> = lines.flat_map(|c| [c.0, c.1, c.2]).collect();
    writer
        .write_image_data(&data)
        .map_err(FigureError::drawing)?;
    writer.finish().map_err(FigureError::drawing)?;
    Ok(bytes)
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

    fn marker(
        &self,
        (x, y): (f64, f64),
        colour: RGBColor,
        shape: Shape,
        filled: bool,
    ) -> Result<(), FigureError> {
        let size = shape.size();
        // A white edge keeps markers apart that share a colour and a place.
        let (fill, edge) = if filled {
            (colour, WHITE)
        } else {
            (WHITE, colour)
        };
        let (fill, edge) = (fill.filled(), edge.stroke_width(fine_size(1.25)));
        let at = (fine(x), fine(y));
        if shape == Shape::Circle {
            let radius = fine(size);
            self.draw(&Circle::new(at, radius, fill))?;
            return self.draw(&Circle::new(at, radius, edge));
        }
        let corners = shape.corners().iter();
        let mut corners: Vec<_> = corners
            .map(|(dx, dy)| (fine(x + dx * size), fine(y + dy * size)))
            .collect();
        self.draw(&Polygon::new(corners.clone(), fill))?;
        corners.extend_from_within(..1);
        self.draw(&PathElement::new(corners, edge))
    }

    fn draw<E>(&self, element: &E) -> Result<(), FigureError>
    where
        for<'b> &'b E: PointCollection<'b, (i32, i32)>,
        E: Drawable<SVGBackend<'a>>,
    {
        self.area.draw(element).map_err(FigureError::drawing)
    }

    fn dot(&self, (x, y): (f64, f64), colour: RGBColor) -> Result<(), FigureError> {
        self.draw(&Circle::new((fine(x), fine(y)), fine(2.6), colour.filled()))
    }

    fn sphere(&self, (x, y): (f64, f64), radius: f64, colour: RGBColor) -> Result<(), FigureError> {
        let at = (fine(x), fine(y));
        self.draw(&Circle::new(at, fine(radius), colour.mix(0.14).filled()))?;
        self.draw(&Circle::new(at, fine(radius), colour.stroke_width(4)))
    }

    /// An arrow from a point along a unit vector whose second component is upward.
    fn arrow(
        &self,
        from: (f64, f64),
        (along, up): (f64, f64),
        length: f64,
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        let at = |forward: f64, aside: f64| {
            let x = from.0 + forward * along - aside * up;
            let y = from.1 - forward * up - aside * along;
            (x, y)
        };
        let stroke = Stroke {
            colour,
            width: 1.2,
            dash: Dash::Solid,
        };
        self.line(&[at(0.0, 0.0), at(length - 5.0, 0.0)], stroke)?;
        let head = [
            at(length, 0.0),
            at(length - 7.0, 3.2),
            at(length - 7.0, -3.2),
        ];
        let head = head.map(|(x, y)| (fine(x), fine(y))).to_vec();
        self.draw(&Polygon::new(head, colour.filled()))
    }

    /// A filled rectangle with its upper left corner at `(x, y)`.
    pub(super) fn rectangle(
        &self,
        (x, y): (f64, f64),
        (width, height): (f64, f64),
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        let corners = [(fine(x), fine(y)), (fine(x + width), fine(y + height))];
        self.draw(&Rectangle::new(corners, colour.filled()))
    }

    /// A text that begins at a point.
    pub(super) fn label(&self, text: &str, at: (f64, f64)) -> Result<(), FigureError> {
        self.text(text, at, TEXT, Anchor::Left)
    }

    /// A text that reads upward, centred at a point.
    pub(super) fn upright_label(&self, text: &str, at: (f64, f64)) -> Result<(), FigureError> {
        self.text(text, at, TEXT, Anchor::Upright)
    }

    /// A square grid of colours, one pixel a point, its lines from the bottom upward.
    pub(super) fn image(
        &self,
        (x, y): (f64, f64),
        (width, height): (f64, f64),
        colours: &[RGBColor],
    ) -> Result<(), FigureError> {
        let data = BASE64_STANDARD.encode(png(colours)?);
        let [x, y, width, height] = [x, y, width, height].map(fine);
        *self.images.borrow_mut() += &format!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             style=\"image-rendering:pixelated\" preserveAspectRatio=\"none\" \
             href=\"data:image/png;base64,{data}\"/>\n"
        );
        Ok(())
    }

    /// A legend centred below `top`.
    pub(super) fn legend(
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
            Key::Patch(colour) => {
                let (corner, size) = ((x + 10.0, y - 7.0), (22.0, 14.0));
                self.rectangle(corner, size, colour)?;
                let far = (corner.0 + size.0, corner.1 + size.1);
                let at = |(x, y)| (fine(x), fine(y));
                self.draw(&Rectangle::new([at(corner), at(far)], INK.stroke_width(2)))
            }
        }
    }

    /// A panel whose plot has its upper left corner at `corner` and the given size; [`LEFT`],
    /// [`BELOW`] and [`ABOVE`] of it are for its titles and labels.
    pub(super) fn panel<'c>(
        &'c self,
        corner: (f64, f64),
        size: (f64, f64),
        axes: Axes,
    ) -> Result<Panel<'c, 'a>, FigureError> {
        self.labelled_panel(corner, size, axes, (number, number))
    }

    /// The same with tick labels of one's own along x and y.
    pub(super) fn labelled_panel<'c>(
        &'c self,
        corner: (f64, f64),
        size: (f64, f64),
        axes: Axes,
        labels: (Label, Label),
    ) -> Result<Panel<'c, 'a>, FigureError> {
        let middle = (corner.0 + size.0 / 2.0, corner.1 - ABOVE / 2.0);
        self.text(&axes.title, middle, 15.0, Anchor::Middle)?;
        let whole = self.area.clone().shrink(
            (fine(corner.0 - LEFT), fine(corner.1)),
            (fine(size.0 + LEFT), fine(size.1 + BELOW)),
        );
        let mut chart = ChartBuilder::on(&whole)
            .set_label_area_size(LabelAreaPosition::Left, fine(LEFT))
            .set_label_area_size(LabelAreaPosition::Bottom, fine(BELOW))
            .build_cartesian_2d(axes.x.clone(), axes.y.clone())
            .map_err(FigureError::drawing)?;
        let font = ("sans-serif", fine(TEXT)).into_font().color(&INK);
        chart
            .configure_mesh()
            .axis_style(INK.stroke_width(fine_size(1.0)))
            .bold_line_style(MESH.stroke_width(fine_size(1.0)))
            .light_line_style(TRANSPARENT)
            .label_style(font)
            .x_labels(axes.ticks.0)
            .y_labels(axes.ticks.1)
            .set_all_tick_mark_size(fine(4.0))
            .x_label_formatter(&|v| labels.0(*v))
            .y_label_formatter(&|v| labels.1(*v))
            .draw()
            .map_err(FigureError::drawing)?;
        let frame = Rectangle::new(
            [
                (fine(corner.0), fine(corner.1)),
                (fine(corner.0 + size.0), fine(corner.1 + size.1)),
            ],
            INK.stroke_width(fine_size(1.0)),
        );
        self.draw(&frame)?;
        let below = (middle.0, corner.1 + size.1 + BELOW - AXIS_TITLE);
        self.text(axes.x_title, below, TEXT, Anchor::Middle)?;
        let beside = (corner.0 - LEFT + AXIS_TITLE, corner.1 + size.1 / 2.0);
        self.text(axes.y_title, beside, TEXT, Anchor::Upright)?;
        Ok(Panel {
            canvas: self,
            x: axes.x,
            y: axes.y,
            corner,
            size,
        })
    }
}

impl Panel<'_, '_> {
    /// Nominal pixels per unit of x.
    fn scale(&self) -> f64 {
        self.size.0 / (self.x.end - self.x.start)
    }

    fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let along = (x - self.x.start) / (self.x.end - self.x.start);
        let up = (y - self.y.start) / (self.y.end - self.y.start);
        (
            self.corner.0 + self.size.0 * along,
            self.corner.1 + self.size.1 * (1.0 - up),
        )
    }

    /// Whether a point lies in the plot, at least `margin` from its frame.
    pub(super) fn shows(&self, (x, y): (f64, f64), margin: f64) -> bool {
        let within =
            |range: &Range<f64>, v: f64| (range.start + margin..=range.end - margin).contains(&v);
        within(&self.x, x) && within(&self.y, y)
    }

    /// A line through points, as far as it lies in the plot.
    pub(super) fn line(&self, points: &[(f64, f64)], stroke: Stroke) -> Result<(), FigureError> {
        let mut piece: Vec<(f64, f64)> = Vec::new();
        for ends in points.windows(2) {
            let Some((enters, leaves)) = self.clip(ends[0], ends[1]) else {
                continue;
            };
            let at = |share: f64| {
                let [a, b] = [ends[0], ends[1]];
                self.place((a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1)))
            };
            if piece.is_empty() {
                piece.push(at(enters));
            }
            piece.push(at(leaves));
            if leaves < 1.0 {
                self.canvas.line(&piece, stroke)?;
                piece.clear();
            }
        }
        if piece.len() > 1 {
            self.canvas.line(&piece, stroke)?;
        }
        Ok(())
    }

    /// The shares of the way from `a` to `b` at which it enters and leaves the plot (Liang and
    /// Barsky, 1984).
    fn clip(&self, a: (f64, f64), b: (f64, f64)) -> Option<(f64, f64)> {
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for (from, to, range) in [(a.0, b.0, &self.x), (a.1, b.1, &self.y)] {
            let step = to - from;
            if step.abs() < f64::MIN_POSITIVE {
                if !(range.start..=range.end).contains(&from) {
                    return None;
                }
                continue;
            }
            let [first, last] = [(range.start - from) / step, (range.end - from) / step];
            enters = enters.max(first.min(last));
            leaves = leaves.min(first.max(last));
        }
        (enters < leaves).then_some((enters, leaves))
    }

    /// A marker at a point, if the plot shows the point.
    pub(super) fn marker(
        &self,
        at: (f64, f64),
        colour: RGBColor,
        shape: Shape,
        filled: bool,
    ) -> Result<(), FigureError> {
        if !self.shows(at, 0.0) {
            return Ok(());
        }
        self.canvas.marker(self.place(at), colour, shape, filled)
    }

    pub(super) fn dot(&self, at: (f64, f64), colour: RGBColor) -> Result<(), FigureError> {
        self.canvas.dot(self.place(at), colour)
    }

    /// An arrow of a nominal length from a point along a unit vector.
    pub(super) fn arrow(
        &self,
        from: (f64, f64),
        along: (f64, f64),
        length: f64,
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        self.canvas.arrow(self.place(from), along, length, colour)
    }

    /// An arrow downward with the letter g, in the corner of the plot that the points leave most free.
    pub(super) fn gravity(&self, points: &[(f64, f64)]) -> Result<(), FigureError> {
        const INSET: (f64, f64) = (24.0, 14.0);
        const LENGTH: f64 = 30.0;
        let (left, right) = (
            self.corner.0 + INSET.0,
            self.corner.0 + self.size.0 - INSET.0,
        );
        let (top, low) = (
            self.corner.1 + INSET.1,
            self.corner.1 + self.size.1 - INSET.1 - LENGTH,
        );
        let room = |(x, y): (f64, f64)| {
            let distances = points.iter().map(|at| {
                let at = self.place(*at);
                (at.0 - x).hypot(at.1 - (y + LENGTH / 2.0))
            });
            distances.fold(f64::INFINITY, f64::min)
        };
        let mut at = (right, top);
        for corner in [(left, top), (right, low), (left, low)] {
            if room(corner) > room(at) {
                at = corner;
            }
        }
        self.canvas.arrow(at, (0.0, -1.0), LENGTH, INK)?;
        self.canvas.label("g", (at.0 + 8.0, at.1 + LENGTH / 2.0))
    }

    /// A sphere of radius 1 with an arrow along its orientation; the scales of x and y must be equal.
    pub(super) fn sphere(
        &self,
        centre: (f64, f64),
        heading: (f64, f64),
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        self.canvas
            .sphere(self.place(centre), self.scale(), colour)?;
        let at = |along: f64, across: f64| {
            let x = centre.0 + along * heading.0 - across * heading.1;
            let y = centre.1 + along * heading.1 + across * heading.0;
            self.place((x, y))
        };
        let stroke = Stroke {
            colour,
            width: 1.5,
            dash: Dash::Solid,
        };
        self.canvas.line(&[at(0.0, 0.0), at(0.6, 0.0)], stroke)?;
        let head = [at(0.85, 0.0), at(0.5, 0.17), at(0.5, -0.17)];
        let head = head.map(|(x, y)| (fine(x), fine(y))).to_vec();
        self.canvas.draw(&Polygon::new(head, colour.filled()))
    }
}
