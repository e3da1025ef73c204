//! The table of costs and errors of each method.

use super::Table;
use super::table::Cell;

/// Cost and errors of a method.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MethodCost {
    /// Name of the method.
    pub method: String,
    /// Wall-clock time of building its table, in seconds.
    pub set_up_seconds: f64,
    /// Gaps at which its loads were computed for the table.
    pub gaps_evaluated: usize,
    /// Estimated error of interpolation in the table; NaN without a table.
    pub interpolation_error: f64,
    /// What limits the accuracy of the table: the requested tolerance or the model's own noise.
    pub limit: String,
    /// Gaps near contact, in radii, and the model's own estimate of its relative error there.
    pub error_at_contact: Vec<(f64, f64)>,
    /// Wall-clock time of a run, in seconds.
    pub seconds_per_run: f64,
}

impl MethodCost {
    /// The table of all methods, with a column for each gap near contact.
    #[must_use]
    pub fn table(costs: &[Self]) -> Table {
        let mut gaps: Vec<f64> = (costs.iter())
            .flat_map(|cost| cost.error_at_contact.iter().map(|(gap, _)| *gap))
            .collect();
        gaps.sort_by(|a, b| b.total_cmp(a));
        gaps.dedup_by(|a, b| a.total_cmp(b).is_eq());
        let mut headers: Vec<String> = [
            "method",
            "set_up_seconds",
            "gaps_evaluated",
            "interpolation_error",
            "limit",
            "seconds_per_run",
        ]
        .map(str::to_owned)
        .into();
        headers.extend(gaps.iter().map(|gap| format!("error_at_gap_{gap}")));
        let rows = costs.iter().map(|cost| {
            let mut row = vec![
                Cell::Text(cost.method.clone()),
                Cell::Number(cost.set_up_seconds),
                Cell::Count(cost.gaps_evaluated),
                Cell::Number(cost.interpolation_error),
                Cell::Text(cost.limit.clone()),
                Cell::Number(cost.seconds_per_run),
            ];
            row.extend(gaps.iter().map(|gap| {
                let there = |(at, _): &&(f64, f64)| at.total_cmp(gap).is_eq();
                let error = cost.error_at_contact.iter().find(there);
                Cell::Number(error.map_or(f64::NAN, |(_, error)| *error))
            }));
            row
        });
        Table::from_cells(
            "Cost and errors of each method",
            "methods.csv",
            headers,
            rows,
        )
    }
}
