//! Work-precision diagrams as in SciMLBenchmarks: error as a function of time, on logarithmic axes.

use std::ops::Range;

use super::canvas::{Axes, Axis, Entry, Key, Layout};
use super::range::decades;
use super::style::{Dash, Shape, Stroke, colour};
use super::{FigureError, approach_title};
use compare::Approach;
use compare::cost::{CostRow, Part};

/// Size of a plot, in nominal pixels.
const PLOT: (f64, f64) = (400.0, 340.0);

/// Number of panels side by side.
const COLUMNS: usize = 2;

/// Smaller errors are drawn at this error, because they are only rounding.
const SMALLEST_ERROR: f64 = 1e-15;

/// A point, as logarithms to the base ten of seconds and error.
type Place = (f64, f64);

/// The measurements of one model in one panel.
struct Curve {
    model: String,
    /// Points that are joined by a line, in the order of the varied quantity.
    line: Vec<Place>,
    /// Points that are not joined: the single cases that the line summarises.
    dots: Vec<Place>,
}

/// A panel and its curves.
struct Plot {
    title: String,
    curves: Vec<Curve>,
}

/// The texts of a diagram.
struct Words {
    title: &'static str,
    x_title: &'static str,
    y_title: &'static str,
}

/// Draws the error of the loads as a function of the time of one evaluation, with a panel for each gap. All panels have
/// the same axes.
///
/// # Errors
/// [`FigureError`] if there are no rows of loads with an error.
pub fn loads_work_precision(rows: &[CostRow]) -> Result<String, FigureError> {
    let rows: Vec<&CostRow> = rows.iter().filter(|r| r.part == Part::Loads).collect();
    let mut plots = Vec::new();
    for gap in labels(rows.iter().map(|r| &r.gap_or_case)) {
        let here = || rows.iter().filter(|r| r.gap_or_case == gap);
        let curves = labels(here().map(|r| &r.model))
            .into_iter()
            .map(|model| Curve {
                model: model.to_owned(),
                line: (here().filter(|r| r.model == model))
                    .filter_map(|r| place(r))
                    .collect(),
                dots: Vec::new(),
            });
        plots.push(Plot {
            title: format!("gap ε = {gap}"),
            curves: curves.collect(),
        });
    }
    let words = Words {
        title: "Error of the loads against time",
        x_title: "time of one evaluation (s)",
        y_title: "largest error of a load (relative)",
    };
    draw(&plots, &words)
}

/// Draws the error of the outgoing angles as a function of the time of a trajectory, with a panel for each approach and
/// a dot for each case. A line joins the points of largest error and median time at each tolerance.
///
/// # Errors
/// [`FigureError`] if there are no rows of deflections with an error.
pub fn deflections_work_precision(rows: &[CostRow]) -> Result<String, FigureError> {
    let rows: Vec<&CostRow> = (rows.iter())
        .filter(|r| r.part == Part::Deflection)
        .collect();
    let mut plots = Vec::new();
    for approach in [Approach::HeadOn, Approach::Orthogonal] {
        let name = approach.to_string();
        let here = || rows.iter().filter(|r| r.gap_or_case.starts_with(&name));
        let curves = labels(here().map(|r| &r.model)).into_iter().map(|model| {
            let mine: Vec<&CostRow> = here().filter(|r| r.model == model).copied().collect();
            let mut values: Vec<f64> = mine.iter().map(|r| r.value).collect();
            values.sort_by(|a, b| b.total_cmp(a));
            values.dedup_by(|a, b| a.total_cmp(b).is_eq());
            let at = |value: &f64| {
                let same = |r: &&&CostRow| r.value.total_cmp(value).is_eq();
                worst(mine.iter().filter(same).filter_map(|r| place(r)))
            };
            Curve {
                model: model.to_owned(),
                line: values.iter().filter_map(at).collect(),
                dots: mine.iter().filter_map(|r| place(r)).collect(),
            }
        });
        plots.push(Plot {
            title: approach_title(approach).to_owned(),
            curves: curves.collect(),
        });
    }
    let words = Words {
        title: "Error of the outgoing angle against time (dots: cases; open marks: their worst error, median time)",
        x_title: "time of one trajectory (s)",
        y_title: "largest error (degrees)",
    };
    draw(&plots, &words)
}

/// The distinct texts, in the order of their first occurrence.
fn labels<'a>(all: impl Iterator<Item = &'a String>) -> Vec<&'a str> {
    let mut labels: Vec<&str> = Vec::new();
    for label in all {
        if !labels.contains(&label.as_str()) {
            labels.push(label);
        }
    }
    labels
}

/// The point of a measurement; `None` if it failed.
fn place(row: &CostRow) -> Option<Place> {
    let place = (row.seconds.log10(), row.error.max(SMALLEST_ERROR).log10());
    (row.error.is_finite() && place.0.is_finite()).then_some(place)
}

/// Median time and largest error.
fn worst(places: impl Iterator<Item = Place>) -> Option<Place> {
    let (mut times, errors): (Vec<f64>, Vec<f64>) = places.unzip();
    times.sort_by(f64::total_cmp);
    let error = errors.into_iter().max_by(f64::total_cmp)?;
    times.get(times.len() / 2).map(|time| (*time, error))
}

fn draw(plots: &[Plot], words: &Words) -> Result<String, FigureError> {
    let all = || plots.iter().flat_map(|p| &p.curves);
    let places = || all().flat_map(|c| c.line.iter().chain(&c.dots));
    if places().next().is_none() {
        return Err(FigureError::Empty { what: "no error" });
    }
    let (x, y) = (
        decades(places().map(|p| p.0)),
        decades(places().map(|p| p.1)),
    );
    let models = labels(all().map(|c| &c.model));
    let columns = COLUMNS.min(plots.len());
    let layout = Layout::new(PLOT, columns, plots.len().div_ceil(columns));
    let entry = |(i, model): (usize, &&str)| -> Entry {
        (
            Key::MarkedLine(stroke(i), Shape::of(i)),
            (*model).to_owned(),
        )
    };
    let legend: Vec<Entry> = models.iter().enumerate().map(entry).collect();
    let mut canvas = layout.canvas(words.title, &[legend]);
    for (i, plot) in plots.iter().enumerate() {
        let corner = layout.corner(i % columns, i / columns);
        let index = |curve: &Curve| models.iter().position(|m| *m == curve.model).unwrap_or(0);
        canvas.panel(corner, PLOT, axes(plot, words, (&x, &y)), |panel| {
            for curve in &plot.curves {
                panel.line(&curve.line, stroke(index(curve)));
            }
            for curve in &plot.curves {
                // Markers are open if they may cover other points: those of models without a varied
                // quantity, and those of largest errors.
                let filled = curve.dots.is_empty() && curve.line.len() > 1;
                let index = index(curve);
                for &at in &curve.line {
                    panel.marker(at, colour(index), Shape::of(index), filled);
                }
            }
            for curve in plot.curves.iter().rev() {
                for &at in &curve.dots {
                    panel.dot(at, colour(index(curve)));
                }
            }
        });
    }
    Ok(canvas.finish())
}

fn axes(plot: &Plot, words: &Words, (x, y): (&Range<f64>, &Range<f64>)) -> Axes {
    let ticks = |range: &Range<f64>| ((range.end - range.start).round() as usize + 1).min(12);
    Axes {
        title: plot.title.clone(),
        x: Axis::powers(x, words.x_title, ticks(x)),
        y: Axis::powers(y, words.y_title, ticks(y)),
    }
}

fn stroke(index: usize) -> Stroke {
    Stroke::new(colour(index), 1.5, Dash::of(index / 7))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_failed_is_not_drawn() {
        let mut failed = CostRow::new(Part::Loads, "lt", ("none", f64::NAN), "1");
        let empty = loads_work_precision(&[failed.clone()]);
        assert!(matches!(empty, Err(FigureError::Empty { .. })));
        (failed.error, failed.seconds) = (1e-3, 1e-7);
        assert!(
            loads_work_precision(&[failed])
                .unwrap()
                .contains("gap ε = 1")
        );
    }
}
