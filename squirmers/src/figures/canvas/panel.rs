//! Draws data in a panel, in the units of its axes. Data outside the axes are not drawn.

use super::{Anchor, Axes, Axis, Canvas, Map, TEXT, text_width};
use crate::figures::style::{Colour, Dash, Fill, INK, Shape, Stroke, WHITE};

/// The text of an empty panel.
const NO_DATA: &str = "no data";

/// A plot in a picture: its axes and its data.
pub(crate) struct Panel<'c> {
    pub(super) canvas: &'c mut Canvas,
    pub(super) x: Axis,
    pub(super) y: Axis,
    /// Upper left corner and size of the plot.
    pub(super) corner: (f64, f64),
    pub(super) size: (f64, f64),
    /// Whether any data have been drawn.
    pub(super) is_filled: bool,
}

impl Canvas {
    /// A panel whose plot has its upper left corner at `corner` and the given size. Titles and labels are outside the
    /// plot. If `paint` draws no data, the panel shows "no data".
    pub(crate) fn panel(
        &mut self,
        corner: (f64, f64),
        size: (f64, f64),
        axes: Axes,
        paint: impl FnOnce(&mut Panel<'_>),
    ) {
        let Axes { title, x, y } = axes;
        let mut panel = Panel {
            canvas: self,
            x,
            y,
            corner,
            size,
            is_filled: false,
        };
        panel.draw_axes(&title);
        paint(&mut panel);
        if !panel.is_filled {
            panel.say_no_data();
        }
    }
}

impl Panel<'_> {
    /// Writes "no data" into an empty frame, because a reader could take an empty frame for an error.
    fn say_no_data(&mut self) {
        let ((left, top), (width, height)) = (self.corner, self.size);
        let middle = (left + 0.5 * width, top + 0.5 * height);
        let plate = (text_width(NO_DATA, TEXT) + 8.0, TEXT + 6.0);
        let corner = (middle.0 - 0.5 * plate.0, middle.1 - 0.5 * plate.1);
        self.canvas.rectangle(corner, plate, WHITE);
        self.canvas.text(NO_DATA, middle, TEXT, Anchor::Middle);
    }

    pub(super) fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (
            self.corner.0 + self.size.0 * self.x.share(x),
            self.corner.1 + self.size.1 * (1.0 - self.y.share(y)),
        )
    }

    /// Whether a point lies in the plot, at least `margin` from its frame.
    pub(crate) fn shows(&self, (x, y): (f64, f64), margin: f64) -> bool {
        let within = |axis: &Axis, v: f64| {
            (axis.range.start + margin..=axis.range.end - margin).contains(&v)
        };
        within(&self.x, x) && within(&self.y, y)
    }

    /// Whether to draw a mark at a point. If so, the panel is not empty.
    fn takes(&mut self, at: (f64, f64)) -> bool {
        let shows = self.shows(at, 0.0);
        self.is_filled |= shows;
        shows
    }

    /// A line through points, clipped to the plot. NaN coordinates interrupt the line.
    pub(crate) fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
        let mut goes_on = false;
        for ends in points.windows(2) {
            let [a, b] = [ends[0], ends[1]];
            let Some((enters, leaves)) = self.clip(a, b) else {
                goes_on = false;
                continue;
            };
            let at =
                |share: f64| self.place((a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1)));
            match pieces.last_mut() {
                Some(piece) if goes_on => piece.push(at(leaves)),
                _ => pieces.push(vec![at(enters), at(leaves)]),
            }
            goes_on = leaves >= 1.0;
        }
        self.is_filled |= !pieces.is_empty();
        for piece in pieces {
            self.canvas.line(&piece, stroke);
        }
    }

    /// A line through points without markers. A point without neighbours is a dot.
    pub(crate) fn path(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let is_finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
        for run in points.chunk_by(|a, b| is_finite(a) && is_finite(b)) {
            let first = run[0];
            let apart =
                |p: &(f64, f64)| p.0.total_cmp(&first.0).is_ne() || p.1.total_cmp(&first.1).is_ne();
            if run.iter().any(apart) {
                self.line(run, stroke);
            } else {
                self.dot(first, stroke.colour);
            }
        }
    }

    /// The line y = 0, which does not count as data.
    pub(crate) fn zero_line(&mut self) {
        if self.shows((self.x.range.start, 0.0), 0.0) {
            let ends = [self.x.range.start, self.x.range.end].map(|x| self.place((x, 0.0)));
            self.canvas.line(&ends, Stroke::new(INK, 0.75, Dash::Solid));
        }
    }

    /// The shares of the way from `a` to `b` at which the line enters and leaves the plot (Liang and Barsky, 1984);
    /// `None` if the line is outside the plot or a coordinate is not finite.
    fn clip(&self, a: (f64, f64), b: (f64, f64)) -> Option<(f64, f64)> {
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for (from, to, range) in [(a.0, b.0, &self.x.range), (a.1, b.1, &self.y.range)] {
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

    /// A marker at a point, if the plot shows the point.
    pub(crate) fn marker(&mut self, at: (f64, f64), colour: Colour, shape: Shape, filled: bool) {
        if self.takes(at) {
            self.canvas.marker(self.place(at), colour, shape, filled);
        }
    }

    /// A dot at a point, if the plot shows the point.
    pub(crate) fn dot(&mut self, at: (f64, f64), colour: Colour) {
        if self.takes(at) {
            self.canvas.dot(self.place(at), colour);
        }
    }

    /// An arrow of a length in pixels along a unit vector, if the plot shows the point that it leaves.
    pub(crate) fn arrow(
        &mut self,
        from: (f64, f64),
        along: (f64, f64),
        length: f64,
        colour: Colour,
    ) {
        if self.takes(from) {
            self.canvas.arrow(self.place(from), along, length, colour);
        }
    }

    /// A map over the whole plot. Draws nothing if no point is known.
    pub(crate) fn map(&mut self, map: &Map) {
        if map.is_data {
            self.is_filled = true;
            self.canvas.map(self.corner, self.size, map);
        }
    }

    /// A bar from `low` to `high` along y, centred at a place along x.
    pub(crate) fn bar(&mut self, (middle, width): (f64, f64), (low, high): (f64, f64), fill: Fill) {
        if low < high && self.takes((middle, 0.5 * (low + high))) {
            let (left, top) = self.place((middle - 0.5 * width, high));
            let (right, foot) = self.place((middle + 0.5 * width, low));
            self.canvas
                .patch((left, top), (right - left, foot - top), fill);
        }
    }

    /// An arrow downward with the letter g, in the corner of the plot that is farthest from the points.
    pub(crate) fn gravity(&mut self, points: &[(f64, f64)]) {
        const LENGTH: f64 = 24.0;
        let (left, right) = (self.corner.0 + 24.0, self.corner.0 + self.size.0 - 24.0);
        let (top, low) = (
            self.corner.1 + 14.0,
            self.corner.1 + self.size.1 - 14.0 - LENGTH,
        );
        let room = |(x, y): (f64, f64)| {
            let places = points.iter().map(|at| self.place(*at));
            let distances = places.map(|at| (at.0 - x).hypot(at.1 - (y + 0.5 * LENGTH)));
            distances.fold(f64::INFINITY, f64::min)
        };
        let corners = [(left, top), (right, low), (left, low)];
        let freer = |a, b| if room(b) > room(a) { b } else { a };
        let at = corners.into_iter().fold((right, top), freer);
        self.canvas.arrow(at, (0.0, -1.0), LENGTH, INK);
        let beside = (at.0 + 8.0, at.1 + 0.5 * LENGTH);
        self.canvas.text("g", beside, TEXT, Anchor::Start);
    }

    /// A sphere with an arrow along its orientation; the scales of x and y must be equal.
    pub(crate) fn sphere(
        &mut self,
        centre: (f64, f64),
        radius: f64,
        heading: (f64, f64),
        colour: Colour,
    ) {
        if !self.takes(centre) {
            return;
        }
        let radius = radius * self.size.0 / (self.x.range.end - self.x.range.start);
        let at = self.place(centre);
        self.canvas.sphere(at, radius, colour);
        self.canvas.arrow(at, heading, 0.85 * radius, colour);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STROKE: Stroke = Stroke {
        colour: Colour(1, 2, 3),
        width: 2.0,
        dash: Dash::Solid,
    };

    fn drawn(paint: impl FnOnce(&mut Panel<'_>)) -> String {
        let axes = Axes {
            title: String::new(),
            x: Axis::new(&(0.0..1.0), "x", 5),
            y: Axis::new(&(0.0..1.0), "y", 5),
        };
        let mut canvas = Canvas::new("a panel", (300.0, 350.0), &[]);
        canvas.panel((70.0, 70.0), (200.0, 200.0), axes, paint);
        canvas.finish()
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
                panel.dot(at, STROKE.colour);
                panel.arrow(at, (1.0, 0.0), 10.0, STROKE.colour);
                panel.marker(at, STROKE.colour, Shape::Square, true);
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
        // The line leaves through a point on the frame and enters again elsewhere.
        let away = [(0.5, 0.5), (1.0, 0.5), (2.0, 0.5), (2.0, 0.9), (0.5, 0.9)];
        assert_eq!(lines(&away), 2);
        // The line leaves between two points and enters again at once.
        assert_eq!(lines(&[(0.5, 0.5), (2.0, 0.5), (0.5, 0.9)]), 2);
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
