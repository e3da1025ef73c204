//! A model that takes long for each gap, whose work can be given up.

use std::sync::Arc;

use scene::{
    ActiveLoads, Gap, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError, SwirlLoads,
};

use crate::watch;

/// A model of loads. It answers as the one behind it until work is given up ([`watch::give_up`]); from then on it fails.
pub(crate) struct Stoppable(pub Arc<dyn Hydrodynamics>);

/// Work was given up.
#[derive(Debug, thiserror::Error)]
#[error("the work was given up")]
struct GivenUp;

/// The error of work that was given up.
pub(crate) fn given_up() -> SceneError {
    SceneError::from_model("interrupted", GivenUp)
}

/// An error if work was given up.
pub(crate) fn check() -> Result<(), SceneError> {
    if watch::given_up() {
        return Err(given_up());
    }
    Ok(())
}

impl Hydrodynamics for Stoppable {
    fn description(&self) -> ModelDescription<'_> {
        self.0.description()
    }

    fn fingerprint(&self) -> String {
        self.0.fingerprint()
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        check()?;
        self.0.interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        check()?;
        self.0.interacting_loads_with_swirl(gap, set)
    }

    fn foresee(&self, gaps: &[Gap]) -> Result<(), SceneError> {
        check()?;
        self.0.foresee(gaps)
    }

    fn interacting_loads_of_each(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<[ActiveLoads; 2], SceneError> {
        check()?;
        self.0.interacting_loads_of_each(gap, set)
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        check()?;
        self.0.error_estimate(gap, set)
    }
}
