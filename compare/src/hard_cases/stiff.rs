//! Stiff repulsion, strong gravity, strong slip, and squirmers that do not swim.

use std::f64::consts::{FRAC_PI_2, PI};

use scene::{
    Gap, Gravity, Hydrodynamics, LoadSet, Orientation, Outcome, Pose, Repulsion, Scene, Squirmer,
};

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
        orientation: Orientation::Angle(angle),
    };
    let start = [pose(-half, angles[0]), pose(half, angles[1])];
    Ok(Scene::new([squirmer; 2], start, repulsion, gravity)?)
}

/// Twice the axial slip force on each of a facing pair, and the repulsion, per `pi mu a`.
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

/// A facing pair runs to where slip and repulsion balance, from every gap.
fn repulsion(
    model: &Model,
    (squirmer, vigour): (Squirmer, f64),
    decay: f64,
    what: &str,
    rows: &mut Rows,
) -> Result<(), CompareError> {
    let name = model.method().name();
    let repulsion = Repulsion::new(10.0, decay)?;
    // The balance by bisection, in ln eps.
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
        off = off.max((run.end.gap.ln() - low).abs());
        steps = steps.max((run.counters.steps + run.counters.rejected) as f64);
    }
    let bound = TOLERANCE * 10.0 * (1.0 - low);
    rows.add(
        name,
        format!("{what}: |ln| of the end gap over the equilibrium's"),
        (
            bound,
            "tolerance x (1 + |ln eps|), steps contracting by a tenth at least",
        ),
        off,
    );
    let bound = 500.0 + time * rate / 2.0;
    rows.add(
        name,
        format!("{what}: steps"),
        (
            bound,
            "stability: a step of 2 over the decay rate at least, and 500 for the way there",
        ),
        steps,
    );
    Ok(())
}

/// Far-apart squirmers right themselves as `tan(angle/2) exp(-k t)`, `k = G/(8 pi)`; a pair in contact
/// under gravity that outweighs all else ends up upright.
fn gravity(model: &Model, g: f64, what: &str, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let squirmer = Squirmer::with_beta(1.0, 1.0)?.bottom_heavy(g)?;
    let time = 5.0;
    let scene = pair(1e4, squirmer, [-0.7, 0.4], None, Some(Gravity::DOWN))?;
    let run = model.run(&scene, &until(time, TOLERANCE))?;
    let rate = g / (8.0 * PI);
    let mut off = 0.0_f64;
    for (start, end) in run.start.angles.into_iter().zip(run.end.angles) {
        let before = start - FRAC_PI_2;
        let after = 2.0 * ((before / 2.0).tan() * (-rate * time).exp()).atan();
        off = off.max((end - FRAC_PI_2 - after).abs());
    }
    let steps = run.counters.steps.max(1) as f64;
    // Vorticity of a stresslet, 3 |B_2|/(2 r^3), over the time.
    let bound = steps.min(100.0) * TOLERANCE * 3.0 + 1e-10;
    rows.add(
        name,
        format!("{what}: angle of far-apart squirmers off the closed form"),
        (
            bound,
            "tolerance x (1 + angle) of the last 100 steps, earlier ones decay",
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
            format!("{what}: outcome in contact other than upward"),
            (0.0, "gravity's torque is the largest"),
            f64::from(u8::from(run.outcome != Outcome::Upward)),
        );
    }
    Ok(())
}

/// Squirmers without a first mode have no speed to divide by; without any they stay as they are.
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
        .deflections()
        .into_iter()
        .fold(0.0_f64, |most, d| most.max(d.abs()));
    rows.add(
        name,
        "no slip: turning of passive spheres that repel each other",
        (0.0, "no torque, exactly"),
        turned,
    );
    let moved = run.end.midpoint.norm();
    rows.add(
        name,
        "no slip: motion of their midpoint",
        (0.0, "equal and opposite forces, exactly"),
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
            .chain(&run.end.angles)
            .all(|v| v.is_finite());
        rows.add(
            name,
            format!("V_s = 0, B_2 = {b2}: numbers at the end that are not finite"),
            (0.0, "nothing is divided by V_s"),
            f64::from(u8::from(!finite)),
        );
    }
    Ok(())
}
