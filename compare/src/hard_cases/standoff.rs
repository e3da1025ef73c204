//! The standoff, `Delta = Sigma = 1`: two squirmers face each other at rest. The equilibrium is unstable, but a pair that
//! is symmetric to the last bit stays in it for ever.

use std::f64::consts::PI;

use scene::{
    BoundState, Orientation, Outcome, Plan, Pose, Repulsion, RunOptions, Scene, Squirmer,
    bound_states,
};

use super::{Bench, Rows, until};
use crate::study::maps::Pair;
use crate::{CompareError, Model};

/// Squirmer parameter of the pairs whose standoff is disturbed.
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
        "the force balance uses sums and differences only, and the sines of the angles are zero",
    );
    rows.add(
        name,
        format!("beta {beta}: tilt at t = 200, motion in the plane"),
        why,
        tilt,
    );
    rows.add(
        name,
        format!("beta {beta}: displacement of the midpoint"),
        why,
        run.end.midpoint.norm(),
    );
    let not = f64::from(u8::from(run.outcome != Outcome::Standoff));
    rows.add(
        name,
        format!("beta {beta}: pairs whose outcome is not standoff"),
        (0.0, "it is at rest"),
        not,
    );
    // In three dimensions: one orientation is exactly the opposite of the other.
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
        format!("beta {beta}: tilt and displacement at t = 200, motion in three dimensions"),
        why,
        off,
    );
    Ok(())
}

/// Two ways to disturb a facing pair: both tilt as mirror images, or as images under half a turn; with the sign of the
/// second one's tilt.
const MODES: [(&str, f64); 2] = [("mirror images", -1.0), ("half a turn", 1.0)];

fn tipped(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let squirmer = Squirmer::with_beta(1.0, BETA)?;
    let states = bound_states(&**model, &squirmer, Repulsion::PAPER)?;
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
            // The Jacobian comes from central differences with steps of 1e-5; third derivatives are up to 10.
            // If each value of ln(tilt) is wrong by E, the slope of the line through them is wrong by at most 3 E
            // divided by its length.
            let error = steps * 3.0_f64.sqrt() * FINEST / FROM;
            let why = "sqrt(3) tolerance/(tilt of 1e-6) in each step; the tilt squared; the Jacobian's differences of 1e-5, squared";
            rows.add(
                name,
                format!("{mode}: growth rate of a tilt of 1e-12, relative difference from the eigenvalue"),
                (3.0 * error / (TO / FROM).ln() + TO * TO + 1e-9, why),
                off,
            );
        }
    }
    let differ = f64::from(u8::from(left != growing));
    rows.add(
        name,
        format!("disturbances that grow ({left}): their number differs from that of growing eigenvalues ({growing})"),
        (0.0, "linearised equations of motion"),
        differ,
    );
    Ok(())
}

/// Tolerance of runs from a disturbed standoff. Between the tilts `FROM` and `TO` growth is linear, and the tilt is far
/// above the tolerance.
const FINEST: f64 = 1e-13;
const FROM: f64 = 1e-6;
const TO: f64 = 1e-4;

/// Rate at which a tilt that starts at 1e-12 grows between `FROM` and `TO`, and the steps up to `TO`; none if it does
/// not grow.
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
    // The plan keeps the symmetry of the start, so that the other kind of disturbance cannot grow from rounding.
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

/// Slope of the straight line through some points by least squares.
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
