//! `bound_states`.

use compare::output::csv_text;
use compare::study::maps::bound_rows;
use pyo3::prelude::*;

use super::{Setters, columns_of, list, usual};
use crate::array::Numbers;
use crate::background::in_background;
use crate::model::Model;
use crate::table::{Parts, parts};

/// The bound states of every model and squirmer parameter.
#[pyfunction]
#[pyo3(signature = (models, beta))]
pub(crate) fn bound_states<'py>(
    py: Python<'py>,
    models: Vec<Bound<'py, Model>>,
    beta: Numbers<'py>,
) -> PyResult<Parts> {
    let (setters, betas) = (Setters::of(&models)?, list("beta", &beta)?);
    let text = in_background(py, None, move || {
        let models = setters.set_up(&usual())?;
        let models: Vec<_> = models.iter().collect();
        csv_text(&bound_rows(&models, &betas)?)
    })?;
    parts(py, text, columns_of("bound-states.csv"))
}
