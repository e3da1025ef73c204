//! Radii of 1 to 100: the same pair named either way round, from gaps of a tenth of the smaller radius to contact.

use exact::Exact;
use lt::{Form, UnlikeLubrication};
use nalgebra::Vector3;
use scene::{
    Gap, Hydrodynamics, LoadSet, MovingPair, Orientation, Plan, Pose, Repulsion, Run, Scene,
    SceneError, Squirmer, run_plan,
};

use super::rows::larger;
use super::{Bench, ROUNDING, Rows, stepping_error, until};
use crate::{CompareError, Method};

/// Radius of the larger sphere over that of the smaller one.
const RATIO: f64 = 100.0;

pub(super) fn cases(_: &Bench, rows: &mut Rows) {
    let lubrication = Method::LtCorrected.name();
    rows.attempt(lubrication, "rates", |rows| {
        let model = |ratio: f64| UnlikeLubrication::new(Form::Corrected, ratio);
        let [of_larger, of_smaller] = [model(1.0 / RATIO)?, model(RATIO)?];
        let why = "42 roundings of either naming, as many as velocities of equal radii may have";
        exchange(
            lubrication,
            [&of_larger, &of_smaller],
            (&|_| Ok(2.0 * 42.0 * ROUNDING), why),
            rows,
        )?;
        collision(lubrication, [&of_larger, &of_smaller], rows)
    });
    let name = Method::Exact.name();
    rows.attempt(name, "rates", |rows| {
        let model = |ratio: f64| Exact::of_ratio(ratio).map_err(SceneError::from);
        let [of_larger, of_smaller] = [model(1.0 / RATIO)?, model(RATIO)?];
        let set = LoadSet::planar(2);
        let why = "the error estimates of the loads of both namings";
        let allowed = |gap: Gap| {
            let own = Gap::new(gap.eps() / RATIO)?;
            let errors = [
                of_larger.error_estimate(own, set)?,
                of_smaller.error_estimate(gap, set)?,
            ];
            Ok(errors.into_iter().flatten().sum::<f64>())
        };
        exchange(name, [&of_larger, &of_smaller], (&allowed, why), rows)
    });
}

/// A large squirmer and a small one at a gap, in units of the radius of the first one named.
fn pair(eps: f64, small_first: bool) -> Result<Scene, CompareError> {
    let unit = if small_first { 1.0 } else { RATIO };
    let large = (
        Squirmer::with_beta(1.0, 3.0)?.with_radius(RATIO / unit)?,
        [0.36, -0.48, 0.8],
    );
    let small = (
        Squirmer::with_beta(0.7, -2.0)?.with_radius(1.0 / unit)?,
        [-0.6, 0.64, 0.48],
    );
    let at = [0.0, (RATIO + 1.0 + eps) / unit];
    let pose = |x: f64, p: [f64; 3]| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Vector(p.into()),
    };
    let (squirmers, start) = if small_first {
        (
            [small.0, large.0],
            [pose(at[1], small.1), pose(at[0], large.1)],
        )
    } else {
        (
            [large.0, small.0],
            [pose(at[0], large.1), pose(at[1], small.1)],
        )
    };
    Ok(Scene::new(squirmers, start, None, None)?)
}

/// Velocities of the large squirmer and of the small one, and how fast their orientations turn, in radii of the small one.
fn motion(
    model: &dyn Hydrodynamics,
    eps: f64,
    small_first: bool,
) -> Result<[Vector3<f64>; 4], CompareError> {
    let scene = pair(eps, small_first)?;
    let plan = Plan::new(&scene)?.in_three_dimensions();
    // From positions 101 apart a gap of 1e-12 has two digits.
    let unit = if small_first { 1.0 } else { RATIO };
    let mut at = *plan.start();
    at.gap = Gap::new(eps / unit)?;
    let moving = MovingPair::free(&plan, model, &at)?;
    let [one, two] = moving.velocities;
    let [p, q] = [0, 1].map(|k| moving.angular_velocities[k].cross(&at.orientations[k]));
    Ok(if small_first {
        [two, one, q, p]
    } else {
        [one, two, p / RATIO, q / RATIO]
    })
}

/// What may be off at a gap, in radii of the small squirmer.
type Allowed<'a> = &'a dyn Fn(Gap) -> Result<f64, CompareError>;

/// Velocities of the pair named either way round; the models are those of the larger and of the smaller one named first.
fn exchange(
    name: &'static str,
    [of_larger, of_smaller]: [&dyn Hydrodynamics; 2],
    (allowed, why): (Allowed<'_>, &'static str),
    rows: &mut Rows,
) -> Result<(), CompareError> {
    let mut worst = 0.0_f64;
    for decade in 1..=12 {
        let eps = 10f64.powi(-decade);
        let one = motion(of_larger, eps, false)?;
        let other = motion(of_smaller, eps, true)?;
        let allowed = allowed(Gap::new(eps)?)?;
        for (a, b) in one.into_iter().zip(other) {
            worst = larger(worst, (a - b).norm() / b.norm().max(1.0) / allowed);
        }
    }
    rows.add(
        name,
        format!("radii 1 and {RATIO}, gaps 1e-1 to 1e-12 of the smaller one: difference of the velocities when the other one is named first, divided by what is allowed"),
        (1.0, why),
        worst,
    );
    Ok(())
}

/// The same pair closes in under repulsion; where it is when the small one has swum three radii.
fn collision(
    name: &'static str,
    [of_larger, of_smaller]: [&dyn Hydrodynamics; 2],
    rows: &mut Rows,
) -> Result<(), CompareError> {
    const TOLERANCE: f64 = 1e-10;
    let end = |model: &dyn Hydrodynamics, small_first: bool| -> Result<Run, CompareError> {
        let unit = if small_first { 1.0 } else { RATIO };
        let mut scene = pair(0.3, small_first)?;
        // The paper's repulsion of the small one, in any units.
        scene.repulsion = Some(Repulsion::new(10.0 / (unit * unit), 100.0 * unit)?);
        let options = until(3.0 / unit, TOLERANCE);
        Ok(run_plan(&Plan::new(&scene)?, model, &options)?)
    };
    let (one, other) = (end(of_larger, false)?, end(of_smaller, true)?);
    let off = (one.min_gap * RATIO / other.min_gap).ln().abs();
    let turned = (one.end.orientations[1] - other.end.orientations[0]).norm();
    rows.add(
        name,
        format!("radii 1 and {RATIO}: the smallest gap (relative) and the end of the smaller one's orientation when the other one is named first"),
        (
            stepping_error(&one, TOLERANCE) + stepping_error(&other, TOLERANCE),
            "steps x tolerance x (1 + |y|) of both runs, which close in and then slide along each other",
        ),
        off + turned,
    );
    Ok(())
}
