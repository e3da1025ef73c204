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
        (
            10.0 * TOLERANCE * SIZE,
            "tolerance x (1 + |y|), steps contracting by a tenth at least",
        ),
        (spatial.end.gap.ln() - state.gap.ln()).abs(),
    );
    let closed = spatial.end.midpoint - planar.end.midpoint;
    rows.add(
        name,
        of("midpoint off the closed form"),
        (bound * (1.0 + state.speed / state.turning), why),
        closed.norm(),
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
        (20.0 * TOLERANCE * SIZE, "two angles, as the gap"),
        apart.abs(),
    );
    Ok(())
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
    let (mut minima, mut early, mut late, mut end) =
        (0, Extent::default(), Extent::default(), Extent::default());
    let mut last = [f64::INFINITY; 2];
    let mut crooked = 0.0_f64;
    let run = model.run_observed(&plan, &options, &mut |sample| {
        let c = &sample.configuration;
        let ([a, b], now) = (last, c.gap.ln());
        minima += usize::from(sample.t < 50.0 && a > b && now >= b);
        last = [b, now];
        match sample.t {
            t if (20.0..25.0).contains(&t) => early.take(now),
            t if (45.0..50.0).contains(&t) => late.take(now),
            t if t >= 0.5 * TIME => end.take(now),
            _ => {}
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
    // The swings shrink at this rate, and with them what steps are off by.
    let decay = (early.width() / late.width()).ln() / 25.0;
    // At rest the steps are as long as stability allows. An error of the fast variable then stays where the
    // step's estimate of it is the tolerance, and the interpolant between steps, where samples lie, makes it
    // larger: at most by this, for `y' = z y` with `z` from -6.2 to -8 about the stepper's limit of
    // stability, -6.4. The norm of the estimate is a mean over the numbers of the state.
    const INTERPOLATED: f64 = 55.4;
    let size = 1.0 + run.end.gap.ln().abs();
    let between = 2.0 * INTERPOLATED * (plan.state().numbers() as f64).sqrt() * TOLERANCE * size;
    let why = "tolerance x (1 + |y|) x the steps in which the swings, and so what steps are off by, shrink to 1/e, \
               and what the interpolant makes of steps at the limit of stability";
    rows.add(
        name,
        of("change of ln(gap) from t = 5,000 on"),
        (
            stepping_error(&run, TOLERANCE) / (decay * TIME) + between,
            why,
        ),
        end.width(),
    );
    Ok(())
}

/// The numbers from the smallest to the largest seen.
#[derive(Default)]
struct Extent(Option<(f64, f64)>);

impl Extent {
    fn take(&mut self, value: f64) {
        let (least, most) = self.0.unwrap_or((value, value));
        self.0 = Some((least.min(value), most.max(value)));
    }

    fn width(&self) -> f64 {
        self.0.map_or(f64::NAN, |(least, most)| most - least)
    }
}
