//! Offsets out of the plane by the motion itself against those by its derivative.

use std::ops::Range;

use super::FigureError;
use super::canvas::{Axes, Axis, Layout};
use super::range::decades;
use super::style::{Dash, INK, Shape, Stroke, colour};
use compare::Method;
use compare::study::sensitivity::SensitivityCase;

/// Size of a plot, in nominal pixels, and number of plots side by side.
const PLOT: (f64, f64) = (270.0, 250.0);
const COLUMNS: usize = 2;

/// Draws the offset at which an outgoing heading turns by 6 degrees, by the motion as a function of that by its derivative, on logarithmic axes, with a panel for each
/// method. Cases below the diagonal are more sensitive than their derivative says.
///
/// # Errors
/// [`FigureError::Empty`] if there are no cases.
pub fn sensitivity(cases: &[SensitivityCase]) -> Result<String, FigureError> {
    if cases.is_empty() {
        return Err(FigureError::Empty { what: "no cases" });
    }
    let mut methods: Vec<Method> = cases.iter().map(|case| case.row.method).collect();
    methods.sort_unstable();
    methods.dedup();
    let place = |case: &SensitivityCase| {
        let at = (case.row.linear_6deg.log10(), case.row.offset_6deg.log10());
        (at.0.is_finite() && at.1.is_finite()).then_some(at)
    };
    let places = || cases.iter().filter_map(place);
    let (x, y) = (
        decades(places().map(|at| at.0)),
        decades(places().map(|at| at.1)),
    );
    let columns = COLUMNS.min(methods.len());
    let layout = Layout::new(PLOT, columns, methods.len().div_ceil(columns));
    let title = "Offset out of the plane that turns an outgoing heading by 6°";
    let mut canvas = layout.canvas(title, &[]);
    let ticks = |range: &Range<f64>| ((range.end - range.start).round() as usize + 1).min(9);
    let diagonal = [x.start.max(y.start), x.end.min(y.end)].map(|at| (at, at));
    for (i, method) in methods.iter().enumerate() {
        let mine: Vec<&SensitivityCase> = (cases.iter())
            .filter(|case| case.row.method == *method)
            .collect();
        let points: Vec<(f64, f64)> = mine.iter().filter_map(|case| place(case)).collect();
        let axes = Axes {
            title: format!(
                "{method}: {} of {} offsets are finite",
                points.len(),
                mine.len()
            ),
            x: Axis::powers(&x, "by the derivative (a)", ticks(&x)),
            y: Axis::powers(&y, "by the motion (a)", ticks(&y)),
        };
        let corner = layout.corner(i % columns, i / columns);
        canvas.panel(corner, PLOT, axes, |panel| {
            if diagonal[0].0 < diagonal[1].0 {
                panel.line(&diagonal, Stroke::new(INK, 1.0, Dash::of(1)));
            }
            for point in points {
                panel.marker(
                    point,
                    colour(method.place()),
                    Shape::of(method.place()),
                    true,
                );
            }
        });
    }
    Ok(canvas.finish())
}
