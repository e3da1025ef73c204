//! Opaque bodies and arrows in a picture of a field, clipped to the plot.

use maud::{PreEscaped, html};

use super::marks::listed;
use super::{Anchor, Canvas, Panel, TEXT, px};
use crate::figures::style::{Colour, Dash, INK, Stroke, WHITE};

/// Half the width and the length of an arrow head, in pixels.
const HEAD: (f64, f64) = (3.6, 8.0);

/// Width of the light edge of a line over a field.
const EDGE: f64 = 1.4;

impl Canvas {
    /// Draws with everything outside a box cut off.
    fn clipped(
        &mut self,
        (x, y): (f64, f64),
        (width, height): (f64, f64),
        paint: impl FnOnce(&mut Self),
    ) {
        let outside = std::mem::take(&mut self.markup);
        paint(self);
        let inside = std::mem::replace(&mut self.markup, outside);
        let view = [x, y, width, height].map(px).join(" ");
        self.draw(html! {
            svg x=(px(x)) y=(px(y)) width=(px(width)) height=(px(height)) viewBox=(view) overflow="hidden" {
                (PreEscaped(inside))
            }
        });
    }
}

impl Panel<'_> {
    /// Draws with everything outside the plot cut off, and the frame anew on top.
    pub(crate) fn within_frame(&mut self, paint: impl FnOnce(&mut Panel<'_>)) {
        let (corner, size) = (self.corner, self.size);
        let (x, y, is_filled) = (self.x.clone(), self.y.clone(), &mut self.is_filled);
        self.canvas.clipped(corner, size, |canvas| {
            let mut inner = Panel {
                canvas,
                x,
                y,
                corner,
                size,
                is_filled: *is_filled,
            };
            paint(&mut inner);
            *is_filled = inner.is_filled;
        });
        self.canvas.frame(corner, size, 1.0);
    }

    /// Pixels of a length along x.
    pub(crate) fn pixels(&self, length: f64) -> f64 {
        length * self.size.0 / (self.x.range.end - self.x.range.start)
    }

    /// A disc that covers what is below it, of a radius in the units of the axes.
    pub(crate) fn disc(&mut self, centre: (f64, f64), radius: f64, line: Colour) {
        let (x, y) = self.place(centre);
        let radius = self.pixels(radius);
        self.is_filled = true;
        self.canvas.draw(html! {
            circle cx=(px(x)) cy=(px(y)) r=(px(radius)) fill=(WHITE) stroke=(line) stroke-width="1.5" {}
        });
    }

    /// A line over a field: dark with a light edge, so that it can be seen on every colour.
    pub(crate) fn streamline(&mut self, points: &[(f64, f64)]) {
        let places: Vec<_> = points.iter().map(|at| self.place(*at)).collect();
        self.is_filled = true;
        let light = px(1.0 + EDGE);
        self.canvas.draw(html! {
            polyline points=(listed(&places)) fill="none" stroke=(WHITE) stroke-opacity="0.55" stroke-width=(light) {}
        });
        self.canvas
            .line(&places, Stroke::new(INK, 1.0, Dash::Solid));
    }

    /// A short text at a point.
    pub(crate) fn label(&mut self, at: (f64, f64), text: &str) {
        self.canvas.text(text, self.place(at), TEXT, Anchor::Middle);
    }

    /// The head of an arrow, its middle at a point of a streamline, along a vector in the units of the axes.
    pub(crate) fn head(&mut self, at: (f64, f64), along: (f64, f64)) {
        let (x, y) = self.place(at);
        let length = along.0.hypot(along.1);
        let (dx, dy) = (along.0 / length, -along.1 / length);
        let (half, whole) = HEAD;
        let corner =
            |forward: f64, left: f64| (x + forward * dx + left * dy, y + forward * dy - left * dx);
        let corners = [
            corner(0.5 * whole, 0.0),
            corner(-0.5 * whole, half),
            corner(-0.5 * whole, -half),
        ];
        self.canvas.draw(html! {
            polygon points=(listed(&corners)) fill=(INK) stroke=(WHITE) stroke-opacity="0.55" stroke-width="0.7" {}
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Axes, Axis};
    use super::*;

    #[test]
    fn what_lies_outside_the_plot_is_cut_off() {
        let axes = Axes {
            title: String::new(),
            x: Axis::new(&(0.0..1.0), "x", 5),
            y: Axis::new(&(0.0..1.0), "y", 5),
        };
        let mut canvas = Canvas::new("a field", (300.0, 350.0), &[]);
        canvas.panel((70.0, 70.0), (200.0, 200.0), axes, |panel| {
            panel.within_frame(|panel| {
                panel.disc((0.0, 0.0), 0.5, INK);
                panel.head((0.5, 0.5), (0.0, 2.0));
            });
        });
        let svg = canvas.finish();
        let clip = svg.split("overflow=\"hidden\"").nth(1).unwrap();
        assert!(clip.contains("viewBox") || svg.contains("viewBox=\"70 70 200 200\""));
        let disc = clip.find("cx=\"70\" cy=\"270\" r=\"100\"").unwrap();
        assert!(disc < clip.find("</svg>").unwrap());
        // Upward on the page, and as wide as it is to be.
        assert!(clip.contains("170,166"), "{clip}");
        assert!(!svg.contains("no data"));
    }
}
