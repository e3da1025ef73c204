//! Deflection as a function of the offset of the paths (the paper's Fig. 6c): a curve for each method and beta, and a
//! panel for each squirmer if the deflections of the two differ.

use super::canvas::{Axes, Axis, Entry, Key, Layout, Panel};
use super::range::padded;
use super::style::{Dash, INK, Shape, Stroke, colour};
use super::{FigureError, approach_title, distinct, methods, number, same};
use compare::{Encounter, EncounterRow};

/// Largest difference in degrees of two deflections that are drawn as one.
const SAME_DEFLECTION: f64 = 0.05;

/// Largest deflection in degrees that is drawn as zero.
pub(super) const NOISE: f64 = 1e-5;

struct Dot {
    dx: f64,
    degrees: [f64; 2],
    scattered: bool,
}

struct Curve {
    label: String,
    stroke: Stroke,
    shape: Shape,
    dots: Vec<Dot>,
}

/// Draws the deflections, in degrees, as a function of `dx`. Pairs that did not part have hollow markers off the
/// curves. The range of the y axis follows from the pairs that parted, if there are any; points outside it are not
/// drawn.
///
/// # Errors
/// [`FigureError`] if there are no runs, or runs of more than one approach.
pub fn deflection(encounters: &[Encounter]) -> Result<String, FigureError> {
    let first = (encounters.first())
        .ok_or(FigureError::Empty { what: "no run" })?
        .case
        .approach;
    if let Some(other) = encounters.iter().find(|e| e.case.approach != first) {
        return Err(FigureError::MixedApproaches {
            first,
            other: other.case.approach,
        });
    }
    let curves = curves(encounters);
    let dots = || curves.iter().flat_map(|c| &c.dots);
    let alike = |d: &Dot| (d.degrees[0] - d.degrees[1]).abs() < SAME_DEFLECTION || !d.scattered;
    let squirmers: &[usize] = if dots().all(alike) { &[0] } else { &[0, 1] };
    let none_scattered = !dots().any(|d| d.scattered);
    let shown = dots().filter(|d| d.scattered || none_scattered);
    let y = padded(shown.flat_map(|d| d.degrees).chain([0.0]), 0.08, NOISE);
    let x = padded(dots().map(|d| d.dx), 0.06, 0.0);

    let plot = if squirmers.len() == 1 {
        (560.0, 340.0)
    } else {
        (400.0, 340.0)
    };
    let entry = |c: &Curve| (Key::MarkedLine(c.stroke, c.shape), c.label.clone());
    let mut legend: Vec<Vec<Entry>> = (curves.chunk_by(|a, b| a.shape == b.shape))
        .map(|of_method| of_method.iter().map(entry).collect())
        .collect();
    if dots().any(|d| !d.scattered) {
        let key = Key::Marker(INK, Shape::Circle, false);
        legend.push(vec![(key, "hollow: not scattered".to_owned())]);
    }
    if curves.len() == methods(encounters.iter().map(|e| e.method)).len() {
        legend = vec![legend.concat()];
    }
    let layout = Layout::new(plot, squirmers.len(), 1);
    let title = format!("Deflection, {}", approach_title(first).to_lowercase());
    let mut canvas = layout.canvas(&title, &legend);
    for (column, &k) in squirmers.iter().enumerate() {
        let axes = Axes {
            title: if squirmers.len() == 1 {
                "Both squirmers".to_owned()
            } else {
                format!("Squirmer {}", k + 1)
            },
            x: Axis::new(&x, "offset of the paths, δx (radii a)", 8),
            y: Axis::new(&y, "deflection (degrees)", 8),
        };
        canvas.panel(layout.corner(column, 0), plot, axes, |panel| {
            panel.zero_line();
            for curve in &curves {
                draw(panel, curve, k);
            }
        });
    }
    Ok(canvas.finish())
}

/// One curve for each method, beta and dz.
fn curves(encounters: &[Encounter]) -> Vec<Curve> {
    let methods = methods(encounters.iter().map(|e| e.method));
    let betas = distinct(encounters.iter().map(|e| e.case.beta));
    let heights = distinct(encounters.iter().map(|e| e.case.dz));
    let mut curves = Vec::new();
    for (i, &method) in methods.iter().enumerate() {
        for (j, &beta) in betas.iter().enumerate() {
            for (l, &dz) in heights.iter().enumerate() {
                let mine = |e: &&Encounter| {
                    e.method == method && same(e.case.beta, beta) && same(e.case.dz, dz)
                };
                let mut dots: Vec<Dot> = encounters.iter().filter(mine).filter_map(dot).collect();
                if dots.is_empty() {
                    continue;
                }
                dots.sort_by(|a, b| a.dx.total_cmp(&b.dx));
                let mut label = method.title().to_owned();
                if betas.len() > 1 {
                    label += &format!(", β = {}", number(beta));
                }
                if heights.len() > 1 {
                    label += &format!(", δz = {}", number(dz));
                }
                let hue = j * heights.len() + l;
                let single = betas.len() * heights.len() == 1;
                let colour = colour(if single { i } else { hue });
                let stroke = Stroke::new(colour, 2.0, Dash::of(i));
                curves.push(Curve {
                    label,
                    stroke,
                    shape: Shape::of(i),
                    dots,
                });
            }
        }
    }
    curves
}

/// The point of an encounter; `None` if its run failed.
fn dot(encounter: &Encounter) -> Option<Dot> {
    let row: EncounterRow = encounter.row();
    let degrees = [row.deflection1_deg, row.deflection2_deg];
    degrees.iter().all(|v| v.is_finite()).then_some(Dot {
        dx: row.dx,
        degrees,
        scattered: encounter.scattered(),
    })
}

fn draw(panel: &mut Panel<'_>, curve: &Curve, k: usize) {
    for run in curve.dots.chunk_by(|a, b| a.scattered && b.scattered) {
        let line: Vec<_> = run.iter().map(|d| (d.dx, d.degrees[k])).collect();
        panel.line(&line, curve.stroke);
    }
    for dot in &curve.dots {
        let at = (dot.dx, dot.degrees[k]);
        panel.marker(at, curve.stroke.colour, curve.shape, dot.scattered);
    }
}
