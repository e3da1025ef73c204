//! One measurement, a line of `cost.csv`.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::CompareError;

/// What was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// Loads at a gap; errors relative to the larger of the load and 1.
    Loads,
    /// A trajectory; errors of the outgoing angles in degrees.
    Deflection,
    /// Time against unknowns, trajectories and threads.
    Scaling,
    /// Where a trajectory's time goes.
    Profile,
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Loads => "loads",
            Self::Deflection => "deflection",
            Self::Scaling => "scaling",
            Self::Profile => "profile",
        })
    }
}

/// One measurement. What does not apply, and what failed, is NaN.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CostRow {
    /// What was measured.
    pub part: Part,
    /// The model, with `-table` where its loads are read from a table, and the level of boundary
    /// elements.
    pub model: String,
    /// What was varied.
    pub knob: String,
    /// Its value.
    pub value: f64,
    /// The gap in radii, or the case.
    pub gap_or_case: String,
    /// Largest error.
    pub error: f64,
    /// Root mean square of the errors.
    pub error_rms: f64,
    /// The part of the largest error that the loads cause, whatever the stepper's tolerance.
    pub model_error: f64,
    /// The part of the largest error that the stepper's tolerance causes.
    pub integration_error: f64,
    /// Seconds of wall-clock time of one evaluation or trajectory, without set-up.
    pub seconds: f64,
    /// Seconds of wall-clock time of setting the model up, once.
    pub set_up_seconds: f64,
    /// Evaluations that were timed.
    pub repeats: u64,
    /// Accepted steps.
    pub steps: f64,
    /// Rejected steps.
    pub rejected: f64,
    /// Loads evaluated: gaps for a table, right-hand sides for a trajectory.
    pub loads: f64,
    /// Dense systems factorised in one evaluation.
    pub solves: f64,
    /// The most memory that the process has held so far, in MiB.
    pub peak_memory_mib: f64,
}

impl CostRow {
    /// A row in which nothing has been measured yet.
    pub fn new(
        part: Part,
        model: impl Into<String>,
        (knob, value): (&str, f64),
        gap_or_case: impl Into<String>,
    ) -> Self {
        Self {
            part,
            model: model.into(),
            knob: knob.to_owned(),
            value,
            gap_or_case: gap_or_case.into(),
            error: f64::NAN,
            error_rms: f64::NAN,
            model_error: f64::NAN,
            integration_error: f64::NAN,
            seconds: f64::NAN,
            set_up_seconds: f64::NAN,
            repeats: 0,
            steps: f64::NAN,
            rejected: f64::NAN,
            loads: f64::NAN,
            solves: f64::NAN,
            peak_memory_mib: peak_memory_mib().unwrap_or(f64::NAN),
        }
    }
}

/// The most memory that the process has held so far, where the system tells.
fn peak_memory_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}

/// Rows of a CSV text.
///
/// # Errors
/// [`CompareError::Rows`] if it is not one of `cost.csv`.
pub fn read(csv: &str) -> Result<Vec<CostRow>, CompareError> {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let rows = reader.deserialize().collect::<Result<_, _>>()?;
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_read_as_they_were_written() {
        let mut row = CostRow::new(Part::Deflection, "lt", ("tolerance", 1e-8), "head-on, dx 1");
        row.peak_memory_mib = 1.5;
        let csv = crate::csv_text(&[row]).unwrap();
        let again = crate::csv_text(&read(&csv).unwrap()).unwrap();
        assert_eq!(again, csv);
        assert!(csv.contains("deflection,lt,tolerance,1e-8,\"head-on, dx 1\",NaN"));
    }
}
