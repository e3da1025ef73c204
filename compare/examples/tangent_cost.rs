//! What the linearised motion costs beside a run, in runs: `cargo run --release -p squirmers-compare --example tangent_cost`.
//!
//! The case is at right angles, `beta` 1, `dx` 1, a little off the plane. The shortest of many timings counts, each compared with a run timed just before it.

use std::time::Instant;

use compare::{CompareError, Family, Method, Model, ModelOptions};
use scene::{MAX_MODES, Perturbation, Plan, RunOptions, run_with_tangents};

/// Timings of each number of directions, and calls in one timing.
const TIMINGS: (usize, usize) = (40, 5);

fn main() -> Result<(), CompareError> {
    let Some(family) = Family::named("right-angles") else {
        return Ok(());
    };
    let point = (family.scene(&[("dz", 0.05)])).map_err(CompareError::FamilyPoint)?;
    let directions: Vec<Perturbation> = (0..8).map(direction).collect();
    let options = RunOptions::default();
    for method in [Method::Lt, Method::Exact] {
        let model = Model::set_up(method, &ModelOptions::default())?;
        let plan = Plan::new(&point.scene)?;
        for count in [0, 1, 2, 4, 8] {
            let run = || model.run_observed(&plan, &options, &mut |_| {}).map(drop);
            let some = &directions[..count];
            let with = || run_with_tangents(&point.scene, &*model, &options, some).map(drop);
            let (mut alone, mut beside) = (f64::INFINITY, f64::INFINITY);
            for _ in 0..TIMINGS.0 {
                alone = alone.min(seconds(run)?);
                beside = beside.min(seconds(with)?);
            }
            println!(
                "{method}, {count} directions: {:.1} runs of {:.0} us",
                beside / alone,
                1e6 * alone
            );
        }
    }
    Ok(())
}

/// A displacement of the first squirmer, or a change of one of its modes.
fn direction(number: usize) -> Perturbation {
    let mut direction = Perturbation::NONE;
    match number {
        0..3 => direction.positions[0][number] = 1.0,
        3..6 => direction.orientations[0][number - 3] = 1.0,
        _ => direction.modes[0][(number - 6).min(MAX_MODES)] = 1.0,
    }
    direction
}

fn seconds<E>(of: impl Fn() -> Result<(), E>) -> Result<f64, E> {
    let started = Instant::now();
    for _ in 0..TIMINGS.1 {
        of()?;
    }
    Ok(started.elapsed().as_secs_f64() / TIMINGS.1 as f64)
}
