//! Runs to t = 10,000: an orbit, a bottom-heavy pair that comes to rest, and pairs that swing for ever
//! ([`super::oscillation`]).

use std::f64::consts::PI;

use scene::{
    Orientation, Outcome, Plan, Pose, Repulsion, RunOptions, Scene, Squirmer, bound_states,
};

use super::rows::larger;
use super::{Bench, Rows, SIZE, stepping_error, until};
use crate::study::maps::Pair;
use crate::{CompareError, Defaults, Method, Model};

pub(super) const TIME: f64 = 10_000.0;
pub(super) const TOLERANCE: f64 = 1e-10;

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    // Pairs that orbit: pushers by lubrication theory, pullers by exact loads.
    for (method, beta) in [(Method::Lt, -5.0), (Method::Exact, 5.0)] {
        for model in bench.only(&[method]) {
            rows.attempt(method.name(), "orbit", |rows| orbit(model, beta, rows));
        }
    }
    for model in bench.only(&[Method::Lt]) {
        rows.attempt(model.method().name(), "rest", |rows| rest(model, rows));
    }
}

/// A stable orbit. In three dimensions it is integrated to the end. In the plane the run finds the steady state and
/// continues it to the end in closed form.
fn orbit(model: &Model, beta: f64, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let squirmer = Squirmer::with_beta(1.0, beta)?;
    let states = bound_states(&**model, &squirmer, Repulsion::PAPER)?;
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
        orientation: Orientation::Radians(angle),
    };
    let start = [
        pose(-half, state.angles_rad[0]),
        pose(half, PI + state.angles_rad[1]),
    ];
    let scene = Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), None)?;
    let plan = Plan::new(&scene)?.without_symmetry();
    let options = until(TIME, TOLERANCE);
    let planar = model.run_observed(&plan, &options, &mut |_| {})?;
    let spatial = model.run_observed(&plan.in_three_dimensions(), &options, &mut |_| {})?;
    let why = "steps x tolerance x (1 + |y|), plus the error 1e-11 t of the fixed point";
    let bound = stepping_error(&spatial, TOLERANCE) + 1e-11 * TIME;
    let held = at_rest(&spatial, state.growth());
    let turns = planar.end.line_angle_rad / (2.0 * PI);
    let of = |what: &str| format!("orbit, beta {beta}, {turns:.0} turns: {what}");
    rows.add(
        name,
        of("angle of the line of centres: difference from the closed form"),
        (bound, why),
        (spatial.end.line_angle_rad - planar.end.line_angle_rad).abs(),
    );
    rows.add(
        name,
        of("|ln(gap/gap of the fixed point)|"),
        (held, HELD),
        (spatial.end.gap.ln() - state.gap.ln()).abs(),
    );
    let closed = spatial.end.midpoint - planar.end.midpoint;
    rows.add(
        name,
        of("midpoint: distance from the closed form"),
        (bound * (1.0 + state.speed / state.turning_rate_rad), why),
        closed.norm(),
    );
    rows.add(
        name,
        of("largest ||p| - 1| of the orientations and of the direction between the centres"),
        (unit_drift(&spatial), UNIT_DRIFT),
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
        of("displacement out of the plane"),
        (0.0, "every term is a product with zero"),
        lifted,
    );
    let apart = spatial.end.orientations[0].dot(&spatial.end.orientations[1])
        - planar.end.orientations[0].dot(&planar.end.orientations[1]);
    rows.add(
        name,
        of("cosine between the orientations: difference from the closed form"),
        (2.0 * held, "two angles, each with the bound of ln(gap)"),
        apart.abs(),
    );
    Ok(())
}

pub(super) const UNIT_DRIFT: &str =
    "steps x sqrt(13) tolerance x (1 + |p|), if every error is along p";

/// How much the unit vectors of a run in three dimensions may grow or shrink.
pub(super) fn unit_drift(run: &scene::Run) -> f64 {
    run.counters.steps as f64 * 13.0_f64.sqrt() * TOLERANCE * 2.0
}

const HELD: &str = "an error of sqrt(13) tolerance x (1 + |y|) in each step: 2.0103 times that of the last step, plus that of each step within 1/(slowest decay rate)";

/// Largest distance of a state in three dimensions from the fixed point that attracts it at the rate `growth < 0`. The
/// error norm is a mean over the 13 variables, so that one of them may be wrong by `sqrt(13) tolerance (1 + |y|)` in
/// each step. Errors of earlier steps decay at the rate `growth` and add up over that time. The last step leaves
/// [`LEFT`] times its own error at most, also where stability limits the length of the steps.
fn at_rest(run: &scene::Run, growth: f64) -> f64 {
    let step = TIME / run.counters.steps as f64;
    13.0_f64.sqrt() * TOLERANCE * SIZE * (LEFT + 1.0 / (step * growth.abs()))
}

/// Largest deviation from rest that an accepted step may leave, divided by its error estimate. For `y' = λ y` and
/// `z = λ h` the ratio is `|R(z)|` divided by the estimate of DOP853, `E_5²/sqrt(E_5² + 0.01 E_3²)`. Where
/// `|R(z)| < 1` deviations shrink. Over all other `z` with `Re z <= 0` the ratio is largest at infinity, where the
/// leading coefficients give this value. So it is a bound for steps of any length.
const LEFT: f64 = 2.010_3;

/// Number of runs, to different ends, that are compared.
const ENDS: u32 = 8;

/// The pair of Fig. 8(c). Its oscillation dies out within some hundred time units; after that it must stay at rest.
fn rest(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let panels = Defaults::paper()?.bottom_heavy;
    let Some(panel) = panels.iter().find(|panel| panel.panel == "c") else {
        let why = (0.0, "there is one");
        rows.add(name, "panels (c) of Fig. 8 found", why, f64::NAN);
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
    let (mut minima, mut crooked) = (0, 0.0_f64);
    let mut last = [f64::INFINITY; 2];
    let mut swings = Vec::new();
    let run = model.run_observed(&plan, &options, &mut |sample| {
        let c = &sample.configuration;
        let ([a, b], now) = (last, c.gap.ln());
        minima += usize::from(sample.t < 50.0 && a > b && now >= b);
        last = [b, now];
        if (20.0..50.0).contains(&sample.t) {
            swings.push([now, c.angles_rad[0]]);
        }
        let line = c.line_angle_rad.abs() + c.midpoint.x.abs();
        crooked = larger(
            crooked,
            (c.angles_rad[0] + c.angles_rad[1] - PI).abs() + line,
        );
    })?;
    let of = |what: &str| format!("bottom-heavy pair after {minima} swings by t = 50: {what}");
    rows.add(
        name,
        of("deviation from mirror symmetry up to t = 10,000"),
        (4.0 * f64::EPSILON, "rounding of pi"),
        crooked,
    );
    // Only states at the ends of steps count: the dense output of steps this long is not accurate.
    let (mut least, mut most) = (run.end.gap.ln(), run.end.gap.ln());
    for k in 0..ENDS {
        let end = TIME * (1.0 - 0.5 * f64::from(k + 1) / f64::from(ENDS));
        let run = model.run_observed(&plan, &until(end, TOLERANCE), &mut |_| {})?;
        (least, most) = (least.min(run.end.gap.ln()), larger(most, run.end.gap.ln()));
    }
    let size = 1.0 - least;
    let oval = oval(&swings, [run.end.gap.ln(), run.end.angles_rad[0]], size);
    let why = "2 x sqrt(6) tolerance x (1 + |ln eps|) x 2.0103, which an accepted step may leave, x the squared ratio of the axes of its swings";
    rows.add(
        name,
        of("range of ln(gap) from t = 5,000 on"),
        (2.0 * 6.0_f64.sqrt() * TOLERANCE * size * LEFT * oval, why),
        most - least,
    );
    Ok(())
}

/// The state swings to rest on an oval; this is the squared ratio of its axes. The variables are scaled as in the
/// tolerance: `ln eps` by its `size`, and the angles of both squirmers by theirs. Compared with the swing, an error may
/// look larger or smaller by the ratio of the axes, once in the error estimate and once in `ln eps`: hence the square.
fn oval(swings: &[[f64; 2]], rest: [f64; 2], size: f64) -> f64 {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for [ln_gap, angle] in swings {
        let x = (ln_gap - rest[0]) / size;
        let y = 2.0_f64.sqrt() * (angle - rest[1]) / (1.0 + rest[1].abs());
        (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
    }
    let (mean, apart) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
    (mean + apart) / (mean - apart)
}
