//! Share of each outcome as a function of beta (the paper's Fig. 5a) or, with several bottom-heavinesses, share of
//! orbits as a function of the bottom-heaviness (Fig. 8g). One panel for each method.

use super::canvas::{Axes, Axis, Entry, Key, Layout};
use super::range::{extremes, padded};
use super::style::{Dash, Shape, Stroke, colour};
use super::{FigureError, distinct, methods, number, same};
use compare::study::maps::{FateRow, Share};

/// A line: its name and the points.
type Line<'a> = (String, Vec<&'a FateRow>, Share);

/// Draws the share of each outcome; with several bottom-heavinesses, the share of orbits, with a line for each beta.
///
/// # Errors
/// [`FigureError`] if there are no rows.
pub fn fates(rows: &[FateRow]) -> Result<String, FigureError> {
    if rows.is_empty() {
        return Err(FigureError::Empty { what: "no shares" });
    }
    let gravity = distinct(rows.iter().map(|row| row.g)).len() > 1;
    let abscissa: fn(&FateRow) -> f64 = if gravity { |r| r.g } else { |r| r.beta };
    let shown = shown(rows);
    let methods = methods(rows.iter().map(|row| row.method));
    let x = padded(rows.iter().map(abscissa), 0.04, 0.0);
    let orbits = extremes(rows.iter().map(|row| 100.0 * FateRow::orbits(row)));
    // Orbits are usually rare, so their axis is shorter.
    let few = gravity && orbits.is_none_or(|(_, most)| most <= 50.0);
    let y = -2.0..if few { 50.0 } else { 102.0 };
    let layout = Layout::new((400.0, 320.0), methods.len(), 1);
    let label =
        |i: usize, name: String| -> Entry { (Key::MarkedLine(stroke(i), Shape::of(i)), name) };
    let names = lines(rows, gravity, &shown).into_iter().enumerate();
    let legend = [names.map(|(i, (name, ..))| label(i, name)).collect()];
    let title = if gravity {
        "Share of orbiting pairs against bottom-heaviness"
    } else {
        "Share of each outcome over the incoming angles"
    };
    let x_title = if gravity {
        "bottom-heaviness, G"
    } else {
        "squirmer parameter, β"
    };
    let mut canvas = layout.canvas(title, &legend);
    for (column, &method) in methods.iter().enumerate() {
        let mine: Vec<FateRow> = (rows.iter().filter(|r| r.method == method).cloned()).collect();
        let axes = Axes {
            title: method.title().to_owned(),
            x: Axis::new(&x, x_title, 9),
            y: Axis::new(&y, "share of incoming angles (%)", 6),
        };
        canvas.panel(layout.corner(column, 0), layout.plot, axes, |panel| {
            for (i, (_, rows, share)) in lines(&mine, gravity, &shown).into_iter().enumerate() {
                let mut points: Vec<_> = rows
                    .iter()
                    .map(|row| (abscissa(row), 100.0 * share(row)))
                    .collect();
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
                panel.line(&points, stroke(i));
                for at in points {
                    panel.marker(at, colour(i), Shape::of(i), true);
                }
            }
        });
    }
    Ok(canvas.finish())
}

fn lines<'a>(rows: &'a [FateRow], gravity: bool, shown: &[(&str, Share)]) -> Vec<Line<'a>> {
    if gravity {
        let betas = distinct(rows.iter().map(|row| row.beta)).into_iter();
        let of = |beta: f64| {
            rows.iter()
                .filter(move |row| same(row.beta, beta))
                .collect()
        };
        return betas
            .map(|beta| {
                (
                    format!("β = {}", number(beta)),
                    of(beta),
                    FateRow::orbits as _,
                )
            })
            .collect();
    }
    (shown.iter())
        .map(|&(name, share)| (name.to_owned(), rows.iter().collect(), share))
        .collect()
}

/// Outcomes that always have a line. Other outcomes have a line only if they occur.
const ALWAYS: [&str; 5] = [
    "scattered",
    "pairwise",
    "anticlockwise",
    "clockwise",
    "undecided",
];

fn shown(rows: &[FateRow]) -> Vec<(&'static str, Share)> {
    let occurs = |share: Share| rows.iter().any(|row| share(row) > 0.0);
    let (mut shown, others): (Vec<_>, Vec<_>) =
        (FateRow::SHARES.into_iter()).partition(|(name, _)| ALWAYS.contains(name));
    shown.extend(others.into_iter().filter(|(_, share)| occurs(*share)));
    shown
}

/// Place of the anticlockwise orbits among the lines.
const ANTICLOCKWISE: usize = 2;

/// Number of lines with different colours; further lines are dashed.
const COLOURS: usize = 7;

fn stroke(index: usize) -> Stroke {
    // Orbits of both senses are equally frequent; different widths keep both lines visible.
    let width = if index == ANTICLOCKWISE { 6.0 } else { 2.0 };
    Stroke::new(colour(index), width, Dash::of(index / COLOURS))
}
