//! A scorecard as JSON.

use serde::Serialize;

use super::{Scorecard, TRUST};
use crate::submission::Header;

/// A scorecard as JSON, in which NaN is null.
#[derive(Debug, Serialize)]
pub struct Judged<'a> {
    model: &'a str,
    header: &'a Header,
    faultless: bool,
    verdict: Vec<String>,
    trusted_down_to: Vec<Option<f64>>,
    faults: Vec<JudgedFault>,
    rows: Vec<JudgedRow>,
}

#[derive(Debug, Serialize)]
struct JudgedFault {
    kind: &'static str,
    items: Vec<String>,
    number: f64,
    worst_error: f64,
    at_gap: f64,
    sentence: String,
}

/// As a row of the CSV.
#[derive(Debug, Serialize)]
struct JudgedRow {
    measure: &'static str,
    case: String,
    value: f64,
    unit: &'static str,
}

impl Scorecard {
    /// As JSON.
    #[must_use]
    pub fn judged(&self) -> Judged<'_> {
        Judged {
            model: &self.name,
            header: &self.header,
            faultless: self.is_faultless(),
            verdict: self.verdict(),
            trusted_down_to: TRUST.iter().map(|&bound| self.trusted(bound)).collect(),
            faults: (self.faults.iter())
                .map(|fault| JudgedFault {
                    kind: fault.kind.name(),
                    items: fault.items().iter().map(ToString::to_string).collect(),
                    number: fault.kind.number(),
                    worst_error: fault.worst().0,
                    at_gap: fault.worst().1,
                    sentence: fault.sentence(),
                })
                .collect(),
            rows: (self.rows().into_iter())
                .map(|row| JudgedRow {
                    measure: row.measure,
                    case: row.case,
                    value: row.value,
                    unit: row.unit,
                })
                .collect(),
        }
    }
}
