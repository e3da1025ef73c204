//! `flow`.

use compare::study::flow::states;
use pyo3::prelude::*;

use crate::array::{Array, Numbers, Show};
use crate::background::in_background;
use crate::instant::{Asked, Finder, Pair};
use crate::model::Model;
use crate::scene::Scene;

/// The pair, velocity and pressure at each point in the order of rows, and the estimate of the error of the velocity.
type Flow<'py> = (Pair, Array<'py>, Array<'py>, f64);

/// The flow about a pair at some points.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they have names in Python")]
#[pyo3(signature = (scene, points, model, time, gap, closest, show))]
pub(crate) fn flow<'py>(
    py: Python<'py>,
    scene: &Bound<'py, Scene>,
    points: Numbers<'py>,
    model: &Bound<'py, Model>,
    time: Option<f64>,
    gap: Option<f64>,
    closest: bool,
    show: Option<Show<'py>>,
) -> PyResult<Flow<'py>> {
    let points = points.points("points")?;
    let finder = Finder::new(scene.get(), model.get(), Asked::new(time, gap, closest))?;
    let (pair, states, error) = in_background(py, show.as_ref(), move || {
        let found = finder.find()?;
        let flow = found.fluid.flow(&found.pair)?;
        let states = states(flow.as_ref(), &points)?;
        Ok((
            Pair::new(found.t, found.pair),
            states,
            flow.error_estimate(),
        ))
    })?;
    let velocity = Array::vectors(py, states.iter().map(|state| state.velocity))?;
    let pressure = Array::line(py, states.iter().map(|state| state.pressure));
    Ok((pair, velocity, pressure, error))
}
