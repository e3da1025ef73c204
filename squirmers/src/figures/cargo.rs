//! Entrainment: displacement of a passive sphere by a swimmer that passes, against the offset of its path. A column of panels for each
//! method, a line for each ratio of the radii.

use super::canvas::{Axes, Axis, Entry, Key, Layout};
use super::range::padded;
use super::style::{Dash, INK, Shape, Stroke, colour};
use super::{FigureError, distinct, methods, number, same};
use compare::study::cargo::CargoRow;

/// Displacements in radii that are drawn as zero.
const NOISE: f64 = 1e-6;

/// A row of panels: title of the axis, what it shows, and its number.
type Kind = (&'static str, &'static str, fn(&CargoRow) -> f64);

/// Number of lines with different colours; further lines are dashed.
const COLOURS: usize = 7;

/// Draws the displacements of rows of one beta.
///
/// # Errors
/// [`FigureError::Empty`] if there are no rows.
pub fn cargo(rows: &[CargoRow]) -> Result<String, FigureError> {
    let first = rows
        .first()
        .ok_or(FigureError::Empty { what: "no cargo" })?;
    let methods = methods(rows.iter().map(|row| row.method));
    let ratios = distinct(rows.iter().map(|row| row.ratio));
    let x = padded(rows.iter().map(|row| row.b), 0.04, 0.0);
    let kinds: [Kind; 2] = [
        ("displacement along (radii a)", "along the path", |row| {
            row.along
        }),
        (
            "displacement across (radii a)",
            "across, towards the path",
            |row| row.across,
        ),
    ];
    let entry = |(i, ratio): (usize, &f64)| -> Entry {
        let label = format!("λ = {}", number(*ratio));
        (Key::MarkedLine(stroke(i), Shape::of(i)), label)
    };
    let mut legend = vec![ratios.iter().enumerate().map(entry).collect::<Vec<_>>()];
    if rows.iter().any(|row| row.along.is_nan()) {
        let key = Key::Marker(INK, Shape::Circle, false);
        legend.push(vec![(
            key,
            "hollow, on the axis: the pair stays bound".to_owned(),
        )]);
    }
    let layout = Layout::new((340.0, 240.0), methods.len(), kinds.len());
    let title = format!(
        "Displacement of a passive sphere, swimmer with β = {}",
        number(first.beta)
    );
    let mut canvas = layout.canvas(&title, &legend);
    for (line, (y_title, kind, of)) in kinds.into_iter().enumerate() {
        let y = padded(rows.iter().map(of).chain([0.0]), 0.08, NOISE);
        for (column, &method) in methods.iter().enumerate() {
            let axes = Axes {
                title: format!("{}, {kind}", method.title()),
                x: Axis::new(&x, "offset of the path (radii a)", 8),
                y: Axis::new(&y, y_title, 7),
            };
            canvas.panel(layout.corner(column, line), layout.plot, axes, |panel| {
                panel.zero_line();
                for (i, &ratio) in ratios.iter().enumerate() {
                    let mut mine: Vec<&CargoRow> = (rows.iter())
                        .filter(|row| row.method == method && same(row.ratio, ratio))
                        .collect();
                    mine.sort_by(|a, b| a.b.total_cmp(&b.b));
                    for part in mine.chunk_by(|a, b| of(a).is_finite() && of(b).is_finite()) {
                        let points: Vec<_> = part.iter().map(|row| (row.b, of(row))).collect();
                        panel.line(&points, stroke(i));
                    }
                    for row in mine {
                        let at = (row.b, if of(row).is_nan() { 0.0 } else { of(row) });
                        panel.marker(at, colour(i), Shape::of(i), of(row).is_finite());
                    }
                }
            });
        }
    }
    Ok(canvas.finish())
}

fn stroke(index: usize) -> Stroke {
    Stroke::new(colour(index), 2.0, Dash::of(index / COLOURS))
}
