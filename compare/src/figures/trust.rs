//! Where lubrication theory can be trusted, over the plane of initial directions.

use plotters::style::RGBColor;

use super::canvas::{ABOVE, BELOW, Entry, Key, LEFT, RIGHT, TITLE, legend_height, picture};
use super::map::draw;
use super::{FigureError, number};
use crate::Method;
use crate::maps::{TRUST_CLASSES, TrustRow};

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
    let method = Method::ALL.into_iter().find(|m| m.name() == first.method);
    let method = method.map_or(first.method.clone(), |m| m.title().to_owned());
    let mut title = format!("{method} against exact, β = {}", number(first.beta));
    if first.g != 0.0 {
        title += &format!(", G = {}", number(first.g));
    }
    let legend: Vec<Vec<Entry>> = vec![
        (COLOURS.into_iter().zip(TRUST_CLASSES))
            .map(|(colour, class)| (Key::Patch(colour), class.to_owned()))
            .collect(),
    ];
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
