//! One measurement: a line of `cost.csv`.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::CompareError;
use crate::columns::columns;

/// The kinds of measurements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// Loads at a gap. Errors are relative to the larger of the load and 1.
    Loads,
    /// A trajectory. Errors are those of the outgoing angles, in degrees.
    Deflection,
    /// Time as a function of the number of unknowns, trajectories or threads.
    Scaling,
    /// Times of the parts of a trajectory.
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

columns! {
    /// A row for each measurement. Numbers that do not apply, or that failed, are NaN. Errors of loads are relative to
    /// the larger of the load and 1. Errors of trajectories are those of the outgoing angles, in degrees. Errors of
    /// velocities are in `V_s`.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct CostRow {
        /// The kind of measurement: `loads` at a gap, `deflection` (a trajectory), `scaling` (time as a function of the
        /// number of unknowns or trajectories), or `profile` (the parts of a trajectory).
        #[unit = "-"]
        pub part: Part,
        /// The model. `-table` means that its loads are read from a table; a number is the level of boundary elements.
        #[unit = "-"]
        pub model: String,
        /// Name of the quantity that is varied.
        #[unit = "-"]
        pub knob: String,
        /// Value of the quantity that is varied, in the unit that `knob` implies.
        #[unit = "varies"]
        pub value: f64,
        /// The gap in radii, the case, or the number of threads.
        #[unit = "varies"]
        pub gap_or_case: String,
        /// Largest error, in the unit that the text above the table names.
        #[unit = "varies"]
        pub error: f64,
        /// Root mean square of the errors, in the unit that the text above the table names.
        #[unit = "varies"]
        pub error_rms: f64,
        /// Part of the error of a trajectory that comes from the loads: its error if the integrator were exact.
        #[unit = "deg"]
        pub model_error: f64,
        /// Part of the error of a trajectory that comes from the tolerance of the integrator.
        #[unit = "deg"]
        pub integration_error: f64,
        /// Time of one evaluation, trajectory or sweep, without the set-up.
        #[unit = "s"]
        pub seconds: f64,
        /// Time to set the model up, once.
        #[unit = "s"]
        pub set_up_seconds: f64,
        /// Number of evaluations that were timed.
        #[unit = "-"]
        pub repeats: u64,
        /// Number of accepted steps of the integrator.
        #[unit = "-"]
        pub steps: f64,
        /// Number of rejected steps of the integrator.
        #[unit = "-"]
        pub rejected: f64,
        /// Number of evaluations of the loads: the gaps of a table, or the right-hand sides of trajectories.
        #[unit = "-"]
        pub loads: f64,
        /// Number of dense systems that one evaluation factorises.
        #[unit = "-"]
        pub solves: f64,
        /// Largest memory that the process has used so far. NaN if the system does not report it.
        #[unit = "MiB"]
        pub peak_memory_mib: f64,
    }
}

impl CostRow {
    /// A row without measured numbers.
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

/// Largest memory that the process has used so far; `None` if the system does not report it.
fn peak_memory_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}

/// Reads rows from CSV text.
///
/// # Errors
/// [`CompareError::Rows`] if the text does not have the columns of `cost.csv`.
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
