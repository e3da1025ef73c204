//! Far apart, the ends of the tables, and the seams between their pieces.

use scene::{FAR_GAP, Gap, Hydrodynamics, LoadSet, Orientation, Pose, Scene, Squirmer};

use super::{Bench, Rows, until};
use crate::model::EXACT_TABLE_FROM;
use crate::{CompareError, Method, Model};

const LOADS: LoadSet = LoadSet::all(2);

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.only(&[Method::Exact, Method::Bem]) {
        let name = model.method().name();
        rows.attempt(name, "seams", |rows| seams(model, rows));
        rows.attempt(name, "reflections", |rows| reflections(model, rows));
    }
    for model in bench.models() {
        rows.attempt(model.method().name(), "far flight", |rows| {
            far_flight(model, rows)
        });
    }
}

fn columns(model: &Model, eps: f64) -> Result<Vec<f64>, CompareError> {
    Ok(model.loads(Gap::new(eps)?, LOADS)?.columns().collect())
}

fn worst(one: &[f64], two: &[f64]) -> f64 {
    let pairs = one.iter().zip(two);
    pairs
        .map(|(a, b)| (a - b).abs() / a.abs().max(1.0))
        .fold(0.0, f64::max)
}

/// Values and slopes on both sides of the seam between near and far pieces, and values where the table
/// ends and the model's closed form begins.
fn seams(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    const STEP: f64 = 1e-3;
    let name = model.method().name();
    let error = model.table().map_or(0.0, |table| table.interpolation_error);
    let beyond = FAR_GAP.next_up();
    rows.add(
        name,
        format!("jump of the loads at the seam, gap {FAR_GAP}"),
        (2.0 * error + 1e-14, "interpolation error of both pieces"),
        worst(&columns(model, FAR_GAP)?, &columns(model, beyond)?),
    );
    // One-sided differences of second order.
    let slopes = |from: f64, h: f64| -> Result<Vec<f64>, CompareError> {
        let [a, b, c] = [
            columns(model, from)?,
            columns(model, from + h)?,
            columns(model, from + 2.0 * h)?,
        ];
        Ok((a.iter().zip(&b).zip(&c))
            .map(|((a, b), c)| (4.0 * b - 3.0 * a - c) / (2.0 * h))
            .collect())
    };
    let bound = 8.0 * error / STEP + STEP * STEP;
    rows.add(
        name,
        "jump of the loads' slopes there",
        (
            bound,
            "interpolation error over the step 1e-3 of one-sided differences, and their h^2",
        ),
        worst(&slopes(FAR_GAP, -STEP)?, &slopes(beyond, STEP)?),
    );
    if model.method() == Method::Exact {
        let at = EXACT_TABLE_FROM;
        let rounding = 4.0 * f64::EPSILON;
        rows.add(
            name,
            format!("jump of the loads at the table's end, gap {at:e}"),
            (
                2.0 * error + rounding + 1e-11,
                "interpolation error, and the range's slack of 1e-12",
            ),
            worst(
                &columns(model, at * (1.0 + 1e-13))?,
                &columns(model, at * (1.0 - 3e-12))?,
            ),
        );
    }
    Ok(())
}

/// Far loads by the method of reflections (Kim & Karrila, chapter 11), with `1/r` the expansion's
/// variable: what is left out is of relative order `1/r^2`, with factors below 5.
fn reflections(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let error = model.table().map_or(0.0, |table| table.interpolation_error);
    for eps in [1e2, 1e4, 1e6] {
        let gap = Gap::new(eps)?;
        let loads = model.loads(gap, LOADS)?;
        let r = gap.distance();
        let leading = [
            (loads.xa.own() - 1.0, 2.25 / (r * r)),
            (loads.xa.other(), -1.5 / r),
            (loads.ya.own() - 1.0, 0.5625 / (r * r)),
            (loads.ya.other(), -0.75 / r),
            (loads.yb.other(), 1.5 / (r * r)),
        ];
        let off = leading
            .iter()
            .map(|(found, known)| (found - known).abs())
            .fold(0.0, f64::max);
        let estimate = model.error_estimate(gap, LOADS)?;
        rows.add(
            name,
            format!("gap {eps:e}: loads off their leading reflections"),
            (
                5.0 / r.powi(3) + 4.0 * (error + estimate) + 1e-14,
                "next reflections, at most 5/r^3; errors that the model states",
            ),
            off,
        );
    }
    Ok(())
}

/// Squirmers 1e6 apart swim straight.
fn far_flight(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let squirmer = Squirmer::with_beta(1.0, 5.0)?;
    let pose = |x: f64, angle: f64| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Angle(angle),
    };
    let start = [pose(-5e5, 0.3), pose(5e5, 2.9)];
    let scene = Scene::new([squirmer; 2], start, None, None)?;
    let run = model.run(&scene, &until(200.0, 1e-10))?;
    let off = [0, 1].map(|k| {
        let p = run.start.orientations[k];
        let straight = run.start.positions()[k] + p * run.end_time;
        (run.end.positions()[k] - straight).norm() + run.deflections()[k].abs()
    });
    // A mesh's lone squirmer swims at a speed that is off by the mesh's error: slip force 4 B over drag 6.
    let estimate = model.error_estimate(Gap::new(1e6)?, LoadSet::planar(2))?;
    let strength: f64 = squirmer.modes().iter().sum();
    let bound = run.end_time * 4.0 * strength / 6.0 * estimate + 1e-9;
    rows.add(
        name,
        "flight 1e6 apart: off a straight line after t = 200",
        (
            bound,
            "stated error of slip force and drag x time; stresslet 1e-12 t and rounding of 5e5",
        ),
        off[0].max(off[1]),
    );
    Ok(())
}
