//! Trajectories of encounters (the paper's Figs 6a, b and 7). There is one panel for each method, or methods are rows
//! and values of beta are columns. Each offset has a colour. Spheres are drawn to scale at closest approach.

use std::ops::Range;

use scene::{Configuration, Run};

use super::canvas::{Axes, Axis, Entry, Key, Layout, Panel};
use super::range::{sound, widened};
use super::style::{Colour, Dash, INK, Stroke, colour};
use super::{FigureError, approach_title, distinct, methods, number, same};
use compare::{Encounter, Method};

/// Time between the dots on a trajectory, in `a/V_s`.
pub const TICK_INTERVAL: f64 = 2.0;

/// Room in the window around the centres at closest approach, in radii.
const ROOM: f64 = 5.0;

/// Largest gap at which the spheres are drawn, in radii. At larger gaps the squirmers hardly interact.
const DRAWN_GAP: f64 = 1.0;

/// Smallest ratio of a window's sides; without it, paths far apart would give a narrow strip.
const NARROWEST: f64 = 0.25;

/// Window of a picture if all runs failed, in radii.
const NOWHERE: (Range<f64>, Range<f64>) = (-6.0..6.0, -6.0..6.0);

/// Distance between drawn points of a trajectory, in radii.
const SPACING: f64 = 0.04;

/// Time of the straight flight that is added to a path, in `a/V_s`. It ends outside any window.
const FLIGHT: f64 = 60.0;

/// A pair at some time, seen along z.
#[derive(Clone, Copy)]
struct Point {
    t: f64,
    gap: f64,
    centres: [(f64, f64); 2],
    headings: [(f64, f64); 2],
}

/// The part of a run that is drawn.
struct Track {
    points: Vec<Point>,
    nearest: Point,
}

impl Point {
    fn new(t: f64, configuration: &Configuration) -> Self {
        Self {
            t,
            gap: configuration.gap.eps(),
            centres: configuration.positions().map(|v| (v.x, v.y)),
            headings: configuration.orientations.map(|v| (v.x, v.y)),
        }
    }

    /// The pair after both have flown straight for a time.
    fn flown(&self, time: f64) -> Self {
        let centres = [0, 1].map(|k| {
            let [c, p] = [self.centres[k], self.headings[k]];
            (c.0 + time * p.0, c.1 + time * p.1)
        });
        Self {
            t: self.t + time,
            centres,
            ..*self
        }
    }
}

impl Track {
    fn new(method: Method, scattered: bool, run: &Run) -> Option<Self> {
        let samples = run.samples.iter();
        let mut points: Vec<Point> = samples.map(|s| Point::new(s.t, &s.configuration)).collect();
        let least = points.iter().map(|p| p.gap).fold(f64::INFINITY, f64::min);
        // A bound pair slowly comes closer until the end; the picture shows where it first came close.
        let close = if scattered { least } else { 1.05 * least };
        let nearest = *points.iter().find(|p| p.gap <= close)?;
        let last = *points.last()?;
        if scattered && flies_on(method) {
            points.push(last.flown(FLIGHT));
        }
        Some(Self { points, nearest })
    }

    /// The line of squirmer `k`, with fewer points where they are dense.
    fn line(&self, k: usize) -> Vec<(f64, f64)> {
        let mut line: Vec<(f64, f64)> = Vec::new();
        for (number, point) in self.points.iter().enumerate() {
            let at = point.centres[k];
            let far =
                (line.last()).is_none_or(|last| (at.0 - last.0).hypot(at.1 - last.1) > SPACING);
            if far || number + 1 == self.points.len() {
                line.push(at);
            }
        }
        line
    }

    /// Positions of squirmer `k` at multiples of [`TICK_INTERVAL`].
    fn ticks(&self, k: usize) -> Vec<(f64, f64)> {
        let mut ticks = Vec::new();
        for ends in self.points.windows(2) {
            let [from, to] = [ends[0].t, ends[1].t].map(|t| t / TICK_INTERVAL);
            for tick in from.ceil() as i64..to.ceil() as i64 {
                let share = (tick as f64 - from) / (to - from);
                let [a, b] = [ends[0].centres[k], ends[1].centres[k]];
                ticks.push((a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1)));
            }
        }
        ticks
    }
}

/// Whether pairs that have parted fly exactly straight by this method. By full hydrodynamics they do not, and a run is
/// drawn only to its end.
fn flies_on(method: Method) -> bool {
    matches!(method, Method::Lt | Method::LtCorrected)
}

/// Draws the trajectories of encounters of one approach in the x-y plane, in radii.
///
/// With one beta the methods are side by side (Fig. 6). With several values, methods are rows and values of beta are
/// columns (Fig. 7). All panels show the same window, with the same scale along x and y.
///
/// # Errors
/// [`FigureError`] if there are no runs, if no successful run has samples, or if there is more than one approach.
pub fn trajectories(encounters: &[Encounter]) -> Result<String, FigureError> {
    const EMPTY: FigureError = FigureError::Empty {
        what: "no run with samples",
    };
    let first = encounters.first().ok_or(EMPTY)?.case.approach;
    if let Some(other) = encounters.iter().find(|e| e.case.approach != first) {
        return Err(FigureError::MixedApproaches {
            first,
            other: other.case.approach,
        });
    }
    let tracks: Vec<(&Encounter, Track)> = (encounters.iter())
        .filter_map(|e| {
            let track = Track::new(e.method, e.scattered(), e.run.as_ref().ok()?)?;
            Some((e, track))
        })
        .collect();
    let methods = methods(encounters.iter().map(|e| e.method));
    let betas = distinct(encounters.iter().map(|e| e.case.beta));
    let offsets = distinct(encounters.iter().map(|e| e.case.dx));
    let heights = distinct(encounters.iter().map(|e| e.case.dz));
    let series = |e: &Encounter| {
        let dx = offsets.iter().position(|v| same(*v, e.case.dx));
        let dz = heights.iter().position(|v| same(*v, e.case.dz));
        dx.unwrap_or(0) * heights.len() + dz.unwrap_or(0)
    };
    let failed = encounters.iter().all(|e| e.run.is_err());
    let (x, y) = window(&tracks).or(failed.then_some(NOWHERE)).ok_or(EMPTY)?;

    let (columns, rows) = if betas.len() == 1 {
        (methods.len(), 1)
    } else {
        (betas.len(), methods.len())
    };
    let plot_width = if columns <= 2 { 420.0 } else { 330.0 };
    let plot_height = plot_width * (y.end - y.start) / (x.end - x.start);
    let layout = Layout::new((plot_width, plot_height), columns, rows);
    let mut title = approach_title(first).to_owned();
    if let [beta] = betas[..] {
        title += &format!(", β = {}", number(beta));
    }
    let mut canvas = layout.canvas(&title, &legend(&offsets, &heights));
    for (number_of_method, &method) in methods.iter().enumerate() {
        for (number_of_beta, &beta) in betas.iter().enumerate() {
            let (column, row) = if betas.len() == 1 {
                (number_of_method, 0)
            } else {
                (number_of_beta, number_of_method)
            };
            let axes = Axes {
                title: panel_title(method, beta, row * columns + column, betas.len() > 1),
                x: Axis::new(&x, "x (radii a)", 7),
                y: Axis::new(&y, "y (radii a)", 7),
            };
            let shown = |e: &Encounter| e.method == method && same(e.case.beta, beta);
            let tracks = tracks.iter().filter(|(e, _)| shown(e));
            canvas.panel(layout.corner(column, row), layout.plot, axes, |panel| {
                for (encounter, track) in tracks.clone() {
                    draw_spheres(panel, track, series(encounter));
                }
                for (encounter, track) in tracks {
                    draw_lines(panel, track, series(encounter));
                }
            });
        }
    }
    Ok(canvas.finish())
}

fn panel_title(method: Method, beta: f64, index: usize, with_beta: bool) -> String {
    let letter = char::from(b'a' + (index % 26) as u8);
    let mut title = format!("({letter}) {}", method.title());
    if with_beta {
        title += &format!(", β = {}", number(beta));
    }
    title
}

fn legend(offsets: &[f64], heights: &[f64]) -> Vec<Vec<Entry>> {
    let line = |colour: Colour, dash| Key::Line(Stroke::new(colour, 2.0, dash));
    let mut entries: Vec<Entry> = Vec::new();
    for (i, dx) in offsets.iter().enumerate() {
        for (j, dz) in heights.iter().enumerate() {
            let mut label = format!("δx = {}", number(*dx));
            if heights.len() > 1 {
                label += &format!(", δz = {}", number(*dz));
            }
            let key = line(colour(i * heights.len() + j), Dash::Solid);
            entries.push((key, label));
        }
    }
    let signs = vec![
        (line(INK, Dash::Solid), "squirmer 1".to_owned()),
        (line(INK, Dash::Dashed), "squirmer 2".to_owned()),
        (Key::Dot, format!("every Δt = {}", number(TICK_INTERVAL))),
        (
            Key::Sphere,
            format!("closest approach, if gap ≤ {}", number(DRAWN_GAP)),
        ),
    ];
    vec![entries, signs]
}

/// The window of all panels: all starts and closest approaches, with room around the closest approaches.
fn window(tracks: &[(&Encounter, Track)]) -> Option<(Range<f64>, Range<f64>)> {
    let mut bounds = [(f64::INFINITY, f64::NEG_INFINITY); 2];
    let mut take = |at: (f64, f64), room: f64| {
        for (bound, v) in bounds.iter_mut().zip([at.0, at.1]) {
            *bound = (bound.0.min(v - room), bound.1.max(v + room));
        }
    };
    for (_, track) in tracks {
        for k in [0, 1] {
            take(track.points.first()?.centres[k], 1.0);
            // Paths that are nearly straight need no room beside them.
            let room = if track.nearest.gap <= DRAWN_GAP {
                ROOM
            } else {
                1.0
            };
            take(track.nearest.centres[k], room);
        }
    }
    let [x, y] = bounds.map(|(low, high)| low.floor()..high.ceil());
    let ends = [x.start, x.end, y.start, y.end];
    if !ends.into_iter().all(f64::is_finite) {
        return None;
    }
    let [x, y] = [sound(&x), sound(&y)];
    let least = NARROWEST * (x.end - x.start).max(y.end - y.start);
    Some((widened(&x, least), widened(&y, least)))
}

fn draw_spheres(panel: &mut Panel<'_>, track: &Track, series: usize) {
    let at = &track.nearest;
    if at.gap > DRAWN_GAP {
        return;
    }
    for k in [0, 1] {
        if panel.shows(at.centres[k], 1.0) {
            panel.sphere(at.centres[k], 1.0, at.headings[k], colour(series));
        }
    }
}

fn draw_lines(panel: &mut Panel<'_>, track: &Track, series: usize) {
    for (k, dash) in [(0, Dash::Solid), (1, Dash::Dashed)] {
        panel.line(&track.line(k), Stroke::new(colour(series), 1.8, dash));
        for tick in track.ticks(k) {
            panel.dot(tick, colour(series));
        }
    }
}
