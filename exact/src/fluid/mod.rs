//! The flow about a pair, its stresslets and its power, from the same series as the loads.
//!
//! Velocities of both surfaces are expanded themselves, with no lone flow taken out, in every azimuthal order that the slip modes have: the
//! fields are then known up to the surfaces, for equal spheres and unlike ones alike.

mod causes;
mod flow;
mod harmonic;
mod solution;
mod stresses;
mod tractions;

use scene::stress::Stresses;
use scene::{Flow, Fluid, Gap, GapRange, LoadSet, MovingPair, SceneError};

use crate::Exact;
use crate::error::check;
use flow::SeriesFlow;

/// Gaps at which the flow is summed, in units of the smaller radius and of the larger one: rounding costs about 1e-6 at the first, and 1e-7 at
/// the last, where the pressure is multiplied by the distance of the centres.
const GAPS: [f64; 2] = [1e-6, 1e4];

impl Exact {
    fn check_fluid_gap(&self, gap: Gap) -> Result<(), SceneError> {
        let range = GapRange {
            smallest: GAPS[0] * self.ratio().min(1.0),
            largest: GAPS[1] * self.ratio().max(1.0),
        };
        range.check(gap)
    }
}

/// By the series, at gaps from 1e-6 of the smaller radius to 1e4 of the larger one.
impl Fluid for Exact {
    /// The estimate of the flow's error is the largest difference from the velocity of the surfaces, at points that the solution does not know
    /// of: the error is a Stokes flow itself, and largest on the surfaces up to a factor of order 1.
    fn flow(&self, pair: &MovingPair) -> Result<Box<dyn Flow>, SceneError> {
        let [one, two] = pair.configuration.radii;
        self.check_radii(two / one)?;
        self.check_fluid_gap(pair.configuration.gap)?;
        Ok(Box::new(SeriesFlow::new(pair, self.factor())?))
    }

    fn stresses(&self, gap: Gap, modes: usize, swirl: usize) -> Result<Stresses, SceneError> {
        self.check_fluid_gap(gap)?;
        check(LoadSet::planar(modes).with_swirl(swirl))?;
        let stresses = stresses::stresses(gap, self.ratio(), (modes, swirl), self.factor())?;
        Ok(stresses)
    }
}
