//! Rows: a measured value and the largest value allowed.

use serde::Serialize;

use crate::CompareError;

/// A line of `hard-cases.csv`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HardCaseRow {
    /// The group.
    pub case: &'static str,
    /// Name of the method.
    pub method: &'static str,
    /// What is measured; if the case failed, why.
    pub measure: String,
    /// Largest value allowed.
    pub bound: f64,
    /// The value; NaN if the case failed.
    pub value: f64,
    /// Whether the value keeps the bound.
    pub holds: bool,
    /// What could go wrong.
    pub hazard: &'static str,
    /// Where the bound comes from.
    pub bound_from: &'static str,
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
