//! Error of each load against the exact load as a function of the gap, with a panel for each load.

use super::canvas::{Axes, Axis, Entry, Key, Layout};
use super::range::{decades, extremes};
use super::style::{Dash, Stroke, colour};
use super::{FigureError, methods};
use compare::{LoadErrorRow, Method};

/// Panels in a row: the loads of one mode.
const COLUMNS: usize = 6;

/// Powers of ten between which errors are drawn. Smaller errors are drawn on the lower edge.
const POWERS: (f64, f64) = (-7.0, 1.0);

/// Draws the errors of the loads. Methods differ in colour and line style.
///
/// # Errors
/// [`FigureError`] if there are no rows.
pub fn load_errors(rows: &[LoadErrorRow]) -> Result<String, FigureError> {
    let mut names: Vec<&str> = Vec::new();
    for row in rows {
        if !names.contains(&row.name.as_str()) {
            names.push(&row.name);
        }
    }
    if names.is_empty() {
        return Err(FigureError::Empty { what: "no loads" });
    }
    let methods = methods(rows.iter().map(|row| row.method));
    let gaps = || rows.iter().map(|row| row.gap.log10());
    let x = match extremes(gaps()) {
        // The axis has at least two powers of ten, so that it has a scale.
        Some((low, high)) if high.floor() - low.ceil() >= 1.0 => low..high,
        _ => decades(gaps()),
    };

    let y = POWERS.0..POWERS.1;
    let entry = |method: &Method| (Key::Line(stroke(*method)), method.title().to_owned());
    let legend: Vec<Entry> = methods.iter().map(entry).collect();
    let places = places(&names);
    let lines = places.iter().map(|(line, _)| line + 1).max().unwrap_or(1);
    let layout = Layout::new((170.0, 150.0), COLUMNS, lines);
    let mut canvas = layout.canvas("Error of the loads against the exact ones", &[legend]);
    for (&name, &(line, column)) in names.iter().zip(&places) {
        let axes = Axes {
            title: name.to_owned(),
            x: Axis::powers(&x, "gap (radii a)", 4),
            y: Axis::powers(&y, if column == 0 { "error" } else { "" }, 6),
        };
        canvas.panel(layout.corner(column, line), layout.plot, axes, |panel| {
            for &method in &methods {
                let mine = (rows.iter()).filter(|row| row.method == method && row.name == name);
                let points: Vec<_> = mine.map(place).collect();
                panel.path(&points, stroke(method));
            }
        });
    }
    Ok(canvas.finish())
}

/// Coordinates of an error, as logarithms; NaN if the error is not known.
fn place(row: &LoadErrorRow) -> (f64, f64) {
    let error = if row.error.is_nan() {
        f64::NAN
    } else {
        row.error.log10().max(POWERS.0)
    };
    (row.gap.log10(), error)
}

/// Row and column of the panel of each load. The six loads of a mode fill a row.
fn places(names: &[&str]) -> Vec<(usize, usize)> {
    let mut places = Vec::with_capacity(names.len());
    let (mut line, mut column) = (0, 0);
    for name in names {
        if column == COLUMNS || (name.starts_with("XF1") && column > 0) {
            (line, column) = (line + 1, 0);
        }
        places.push((line, column));
        column += 1;
    }
    places
}

fn stroke(method: Method) -> Stroke {
    let index = method.place();
    Stroke::new(colour(index), 2.0, Dash::of(index))
}
