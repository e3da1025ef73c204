//! Collision integrals against beta, or against the largest impact parameter where there is one beta. A colour and a marker for each
//! method, a kind of line for each other parameter; a bar over two standard errors to each side.

use super::canvas::{Axes, Axis, Entry, Key, Layout};
use super::range::padded;
use super::style::{Dash, INK, Shape, Stroke, colour};
use super::{FigureError, distinct, methods, number, same};
use compare::study::kinetics::KineticsRow;

/// Size of a panel, and columns of panels.
const PLOT: (f64, f64) = (250.0, 190.0);
const COLUMNS: usize = 2;

/// Errors to each side of a bar.
const ERRORS: f64 = 2.0;

/// Smaller values are drawn as zero.
const NOISE: f64 = 1e-9;

/// A panel: its title, the title of its axis, and a value with its error.
struct Shown {
    title: &'static str,
    unit: &'static str,
    of: fn(&KineticsRow) -> (f64, f64),
}

const PANELS: [Shown; 6] = [
    Shown {
        title: "Rotational diffusivity",
        unit: "D_R/n (a² Vs)",
        of: |row| (row.rotation, row.rotation_error),
    },
    Shown {
        title: "Diffusivity by displacements",
        unit: "D/n (a⁴ Vs)",
        of: |row| (row.displacement, row.displacement_error),
    },
    Shown {
        title: "Change of alignment",
        unit: "change of p1·p2",
        of: |row| (row.alignment, row.alignment_error),
    },
    Shown {
        title: "Growth of polar order",
        unit: "growth rate/n (a² Vs)",
        of: |row| (row.growth, row.growth_error),
    },
    Shown {
        title: "Interaction time",
        unit: "mean tau (a/Vs)",
        of: |row| (row.tau, row.tau_error),
    },
    Shown {
        title: "Pairs that do not part",
        unit: "share (%)",
        of: |row| (100.0 * (1.0 - row.parting), 0.0),
    },
];

/// Draws the coefficients.
///
/// # Errors
/// [`FigureError::Empty`] if there are no rows.
pub fn kinetics(rows: &[KineticsRow]) -> Result<String, FigureError> {
    if rows.is_empty() {
        let what = "no coefficients";
        return Err(FigureError::Empty { what });
    }
    let methods = methods(rows.iter().map(|row| row.method));
    let betas = distinct(rows.iter().map(|row| row.beta));
    let impacts = distinct(rows.iter().map(|row| row.impact));
    let by_impact = betas.len() == 1 && impacts.len() > 1;
    let (along, others): (fn(&KineticsRow) -> f64, &[f64]) = if by_impact {
        (|row| row.impact, &betas)
    } else {
        (|row| row.beta, &impacts)
    };
    let other = |row: &KineticsRow| if by_impact { row.beta } else { row.impact };
    let mut legend: Vec<Vec<Entry>> = vec![
        methods
            .iter()
            .enumerate()
            .map(|(k, method)| {
                let key = Key::MarkedLine(stroke(k, 0), Shape::of(k));
                (key, method.title().to_owned())
            })
            .collect(),
    ];
    if others.len() > 1 {
        let entry = |(k, b): (usize, &f64)| -> Entry {
            let key = Key::Line(Stroke::new(INK, 1.6, Dash::of(k)));
            (key, format!("b up to {} a", number(*b)))
        };
        legend.push(others.iter().enumerate().map(entry).collect());
    }
    let layout = Layout::new(PLOT, COLUMNS, PANELS.len().div_ceil(COLUMNS));
    let title = if by_impact {
        format!("Dilute suspension, β = {}", number(betas[0]))
    } else if others.len() > 1 {
        "Dilute suspension".to_owned()
    } else {
        format!(
            "Dilute suspension, encounters up to b = {} a",
            number(impacts[0])
        )
    };
    let mut canvas = layout.canvas(&title, &legend);
    let x = padded(rows.iter().map(along), 0.05, 0.0);
    let x_title = if by_impact {
        "largest impact parameter (radii a)"
    } else {
        "β"
    };
    for (place, shown) in PANELS.iter().enumerate() {
        let ends = rows.iter().flat_map(|row| {
            let (value, error) = (shown.of)(row);
            let error = if error.is_finite() {
                ERRORS * error
            } else {
                0.0
            };
            [value - error, value + error]
        });
        let axes = Axes {
            title: shown.title.to_owned(),
            x: Axis::new(&x, x_title, 7),
            y: Axis::new(&padded(ends.chain([0.0]), 0.08, NOISE), shown.unit, 6),
        };
        let corner = layout.corner(place % COLUMNS, place / COLUMNS);
        canvas.panel(corner, layout.plot, axes, |panel| {
            panel.zero_line();
            for (k, &method) in methods.iter().enumerate() {
                for (j, &value) in others.iter().enumerate() {
                    let mut mine: Vec<&KineticsRow> = (rows.iter())
                        .filter(|row| row.method == method && same(other(row), value))
                        .collect();
                    mine.sort_by(|a, b| along(a).total_cmp(&along(b)));
                    let points: Vec<_> = (mine.iter())
                        .map(|row| (along(row), (shown.of)(row).0))
                        .collect();
                    panel.line(&points, stroke(k, j));
                    for row in mine {
                        let (value, error) = (shown.of)(row);
                        let x = along(row);
                        let bar = [ERRORS, -ERRORS].map(|side| (x, value + side * error));
                        panel.line(&bar, Stroke::new(colour(k), 1.2, Dash::Solid));
                        panel.marker((x, value), colour(k), Shape::of(k), true);
                    }
                }
            }
        });
    }
    Ok(canvas.finish())
}

fn stroke(method: usize, other: usize) -> Stroke {
    Stroke::new(colour(method), 1.8, Dash::of(other))
}
