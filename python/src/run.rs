//! `run`.

use std::time::Instant;

use ::scene::nalgebra::Vector3;
use ::scene::{Plan, Run as Native, RunOptions, Sample};
use compare::Model as Ready;
use compare::scene_file::SAMPLE_INTERVAL;
use pyo3::prelude::*;

use crate::array::Array;
use crate::background::{in_background, listen, tell};
use crate::error::of_scene;
use crate::model::Model;
use crate::scene::Scene;

/// Time up to which a run by a table or a closed form takes no longer than a moment.
const SHORT: f64 = 1e4;

/// A run from start to end; `squirmers.Trajectory` shows it.
#[pyclass(frozen, module = "squirmers._native")]
pub(crate) struct Run {
    run: Native,
    seconds: f64,
}

impl Run {
    /// A number for each sample.
    fn line<'py>(&self, py: Python<'py>, of: impl Fn(&Sample) -> f64) -> Array<'py> {
        Array::line(py, self.run.samples.iter().map(of))
    }

    /// A vector for each sample and squirmer.
    fn vectors<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&Sample) -> [Vector3<f64>; 2],
    ) -> PyResult<Array<'py>> {
        let samples = &self.run.samples;
        let flat = (samples.iter().flat_map(of)).flat_map(<[f64; 3]>::from);
        Array::shaped(py, flat.collect(), [samples.len(), 2, 3])
    }
}

#[pymethods]
impl Run {
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> Array<'py> {
        self.line(py, |sample| sample.t)
    }

    #[getter]
    fn gap<'py>(&self, py: Python<'py>) -> Array<'py> {
        self.line(py, |sample| sample.configuration.gap.eps())
    }

    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        self.vectors(py, |sample| sample.configuration.positions())
    }

    #[getter]
    fn orientations<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        self.vectors(py, |sample| sample.configuration.orientations)
    }

    #[getter]
    fn angles_deg<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let samples = &self.run.samples;
        let angles = (samples.iter())
            .flat_map(|sample| sample.configuration.angles_rad.map(f64::to_degrees));
        Array::shaped(py, angles.collect(), [samples.len(), 2])
    }

    #[getter]
    fn outcome(&self) -> String {
        self.run.outcome.to_string()
    }

    #[getter]
    fn deflections_deg<'py>(&self, py: Python<'py>) -> Array<'py> {
        Array::line(py, self.run.deflections_rad().map(f64::to_degrees))
    }

    #[getter]
    fn truncation_deg(&self) -> f64 {
        self.run.truncation_rad.to_degrees()
    }

    #[getter]
    fn end_time(&self) -> f64 {
        self.run.end_time
    }

    #[getter]
    fn min_gap(&self) -> f64 {
        self.run.min_gap
    }

    #[getter]
    fn tau(&self) -> f64 {
        self.run.contact_time
    }

    #[getter]
    fn settled(&self) -> Option<f64> {
        self.run.settled
    }

    #[getter]
    fn steps(&self) -> u64 {
        self.run.counters.steps
    }

    #[getter]
    fn seconds(&self) -> f64 {
        self.seconds
    }
}

/// Runs a plan, with its samples.
fn sampled(model: &Ready, plan: &Plan, options: &RunOptions) -> Result<Run, ::scene::SceneError> {
    let began = Instant::now();
    let mut samples = Vec::new();
    let run = model.run_observed(plan, options, &mut |sample| samples.push(*sample))?;
    Ok(Run {
        run: Native { samples, ..run },
        seconds: began.elapsed().as_secs_f64(),
    })
}

/// The run options of a scene, with what is given in place of its own.
fn options(
    own: RunOptions,
    given: [Option<f64>; 4],
    (samples, interval): (bool, Option<f64>),
    max_steps: Option<usize>,
) -> RunOptions {
    let [end_time, tolerance, departure_distance, angles_at] = given;
    RunOptions {
        end_time: end_time.unwrap_or(own.end_time),
        tolerance: tolerance.unwrap_or(own.tolerance),
        departure_distance: departure_distance.unwrap_or(own.departure_distance),
        angles_at: angles_at.unwrap_or(own.angles_at),
        sample_interval: samples
            .then(|| interval.or(own.sample_interval).unwrap_or(SAMPLE_INTERVAL)),
        max_steps: max_steps.unwrap_or(own.max_steps),
    }
}

/// Runs a scene under a model.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they have names in Python")]
#[pyo3(signature = (scene, model, *, end_time=None, tolerance=None, departure_distance=None, angles_at=None, sample_interval=None, samples=true, max_steps=None))]
pub(crate) fn run(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    model: &Bound<'_, Model>,
    end_time: Option<f64>,
    tolerance: Option<f64>,
    departure_distance: Option<f64>,
    angles_at: Option<f64>,
    sample_interval: Option<f64>,
    samples: bool,
    max_steps: Option<usize>,
) -> PyResult<Run> {
    let scene = scene.get();
    let options = options(
        scene.run,
        [end_time, tolerance, departure_distance, angles_at],
        (samples, sample_interval),
        max_steps,
    );
    let plan = Plan::new(&scene.scene).map_err(of_scene)?;
    let model = model
        .get()
        .for_ratio(py, plan.load_set(), scene.scene.ratio())?;
    if model.is_direct() || options.end_time > SHORT {
        return in_background(py, None, move || Ok(sampled(&model, &plan, &options)?));
    }
    listen();
    let run = py
        .detach(|| sampled(&model, &plan, &options))
        .map_err(of_scene)?;
    tell(py)?;
    Ok(run)
}
