//! Deflections of the paper's encounters by exact loads, with the parts of their errors.

use rayon::prelude::*;
use scene::{Hydrodynamics, Run, RunOptions, run};
use serde::Serialize;

use super::digits::{Digits, upward};
use super::tables::Tables;
use crate::columns::columns;
use crate::{Case, CompareError, Defaults};

/// Tolerance of the integrator, and the one that tells what it leaves.
const TOLERANCE: f64 = 1e-12;
const LOOSER: f64 = 1e-10;

/// Least error of a smallest gap, relative to it, and of a time.
const LEAST: f64 = 1e-9;

columns! {
    /// A row for each encounter of the paper's Figs 6 and 7, of two equal squirmers without gravity, with the paper's repulsion. The error of the deflections is the sum of its parts and that of rounding.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct DeflectionRow {
        /// The approach: `head-on` for opposed velocities (Fig. 6), `orthogonal` for velocities at right angles (Fig. 7).
        #[unit = "-"]
        pub approach: String,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Offset of the two paths in the plane; for opposed paths the distance between them.
        #[unit = "a"]
        pub dx: f64,
        /// Deflection of squirmer 1, outgoing minus incoming angle, at infinite distance.
        #[unit = "deg"]
        pub deflection1_deg: String,
        /// Deflection of squirmer 2, outgoing minus incoming angle, at infinite distance.
        #[unit = "deg"]
        pub deflection2_deg: String,
        /// Largest difference of the two printed deflections from the exact ones, with that of rounding.
        #[unit = "deg"]
        pub error_deg: String,
        /// Part of the error by the loads: what half as many terms again change.
        #[unit = "deg"]
        pub model_deg: String,
        /// Part of the error by the table of loads: what the table of the commands changes, whose error is about ten times as large.
        #[unit = "deg"]
        pub interpolation_deg: String,
        /// Part of the error by the integrator: what a tolerance of 1e-10 in place of 1e-12 changes.
        #[unit = "deg"]
        pub integration_deg: String,
        /// Part of the error by the limit of infinite distance.
        #[unit = "deg"]
        pub truncation_deg: String,
        /// Smallest gap during the run.
        #[unit = "a"]
        pub min_gap: String,
        /// Largest difference of the printed gap from the exact one, with that of rounding.
        #[unit = "a"]
        pub min_gap_error: String,
        /// Interaction time: the time that the pair spends at gaps up to one radius.
        #[unit = "a/V_s"]
        pub tau: String,
        /// Largest difference of the printed time from the exact one, with that of rounding.
        #[unit = "a/V_s"]
        pub tau_error: String,
        /// Outcome of the run.
        #[unit = "-"]
        pub outcome: String,
    }
}

/// A row for each encounter.
///
/// # Errors
/// Those of runs.
pub fn deflections(tables: &Tables) -> Result<Vec<DeflectionRow>, CompareError> {
    let cases = Defaults::paper_encounters()?;
    (cases.par_iter())
        .map(|case| of_case(case, tables))
        .collect()
}

fn of_case(case: &Case, tables: &Tables) -> Result<DeflectionRow, CompareError> {
    let scene = case.scene()?;
    let run_at = |model: &dyn Hydrodynamics, tolerance: f64| {
        let options = RunOptions {
            tolerance,
            ..RunOptions::default()
        };
        run(&scene, model, &options)
    };
    let tight = run_at(&tables.finer, TOLERANCE)?;
    let loose = run_at(&tables.finer, LOOSER)?;
    let by_more_terms = run_at(&tables.more_terms, LOOSER)?;
    let by_usual = run_at(&*tables.usual, LOOSER)?;
    let turned = |run: &Run| run.deflections_rad().map(f64::to_degrees);
    let apart = |a: &Run, b: &Run| {
        let both = turned(a).into_iter().zip(turned(b));
        both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let (model, interpolation) = (apart(&by_more_terms, &loose), apart(&by_usual, &loose));
    let integration = apart(&tight, &loose);
    let truncation = tight.truncation_rad.to_degrees();
    let error = model + interpolation + integration + truncation;
    let [first, second] = turned(&tight).map(|angle| Digits::of(angle, error));
    let of = |part: fn(&Run) -> f64, least: f64| {
        let loose = part(&loose);
        let others = [&tight, &by_more_terms, &by_usual].map(part);
        let changed: f64 = others.iter().map(|other| (other - loose).abs()).sum();
        Digits::of(part(&tight), changed.max(least))
    };
    let min_gap = of(|run| run.min_gap, LEAST * tight.min_gap);
    let tau = of(|run| run.contact_time, LEAST * tight.contact_time.max(1.0));
    Ok(DeflectionRow {
        approach: case.approach.to_string(),
        beta: case.beta,
        dx: case.dx,
        deflection1_deg: first.value,
        deflection2_deg: second.value,
        error_deg: first.error,
        model_deg: upward(model),
        interpolation_deg: upward(interpolation),
        integration_deg: upward(integration),
        truncation_deg: upward(truncation),
        min_gap: min_gap.value,
        min_gap_error: min_gap.error,
        tau: tau.value,
        tau_error: tau.error,
        outcome: tight.outcome.to_string(),
    })
}
