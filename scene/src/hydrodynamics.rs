//! What a hydrodynamic model is: a function from the gap to the loads of the pair.

use serde::{Deserialize, Serialize};

use crate::{Gap, LoadSet, PairLoads, SceneError, SwirlLoads};

/// Gaps for which a model vouches, `smallest <= eps <= largest` (in sphere radii).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GapRange {
    /// Smallest gap.
    pub smallest: f64,
    /// Largest gap; infinity where the model holds for spheres however far apart.
    pub largest: f64,
}

impl GapRange {
    /// `Ok` if `gap` lies within.
    ///
    /// # Errors
    /// [`SceneError::GapOutsideRange`] otherwise, NaN included.
    #[inline]
    pub fn check(&self, gap: Gap) -> Result<(), SceneError> {
        let eps = gap.eps();
        // Rounding of exp(ln(eps)) must not refuse the end of the range itself.
        let slack = 1.0 + 1e-12;
        if eps * slack >= self.smallest && eps <= self.largest * slack {
            Ok(())
        } else {
            Err(SceneError::GapOutsideRange {
                eps,
                smallest: self.smallest,
                largest: self.largest,
            })
        }
    }
}

/// A hydrodynamic model of two equal spheres: gap in, loads out.
///
/// Orientation enters through closed-form angular factors (see [`crate::loads`]), so this is all
/// that the force balance and everything after it need to know of the fluid.
pub trait Hydrodynamics: Send + Sync {
    /// Gaps for which [`Self::loads`] answers.
    fn range(&self) -> GapRange;

    /// The loads of `set` at `gap`, but for those by swirl.
    ///
    /// # Errors
    /// [`SceneError::GapOutsideRange`] for a gap outside [`Self::range`],
    /// [`SceneError::TooManyModes`] or [`SceneError::LoadsNotHeld`] if the model does not hold the set, and
    /// [`SceneError::Model`] if the model could not compute the loads.
    fn loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError>;

    /// The same with the loads by the swirl modes of `set`.
    ///
    /// # Errors
    /// As [`Self::loads`].
    fn loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError>;

    /// The model's own estimate of its error at `gap`: the largest over all loads of the error
    /// relative to the larger of the load and 1. Zero for a closed form, which is exact as a
    /// formula, whatever the formula is worth.
    ///
    /// # Errors
    /// As [`Self::loads`].
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<f64, SceneError>;

    /// Gap beyond which the spheres do not interact at all, if there is one: the cut of
    /// lubrication theory. Loads may jump there.
    fn cutoff(&self) -> Option<f64> {
        None
    }

    /// The loads of the interacting branch, continued smoothly past [`Self::cutoff`], so that a
    /// trial step may overshoot the cut before the crossing is located.
    ///
    /// # Errors
    /// As [`Self::loads`].
    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.loads(gap, set)
    }

    /// The same with the loads by the swirl modes of `set`.
    ///
    /// # Errors
    /// As [`Self::loads`].
    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.loads_with_swirl(gap, set)
    }

    /// Ascending gaps at which the model's discretisation changes, so that the loads jump by
    /// about the discretisation error: tables must not interpolate across them.
    fn seams(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Size of the model's noise between seams (rounding, quadrature), relative to the larger of
    /// the load and 1: a table tighter than this would interpolate noise.
    fn noise(&self) -> f64 {
        1e-13
    }

    /// Names the model, its parameters and the revision of its code: two models with the same
    /// fingerprint have the same loads, so that a table kept on disk may serve again.
    fn fingerprint(&self) -> String;
}

/// A model behind a pointer, for callers that choose it at run time: what it costs to find the function is
/// nothing beside a solve. Loops over a closed form or a table take the model itself.
impl<H: Hydrodynamics + ?Sized> Hydrodynamics for Box<H> {
    fn range(&self) -> GapRange {
        self.as_ref().range()
    }

    fn loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.as_ref().loads(gap, set)
    }

    fn loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.as_ref().loads_with_swirl(gap, set)
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<f64, SceneError> {
        self.as_ref().error_estimate(gap, set)
    }

    fn cutoff(&self) -> Option<f64> {
        self.as_ref().cutoff()
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.as_ref().interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.as_ref().interacting_loads_with_swirl(gap, set)
    }

    fn seams(&self) -> Vec<f64> {
        self.as_ref().seams()
    }

    fn noise(&self) -> f64 {
        self.as_ref().noise()
    }

    fn fingerprint(&self) -> String {
        self.as_ref().fingerprint()
    }
}
