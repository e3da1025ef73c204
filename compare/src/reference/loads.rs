//! Exact loads over the gap, each with the digits that its error leaves.

use rayon::prelude::*;
use scene::{ActiveLoads, Gap, Hydrodynamics, LoadSet, PairLoads, SceneError, are_unlike};
use serde::Serialize;

use super::digits::Digits;
use super::gaps::{ExactOf, gaps_of_ratio};
use crate::CompareError;
use crate::columns::columns;
use crate::watch::{Pieces, Progress};

/// The loads of the package: ten resistance scalars, and those by the squirming modes 1 and 2.
pub const LOADS: LoadSet = LoadSet::all(2);

/// How many times the model's own error estimate the error is taken to be: near contact and far apart it is measured at
/// three gaps only.
const SAFETY: f64 = 3.0;

columns! {
    /// A row for each ratio of the radii, gap and load. Loads are pure numbers, for viscosity 1 and radius 1, defined in the
    /// package's README.md. Where radii are unlike, names have the number of the loaded sphere and that of the sphere that moves or
    /// squirms, whose radius is 1: `X21A` is the load on sphere 2 by sphere 1, `Y21B` the torque on it by
    /// a translation and `Y21B_force` the force by a spin. Equal spheres have those of sphere 1 alone: `X12A` is the load on sphere 2.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct ReferenceLoad {
        /// Radius of sphere 2 over that of sphere 1.
        #[unit = "-"]
        pub ratio: f64,
        /// Gap between the surfaces, in radii of sphere 1.
        #[unit = "a"]
        pub gap: f64,
        /// Name of the load.
        #[unit = "-"]
        pub name: String,
        /// The load, down to the last digit that the error leaves.
        #[unit = "-"]
        pub value: String,
        /// Largest difference of the printed number from the exact load, with that of rounding.
        #[unit = "-"]
        pub error_estimate: String,
    }
}

/// The relative error of the loads at a gap: of each sum and difference of a load on sphere 1 and its other one, relative to the larger of it
/// and 1.
///
/// # Errors
/// Those of the model.
pub(super) fn relative_error(exact: &dyn Hydrodynamics, gap: Gap) -> Result<f64, SceneError> {
    Ok(SAFETY * exact.error_estimate(gap, LOADS)?.unwrap_or(f64::INFINITY))
}

/// What a `relative` error of the sums and differences makes of each load.
pub(super) fn errors(loads: &ActiveLoads, relative: f64) -> ActiveLoads {
    let set = loads.pair.set();
    let columns: Vec<f64> = loads.pair.columns().collect();
    let bounds: Vec<f64> = (columns.chunks(2))
        // The sum of the errors is twice that of either load, and they do not differ.
        .flat_map(|both| [both.iter().map(|of| relative * size(*of)).sum(), 0.0])
        .collect();
    ActiveLoads {
        pair: PairLoads::from_columns(set, set, &bounds),
        torque_on_other: relative * size(loads.torque_on_other),
        swirl: loads.swirl,
    }
}

/// What errors are relative to.
fn size(load: f64) -> f64 {
    load.abs().max(1.0)
}

/// Name, value and error of every load: of equal spheres those of sphere 1.
pub(super) fn named(
    ratio: f64,
    loads: &[ActiveLoads; 2],
    relative: f64,
) -> Vec<(String, f64, f64)> {
    let all = |of: &[ActiveLoads; 2]| -> Vec<(String, f64)> {
        if are_unlike(ratio) {
            let each = of.iter().zip([1, 2]);
            each.flat_map(|(of, active)| of.named(active)).collect()
        } else {
            of[0].pair.named()
        }
    };
    let bounds = loads.each_ref().map(|of| errors(of, relative));
    (all(loads).into_iter().zip(all(&bounds)))
        .map(|((name, value), (_, error))| (name, value, error))
        .collect()
}

/// The loads of all models at all gaps.
///
/// # Errors
/// Those of the exact model.
pub fn reference_loads(models: &[ExactOf]) -> Result<Vec<ReferenceLoad>, CompareError> {
    let mut points = Vec::new();
    for of in models {
        // The limiting forms are fitted here once, and not by each thread for itself.
        of.exact
            .contact_constants_of_each(LOADS)
            .map_err(SceneError::from)?;
        let gaps = gaps_of_ratio(of.ratio).into_iter();
        points.extend(gaps.map(|gap| (of, gap)));
    }
    let progress = Progress::begin("gaps of loads.csv", points.len(), Pieces::Unlike);
    let rows: Result<Vec<_>, CompareError> = (points.par_iter())
        .map(|&(of, gap)| {
            let rows = at_gap(of, gap)?;
            progress.advance();
            Ok(rows)
        })
        .collect();
    Ok(rows?.concat())
}

fn at_gap(of: &ExactOf, eps: f64) -> Result<Vec<ReferenceLoad>, CompareError> {
    let gap = Gap::new(eps)?;
    let loads = of.exact.loads_of_each(gap, LOADS)?;
    let relative = relative_error(&of.exact, gap)?;
    let rows = named(of.ratio, &loads, relative).into_iter();
    Ok(rows
        .map(|(name, value, error)| {
            let digits = Digits::of(value, error);
            ReferenceLoad {
                ratio: of.ratio,
                gap: eps,
                name,
                value: digits.value,
                error_estimate: digits.error,
            }
        })
        .collect())
}
