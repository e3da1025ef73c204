//! Coordinates in which the pair's motion is integrated.
//!
//! All of them carry `ln eps` as a variable of its own, so that the spheres cannot overlap and the gap
//! keeps its digits near contact, the midpoint of the two centres, and the line of centres `d`.

use super::steady::Relative;
use crate::frame::{Configuration, Rates};

/// From configurations to states of `N` numbers, and back.
pub(crate) trait Chart<const N: usize> {
    /// Index of `ln eps`.
    fn ln_gap(&self) -> usize;
    /// Whether angles are wound on from one step to the next, so that the configuration must be known at each.
    fn is_wound(&self) -> bool {
        false
    }
    /// The variables that without gravity are a system of their own, if there are such.
    fn relative(&self) -> Option<Relative>;
    /// The state of a configuration.
    fn encode(&self, configuration: &Configuration) -> [f64; N];
    /// The configuration of a state, its angles wound on from those of `previous`.
    fn decode(&self, y: &[f64; N], previous: &Configuration) -> Configuration;
    /// The state after the further time `t` when only position and line of centres change, at the
    /// constant rates that `dy` has in the frame of the pair; none without [`Self::relative`].
    fn carried_on(&self, y: &[f64; N], dy: &[f64; N], t: f64) -> Option<[f64; N]> {
        let driven = self.relative()?.driven;
        let mut carried = *y;
        carried[driven] += dy[driven] * t;
        Some(carried)
    }
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
}
