//! Maps over the plane of initial directions (the paper's Figs 2-4): deflections of both
//! squirmers, interaction time and outcome, side by side.

use scene::Outcome;

use super::canvas::{Axes, Axis, Canvas, Entry, Key, Layout, Map, MapCell, whole_side};
use super::heat;
use super::style::{Colour, Fill, Hatch};
use super::{FigureError, number};
use compare::study::maps::ScatterRow;

/// Approximate side of a map, in nominal pixels.
const SIDE: f64 = 270.0;

/// Interaction time at the end of the colour scale, in `a/V_s`.
const LONGEST: f64 = 30.0;

/// Fill of an outcome, with a colour of Okabe and Ito; for `None` the fill of a failed run. Any two fills differ in
/// their hatch or in their lightness.
pub(super) const fn outcome_fill(outcome: Option<Outcome>) -> Fill {
    match outcome {
        Some(Outcome::Scattered) => Fill::new(Colour(240, 240, 240), Hatch::Plain),
        Some(Outcome::Standoff) => Fill::new(Colour(240, 228, 66), Hatch::Crossed),
        Some(Outcome::Pairwise) => Fill::new(Colour(213, 94, 0), Hatch::Plain),
        Some(Outcome::Anticlockwise) => Fill::new(Colour(0, 114, 178), Hatch::Rising),
        Some(Outcome::Clockwise) => Fill::new(Colour(86, 180, 233), Hatch::Falling),
        Some(Outcome::Undecided) => Fill::new(Colour(0, 0, 0), Hatch::Crossed),
        Some(Outcome::Upward) => Fill::new(Colour(190, 190, 190), Hatch::Plain),
        Some(Outcome::Oscillating) => Fill::new(Colour(204, 121, 167), Hatch::Rising),
        Some(Outcome::Downward) => Fill::new(Colour(0, 158, 115), Hatch::Falling),
        Some(Outcome::Contact) => Fill::new(Colour(120, 70, 20), Hatch::Plain),
        Some(Outcome::Unresolved) => Fill::new(Colour(160, 32, 32), Hatch::Crossed),
        None => Fill::new(Colour(230, 159, 0), Hatch::Crossed),
    }
}

/// Fill of pairs without a number, in the panels of numbers. It is hatched, because the colour scales are not.
const BOUND: Fill = Fill::new(Colour(150, 150, 150), Hatch::Rising);

/// The quantities in the panels of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    Deflection,
    Time,
}

impl Quantity {
    /// Whether pairs with this outcome have the quantity; `None` if the outcome is not known.
    fn belongs_to(self, outcome: Option<Outcome>) -> Option<bool> {
        match outcome {
            Some(Outcome::Scattered) => Some(true),
            // These pairs have parted or are side by side, but gravity has turned them.
            Some(Outcome::Upward) => Some(self == Self::Time),
            Some(Outcome::Undecided | Outcome::Unresolved) | None => None,
            Some(_) => Some(false),
        }
    }

    /// Whether the quantity is known for a pair.
    fn is_known(self, row: &ScatterRow) -> bool {
        let finite = match self {
            Self::Deflection => row.deflection1_deg.is_finite() && row.deflection2_deg.is_finite(),
            Self::Time => row.tau.is_finite(),
        };
        finite && self.belongs_to(row.outcome()) == Some(true)
    }

    /// The point of a pair in a panel, with the colour of its number if it has one.
    fn cell(self, row: &ScatterRow, colour: Colour) -> MapCell {
        let is_data = self.is_known(row);
        let fill = match self.belongs_to(row.outcome()) {
            Some(true) if is_data => Fill::new(colour, Hatch::Plain),
            Some(true) => outcome_fill(None),
            Some(false) => BOUND,
            None => outcome_fill(row.outcome()),
        };
        MapCell { fill, is_data }
    }

    /// Whether the panel has points of pairs without the quantity.
    fn is_hatched(self, rows: &[ScatterRow]) -> bool {
        let lacks = |row: &ScatterRow| self.belongs_to(row.outcome()) == Some(false);
        rows.iter().any(|row| self.is_known(row)) && rows.iter().any(lacks)
    }
}

/// The legend: each outcome that occurs, and the fill of pairs without a number.
fn legend(rows: &[ScatterRow]) -> Vec<Vec<Entry>> {
    let occurs = |outcome: Option<Outcome>| rows.iter().any(|row| row.outcome() == outcome);
    let mut outcomes: Vec<Entry> = (Outcome::ALL.into_iter())
        .filter(|o| occurs(Some(*o)))
        .map(|o| (Key::Patch(outcome_fill(Some(o))), o.to_string()))
        .collect();
    let [deflection, time] = [Quantity::Deflection, Quantity::Time];
    let lost = |row: &ScatterRow| {
        let owed = |q: Quantity| q.belongs_to(row.outcome()) == Some(true) && !q.is_known(row);
        owed(deflection) || owed(time)
    };
    if occurs(None) || rows.iter().any(lost) {
        outcomes.push((Key::Patch(outcome_fill(None)), "failed".to_owned()));
    }
    let mut legend = vec![outcomes];
    if deflection.is_hatched(rows) || time.is_hatched(rows) {
        let text = "not scattered: no deflection; bound: no τ".to_owned();
        legend.push(vec![(Key::Patch(BOUND), text)]);
    }
    legend
}

/// Draws one map from the rows of a grid, with `Delta` varying fastest.
///
/// # Errors
/// [`FigureError`] if there are no rows, or if they are not a square grid.
pub fn scatter(rows: &[ScatterRow]) -> Result<String, FigureError> {
    let first = (rows.first()).ok_or(FigureError::Empty { what: "no map" })?;
    let method = first.method.title();
    let mut title = format!("{method}, β = {}", number(first.beta));
    if first.g != 0.0 {
        title += &format!(", G = {}", number(first.g));
    }
    let side = whole_side(SIDE, rows.len().isqrt());
    // The panels are two by two, because four in a row are wider than a page.
    let layout = Layout {
        right: heat::BAR_ROOM,
        ..Layout::new((side, side), 2, 2)
    };
    let corner = |panel: usize| layout.corner(panel % 2, panel / 2);
    let beside = |panel: usize| (corner(panel).0 + side + 14.0, corner(panel).1);
    let angle = (rows.iter())
        .filter(|row| Quantity::Deflection.is_known(row))
        .flat_map(|row| [row.deflection1_deg.abs(), row.deflection2_deg.abs()])
        .fold(30.0, f64::max);
    let angle = (angle / 30.0).ceil() * 30.0;
    let colour = |deflection: f64| heat::diverging(deflection / angle);
    let mut canvas = layout.canvas(&title, &legend(rows));
    for k in [0, 1] {
        let cells = rows.iter().map(|row| {
            let deflection = [row.deflection1_deg, row.deflection2_deg][k];
            Quantity::Deflection.cell(row, colour(deflection))
        });
        let title = format!("Deflection of squirmer {}", k + 1);
        draw(&mut canvas, corner(k), title, side, cells)?;
        heat::bar(
            &mut canvas,
            beside(k),
            side,
            &(-angle..angle),
            colour,
            "degrees",
        );
    }
    let colour = |tau: f64| heat::sequential(tau / LONGEST);
    let cells = (rows.iter()).map(|row| Quantity::Time.cell(row, colour(row.tau)));
    let title = "Interaction time τ".to_owned();
    draw(&mut canvas, corner(2), title, side, cells)?;
    let title = "a/Vs (top: ≥ 30)";
    heat::bar(&mut canvas, beside(2), side, &(0.0..LONGEST), colour, title);
    let cells = rows.iter().map(|row| MapCell {
        fill: outcome_fill(row.outcome()),
        is_data: true,
    });
    draw(&mut canvas, corner(3), "Outcome".to_owned(), side, cells)?;
    Ok(canvas.finish())
}

/// A square panel over `Delta` and `Sigma` filled with the points of a grid.
pub(super) fn draw(
    canvas: &mut Canvas,
    corner: (f64, f64),
    title: String,
    side: f64,
    cells: impl Iterator<Item = MapCell>,
) -> Result<(), FigureError> {
    let axes = Axes {
        title,
        x: Axis::new(&(0.0..2.0), "difference of incoming angles, Δ (π)", 5),
        y: Axis::new(&(0.0..2.0), "sum of incoming angles, Σ (π)", 5),
    };
    let map = Map::new(&cells.collect::<Vec<_>>())?;
    canvas.panel(corner, (side, side), axes, |panel| panel.map(&map));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::style::lightness;

    #[test]
    fn outcomes_are_told_apart_in_grey_print_by_lightness_or_hatch() {
        let mut fills: Vec<Fill> = Outcome::ALL.map(|o| outcome_fill(Some(o))).to_vec();
        fills.push(outcome_fill(None));
        for (i, a) in fills.iter().enumerate() {
            for b in &fills[..i] {
                let apart = (lightness(a.colour) - lightness(b.colour)).abs();
                assert!(a.hatch != b.hatch || apart >= 10.0, "{a:?} {b:?}: {apart}");
            }
        }
    }

    fn row(outcome: &str, deflection: f64) -> ScatterRow {
        ScatterRow {
            method: compare::Method::Lt,
            beta: 5.0,
            g: 0.0,
            delta: 0.5,
            sigma: 0.5,
            deflection1_deg: deflection,
            deflection2_deg: deflection,
            tau: if outcome == "failed" { f64::NAN } else { 1.0 },
            outcome: outcome.to_owned(),
            min_gap: 0.1,
        }
    }

    #[test]
    fn bound_undecided_and_failed_pairs_are_filled_unlike_any_number() {
        for outcome in ["pairwise", "contact", "undecided", "unresolved", "failed"] {
            for quantity in [Quantity::Deflection, Quantity::Time] {
                let cell = quantity.cell(&row(outcome, 400.0), heat::diverging(1.0));
                assert!(!cell.is_data, "{outcome}");
                let hatched = cell.fill == BOUND || cell.fill.hatch == Hatch::Crossed;
                assert!(hatched, "{outcome}");
            }
        }
        let unknown = row("scattered", f64::NAN);
        let unknown = Quantity::Deflection.cell(&unknown, heat::diverging(f64::NAN));
        assert_eq!(unknown.fill, outcome_fill(None));
    }

    #[test]
    fn pairs_that_gravity_has_righted_have_a_time_and_no_deflection() {
        let upward = row("upward", 3.0);
        assert!(Quantity::Time.is_known(&upward));
        assert!(!Quantity::Deflection.is_known(&upward));
    }

    #[test]
    fn the_legend_names_what_occurs_and_nothing_else() {
        let names = |rows: &[ScatterRow]| -> Vec<String> {
            legend(rows)
                .concat()
                .into_iter()
                .map(|(_, name)| name)
                .collect()
        };
        assert_eq!(names(&[row("scattered", 1.0)]), ["scattered"]);
        assert_eq!(names(&[row("failed", f64::NAN)]), ["failed"]);
        // No panel has a number, so no panel has a hatch instead of one.
        let none = names(&[row("pairwise", 1.0), row("failed", f64::NAN)]);
        assert_eq!(none, ["pairwise", "failed"]);
        let both = names(&[row("pairwise", 1.0), row("scattered", 1.0)]);
        assert_eq!(both[..2], ["scattered", "pairwise"]);
        assert!(both[2].starts_with("not scattered"), "{both:?}");
    }

    #[test]
    fn a_map_without_one_scattered_pair_has_outcomes_and_no_other_data() {
        let svg = scatter(&[const { "failed" }; 4].map(|o| row(o, f64::NAN))).unwrap();
        assert_eq!(svg.matches(">no data<").count(), 3);
        assert_eq!(svg.matches("<image").count(), 1);
        let svg =
            scatter(&["scattered", "pairwise", "pairwise", "failed"].map(|o| row(o, 3.0))).unwrap();
        assert!(!svg.contains("no data"));
        assert_eq!(svg.matches("<image").count(), 4);
    }
}
