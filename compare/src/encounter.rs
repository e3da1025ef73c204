//! Encounters as each method computes them: one row of numbers per run, and its trajectory.

use scene::{Outcome, Run};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use crate::columns::columns;
use crate::numbers::written;
use crate::{Case, Method};

/// One encounter by one method: its run, or the reason why it has none.
#[derive(Clone, Debug)]
pub struct Encounter {
    /// The case.
    pub case: Case,
    /// The method.
    pub method: Method,
    /// The run with its samples, or the reason why there is no run.
    pub run: Result<Run, NoRun>,
    /// Wall-clock time of the run in seconds, without the time to build tables.
    pub seconds: f64,
}

/// The reason why there is no run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoRun {
    /// The run was not started.
    #[error("skipped: the time limit was reached")]
    Skipped,
    /// The run failed; the reason in one line.
    #[error("{0}")]
    Failed(String),
}

impl NoRun {
    /// The word in the column `outcome`.
    #[must_use]
    pub fn outcome(&self) -> &'static str {
        match self {
            Self::Skipped => SKIPPED,
            Self::Failed(_) => FAILED,
        }
    }
}

/// The numbers of a run as they stand in a row. Without a run they are NaN and 0.
pub(crate) struct RunNumbers {
    pub deflections_deg: [f64; 2],
    pub min_gap: f64,
    pub tau: f64,
    pub outcome: String,
    pub steps: u64,
    pub loads: u64,
    pub truncation_deg: f64,
}

impl RunNumbers {
    pub(crate) fn of(run: &Result<Run, NoRun>) -> Self {
        match run {
            Ok(run) => Self {
                deflections_deg: run.deflections_rad().map(f64::to_degrees),
                min_gap: run.min_gap,
                tau: run.contact_time,
                outcome: run.outcome.to_string(),
                steps: run.counters.steps,
                loads: run.counters.loads,
                truncation_deg: run.truncation_rad.to_degrees(),
            },
            Err(none) => Self {
                deflections_deg: [f64::NAN; 2],
                min_gap: f64::NAN,
                tau: f64::NAN,
                outcome: none.outcome().to_owned(),
                steps: 0,
                loads: 0,
                truncation_deg: f64::NAN,
            },
        }
    }
}

/// Outcome of a run that was not started.
pub const SKIPPED: &str = "skipped";

/// Outcome of a run that failed.
pub const FAILED: &str = "failed";

/// Name of a method. The alias is needed because serde borrows a field of type `&str` from its input.
type MethodName = &'static str;

fn method_name<'de, D: Deserializer<'de>>(from: D) -> Result<MethodName, D::Error> {
    let name = String::deserialize(from)?;
    let method = Method::named(&name)
        .ok_or_else(|| D::Error::custom(format!("'{name}' is not a method")))?;
    Ok(method.name())
}

columns! {
    /// A row for each encounter and method. A run without a result has NaN.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct EncounterRow {
        /// Name of the method.
        #[unit = "-"]
        #[serde(deserialize_with = "method_name")]
        pub method: MethodName,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Offset of the two paths in the plane; for opposed paths the distance between them.
        #[unit = "a"]
        pub dx: f64,
        /// Offset out of the plane: squirmer 1 starts at `z = dz/2`, squirmer 2 at `z = -dz/2`.
        #[unit = "a"]
        pub dz: f64,
        /// Deflection of squirmer 1: outgoing minus incoming angle in the x-y plane.
        #[unit = "deg"]
        pub deflection1_deg: f64,
        /// Deflection of squirmer 2: outgoing minus incoming angle in the x-y plane.
        #[unit = "deg"]
        pub deflection2_deg: f64,
        /// Smallest gap during the run.
        #[unit = "a"]
        pub min_gap: f64,
        /// Interaction time: the time that the pair spends at gaps up to one radius.
        #[unit = "a/V_s"]
        pub tau: f64,
        /// Outcome of the run.
        #[unit = "-"]
        pub outcome: String,
        /// Number of accepted steps of the integrator; 0 for a run without a result.
        #[unit = "-"]
        pub steps: u64,
        /// Number of times that the model computed its loads; 0 for a run without a result.
        #[unit = "-"]
        pub loads: u64,
        /// Time of the run, without the time to build tables.
        #[unit = "s"]
        pub seconds: f64,
        /// Estimated difference of the deflections from their limit at infinite distance; 0 if the run needs no such limit.
        #[unit = "deg"]
        pub truncation_deg: f64,
    }
}

impl Encounter {
    /// The row of this encounter.
    #[must_use]
    pub fn row(&self) -> EncounterRow {
        let Case { beta, dx, dz, .. } = self.case;
        let run = RunNumbers::of(&self.run);
        EncounterRow {
            method: self.method.name(),
            beta,
            dx,
            dz,
            deflection1_deg: run.deflections_deg[0],
            deflection2_deg: run.deflections_deg[1],
            min_gap: run.min_gap,
            tau: run.tau,
            outcome: run.outcome,
            steps: run.steps,
            loads: run.loads,
            seconds: self.seconds,
            truncation_deg: run.truncation_deg,
        }
    }

    /// Name of the outcome, `failed` or `skipped`.
    #[must_use]
    pub fn outcome(&self) -> String {
        RunNumbers::of(&self.run).outcome
    }

    /// A message about an encounter without a result.
    #[must_use]
    pub fn failure(&self) -> Option<String> {
        let reason = self.run.as_ref().err()?;
        let Case {
            approach,
            beta,
            dx,
            dz,
        } = self.case;
        Some(format!(
            "{approach}, {}, beta {}, dx {}, dz {}: {reason}",
            self.method,
            written(beta),
            written(dx),
            written(dz)
        ))
    }

    /// Whether the pair parted. Only then are its outgoing angles meaningful.
    #[must_use]
    pub fn scattered(&self) -> bool {
        (self.run.as_ref()).is_ok_and(|run| run.outcome == Outcome::Scattered)
    }
}

columns! {
    /// A row for each encounter, method and offset out of the plane: how much the offset changes the outgoing orientations.
    /// Outgoing orientations are those at infinite distance if the pair parts, and those at the end of the run if it stays
    /// bound.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct OffsetRow {
        /// Name of the approach: `head-on` or `orthogonal`.
        #[unit = "-"]
        pub case: String,
        /// Name of the method.
        #[unit = "-"]
        #[serde(deserialize_with = "method_name")]
        pub method: MethodName,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Offset of the two paths in the plane; for opposed paths the distance between them.
        #[unit = "a"]
        pub dx: f64,
        /// Offset out of the plane: squirmer 1 starts at `z = dz/2`, squirmer 2 at `z = -dz/2`.
        #[unit = "a"]
        pub dz: f64,
        /// Angle between the outgoing orientations of squirmer 1 with and without the offset, from 0 to 180. NaN if one
        /// of the two runs has no outgoing orientation.
        #[unit = "deg"]
        pub change1_deg: f64,
        /// Angle between the outgoing orientations of squirmer 2 with and without the offset, from 0 to 180. NaN if one
        /// of the two runs has no outgoing orientation.
        #[unit = "deg"]
        pub change2_deg: f64,
        /// Smallest gap during the run with the offset.
        #[unit = "a"]
        pub min_gap: f64,
        /// Outcome of the run with the offset.
        #[unit = "-"]
        pub outcome: String,
        /// Outcome of the run without the offset.
        #[unit = "-"]
        pub outcome_in_plane: String,
    }
}
