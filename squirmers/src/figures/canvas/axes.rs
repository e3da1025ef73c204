//! Axes of a panel: frame, mesh, ticks and titles.

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::panel::Panel;
use super::ticks::{Scale, Ticks};
use super::{ABOVE, AXIS_TITLE, Anchor, BELOW, Canvas, LEFT, TEXT, fine, fine_size};
use crate::figures::FigureError;
use crate::figures::range::sound;
use crate::figures::style::{INK, MESH};

/// What a panel shows.
pub(in crate::figures) struct Axes {
    pub title: String,
    pub x: Range<f64>,
    pub y: Range<f64>,
    pub x_title: &'static str,
    pub y_title: &'static str,
    /// About how many ticks along x and y.
    pub ticks: (usize, usize),
}

impl<'a> Canvas<'a> {
    /// A panel whose plot has its upper left corner at `corner` and the given size; [`LEFT`],
    /// [`BELOW`] and [`ABOVE`] of it are for its titles and labels. Where `paint` draws nothing it says so.
    pub(in crate::figures) fn panel(
        &self,
        corner: (f64, f64),
        size: (f64, f64),
        axes: Axes,
        paint: impl FnOnce(&Panel<'_, 'a>) -> Result<(), FigureError>,
    ) -> Result<(), FigureError> {
        self.scaled_panel(corner, size, axes, (Scale::Linear, Scale::Linear), paint)
    }

    /// The same with scales of one's own along x and y.
    pub(in crate::figures) fn scaled_panel(
        &self,
        corner: (f64, f64),
        size: (f64, f64),
        axes: Axes,
        scales: (Scale, Scale),
        paint: impl FnOnce(&Panel<'_, 'a>) -> Result<(), FigureError>,
    ) -> Result<(), FigureError> {
        let (x, y) = (sound(&axes.x), sound(&axes.y));
        let across = |chars: usize, share: f64| label_width(chars) + BETWEEN <= share * size.0;
        let up = |_: usize, share: f64| TEXT <= share * size.1;
        let ticks = (
            Ticks::new(&x, axes.ticks.0, scales.0, across),
            Ticks::new(&y, axes.ticks.1, scales.1, up),
        );
        self.draw_axes(corner, size, &axes, (&x, &y), (&ticks.0, &ticks.1))?;
        let panel = Panel::new(self, (x, y), corner, size);
        paint(&panel)?;
        panel.say_if_empty()
    }

    fn draw_axes(
        &self,
        corner: (f64, f64),
        size: (f64, f64),
        axes: &Axes,
        (x, y): (&Range<f64>, &Range<f64>),
        (across, up): (&Ticks, &Ticks),
    ) -> Result<(), FigureError> {
        let middle = (corner.0 + size.0 / 2.0, corner.1 - ABOVE / 2.0);
        self.text(&axes.title, middle, 15.0, Anchor::Middle)?;
        let whole = self.area.clone().shrink(
            (fine(corner.0 - LEFT), fine(corner.1)),
            (fine(size.0 + LEFT), fine(size.1 + BELOW)),
        );
        let mut chart = ChartBuilder::on(&whole)
            .set_label_area_size(LabelAreaPosition::Left, fine(LEFT))
            .set_label_area_size(LabelAreaPosition::Bottom, fine(BELOW))
            .build_cartesian_2d(Ticked::new(x, across), Ticked::new(y, up))
            .map_err(FigureError::drawing)?;
        let font = ("sans-serif", fine(TEXT)).into_font().color(&INK);
        chart
            .configure_mesh()
            .axis_style(INK.stroke_width(fine_size(1.0)))
            .bold_line_style(MESH.stroke_width(fine_size(1.0)))
            .light_line_style(TRANSPARENT)
            .label_style(font)
            .set_all_tick_mark_size(fine(4.0))
            .x_label_formatter(&|v| across.label(*v))
            .y_label_formatter(&|v| up.label(*v))
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
        self.text(&across.titled(axes.x_title), below, TEXT, Anchor::Middle)?;
        let beside = (corner.0 - LEFT + AXIS_TITLE, corner.1 + size.1 / 2.0);
        self.text(&up.titled(axes.y_title), beside, TEXT, Anchor::Upright)
    }
}

/// A linear axis with ticks of one's own.
struct Ticked {
    axis: RangedCoordf64,
    ticks: Vec<f64>,
}

impl Ticked {
    fn new(range: &Range<f64>, ticks: &Ticks) -> Self {
        Self {
            axis: range.clone().into(),
            ticks: ticks.values.clone(),
        }
    }
}

impl Ranged for Ticked {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        self.axis.map(value, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            return Vec::new();
        }
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.axis.range()
    }
}

/// Least room between labels along x.
const BETWEEN: f64 = 4.0;

/// Estimated width of a label.
fn label_width(chars: usize) -> f64 {
    0.55 * TEXT * chars as f64
}
