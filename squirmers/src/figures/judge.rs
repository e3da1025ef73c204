//! How good judged models are: their errors against the gap, and down to which gap they can be trusted.

use super::canvas::{Axes, Axis, Entry, Key, LEFT, Layout};
use super::range::{decades, extremes};
use super::style::{Dash, Shape, Stroke, colour};
use super::{FigureError, number};
use compare::judge::{ErrorAt, Group, LeaderRow, TRUST};

/// Panels side by side.
const COLUMNS: usize = 2;

/// Powers of ten between which errors are drawn; others are drawn on the edge.
const POWERS: (f64, f64) = (-8.0, 2.0);

/// Most models with an entry of their own in a legend.
const MOST_NAMED: usize = 28;

/// Draws the largest error of each group of numbers against the gap, with a line for each model and a mark at each gap of its own.
///
/// # Errors
/// [`FigureError::Empty`] without errors.
pub fn judged_errors(errors: &[ErrorAt]) -> Result<String, FigureError> {
    let groups: Vec<Group> = (Group::ALL.into_iter())
        .filter(|group| errors.iter().any(|at| at.group == *group))
        .collect();
    if groups.is_empty() {
        return Err(FigureError::Empty { what: "no errors" });
    }
    let mut models: Vec<&str> = Vec::new();
    for at in errors {
        if !models.contains(&at.model.as_str()) {
            models.push(&at.model);
        }
    }
    let gaps = || errors.iter().map(|at| at.gap.log10());
    let x = match extremes(gaps()) {
        Some((low, high)) if high.floor() - low.ceil() >= 1.0 => low - 0.05..high + 0.05,
        _ => decades(gaps()),
    };
    let y = POWERS.0..POWERS.1;
    let layout = Layout::new(
        (360.0, 220.0),
        COLUMNS.min(groups.len()),
        groups.len().div_ceil(COLUMNS),
    );
    let mut canvas = layout.canvas(
        "Largest error against exact hydrodynamics",
        &[legend(&models)],
    );
    for (place, group) in groups.iter().enumerate() {
        let (column, line) = (place % COLUMNS, place / COLUMNS);
        let axes = Axes {
            title: group.title().to_owned(),
            x: Axis::powers(&x, "gap (radii a)", 8),
            y: Axis::powers(&y, "error", 6),
        };
        canvas.panel(layout.corner(column, line), layout.plot, axes, |panel| {
            for (index, model) in models.iter().enumerate() {
                let mine: Vec<&ErrorAt> = errors
                    .iter()
                    .filter(|at| at.model == *model && at.group == *group)
                    .collect();
                let at =
                    |at: &ErrorAt| (at.gap.log10(), at.error.log10().clamp(POWERS.0, POWERS.1));
                let points: Vec<_> = mine.iter().map(|of| at(of)).collect();
                panel.path(
                    &points,
                    Stroke::new(colour(index), 1.8, Dash::of(index / 7)),
                );
                for own in mine.iter().filter(|of| !of.between) {
                    panel.marker(at(own), colour(index), Shape::of(index), false);
                }
            }
        });
    }
    Ok(canvas.finish())
}

fn legend(models: &[&str]) -> Vec<Entry> {
    let entry = |(index, model): (usize, &&str)| -> Entry {
        let stroke = Stroke::new(colour(index), 1.8, Dash::of(index / 7));
        (
            Key::MarkedLine(stroke, Shape::of(index)),
            (*model).to_owned(),
        )
    };
    models
        .iter()
        .enumerate()
        .take(MOST_NAMED)
        .map(entry)
        .collect()
}

/// Height of a line of a model, in pixels, and room for its name.
const LINE: f64 = 22.0;
const NAMES: f64 = 190.0;

/// Draws for each model the gaps down to which it is trusted.
///
/// # Errors
/// [`FigureError::Empty`] without rows.
pub fn trusted_gaps(rows: &[LeaderRow]) -> Result<String, FigureError> {
    if rows.is_empty() {
        return Err(FigureError::Empty { what: "no models" });
    }
    let of_row = |row: &LeaderRow| [row.trusted_1, row.trusted_5, row.trusted_20];
    let trusted = || {
        rows.iter()
            .flat_map(of_row)
            .filter(|gap| gap.is_finite())
            .map(f64::log10)
    };
    let x = decades(trusted().chain([0.005_f64.log10(), 100.0_f64.log10()]));
    let mut layout = Layout::new((520.0, LINE * rows.len() as f64 + 10.0), 1, 1);
    layout.left = NAMES - LEFT;
    let marks: Vec<Entry> = (TRUST.iter().enumerate())
        .map(|(k, bound)| {
            let stroke = Stroke::new(colour(k), 1.8, Dash::Solid);
            (
                Key::MarkedLine(stroke, Shape::of(k)),
                format!("within {} %", number(100.0 * bound)),
            )
        })
        .collect();
    let mut canvas = layout.canvas("Gap down to which a model can be trusted", &[marks]);
    let count = rows.len() as f64;
    let height = |place: usize| count - 1.0 - place as f64;
    let names = rows
        .iter()
        .enumerate()
        .map(|(place, row)| (height(place), row.model.clone()))
        .collect();
    let axes = Axes {
        title: String::new(),
        x: Axis::powers(&x, "gap (radii a)", 9),
        y: Axis::named(&(-0.6..count - 0.4), "", names),
    };
    let corner = layout.corner(0, 0);
    canvas.panel(corner, layout.plot, axes, |panel| {
        for (place, row) in rows.iter().enumerate() {
            for (k, gap) in of_row(row).into_iter().enumerate().rev() {
                // Lines of the three bounds one above the other.
                let y = height(place) + 0.22 - 0.22 * k as f64;
                if gap.is_finite() {
                    let stroke = Stroke::new(colour(k), 1.8, Dash::Solid);
                    panel.path(&[(gap.log10(), y), (x.end, y)], stroke);
                    panel.marker((gap.log10(), y), colour(k), Shape::of(k), true);
                }
            }
        }
    });
    Ok(canvas.finish())
}

/// Draws the score of each model against the time that it takes for one gap. Those that are exact have no place on an axis of powers.
///
/// # Errors
/// [`FigureError::Empty`] if no model has both.
pub fn score_against_time(rows: &[LeaderRow]) -> Result<String, FigureError> {
    let drawn: Vec<(f64, f64, &str)> = (rows.iter())
        .filter(|row| row.seconds.is_finite() && row.score > 0.0)
        .map(|row| (row.seconds.log10(), row.score.log10(), row.model.as_str()))
        .collect();
    if drawn.is_empty() {
        return Err(FigureError::Empty { what: "no times" });
    }
    let (x, y) = (
        decades(drawn.iter().map(|of| of.0)),
        decades(drawn.iter().map(|of| of.1)),
    );
    let layout = Layout::new((520.0, 380.0), 1, 1);
    let entry = |(index, of): (usize, &(f64, f64, &str))| -> Entry {
        (
            Key::Marker(colour(index), Shape::of(index), true),
            of.2.to_owned(),
        )
    };
    let legend: Vec<Entry> = drawn
        .iter()
        .enumerate()
        .take(MOST_NAMED)
        .map(entry)
        .collect();
    let mut canvas = layout.canvas(
        "Largest error at gaps from 0.01 to 2 against time",
        &[legend],
    );
    let ticks =
        |range: &std::ops::Range<f64>| ((range.end - range.start).round() as usize + 1).min(12);
    let axes = Axes {
        title: String::new(),
        x: Axis::powers(&x, "time of one gap (s)", ticks(&x)),
        y: Axis::powers(&y, "largest error of a resistance scalar", ticks(&y)),
    };
    canvas.panel(layout.corner(0, 0), layout.plot, axes, |panel| {
        for (index, (seconds, score, _)) in drawn.iter().enumerate() {
            panel.marker((*seconds, *score), colour(index), Shape::of(index), true);
        }
    });
    Ok(canvas.finish())
}
