//! Loads and coefficients of motion by gap.

use ::scene::mobility::MobilitySet;
use ::scene::{ActiveLoads, Gap, LoadSet, MAX_MODES, RATIOS, are_unlike, balance};
use compare::{CompareError, Model as Ready, ModelOptions, load_rows};
use pyo3::prelude::*;

use crate::array::{Array, Numbers, Show};
use crate::background::in_background;
use crate::error::{input, of_scene, raised};
use crate::model::Model;

/// Names, and for each gap a row of values and one of error estimates, which are NaN where there is none.
pub(crate) type ByGap = (Vec<String>, Vec<f64>, Vec<f64>);

/// Names, values and error estimates as arrays of a row for each gap.
pub(crate) type Arrays<'py> = (Vec<String>, Array<'py>, Array<'py>);

/// Gaps of one dimension, within the range of the model.
pub(crate) fn checked_gaps(model: &Model, gaps: &Numbers<'_>, ratio: f64) -> PyResult<Vec<Gap>> {
    let mesh = model.options().mesh;
    let checked = |eps: f64| {
        let gap = Gap::new(eps).map_err(of_scene)?;
        model.method().check_gap(mesh, ratio, gap).map_err(raised)?;
        Ok(gap)
    };
    gaps.list("gaps")?.into_iter().map(checked).collect()
}

pub(crate) fn checked_modes(what: &'static str, modes: usize) -> PyResult<usize> {
    if modes > MAX_MODES {
        let allowed = format!("modes go from 0 (none) to {MAX_MODES}");
        return Err(input(what, modes, allowed));
    }
    Ok(modes)
}

pub(crate) fn checked_ratio(ratio: f64) -> PyResult<f64> {
    if !RATIOS.contains(&ratio) {
        let allowed = format!("give a number from {} to {}", RATIOS.start(), RATIOS.end());
        return Err(input("ratio", format!("{ratio:?}"), allowed));
    }
    Ok(ratio)
}

/// The options of a model that solves at every gap.
pub(crate) fn direct(model: &Model, set: LoadSet, ratio: f64) -> ModelOptions {
    ModelOptions {
        direct: true,
        tabulated: set,
        ratios: vec![ratio],
        ..model.options().clone()
    }
}

pub(crate) fn arrays<'py>(
    py: Python<'py>,
    (names, values, errors): ByGap,
    gaps: usize,
) -> PyResult<Arrays<'py>> {
    let shape = [gaps, names.len()];
    let array = |flat: Vec<f64>| Array::shaped(py, flat, shape);
    let (values, errors) = (array(values)?, array(errors)?);
    Ok((names, values, errors))
}

/// Rows of the same numbers, each with its name and error, at each of some gaps.
pub(crate) fn by_gap(rows: impl Iterator<Item = (String, f64, String)>, gaps: usize) -> ByGap {
    let (mut names, mut values, mut errors) = ByGap::default();
    for (name, value, error) in rows {
        names.push(name);
        values.push(value);
        errors.push(error.parse().unwrap_or(f64::NAN));
    }
    names.truncate(names.len().checked_div(gaps).unwrap_or(0));
    (names, values, errors)
}

/// Loads at gaps, each solved for.
#[pyfunction]
#[pyo3(signature = (model, gaps, modes, swirl_modes, ratio, show))]
pub(crate) fn loads<'py>(
    py: Python<'py>,
    model: &Bound<'py, Model>,
    gaps: Numbers<'py>,
    modes: usize,
    swirl_modes: usize,
    ratio: f64,
    show: Option<Show<'py>>,
) -> PyResult<Arrays<'py>> {
    let model = model.get();
    let ratio = checked_ratio(ratio)?;
    let gaps = checked_gaps(model, &gaps, ratio)?;
    let set = LoadSet::all(checked_modes("modes", modes)?)
        .with_swirl(checked_modes("swirl_modes", swirl_modes)?);
    let (method, options) = (model.method(), direct(model, set, ratio));
    let count = gaps.len();
    let found = in_background(py, show.as_ref(), move || {
        let rows = load_rows(&[method], &gaps, set, &options)?;
        let cells = (rows.into_iter()).map(|row| (row.name, row.value, row.error_estimate));
        Ok(by_gap(cells, count))
    })?;
    arrays(py, found, count)
}

/// Coefficients of motion at gaps.
fn coefficients_at(
    model: &Ready,
    gaps: &[Gap],
    set: MobilitySet,
    ratio: f64,
) -> Result<ByGap, CompareError> {
    let (mut names, mut values) = (Vec::new(), Vec::new());
    model.foresee(gaps)?;
    for &gap in gaps {
        let named = if are_unlike(ratio) && model.is_cut(gap) {
            let lone = [ActiveLoads::isolated(set.loads); 2];
            balance::of_each(gap, ratio, &lone, set).named(set)
        } else if are_unlike(ratio) {
            model.interacting_mobility_of_each(gap, set)?.named(set)
        } else {
            model.mobility(gap, set)?.named(set)
        };
        names = named.iter().map(|(name, _)| name.clone()).collect();
        values.extend(named.iter().map(|(_, value)| *value));
    }
    let errors = vec![f64::NAN; values.len()];
    Ok((names, values, errors))
}

/// Coefficients of motion at gaps, each solved for.
#[pyfunction]
#[pyo3(signature = (model, gaps, modes, swirl_modes, ratio))]
pub(crate) fn coefficients<'py>(
    py: Python<'py>,
    model: &Bound<'py, Model>,
    gaps: Numbers<'py>,
    modes: usize,
    swirl_modes: usize,
    ratio: f64,
) -> PyResult<(Vec<String>, Array<'py>)> {
    let model = model.get();
    let ratio = checked_ratio(ratio)?;
    let gaps = checked_gaps(model, &gaps, ratio)?;
    let set = MobilitySet {
        loads: LoadSet::all(checked_modes("modes", modes)?)
            .with_swirl(checked_modes("swirl_modes", swirl_modes)?),
        torque: true,
    };
    let (method, options) = (model.method(), direct(model, set.loads, ratio));
    let count = gaps.len();
    let found = in_background(py, None, move || {
        coefficients_at(&Ready::set_up(method, &options)?, &gaps, set, ratio)
    })?;
    let (names, values, _) = arrays(py, found, count)?;
    Ok((names, values))
}
