//! The flow about a pair, its stresslets and its power, from the same series as the loads.
//!
//! Velocities of both surfaces are expanded themselves, with no lone flow taken out, in every azimuthal order that the slip modes have: the
//! fields are then known up to the surfaces, for equal spheres and unlike ones alike.

mod causes;
mod flow;
mod harmonic;
mod solution;
mod stresses;

use scene::stress::Stresses;
use scene::{Flow, Fluid, Gap, LoadSet, MovingPair, SceneError};

use crate::Exact;
use crate::error::check;
use flow::SeriesFlow;

impl Fluid for Exact {
    /// The flow by the series, at gaps down to about 1e-7: its estimate is the largest difference from the velocity of the surfaces, at points
    /// that the solution does not know of. A Stokes flow has its largest error on the surfaces, up to a factor of order 1.
    fn flow(&self, pair: &MovingPair) -> Result<Box<dyn Flow>, SceneError> {
        let [one, two] = pair.configuration.radii;
        self.check_radii(two / one)?;
        Ok(Box::new(SeriesFlow::new(pair, self.factor())?))
    }

    fn stresses(&self, gap: Gap, modes: usize, swirl: usize) -> Result<Stresses, SceneError> {
        check(LoadSet::planar(modes).with_swirl(swirl))?;
        let stresses = stresses::stresses(gap, self.ratio(), (modes, swirl), self.factor())?;
        Ok(stresses)
    }
}
