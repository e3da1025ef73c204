//! Deflections by every method side by side, against the exact ones.

use serde::Serialize;

use crate::{Case, Encounter, Method};

/// One line of `comparison.csv`: the deflection of one squirmer by every method, in degrees, and its difference from
/// the exact one. NaN if a run failed or was not requested.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ComparisonRow {
    /// Name of the approach.
    pub case: String,
    /// Squirmer parameter.
    pub beta: f64,
    /// Offset of the paths, in radii.
    pub dx: f64,
    /// Which squirmer, 1 or 2.
    pub squirmer: usize,
    /// Lubrication theory as published.
    pub lt_deg: f64,
    /// Lubrication theory corrected.
    pub lt_corrected_deg: f64,
    /// Boundary elements.
    pub bem_deg: f64,
    /// Exact hydrodynamics.
    pub exact_deg: f64,
    /// Error of lubrication theory as published.
    pub lt_error_deg: f64,
    /// Error of lubrication theory corrected.
    pub lt_corrected_error_deg: f64,
    /// Error of boundary elements.
    pub bem_error_deg: f64,
    /// Outcome by lubrication theory as published, and outcome by exact hydrodynamics.
    pub outcomes: String,
}

/// Compares encounters by several methods, case by case.
#[must_use]
pub fn comparison(encounters: &[Encounter]) -> Vec<ComparisonRow> {
    let mut cases: Vec<Case> = Vec::new();
    for encounter in encounters {
        if !cases.contains(&encounter.case) {
            cases.push(encounter.case);
        }
    }
    (cases.iter())
        .flat_map(|case| [0, 1].map(|k| comparison_row(encounters, case, k)))
        .collect()
}

fn comparison_row(encounters: &[Encounter], case: &Case, k: usize) -> ComparisonRow {
    let of = |method: Method| {
        (encounters.iter()).find(|encounter| encounter.case == *case && encounter.method == method)
    };
    let angle = |method: Method| {
        let run = of(method).and_then(|encounter| encounter.run.as_ref().ok());
        run.map_or(f64::NAN, |run| run.deflections_rad()[k].to_degrees())
    };
    let outcome = |method: Method| of(method).map_or("–".to_owned(), Encounter::outcome);
    let exact = angle(Method::Exact);
    ComparisonRow {
        case: case.approach.to_string(),
        beta: case.beta,
        dx: case.dx,
        squirmer: k + 1,
        lt_deg: angle(Method::Lt),
        lt_corrected_deg: angle(Method::LtCorrected),
        bem_deg: angle(Method::Bem),
        exact_deg: exact,
        lt_error_deg: angle(Method::Lt) - exact,
        lt_corrected_error_deg: angle(Method::LtCorrected) - exact,
        bem_error_deg: angle(Method::Bem) - exact,
        outcomes: format!("{} / {}", outcome(Method::Lt), outcome(Method::Exact)),
    }
}
