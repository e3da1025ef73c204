//! How accurate the models of this workspace are in this version: the rows that `fixtures/history.csv` keeps of every release.

use std::time::Instant;

use scene::{Gap, LoadSet};
use serde::{Deserialize, Serialize};

use super::leaderboard::{own_models, submission_of};
use super::points::Truth;
use crate::CompareError;
use crate::columns::columns;
use crate::submission::{Answer, Quantity};

/// Number of timings, of which the shortest counts.
const REPEATS: usize = 3;

/// Gaps of the comparison.
const GAPS: [f64; 4] = [0.01, 0.1, 0.5, 2.0];

columns! {
    /// A row for each version and each model of this workspace. The error is the largest of the ten resistance scalars and the twelve loads by slip of the modes 1 and 2 at
    /// gaps 0.01, 0.1, 0.5 and 2, each divided by the larger of the exact load and its value of a lone sphere; of `exact` that of the ten scalars against a published
    /// table of eleven digits, divided by the larger of the scalar and 1.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct HistoryRow {
        /// Version of the workspace.
        #[unit = "-"]
        pub version: String,
        /// Name of the model.
        #[unit = "-"]
        pub model: String,
        /// The largest error.
        #[unit = "-"]
        pub error: f64,
        /// Time of one gap over that of exact loads, in one run.
        #[unit = "-"]
        pub time_ratio: f64,
    }
}

/// The rows of this version.
///
/// # Errors
/// [`CompareError`] if a model fails.
pub fn history_rows() -> Result<Vec<HistoryRow>, CompareError> {
    let truth = Truth::new(2, 0);
    let mut exact_seconds = f64::INFINITY;
    for _ in 0..REPEATS {
        let started = Instant::now();
        for gap in GAPS {
            truth.at(Gap::new(gap)?)?;
        }
        exact_seconds = exact_seconds.min(started.elapsed().as_secs_f64() / GAPS.len() as f64);
    }
    let mut rows = Vec::new();
    for (name, title, model) in own_models()? {
        let submission = submission_of(&title, model.as_ref(), &GAPS, LoadSet::all(2))?;
        let mut seconds = submission.header().seconds_per_gap.unwrap_or(f64::NAN);
        // What is quick is disturbed most by what came before.
        for _ in 1..REPEATS {
            if seconds < exact_seconds * 10.0 {
                let again = submission_of(&title, model.as_ref(), &GAPS, LoadSet::all(2))?;
                seconds = seconds.min(again.header().seconds_per_gap.unwrap_or(f64::NAN));
            }
        }
        let error = if name == "exact" {
            published_error(&truth)?
        } else {
            let said: Vec<_> = (submission.answers().iter())
                .map(|Answer { gap, values, .. }| (*gap, values.clone()))
                .collect();
            let points = truth.points(&said)?;
            let given = points.iter().filter(|point| point.given);
            given.map(|point| point.error().abs()).fold(0.0, f64::max)
        };
        rows.push(HistoryRow {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            model: name,
            error,
            time_ratio: seconds / exact_seconds,
        });
    }
    Ok(rows)
}

/// Largest error of the exact scalars against the published table at equal radii, where that has eleven digits.
fn published_error(truth: &Truth) -> Result<f64, CompareError> {
    /// Distance of the centres over the mean radius, from which on it has them.
    const FROM: f64 = 2.5;
    let mut reader = csv::Reader::from_reader(fixtures::UNEQUAL_RESISTANCE.as_bytes());
    let broken = |_| {
        CompareError::input(
            "fixtures",
            "unequal_sphere_resistance.csv",
            "a table of numbers",
        )
    };
    let mut worst = 0.0_f64;
    for row in reader.deserialize() {
        let (ratio, distance, name, published, _): (f64, f64, String, f64, String) =
            row.map_err(broken)?;
        if (ratio - 1.0).abs() > 0.0 || distance < FROM {
            continue;
        }
        // Those of sphere 2 by itself and on sphere 1 are the same by exchange.
        let exact = truth.at(Gap::new(distance - 2.0)?)?;
        if let Some(value) = Quantity::named(&name).and_then(|quantity| exact.get(quantity)) {
            worst = worst.max((value - published).abs() / published.abs().max(1.0));
        }
    }
    Ok(worst)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
    use super::*;

    #[test]
    fn regress_the_models_of_this_version_are_as_accurate_as_the_history_says() {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(fixtures::HISTORY.as_bytes());
        let kept: Vec<HistoryRow> = reader.deserialize().map(Result::unwrap).collect();
        let rows = history_rows().unwrap();
        assert_eq!(rows.len(), 6);
        for row in rows {
            let of_version = kept
                .iter()
                .filter(|old| old.version == row.version && old.model == row.model);
            let of_version: Vec<_> = of_version.collect();
            let [old] = of_version.as_slice() else {
                panic!("{} rows for {row:?}", of_version.len())
            };
            // Rounding may differ between machines, and matters to boundary elements alone.
            assert!(
                (row.error / old.error - 1.0).abs() < 1e-3,
                "{row:?} was {old:?}"
            );
            assert!(old.time_ratio > 0.0);
        }
    }

    #[test]
    fn val_exact_scalars_are_those_of_the_published_table_to_its_digits() {
        let error = published_error(&Truth::new(2, 0)).unwrap();
        assert!(error > 0.0 && error < 1e-11, "{error:e}");
    }
}
