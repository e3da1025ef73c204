//! `kinetics`: what collisions do to a dilute suspension.

use std::path::PathBuf;

use compare::CompareError;
use compare::output::csv_text;
use compare::study::kinetics::{KineticsRow, KineticsSweep, Sampling, ratios};
use pyo3::prelude::*;

use super::{Place, Setters, columns_of, list, options, usual, whole};
use crate::array::{Numbers, Show};
use crate::background::in_background;
use crate::error::raised;
use crate::model::Model;
use crate::table::{Parts, parts};

/// Collision integrals, and what each model makes of those of the exact one.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they have names in Python")]
#[pyo3(signature = (beta, models, *, impact, count, replications, out, fresh, tolerance, angles_at, time_limit, show))]
pub(crate) fn kinetics<'py>(
    py: Python<'py>,
    beta: Numbers<'py>,
    models: Vec<Bound<'py, Model>>,
    impact: Numbers<'py>,
    count: i64,
    replications: i64,
    out: Option<PathBuf>,
    fresh: bool,
    tolerance: f64,
    angles_at: f64,
    time_limit: Option<f64>,
    show: Option<Show<'py>>,
) -> PyResult<(Parts, Parts)> {
    let setters = Setters::of(&models)?;
    let place = Place { out, fresh };
    let time_limit = place.time_limit(time_limit)?;
    let options = options(&setters.methods(), (tolerance, angles_at), time_limit)?;
    let betas = list("beta", &beta)?;
    let impacts = list("impact", &impact)?;
    let (count, replications) = (whole("count", count)?, whole("replications", replications)?);
    let sampling = Sampling::new(&impacts, count, replications).map_err(raised)?;
    let (rows, against) = in_background(py, show.as_ref(), move || {
        let out = place.open()?;
        let models = setters.set_up(&usual())?;
        let sweep = KineticsSweep {
            models: &models,
            betas: &betas,
            sampling: &sampling,
            options,
            out: &out,
        };
        let Some(estimates) = sweep.run()? else {
            out.account().verdict()?;
            return Err(CompareError::Stopped { skipped: 0 });
        };
        let rows: Vec<KineticsRow> = estimates.iter().map(|of| of.row()).collect();
        let (rows, against) = (csv_text(&rows)?, csv_text(&ratios(&estimates))?);
        out.write("kinetics.csv", &rows)?;
        out.write("kinetics-ratios.csv", &against)?;
        Ok((rows, against))
    })?;
    Ok((
        parts(py, rows, columns_of("kinetics.csv"))?,
        parts(py, against, columns_of("kinetics-ratios.csv"))?,
    ))
}
