//! Offsets out of the plane by the motion itself against those by its derivative.

use super::FigureError;
use super::canvas::{Axes, Axis, Entry, Key, Layout};
use super::range::decades;
use super::style::{Dash, INK, Shape, Stroke, colour};
use compare::Method;
use compare::study::sensitivity::SensitivityCase;

/// Size of the plot, in nominal pixels.
const PLOT: (f64, f64) = (440.0, 400.0);

/// Draws the offset at which an outgoing heading turns by 6 degrees, by the motion as a function of that by its derivative, on logarithmic axes. Cases below the
/// diagonal are more sensitive than their derivative says.
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
    let drawn = places().count();
    let legend: Vec<Entry> = (methods.iter())
        .map(|method| {
            let at = method.place();
            let stroke = Stroke::new(colour(at), 0.0, Dash::of(0));
            let key = Key::MarkedLine(stroke, Shape::of(at));
            (key, method.title().to_owned())
        })
        .collect();
    let layout = Layout::new(PLOT, 1, 1);
    let title = "Offset out of the plane that turns an outgoing heading by 6°";
    let mut canvas = layout.canvas(title, &[legend]);
    let ticks =
        |range: &std::ops::Range<f64>| ((range.end - range.start).round() as usize + 1).min(9);
    let axes = Axes {
        title: format!(
            "{drawn} of {} cases, whose offsets are finite; dashed: both alike",
            cases.len()
        ),
        x: Axis::powers(&x, "by the derivative (a)", ticks(&x)),
        y: Axis::powers(&y, "by the motion (a)", ticks(&y)),
    };
    let corner = layout.corner(0, 0);
    let diagonal = [x.start.max(y.start), x.end.min(y.end)].map(|at| (at, at));
    canvas.panel(corner, PLOT, axes, |panel| {
        if diagonal[0].0 < diagonal[1].0 {
            panel.line(&diagonal, Stroke::new(INK, 1.0, Dash::of(1)));
        }
        // Methods that agree cover each other: the first is drawn last, and every second one is open.
        for method in methods.iter().rev() {
            let at = method.place();
            let mine = cases.iter().filter(|case| case.row.method == *method);
            for point in mine.filter_map(place) {
                panel.marker(point, colour(at), Shape::of(at), at % 2 == 0);
            }
        }
    });
    Ok(canvas.finish())
}
