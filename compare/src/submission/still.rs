//! The model of a submission that moves no pair.

use scene::{
    Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError, SwirlLoads,
};

use super::error::SubmissionError;

/// Refuses every gap for the reason why there is no model.
pub(super) struct Still(pub SubmissionError);

impl Still {
    fn refused<T>(&self) -> Result<T, SceneError> {
        Err(SceneError::from_model("a submission", self.0.clone()))
    }
}

impl Hydrodynamics for Still {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription::smooth(GapRange::from(f64::MIN_POSITIVE))
    }

    fn fingerprint(&self) -> String {
        format!("none: {}", self.0)
    }

    fn interacting_loads(&self, _: Gap, _: LoadSet) -> Result<PairLoads, SceneError> {
        self.refused()
    }

    fn interacting_loads_with_swirl(
        &self,
        _: Gap,
        _: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.refused()
    }

    fn error_estimate(&self, _: Gap, _: LoadSet) -> Result<Option<f64>, SceneError> {
        self.refused()
    }
}
