//! Encounters as each method computes them: one row of numbers per run, and its trajectory.

use scene::{Outcome, Run};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

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

/// One line of `head-on.csv` and `orthogonal.csv`. Angles in degrees, anticlockwise positive;
/// lengths in radii; times in `a/V_s`, except `seconds`. A run that failed has NaN.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EncounterRow {
    /// Name of the method.
    #[serde(deserialize_with = "method_name")]
    pub method: MethodName,
    /// Squirmer parameter.
    pub beta: f64,
    /// Offset of the paths, in radii.
    pub dx: f64,
    /// Offset out of the plane, in radii.
    pub dz: f64,
    /// Deflection of squirmer 1: outgoing minus incoming angle in the x-y plane.
    pub deflection1_deg: f64,
    /// Deflection of squirmer 2: outgoing minus incoming angle in the x-y plane.
    pub deflection2_deg: f64,
    /// Smallest gap, in radii.
    pub min_gap: f64,
    /// Interaction time: the time at gaps up to 1.
    pub tau: f64,
    /// Outcome; `failed` for a run that failed; `skipped` for a run that the time limit left out.
    pub outcome: String,
    /// Accepted steps of the integrator.
    pub steps: u64,
    /// Number of times that the model computed its loads.
    pub loads: u64,
    /// Wall-clock time of the run, in seconds.
    pub seconds: f64,
    /// Estimated difference of the deflections from their limit at infinity; 0 if the run needs no such limit.
    pub truncation_deg: f64,
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

/// One line of `offset.csv`: how much an offset out of the plane changes the outgoing orientations. The change is
/// the angle between the outgoing orientations with and without the offset, in degrees. Outgoing orientations are
/// those at infinity if the pair parts, and those at the end of the run if it stays bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OffsetRow {
    /// Name of the approach.
    pub case: String,
    /// Name of the method.
    #[serde(deserialize_with = "method_name")]
    pub method: MethodName,
    /// Squirmer parameter.
    pub beta: f64,
    /// Offset of the paths, in radii.
    pub dx: f64,
    /// Offset out of the plane, in radii.
    pub dz: f64,
    /// Change of the first squirmer's outgoing orientation, in degrees.
    pub change1_deg: f64,
    /// Change of the second squirmer's outgoing orientation, in degrees.
    pub change2_deg: f64,
    /// Smallest gap, in radii.
    pub min_gap: f64,
    /// Outcome with the offset, `failed` or `skipped`.
    pub outcome: String,
    /// Outcome without the offset.
    pub outcome_in_plane: String,
}
