//! Pairs that are far apart, the ends of the tables, and the seams between their pieces.

use bem::Bem;
use scene::mobility::{External, Heading, MobilitySet, pair_velocity};
use scene::{FAR_GAP, Gap, Hydrodynamics, LoadSet, Orientation, PairLoads, Pose, Scene, Squirmer};

use super::rows::larger;
use super::{Bench, MESH, READ, Rows, until};
use crate::{CompareError, Method, Model};

const LOADS: LoadSet = LoadSet::all(2);

/// The loads of rigid motion alone.
const DRAGS: LoadSet = LoadSet::all(0);

/// Error of a level, divided by its difference from the next level. `bem` states that errors fall by a factor of three
/// from level to level: hence 3/2.
const LAST: f64 = 1.5;

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.only(&[Method::Exact, Method::Bem]) {
        let name = model.method().name();
        rows.attempt(name, "seams", |rows| seams(model, rows));
        rows.attempt(name, "reflections", |rows| reflections(model, rows));
    }
    for model in bench.models() {
        rows.attempt(model.method().name(), "far flight", |rows| {
            far_flight(model, rows)
        });
    }
}

fn columns(model: &Model, eps: f64) -> Result<Vec<f64>, CompareError> {
    let mobility = model.mobility(Gap::new(eps)?, READ)?;
    let named = mobility.named(READ);
    Ok(named
        .into_iter()
        .map(|(_, coefficient)| coefficient)
        .collect())
}

fn worst(one: &[f64], two: &[f64]) -> f64 {
    let pairs = one.iter().zip(two);
    pairs
        .map(|(a, b)| (a - b).abs() / a.abs().max(1.0))
        .fold(0.0, larger)
}

/// A gap near contact at which two stretches of a table meet, `exp(-16)`.
const NEAR_SEAM: f64 = 1.125_351_747_192_591_1e-7;

/// Mobilities and their slopes on both sides of the seam between near and far stretches, and mobilities on both sides of one near
/// contact.
fn seams(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let error = model.table().map_or(0.0, |table| table.interpolation_error);
    let beyond = FAR_GAP.next_up();
    rows.add(
        name,
        format!("jump of the mobilities at the seam, gap {FAR_GAP}"),
        (
            2.0 * error + 1e-14,
            "interpolation errors of both stretches",
        ),
        worst(&columns(model, FAR_GAP)?, &columns(model, beyond)?),
    );
    // One-sided differences of fourth order, with the step at which what they leave out equals what they make of the error of the table.
    const WEIGHTS: [f64; 5] = [-25.0, 48.0, -36.0, 16.0, -3.0];
    let slopes = |from: f64, h: f64| -> Result<Vec<f64>, CompareError> {
        let mut sum = vec![0.0; columns(model, from)?.len()];
        for (k, weight) in (0u8..).zip(WEIGHTS) {
            let at = columns(model, from + f64::from(k) * h)?;
            for (sum, value) in sum.iter_mut().zip(at) {
                *sum += weight * value / (12.0 * h);
            }
        }
        Ok(sum)
    };
    let noise = 2.0 * WEIGHTS.map(f64::abs).iter().sum::<f64>() / 12.0 * error;
    let step = (0.25 * noise).powf(0.2);
    rows.add(
        name,
        format!("jump of the slopes of the mobilities at the seam, gap {FAR_GAP}"),
        (
            noise / step + step.powi(4),
            "64/3 x interpolation error/h, plus h^4, for one-sided differences of fourth order on both sides with the best step h: no table tells its slope better",
        ),
        worst(&slopes(FAR_GAP, -step)?, &slopes(beyond, step)?),
    );
    if model.method() == Method::Exact {
        rows.add(
            name,
            format!(
                "jump of the mobilities where stretches meet near contact, gap {NEAR_SEAM:.2e}"
            ),
            (
                2.0 * error + 1e-11,
                "interpolation errors of both stretches, and the step of 1e-12 of the gap",
            ),
            worst(
                &columns(model, NEAR_SEAM * (1.0 + 5e-13))?,
                &columns(model, NEAR_SEAM * (1.0 - 5e-13))?,
            ),
        );
    }
    Ok(())
}

/// Loads of spheres far apart by the method of reflections (Kim & Karrila, chapter 11), an expansion in `1/r`. Here only
/// its first terms are kept; the next ones are smaller by `1/r^2`, with factors below 5.
fn reflections(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    for eps in [1e2, 1e4, 1e6] {
        let gap = Gap::new(eps)?;
        let r = gap.distance();
        let reflected = [
            2.25 / (r * r),
            -1.5 / r,
            0.5625 / (r * r),
            -0.75 / r,
            1.5 / (r * r),
        ];
        let found = drags(&model.loads(gap, LOADS)?);
        let estimate = match model.method() {
            Method::Bem => {
                let [one, two] = levels()?.map(|model| model.loads(gap, DRAGS));
                LAST * most_apart(&drags(&one?), &drags(&two?))
            }
            _ => model.error_estimate(gap, DRAGS)?.unwrap_or(0.0),
        };
        rows.add(
            name,
            format!("gap {eps:e}: loads, difference from the first reflections"),
            (
                5.0 / r.powi(3) + estimate + 1e-14,
                "next reflections, at most 5/r^3; the error that the model states (of a mesh 3/2 of the difference from the next level)",
            ),
            most_apart(&found, &reflected),
        );
    }
    Ok(())
}

/// The scalars that the first reflections give: for the sphere that moves its excess over a lone sphere, and for the
/// other sphere the scalar itself.
fn drags(loads: &PairLoads) -> [f64; 5] {
    [
        loads.xa.own() - 1.0,
        loads.xa.other(),
        loads.ya.own() - 1.0,
        loads.ya.other(),
        loads.yb.other(),
    ]
}

fn most_apart(one: &[f64], other: &[f64]) -> f64 {
    let pairs = one.iter().zip(other);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, larger)
}

/// Boundary elements at the level of these cases and at the next level.
fn levels() -> Result<[Bem; 2], CompareError> {
    Ok([Bem::new(MESH)?, Bem::new(MESH + 1)?])
}

/// Squirmers that are 1e6 radii apart swim straight.
fn far_flight(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let squirmer = Squirmer::with_beta(1.0, 5.0)?;
    let pose = |x: f64, angle: f64| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Radians(angle),
    };
    let start = [pose(-5e5, 0.3), pose(5e5, 2.9)];
    let scene = Scene::new([squirmer; 2], start, None, None)?;
    let run = model.run(&scene, &until(200.0, 1e-10))?;
    let off = [0, 1].map(|k| {
        let p = run.start.orientations[k];
        let straight = run.start.positions()[k] + p * run.end_time;
        (run.end.positions()[k] - straight).norm() + run.deflections_rad()[k].abs()
    });
    // Slip moves a squirmer by at most 4/6 of it, along and across the line of centres; both are interpolated.
    let strength: f64 = squirmer.modes().iter().sum();
    let interpolated = model.table().map_or(0.0, |table| table.interpolation_error);
    let tabulated = 2.0 * interpolated * 4.0 * strength / 6.0;
    let apart = run.start.gap;
    let (discretised, why) = if model.method() == Method::Bem {
        let [one, two] =
            levels()?.map(|model| lone_motions(&model, &squirmer, apart, run.start.angles_rad));
        (
            LAST * moved(&one?, &two?, run.end_time),
            "error of a lone squirmer's motion, 3/2 of the difference from the next level; error of the table; rounding of 5e5",
        )
    } else {
        (
            0.0,
            "error of the table; flow of the other's stresslet, 1e-12 t; rounding of 5e5",
        )
    };
    rows.add(
        name,
        "squirmers 1e6 apart: distance and turn from straight swimming after t = 200",
        (discretised + run.end_time * tabulated + 1e-9, why),
        larger(off[0], off[1]),
    );
    Ok(())
}

/// For each of two squirmers at these angles: velocity along and across the line of centres, and spin in the plane.
fn lone_motions(
    model: &Bem,
    squirmer: &Squirmer,
    gap: Gap,
    angles: [f64; 2],
) -> Result<[[f64; 3]; 2], CompareError> {
    let set = MobilitySet {
        loads: LoadSet::planar(2),
        torque: false,
    };
    let mobility = model.mobility(gap, set)?;
    let headings = [1.0, -1.0].map(|side| {
        let (sin, cos) = angles[usize::from(side < 0.0)].sin_cos();
        Heading {
            cosine: side * cos,
            transverse: sin,
        }
    });
    let external = External {
        repulsion: 0.0,
        torque: None,
    };
    let v = pair_velocity(
        (&mobility.pair, &mobility.modes[..2]),
        &[*squirmer; 2],
        &headings,
        &external,
    );
    Ok([-0.5, 0.5].map(|side| {
        let opening = side * v.opening * gap.eps();
        let turning = side * v.turning * gap.distance();
        let spin = v.spin[usize::from(side > 0.0)];
        [v.mean_axial + opening, v.mean_transverse + turning, spin]
    }))
}

/// Largest difference, in place and angle, that two such motions make after a time. A spin also turns the direction of
/// swimming, at speed 1.
fn moved(one: &[[f64; 3]; 2], other: &[[f64; 3]; 2], time: f64) -> f64 {
    let of = |(a, b): (&[f64; 3], &[f64; 3])| {
        let spin = (a[2] - b[2]).abs();
        time * ((a[0] - b[0]).hypot(a[1] - b[1]) + spin) + 0.5 * time * time * spin
    };
    one.iter().zip(other).map(of).fold(0.0, larger)
}
