//! The standoff, Delta = Sigma = 1: unstable, and kept for ever by a pair that is symmetric to the last bit.

use std::f64::consts::PI;

use scene::{
    BoundState, Hydrodynamics, Orientation, Outcome, Plan, Pose, Repulsion, RunOptions, Scene,
    Squirmer, bound_states,
};

use super::{Bench, Rows, until};
use crate::maps::Pair;
use crate::{CompareError, Model};

/// Squirmer parameter of the pairs whose standoff is tipped.
const BETA: f64 = 5.0;

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.models() {
        let name = model.method().name();
        for beta in [0.0, BETA] {
            rows.attempt(name, "symmetric", |rows| symmetric(model, beta, rows));
        }
        rows.attempt(name, "tipped", |rows| tipped(model, rows));
    }
}

fn symmetric(model: &Model, beta: f64, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let scene = Pair {
        beta,
        g: 0.0,
        dz: 0.0,
    }
    .scene(1.0, 1.0)?;
    let plan = Plan::new(&scene)?.without_symmetry();
    let run = model.run_observed(&plan, &until(200.0, 1e-8), &mut |_| {})?;
    let [one, two] = run.end.angles_rad;
    let tilt = one.abs() + (two - PI).abs() + run.end.line_angle_rad.abs();
    let why = (
        0.0,
        "the balance uses sums and differences only, and the angles' sines are zero",
    );
    rows.add(
        name,
        format!("beta {beta}: tilt at t = 200, in the plane"),
        why,
        tilt,
    );
    rows.add(
        name,
        format!("beta {beta}: motion of the midpoint"),
        why,
        run.end.midpoint.norm(),
    );
    let not = f64::from(u8::from(run.outcome != Outcome::Standoff));
    rows.add(
        name,
        format!("beta {beta}: outcome other than standoff"),
        (0.0, "it is at rest"),
        not,
    );
    // In three dimensions, with vectors of which one is the other's opposite exactly.
    let mut start = scene.start;
    start[0].orientation = Orientation::Vector([1.0, 0.0, 0.0].into());
    start[1].orientation = Orientation::Vector([-1.0, 0.0, 0.0].into());
    let scene = Scene::new(scene.squirmers, start, scene.repulsion, None)?;
    let plan = Plan::new(&scene)?.in_three_dimensions();
    let run = model.run_observed(&plan, &until(200.0, 1e-8), &mut |_| {})?;
    let [one, two] = run.end.orientations;
    let off = (one + two).norm() + one.y.abs() + one.z.abs() + run.end.midpoint.norm();
    rows.add(
        name,
        format!("beta {beta}: tilt and motion at t = 200, in three dimensions"),
        why,
        off,
    );
    Ok(())
}

/// Two ways to tip a facing pair: as mirror images, and as images under half a turn.
const MODES: [(&str, f64); 2] = [("mirror images", -1.0), ("half a turn", 1.0)];

fn tipped(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let squirmer = Squirmer::with_beta(1.0, BETA)?;
    let states = bound_states(model as &dyn Hydrodynamics, &squirmer, Repulsion::PAPER)?;
    let facing = |s: &&BoundState| {
        s.outcome == Outcome::Standoff && s.angles_rad.iter().all(|a| a.abs() < 1e-3)
    };
    let Some(state) = states.iter().find(facing) else {
        rows.add(name, "standoffs found", (0.0, "there is one"), f64::NAN);
        return Ok(());
    };
    let growing = state.eigenvalues.iter().filter(|e| e.re > 1e-3).count();
    let mut left = 0;
    for (mode, sign) in MODES {
        if let Some((rate, steps)) = growth(model, squirmer, state, sign)? {
            left += 1;
            let off = (state.eigenvalues.iter())
                .map(|e| (rate / e.re - 1.0).abs())
                .fold(f64::INFINITY, f64::min);
            // The Jacobian is by central differences of step 1e-5, with third derivatives up to 10.
            // A line through values of ln(tilt) that are off by E each is off by at most 3 E over its length.
            let error = steps * 3.0_f64.sqrt() * FINEST / FROM;
            let why = "sqrt(3) tolerance over the tilt, 1e-6, in every step; tilt squared; differences of 1e-5 squared";
            rows.add(
                name,
                format!("{mode}: growth rate of 1e-12 off the eigenvalue, relative"),
                (3.0 * error / (TO / FROM).ln() + TO * TO + 1e-9, why),
                off,
            );
        }
    }
    let differ = f64::from(u8::from(left != growing));
    rows.add(
        name,
        format!("ways to leave ({left}) other than growing eigenvalues ({growing})"),
        (0.0, "linearised motion"),
        differ,
    );
    Ok(())
}

/// Tolerance of runs that are tipped, and tilts from which to which growth is linear and far above it.
const FINEST: f64 = 1e-13;
const FROM: f64 = 1e-6;
const TO: f64 = 1e-4;

/// Rate at which a tilt of 1e-12 grows between the two, if it does, and the steps up to the larger.
fn growth(
    model: &Model,
    squirmer: Squirmer,
    state: &BoundState,
    sign: f64,
) -> Result<Option<(f64, f64)>, CompareError> {
    const TILT: f64 = 1e-12;
    let half = 0.5 * state.gap.distance();
    let pose = |x: f64, angle: f64| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Radians(angle),
    };
    let start = [pose(-half, TILT), pose(half, PI + sign * TILT)];
    let scene = Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), None)?;
    // On the state of its symmetry, in which the other way to leave does not exist.
    let plan = Plan::new(&scene)?;
    let options = RunOptions {
        sample_interval: Some(0.01),
        ..until(400.0, FINEST)
    };
    let mut seen: Vec<(f64, f64)> = Vec::new();
    let mut over = false;
    let mut left = options.end_time;
    model.run_observed(&plan, &options, &mut |sample| {
        let c = &sample.configuration;
        let [one, two] = [
            c.angles_rad[0] - c.line_angle_rad,
            c.angles_rad[1] - PI - c.line_angle_rad,
        ];
        let tilt = 0.5 * (one + sign * two).abs();
        if tilt > TO && !over {
            (over, left) = (true, sample.t);
        }
        if !over && tilt > FROM {
            seen.push((sample.t, tilt.ln()));
        }
    })?;
    let run = model.run_observed(&plan, &until(left, FINEST), &mut |_| {})?;
    let steps = run.counters.steps as f64;
    Ok((over && seen.len() > 2).then(|| (slope(&seen), steps)))
}

/// Slope of the straight line closest to some points.
pub(super) fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0, y + p.1));
    let (x, y) = (x / count, y / count);
    let across: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let along: f64 = points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
    across / along
}
