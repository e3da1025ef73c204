//! Rows: a measured value and the largest value allowed.

use serde::Serialize;

use crate::CompareError;
use crate::columns::columns;

columns! {
    /// A row for each bound.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct HardCaseRow {
        /// Name of the group.
        #[unit = "-"]
        pub case: &'static str,
        /// Name of the method.
        #[unit = "-"]
        pub method: &'static str,
        /// What is measured. If the case failed, the reason.
        #[unit = "-"]
        pub measure: String,
        /// Largest value allowed, in the unit that `measure` implies.
        #[unit = "varies"]
        pub bound: f64,
        /// The measured value, in the unit of the bound. NaN if the case failed.
        #[unit = "varies"]
        pub value: f64,
        /// `true` if the value is at most the bound.
        #[unit = "-"]
        pub holds: bool,
        /// What could go wrong.
        #[unit = "-"]
        pub hazard: &'static str,
        /// What the bound follows from.
        #[unit = "-"]
        pub bound_from: &'static str,
    }
}

/// The rows of a group as they come.
pub struct Rows {
    case: &'static str,
    hazard: &'static str,
    rows: Vec<HardCaseRow>,
}

impl Rows {
    pub(super) fn new(case: &'static str, hazard: &'static str) -> Self {
        Self {
            case,
            hazard,
            rows: Vec::new(),
        }
    }

    pub(super) fn finish(self) -> Vec<HardCaseRow> {
        self.rows
    }

    /// Adds a measured value.
    pub(super) fn add(
        &mut self,
        method: &'static str,
        measure: impl Into<String>,
        (bound, bound_from): (f64, &'static str),
        value: f64,
    ) {
        self.rows.push(HardCaseRow {
            case: self.case,
            method,
            measure: measure.into(),
            bound,
            value,
            // NaN does not hold.
            holds: value <= bound,
            hazard: self.hazard,
            bound_from,
        });
    }

    /// Runs a case. If it fails, adds a row that does not hold.
    pub(super) fn attempt(
        &mut self,
        method: &'static str,
        what: &str,
        case: impl FnOnce(&mut Self) -> Result<(), CompareError>,
    ) {
        if let Err(error) = case(self) {
            let measure = format!("{what}: {error}");
            self.add(method, measure, (0.0, "no error"), f64::NAN);
        }
    }
}

/// The larger of two values; NaN if one of them is NaN, so that it is not lost.
pub(super) fn larger(one: f64, other: f64) -> f64 {
    if one.is_nan() || one > other {
        one
    } else {
        other
    }
}
