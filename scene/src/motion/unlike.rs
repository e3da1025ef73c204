//! The equation of motion of a pair of unlike radii, in any of the coordinates that need no equal pair.
//!
//! Each squirmer's causes have coefficients of their own, so that there are twice as many; which effects a scene calls for is asked while
//! it runs, because each set of effects that is known to the compiler is one more loop to compile.

use super::chart::Chart;
use super::equations::{Dynamics, Effect, Instant};
use super::steady::Relative;
use crate::frame::{Configuration, Rates};
use crate::mobility::{Heading, PairVelocity, add_swirl_of_each, velocity_of_each};
use crate::{Gravity, Hydrodynamics, LoadSet, SceneError, Squirmer};

/// Coordinates of a pair of unlike radii.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unlike<C>(pub C);

impl<const N: usize, C: Chart<N>> Chart<N> for Unlike<C> {
    #[inline]
    fn ln_gap(&self) -> usize {
        self.0.ln_gap()
    }

    fn is_wound(&self) -> bool {
        self.0.is_wound()
    }

    fn relative(&self) -> Option<Relative> {
        self.0.relative()
    }

    fn encode(&self, configuration: &Configuration) -> [f64; N] {
        self.0.encode(configuration)
    }

    fn decode(&self, y: &[f64; N], previous: &Configuration) -> Configuration {
        self.0.decode(y, previous)
    }

    fn carried_on(&self, y: &[f64; N], dy: &[f64; N], t: f64) -> Option<[f64; N]> {
        self.0.carried_on(y, dy, t)
    }

    fn unit_drift(&self, y: &[f64; N]) -> f64 {
        self.0.unit_drift(y)
    }

    fn rates(&self, y: &[f64; N], dy: &[f64; N]) -> Rates {
        self.0.rates(y, dy)
    }

    fn restored(&self, configuration: Configuration) -> Configuration {
        self.0.restored(configuration)
    }
}

impl<const N: usize, C: Dynamics<N>> Dynamics<N> for Unlike<C> {
    type Across = C::Across;

    fn read(set: LoadSet) -> LoadSet {
        C::read(set)
    }

    fn headings(&self, y: &[f64; N]) -> [Heading<C::Across>; 2] {
        self.0.headings(y)
    }

    fn gravity_torques(
        &self,
        y: &[f64; N],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> [C::Across; 2] {
        self.0.gravity_torques(y, gravity, squirmers)
    }

    fn axial_torques(
        &self,
        y: &[f64; N],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> Option<[f64; 2]> {
        self.0.axial_torques(y, gravity, squirmers)
    }

    fn add_axial_spin(&self, y: &[f64; N], dy: &mut [f64; N], spins: [f64; 2]) {
        self.0.add_axial_spin(y, dy, spins);
    }

    fn motion<const M: usize, H, G>(
        &self,
        y: &[f64; N],
        headings: &[Heading<C::Across>; 2],
        at: &Instant<'_, H, G>,
    ) -> Result<[f64; N], SceneError>
    where
        H: Hydrodynamics + ?Sized,
        G: Effect<Gravity>,
    {
        let mobility = (at.model).interacting_mobility_of_each(at.gap, at.mobility_set())?;
        let external = at.external(self, y);
        let mut velocity =
            velocity_of_each(&mobility, at.set.modes, at.squirmers, headings, &external);
        let turned = self.0.turned(y, headings);
        let mut spins = turned.map(|turned| {
            add_swirl_of_each(&mut velocity, &mobility, at.squirmers, (headings, &turned))
        });
        let mut dy = self.derivative(y, &velocity);
        if let Some(torques) = at.axial_torques(self, y) {
            let of = spins.get_or_insert_default();
            for (by, torque) in mobility.by.iter().zip(torques) {
                let [one, two] = by.pair.twist.spins(torque, torque);
                *of = [of[0] + one, of[1] + two];
            }
        }
        if let Some(spins) = spins {
            self.add_axial_spin(y, &mut dy, spins);
        }
        Ok(dy)
    }

    fn derivative(&self, y: &[f64; N], velocity: &PairVelocity<C::Across>) -> [f64; N] {
        self.0.derivative(y, velocity)
    }
}
