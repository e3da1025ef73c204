//! Marks on the sheet, in nominal pixels: markers, dots, spheres, arrows and rectangles.

use plotters::prelude::*;

use super::{Canvas, Stroke, fine, fine_size};
use crate::figures::FigureError;
use crate::figures::style::{Dash, Shape};

impl Canvas<'_> {
    pub(super) fn marker(
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

    pub(super) fn dot(&self, (x, y): (f64, f64), colour: RGBColor) -> Result<(), FigureError> {
        self.draw(&Circle::new((fine(x), fine(y)), fine(2.6), colour.filled()))
    }

    pub(super) fn sphere(
        &self,
        (x, y): (f64, f64),
        radius: f64,
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        let at = (fine(x), fine(y));
        self.draw(&Circle::new(at, fine(radius), colour.mix(0.14).filled()))?;
        self.draw(&Circle::new(at, fine(radius), colour.stroke_width(4)))
    }

    /// An arrow from a point along a unit vector whose second component is upward.
    pub(super) fn arrow(
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
    pub(in crate::figures) fn rectangle(
        &self,
        (x, y): (f64, f64),
        (width, height): (f64, f64),
        colour: RGBColor,
    ) -> Result<(), FigureError> {
        let corners = [(fine(x), fine(y)), (fine(x + width), fine(y + height))];
        self.draw(&Rectangle::new(corners, colour.filled()))
    }
}
