//! A pair at an instant of its run, moving as a model that knows the flow says.

use ::scene::{Fluid, MovingPair, Plan, RunOptions, Sample};
use compare::study::flow::{FlowStudy, Instant};
use compare::{CompareError, Reads};
use pyo3::prelude::*;

use crate::array::Array;
use crate::error::{of_scene, raised};
use crate::model::{Model, Setter};
use crate::scene::Scene;

/// The instant that is asked for.
#[derive(Clone, Copy)]
pub(crate) enum Asked {
    /// The start of the scene, to which nothing is run.
    Start,
    /// Found by a run.
    Within(Instant),
}

impl Asked {
    /// From what Python says, of which at most one is given.
    pub(crate) fn new(time: Option<f64>, gap: Option<f64>, closest: bool) -> Self {
        match (time, gap, closest) {
            (Some(t), ..) if t.abs() > 0.0 || t.is_nan() => Self::Within(Instant::Time(t)),
            (_, Some(gap), _) => Self::Within(Instant::Gap(gap)),
            (_, _, true) => Self::Within(Instant::ClosestApproach),
            _ => Self::Start,
        }
    }
}

/// Finds a pair at an instant, which may take long.
pub(crate) struct Finder {
    plan: Plan,
    run: RunOptions,
    fluid: Box<dyn Fluid>,
    setter: Setter,
    asked: Asked,
}

/// A pair at an instant, and the model that knows its flow.
pub(crate) struct Found {
    pub t: f64,
    pub pair: MovingPair,
    pub fluid: Box<dyn Fluid>,
}

impl Finder {
    /// Of a model that knows the flow.
    ///
    /// # Errors
    /// `InputError` for one that does not.
    pub(crate) fn new(scene: &Scene, model: &Model, asked: Asked) -> PyResult<Self> {
        let plan = Plan::new(&scene.scene).map_err(of_scene)?;
        let ratio = plan.scene().ratio();
        let fluid = model.method().fluid(model.options(), ratio);
        Ok(Self {
            plan,
            run: scene.run,
            fluid: fluid.map_err(raised)?,
            setter: model.setter(),
            asked,
        })
    }

    /// The pair.
    ///
    /// # Errors
    /// As [`FlowStudy::sample`] and [`MovingPair::free`].
    pub(crate) fn find(self) -> Result<Found, CompareError> {
        let Self { plan, fluid, .. } = self;
        let (sample, fluid) = match self.asked {
            Asked::Start => {
                let configuration = *plan.start();
                let t = 0.0;
                (Sample { t, configuration }, fluid)
            }
            Asked::Within(instant) => {
                let model = self.setter.set_up(&Reads {
                    loads: Some(plan.load_set()),
                    ratios: vec![plan.scene().ratio()],
                })?;
                let study = FlowStudy::of(model, fluid, plan.clone(), self.run);
                (study.sample(instant)?, study.into_fluid())
            }
        };
        let pair = MovingPair::free(&plan, fluid.as_ref(), &sample.configuration)?;
        let t = sample.t;
        Ok(Found { t, pair, fluid })
    }
}

/// A pair at one instant.
#[pyclass(frozen, module = "squirmers._native")]
pub(crate) struct Pair {
    t: f64,
    pair: MovingPair,
}

impl Pair {
    pub(crate) fn new(t: f64, pair: MovingPair) -> Self {
        Self { t, pair }
    }
}

#[pymethods]
impl Pair {
    #[getter]
    fn time(&self) -> f64 {
        self.t
    }

    #[getter]
    fn gap(&self) -> f64 {
        self.pair.configuration.gap.eps()
    }

    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        Array::vectors(py, self.pair.configuration.positions())
    }

    #[getter]
    fn orientations<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        Array::vectors(py, self.pair.configuration.orientations)
    }

    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        Array::vectors(py, self.pair.velocities)
    }

    #[getter]
    fn angular_velocities<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        Array::vectors(py, self.pair.angular_velocities)
    }
}
