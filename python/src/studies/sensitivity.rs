//! `sensitivity`: derivatives of collisions, and how far a squirmer can be offset out of the plane.

use std::path::PathBuf;

use compare::study::sensitivity::{DERIVATIVES, Part, SensitivityStudy, reads};
use compare::sweep::{Points, RunChoices, checked_tolerance};
use pyo3::prelude::*;

use super::{Axes, Place, Setters, axes, columns_of, written};
use crate::array::Show;
use crate::background::in_background;
use crate::error::raised;
use crate::model::Model;
use crate::scene::family;
use crate::table::{Parts, parts};

/// The rows of a file whose first column is the name of the family.
fn of_cases(py: Python<'_>, text: String, file: &str) -> PyResult<Parts> {
    let (mut columns, values, text) = parts(py, text, columns_of(file))?;
    if let Some((_, _, meaning)) = columns.first_mut() {
        *meaning = "Name of the family.".to_owned();
    }
    Ok((columns, values, text))
}

/// How sensitive collisions are: of a family along some of its parameters, or else of the paper's encounters.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they have names in Python")]
#[pyo3(signature = (name, axes_of, models, *, out, fresh, tolerance, time_limit, show))]
pub(crate) fn sensitivity<'py>(
    py: Python<'py>,
    name: Option<PathBuf>,
    axes_of: Axes<'py>,
    models: Vec<Bound<'py, Model>>,
    out: Option<PathBuf>,
    fresh: bool,
    tolerance: Option<f64>,
    time_limit: Option<f64>,
    show: Option<Show<'py>>,
) -> PyResult<(Parts, Parts)> {
    let setters = Setters::of(&models)?;
    let place = Place { out, fresh };
    let time_limit = place.time_limit(time_limit)?;
    let choices = RunChoices {
        tolerance: (tolerance.map(checked_tolerance).transpose()).map_err(raised)?,
        angles_at: f64::INFINITY,
    };
    let families = match name {
        Some(name) => {
            let family = family(&name.to_string_lossy())?;
            let case = name.file_stem().unwrap_or(name.as_os_str());
            vec![Part {
                case: case.to_string_lossy().into_owned(),
                points: Points::new(family, &axes(&axes_of)?, choices).map_err(raised)?,
            }]
        }
        None => Part::paper(choices).map_err(raised)?,
    };
    let (cases, derivatives) = in_background(py, show.as_ref(), move || {
        let out = place.open()?;
        let models = setters.set_up(&reads(&families)?)?;
        let study = SensitivityStudy {
            parts: &families,
            models: &models,
            time_limit,
            out: &out,
        };
        if !study.run(&mut |_| {})?.is_complete() {
            out.account().verdict()?;
        }
        Ok((
            written(&out, "sensitivity.csv")?,
            written(&out, DERIVATIVES)?,
        ))
    })?;
    Ok((
        of_cases(py, cases, "sensitivity.csv")?,
        of_cases(py, derivatives, DERIVATIVES)?,
    ))
}
