//! What becomes of a run in a row: its numbers, or the reason why there is no run.

use scene::Run;

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
