//! Where lubrication theory and exact hydrodynamics disagree, over the plane of initial directions.

use scene::Outcome;
use serde::{Deserialize, Serialize};

use super::grid::Pair;
use super::scatter::{ScatterRow, line};
use super::{EachMap, Maps};
use crate::columns::columns;
use crate::no_run::FAILED;
use crate::output::csv_lines;
use crate::sweep::Row;
use crate::{CompareError, Method};

columns! {
    /// A row for each form of lubrication theory, pair and point of the grid of initial angles. Differences are deflections
    /// by lubrication theory minus exact deflections.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct TrustRow {
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Difference of the initial angles from the x axis divided by pi, `(phi2 - phi1)/pi`.
        #[unit = "-"]
        pub delta: f64,
        /// Sum of the initial angles from the x axis divided by pi, `(phi2 + phi1)/pi`.
        #[unit = "-"]
        pub sigma: f64,
        /// Outcome by lubrication theory.
        #[unit = "-"]
        pub outcome_lt: String,
        /// Outcome by exact hydrodynamics.
        #[unit = "-"]
        pub outcome_exact: String,
        /// Difference for squirmer 1. NaN if one of the two runs has no deflection.
        #[unit = "deg"]
        pub difference1_deg: f64,
        /// Difference for squirmer 2. NaN if one of the two runs has no deflection.
        #[unit = "deg"]
        pub difference2_deg: f64,
        /// Name of the form of lubrication theory.
        #[unit = "-"]
        pub method: Method,
        /// Bottom-heaviness of both squirmers; 0 if gravity does not turn them.
        #[unit = "-"]
        pub g: f64,
        /// Offset out of the plane: squirmer 1 starts at `z = dz/2`, squirmer 2 at `z = -dz/2`.
        #[unit = "a"]
        pub dz: f64,
    }
}

impl TrustRow {
    fn of(judged: &ScatterRow, exact: &ScatterRow, pair: Pair) -> Self {
        Self {
            beta: judged.beta,
            delta: judged.delta,
            sigma: judged.sigma,
            outcome_lt: judged.outcome.clone(),
            outcome_exact: exact.outcome.clone(),
            difference1_deg: judged.deflection1_deg - exact.deflection1_deg,
            difference2_deg: judged.deflection2_deg - exact.deflection2_deg,
            method: judged.method,
            g: pair.g,
            dz: pair.dz,
        }
    }

    /// Whether both models give the same outcome.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.outcome_lt == self.outcome_exact
    }

    fn differences(&self) -> [f64; 2] {
        [self.difference1_deg, self.difference2_deg]
    }

    /// The larger of the two differences, in degrees; `None` unless the pair parts in both models.
    #[must_use]
    pub fn difference(&self) -> Option<f64> {
        larger([&self.outcome_lt, &self.outcome_exact], self.differences())
    }

    /// Index of the class of trust in [`CLASSES`].
    #[must_use]
    pub fn class(&self) -> usize {
        trust_class([&self.outcome_lt, &self.outcome_exact], self.differences())
    }
}

/// The larger of two differences, if both models part the pair.
fn larger(outcomes: [&str; 2], [one, two]: [f64; 2]) -> Option<f64> {
    let scattered = Outcome::Scattered.to_string();
    (outcomes.iter().all(|outcome| *outcome == scattered)).then(|| one.abs().max(two.abs()))
}

/// Index in [`CLASSES`] of two runs from one start, from their outcomes and the differences of the deflections, in degrees.
#[must_use]
pub fn trust_class(outcomes: [&str; 2], differences: [f64; 2]) -> usize {
    let [judged, exact] = outcomes;
    match larger(outcomes, differences) {
        _ if outcomes.contains(&FAILED) => CLASSES.len() - 1,
        _ if judged != exact => CLASSES.len() - 2,
        Some(difference) => (BOUNDS_DEG.iter())
            .position(|&bound| difference <= bound)
            .unwrap_or(BOUNDS_DEG.len()),
        None => CLASSES.len() - 3,
    }
}

/// Limits of the classes of trust: differences of deflections, in degrees.
const BOUNDS_DEG: [f64; 3] = [5.0, 15.0, 45.0];

/// Names of the classes of trust.
pub const CLASSES: [&str; 7] = [
    "up to 5°",
    "5° to 15°",
    "15° to 45°",
    "more than 45°",
    "alike, no deflection",
    "another outcome",
    "failed",
];

columns! {
    /// A row for each form of lubrication theory and pair: the share of initial angles in each class of trust. Shares
    /// are from 0 to 1. The difference of a pair is the larger of those of its two squirmers.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct TrustShares {
        /// Name of the form of lubrication theory.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Bottom-heaviness of both squirmers; 0 if gravity does not turn them.
        #[unit = "-"]
        pub g: f64,
        /// Offset out of the plane: squirmer 1 starts at `z = dz/2`, squirmer 2 at `z = -dz/2`.
        #[unit = "a"]
        pub dz: f64,
        /// Share where both models part the pair, and the deflections differ by at most 5 degrees.
        #[unit = "-"]
        pub within_5_deg: f64,
        /// Share where both models part the pair, and the deflections differ by 5 to 15 degrees.
        #[unit = "-"]
        pub within_15_deg: f64,
        /// Share where both models part the pair, and the deflections differ by 15 to 45 degrees.
        #[unit = "-"]
        pub within_45_deg: f64,
        /// Share where both models part the pair, and the deflections differ by more than 45 degrees.
        #[unit = "-"]
        pub beyond_45_deg: f64,
        /// Share where both models give the same outcome, and the pair does not part.
        #[unit = "-"]
        pub same_outcome: f64,
        /// Share where the models give different outcomes.
        #[unit = "-"]
        pub other_outcome: f64,
        /// Share where a run failed.
        #[unit = "-"]
        pub failed: f64,
    }
}

impl TrustShares {
    /// The shares in the order of [`CLASSES`].
    #[must_use]
    pub fn in_order(&self) -> [f64; CLASSES.len()] {
        [
            self.within_5_deg,
            self.within_15_deg,
            self.within_45_deg,
            self.beyond_45_deg,
            self.same_outcome,
            self.other_outcome,
            self.failed,
        ]
    }
}

/// The shares for each method and pair, in the order of `rows`.
#[must_use]
pub fn trust_shares(rows: &[TrustRow]) -> Vec<TrustShares> {
    (rows.chunk_by(same_map))
        .map(|map| {
            let share = |class: usize| {
                map.iter().filter(|row| row.class() == class).count() as f64 / map.len() as f64
            };
            TrustShares {
                method: map[0].method,
                beta: map[0].beta,
                g: map[0].g,
                dz: map[0].dz,
                within_5_deg: share(0),
                within_15_deg: share(1),
                within_45_deg: share(2),
                beyond_45_deg: share(3),
                same_outcome: share(4),
                other_outcome: share(5),
                failed: share(6),
            }
        })
        .collect()
}

/// Whether two rows belong to the same map.
pub fn same_map(a: &TrustRow, b: &TrustRow) -> bool {
    let key = |row: &TrustRow| (row.beta.to_bits(), row.g.to_bits(), row.dz.to_bits());
    a.method == b.method && key(a) == key(b)
}

/// Compares the rows of one map with the exact rows of the same points.
#[must_use]
pub fn trust_rows(judged: &[ScatterRow], exact: &[ScatterRow], pair: Pair) -> Vec<TrustRow> {
    (judged.iter().zip(exact))
        .map(|(judged, exact)| TrustRow::of(judged, exact, pair))
        .collect()
}

impl Row for TrustRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        [self.outcome_lt.as_str(), self.outcome_exact.as_str()].into_iter()
    }
}

impl Maps<'_> {
    /// Compares each of the models with the exact one, for every pair and point of the grid. Passes the rows of each
    /// map to `each`, one map at a time, and writes all rows to the file of the maps if `kept`. Returns whether all are
    /// done; if the time limit left something out, the same command continues.
    ///
    /// # Errors
    /// [`CompareError::Write`] if rows cannot be kept; [`CompareError::Input`] without an exact model; the errors of
    /// `each`.
    pub fn trust<E: From<CompareError>>(
        &self,
        kept: bool,
        each: &mut EachMap<'_, TrustRow, E>,
    ) -> Result<bool, E> {
        let Some(exact) = self.exact else {
            let allowed = "name exact and the methods to compare with it, such as lt,exact";
            return Err(CompareError::input("--method", "without exact", allowed).into());
        };
        let sweep = self.sweep();
        let lines = self.lines(&sweep, |model, pair, sigma, options| {
            let judged = line(model, pair, self.grid, sigma, options);
            let referee = line(exact, pair, self.grid, sigma, options);
            csv_lines(&trust_rows(&judged, &referee, pair))
        })?;
        let Some(lines) = lines else {
            return Ok(false);
        };
        if kept {
            self.write(lines, each)?;
        } else {
            self.read(&lines, each)?;
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "shares of four are exact")]

    use super::*;

    fn row(outcomes: [&str; 2]) -> TrustRow {
        TrustRow {
            beta: 1.0,
            delta: 0.5,
            sigma: 0.5,
            outcome_lt: outcomes[0].to_owned(),
            outcome_exact: outcomes[1].to_owned(),
            difference1_deg: f64::NAN,
            difference2_deg: f64::NAN,
            method: Method::Lt,
            g: 0.0,
            dz: 0.0,
        }
    }

    #[test]
    fn runs_that_failed_neither_agree_nor_differ() {
        let pairs = [
            ["failed", "failed"],
            ["failed", "scattered"],
            ["pairwise", "failed"],
            ["pairwise", "scattered"],
        ];
        let shares = trust_shares(&pairs.map(row));
        assert_eq!(shares[0].failed, 0.75);
        assert_eq!(shares[0].other_outcome, 0.25);
        assert_eq!(shares[0].same_outcome, 0.0);
    }
}
