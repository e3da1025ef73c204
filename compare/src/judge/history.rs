//! How accurate the models of this workspace are in this version, and what they cost: the rows that `fixtures/history.csv` keeps of every release, and the bands
//! in which a later measurement of the same version has to lie.

use std::time::Instant;

use scene::{Gap, LoadSet, Pose, Repulsion, RunOptions, Scene, Squirmer, State};
use serde::{Deserialize, Serialize};

use super::leaderboard::{own_models, submission_of};
use super::points::Truth;
use crate::columns::columns;
use crate::effects::InstructionRow;
use crate::submission::{Answer, Quantity};
use crate::{CompareError, Method, Model, ModelOptions};

/// Number of timings, of which the shortest counts.
const REPEATS: usize = 3;

/// Gaps of the comparison.
const GAPS: [f64; 4] = [0.01, 0.1, 0.5, 2.0];

/// Collisions of one timing.
const COLLISIONS: usize = 300;

/// What is measured of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// The largest error of the ten resistance scalars and the twelve loads by slip of the modes 1 and 2 at gaps 0.01, 0.1, 0.5 and 2, each divided by the larger
    /// of the exact load and its value of a lone sphere; of `exact` that of the ten scalars against a published table of eleven digits, divided by the larger of
    /// the scalar and 1.
    Error,
    /// Time of the loads at one gap over that of exact loads, in one run.
    LoadsTime,
    /// Time of a collision (strong pullers, opposed, one radius apart) over that of exact loads at one gap, in one run; of `exact` and `bem` by a table that stands.
    CollisionTime,
    /// Instructions of one right-hand side: two modes and repulsion in the plane.
    Instructions,
}

impl Measure {
    /// Largest factor, up or down, by which a later measurement of the same version may differ: rounding differs between machines, and matters to boundary elements
    /// alone; times are disturbed by what else a machine does; instructions depend on the compiler.
    #[must_use]
    pub fn band(self) -> f64 {
        match self {
            Self::Error => 1.001,
            Self::LoadsTime | Self::CollisionTime => 2.0,
            Self::Instructions => 1.02,
        }
    }
}

columns! {
    /// A row for each version, measure and model of this workspace.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct HistoryRow {
        /// Version of the workspace.
        #[unit = "-"]
        pub version: String,
        /// What is measured: `error`, `loads_time`, `collision_time` or `instructions`.
        #[unit = "-"]
        pub measure: Measure,
        /// Name of the model.
        #[unit = "-"]
        pub model: String,
        /// The measured value.
        #[unit = "-"]
        pub value: f64,
    }
}

impl HistoryRow {
    fn new(measure: Measure, model: &str, value: f64) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            measure,
            model: model.to_owned(),
            value,
        }
    }
}

/// The rows of this version, but for instructions, which [`instruction_rows`] has.
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
        rows.push(HistoryRow::new(Measure::Error, &name, error));
        let ratio = seconds / exact_seconds;
        rows.push(HistoryRow::new(Measure::LoadsTime, &name, ratio));
    }
    for method in [Method::Lt, Method::LtCorrected, Method::Exact] {
        let ratio = collision_seconds(method)? / exact_seconds;
        rows.push(HistoryRow::new(
            Measure::CollisionTime,
            method.name(),
            ratio,
        ));
    }
    Ok(rows)
}

/// Shortest time of a collision, in seconds.
fn collision_seconds(method: Method) -> Result<f64, CompareError> {
    let puller = Squirmer::with_beta(1.0, 5.0)?;
    let start = [
        Pose::planar(-0.5, 5.0, -90.0),
        Pose::planar(0.5, -5.0, 90.0),
    ];
    let scene = Scene::new([puller; 2], start, Some(Repulsion::PAPER), None)?;
    let model = Model::set_up(method, &ModelOptions::default())?;
    // The first builds the table.
    model.run(&scene, &RunOptions::default())?;
    let mut seconds = f64::INFINITY;
    for _ in 0..REPEATS {
        let started = Instant::now();
        for _ in 0..COLLISIONS {
            model.run(&scene, &RunOptions::default())?;
        }
        seconds = seconds.min(started.elapsed().as_secs_f64() / COLLISIONS as f64);
    }
    Ok(seconds)
}

/// The rows that follow from counted instructions.
#[must_use]
pub fn instruction_rows(counts: &[InstructionRow]) -> Vec<HistoryRow> {
    let compared = |row: &&InstructionRow| {
        let effects = (row.repulsion, row.gravity, row.swirl);
        row.state == State::Planar.name()
            && row.squirming_modes == 2
            && effects == (true, false, false)
    };
    (counts.iter().filter(compared))
        .map(|row| HistoryRow::new(Measure::Instructions, &row.model, row.instructions))
        .collect()
}

/// The rows of a text in the format of `fixtures/history.csv`.
///
/// # Errors
/// [`CompareError::Rows`] if it has another format.
pub fn read_history(text: &str) -> Result<Vec<HistoryRow>, CompareError> {
    let mut reader = (csv::ReaderBuilder::new().comment(Some(b'#'))).from_reader(text.as_bytes());
    let rows = reader.deserialize().collect::<Result<_, _>>()?;
    Ok(rows)
}

/// A line for each measured row that lies outside its band about the row that is kept of this version, and for each that has one only now or then.
#[must_use]
pub fn outside_bands(now: &[HistoryRow], kept: &[HistoryRow]) -> Vec<String> {
    let is = |one: &HistoryRow, other: &HistoryRow| {
        one.version == other.version && one.measure == other.measure && one.model == other.model
    };
    let mut lines = Vec::new();
    for row in now {
        let HistoryRow {
            measure,
            model,
            value,
            ..
        } = row;
        let Some(old) = kept.iter().find(|old| is(old, row)) else {
            lines.push(format!("{measure:?} of {model}: {value:e} is new"));
            continue;
        };
        let (factor, band) = (value / old.value, measure.band());
        // A value that is no number is outside.
        if !(factor <= band && factor >= 1.0 / band) {
            lines.push(format!(
                "{measure:?} of {model}: {value:e} was {:e}, allowed is a factor {band}",
                old.value
            ));
        }
    }
    let gone = (kept.iter())
        .filter(|old| old.version == env!("CARGO_PKG_VERSION"))
        .filter(|old| !now.iter().any(|row| is(old, row)));
    lines.extend(gone.map(|old| format!("{:?} of {} is missing", old.measure, old.model)));
    lines
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
    use crate::effects::counted_instructions;

    fn kept() -> Vec<HistoryRow> {
        read_history(fixtures::HISTORY).unwrap()
    }

    /// Times are no business of a test.
    fn errors(rows: Vec<HistoryRow>) -> Vec<HistoryRow> {
        let is_error = |row: &HistoryRow| row.measure == Measure::Error;
        rows.into_iter().filter(is_error).collect()
    }

    #[test]
    fn regress_the_models_of_this_version_are_as_accurate_as_the_history_says() {
        let rows = errors(history_rows().unwrap());
        assert_eq!(rows.len(), 6);
        assert_eq!(outside_bands(&rows, &errors(kept())), [""; 0]);
    }

    #[test]
    fn the_history_has_the_instructions_that_were_counted() {
        let counted = instruction_rows(&counted_instructions().unwrap());
        let is_count = |row: &HistoryRow| row.measure == Measure::Instructions;
        let kept: Vec<_> = kept().into_iter().filter(is_count).collect();
        assert_eq!(counted, kept);
    }

    #[test]
    fn what_lies_outside_its_band_is_new_or_is_missing_is_named() {
        let kept = kept();
        assert_eq!(outside_bands(&kept, &kept), [""; 0]);
        for (k, row) in kept.iter().enumerate() {
            let band = row.measure.band();
            let with = |value: f64| {
                let mut rows = kept.clone();
                rows[k].value = value;
                outside_bands(&rows, &kept)
            };
            for inside in [0.999 * band, 1.001 / band] {
                assert_eq!(with(inside * row.value), [""; 0], "{row:?}");
            }
            for outside in [1.001 * band * row.value, 0.999 / band * row.value, f64::NAN] {
                let lines = with(outside);
                assert_eq!(lines.len(), 1, "{row:?}: {lines:?}");
                assert!(lines[0].contains(&row.model), "{}", lines[0]);
            }
            let mut fewer = kept.clone();
            fewer.remove(k);
            assert!(outside_bands(&kept, &fewer)[0].ends_with("is new"));
            assert!(outside_bands(&fewer, &kept)[0].ends_with("is missing"));
        }
    }

    #[test]
    fn val_exact_scalars_are_those_of_the_published_table_to_its_digits() {
        let error = published_error(&Truth::new(2, 0)).unwrap();
        assert!(error > 0.0 && error < 1e-11, "{error:e}");
    }
}
