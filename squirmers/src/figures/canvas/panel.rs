//! What lies between the axes of a panel, in the units of its axes, as far as the panel shows it.

use std::cell::Cell;
use std::ops::Range;

use plotters::prelude::*;

use super::{Anchor, Canvas, Stroke, TEXT, fine, text_width};
use crate::figures::FigureError;
use crate::figures::style::{Dash, Fill, INK, Shape};

/// What an empty panel says.
const NO_DATA: &str = "no data";

/// One point of a map.
#[derive(Clone, Copy)]
pub(in crate::figures) struct MapCell {
    pub fill: Fill,
    /// Whether the panel's quantity is known there.
    pub is_data: bool,
}

/// A plot in a picture: axes, and what lies between them.
pub(in crate::figures) struct Panel<'c, 'a> {
    canvas: &'c Canvas<'a>,
    x: Range<f64>,
    y: Range<f64>,
    /// Upper left corner and size of the plot.
    corner: (f64, f64),
    size: (f64, f64),
    /// Whether anything of the data has been drawn.
    filled: Cell<bool>,
}

impl<'c, 'a> Panel<'c, 'a> {
    /// A panel over ranges that can be drawn.
    pub(super) fn new(
        canvas: &'c Canvas<'a>,
        (x, y): (Range<f64>, Range<f64>),
        corner: (f64, f64),
        size: (f64, f64),
    ) -> Self {
        Self {
            canvas,
            x,
            y,
            corner,
            size,
            filled: Cell::new(false),
        }
    }

    /// An empty frame is no answer: it might be a fault of the picture.
    pub(super) fn say_if_empty(&self) -> Result<(), FigureError> {
        if self.filled.get() {
            return Ok(());
        }
        let [(left, top), (width, height)] = [self.corner, self.size];
        let middle = (left + 0.5 * width, top + 0.5 * height);
        let plate = (text_width(NO_DATA, TEXT) + 8.0, TEXT + 6.0);
        let corner = (middle.0 - 0.5 * plate.0, middle.1 - 0.5 * plate.1);
        self.canvas.rectangle(corner, plate, WHITE)?;
        self.canvas.text(NO_DATA, middle, TEXT, Anchor::Middle)
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
    pub(in crate::figures) fn shows(&self, (x, y): (f64, f64), margin: f64) -> bool {
        let within =
            |range: &Range<f64>, v: f64| (range.start + margin..=range.end - margin).contains(&v);
        within(&self.x, x) && within(&self.y, y)
    }

    /// A line through points, as far as it lies in the plot; it breaks where a coordinate is no number.
    pub(in crate::figures) fn line(
        &self,
        points: &[(f64, f64)],
        stroke: Stroke,
    ) -> Result<(), FigureError> {
        let mut piece: Vec<(f64, f64)> = Vec::new();
        for ends in points.windows(2) {
            let [a, b] = [ends[0], ends[1]];
            let Some((enters, leaves)) = self.clip(a, b) else {
                self.piece(&mut piece, stroke)?;
                continue;
            };
            let at =
                |share: f64| self.place((a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1)));
            if piece.is_empty() {
                piece.push(at(enters));
            }
            piece.push(at(leaves));
            if leaves < 1.0 {
                self.piece(&mut piece, stroke)?;
            }
        }
        self.piece(&mut piece, stroke)
    }

    fn piece(&self, piece: &mut Vec<(f64, f64)>, stroke: Stroke) -> Result<(), FigureError> {
        if piece.len() > 1 {
            self.filled.set(true);
            self.canvas.line(piece, stroke)?;
        }
        piece.clear();
        Ok(())
    }

    /// A line through points that have no markers: one without neighbours is a dot.
    pub(in crate::figures) fn path(
        &self,
        points: &[(f64, f64)],
        stroke: Stroke,
    ) -> Result<(), FigureError> {
        let finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
        for run in points.chunk_by(|a, b| finite(a) && finite(b)) {
            let (first, rest) = (run[0], &run[1..]);
            let apart =
                |p: &(f64, f64)| p.0.total_cmp(&first.0).is_ne() || p.1.total_cmp(&first.1).is_ne();
            if rest.iter().any(apart) {
                self.line(run, stroke)?;
            } else {
                self.dot(first, stroke.colour)?;
            }
        }
        Ok(())
    }

    /// The line of zero, which is no data.
    pub(in crate::figures) fn zero_line(&self) -> Result<(), FigureError> {
        if !self.shows((self.x.start, 0.0), 0.0) {
            return Ok(());
        }
        let stroke = Stroke {
            colour: INK,
            width: 0.75,
            dash: Dash::Solid,
        };
        let ends = [self.x.start, self.x.end].map(|x| self.place((x, 0.0)));
        self.canvas.line(&ends, stroke)
    }

    /// The shares of the way from `a` to `b` at which it enters and leaves the plot (Liang and
    /// Barsky, 1984); none where one of them is no number.
    fn clip(&self, a: (f64, f64), b: (f64, f64)) -> Option<(f64, f64)> {
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for (from, to, range) in [(a.0, b.0, &self.x), (a.1, b.1, &self.y)] {
            let step = to - from;
            if !step.is_finite() {
                return None;
            }
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

    /// Whether a mark at a point is to be drawn.
    fn takes(&self, at: (f64, f64)) -> bool {
        let shows = self.shows(at, 0.0);
        self.filled.set(self.filled.get() || shows);
        shows
    }

    /// A marker at a point, if the plot shows the point.
    pub(in crate::figures) fn marker(
        &self,
        at: (f64, f64),
        colour: RGBColor,
        shape: Shape,
        filled: bool,
    ) -> Result<(), FigureError> {
        if !self.takes(at) {
            return Ok(());
        }
        self.canvas.marker(self.place(at), colour, shape, filled)
    }

    /// A dot at a point, if the plot shows the point.
    pub(in crate::figures) fn dot(
        &self,
        at: (f64, f64),
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        if !self.takes(at) {
            return Ok(());
        }
        self.canvas.dot(self.place(at), colour)
    }

    /// An arrow of a nominal length along a unit vector, if the plot shows the point that it leaves.
    pub(in crate::figures) fn arrow(
        &self,
        from: (f64, f64),
        along: (f64, f64),
        length: f64,
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        if !self.takes(from) {
            return Ok(());
        }
        self.canvas.arrow(self.place(from), along, length, colour)
    }

    /// A grid of fills over the whole plot; nothing where none of them is data.
    pub(in crate::figures) fn grid(&self, cells: &[MapCell]) -> Result<(), FigureError> {
        if !cells.iter().any(|cell| cell.is_data) {
            return Ok(());
        }
        self.filled.set(true);
        let fills: Vec<Fill> = cells.iter().map(|cell| cell.fill).collect();
        self.canvas.grid(self.corner, self.size, &fills)
    }

    /// A bar from `low` to `high` along y, about a place along x.
    pub(in crate::figures) fn bar(
        &self,
        (middle, width): (f64, f64),
        (low, high): (f64, f64),
        fill: Fill,
    ) -> Result<(), FigureError> {
        if !(low < high && self.takes((middle, 0.5 * (low + high)))) {
            return Ok(());
        }
        let (left, top) = self.place((middle - 0.5 * width, high));
        let (right, foot) = self.place((middle + 0.5 * width, low));
        self.canvas
            .patch((left, top), (right - left, foot - top), fill)
    }

    /// An arrow downward with the letter g, in the corner of the plot that the points leave most free.
    pub(in crate::figures) fn gravity(&self, points: &[(f64, f64)]) -> Result<(), FigureError> {
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
    pub(in crate::figures) fn sphere(
        &self,
        centre: (f64, f64),
        heading: (f64, f64),
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        self.takes(centre);
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

#[cfg(test)]
mod tests {
    use super::super::{Axes, picture};
    use super::*;

    const STROKE: Stroke = Stroke {
        colour: RGBColor(1, 2, 3),
        width: 2.0,
        dash: Dash::Solid,
    };

    fn drawn(paint: impl FnOnce(&Panel<'_, '_>) -> Result<(), FigureError>) -> String {
        let axes = Axes {
            title: String::new(),
            x: 0.0..1.0,
            y: 0.0..1.0,
            x_title: "x",
            y_title: "y",
            ticks: (5, 5),
        };
        let draw = |canvas: &Canvas<'_>| canvas.panel((70.0, 70.0), (200.0, 200.0), axes, paint);
        picture((300.0, 350.0), "a panel", draw).unwrap()
    }

    #[test]
    fn marks_outside_the_panel_are_not_drawn_and_leave_it_empty() {
        for at in [
            (5.0, 0.5),
            (0.5, -0.1),
            (f64::NAN, 0.5),
            (0.5, f64::INFINITY),
        ] {
            let svg = drawn(|panel| {
                panel.dot(at, STROKE.colour)?;
                panel.arrow(at, (1.0, 0.0), 10.0, STROKE.colour)?;
                panel.marker(at, STROKE.colour, Shape::Square, true)
            });
            assert!(!svg.contains("#010203"), "{at:?}");
            assert!(svg.contains(NO_DATA), "{at:?}");
        }
        let svg = drawn(|panel| panel.dot((1.0, 0.5), STROKE.colour));
        assert!(svg.contains("#010203") && !svg.contains(NO_DATA));
    }

    #[test]
    fn lines_break_at_what_is_no_number_and_where_they_leave_the_panel() {
        let lines = |points: &[(f64, f64)]| {
            let svg = drawn(|panel| panel.line(points, STROKE));
            svg.lines()
                .filter(|l| l.contains("polyline") && l.contains("#010203"))
                .count()
        };
        let gap = [
            (0.0, 0.1),
            (0.2, 0.1),
            (0.4, f64::NAN),
            (0.6, 0.1),
            (0.8, 0.1),
        ];
        assert_eq!(lines(&gap), 2);
        // Out through a point on the frame, and in again elsewhere.
        let away = [(0.5, 0.5), (1.0, 0.5), (2.0, 0.5), (2.0, 0.9), (0.5, 0.9)];
        assert_eq!(lines(&away), 2);
        assert_eq!(lines(&[(0.5, -f64::MAX), (0.5, f64::MAX)]), 0);
    }

    #[test]
    fn a_path_of_one_point_is_a_dot() {
        let svg = drawn(|panel| panel.path(&[(0.5, 0.5), (0.5, 0.5)], STROKE));
        assert_eq!(svg.matches("<circle").count(), 1);
    }

    #[test]
    fn the_line_of_zero_is_no_data() {
        assert!(drawn(|panel| panel.zero_line()).contains(NO_DATA));
    }
}
