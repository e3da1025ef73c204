//! An equation of motion behind a pointer: whoever runs it is compiled once for each size of the state, not once for each
//! set of effects. One virtual call takes a whole step.

use super::chart::Chart;
use super::equations::{Dynamics, Effect, PairMotion};
use crate::ode::{OdeError, Step, Stepper, System};
use crate::{Gap, Gravity, Hydrodynamics, Repulsion, SceneError, Squirmer};

/// The motion of a pair in some coordinates of dimension `N`.
pub(super) trait Moving<const N: usize>: System<N> {
    /// Takes one step, with the right-hand side inside the loop over its stages.
    ///
    /// # Errors
    /// As [`Stepper::step`].
    fn step(&mut self, stepper: &mut Stepper<N>, end: f64) -> Result<Step<N>, OdeError>;

    /// The coordinates of the state.
    fn chart(&self) -> &dyn Chart<N>;

    /// The two squirmers.
    fn squirmers(&self) -> &[Squirmer; 2];

    /// Gravity, if it acts.
    fn gravity(&self) -> Option<Gravity>;

    /// Whether the model answers for a gap, in its own words where it has some.
    ///
    /// # Errors
    /// The model's.
    fn check_gap(&self, gap: Gap) -> Result<(), SceneError>;

    /// Why the last right-hand side could not be computed, if it could not; forgotten by this call.
    fn take_failure(&mut self) -> Option<SceneError>;

    /// Loads evaluated so far.
    fn loads(&self) -> u64;
}

impl<H, C, R, G, const N: usize> Moving<N> for PairMotion<'_, H, C, R, G>
where
    H: Hydrodynamics + ?Sized,
    C: Dynamics<N>,
    R: Effect<Repulsion>,
    G: Effect<Gravity>,
{
    fn step(&mut self, stepper: &mut Stepper<N>, end: f64) -> Result<Step<N>, OdeError> {
        stepper.step(self, end)
    }

    fn chart(&self) -> &dyn Chart<N> {
        &self.coordinates
    }

    fn squirmers(&self) -> &[Squirmer; 2] {
        &self.squirmers
    }

    fn gravity(&self) -> Option<Gravity> {
        self.gravity.get()
    }

    fn check_gap(&self, gap: Gap) -> Result<(), SceneError> {
        self.model.range().check(gap).or_else(|error| {
            self.model.interacting_loads(gap, self.set)?;
            Err(error)
        })
    }

    fn take_failure(&mut self) -> Option<SceneError> {
        self.failure.take()
    }

    fn loads(&self) -> u64 {
        self.loads
    }
}
