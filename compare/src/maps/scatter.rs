//! Maps of what becomes of two squirmers over their initial directions (the paper's Figs 2-4).

use scene::{Outcome, RunOptions};
use serde::{Deserialize, Serialize};

use super::grid::{Grid, Pair};
use super::{Maps, SeeMap};
use crate::encounter::FAILED;
use crate::output::csv_lines;
use crate::{CompareError, Method, Model};

/// One line of `scatter.csv`. Deflections wind, anticlockwise positive; those of a pair that parts without gravity are
/// limits at infinity, those of any other the change of orientation up to the end of the run. A run that failed has NaN and the outcome
/// `failed`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScatterRow {
    /// Name of the method.
    pub method: String,
    /// Squirmer parameter.
    pub beta: f64,
    /// Bottom-heaviness.
    pub g: f64,
    /// Difference of the incoming angles, `(phi2 - phi1)/pi`.
    pub delta: f64,
    /// Sum of the incoming angles, `(phi2 + phi1)/pi`.
    pub sigma: f64,
    /// Deflection of the first squirmer, in degrees.
    pub deflection1_deg: f64,
    /// Deflection of the second squirmer, in degrees.
    pub deflection2_deg: f64,
    /// Time spent at gaps up to 1, in `a/V_s`.
    pub tau: f64,
    /// Outcome.
    pub outcome: String,
    /// Smallest gap, in radii.
    pub min_gap: f64,
}

/// The run that starts at one point of the plane.
#[must_use]
pub fn scatter_row(
    model: &Model,
    pair: Pair,
    (delta, sigma): (f64, f64),
    options: &RunOptions,
) -> ScatterRow {
    let run = (pair.scene(delta, sigma)).and_then(|scene| model.run(&scene, options));
    let run = run.as_ref().ok();
    let deflection =
        |k: usize| run.map_or(f64::NAN, |run| run.deflections_rad()[k].to_degrees() + 0.0);
    ScatterRow {
        method: model.method().name().to_owned(),
        beta: pair.beta,
        g: pair.g,
        delta,
        sigma,
        deflection1_deg: deflection(0),
        deflection2_deg: deflection(1),
        tau: run.map_or(f64::NAN, |run| run.contact_time),
        outcome: run.map_or(FAILED.to_owned(), |run| run.outcome.to_string()),
        min_gap: run.map_or(f64::NAN, |run| run.min_gap),
    }
}

/// The runs along a line of constant `Sigma`.
pub(super) fn line(
    model: &Model,
    pair: Pair,
    grid: Grid,
    sigma: f64,
    options: &RunOptions,
) -> Vec<ScatterRow> {
    (grid.values().into_iter())
        .map(|delta| scatter_row(model, pair, (delta, sigma), options))
        .collect()
}

impl Maps<'_> {
    /// Hands the rows of each map to `see`, one map at a time, each `Sigma` a line of `Delta`, and writes all to the
    /// maps' file; whether all are done, or the time limit left something out, to be gone on with.
    ///
    /// # Errors
    /// [`CompareError::Write`] if rows cannot be kept; those of `see`.
    pub fn scatter<E: From<CompareError>>(
        &self,
        see: &mut SeeMap<'_, ScatterRow, E>,
    ) -> Result<bool, E> {
        let sweep = self.sweep();
        let lines = self.lines(&sweep, |model, pair, sigma, options| {
            csv_lines(&line(model, pair, self.grid, sigma, options))
        })?;
        let Some(lines) = lines else {
            return Ok(false);
        };
        self.hand_over(lines, true, &mut |model, pair, rows: Vec<ScatterRow>| {
            let failed = rows.iter().filter(|row| row.outcome == FAILED).count();
            self.out.account().failed(failed);
            see(model, pair, rows)
        })?;
        Ok(true)
    }
}

impl ScatterRow {
    /// The method.
    #[must_use]
    pub fn method(&self) -> Option<Method> {
        Method::ALL.into_iter().find(|m| m.name() == self.method)
    }

    /// The outcome, unless the run failed.
    #[must_use]
    pub fn outcome(&self) -> Option<Outcome> {
        (Outcome::ALL.into_iter()).find(|outcome| outcome.to_string() == self.outcome)
    }
}
