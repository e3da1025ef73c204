//! `stresslet` and `stresses`.

use ::scene::LoadSet;
use ::scene::nalgebra::Matrix3;
use compare::study::stress::{Instant, stress_rows};
use pyo3::prelude::*;

use crate::array::{Array, Numbers, Show};
use crate::background::in_background;
use crate::instant::{Asked, Finder, Pair};
use crate::loads::{Arrays, arrays, by_gap, checked_gaps, checked_modes, checked_ratio, direct};
use crate::model::Model;
use crate::scene::Scene;

/// Stresslets and power of a pair; `squirmers.Stresslet` shows them.
#[pyclass(frozen, module = "squirmers._native")]
pub(crate) struct Stresslet(Instant);

/// A matrix for each of two squirmers.
fn matrices<'py>(py: Python<'py>, of: [Matrix3<f64>; 2]) -> PyResult<Array<'py>> {
    // They are symmetric: columns are rows.
    let flat = of.iter().flat_map(|matrix| matrix.iter().copied());
    Array::shaped(py, flat.collect(), [2, 3, 3])
}

#[pymethods]
impl Stresslet {
    #[getter]
    fn pair(&self) -> Pair {
        Pair::new(self.0.t, self.0.pair)
    }

    #[getter]
    fn stresslets<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        matrices(py, self.0.stress.stresslets)
    }

    #[getter]
    fn lone<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        matrices(py, self.0.lone)
    }

    #[getter]
    fn slip_power<'py>(&self, py: Python<'py>) -> Array<'py> {
        Array::line(py, self.0.stress.slip_power)
    }

    #[getter]
    fn external_power(&self) -> f64 {
        self.0.pair.external_power()
    }

    #[getter]
    fn dissipation(&self) -> f64 {
        self.0.stress.dissipation
    }

    #[getter]
    fn efficiencies<'py>(&self, py: Python<'py>) -> Array<'py> {
        Array::line(py, self.0.efficiencies())
    }

    #[getter]
    fn budget(&self) -> f64 {
        self.0.budget()
    }
}

/// Stresslets and power of a pair at an instant.
#[pyfunction]
#[pyo3(signature = (scene, model, time, gap, closest, show))]
pub(crate) fn stresslet(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    model: &Bound<'_, Model>,
    time: Option<f64>,
    gap: Option<f64>,
    closest: bool,
    show: Option<Show<'_>>,
) -> PyResult<Stresslet> {
    let finder = Finder::new(scene.get(), model.get(), Asked::new(time, gap, closest))?;
    let found = in_background(py, show.as_ref(), move || {
        let found = finder.find()?;
        Instant::solved(found.fluid.as_ref(), found.t, found.pair)
    })?;
    Ok(Stresslet(found))
}

/// Stresslets and rates of work at gaps, each solved for.
#[pyfunction]
#[pyo3(signature = (model, gaps, modes, swirl_modes, ratio, show))]
pub(crate) fn stresses<'py>(
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
    let modes = (
        checked_modes("modes", modes)?,
        checked_modes("swirl_modes", swirl_modes)?,
    );
    let (method, options) = (model.method(), direct(model, LoadSet::all(0), ratio));
    let count = gaps.len();
    let found = in_background(py, show.as_ref(), move || {
        let rows = stress_rows(&[method], &gaps, modes, &options)?;
        let cells = (rows.into_iter()).map(|row| (row.name, row.value, row.error_estimate));
        Ok(by_gap(cells, count))
    })?;
    arrays(py, found, count)
}
