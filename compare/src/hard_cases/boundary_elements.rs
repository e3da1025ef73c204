//! Boundary elements: rotated meshes, random gaps, and refusals.

use bem::{Bem, Body, Lab};
use exact::Exact;
use nalgebra::{UnitQuaternion, Vector3};
use rayon::prelude::*;
use scene::{Gap, Hydrodynamics, LoadSet};

use super::{Bench, Rows};
use crate::{CompareError, Method};

const LOADS: LoadSet = LoadSet::all(2);

pub(super) fn cases(_: &Bench, rows: &mut Rows) {
    let name = Method::Bem.name();
    rows.attempt(name, "random gaps", random_gaps);
    rows.attempt(name, "refusals", refusals);
    rows.attempt(name, "rotated meshes", rotated_meshes);
    rows.attempt(name, "condition", conditions);
}

/// The systems at gaps of 1 and 0.01 at level 2, with and without the term that fixes the normal's share.
fn conditions(rows: &mut Rows) -> Result<(), CompareError> {
    const LEVEL: usize = 2;
    let (name, model) = (Method::Bem.name(), Bem::new(LEVEL)?);
    for eps in [1.0, 0.01] {
        let gap = Gap::new(eps)?;
        let found = model.conditions(gap, LOADS)?;
        let most = found.iter().map(|c| c.solved).fold(0.0, f64::max);
        let estimate = model.error_estimate(gap, LOADS)?;
        let from = "rounding times condition below the estimated error of the discretisation";
        rows.add(
            name,
            format!("gap {eps}, level {LEVEL}: largest condition number of the six systems"),
            (estimate / f64::EPSILON, from),
            most,
        );
        let gained = (found.iter())
            .filter_map(|c| Some(c.solved / c.without_deflation?))
            .fold(0.0, f64::max);
        let from = "the normal induces no flow: without the term the condition is that of the discretisation";
        rows.add(
            name,
            format!("gap {eps}, level {LEVEL}: condition of the axial systems with deflation over without"),
            (1.0, from),
            gained,
        );
    }
    Ok(())
}

/// Numbers in [0, 1) that fill it evenly, by additive recurrence with the golden ratio and its relatives.
fn share(k: usize, of: f64) -> f64 {
    ((k + 1) as f64 * of).fract()
}

/// Gaps from 1 to 1e-4, seven of eight at level 1, the others at level 2: within three times the estimate,
/// or refused.
fn random_gaps(rows: &mut Rows) -> Result<(), CompareError> {
    const COUNT: usize = 200;
    // Rotation about the line of centres, the easiest of the loads, is left out.
    const LOADS: LoadSet = LoadSet::planar(2);
    let (levels, exact) = ([Bem::new(1)?, Bem::new(2)?], Exact::new());
    let ratios = (0..COUNT)
        .into_par_iter()
        .map(|k| {
            let gap = Gap::from_ln(1e-4_f64.ln() * share(k, 0.618_033_988_749_895));
            let model = &levels[usize::from(k % 8 == 7)];
            if model.check(gap).is_err() {
                return Ok(None);
            }
            let loads = model.loads(gap, LOADS)?;
            let (_, found) = loads.worst_error(&exact.loads(gap, LOADS)?);
            Ok(Some(found / model.error_estimate(gap, LOADS)?))
        })
        .collect::<Result<Vec<Option<f64>>, CompareError>>()?;
    let silent = ratios
        .iter()
        .flatten()
        .filter(|ratio| ratio.is_nan() || **ratio > 3.0)
        .count();
    let refused = ratios.iter().filter(|ratio| ratio.is_none()).count();
    let name = Method::Bem.name();
    rows.add(
        name,
        format!(
            "share of {COUNT} gaps, {refused} of them refused, with an error above 3 estimates"
        ),
        (
            0.05,
            "the estimate is the difference of two levels, whose errors fall by about three",
        ),
        silent as f64 / COUNT as f64,
    );
    Ok(())
}

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
        "gaps below a level's range that are answered",
        (0.0, "a mesh that does not resolve the gap refuses it"),
        answered as f64,
    );
    Ok(())
}

/// The laboratory-frame solver, whose meshes are turned at random, so that no mirror is left.
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
            pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
        };
        let scatter = (motions.iter())
            .map(|one| apart(one, &motions[0]))
            .fold(0.0, f64::max);
        let unturned = |_| UnitQuaternion::identity();
        let estimate = apart(
            &velocities(LEVEL, &unturned)?,
            &velocities(LEVEL + 1, &unturned)?,
        );
        rows.add(
            Method::Bem.name(),
            format!(
                "gap {eps}: scatter of the velocities over {COUNT} random rotations of both meshes"
            ),
            (
                6.0 * estimate,
                "two answers, each off by three times the difference of this level from the next",
            ),
            scatter,
        );
    }
    Ok(())
}
