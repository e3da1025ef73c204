//! `squirmers loads`: the loads of a pair at some gaps, each with an error estimate.

use bem::Bem;
use scene::{Gap, Hydrodynamics, LoadSet};
use serde::Serialize;

use super::many::{PRINTED, print_rest};
use super::shared::model_options;
use crate::arguments::{GeneralArguments, ModelArguments};
use crate::error::CommandError;
use crate::terminal::print_rows;
use compare::numbers::{rounded, size, written};
use compare::output::{OutputFolder, csv_text};
use compare::watch::{Pieces, Progress};
use compare::{Method, Model, ModelOptions, Numbers};

/// Largest number of gaps at which every load is solved for. With more gaps a table is faster.
const SOLVED: usize = 40;

#[derive(Serialize)]
struct LoadRow {
    method: &'static str,
    gap: f64,
    name: String,
    value: f64,
    /// The model's own error estimate, relative to the larger of the load and 1; `none` for a closed form, which has no
    /// estimate.
    error_estimate: String,
}

/// Name, value and error estimate of a load.
type Estimated = (String, f64, Option<f64>);

/// The loads of a method at a gap.
type Estimator = Box<dyn Fn(Gap) -> Result<Vec<Estimated>, CommandError>>;

pub(super) fn run(
    gaps: &Numbers,
    set: LoadSet,
    arguments: &ModelArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, mut options) = model_options(arguments, &Method::DEFAULT, general)?;
    options.tabulated = set;
    options.direct |= gaps.0.len() <= SOLVED;
    let gaps: Vec<_> = (gaps.0.iter())
        .map(|&eps| {
            Gap::new(eps).map_err(|_| {
                let allowed = "gaps must be greater than 0 and finite (commas separate them, decimals take a point)";
                CommandError::input("--gap", format!("{eps:?}"), allowed)
            })
        })
        .collect::<Result<_, _>>()?;
    // Several of these commands may write at once, because each writes a whole file.
    let out = OutputFolder::open_beside_others(&general.out)?;
    let mut rows = Vec::new();
    for &method in &methods {
        check_range(method, &options, &gaps)?;
        let at = estimator(method, set, &options)?;
        let progress = Progress::begin("gaps", gaps.len(), Pieces::Alike);
        for &gap in &gaps {
            rows.extend(at(gap)?.into_iter().map(|(name, value, error)| LoadRow {
                method: method.name(),
                gap: gap.eps(),
                name,
                value,
                error_estimate: error.map_or("none".to_owned(), size),
            }));
            progress.advance();
        }
    }
    out.write("loads.csv", &csv_text(&rows)?)?;
    print_rows(
        &["method", "gap", "load", "value", "error estimate"],
        rows.iter().take(PRINTED).map(|row| {
            vec![
                row.method.to_owned(),
                written(row.gap),
                row.name.clone(),
                rounded(row.value, 9),
                row.error_estimate.clone(),
            ]
        }),
    );
    print_rest(rows.len(), "loads");
    Ok(())
}

/// The source of the loads of a method. Boundary elements without a table estimate the error of each load.
fn estimator(
    method: Method,
    set: LoadSet,
    options: &ModelOptions,
) -> Result<Estimator, CommandError> {
    if method == Method::Bem && options.direct {
        let bem = Bem::new(options.mesh)?;
        return Ok(Box::new(move |gap| {
            let (solution, estimates) = bem.solve_with_estimates(gap, set)?;
            let values = (solution.loads.named().into_iter()).chain(solution.swirl.named());
            let errors = (estimates.loads.named().into_iter()).chain(estimates.swirl.named());
            Ok(values
                .zip(errors)
                .map(|((name, value), (_, error))| {
                    (name, value, Some(error / value.abs().max(1.0)))
                })
                .collect())
        }));
    }
    let model = Model::set_up(method, options)?;
    Ok(Box::new(move |gap| {
        let (loads, swirl) = model.loads_with_swirl(gap, set)?;
        let error = model.error_estimate(gap, set)?;
        let named = loads.named().into_iter().chain(swirl.named());
        Ok(named.map(|(name, value)| (name, value, error)).collect())
    }))
}

/// Refuses gaps outside the method's range, before anything is computed.
fn check_range(method: Method, options: &ModelOptions, gaps: &[Gap]) -> Result<(), CommandError> {
    for &gap in gaps {
        method.check_gap(options.mesh, gap).map_err(|error| {
            CommandError::input("--gap", format!("{:?}", gap.eps()), error.to_string())
        })?;
    }
    Ok(())
}
