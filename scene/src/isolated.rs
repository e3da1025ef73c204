//! No hydrodynamic interaction: the loads of lone spheres at every gap.

use crate::{Gap, GapRange, Hydrodynamics, LoadSet, PairLoads, SceneError, SwirlLoads};

/// Two spheres that do not feel each other through the fluid.
///
/// ```
/// use scene::{Gap, Hydrodynamics, Isolated, LoadSet, PairLoads};
/// assert_eq!(Isolated.loads(Gap::new(1e-3)?, LoadSet::all(2))?, PairLoads::isolated(LoadSet::all(2)));
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Isolated;

impl Hydrodynamics for Isolated {
    fn range(&self) -> GapRange {
        GapRange {
            smallest: 0.0,
            largest: f64::INFINITY,
        }
    }

    #[inline]
    fn loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.range().check(gap)?;
        Ok(PairLoads::isolated(set.check()?))
    }

    fn loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        Ok((self.loads(gap, set)?, SwirlLoads::isolated(set)))
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<f64, SceneError> {
        self.loads(gap, set).map(|_| 0.0)
    }

    fn fingerprint(&self) -> String {
        "isolated".to_owned()
    }

    /// Zero: at no gap do they interact.
    fn cutoff(&self) -> Option<f64> {
        Some(0.0)
    }
}
