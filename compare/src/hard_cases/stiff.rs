//! Stiff repulsion, strong gravity, strong slip, and squirmers that do not swim alone.

use std::f64::consts::{FRAC_PI_2, PI};

use scene::{
    Gap, Gravity, LoadSet, Orientation, Outcome, Plan, Pose, Repulsion, Run, Scene, Squirmer,
};

use super::rows::larger;
use super::{Bench, Rows, until};
use crate::{CompareError, Method, Model};

const TOLERANCE: f64 = 1e-8;
const METHODS: [Method; 3] = [Method::Lt, Method::LtCorrected, Method::Exact];

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.only(&METHODS) {
        let name = model.method().name();
        for decay in [1e2, 1e3, 1e4, 1e5] {
            let squirmer = Squirmer::with_beta(1.0, 1.0);
            let what = format!("kappa2 = {decay:e}");
            rows.attempt(name, &what, |rows| {
                repulsion(model, (squirmer?, 1.0), decay, &what, rows)
            });
        }
        for beta in [30.0, 1e3] {
            let squirmer = Squirmer::with_beta(1.0, beta);
            let what = format!("beta = {beta:e}");
            rows.attempt(name, &what, |rows| {
                repulsion(model, (squirmer?, beta), 100.0, &what, rows)
            });
        }
        for g in [1e-6, 1.0, 1e2, 1e4] {
            let what = format!("G = {g:e}");
            rows.attempt(name, &what, |rows| gravity(model, g, &what, rows));
        }
        for beta in [-1e3, -30.0, 30.0, 1e3] {
            let what = format!("beta = {beta:e}");
            rows.attempt(name, &what, |rows| there_and_back(model, beta, &what, rows));
        }
        rows.attempt(name, "no swimming", |rows| no_swimming(model, rows));
    }
}

fn pair(
    eps: f64,
    squirmer: Squirmer,
    angles: [f64; 2],
    repulsion: Option<Repulsion>,
    gravity: Option<Gravity>,
) -> Result<Scene, CompareError> {
    let half = 1.0 + 0.5 * eps;
    let pose = |x: f64, angle: f64| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Radians(angle),
    };
    let start = [pose(-half, angles[0]), pose(half, angles[1])];
    Ok(Scene::new([squirmer; 2], start, repulsion, gravity)?)
}

/// Force of the slip on each squirmer of a facing pair, and the repulsion, both per `pi mu a`.
fn axial_forces(
    model: &Model,
    squirmer: &Squirmer,
    repulsion: Repulsion,
    eps: f64,
) -> Result<(f64, f64), CompareError> {
    let gap = Gap::new(eps)?;
    let loads = model.loads(gap, LoadSet::axial(2))?;
    let slip: f64 = (squirmer.modes().iter().zip(loads.modes()))
        .map(|(b, mode)| b * mode.xf.difference)
        .sum();
    Ok((slip, repulsion.force(gap)))
}

/// From every gap, a facing pair ends where the force of the slip balances the repulsion.
fn repulsion(
    model: &Model,
    (squirmer, vigour): (Squirmer, f64),
    decay: f64,
    what: &str,
    rows: &mut Rows,
) -> Result<(), CompareError> {
    let name = model.method().name();
    let repulsion = Repulsion::new(10.0, decay)?;
    // ln eps of the balance, by bisection.
    let (mut low, mut high) = (1e-9_f64.ln(), 0.0);
    for _ in 0..200 {
        let middle: f64 = 0.5 * (low + high);
        let (slip, push) = axial_forces(model, &squirmer, repulsion, middle.exp())?;
        if push > slip {
            low = middle
        } else {
            high = middle
        }
    }
    let (slip, _) = axial_forces(model, &squirmer, repulsion, low.exp())?;
    // d(opening)/d(ln eps) = -(2/3) R k eps/(1 - exp(-k eps)), about.
    let x = decay * low.exp();
    let rate = 2.0 / 3.0 * slip * x / -(-x).exp_m1();
    let (mut off, mut steps) = (0.0_f64, 0.0_f64);
    let time = 20.0 / vigour;
    for eps in [1e-6, 1e-5, 1e-4, 1e-3] {
        let scene = pair(eps, squirmer, [0.0, PI], Some(repulsion), None)?;
        let run = model.run(&scene, &until(time, TOLERANCE))?;
        off = larger(off, (run.end.gap.ln() - low).abs());
        steps = steps.max((run.counters.steps + run.counters.rejected) as f64);
    }
    let bound = TOLERANCE * 10.0 * (1.0 - low);
    rows.add(
        name,
        format!("{what}: |ln(gap at the end/gap of the equilibrium)|"),
        (
            bound,
            "10 x tolerance x (1 + |ln eps|): each step reduces the earlier errors by a tenth at least",
        ),
        off,
    );
    let bound = 500.0 + time * rate / 2.0;
    rows.add(
        name,
        format!("{what}: steps"),
        (
            bound,
            "stability allows steps of 2/(decay rate); 500 more on the way to the equilibrium",
        ),
        steps,
    );
    Ok(())
}

/// Stokes flow is reversible: a pair that moves by its slip alone returns to the gap and the orientations of its start
/// when the slip of both squirmers is reversed.
fn there_and_back(
    model: &Model,
    beta: f64,
    what: &str,
    rows: &mut Rows,
) -> Result<(), CompareError> {
    const DISPLACED: f64 = 1e-6;
    const ANGLES: [f64; 2] = [0.3, 2.0];
    // Strain of the slip times time: enough to change the gap by a factor.
    let time = 0.2 / beta.abs();
    let there = Squirmer::with_beta(1.0, beta)?;
    let modes: Vec<f64> = there.modes().iter().map(|b| -b).collect();
    let back = Squirmer::new(&modes)?;
    let run = |squirmer: Squirmer, [ln_gap, one, two]: [f64; 3]| -> Result<Run, CompareError> {
        let scene = pair(ln_gap.exp(), squirmer, [one, two], None, None)?;
        Ok(model.run(&scene, &until(time, TOLERANCE))?)
    };
    // Orientations relative to the line of centres: the whole pair may have turned.
    let state = |run: &Run| {
        let c = &run.end;
        [
            c.gap.ln(),
            c.angles_rad[0] - c.line_angle_rad,
            c.angles_rad[1] - c.line_angle_rad,
        ]
    };
    let start = [0.05_f64.ln(), ANGLES[0], ANGLES[1]];
    let out = run(there, start)?;
    let home = run(back, state(&out))?;
    let mut answer = 0.0_f64;
    for variable in 0..3 {
        let mut aside = state(&out);
        aside[variable] += DISPLACED;
        let off = largest_difference(state(&run(back, aside)?), state(&home));
        answer = answer.hypot(off / DISPLACED);
    }
    let steps = (out.counters.steps + home.counters.steps) as f64;
    let error = steps * 6.0_f64.sqrt() * TOLERANCE * (1.0 - start[0].min(out.min_gap.ln()));
    let why = "sqrt(6) tolerance x (1 + |ln eps|) in each step, times how much a displacement at the turning point changes the end";
    let moved = largest_difference(state(&out), start);
    rows.add(
        model.method().name(),
        format!(
            "{what}: gap (ln) and angles change by {moved:.1} and back: difference from the start"
        ),
        (error * answer.max(1.0), why),
        largest_difference(state(&home), start),
    );
    Ok(())
}

fn largest_difference(one: [f64; 3], other: [f64; 3]) -> f64 {
    let pairs = one.into_iter().zip(other);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, larger)
}

/// Gravity turns squirmers that are far apart upright: `tan(angle/2)` from the vertical decays as `exp(-k t)` with
/// `k = G/(8 pi)`. A pair near contact ends upright where gravity's torque is much larger than all others.
fn gravity(model: &Model, g: f64, what: &str, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let squirmer = Squirmer::with_beta(1.0, 1.0)?.bottom_heavy(g)?;
    let time = 5.0;
    let scene = pair(1e4, squirmer, [-0.7, 0.4], None, Some(Gravity::DOWN))?;
    let run = model.run(&scene, &until(time, TOLERANCE))?;
    let rate = g / (8.0 * PI);
    let mut off = 0.0_f64;
    for (start, end) in run.start.angles_rad.into_iter().zip(run.end.angles_rad) {
        let before = start - FRAC_PI_2;
        let after = 2.0 * ((before / 2.0).tan() * (-rate * time).exp()).atan();
        off = larger(off, (end - FRAC_PI_2 - after).abs());
    }
    let steps = run.counters.steps.max(1) as f64;
    // Vorticity of a stresslet, 3 |B_2|/(2 r^3), over the time.
    let bound = steps.min(100.0) * TOLERANCE * 3.0 + 1e-10;
    rows.add(
        name,
        format!("{what}: angle of squirmers far apart: difference from the closed form"),
        (
            bound,
            "tolerance x (1 + angle) in each of the last 100 steps; errors of earlier steps have decayed",
        ),
        off,
    );
    if g >= 1e2 {
        let scene = pair(
            0.01,
            squirmer,
            [-0.7, 0.4],
            Some(Repulsion::PAPER),
            Some(Gravity::DOWN),
        )?;
        let run = model.run(&scene, &until(50.0, TOLERANCE))?;
        rows.add(
            name,
            format!("{what}: pairs near contact whose outcome is not upward"),
            (0.0, "gravity's torque is much larger than all others"),
            f64::from(u8::from(run.outcome != Outcome::Upward)),
        );
    }
    Ok(())
}

/// Squirmers without a first mode do not swim: no speed may be divided by. Squirmers without any mode are passive
/// spheres.
fn no_swimming(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let scene = pair(
        0.01,
        Squirmer::new(&[])?,
        [0.3, 2.0],
        Some(Repulsion::PAPER),
        None,
    )?;
    let run = model.run(&scene, &until(200.0, TOLERANCE))?;
    let turned = run
        .deflections_rad()
        .into_iter()
        .fold(0.0, |most, d| larger(most, d.abs()));
    rows.add(
        name,
        "no slip: turning of passive spheres that repel each other",
        (0.0, "no torque acts on them"),
        turned,
    );
    let moved = run.end.midpoint.norm();
    rows.add(
        name,
        "no slip: motion of the midpoint of such spheres",
        (0.0, "the forces are equal and opposite"),
        moved,
    );
    for b2 in [-3.0, 3.0] {
        let scene = pair(
            0.01,
            Squirmer::new(&[0.0, b2])?,
            [0.3, 2.0],
            Some(Repulsion::PAPER),
            None,
        )?;
        let run = model.run(&scene, &until(200.0, TOLERANCE))?;
        let finite = run
            .end
            .positions()
            .iter()
            .flatten()
            .chain(&run.end.angles_rad)
            .all(|v| v.is_finite());
        rows.add(
            name,
            format!("V_s = 0, B_2 = {b2}: runs whose numbers at the end are not finite"),
            (0.0, "nothing is divided by V_s"),
            f64::from(u8::from(!finite)),
        );
        // The second mode is the same for p and -p: P_2 and W_2 p_t are even in p.
        let ends = [1.0, -1.0].map(|sign| {
            let mut start = scene.start;
            for pose in &mut start {
                pose.orientation = Orientation::Vector(pose.orientation.vector()? * sign);
            }
            let scene = Scene::new(scene.squirmers, start, scene.repulsion, None)?;
            let plan = Plan::new(&scene)?.in_three_dimensions();
            model.run_observed(&plan, &until(200.0, TOLERANCE), &mut |_| {})
        });
        let [ahead, astern] = ends;
        let (ahead, astern) = (ahead?.end, astern?.end);
        let turned = (ahead.orientations.iter().zip(&astern.orientations))
            .map(|(p, q)| (p + q).norm())
            .fold(0.0, larger);
        let off = turned + (ahead.midpoint - astern.midpoint).norm();
        rows.add(
            name,
            format!(
                "V_s = 0, B_2 = {b2}: change of the motion when both orientations are reversed"
            ),
            (0.0, "every term is even in p"),
            off + (ahead.gap.ln() - astern.gap.ln()).abs(),
        );
    }
    Ok(())
}
