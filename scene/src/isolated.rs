//! No hydrodynamic interaction: the loads of lone spheres at every gap.

use crate::{
    Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError, SwirlLoads,
};

/// Two spheres that do not feel each other through the fluid.
///
/// ```
/// use scene::{Gap, Hydrodynamics, Isolated, LoadSet, PairLoads};
/// assert_eq!(Isolated.loads(Gap::new(1e-3)?, LoadSet::all(2))?, PairLoads::isolated(LoadSet::all(2)));
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Isolated;

/// Lone spheres have loads at every gap.
const RANGE: GapRange = GapRange::from(0.0);

impl Hydrodynamics for Isolated {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            // At no gap do they interact.
            cutoff: Some(0.0),
            ..ModelDescription::smooth(RANGE)
        }
    }

    #[inline]
    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        RANGE.check(gap)?;
        Ok(PairLoads::isolated(set.check()?))
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        Ok((self.interacting_loads(gap, set)?, SwirlLoads::isolated(set)))
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.interacting_loads(gap, set).map(|_| None)
    }

    fn fingerprint(&self) -> String {
        "isolated".to_owned()
    }
}
