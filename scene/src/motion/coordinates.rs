//! Coordinates in which the pair's motion is integrated.
//!
//! All of them carry `ln eps` as a variable of its own, so that the spheres cannot overlap and the gap
//! keeps its digits near contact, the midpoint of the two centres, and the line of centres `d`.

mod planar;
mod spatial;

use nalgebra::Vector3;

pub(crate) use self::planar::Planar;
pub(crate) use self::spatial::Spatial;
pub(super) use self::spatial::{along_line, spin_about};
use super::configuration::{Configuration, Rates};
use super::equations::{self, Effect, Instant};
use super::steady::Relative;
use crate::balance::{External, Heading, PairVelocity, Transverse, pair_velocity};
use crate::{Gap, Gravity, Hydrodynamics, PairLoads, SceneError, Squirmer};

/// Coordinates of dimension `N`.
pub(crate) trait Coordinates<const N: usize>: Copy {
    /// What is perpendicular to the line of centres.
    type Across: Transverse;
    /// Index of `ln eps`.
    const LN_GAP: usize;
    /// Whether angles are wound on from one step to the next, so that the configuration must be known at each.
    const WOUND: bool = false;
    /// Whether headings take sines.
    const SINES: bool = true;
    /// The variables that without gravity are a system of their own, if there are such.
    const RELATIVE: Option<Relative>;

    /// The state of a configuration.
    fn encode(&self, configuration: &Configuration) -> [f64; N];
    /// The configuration of a state, its angles wound on from those of `previous`.
    fn decode(&self, y: &[f64; N], previous: &Configuration) -> Configuration;
    /// Orientations in the pair frame.
    fn headings(&self, y: &[f64; N]) -> [Heading<Self::Across>; 2];
    /// Torques of gravity as `T x d`, per `pi mu a^2`.
    fn gravity_torques(
        &self,
        y: &[f64; N],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> [Self::Across; 2];
    /// Time derivative of the state at an instant, by its headings and the loads of its model.
    ///
    /// # Errors
    /// The model's.
    #[inline(always)]
    fn motion<H, G>(
        &self,
        y: &[f64; N],
        headings: &[Heading<Self::Across>; 2],
        at: &Instant<'_, H, G>,
    ) -> Result<[f64; N], SceneError>
    where
        H: Hydrodynamics + ?Sized,
        G: Effect<Gravity>,
    {
        equations::derivative(self, y, headings, at)
    }
    /// Velocity of the pair without swirl.
    #[inline(always)]
    fn velocity(
        gap: Gap,
        loads: &PairLoads,
        squirmers: &[Squirmer; 2],
        headings: &[Heading<Self::Across>; 2],
        external: &External<Self::Across>,
    ) -> PairVelocity<Self::Across> {
        pair_velocity(gap, loads, squirmers, headings, external)
    }
    /// Time derivative of the state for a velocity of the pair.
    fn derivative(&self, y: &[f64; N], velocity: &PairVelocity<Self::Across>) -> [f64; N];
    /// The state after the further time `t` when only position and line of centres change, at the
    /// constant rates that `dy` has in the frame of the pair; none without [`Self::RELATIVE`].
    fn carried_on(&self, y: &[f64; N], dy: &[f64; N], t: f64) -> Option<[f64; N]>;
    /// Largest departure from unit length of the directions in the state, which are integrated as vectors;
    /// zero for angles.
    fn unit_drift(&self, _y: &[f64; N]) -> f64 {
        0.0
    }
    /// How the derivative `dy` changes the configuration.
    fn rates(&self, y: &[f64; N], dy: &[f64; N]) -> Rates;
    /// `configuration` with what a symmetry of the coordinates says put right, to the last bit, where
    /// free flight in the laboratory frame has rounded it.
    fn restored(&self, configuration: Configuration) -> Configuration {
        configuration
    }
    /// What gravity adds to [`Self::derivative`]: spin about the line of centres. Nothing in a plane, to which
    /// its torques are perpendicular.
    #[inline]
    fn add_axial_spin(
        &self,
        _y: &[f64; N],
        _dy: &mut [f64; N],
        _loads: &PairLoads,
        _gravity: Gravity,
        _squirmers: &[Squirmer; 2],
    ) {
    }
}

/// Unit vector at an angle in the x-y plane.
pub(super) fn direction(angle: f64) -> Vector3<f64> {
    let (sin, cos) = angle.sin_cos();
    Vector3::new(cos, sin, 0.0)
}
