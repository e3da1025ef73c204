//! Deflections by every method side by side, against the exact ones.

use serde::Serialize;

use crate::columns::columns;
use crate::{Case, Encounter, Method};

columns! {
    /// A row for each encounter and squirmer. NaN if a run failed or the method was not requested.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct ComparisonRow {
        /// Name of the approach: `head-on` or `orthogonal`.
        #[unit = "-"]
        pub case: String,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Offset of the two paths in the plane; for opposed paths the distance between them.
        #[unit = "a"]
        pub dx: f64,
        /// Number of the squirmer, 1 or 2.
        #[unit = "-"]
        pub squirmer: usize,
        /// Deflection by lubrication theory as published.
        #[unit = "deg"]
        pub lt_deg: f64,
        /// Deflection by lubrication theory with the corrected coefficient.
        #[unit = "deg"]
        pub lt_corrected_deg: f64,
        /// Deflection by boundary elements.
        #[unit = "deg"]
        pub bem_deg: f64,
        /// Deflection by exact hydrodynamics.
        #[unit = "deg"]
        pub exact_deg: f64,
        /// Deflection by lubrication theory as published, minus the exact one.
        #[unit = "deg"]
        pub lt_error_deg: f64,
        /// Deflection by corrected lubrication theory, minus the exact one.
        #[unit = "deg"]
        pub lt_corrected_error_deg: f64,
        /// Deflection by boundary elements, minus the exact one.
        #[unit = "deg"]
        pub bem_error_deg: f64,
        /// Outcome by lubrication theory as published, then outcome by exact hydrodynamics, with ` / ` between. A dash
        /// for a method that was not requested.
        #[unit = "-"]
        pub outcomes: String,
    }
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

#[cfg(test)]
mod tests;
