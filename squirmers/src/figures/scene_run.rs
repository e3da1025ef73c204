//! The run of one scene: paths in the plane, and for spatial motion also seen from the side; gap and orientations as
//! functions of time.

use std::ops::Range;

use scene::Scene;

use super::canvas::{ABOVE, Axes, Axis, BELOW, Canvas, Key, LEFT, Panel, RIGHT, TITLE};
use super::range::{decades, extremes, padded, sound, widened};
use super::style::{Dash, Stroke, colour};
use super::{FigureError, number};
use compare::scene_run::SampleRow;

/// Width of a panel, and height of the panels over time.
const PLOT: (f64, f64) = (400.0, 250.0);

/// Largest height and smallest side of a panel of paths. Scales along both axes are equal.
const TALLEST: f64 = 560.0;
const LEAST: f64 = 170.0;

/// Room around the paths, in radii of the squirmer whose path it is.
const ROOM: f64 = 1.5;

/// Smallest gap that is drawn. Pairs at smaller gaps are in contact.
const LEAST_GAP: f64 = 1e-300;

/// Smallest extent of the axis of angles, in degrees.
const LEAST_DEGREES: f64 = 10.0;

/// Largest number of points of a line, which is more than the number of pixels.
const POINTS: usize = 4000;

/// Draws the rows of a run of `scene`. `spatial` adds the view along y.
///
/// # Errors
/// [`FigureError`] if there are no rows.
pub fn scene_run(scene: &Scene, rows: &[SampleRow], spatial: bool) -> Result<String, FigureError> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
        return Err(FigureError::Empty { what: "no samples" });
    };
    let stride = rows.len().div_ceil(POINTS);
    let shown: Vec<SampleRow> = (rows.iter().step_by(stride).copied())
        .chain([*last])
        .collect();
    let views: &[View] = if spatial { &[TOP, SIDE] } else { &[TOP] };
    let radii = [0, 1].map(|k| scene.squirmers[k].radius());
    let windows: Vec<_> = (views.iter())
        .map(|view| window(&shown, view, radii))
        .collect();
    let sizes: Vec<_> = windows.iter().map(size).collect();
    let paths = sizes.iter().map(|size| size.1).fold(0.0, f64::max);
    let cell = LEFT + PLOT.0 + RIGHT;
    let width = 2.0 * cell;
    let time_top = TITLE + ABOVE + paths + BELOW + ABOVE;
    let legend = vec![vec![
        (Key::Line(stroke(0)), label(scene, 0)),
        (Key::Line(stroke(1)), label(scene, 1)),
        (Key::Sphere, "start and end".to_owned()),
    ]];
    let size = (width, time_top + PLOT.1 + BELOW + 8.0);
    let mut canvas = Canvas::new("Two squirmers", size, &legend);
    for (column, (view, (x, y))) in views.iter().zip(&windows).enumerate() {
        let axes = Axes {
            title: view.title.to_owned(),
            x: Axis::new(x, view.x_title, 7),
            y: Axis::new(y, view.y_title, 7),
        };
        // A single view is centred.
        let size = sizes[column];
        let middle = width * (column as f64 + 0.5) / views.len() as f64;
        let left = middle + 0.5 * (LEFT - RIGHT - size.0);
        canvas.panel((left, TITLE + ABOVE), size, axes, |panel| {
            draw_paths(panel, view, (&shown, [first, last]), radii);
        });
    }
    let time = Axis::new(&(0.0..last.t), "time (a/Vs)", 7);
    let gaps: Vec<_> = shown.iter().map(|row| (row.t, decade(row.gap))).collect();
    let gap = decades(gaps.iter().map(|(_, log)| *log));
    let axes = Axes {
        title: "Gap".to_owned(),
        x: time.clone(),
        y: Axis::powers(&gap, "gap ε (radii a)", 6),
    };
    canvas.panel((LEFT, time_top), PLOT, axes, |panel| {
        panel.path(&gaps, stroke(2))
    });
    let angles = [0, 1].map(|k| -> Vec<_> {
        let of = |row: &SampleRow| [row.angle1_deg, row.angle2_deg][k];
        shown.iter().map(|row| (row.t, of(row))).collect()
    });
    let all = angles.iter().flatten().map(|(_, angle)| *angle);
    let angle = widened(&padded(all, 0.08, 0.0), LEAST_DEGREES);
    let axes = Axes {
        title: if spatial {
            "Orientations, projected on the x-y plane".to_owned()
        } else {
            "Orientations".to_owned()
        },
        x: time,
        y: Axis::new(&angle, "angle (degrees)", 6),
    };
    canvas.panel((cell + LEFT, time_top), PLOT, axes, |panel| {
        for (k, angles) in angles.iter().enumerate() {
            panel.path(angles, stroke(k));
        }
    });
    Ok(canvas.finish())
}

/// A direction of view.
struct View {
    title: &'static str,
    x_title: &'static str,
    y_title: &'static str,
    /// The upward coordinate of centres and orientations.
    up: fn(&SampleRow) -> [(f64, f64); 2],
}

const TOP: View = View {
    title: "Paths, seen along z",
    x_title: "x (radii a)",
    y_title: "y (radii a)",
    up: |row| [(row.y1, row.py1), (row.y2, row.py2)],
};

const SIDE: View = View {
    title: "Paths, seen along y",
    x_title: "x (radii a)",
    y_title: "z (radii a)",
    up: |row| [(row.z1, row.pz1), (row.z2, row.pz2)],
};

impl View {
    /// Centre and orientation of the squirmer number `k`.
    fn of(&self, row: &SampleRow, k: usize) -> ((f64, f64), (f64, f64)) {
        let (along, up) = ([(row.x1, row.px1), (row.x2, row.px2)][k], (self.up)(row)[k]);
        ((along.0, up.0), (along.1, up.1))
    }
}

fn stroke(series: usize) -> Stroke {
    let dash = if series == 1 {
        Dash::Dashed
    } else {
        Dash::Solid
    };
    Stroke::new(colour(series), 1.8, dash)
}

fn label(scene: &Scene, k: usize) -> String {
    let modes: Vec<_> = (1..)
        .zip(scene.squirmers[k].modes())
        .map(|(n, b)| format!("B{n} = {}", number(*b)))
        .collect();
    let modes = if modes.is_empty() {
        "passive".to_owned()
    } else {
        modes.join(", ")
    };
    let radius = match scene.squirmers[k].radius() {
        1.0 => String::new(),
        radius => format!(", radius {}", number(radius)),
    };
    format!("squirmer {}: {modes}{radius}", k + 1)
}

/// Logarithm of a gap to the base ten; NaN for NaN.
fn decade(gap: f64) -> f64 {
    if gap.is_nan() {
        f64::NAN
    } else {
        gap.max(LEAST_GAP).log10()
    }
}

/// The window of a view, with the same scale along both axes.
fn window(rows: &[SampleRow], view: &View, radii: [f64; 2]) -> (Range<f64>, Range<f64>) {
    let about = |of: fn((f64, f64)) -> f64| {
        let ends = [0, 1].map(|k| {
            let (low, high) =
                extremes(rows.iter().map(|row| of(view.of(row, k).0))).unwrap_or_default();
            (low - ROOM * radii[k], high + ROOM * radii[k])
        });
        sound(&(ends[0].0.min(ends[1].0)..ends[0].1.max(ends[1].1)))
    };
    let (x, y) = (about(|at| at.0), about(|at| at.1));
    // The window must be neither too narrow nor too flat after scaling.
    let scale = (PLOT.0 / (x.end - x.start)).min(TALLEST / (y.end - y.start));
    (widened(&x, LEAST / scale), widened(&y, LEAST / scale))
}

/// Size of a panel for a window.
fn size((x, y): &(Range<f64>, Range<f64>)) -> (f64, f64) {
    let [width, height] = [x, y].map(|range| range.end - range.start);
    let scale = (PLOT.0 / width).min(TALLEST / height);
    (width * scale, height * scale)
}

fn draw_paths(
    panel: &mut Panel<'_>,
    view: &View,
    (rows, ends): (&[SampleRow], [&SampleRow; 2]),
    radii: [f64; 2],
) {
    for k in [0, 1] {
        for row in ends {
            let (centre, heading) = view.of(row, k);
            panel.sphere(centre, radii[k], heading, colour(k));
        }
        let path: Vec<_> = rows.iter().map(|row| view.of(row, k).0).collect();
        panel.line(&path, stroke(k));
    }
}
