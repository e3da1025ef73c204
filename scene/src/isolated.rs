//! No hydrodynamic interaction: the loads of lone spheres at every gap.

use crate::{
    ActiveLoads, Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError,
    SwirlLoads,
};

/// Two spheres that do not feel each other through the fluid.
///
/// ```
/// use scene::{Gap, Hydrodynamics, Isolated, LoadSet, PairLoads};
/// assert_eq!(Isolated::EQUAL.loads(Gap::new(1e-3)?, LoadSet::all(2))?, PairLoads::isolated(LoadSet::all(2)));
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isolated {
    ratio: f64,
}

impl Isolated {
    /// Equal spheres.
    pub const EQUAL: Self = Self::of_ratio(1.0);

    /// Spheres whose radii are in the given ratio, that of sphere 2 over that of sphere 1.
    #[must_use]
    pub const fn of_ratio(ratio: f64) -> Self {
        Self { ratio }
    }
}

/// Lone spheres have loads at every gap.
const RANGE: GapRange = GapRange::from(0.0);

impl Hydrodynamics for Isolated {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            ratio: self.ratio,
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

    fn interacting_loads_of_each(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<[ActiveLoads; 2], SceneError> {
        RANGE.check(gap)?;
        Ok([ActiveLoads::isolated(set.check()?); 2])
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.interacting_loads(gap, set).map(|_| None)
    }

    fn fingerprint(&self) -> String {
        let ratio = self.ratio;
        if self.has_unlike_radii() {
            format!("isolated, radii 1 to {ratio:?}")
        } else {
            "isolated".to_owned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MAX_MODES;

    #[test]
    fn spheres_without_interaction_say_which_radii_they_have_and_have_no_error_to_state() {
        assert_eq!(Isolated::EQUAL.fingerprint(), "isolated");
        assert_eq!(
            Isolated::of_ratio(2.5).fingerprint(),
            "isolated, radii 1 to 2.5"
        );
        let gap = Gap::new(0.1).unwrap();
        assert_eq!(
            Isolated::EQUAL.error_estimate(gap, LoadSet::all(2)),
            Ok(None)
        );
        assert!(
            Isolated::EQUAL
                .error_estimate(gap, LoadSet::all(MAX_MODES + 1))
                .is_err()
        );
    }
}
