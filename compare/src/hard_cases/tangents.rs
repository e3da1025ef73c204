//! Tangents of pairs that part from contact, against differences of runs.

use scene::nalgebra::Vector3;
use scene::{
    Orientation, Outcome, Perturbation, Pose, RunOptions, Scene, SceneError, Squirmer, run,
    run_with_tangents,
};

use super::rows::larger;
use super::{Bench, Rows, stepping_error, until};
use crate::{CompareError, Method, Model};

const TOLERANCE: f64 = 1e-12;

/// Step of the differences, in what a scene is changed by.
const STEP: f64 = 0.02;

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.only(&[Method::LtCorrected, Method::Exact]) {
        rows.attempt(model.method().name(), "contact", |rows| {
            contact(model, rows)
        });
    }
}

/// A pair of unlike squirmers that swims apart from a gap, with headings and modes changed by `h`.
fn scene(eps: f64, h: f64) -> Result<Scene, SceneError> {
    let squirmers = [
        Squirmer::new(&[1.5 + 0.3 * h, 1.5])?,
        Squirmer::new(&[1.5, -3.0 + h])?,
    ];
    let pose = |x: f64, p: [f64; 3]| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Vector(p.into()),
    };
    let start = [
        pose(0.0, [-1.0, 0.3 + h, 0.2]),
        pose(2.0 + eps, [0.8, 0.4, -0.5 * h]),
    ];
    Scene::new(squirmers, start, None, None)
}

fn options() -> RunOptions {
    until(200.0, TOLERANCE)
}

/// Unit orientations at infinity of the scene changed by `h`.
fn headings(model: &Model, eps: f64, h: f64) -> Result<([Vector3<f64>; 2], f64), CompareError> {
    let run = run(&scene(eps, h)?, &**model, &options())?;
    if run.outcome != Outcome::Scattered {
        return Err(CompareError::input("gap", eps, "it does not part"));
    }
    Ok((run.outgoing.orientations, stepping_error(&run, TOLERANCE)))
}

/// A central difference of order 4, and what the errors of the runs make of it.
fn difference(
    model: &Model,
    eps: f64,
    step: f64,
) -> Result<([Vector3<f64>; 2], f64), CompareError> {
    let mut sum = [Vector3::zeros(); 2];
    let mut error = 0.0;
    for (k, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
        let (at, of_run) = headings(model, eps, k * step)?;
        let weight = weight / (12.0 * step);
        for (sum, at) in sum.iter_mut().zip(at) {
            *sum += at * weight;
        }
        error += of_run * weight.abs();
    }
    Ok((sum, error))
}

fn contact(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let mut worst = 0.0_f64;
    for eps in [1e-2, 1e-6, 1e-12] {
        let by_h = Perturbation::along::<SceneError>(|h| scene(eps, h), 1e-3)?;
        let tangents = run_with_tangents(&scene(eps, 0.0)?, &**model, &options(), &[by_h])?;
        let (coarse, _) = difference(model, eps, STEP)?;
        let (fine, stepping) = difference(model, eps, 0.5 * STEP)?;
        let rounding = stepping + stepping_error(&tangents.run, TOLERANCE);
        for k in [0, 1] {
            // Richardson: the finer one has a fifteenth of the difference left.
            let left = (coarse[k] - fine[k]).norm() / 15.0;
            let limit = fine[k] + (fine[k] - coarse[k]) / 15.0;
            let found = tangents.outgoing[0][k];
            worst = larger(worst, (found - limit).norm() / (left + rounding));
        }
    }
    rows.add(
        model.method().name(),
        "pairs that part from gaps of 1e-2, 1e-6 and 1e-12: tangents of the headings at infinity against differences of runs, divided by what is allowed",
        (
            1.0,
            "a fifteenth of what halving the step of differences of order 4 changes, and the errors of the steps of all runs",
        ),
        worst,
    );
    Ok(())
}
