//! `sweep` and `merge`.

use std::path::PathBuf;

use compare::sweep::{
    FamilySweep, Points, RunChoices, Share, checked_angles_at, checked_tolerance,
};
use pyo3::prelude::*;

use super::{Axes, Place, Setters, axes, columns_of, written};
use crate::array::Show;
use crate::background::in_background;
use crate::error::{raised, refused};
use crate::model::Model;
use crate::scene::{ModelArguments, as_arguments, family};
use crate::table::{Parts, parts};

/// Name, level and directness of the model that a family's file names.
#[pyfunction]
pub(crate) fn family_model(name: PathBuf) -> PyResult<Option<ModelArguments>> {
    let family = family(&name.to_string_lossy())?;
    Ok(family.hydrodynamics().map(as_arguments))
}

/// Runs a family along some of its parameters.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they have names in Python")]
#[pyo3(signature = (name, axes_of, models, *, out, fresh, partition, tolerance, angles_at, time_limit, show))]
pub(crate) fn sweep<'py>(
    py: Python<'py>,
    name: PathBuf,
    axes_of: Axes<'py>,
    models: Vec<Bound<'py, Model>>,
    out: Option<PathBuf>,
    fresh: bool,
    partition: Option<&str>,
    tolerance: Option<f64>,
    angles_at: f64,
    time_limit: Option<f64>,
    show: Option<Show<'py>>,
) -> PyResult<Parts> {
    let setters = Setters::of(&models)?;
    let place = Place { out, fresh };
    let time_limit = place.time_limit(time_limit)?;
    let choices = RunChoices {
        tolerance: (tolerance.map(checked_tolerance).transpose()).map_err(raised)?,
        angles_at: checked_angles_at(angles_at, &setters.methods()).map_err(raised)?,
    };
    let share: Share = match partition {
        Some(text) => text.parse().map_err(refused)?,
        None => Share::ALL,
    };
    let family = family(&name.to_string_lossy())?;
    let points = Points::new(family, &axes(&axes_of)?, choices).map_err(raised)?;
    let text = in_background(py, show.as_ref(), move || {
        let out = place.open()?;
        let reads = points.reads()?;
        let models = setters.set_up(&reads)?;
        let sweep = FamilySweep {
            points: &points,
            models: &models,
            loads: reads.loads,
            share,
            time_limit,
            out: &out,
        };
        sweep.run(&mut |_| {})?;
        written(&out, "sweep.csv")
    })?;
    parts(py, text, columns_of("sweep.csv"))
}

/// Merges the shares of a sweep. Also names the file of the rows, and says how many kinds of arithmetic they come from.
#[pyfunction]
#[pyo3(signature = (folders, out))]
pub(crate) fn merge(
    py: Python<'_>,
    folders: Vec<PathBuf>,
    out: Option<PathBuf>,
) -> PyResult<(Parts, String, usize)> {
    let place = Place { out, fresh: false };
    let (file, text, arithmetics) = in_background(py, None, move || {
        let out = place.open()?;
        let merged = compare::sweep::merge(&folders, &out)?;
        let text = written(&out, &merged.file)?;
        Ok((merged.file, text, merged.arithmetic.len()))
    })?;
    Ok((parts(py, text, columns_of(&file))?, file, arithmetics))
}
