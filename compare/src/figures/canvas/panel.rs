//! What lies between the axes of a panel, in the units of its axes, as far as the panel shows it.

use std::ops::Range;

use plotters::prelude::*;

use super::{Canvas, Stroke, fine};
use crate::figures::FigureError;
use crate::figures::style::{Dash, INK, Shape};

/// A plot in a picture: axes, and what lies between them.
pub(in crate::figures) struct Panel<'c, 'a> {
    pub(super) canvas: &'c Canvas<'a>,
    pub(super) x: Range<f64>,
    pub(super) y: Range<f64>,
    /// Upper left corner and size of the plot.
    pub(super) corner: (f64, f64),
    pub(super) size: (f64, f64),
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

    /// A line through points, as far as it lies in the plot.
    pub(in crate::figures) fn line(
        &self,
        points: &[(f64, f64)],
        stroke: Stroke,
    ) -> Result<(), FigureError> {
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
    pub(in crate::figures) fn marker(
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

    pub(in crate::figures) fn dot(
        &self,
        at: (f64, f64),
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        self.canvas.dot(self.place(at), colour)
    }

    /// An arrow of a nominal length from a point along a unit vector.
    pub(in crate::figures) fn arrow(
        &self,
        from: (f64, f64),
        along: (f64, f64),
        length: f64,
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        self.canvas.arrow(self.place(from), along, length, colour)
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
