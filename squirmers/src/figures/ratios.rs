//! What unlike radii change: outcomes by a method, outcomes by exact hydrodynamics, and the trust in the method, as stacked shares against
//! the ratio of the radii, with a column of panels for each pair of beta.

use scene::Outcome;

use super::canvas::{Axes, Axis, Entry, Key, LEFT, Layout, RIGHT};
use super::map::outcome_fill;
use super::style::Fill;
use super::trust::FILLS;
use super::{FigureError, distinct, number, same};
use compare::study::maps::TRUST_CLASSES;
use compare::study::ratios::RatioRow;

/// Smallest width of a panel, and its height.
const PLOT: (f64, f64) = (250.0, 190.0);

/// Smallest width of a picture, for its title and legend.
const LEAST_WIDTH: f64 = 640.0;

/// Width of a bar as a share of the distance between bars.
const FILLED: f64 = 0.8;

/// Fills of [`RatioRow::OUTCOMES`].
const OUTCOMES: [Fill; 5] = [
    outcome_fill(Some(Outcome::Scattered)),
    outcome_fill(Some(Outcome::Standoff)),
    outcome_fill(Some(Outcome::Pairwise)),
    outcome_fill(Some(Outcome::Anticlockwise)),
    outcome_fill(Some(Outcome::Undecided)),
];

/// A row of panels: its title, and the bar of a row.
type Kind<'a> = (&'a str, fn(&RatioRow) -> Bar);

/// Shares with their fills, from the bottom of a bar to its top.
type Bar = Vec<(f64, Fill)>;

fn bar<const N: usize>(shares: [f64; N], fills: [Fill; N]) -> Bar {
    shares.into_iter().zip(fills).collect()
}

/// Draws the shares of one method.
///
/// # Errors
/// [`FigureError::Empty`] if there are no rows.
pub fn ratios(rows: &[RatioRow]) -> Result<String, FigureError> {
    let first = rows
        .first()
        .ok_or(FigureError::Empty { what: "no shares" })?;
    let values = distinct(rows.iter().map(|row| row.ratio));
    let mut pairs: Vec<[f64; 2]> = Vec::new();
    let of = |row: &RatioRow, pair: &[f64; 2]| same(row.beta1, pair[0]) && same(row.beta2, pair[1]);
    for row in rows {
        if !pairs.iter().any(|pair| of(row, pair)) {
            pairs.push([row.beta1, row.beta2]);
        }
    }
    let share = LEAST_WIDTH / pairs.len() as f64 - LEFT - RIGHT;
    let layout = Layout::new((PLOT.0.max(share), PLOT.1), pairs.len(), 3);
    let method = first.method.title();
    let title = format!("Unlike radii: {} against exact", method.to_lowercase());
    let mut canvas = layout.canvas(&title, &legend(rows));
    let place = |ratio: f64| {
        values
            .iter()
            .position(|value| same(*value, ratio))
            .unwrap_or(0) as f64
    };
    let x = -0.5..values.len() as f64 - 0.5;
    let named: Vec<_> = (values.iter().enumerate())
        .map(|(place, value)| (place as f64, number(*value)))
        .collect();
    let kinds: [Kind<'_>; 3] = [
        (method, |row| bar(row.outcomes(false), OUTCOMES)),
        (compare::Method::Exact.title(), |row| {
            bar(row.outcomes(true), OUTCOMES)
        }),
        ("Difference of the deflections", |row| {
            bar(row.trust(), FILLS)
        }),
    ];
    for (column, pair) in pairs.iter().enumerate() {
        let [beta1, beta2] = pair.map(number);
        let pair_title = if same(pair[0], pair[1]) {
            format!("β = {beta1}")
        } else {
            format!("β = {beta1} and {beta2}")
        };
        for (line, (kind, shares)) in kinds.iter().enumerate() {
            let axes = Axes {
                title: format!("{kind}, {pair_title}"),
                x: Axis::named(
                    &x,
                    "radius of the second over that of the first",
                    named.clone(),
                ),
                y: Axis::new(&(0.0..100.0), "incoming angles (%)", 6),
            };
            canvas.panel(layout.corner(column, line), layout.plot, axes, |panel| {
                for row in rows.iter().filter(|row| of(row, pair)) {
                    let mut base = 0.0;
                    for (share, fill) in shares(row) {
                        let top = base + 100.0 * share;
                        panel.bar((place(row.ratio), FILLED), (base, top), fill);
                        base = top;
                    }
                }
            });
        }
    }
    Ok(canvas.finish())
}

/// What occurs, outcomes above and classes of trust below.
fn legend(rows: &[RatioRow]) -> Vec<Vec<Entry>> {
    let entry = |(fill, name): (Fill, &str)| (Key::Patch(fill), name.to_owned());
    let outcomes = OUTCOMES.into_iter().zip(RatioRow::OUTCOMES).enumerate();
    let outcomes = outcomes.filter(|(k, _)| {
        (rows.iter()).any(|row| row.outcomes(false)[*k] + row.outcomes(true)[*k] > 0.0)
    });
    let classes = FILLS.into_iter().zip(TRUST_CLASSES).enumerate();
    let classes = classes.filter(|(k, _)| rows.iter().any(|row| row.trust()[*k] > 0.0));
    vec![
        outcomes.map(|(_, of)| entry(of)).collect(),
        classes.map(|(_, of)| entry(of)).collect(),
    ]
}
