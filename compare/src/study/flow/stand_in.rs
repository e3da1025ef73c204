//! A model with a flow for tests: the loads of any model, and the flows of lone squirmers.

use scene::stress::Stresses;
use scene::{
    ActiveLoads, Flow, Fluid, Gap, Hydrodynamics, LoadSet, LoneFlows, ModelDescription, MovingPair,
    PairLoads, SceneError, SwirlLoads,
};

/// Loads of a model, with the flows of lone squirmers.
pub(crate) struct StandIn<H>(pub H);

impl<H: Hydrodynamics> Hydrodynamics for StandIn<H> {
    fn description(&self) -> ModelDescription<'_> {
        self.0.description()
    }

    fn fingerprint(&self) -> String {
        self.0.fingerprint()
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.0.interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.0.interacting_loads_with_swirl(gap, set)
    }

    fn interacting_loads_of_each(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<[ActiveLoads; 2], SceneError> {
        self.0.interacting_loads_of_each(gap, set)
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.0.error_estimate(gap, set)
    }
}

impl<H: Hydrodynamics> Fluid for StandIn<H> {
    fn flow(&self, pair: &MovingPair) -> Result<Box<dyn Flow>, SceneError> {
        Ok(Box::new(LoneFlows::new(*pair)))
    }

    fn stresses(&self, gap: Gap, modes: usize, swirl: usize) -> Result<Stresses, SceneError> {
        Ok(Stresses {
            gap,
            modes,
            swirl,
            blocks: Vec::new(),
        })
    }
}
