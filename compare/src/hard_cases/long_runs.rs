//! Runs to t = 10,000: an orbit, and an oscillating bottom-heavy pair.

use std::f64::consts::PI;

use scene::{
    Hydrodynamics, Orientation, Outcome, Plan, Pose, Repulsion, RunOptions, Scene, Squirmer,
    bound_states,
};

use super::{Bench, Rows, SIZE, stepping_error, until};
use crate::maps::Pair;
use crate::{CompareError, Defaults, Method, Model};

const TIME: f64 = 10_000.0;
const TOLERANCE: f64 = 1e-10;

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    // Who orbits: pushers under lubrication theory, pullers under exact loads.
    for (method, beta) in [(Method::Lt, -5.0), (Method::Exact, 5.0)] {
        for model in bench.only(&[method]) {
            rows.attempt(method.name(), "orbit", |rows| orbit(model, beta, rows));
        }
    }
    for model in bench.only(&[Method::Lt]) {
        rows.attempt(model.method().name(), "oscillation", |rows| {
            oscillation(model, rows)
        });
    }
}

/// A stable orbit, integrated in three dimensions, where no run ends early, and in the plane, where the
/// steady state is known in closed form.
fn orbit(model: &Model, beta: f64, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let squirmer = Squirmer::with_beta(1.0, beta)?;
    let states = bound_states(model as &dyn Hydrodynamics, &squirmer, Repulsion::PAPER)?;
    let Some(state) = states
        .iter()
        .find(|s| s.outcome == Outcome::Anticlockwise && s.growth() < -1e-3)
    else {
        rows.add(name, "stable orbits found", (0.0, "there is one"), f64::NAN);
        return Ok(());
    };
    let half = 0.5 * state.gap.distance();
    let pose = |x: f64, angle: f64| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Angle(angle),
    };
    let start = [
        pose(-half, state.angles[0]),
        pose(half, PI + state.angles[1]),
    ];
    let scene = Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), None)?;
    let plan = Plan::new(&scene)?.without_symmetry();
    let options = until(TIME, TOLERANCE);
    let planar = model.run_observed(&plan, &options, &mut |_| {})?;
    let spatial = model.run_observed(&plan.in_three_dimensions(), &options, &mut |_| {})?;
    let why = "steps x tolerance x (1 + |y|), and the fixed point's 1e-11 a time";
    let bound = stepping_error(&spatial, TOLERANCE) + 1e-11 * TIME;
    let held = at_rest(&spatial, state.growth());
    let turns = planar.end.line_angle / (2.0 * PI);
    let of = |what: &str| format!("orbit, beta {beta}, {turns:.0} turns: {what}");
    rows.add(
        name,
        of("angle of the line, integrated, off the closed form"),
        (bound, why),
        (spatial.end.line_angle - planar.end.line_angle).abs(),
    );
    rows.add(
        name,
        of("|ln| of the gap, integrated, over the fixed point's"),
        (held, HELD),
        (spatial.end.gap.ln() - state.gap.ln()).abs(),
    );
    let closed = spatial.end.midpoint - planar.end.midpoint;
    rows.add(
        name,
        of("midpoint off the closed form"),
        (bound * (1.0 + state.speed / state.turning), why),
        closed.norm(),
    );
    let from = "steps x sqrt(13) tolerance x (1 + |p|), all of it along p";
    rows.add(
        name,
        of("| |p| - 1 | of the integrated orientations and line of centres"),
        (
            spatial.counters.steps as f64 * 13.0_f64.sqrt() * TOLERANCE * 2.0,
            from,
        ),
        spatial.unit_drift,
    );
    let lifted = spatial.end.midpoint.z.abs()
        + spatial.end.line.z.abs()
        + spatial
            .end
            .orientations
            .iter()
            .map(|p| p.z.abs())
            .sum::<f64>();
    rows.add(
        name,
        of("motion out of the plane"),
        (0.0, "every term of it is a product with zero"),
        lifted,
    );
    let apart = spatial.end.orientations[0].dot(&spatial.end.orientations[1])
        - planar.end.orientations[0].dot(&planar.end.orientations[1]);
    rows.add(
        name,
        of("cosine between the two off the closed form"),
        (2.0 * held, "two angles, as the gap"),
        apart.abs(),
    );
    Ok(())
}

const HELD: &str = "sqrt(13) tolerance x (1 + |y|) a step: at the limit of stability / 0.54, and over the slowest decay";

/// How far steps keep a spatial state from the fixed point that it is drawn to at the rate `growth < 0`. The
/// error norm, a mean over the 13 variables, allows one of them `sqrt(13) tolerance (1 + |y|)` in each step.
/// What is left of earlier steps' errors adds up over the time of the slowest decay; where the fastest rate
/// holds the steps at the limit of stability, a deviation is estimated at 0.54 of itself or more, as for
/// [`TREMOR`].
fn at_rest(run: &scene::Run, growth: f64) -> f64 {
    let step = TIME / run.counters.steps as f64;
    13.0_f64.sqrt() * TOLERANCE * SIZE * (1.0 / 0.54 + 1.0 / (step * growth.abs()))
}

/// The pair of Fig. 8(c), whose oscillation dies out within some hundred time units: what is left is a rest
/// that must last.
fn oscillation(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let panels = Defaults::paper()?.bottom_heavy;
    let Some(panel) = panels.iter().find(|panel| panel.panel == "c") else {
        rows.add(
            name,
            "panels (c) of Fig. 8 found",
            (0.0, "there is one"),
            f64::NAN,
        );
        return Ok(());
    };
    let pair = Pair {
        beta: panel.beta,
        g: panel.g,
        dz: 0.0,
    };
    let plan = Plan::new(&pair.scene(panel.delta, panel.sigma)?)?.without_symmetry();
    let options = RunOptions {
        sample_interval: Some(0.1),
        ..until(TIME, TOLERANCE)
    };
    let (mut minima, mut least, mut most) = (0, f64::INFINITY, f64::NEG_INFINITY);
    let mut last = [f64::INFINITY; 2];
    let mut crooked = 0.0_f64;
    model.run_observed(&plan, &options, &mut |sample| {
        let c = &sample.configuration;
        let ([a, b], now) = (last, c.gap.ln());
        minima += usize::from(sample.t < 50.0 && a > b && now >= b);
        last = [b, now];
        if sample.t >= 0.5 * TIME {
            (least, most) = (least.min(now), most.max(now));
        }
        crooked = crooked
            .max((c.angles[0] + c.angles[1] - PI).abs() + c.line_angle.abs() + c.midpoint.x.abs());
    })?;
    let of = |what: &str| format!("bottom-heavy pair after {minima} swings by t = 50: {what}");
    rows.add(
        name,
        of("departure from mirror symmetry up to t = 10,000"),
        (4.0 * f64::EPSILON, "the last bit of pi"),
        crooked,
    );
    let why = "tolerance x (1 + |ln eps|) x the tremor of steps held by stability";
    rows.add(
        name,
        of("tremor of ln(gap) from t = 5,000 on"),
        (TREMOR * TOLERANCE * (1.0 - least), why),
        most - least,
    );
    Ok(())
}

/// How far a pair at rest may be seen to tremble, over the tolerance of its steps. At rest the error estimate
/// lets steps grow up to the limit of stability, `|R(z)| = 1` at `|z|` = 6 to 6.4, where a deviation is
/// estimated at 0.54 of itself (real `z`) or more and averaged over 6 variables; the dense output between the
/// ends of such steps has up to 48 times the deviation at the ends (`z = 6.4 i`), of either sign.
const TREMOR: f64 = 2.449_5 / 0.54 * 48.0 * 2.0;
