//! Boundary elements: errors at random gaps, gaps that are refused, rotated meshes, and condition numbers.
//! [`super::panels`] has the integrals over panels.

use bem::{Bem, Body, Lab};
use exact::Exact;
use nalgebra::{UnitQuaternion, Vector3};
use rayon::prelude::*;
use scene::{Gap, Hydrodynamics, LoadSet};

use super::panels::panels;
use super::rows::larger;
use super::{Bench, Rows};
use crate::{CompareError, Method};

const LOADS: LoadSet = LoadSet::all(2);

pub(super) fn cases(_: &Bench, rows: &mut Rows) {
    let name = Method::Bem.name();
    rows.attempt(name, "random gaps", random_gaps);
    rows.attempt(name, "closing gap", closing_gap);
    rows.attempt(name, "refusals", refusals);
    rows.attempt(name, "rotated meshes", rotated_meshes);
    rows.attempt(name, "condition", conditions);
    rows.attempt(name, "panels", panels);
}

/// Condition numbers at level 2 and gaps of 1 and 0.01, with and without deflation. Deflation is the term that fixes the
/// part of the density along the normal.
fn conditions(rows: &mut Rows) -> Result<(), CompareError> {
    const LEVEL: usize = 2;
    let (name, model) = (Method::Bem.name(), Bem::new(LEVEL)?);
    for eps in [1.0, 0.01] {
        let gap = Gap::new(eps)?;
        let found = model.conditions(gap, LOADS)?;
        let most = found.iter().map(|c| c.solved).fold(0.0, larger);
        let estimate = model.error_estimate(gap, LOADS)?.unwrap_or(f64::NAN);
        let from = "rounding x condition number must be below the estimated error of the mesh";
        rows.add(
            name,
            format!(
                "gap {eps}, level {LEVEL}: largest condition number of the six systems of equations"
            ),
            (estimate / f64::EPSILON, from),
            most,
        );
        let gained = (found.iter())
            .filter_map(|c| Some(c.solved / c.without_deflation?))
            .fold(0.0, larger);
        let from = "a density along the normal makes no flow: without deflation only the mesh's error makes the system solvable";
        rows.add(
            name,
            format!("gap {eps}, level {LEVEL}: condition number of the axial systems with deflation, divided by that without"),
            (1.0, from),
            gained,
        );
    }
    Ok(())
}

/// The `k`-th number of a sequence that fills [0, 1) evenly: multiples of an irrational number (the golden ratio or a
/// generalisation of it) without their whole parts.
fn share(k: usize, of: f64) -> f64 {
    ((k + 1) as f64 * of).fract()
}

/// Error of the loads that motion in a plane needs, divided by its estimate; none where the level refuses the gap. These
/// loads leave out rotation about the line of centres, which is the easiest.
fn over_estimate(model: &Bem, exact: &Exact, gap: Gap) -> Result<Option<f64>, CompareError> {
    const LOADS: LoadSet = LoadSet::planar(2);
    if model.check(gap).is_err() {
        return Ok(None);
    }
    let (solution, estimate) = model.solve_with_estimate(gap, LOADS)?;
    let (_, found) = (solution.loads).worst_error(&exact.loads(gap, LOADS)?);
    Ok(Some(found / estimate))
}

/// From what the bounds on errors by their estimates follow.
const WITHIN: &str = "estimates are made of the differences of three levels, which hardly agree by chance, and at levels 1 and 2 of three and two times as much: no error is above its own";

/// `(level, number of random gaps)`: fewer at finer levels, which take longer.
const ANSWERED: [(usize, usize); 3] = [(1, 140), (2, 55), (3, 10)];

/// Random gaps from the smallest of a level's range to 1, evenly distributed in `ln eps`.
fn random_gaps(rows: &mut Rows) -> Result<(), CompareError> {
    let exact = Exact::new();
    let mut ratios = Vec::new();
    for (level, count) in ANSWERED {
        let model = Bem::new(level)?;
        let smallest = model.range().smallest.ln();
        let of_level = (0..count)
            .into_par_iter()
            .map(|k| {
                let gap = Gap::from_ln(smallest * share(k, 0.618_033_988_749_895));
                over_estimate(&model, &exact, gap)
            })
            .collect::<Result<Vec<_>, CompareError>>()?;
        ratios.extend(of_level);
    }
    let answered = ratios.iter().flatten().count();
    let worst = ratios.iter().flatten().copied().fold(0.0, larger);
    let refused = ratios.len() - answered;
    let name = Method::Bem.name();
    rows.add(
        name,
        format!("{answered} random gaps at levels 1 to 3: largest error, divided by its estimate"),
        (1.0, WITHIN),
        worst,
    );
    rows.add(
        name,
        "random gaps within a level's range that are refused",
        (0.0, "a level gives loads at every gap of its range"),
        refused as f64,
    );
    Ok(())
}

/// Gaps from 1 to 1e-4 at a fixed level.
fn closing_gap(rows: &mut Rows) -> Result<(), CompareError> {
    const COUNT: usize = 25;
    let exact = Exact::new();
    for level in [1, 2] {
        let model = Bem::new(level)?;
        let ratios = (0..COUNT)
            .into_par_iter()
            .map(|k| {
                let gap = Gap::from_ln(1e-4_f64.ln() * k as f64 / (COUNT - 1) as f64);
                over_estimate(&model, &exact, gap)
            })
            .collect::<Result<Vec<_>, CompareError>>()?;
        let refused = ratios.iter().filter(|ratio| ratio.is_none()).count();
        let worst = ratios.iter().flatten().copied().fold(0.0, larger);
        rows.add(
            Method::Bem.name(),
            format!("level {level}, {COUNT} gaps from 1 to 1e-4, {refused} of them refused: largest error, divided by its estimate"),
            (1.0, WITHIN),
            worst,
        );
    }
    Ok(())
}

/// Gaps below the range of a level.
fn refusals(rows: &mut Rows) -> Result<(), CompareError> {
    let mut answered = 0;
    for level in Bem::LEVELS.0..=Bem::LEVELS.1 {
        let model = Bem::new(level)?;
        let smallest = model.range().smallest;
        for below in [0.99, 0.1, 1e-3, 1e-12] {
            answered += usize::from(model.loads(Gap::new(smallest * below)?, LOADS).is_ok());
        }
    }
    rows.add(
        Method::Bem.name(),
        "gaps below a level's range that are not refused",
        (0.0, "a mesh refuses gaps that it does not resolve"),
        answered as f64,
    );
    Ok(())
}

/// The solver in the laboratory frame, with both meshes turned at random, so that they have no mirror symmetry.
fn rotated_meshes(rows: &mut Rows) -> Result<(), CompareError> {
    const LEVEL: usize = 1;
    const COUNT: usize = 6;
    let centred = |eps: f64| 0.5 * (2.0 + eps);
    for eps in [1.1, 3.0] {
        let modes = [1.5, 3.0];
        let velocities =
            |level: usize, rotation: &(dyn Fn(usize) -> UnitQuaternion<f64> + Sync)| {
                let at = |side: f64, p: [f64; 3], salt: usize| Body {
                    mesh_rotation: rotation(salt),
                    ..Body::squirmer(Vector3::x() * (side * centred(eps)), p.into(), &modes)
                };
                let bodies = [at(-1.0, [0.6, 0.7, 0.2], 0), at(1.0, [-0.3, 0.5, -0.8], 3)];
                let motions = Lab::new(level, &bodies)?.free_motions()?;
                Ok::<_, CompareError>(motions.iter().map(|m| m.velocity).collect::<Vec<_>>())
            };
        let motions = (0..COUNT)
            .into_par_iter()
            .map(|k| {
                let turned = |salt: usize| {
                    let k = 7 * k + salt;
                    UnitQuaternion::from_euler_angles(
                        6.0 * share(k, 0.618_033_988_749_895),
                        3.0 * share(k, 0.754_877_666_246_693),
                        6.0 * share(k, 0.569_840_290_998_053),
                    )
                };
                velocities(LEVEL, &turned)
            })
            .collect::<Result<Vec<_>, CompareError>>()?;
        let apart = |one: &[Vector3<f64>], other: &[Vector3<f64>]| {
            let pairs = one.iter().zip(other);
            pairs.map(|(a, b)| (a - b).norm()).fold(0.0, larger)
        };
        let scatter = (motions.iter())
            .map(|one| apart(one, &motions[0]))
            .fold(0.0, larger);
        let unturned = |_| UnitQuaternion::identity();
        let estimate = apart(
            &velocities(LEVEL, &unturned)?,
            &velocities(LEVEL + 1, &unturned)?,
        );
        rows.add(
            Method::Bem.name(),
            format!(
                "gap {eps}: largest difference of the velocities from the first of {COUNT} random rotations of both meshes"
            ),
            (
                3.0 * estimate,
                "two results, each with an error of 3/2 of the difference from the next level; the model states that errors fall by a factor of three",
            ),
            scatter,
        );
    }
    Ok(())
}
