//! Where lubrication theory can be trusted, over the plane of initial directions.

use scene::Outcome;

use super::canvas::{Axes, Axis, Entry, Key, LEFT, Layout, MapCell, RIGHT, whole_side};
use super::map::{draw, outcome_fill};
use super::style::{Colour, Fill, Hatch};
use super::{FigureError, distinct, number, same};
use compare::study::maps::{TRUST_CLASSES, TrustRow, TrustShares};

/// Approximate side of the map, in nominal pixels.
const SIDE: f64 = 420.0;

/// Fills of the classes. Larger differences are darker; classes without a difference of deflections are hatched.
pub(super) const FILLS: [Fill; 7] = [
    Fill::new(Colour(239, 243, 255), Hatch::Plain),
    Fill::new(Colour(158, 202, 225), Hatch::Plain),
    Fill::new(Colour(66, 146, 198), Hatch::Plain),
    Fill::new(Colour(8, 69, 148), Hatch::Plain),
    Fill::new(Colour(190, 190, 190), Hatch::Rising),
    Fill::new(Colour(213, 94, 0), Hatch::Falling),
    outcome_fill(None),
];

/// The fill and name of a point: those of its class, or of pairs that both models leave undecided.
fn entry(row: &TrustRow) -> (Fill, &'static str) {
    let undecided = Outcome::Undecided.to_string();
    if row.outcome_lt == undecided && row.outcome_exact == undecided {
        let fill = outcome_fill(Some(Outcome::Undecided));
        (fill, "both undecided")
    } else {
        (FILLS[row.class()], TRUST_CLASSES[row.class()])
    }
}

/// Draws one map from the rows of a grid, with `Delta` varying fastest.
///
/// # Errors
/// [`FigureError`] if there are no rows, or if they are not a square grid.
pub fn trust(rows: &[TrustRow]) -> Result<String, FigureError> {
    let first = (rows.first()).ok_or(FigureError::Empty { what: "no map" })?;
    let method = first.method.title();
    let mut title = format!("{method} against exact, β = {}", number(first.beta));
    if first.g != 0.0 {
        title += &format!(", G = {}", number(first.g));
    }
    if first.dz != 0.0 {
        title += &format!(", δz = {}", number(first.dz));
    }
    let side = whole_side(SIDE, rows.len().isqrt());
    let entries: Vec<(Fill, &str)> = rows.iter().map(entry).collect();
    let mut occurring: Vec<(Fill, &str)> = FILLS.into_iter().zip(TRUST_CLASSES).collect();
    let undecided = outcome_fill(Some(Outcome::Undecided));
    occurring.extend(entries.iter().find(|(fill, _)| *fill == undecided));
    occurring.retain(|known| entries.contains(known));
    // This is the room right of the map for the longest entry of the legend.
    let layout = Layout {
        right: 4.0 * RIGHT,
        ..Layout::new((side, side), 1, 1)
    };
    let mut canvas = layout.canvas(&title, &legend(occurring));
    let title = "Difference of the deflections".to_owned();
    let cells = entries.iter().map(|(fill, _)| MapCell {
        fill: *fill,
        is_data: true,
    });
    draw(&mut canvas, layout.corner(0, 0), title, side, cells)?;
    Ok(canvas.finish())
}

/// Smallest width of a panel of shares, and its height.
const PLOT: (f64, f64) = (200.0, 240.0);

/// Smallest width of a picture of shares, for its title and legend.
const LEAST_WIDTH: f64 = 560.0;

/// Width of a bar as a share of the distance between bars.
const FILLED: f64 = 0.8;

/// Draws the shares of the classes as a function of the offset out of the plane, with a panel for each beta. The rows
/// must have one method and one bottom-heaviness.
///
/// # Errors
/// [`FigureError::Empty`] if there is only one offset.
pub fn trust_against_offset(rows: &[TrustShares]) -> Result<String, FigureError> {
    let offsets = distinct(rows.iter().map(|row| row.dz));
    let step = (offsets.windows(2).map(|ends| ends[1] - ends[0])).fold(f64::INFINITY, f64::min);
    let (Some(&first), Some(&last)) = (offsets.first(), offsets.last()) else {
        return Err(FigureError::Empty { what: "no offset" });
    };
    if offsets.len() < 2 {
        return Err(FigureError::Empty { what: "one offset" });
    }
    let x = first - 0.5 * step..last + 0.5 * step;
    let betas = distinct(rows.iter().map(|row| row.beta));
    let share = LEAST_WIDTH / betas.len() as f64 - LEFT - RIGHT;
    let layout = Layout::new((PLOT.0.max(share), PLOT.1), betas.len(), 1);
    let occurs = |class: usize| rows.iter().any(|row| row.in_order()[class] > 0.0);
    let classes = FILLS.into_iter().zip(TRUST_CLASSES).enumerate();
    let occurring = classes.filter(|(class, _)| occurs(*class));
    let legend = legend(occurring.map(|(_, entry)| entry));
    let title = format!(
        "Trust in {} against the offset out of the plane",
        rows[0].method.title().to_lowercase()
    );
    let mut canvas = layout.canvas(&title, &legend);
    for (column, &beta) in betas.iter().enumerate() {
        let axes = Axes {
            title: format!("β = {}", number(beta)),
            x: Axis::new(&x, "offset δz (radii)", offsets.len().min(6)),
            y: Axis::new(&(0.0..100.0), "share of incoming angles (%)", 6),
        };
        canvas.panel(layout.corner(column, 0), layout.plot, axes, |panel| {
            for row in rows.iter().filter(|row| same(row.beta, beta)) {
                let mut base = 0.0;
                for (share, fill) in row.in_order().into_iter().zip(FILLS) {
                    let top = base + 100.0 * share;
                    panel.bar((row.dz, FILLED * step), (base, top), fill);
                    base = top;
                }
            }
        });
    }
    Ok(canvas.finish())
}

fn legend(classes: impl IntoIterator<Item = (Fill, &'static str)>) -> Vec<Vec<Entry>> {
    let entry = |(fill, class): (Fill, &str)| (Key::Patch(fill), class.to_owned());
    vec![classes.into_iter().map(entry).collect()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::style::lightness;

    #[test]
    fn classes_are_told_apart_in_grey_print_by_lightness_or_hatch() {
        let undecided = outcome_fill(Some(Outcome::Undecided));
        let fills: Vec<Fill> = FILLS.into_iter().chain([undecided]).collect();
        for (i, a) in fills.iter().enumerate() {
            for b in &fills[..i] {
                let apart = (lightness(a.colour) - lightness(b.colour)).abs();
                assert!(a.hatch != b.hatch || apart >= 10.0, "{a:?} {b:?}: {apart}");
            }
        }
    }

    fn row(outcomes: [&str; 2], difference: f64) -> TrustRow {
        let [lt, exact] = outcomes.map(str::to_owned);
        TrustRow {
            beta: 5.0,
            delta: 0.5,
            sigma: 0.5,
            outcome_lt: lt,
            outcome_exact: exact,
            difference1_deg: difference,
            difference2_deg: difference,
            method: compare::Method::Lt,
            g: 0.0,
            dz: 0.0,
        }
    }

    #[test]
    fn two_failures_are_no_agreement_and_the_legend_names_what_occurs() {
        let rows = [
            row(["scattered", "scattered"], 1.0),
            row(["scattered", "pairwise"], 1.0),
            row(["failed", "failed"], f64::NAN),
            row(["undecided", "undecided"], f64::NAN),
        ];
        let svg = trust(&rows).unwrap();
        for named in ["up to 5°", "another outcome", "failed", "both undecided"] {
            assert!(svg.contains(named), "{named}");
        }
        for absent in ["alike, no deflection", "5° to 15°"] {
            assert!(!svg.contains(absent), "{absent}");
        }
    }
}
