//! Where lubrication theory can be trusted, over the plane of initial directions.

use plotters::style::RGBColor;

use super::canvas::{ABOVE, Axes, BELOW, Entry, Key, LEFT, RIGHT, TITLE, legend_height, picture};
use super::map::draw;
use super::{FigureError, distinct, number, same};
use crate::Method;
use crate::maps::{TRUST_CLASSES, TrustRow, TrustShares};

/// Side of the map, in nominal pixels.
const SIDE: f64 = 420.0;

/// Colours of the classes: darker is worse, and another outcome is orange.
const COLOURS: [RGBColor; 6] = [
    RGBColor(239, 243, 255),
    RGBColor(158, 202, 225),
    RGBColor(66, 146, 198),
    RGBColor(8, 69, 148),
    RGBColor(190, 190, 190),
    RGBColor(213, 94, 0),
];

/// Draws one map: the rows of a grid, each `Sigma` a line of `Delta`.
///
/// # Errors
/// [`FigureError`] if there are no rows, or they are no square grid.
pub fn trust(rows: &[TrustRow]) -> Result<String, FigureError> {
    let first = (rows.first()).ok_or(FigureError::Empty { what: "no map" })?;
    let method = title_of(&first.method);
    let mut title = format!("{method} against exact, β = {}", number(first.beta));
    if first.g != 0.0 {
        title += &format!(", G = {}", number(first.g));
    }
    if first.dz != 0.0 {
        title += &format!(", δz = {}", number(first.dz));
    }
    let legend = legend();
    let width = LEFT + SIDE + 5.0 * RIGHT;
    let legend_top = TITLE + ABOVE + SIDE + BELOW + 8.0;
    let height = legend_top + legend_height(&legend, width);
    picture((width, height), &title, |canvas| {
        let colours = rows.iter().map(|row| COLOURS[row.class()]);
        let title = "Difference of the deflections".to_owned();
        draw(canvas, (LEFT, TITLE + ABOVE), title, (SIDE, SIDE), colours)?;
        canvas.legend(&legend, legend_top, width)
    })
}

/// Size of a panel of shares.
const PLOT: (f64, f64) = (200.0, 240.0);

/// Share of a bar's place that it fills.
const FILLED: f64 = 0.8;

/// Draws the shares of the classes against the offset out of the plane, a panel for each beta: rows of
/// one method and one bottom-heaviness.
///
/// # Errors
/// [`FigureError::Empty`] if there is but one offset.
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
    let cell = LEFT + PLOT.0 + RIGHT;
    let width = cell * betas.len() as f64;
    let legend = legend();
    let legend_top = TITLE + ABOVE + PLOT.1 + BELOW + 8.0;
    let height = legend_top + legend_height(&legend, width);
    let title = format!(
        "Trust in {} against the offset out of the plane",
        title_of(&rows[0].method).to_lowercase()
    );
    let across = |dz: f64| PLOT.0 * (dz - x.start) / (x.end - x.start);
    picture((width, height), &title, |canvas| {
        for (column, &beta) in betas.iter().enumerate() {
            let corner = (cell * column as f64 + LEFT, TITLE + ABOVE);
            let axes = Axes {
                title: format!("β = {}", number(beta)),
                x: x.clone(),
                y: 0.0..100.0,
                x_title: "offset δz (radii)",
                y_title: "share of incoming angles (%)",
                ticks: (offsets.len().min(6), 6),
            };
            canvas.panel(corner, PLOT, axes)?;
            for row in rows.iter().filter(|row| same(row.beta, beta)) {
                let (left, wide) = (
                    across(row.dz - 0.5 * FILLED * step),
                    across(x.start + FILLED * step),
                );
                let mut base = corner.1 + PLOT.1;
                for (share, colour) in row.in_order().into_iter().zip(COLOURS) {
                    let tall = PLOT.1 * share;
                    base -= tall;
                    canvas.rectangle((corner.0 + left, base), (wide, tall), colour)?;
                }
            }
        }
        canvas.legend(&legend, legend_top, width)
    })
}

fn title_of(method: &str) -> String {
    let known = Method::ALL.into_iter().find(|m| m.name() == method);
    known.map_or(method.to_owned(), |m| m.title().to_owned())
}

/// The classes and their colours.
fn legend() -> Vec<Vec<Entry>> {
    vec![
        (COLOURS.into_iter().zip(TRUST_CLASSES))
            .map(|(colour, class)| (Key::Patch(colour), class.to_owned()))
            .collect(),
    ]
}
