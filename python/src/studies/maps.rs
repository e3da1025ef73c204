//! `scatter` and `fates`: maps over the incoming angles.

use std::path::PathBuf;

use compare::output::csv_text;
use compare::study::maps::{self, Grid, Maps, Pair};
use compare::sweep::SweepOptions;
use compare::{CompareError, Model as Ready, OutputFolder, Reads};
use pyo3::prelude::*;

use super::{Place, Setters, columns_of, list, options, whole, written};
use crate::array::{Numbers, Show};
use crate::background::in_background;
use crate::error::raised;
use crate::model::Model;
use crate::table::{Parts, parts};

/// What Python says of maps, checked.
struct Given {
    setters: Setters,
    pairs: Vec<Pair>,
    grid: Grid,
    options: SweepOptions,
    place: Place,
}

impl Given {
    fn new(
        models: &[Bound<'_, Model>],
        (beta, g): (&Numbers<'_>, &Numbers<'_>),
        grid: i64,
        run: (f64, f64),
        time_limit: Option<f64>,
        place: Place,
    ) -> PyResult<Self> {
        let setters = Setters::of(models)?;
        let g = list("g", g)?;
        let of_beta = |beta: f64| g.iter().map(move |&g| Pair { beta, g, dz: 0.0 });
        let time_limit = place.time_limit(time_limit)?;
        Ok(Self {
            pairs: list("beta", beta)?.into_iter().flat_map(of_beta).collect(),
            grid: Grid::new(whole("grid", grid)?).map_err(raised)?,
            options: options(&setters.methods(), run, time_limit)?,
            setters,
            place,
        })
    }

    /// What `write` writes to the file `NAME.csv` of the folder, and reads from it.
    ///
    /// # Errors
    /// [`CompareError::Stopped`] if the time limit left something out; the errors of `write`.
    fn text(
        self,
        name: &'static str,
        write: impl FnOnce(&Maps<'_>, &OutputFolder) -> Result<bool, CompareError>,
    ) -> Result<String, CompareError> {
        let out = self.place.open()?;
        let mut reads = Reads::default();
        for scene in maps::unsymmetric_starts(&self.pairs) {
            reads.add(&scene?)?;
        }
        let models = self.setters.set_up(&reads)?;
        let maps = Maps {
            name,
            models: models.iter().collect(),
            exact: None,
            pairs: self.pairs,
            grid: self.grid,
            options: self.options,
            out: &out,
        };
        if !write(&maps, &out)? {
            out.account().verdict()?;
        }
        written(&out, &format!("{name}.csv"))
    }
}

/// Maps over the incoming angles: a row for each run.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they have names in Python")]
#[pyo3(signature = (beta, models, *, g, grid, out, fresh, tolerance, angles_at, time_limit, show))]
pub(crate) fn scatter<'py>(
    py: Python<'py>,
    beta: Numbers<'py>,
    models: Vec<Bound<'py, Model>>,
    g: Numbers<'py>,
    grid: i64,
    out: Option<PathBuf>,
    fresh: bool,
    tolerance: f64,
    angles_at: f64,
    time_limit: Option<f64>,
    show: Option<Show<'py>>,
) -> PyResult<Parts> {
    let place = Place { out, fresh };
    let run = (tolerance, angles_at);
    let given = Given::new(&models, (&beta, &g), grid, run, time_limit, place)?;
    let text = in_background(py, show.as_ref(), move || {
        given.text("scatter", |maps, _| {
            maps.scatter(&mut |_: &Ready, _, _| Ok::<_, CompareError>(()))
        })
    })?;
    parts(py, text, columns_of("scatter.csv"))
}

/// Maps over the incoming angles: the shares of the outcomes.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they have names in Python")]
#[pyo3(signature = (beta, models, *, g, grid, out, fresh, tolerance, angles_at, time_limit, show))]
pub(crate) fn fates<'py>(
    py: Python<'py>,
    beta: Numbers<'py>,
    models: Vec<Bound<'py, Model>>,
    g: Numbers<'py>,
    grid: i64,
    out: Option<PathBuf>,
    fresh: bool,
    tolerance: f64,
    angles_at: f64,
    time_limit: Option<f64>,
    show: Option<Show<'py>>,
) -> PyResult<Parts> {
    let place = Place { out, fresh };
    let run = (tolerance, angles_at);
    let given = Given::new(&models, (&beta, &g), grid, run, time_limit, place)?;
    let text = in_background(py, show.as_ref(), move || {
        given.text("fates", |maps, out| match maps.fates()? {
            Some(rows) => {
                out.write("fates.csv", &csv_text(&rows)?)?;
                Ok(true)
            }
            None => Ok(false),
        })
    })?;
    parts(py, text, columns_of("fates.csv"))
}
