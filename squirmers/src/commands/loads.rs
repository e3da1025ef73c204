//! `squirmers loads`: the loads of a pair at some gaps, each with an error estimate.

use scene::{Gap, LoadSet};

use super::many::print_numbers;
use super::shared::{checked_ratios, model_options};
use crate::arguments::{GeneralArguments, ModelArguments};
use crate::error::CommandError;
use compare::output::{OutputFolder, csv_text};
use compare::{Method, ModelOptions, Numbers, load_rows};

pub(super) fn run(
    gaps: &Numbers,
    ratios: &Numbers,
    set: LoadSet,
    arguments: &ModelArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(arguments, &Method::DEFAULT, general)?;
    let options = ModelOptions {
        ratios: checked_ratios(ratios.0.clone())?,
        ..options
    };
    let gaps = checked_gaps(&gaps.0, &methods, &options)?;
    // Several of these commands may write at once, because each writes a whole file.
    let out = OutputFolder::open_beside_others(&general.out)?;
    let rows = load_rows(&methods, &gaps, set, &options)?;
    out.write("loads.csv", &csv_text(&rows)?)?;
    let numbers = rows.iter().map(|row| {
        let (name, error) = (row.name.as_str(), row.error_estimate.as_str());
        (row.method, row.ratio, row.gap, name, row.value, error)
    });
    print_numbers("load", "loads", numbers);
    Ok(())
}

/// The gaps, if every method resolves them.
pub(super) fn checked_gaps(
    gaps: &[f64],
    methods: &[Method],
    options: &ModelOptions,
) -> Result<Vec<Gap>, CommandError> {
    gaps.iter().map(|&eps| gap(eps, methods, options)).collect()
}

/// A gap that every method resolves.
fn gap(eps: f64, methods: &[Method], options: &ModelOptions) -> Result<Gap, CommandError> {
    let refused = |allowed: String| CommandError::input("--gap", format!("{eps:?}"), allowed);
    let gap = Gap::new(eps).map_err(|_| {
        let allowed =
            "gaps must be greater than 0 and finite (commas separate them, decimals take a point)";
        refused(allowed.to_owned())
    })?;
    for method in methods {
        for &ratio in &options.ratios {
            let checked = method.check_gap(options.mesh, ratio, gap);
            checked.map_err(|error| refused(error.to_string()))?;
        }
    }
    Ok(gap)
}
