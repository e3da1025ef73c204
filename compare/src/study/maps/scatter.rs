//! Maps of outcome, deflections and interaction time over the initial directions (the paper's Figs 2-4).

use scene::{Outcome, RunOptions};
use serde::{Deserialize, Serialize};

use super::grid::{Grid, Pair};
use super::{EachMap, Maps};
use crate::columns::columns;
use crate::no_run::RunNumbers;
use crate::output::csv_lines;
use crate::sweep::Row;
use crate::{CompareError, Method, Model};

columns! {
    /// A row for each method, pair and point of the grid of initial angles. A run without a result has NaN.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct ScatterRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Bottom-heaviness of both squirmers; 0 if gravity does not turn them.
        #[unit = "-"]
        pub g: f64,
        /// Difference of the initial angles from the x axis divided by pi, `(phi2 - phi1)/pi`.
        #[unit = "-"]
        pub delta: f64,
        /// Sum of the initial angles from the x axis divided by pi, `(phi2 + phi1)/pi`.
        #[unit = "-"]
        pub sigma: f64,
        /// Deflection of squirmer 1.
        #[unit = "deg"]
        pub deflection1_deg: f64,
        /// Deflection of squirmer 2.
        #[unit = "deg"]
        pub deflection2_deg: f64,
        /// Interaction time: the time that the pair spends at gaps up to one radius, of the smaller squirmer.
        #[unit = "a/V_s"]
        pub tau: f64,
        /// Outcome of the run.
        #[unit = "-"]
        pub outcome: String,
        /// Smallest gap during the run.
        #[unit = "a"]
        pub min_gap: f64,
    }
}

/// Runs the pair from one point of the plane.
#[must_use]
pub fn scatter_row(
    model: &Model,
    pair: Pair,
    (delta, sigma): (f64, f64),
    options: &RunOptions,
) -> ScatterRow {
    let run = model.attempt(pair.scene(delta, sigma), options);
    let RunNumbers {
        deflections_deg,
        tau,
        outcome,
        min_gap,
        ..
    } = RunNumbers::of(&run);
    // No negative zeros.
    let [deflection1_deg, deflection2_deg] = deflections_deg.map(|angle| angle + 0.0);
    ScatterRow {
        method: model.method(),
        beta: pair.beta,
        g: pair.g,
        delta,
        sigma,
        deflection1_deg,
        deflection2_deg,
        tau,
        outcome,
        min_gap,
    }
}

/// Runs the pair from every point of a line of constant `Sigma`.
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
    /// Passes the rows of each map to `each`, one map at a time, with `Delta` varying fastest. Writes all rows to the
    /// file of the maps. Returns whether all are done; if the time limit left something out, the same command
    /// continues.
    ///
    /// # Errors
    /// [`CompareError::Write`] if rows cannot be kept; the errors of `each`.
    pub fn scatter<E: From<CompareError>>(
        &self,
        each: &mut EachMap<'_, ScatterRow, E>,
    ) -> Result<bool, E> {
        let sweep = self.sweep();
        let lines = self.lines(&sweep, |model, pair, sigma, options| {
            csv_lines(&line(model, pair, self.grid, sigma, options))
        })?;
        let Some(lines) = lines else {
            return Ok(false);
        };
        self.write(lines, each)?;
        Ok(true)
    }
}

impl Row for ScatterRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
    }
}

impl ScatterRow {
    /// The outcome; `None` if the run failed.
    #[must_use]
    pub fn outcome(&self) -> Option<Outcome> {
        (Outcome::ALL.into_iter()).find(|outcome| outcome.to_string() == self.outcome)
    }
}
