//! Axes of a panel: frame, mesh, ticks and titles.

use std::ops::Range;

use plotters::prelude::*;

use super::panel::Panel;
use super::{ABOVE, AXIS_TITLE, Anchor, BELOW, Canvas, LEFT, TEXT, fine, fine_size};
use crate::figures::style::{INK, MESH};
use crate::figures::{FigureError, number};

/// What a panel shows.
pub(in crate::figures) struct Axes {
    pub(in crate::figures) title: String,
    pub(in crate::figures) x: Range<f64>,
    pub(in crate::figures) y: Range<f64>,
    pub(in crate::figures) x_title: &'static str,
    pub(in crate::figures) y_title: &'static str,
    /// About how many ticks along x and y.
    pub(in crate::figures) ticks: (usize, usize),
}

/// Text of a tick.
type Label = fn(f64) -> String;

impl<'a> Canvas<'a> {
    /// A panel whose plot has its upper left corner at `corner` and the given size; [`LEFT`],
    /// [`BELOW`] and [`ABOVE`] of it are for its titles and labels.
    pub(in crate::figures) fn panel<'c>(
        &'c self,
        corner: (f64, f64),
        size: (f64, f64),
        axes: Axes,
    ) -> Result<Panel<'c, 'a>, FigureError> {
        self.labelled_panel(corner, size, axes, (number, number))
    }

    /// The same with tick labels of one's own along x and y.
    pub(in crate::figures) fn labelled_panel<'c>(
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
