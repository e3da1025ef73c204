//! Marks on the sheet: lines, markers, dots, spheres, arrows and rectangles.

use maud::html;

use super::{Canvas, px};
use crate::figures::style::{Colour, Dash, INK, Shape, Stroke, WHITE};

/// Points as a polyline or polygon lists them.
fn listed(points: &[(f64, f64)]) -> String {
    let places: Vec<_> = points
        .iter()
        .map(|(x, y)| format!("{},{}", px(*x), px(*y)))
        .collect();
    places.join(" ")
}

impl Canvas {
    /// A line through points.
    pub(super) fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let (width, dash) = (px(stroke.width), stroke.dash.pattern());
        self.draw(html! {
            polyline points=(listed(points)) fill="none" stroke=(stroke.colour) stroke-width=(width)
                stroke-dasharray=[dash] stroke-linejoin="round" {}
        });
    }

    pub(super) fn marker(&mut self, at: (f64, f64), colour: Colour, shape: Shape, filled: bool) {
        // A white edge keeps markers apart that share a colour and a place.
        let (fill, edge) = if filled {
            (colour, WHITE)
        } else {
            (WHITE, colour)
        };
        let (size, corners) = (shape.size(), shape.corners().iter());
        let corners: Vec<_> = corners
            .map(|(x, y)| (at.0 + x * size, at.1 + y * size))
            .collect();
        self.draw(html! {
            @if corners.is_empty() {
                circle cx=(px(at.0)) cy=(px(at.1)) r=(size) fill=(fill) stroke=(edge) stroke-width="1.25" {}
            } @else {
                polygon points=(listed(&corners)) fill=(fill) stroke=(edge) stroke-width="1.25" {}
            }
        });
    }

    pub(super) fn dot(&mut self, (x, y): (f64, f64), colour: Colour) {
        self.draw(html! { circle cx=(px(x)) cy=(px(y)) r="2.6" fill=(colour) {} });
    }

    pub(super) fn sphere(&mut self, (x, y): (f64, f64), radius: f64, colour: Colour) {
        self.draw(html! {
            circle cx=(px(x)) cy=(px(y)) r=(px(radius)) fill=(colour) fill-opacity="0.14" stroke=(colour) {}
        });
    }

    /// An arrow of a length along a unit vector whose second component is upward.
    pub(super) fn arrow(
        &mut self,
        from: (f64, f64),
        along: (f64, f64),
        length: f64,
        colour: Colour,
    ) {
        self.headed_arrow(from, along, (length, 1.2), (7.0, 3.2), colour);
    }

    /// The same with a line's width, and the length of the head and half its width.
    pub(super) fn headed_arrow(
        &mut self,
        from: (f64, f64),
        (along, up): (f64, f64),
        (length, width): (f64, f64),
        head: (f64, f64),
        colour: Colour,
    ) {
        let at = |forward: f64, aside: f64| {
            let x = from.0 + forward * along - aside * up;
            (x, from.1 - forward * up - aside * along)
        };
        let foot = length - head.0;
        // The line ends within the head: no seam shows.
        let line = [from, at(foot + 0.3 * head.0, 0.0)];
        self.line(&line, Stroke::new(colour, width, Dash::Solid));
        let head = listed(&[at(length, 0.0), at(foot, head.1), at(foot, -head.1)]);
        self.draw(html! { polygon points=(head) fill=(colour) {} });
    }

    /// A filled rectangle with its upper left corner at `(x, y)`.
    pub(crate) fn rectangle(&mut self, (x, y): (f64, f64), size: (f64, f64), colour: Colour) {
        let (width, height) = (px(size.0), px(size.1));
        self.draw(
            html! { rect x=(px(x)) y=(px(y)) width=(width) height=(height) fill=(colour) {} },
        );
    }

    /// The outline of a rectangle with its upper left corner at `(x, y)`.
    pub(super) fn frame(&mut self, (x, y): (f64, f64), size: (f64, f64), line: f64) {
        let (width, height, line) = (px(size.0), px(size.1), px(line));
        self.draw(html! {
            rect x=(px(x)) y=(px(y)) width=(width) height=(height) fill="none" stroke=(INK) stroke-width=(line) {}
        });
    }
}
