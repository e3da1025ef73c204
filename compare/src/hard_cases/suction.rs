//! No repulsion: the slip of the squirmers pulls a pair together, down to a gap of 1e-300.
//!
//! Let `L = ln(1/eps)`, and let `c = p.d` be the cosine between each squirmer's orientation and the direction to the
//! other one. Near contact `dL/dt = (4 k/3) S L + constant`, with `S = Σ B_n P_n(c)`. The axial squirming coefficient
//! `k` is 3, so that the slope is `4 S`; the published 9/4 makes it `3 S`.

use std::f64::consts::FRAC_PI_2;

use scene::{Gap, LoadSet, Orientation, Outcome, Pose, Scene, Squirmer};

use super::rows::larger;
use super::{Bench, Rows, SIZE, until};
use crate::{CompareError, Method, Model};

const TOLERANCE: f64 = 1e-8;

/// The gap at which a run ends in contact.
const TOUCHING: f64 = 1e-300;

const METHODS: [Method; 3] = [Method::Lt, Method::LtCorrected, Method::Exact];

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.only(&METHODS) {
        let name = model.method().name();
        for beta in [0.0, 5.0] {
            rows.attempt(name, "facing", |rows| facing(model, beta, rows));
        }
        rows.attempt(name, "side by side", |rows| side_by_side(model, rows));
    }
}

/// Two equal squirmers on the x axis, mirror images of each other; the first one at this angle to the x axis.
fn mirror_pair(eps: f64, beta: f64, angle: f64) -> Result<Scene, CompareError> {
    let squirmer = Squirmer::with_beta(1.0, beta)?;
    let half = 1.0 + 0.5 * eps;
    let pose = |x: f64, angle: f64| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Radians(angle),
    };
    let start = [pose(-half, angle), pose(half, std::f64::consts::PI - angle)];
    Ok(Scene::new([squirmer; 2], start, None, None)?)
}

/// Slope and constant of `dL/dt = slope L + constant` near contact for facing squirmers (`c = 1`). They come from the
/// loads at a tiny gap, without the force balance.
fn suction(model: &Model, squirmer: &Squirmer) -> Result<(f64, f64), CompareError> {
    let gap = Gap::new(1e-12)?;
    let loads = model.loads(gap, LoadSet::all(2))?;
    let published = model.method() == Method::Lt;
    let slope = if published { 3.0 } else { 4.0 };
    let strength: f64 = squirmer.modes().iter().sum();
    let slip: f64 = (squirmer.modes().iter().zip(loads.modes()))
        .map(|(b, mode)| b * mode.xf.difference)
        .sum();
    // dL/dt = F/(3 eps (X11A - X12A)), and 2 eps (X11A - X12A) -> 1.
    let rate = 2.0 / 3.0 * slip;
    Ok((
        slope * strength,
        rate - slope * strength * gap.log_inverse(),
    ))
}

fn facing(model: &Model, beta: f64, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let scene = mirror_pair(1e-8, beta, 0.0)?;
    let (slope, constant) = suction(model, &scene.squirmers[0])?;
    let run = model.run(&scene, &until(200.0, TOLERANCE))?;
    let of = |what: &str| format!("facing, beta {beta}: {what}");
    rows.add(
        name,
        of("outcome other than contact"),
        (0.0, "there is no repulsion"),
        f64::from(u8::from(run.outcome != Outcome::Contact)),
    );
    let (from, to) = (run.start.gap.log_inverse(), -TOUCHING.ln());
    let shift = constant / slope;
    let time = ((to + shift) / (from + shift)).ln() / slope;
    let steps = run.counters.steps as f64;
    let bound = steps * TOLERANCE * 2.0 + 1e-7;
    let why = "steps x tolerance x 2, because errors grow as L does, plus eps L at the start";
    rows.add(
        name,
        of("time to a gap of 1e-300, times the slope of dL/dt: difference from the closed form"),
        (bound, why),
        (run.end_time - time).abs() * slope,
    );
    let why = "an exponential takes one step for each tolerance^(1/8) = 0.1 of its exponent, and 10 steps at the start";
    rows.add(
        name,
        of("steps"),
        (10.0 + (to / from).ln() / 0.1, why),
        steps + run.counters.rejected as f64,
    );
    rows.add(
        name,
        of("|ln(gap/1e-300)| at the end"),
        (
            TOLERANCE * 700.0,
            "contact is located to the tolerance times |ln eps|",
        ),
        (run.end.gap.ln() - TOUCHING.ln()).abs(),
    );
    let [one, two] = run.end.orientations;
    let tilt = larger(one.y.abs(), two.y.abs());
    rows.add(
        name,
        of("component of the orientations across the line of centres"),
        (
            2.0 * f64::EPSILON,
            "they face each other: only the rounding of the sine of pi is left",
        ),
        tilt,
    );
    Ok(())
}

/// Squirmers side by side: there `S = -B_2/2`, so that pullers part at once. Pushers approach, while the torques turn
/// them away from each other until `S` changes its sign. Their smallest gap is compared with that by the asymptotic
/// equations: `dL/dt = slope S(c) L + constant`, and the rate of the angle from the balance of torques.
fn side_by_side(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let options = until(200.0, TOLERANCE);
    let pullers = model.run(&mirror_pair(1e-8, 5.0, FRAC_PI_2)?, &options)?;
    let start = pullers.start.gap;
    rows.add(
        name,
        "side by side, beta 5: how far the gap falls below that at the start, relative",
        (
            (1.0 - start.ln()) * f64::EPSILON,
            "S < 0, so that the gap grows from the start; rounding of exp(ln eps)",
        ),
        1.0 - pullers.min_gap / start.eps(),
    );
    let scene = mirror_pair(1e-8, -5.0, FRAC_PI_2)?;
    let pushers = model.run(&scene, &options)?;
    let from = pushers.start.gap.log_inverse();
    let nearest = asymptotic_turning(model, &scene.squirmers[0], from)?;
    let steps = pushers.counters.steps as f64;
    let bound = steps * TOLERANCE * SIZE + 1e-8 * nearest;
    let why = "steps x tolerance x (1 + |y|), plus eps L at the start, which grows as L does";
    rows.add(
        name,
        format!("side by side, beta -5: ln of the smallest gap, {:.1}, relative difference from the asymptotic equations", -nearest),
        (bound, why),
        (-pushers.min_gap.ln() / nearest - 1.0).abs(),
    );
    Ok(())
}

/// Largest `L` of mirror images that begin side by side, by the two asymptotic equations. They are integrated by the
/// classical Runge–Kutta method of fourth order.
fn asymptotic_turning(model: &Model, squirmer: &Squirmer, from: f64) -> Result<f64, CompareError> {
    const STEP: f64 = 1e-5;
    let unit = Gap::new(1e-12)?;
    let loads = model.loads(unit, LoadSet::all(2))?;
    let slope = if model.method() == Method::Lt {
        4.5
    } else {
        6.0
    };
    let rates = |[log, angle]: [f64; 2]| {
        let at = |known: f64, slope: f64| known + slope * (log - unit.log_inverse());
        let (s, c) = angle.sin_cos();
        let (p, w) = ([c, 1.5 * c * c - 0.5], [1.0, c]);
        let (mut slip, mut torque, mut thrust) = (0.0, 0.0, 0.0);
        for (n, (b, mode)) in squirmer.modes().iter().zip(loads.modes()).enumerate() {
            slip += b * p[n] * at(mode.xf.difference, slope);
            torque += b * w[n] * s * at(mode.yt.difference, 1.2);
            thrust += b * w[n] * s * mode.yf.sum;
        }
        let (a, b, c) = (loads.ya.sum, loads.yb.sum, at(loads.yc.difference, 0.15));
        // [6a, -4b; -4b, 8c] (U, w) = (thrust, torque).
        let spin = (torque + 4.0 * b * thrust / (6.0 * a)) / (8.0 * c - 16.0 * b * b / (6.0 * a));
        [2.0 / 3.0 * slip, spin]
    };
    let moved = |y: [f64; 2], h: f64, k: [f64; 2]| [y[0] + h * k[0], y[1] + h * k[1]];
    let (mut y, mut nearest) = ([from, FRAC_PI_2], from);
    while y[0] >= nearest && y[0] < -TOUCHING.ln() {
        nearest = y[0];
        let k1 = rates(y);
        let k2 = rates(moved(y, 0.5 * STEP, k1));
        let k3 = rates(moved(y, 0.5 * STEP, k2));
        let k4 = rates(moved(y, STEP, k3));
        for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            y = moved(y, weight * STEP / 6.0, k);
        }
    }
    Ok(nearest)
}
