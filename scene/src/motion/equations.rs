//! The equation of motion: loads, balance and kinematics put together.

use super::coordinates::Coordinates;
use crate::balance::{External, Transverse, pair_velocity};
use crate::ode::System;
use crate::{Gap, Gravity, Hydrodynamics, LoadSet, Repulsion, SceneError, Squirmer};

/// An effect that the compiler knows to be there or not, so that an absent one leaves no trace.
pub(crate) trait Effect<T>: Copy {
    /// The effect, if it is there.
    fn get(&self) -> Option<T>;
}

/// An effect that the scene does not call for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Absent;

impl<T> Effect<T> for Absent {
    #[inline]
    fn get(&self) -> Option<T> {
        None
    }
}

/// An effect that the scene calls for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Present<T>(pub T);

impl<T: Copy> Effect<T> for Present<T> {
    #[inline]
    fn get(&self) -> Option<T> {
        Some(self.0)
    }
}

/// Right-hand side of a pair's motion in the coordinates `C`.
pub(crate) struct PairMotion<'a, H: ?Sized, C, R, G> {
    pub model: &'a H,
    pub coordinates: C,
    pub squirmers: [Squirmer; 2],
    pub set: LoadSet,
    pub repulsion: R,
    pub gravity: G,
    /// Why the last right-hand side could not be computed, if it could not.
    pub failure: Option<SceneError>,
    /// Loads evaluated so far.
    pub loads: u64,
}

impl<H, C, R, G, const N: usize> System<N> for PairMotion<'_, H, C, R, G>
where
    H: Hydrodynamics + ?Sized,
    C: Coordinates<N>,
    R: Effect<Repulsion>,
    G: Effect<Gravity>,
{
    #[inline]
    fn rhs(&mut self, _t: f64, y: &[f64; N]) -> [f64; N] {
        let gap = Gap::from_ln(y[C::LN_GAP]);
        self.loads += 1;
        // Matched by reference: the loads are too large to be moved about.
        let loads = self.model.interacting_loads(gap, self.set);
        let loads = match &loads {
            Ok(loads) => loads,
            Err(error) => {
                // A trial step went too far; the stepper retries with a shorter one.
                self.failure = Some(error.clone());
                return [f64::NAN; N];
            }
        };
        let headings = self.coordinates.headings(y);
        let repulsion = self.repulsion.get().map_or(0.0, |r| r.force(gap));
        let torque = match self.gravity.get() {
            Some(gravity) => self
                .coordinates
                .gravity_torques(y, gravity, &self.squirmers),
            None => [C::Across::ZERO; 2],
        };
        let external = External { repulsion, torque };
        let velocity = pair_velocity(gap, loads, &self.squirmers, &headings, &external);
        let mut dy = self.coordinates.derivative(y, &velocity);
        if let Some(gravity) = self.gravity.get() {
            self.coordinates
                .add_axial_spin(y, &mut dy, loads, gravity, &self.squirmers);
        }
        dy
    }
}
