//! The equation of motion at one configuration, as the plan has it.

use std::hint::black_box;

use super::dispatch::{Task, dispatch};
use super::equations::{Dynamics, Effect, PairMotion};
use crate::frame::{Configuration, Rates};
use crate::ode::System;
use crate::{Gravity, Hydrodynamics, Plan, Repulsion, SceneError};

/// How a configuration changes under a plan and a model, in the laboratory frame. The right-hand side
/// of the plan's own equation of motion is evaluated `times` times over (at least once), so that the
/// time of one can be measured.
///
/// The configuration must have the symmetry that the plan's state has: what breaks it is not seen.
///
/// # Errors
/// [`SceneError`] if the model cannot give the loads at the configuration's gap.
pub fn rates(
    plan: &Plan,
    model: &dyn Hydrodynamics,
    configuration: &Configuration,
    times: usize,
) -> Result<Rates, SceneError> {
    rates_monomorphic(plan, model, configuration, times)
}

/// As [`rates`], with a loop that is compiled for this type of model, see [`run_monomorphic`](crate::run_monomorphic).
///
/// # Errors
/// As [`rates`].
pub fn rates_monomorphic<H: Hydrodynamics + ?Sized>(
    plan: &Plan,
    model: &H,
    configuration: &Configuration,
    times: usize,
) -> Result<Rates, SceneError> {
    plan.check_ratio(model)?;
    let within = plan.plane().map(|plane| plane.within(configuration));
    let task = Evaluation {
        configuration: within.as_ref().unwrap_or(configuration),
        times,
    };
    let rates = dispatch(plan, model, task)?;
    Ok((plan.plane()).map_or(rates, |plane| plane.rates_outside(&rates)))
}

struct Evaluation<'a> {
    configuration: &'a Configuration,
    times: usize,
}

impl Task for Evaluation<'_> {
    type Output = Result<Rates, SceneError>;

    fn perform<H, C, R, G, const N: usize>(
        self,
        _: &Plan,
        mut motion: PairMotion<'_, H, C, R, G>,
    ) -> Self::Output
    where
        H: Hydrodynamics + ?Sized,
        C: Dynamics<N>,
        R: Effect<Repulsion>,
        G: Effect<Gravity>,
    {
        let y = motion.coordinates.encode(self.configuration);
        let mut dy = motion.called(0.0, &y);
        for _ in 1..self.times {
            dy = black_box(motion.called(0.0, black_box(&y)));
        }
        match motion.failure {
            Some(error) => Err(error),
            None => Ok(motion.coordinates.rates(&y, &dy)),
        }
    }
}
