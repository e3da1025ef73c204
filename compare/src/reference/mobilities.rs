//! Coefficients of motion over the gap, with the error that the loads leave.

use rayon::prelude::*;
use scene::mobility::{COEFFICIENTS, MobilitySet};
use scene::{Gap, Hydrodynamics, PairLoads, balance};
use serde::Serialize;

use super::digits::Digits;
use super::gaps::{ExactOf, gaps};
use super::loads::{LOADS, relative_error};
use crate::CompareError;
use crate::columns::columns;
use crate::watch::{Pieces, Progress};

/// The coefficients of the package: by the squirming modes 1 and 2, by repulsion and by torques.
pub const COEFFICIENTS_READ: MobilitySet = MobilitySet {
    loads: LOADS,
    torque: true,
};

/// Step of the differences, relative to the larger of a sum or difference of loads and 1. Coefficients are smooth functions of the loads.
const STEP: f64 = 1e-6;

columns! {
    /// A row for each gap and coefficient of motion of two equal spheres: the velocities of a pair are sums of causes times these. The
    /// causes are defined in the package's README.md.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct MobilityRow {
        /// Gap between the surfaces.
        #[unit = "a"]
        pub gap: f64,
        /// Effect, cause and squirming mode.
        #[unit = "-"]
        pub name: String,
        /// The coefficient, down to the last digit that the error leaves.
        #[unit = "varies"]
        pub value: String,
        /// Largest difference of the printed number from the exact coefficient, with that of rounding.
        #[unit = "varies"]
        pub error_estimate: String,
        /// Unit of the coefficient, for radius a and viscosity mu.
        #[unit = "-"]
        pub unit: &'static str,
    }
}

/// The coefficients of equal spheres at all gaps.
///
/// # Errors
/// Those of the exact model.
pub fn mobilities(of_equal: &ExactOf) -> Result<Vec<MobilityRow>, CompareError> {
    let all: Vec<f64> = gaps().collect();
    let progress = Progress::begin("gaps of mobilities.csv", all.len(), Pieces::Unlike);
    let rows: Result<Vec<_>, CompareError> = (all.into_par_iter())
        .map(|gap| {
            let rows = at_gap(&of_equal.exact, gap)?;
            progress.advance();
            Ok(rows)
        })
        .collect();
    Ok(rows?.concat())
}

fn at_gap(exact: &dyn Hydrodynamics, eps: f64) -> Result<Vec<MobilityRow>, CompareError> {
    let gap = Gap::new(eps)?;
    let loads = exact.loads(gap, LOADS)?;
    let errors = errors(gap, &loads, relative_error(exact, gap)?);
    let coefficients = named(gap, &loads).into_iter().zip(errors);
    Ok(coefficients
        .map(|((name, value), error)| {
            let digits = Digits::of(value, error);
            MobilityRow {
                gap: eps,
                unit: unit(&name),
                name,
                value: digits.value,
                error_estimate: digits.error,
            }
        })
        .collect())
}

fn named(gap: Gap, loads: &PairLoads) -> Vec<(String, f64)> {
    balance::solve(gap, loads, COEFFICIENTS_READ).named(COEFFICIENTS_READ)
}

/// Bounds of the errors of the coefficients, to first order in a `relative` error of each sum and difference of loads.
fn errors(gap: Gap, loads: &PairLoads, relative: f64) -> Vec<f64> {
    let set = loads.set();
    let columns: Vec<f64> = loads.columns().collect();
    let values = named(gap, loads);
    let mut bounds = vec![0.0; values.len()];
    for k in 0..columns.len() {
        let mut moved = columns.clone();
        moved[k] += STEP * columns[k].abs().max(1.0);
        let moved = named(gap, &PairLoads::from_columns(set, set, &moved));
        for ((bound, (_, before)), (_, after)) in bounds.iter_mut().zip(&values).zip(moved) {
            *bound += (after - before).abs() / STEP * relative;
        }
    }
    bounds
}

fn unit(name: &str) -> &'static str {
    let of = COEFFICIENTS.iter().find(|of| {
        let rest = name.strip_prefix(of.effect);
        let rest = rest.and_then(|rest| rest.strip_prefix(" by "));
        let rest = rest.and_then(|rest| rest.strip_prefix(of.cause));
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(", mode"))
    });
    of.map_or("-", |of| of.unit)
}
