//! Maps over the plane of initial directions (the paper's Figs 2-4): deflections of both
//! squirmers, interaction time and outcome, side by side.

use plotters::style::RGBColor;
use scene::Outcome;

use super::canvas::{
    ABOVE, Axes, BELOW, Canvas, Entry, Key, LEFT, RIGHT, TITLE, legend_height, picture,
};
use super::heat::{self, Bar};
use super::{FigureError, number};
use crate::maps::ScatterRow;

/// Side of a map, in nominal pixels.
pub(super) const SIDE: f64 = 270.0;

/// Interaction time, in `a/V_s`, from which on the colour stays the same: pairs that are bound.
const LONGEST: f64 = 30.0;

/// Colour of an outcome, after Okabe and Ito.
pub(super) fn outcome_colour(outcome: Option<Outcome>) -> RGBColor {
    match outcome {
        Some(Outcome::Scattered) => RGBColor(240, 240, 240),
        Some(Outcome::Standoff) => RGBColor(240, 228, 66),
        Some(Outcome::Pairwise) => RGBColor(213, 94, 0),
        Some(Outcome::Anticlockwise) => RGBColor(0, 114, 178),
        Some(Outcome::Clockwise) => RGBColor(86, 180, 233),
        Some(Outcome::Undecided) => RGBColor(0, 0, 0),
        Some(Outcome::Upward) => RGBColor(190, 190, 190),
        Some(Outcome::Oscillating) => RGBColor(204, 121, 167),
        Some(Outcome::Downward) => RGBColor(0, 158, 115),
        Some(Outcome::Contact) => RGBColor(120, 70, 20),
        Some(Outcome::Unresolved) => RGBColor(160, 32, 32),
        None => RGBColor(230, 159, 0),
    }
}

/// Colour, in the panels of deflections, of pairs that did not scatter: on neither side of the scale.
const BOUND: RGBColor = RGBColor(120, 120, 120);

/// Whether a pair scattered, so that it has a deflection.
fn parts(row: &ScatterRow) -> bool {
    row.outcome() == Some(Outcome::Scattered)
}

/// Draws one map: the rows of a grid, each `Sigma` a line of `Delta`.
///
/// # Errors
/// [`FigureError`] if there are no rows, or they are no square grid.
pub fn scatter(rows: &[ScatterRow]) -> Result<String, FigureError> {
    let first = (rows.first()).ok_or(FigureError::Empty { what: "no map" })?;
    let method = first.method().map_or(first.method.as_str(), |m| m.title());
    let mut title = format!("{method}, β = {}", number(first.beta));
    if first.g != 0.0 {
        title += &format!(", G = {}", number(first.g));
    }
    let present = |o: &Outcome| rows.iter().any(|row| row.outcome() == Some(*o));
    let mut legend: Vec<Vec<Entry>> = vec![
        (Outcome::ALL.into_iter().filter(present))
            .map(|o| (Key::Patch(outcome_colour(Some(o))), o.to_string()))
            .collect(),
    ];
    if rows.iter().any(|row| !parts(row)) {
        let text = "no deflection shown: not scattered".to_owned();
        legend.push(vec![(Key::Patch(BOUND), text)]);
    }
    let plot = (SIDE, SIDE);
    let cell = LEFT + SIDE + RIGHT + heat::BAR_ROOM;
    let storey = ABOVE + SIDE + BELOW;
    let width = 2.0 * cell;
    let legend_top = TITLE + 2.0 * storey + 8.0;
    let height = legend_top + legend_height(&legend, width);
    let angle = (rows
        .iter()
        .filter(|row| row.outcome() == Some(Outcome::Scattered)))
    .flat_map(|row| [row.deflection1_deg.abs(), row.deflection2_deg.abs()])
    .fold(30.0, f64::max);
    let angle = (angle / 30.0).ceil() * 30.0;
    picture((width, height), &title, |canvas| {
        // Two by two: four in a row are wider than a page.
        let corner = |panel: usize| {
            let (column, row) = ((panel % 2) as f64, (panel / 2) as f64);
            (cell * column + LEFT, TITLE + ABOVE + storey * row)
        };
        for k in [0, 1] {
            let colours = rows.iter().map(|row| {
                let deflection = [row.deflection1_deg, row.deflection2_deg][k];
                match parts(row) {
                    true => heat::diverging(deflection / angle),
                    false => BOUND,
                }
            });
            let title = format!("Deflection of squirmer {}", k + 1);
            draw(canvas, corner(k), title, plot, colours)?;
            let bar = Bar {
                range: -angle..angle,
                colour: heat::diverging_bar,
                title: "degrees",
            };
            bar.draw(canvas, (corner(k).0 + SIDE + 14.0, corner(k).1), SIDE)?;
        }
        let colours = rows.iter().map(|row| heat::sequential(row.tau / LONGEST));
        draw(
            canvas,
            corner(2),
            "Interaction time τ".to_owned(),
            plot,
            colours,
        )?;
        let bar = Bar {
            range: 0.0..LONGEST,
            colour: heat::sequential,
            title: "a/Vs; the same above",
        };
        bar.draw(canvas, (corner(2).0 + SIDE + 14.0, corner(2).1), SIDE)?;
        let colours = rows.iter().map(|row| outcome_colour(row.outcome()));
        draw(canvas, corner(3), "Outcome".to_owned(), plot, colours)?;
        canvas.legend(&legend, legend_top, width)
    })
}

/// A panel over `Delta` and `Sigma` filled with the colours of a grid.
pub(super) fn draw(
    canvas: &Canvas<'_>,
    corner: (f64, f64),
    title: String,
    plot: (f64, f64),
    colours: impl Iterator<Item = RGBColor>,
) -> Result<(), FigureError> {
    let axes = Axes {
        title,
        x: 0.0..2.0,
        y: 0.0..2.0,
        x_title: "difference of incoming angles, Δ (π)",
        y_title: "sum of incoming angles, Σ (π)",
        ticks: (5, 5),
    };
    canvas.panel(corner, plot, axes)?;
    canvas.image(corner, plot, &colours.collect::<Vec<_>>())
}
