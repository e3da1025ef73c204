//! The section on errors: loads and deflections of every method against the exact ones.

use serde::Serialize;

use super::{LOADS, findings, words};
use crate::error::CommandError;
use crate::figures;
use crate::page::{Figure, Section, Table};
use compare::output::{OutputFolder, csv_text};
use compare::sweep::SweepOptions;
use compare::{Encounter, LoadErrorRow, Method, Model, ModelOptions, comparison, load_errors};

/// Errors of the loads and deflections of each method. Both forms of lubrication theory are always shown here,
/// because their loads take no time.
pub(super) fn section(
    models: &[Model],
    exact: &Model,
    mut encounters: Vec<Encounter>,
    sweep: &SweepOptions,
    out: &OutputFolder,
) -> Result<Section, CommandError> {
    let mut extra = Vec::new();
    for method in [Method::Lt, Method::LtCorrected] {
        if models.iter().all(|model| model.method() != method) {
            extra.push(Model::set_up(method, &ModelOptions::default())?);
        }
    }
    let cases: Vec<_> = (encounters.iter())
        .filter(|encounter| encounter.method == Method::Exact)
        .map(|encounter| encounter.case)
        .collect();
    let more = compare::encounters(&extra, &cases, sweep);
    out.account()
        .enter(more.iter().map(|encounter| &encounter.run));
    encounters.extend(more);
    let mut judged: Vec<_> = models.iter().chain(&extra).collect();
    judged.sort_by_key(|model| model.method());

    let errors = load_errors(&judged, exact, LOADS)?;
    let slopes = findings::slopes((judged.iter()).map(|model| (model.method(), &***model)))?;
    let errors_csv = csv_text(&errors)?;
    out.write("load-errors.csv", &errors_csv)?;
    let svg = figures::load_errors(&errors)?;
    out.write("load-errors.svg", &svg)?;
    let comparison_csv = csv_text(&comparison(&encounters))?;
    out.write_unless_less("comparison.csv", &comparison_csv)?;
    Ok(Section {
        id: "errors".to_owned(),
        title: "How far each method is from the exact answer".to_owned(),
        finding: findings::of_loads(&errors),
        prose: vec![words::ERRORS.to_owned(), slopes],
        figures: vec![Figure {
            svg,
            caption: words::caption("load-errors").to_owned(),
        }],
        tables: vec![
            Table {
                csv: errors_csv,
                file_name: "load-errors.csv".to_owned(),
                ..Table::from_rows(
                    "Largest error of all loads of modes 1 and 2, and the name of this load. The \
                     linked file has every load at every gap.",
                    "load-errors.csv",
                    &worst_loads(&errors),
                )?
            },
            Table::from_csv(
                "Deflections by every method, their differences from the exact ones, and outcomes by \
                 lubrication theory as published / by exact hydrodynamics.",
                "comparison.csv",
                &comparison_csv,
            )?,
        ],
    })
}

/// One line of the summary of load errors.
#[derive(Serialize)]
struct WorstLoad {
    method: Method,
    gap: f64,
    worst_error: f64,
    load: String,
}

/// The load with the largest error, for each method, at gaps that are powers of ten.
fn worst_loads(errors: &[LoadErrorRow]) -> Vec<WorstLoad> {
    (errors.chunk_by(|a, b| a.method == b.method && a.gap.total_cmp(&b.gap).is_eq()))
        .filter(|of_gap| (of_gap[0].gap.log10() - of_gap[0].gap.log10().round()).abs() < 1e-9)
        .filter_map(|of_gap| of_gap.iter().max_by(|a, b| a.error.total_cmp(&b.error)))
        .map(|row| WorstLoad {
            method: row.method,
            gap: row.gap,
            worst_error: row.error,
            load: row.name.clone(),
        })
        .collect()
}
