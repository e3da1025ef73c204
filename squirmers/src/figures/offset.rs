//! Change of the outgoing orientation by an offset out of the plane (the paper's Fig. 5b), with a panel for each method
//! and a line for each case.

use super::canvas::{Axes, Axis, Entry, Key, Layout};
use super::deflection::NOISE;
use super::range::padded;
use super::style::{Dash, INK, Shape, Stroke, colour};
use super::{FigureError, methods, number, same};
use compare::{Approach, OffsetRow};

/// Largest difference in degrees of the changes of the two squirmers that are drawn as one.
const SAME_CHANGE: f64 = 0.05;

/// The parameters that identify a line.
struct Line<'a> {
    case: &'a str,
    beta: f64,
    dx: f64,
}

impl Line<'_> {
    fn holds(&self, row: &OffsetRow) -> bool {
        row.case == self.case && same(row.beta, self.beta) && same(row.dx, self.dx)
    }

    fn label(&self) -> String {
        let (beta, dx) = (number(self.beta), number(self.dx));
        format!("{}, β = {beta}, δx = {dx}", self.case)
    }

    fn shape(&self) -> Shape {
        Shape::of(usize::from(self.case != Approach::HeadOn.to_string()))
    }
}

/// Draws the changes of the outgoing orientations, in degrees, as a function of `dz`. NaN is left out.
///
/// # Errors
/// [`FigureError`] if there are no rows.
pub fn offset(rows: &[OffsetRow]) -> Result<String, FigureError> {
    if rows.is_empty() {
        return Err(FigureError::Empty { what: "no offset" });
    }
    let methods = methods(rows.iter().map(|row| row.method));
    let mut lines: Vec<Line<'_>> = Vec::new();
    for row in rows {
        if !lines.iter().any(|line| line.holds(row)) {
            lines.push(Line {
                case: &row.case,
                beta: row.beta,
                dx: row.dx,
            });
        }
    }
    let changes = rows.iter().flat_map(|r| [r.change1_deg, r.change2_deg]);
    let y = padded(changes.chain([0.0]), 0.06, NOISE);
    let x = padded(rows.iter().map(|r| r.dz), 0.04, 0.0);
    let differ = (rows.iter()).any(|r| (r.change1_deg - r.change2_deg).abs() > SAME_CHANGE);

    let entry = |(i, line): (usize, &Line<'_>)| {
        let mut label = line.label();
        let mine = rows.iter().filter(|row| line.holds(row));
        if mine.clone().all(|r| r.change1_deg.is_nan()) {
            label += " (not scattered)";
        }
        let key = Key::MarkedLine(stroke(i, Dash::Solid), line.shape());
        (line.shape(), (key, label))
    };
    let entries: Vec<(Shape, Entry)> = lines.iter().enumerate().map(entry).collect();
    let mut legend: Vec<Vec<Entry>> = (entries.chunk_by(|a, b| a.0 == b.0))
        .map(|of_case| of_case.iter().map(|(_, entry)| entry.clone()).collect())
        .collect();
    if differ {
        let squirmers = [(Dash::Solid, "squirmer 1"), (Dash::Dashed, "squirmer 2")];
        let entry = |(dash, label): (Dash, &str)| {
            let key = Key::Line(Stroke::new(INK, 2.0, dash));
            (key, label.to_owned())
        };
        legend.push(squirmers.map(entry).into());
    }
    let layout = Layout::new((400.0, 340.0), methods.len(), 1);
    let title = "Change of the outgoing orientation by an offset out of the plane";
    let mut canvas = layout.canvas(title, &legend);
    for (column, &method) in methods.iter().enumerate() {
        let axes = Axes {
            title: method.title().to_owned(),
            x: Axis::new(&x, "offset out of the plane, δz (radii a)", 7),
            y: Axis::new(&y, "change of angle (degrees)", 8),
        };
        canvas.panel(layout.corner(column, 0), layout.plot, axes, |panel| {
            for (i, line) in lines.iter().enumerate() {
                let mut mine: Vec<&OffsetRow> = (rows.iter())
                    .filter(|r| r.method == method && line.holds(r))
                    .collect();
                mine.sort_by(|a, b| a.dz.total_cmp(&b.dz));
                let first: Vec<_> = mine.iter().map(|r| (r.dz, r.change1_deg)).collect();
                let second: Vec<_> = mine.iter().map(|r| (r.dz, r.change2_deg)).collect();
                let apart =
                    (mine.iter()).any(|r| (r.change1_deg - r.change2_deg).abs() > SAME_CHANGE);
                let both = [(first, Dash::Solid), (second, Dash::Dashed)];
                for (points, dash) in both.iter().take(if apart { 2 } else { 1 }) {
                    panel.line(points, stroke(i, *dash));
                    for &at in points {
                        panel.marker(at, colour(i), line.shape(), *dash == Dash::Solid);
                    }
                }
            }
        });
    }
    Ok(canvas.finish())
}

fn stroke(index: usize, dash: Dash) -> Stroke {
    Stroke::new(colour(index), 2.0, dash)
}
