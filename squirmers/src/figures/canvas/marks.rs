//! Marks on the sheet: lines, markers, dots, spheres, arrows and rectangles.

use maud::html;

use super::{Canvas, px};
use crate::figures::style::{Colour, Dash, INK, Shape, Stroke, WHITE};

/// Points as the text of a polyline or polygon.
pub(super) fn listed(points: &[(f64, f64)]) -> String {
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

    /// A marker at a place, filled or hollow.
    pub(super) fn marker(&mut self, at: (f64, f64), colour: Colour, shape: Shape, filled: bool) {
        // A white edge separates markers with the same colour and place.
        let (fill, edge) = if filled {
            (colour, WHITE)
        } else {
            (WHITE, colour)
        };
        let corners = shape.corners().iter();
        let corners: Vec<_> = corners.map(|(x, y)| (at.0 + x, at.1 + y)).collect();
        self.draw(html! {
            @if corners.is_empty() {
                circle cx=(px(at.0)) cy=(px(at.1)) r="5.5" fill=(fill) stroke=(edge) stroke-width="1.25" {}
            } @else {
                polygon points=(listed(&corners)) fill=(fill) stroke=(edge) stroke-width="1.25" {}
            }
        });
    }

    pub(super) fn dot(&mut self, (x, y): (f64, f64), colour: Colour) {
        self.draw(html! { circle cx=(px(x)) cy=(px(y)) r="2.6" fill=(colour) {} });
    }

    /// A transparent sphere.
    pub(super) fn sphere(&mut self, (x, y): (f64, f64), radius: f64, colour: Colour) {
        self.draw(html! {
            circle cx=(px(x)) cy=(px(y)) r=(px(radius)) fill=(colour) fill-opacity="0.14" stroke=(colour) {}
        });
    }

    /// An arrow along a vector `(along, up)`: a unit vector, or a shorter one if it points out of the plane.
    pub(super) fn arrow(
        &mut self,
        (x, y): (f64, f64),
        (along, up): (f64, f64),
        length: f64,
        colour: Colour,
    ) {
        // Coordinates forward and to the left, as shares of the length.
        let at = |forward: f64, left: f64| {
            let (dx, dy) = (forward * along - left * up, forward * up + left * along);
            (x + length * dx, y - length * dy)
        };
        let stroke = Stroke::new(colour, 1.3, Dash::Solid);
        self.line(&[(x, y), at(0.7, 0.0)], stroke);
        let head = listed(&[at(1.0, 0.0), at(0.6, 0.19), at(0.6, -0.19)]);
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
