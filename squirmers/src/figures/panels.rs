//! Trajectories of pairs (the paper's Figs 1c, 2c and 8a-f), with a column for each panel and a row for each method.
//! Spheres are drawn to scale at the start; arrows show the orientations.

use std::ops::Range;

use super::canvas::{Anchor, Axes, Axis, Entry, Key, Layout, Panel, TEXT};
use super::range::{extremes, sound, widened};
use super::style::{Colour, Dash, Stroke, colour};
use super::{FigureError, methods, number};
use compare::study::panels::PanelRun;

/// Time between the orientations that are drawn, in `a/V_s`.
pub const ARROW_INTERVAL: f64 = 4.0;

/// Colour of the orientations, which differs from both lines.
const ARROW: Colour = Colour(96, 96, 96);

/// Length of the arrow of an orientation, in nominal pixels.
const ARROW_LENGTH: f64 = 17.0;

/// Room around the trajectories, in radii, for spheres and arrows.
const ROOM: f64 = 1.6;

/// Size of a plot, in nominal pixels.
const PLOT: (f64, f64) = (170.0, 340.0);

/// Room on the left for the names of the methods.
const NAMES: f64 = 26.0;

/// A point of a path and the orientation at this point.
type Pose = ((f64, f64), (f64, f64));

/// The part of a squirmer's path that the panel shows.
fn path(run: &PanelRun, k: usize) -> Vec<(f64, Pose)> {
    (run.shown())
        .map(|s| {
            let (x, p) = (
                s.configuration.positions()[k],
                s.configuration.orientations[k],
            );
            (s.t, ((x.x, x.y), (p.x, p.y)))
        })
        .collect()
}

/// Draws the panels in the x-y plane, in radii. Each has a window of its own, because a pair can stay together by one
/// method and part by another.
///
/// # Errors
/// [`FigureError`] if there are no runs.
pub fn panels(runs: &[PanelRun], title: &str) -> Result<String, FigureError> {
    let methods = methods(runs.iter().map(|run| run.method));
    let mut panels: Vec<&PanelRun> = Vec::new();
    for run in runs {
        if panels.iter().all(|other| other.case != run.case) {
            panels.push(run);
        }
    }
    if panels.is_empty() {
        let what = "no run";
        return Err(FigureError::Empty { what });
    }
    let layout = Layout {
        left: NAMES,
        ..Layout::new(PLOT, panels.len(), methods.len())
    };
    let mut canvas = layout.canvas(title, &legend());
    for (row, &method) in methods.iter().enumerate() {
        let middle = layout.corner(0, row).1 + PLOT.1 / 2.0;
        canvas.text(method.title(), (NAMES / 2.0, middle), TEXT, Anchor::Upright);
        for (column, first) in panels.iter().enumerate() {
            let case = &first.case;
            let of_case = || {
                runs.iter()
                    .filter(|run| run.case == *case && run.run.is_ok())
            };
            let mine = of_case().find(|run| run.method == method);
            let (x, y) = window(mine.or_else(|| of_case().next()));
            let mut title = format!("({}) β = {}", case.panel, number(case.beta));
            if case.g != 0.0 {
                title += &format!(", G = {}", number(case.g));
            }
            let axes = Axes {
                title,
                x: Axis::new(&x, "x (radii a)", 4),
                y: Axis::new(&y, "y (radii a)", 9),
            };
            canvas.panel(layout.corner(column, row), PLOT, axes, |panel| {
                if let Some(run) = mine {
                    draw(panel, run);
                }
            });
        }
    }
    Ok(canvas.finish())
}

fn stroke(k: usize) -> Stroke {
    Stroke::new(colour(k), 1.8, Dash::of(k))
}

fn legend() -> Vec<Vec<Entry>> {
    vec![vec![
        (Key::Line(stroke(0)), "squirmer 1".to_owned()),
        (Key::Line(stroke(1)), "squirmer 2".to_owned()),
        (
            Key::Arrow(ARROW),
            format!("orientation, every Δt = {}", number(ARROW_INTERVAL)),
        ),
        (Key::Sphere, "start, to scale".to_owned()),
    ]]
}

fn draw(panel: &mut Panel<'_>, run: &PanelRun) {
    let paths = [0, 1].map(|k| path(run, k));
    let mut points: Vec<_> = paths.iter().flatten().map(|(_, (at, _))| *at).collect();
    for (_, ((x, y), _)) in paths.iter().filter_map(|path| path.first()) {
        points.extend([(x + 1.0, *y), (x - 1.0, *y), (*x, y + 1.0), (*x, y - 1.0)]);
    }
    if run.case.g != 0.0 {
        panel.gravity(&points);
    }
    for (k, path) in paths.iter().enumerate() {
        if let Some((_, (at, heading))) = path.first() {
            panel.sphere(*at, 1.0, *heading, colour(k));
        }
        let line: Vec<_> = path.iter().map(|(_, (at, _))| *at).collect();
        panel.line(&line, stroke(k));
    }
    for path in &paths {
        let mut next = ARROW_INTERVAL;
        for (t, (at, heading)) in path {
            // Samples lie at multiples of an interval that divides this interval.
            if *t >= next - 1e-9 {
                panel.arrow(*at, *heading, ARROW_LENGTH, ARROW);
                next += ARROW_INTERVAL;
            }
        }
    }
}

/// The window of the trajectories, widened to the shape of the plot; around the origin without trajectories.
fn window(run: Option<&PanelRun>) -> (Range<f64>, Range<f64>) {
    let poses = run.iter().flat_map(|run| [0, 1].map(|k| path(run, k)));
    let centres: Vec<(f64, f64)> = poses.flatten().map(|(_, (at, _))| at).collect();
    let about = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = extremes(values).unwrap_or((0.0, 0.0));
        sound(&(low - ROOM..high + ROOM))
    };
    let x = about(&mut centres.iter().map(|at| at.0));
    let y = about(&mut centres.iter().map(|at| at.1));
    let scale = ((x.end - x.start) / PLOT.0).max((y.end - y.start) / PLOT.1);
    (widened(&x, scale * PLOT.0), widened(&y, scale * PLOT.1))
}
