//! What a hydrodynamic model is: a function from the gap to the loads of the pair.

use serde::{Deserialize, Serialize};

use crate::mobility::{
    Mobility, MobilityOfEach, MobilitySet, ModeMobility, PairMobility, SwirlMobilities,
};
use crate::{ActiveLoads, Gap, LoadSet, PairLoads, SceneError, SwirlLoads, are_unlike, balance};

/// Gaps for which a model vouches, `smallest <= eps <= largest` (in radii of sphere 1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GapRange {
    /// Smallest gap.
    pub smallest: f64,
    /// Largest gap; infinity where the model holds for spheres however far apart.
    pub largest: f64,
}

impl GapRange {
    /// From a smallest gap on, to spheres however far apart.
    #[must_use]
    pub const fn from(smallest: f64) -> Self {
        Self {
            smallest,
            largest: f64::INFINITY,
        }
    }

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

/// What a model says of itself. There are no defaults: whatever wraps a model hands on all of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelDescription<'a> {
    /// Radius of sphere 2 over that of sphere 1: for no other pair does the model answer.
    pub ratio: f64,
    /// Gaps for which the model answers.
    pub range: GapRange,
    /// Gap beyond which the spheres do not interact at all, if there is one: the cut of
    /// lubrication theory. Loads may jump there.
    pub cutoff: Option<f64>,
    /// Ascending gaps at which the model's discretisation changes, so that the loads jump by
    /// about the discretisation error: tables must not interpolate across them.
    pub seams: &'a [f64],
    /// Size of the model's noise between seams (rounding, quadrature), relative to the larger of
    /// the load and 1. A table of mobilities tighter than this would interpolate noise.
    pub noise: f64,
}

/// Step in `ln eps` of the difference that stands for the derivative of coefficients: its error, a 630th of the eighth power of the step, is that of rounding.
const STEP: f64 = 0.04;

/// Offsets and weights of the central difference of order 8 with a `step` (Fornberg, Math. Comput. 51 (1988) 699).
pub(crate) fn central_difference(step: f64) -> impl Iterator<Item = (f64, f64)> {
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let of = move |(i, weight): (u8, f64)| {
        let offset = f64::from(i) * step;
        [(offset, weight / step), (-offset, -weight / step)]
    };
    (1..).zip(WEIGHTS).flat_map(of)
}

/// Noise of a model that is a formula.
const ROUNDING_NOISE: f64 = 1e-13;

impl ModelDescription<'_> {
    /// A model of equal spheres that answers in a range of gaps, without a cut or seams, and with no more noise than rounding.
    #[must_use]
    pub fn smooth(range: GapRange) -> Self {
        Self {
            ratio: 1.0,
            range,
            cutoff: None,
            seams: &[],
            noise: ROUNDING_NOISE,
        }
    }
}

/// A hydrodynamic model of two spheres of given radii: gap in, loads out. The spheres are equal unless [`ModelDescription::ratio`] says
/// otherwise; of unlike ones the loads are those of sphere 1, and [`Self::interacting_loads_of_each`] has those of both.
///
/// Orientation enters through closed-form angular factors (see [`crate::loads`]), so this is all
/// that the force balance and everything after it need to know of the fluid.
///
/// A model implements the methods without a body, and nothing else; those with one follow from them.
pub trait Hydrodynamics: Send + Sync {
    /// Range, cut, seams and noise.
    fn description(&self) -> ModelDescription<'_>;

    /// Names the model, its parameters and the revision of its code: two models with the same
    /// fingerprint have the same loads, so that a table kept on disk may serve again.
    fn fingerprint(&self) -> String;

    /// The loads of `set` at `gap`, but for those by swirl, of spheres that interact: beyond a cut those within are
    /// continued smoothly, so that a trial step may overshoot it before the crossing is located.
    ///
    /// # Errors
    /// [`SceneError::GapOutsideRange`] for a gap outside the range of the model,
    /// [`SceneError::TooManyModes`] or [`SceneError::LoadsNotHeld`] if the model does not hold the set, and
    /// [`SceneError::Model`] if the model could not compute the loads.
    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError>;

    /// The same with the loads by the swirl modes of `set`.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError>;

    /// Says at which gaps the model is about to be asked. A model that answers for many gaps in less time than for one after the other works them out now; by
    /// default nothing happens.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn foresee(&self, _gaps: &[Gap]) -> Result<(), SceneError> {
        Ok(())
    }

    /// Fills in the coefficients of `set` at `gap`, but for those by swirl, of spheres that interact, as
    /// [`Self::interacting_loads`] does the loads. There is room for all modes of the set. By default they follow from the loads by [`balance::solve_into`]; a model of
    /// mobilities gives its own. Of unlike spheres there is [`Self::interacting_mobility_of_each`] instead.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    #[inline(always)]
    fn interacting_mobility(
        &self,
        gap: Gap,
        set: MobilitySet,
        into: (&mut PairMobility, &mut [ModeMobility]),
    ) -> Result<(), SceneError> {
        self.check_equal_radii()?;
        // Matched by reference: the loads are too large to be moved about.
        match &self.interacting_loads(gap, set.loads) {
            Ok(loads) => {
                balance::solve_into(gap, loads, set, into);
                Ok(())
            }
            Err(error) => Err(error.clone()),
        }
    }

    /// The same with the coefficients by the swirl modes of `set`.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn interacting_mobility_with_swirl(
        &self,
        gap: Gap,
        set: MobilitySet,
        into: (&mut PairMobility, &mut [ModeMobility]),
        swirl: &mut SwirlMobilities,
    ) -> Result<(), SceneError> {
        self.check_equal_radii()?;
        match &self.interacting_loads_with_swirl(gap, set.loads) {
            Ok((loads, of_swirl)) => {
                balance::solve_into(gap, loads, set, into);
                balance::solve_swirl_into(gap, (loads, of_swirl), set, swirl);
                Ok(())
            }
            Err(error) => Err(error.clone()),
        }
    }

    /// The loads of `set` at `gap`, those by swirl included, when one of the spheres moves or squirms and when the other does: what a pair of
    /// unlike radii needs, of which all sums and differences are read. By default those of equal spheres.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`]; [`SceneError::OtherRatio`] if the radii are unlike and the model does not say what the loads of
    /// each are.
    fn interacting_loads_of_each(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<[ActiveLoads; 2], SceneError> {
        if self.has_unlike_radii() {
            return Err(SceneError::OtherRatio {
                model: 1.0,
                asked: self.description().ratio,
            });
        }
        let (pair, swirl) = if set.swirl > 0 {
            self.interacting_loads_with_swirl(gap, set)?
        } else {
            (self.interacting_loads(gap, set)?, SwirlLoads::zero(set))
        };
        Ok([ActiveLoads::of_equal(pair, swirl); 2])
    }

    /// The same: beyond the cut those of lone spheres.
    ///
    /// # Errors
    /// As [`Self::interacting_loads_of_each`].
    fn loads_of_each(&self, gap: Gap, set: LoadSet) -> Result<[ActiveLoads; 2], SceneError> {
        if self.is_cut(gap) {
            Ok([ActiveLoads::isolated(set.check()?); 2])
        } else {
            self.interacting_loads_of_each(gap, set)
        }
    }

    /// How each cause of either squirmer moves the pair at `gap`, of spheres that interact: what motion reads where radii are unlike.
    ///
    /// # Errors
    /// As [`Self::interacting_loads_of_each`].
    fn interacting_mobility_of_each(
        &self,
        gap: Gap,
        set: MobilitySet,
    ) -> Result<MobilityOfEach, SceneError> {
        let loads = self.interacting_loads_of_each(gap, set.loads)?;
        Ok(balance::of_each(gap, self.description().ratio, &loads, set))
    }

    /// Fills in how each cause of either squirmer moves the pair at `gap`, of spheres of any radii that interact, and how that changes with
    /// `ln eps`: what the linearised motion reads. By default the change is a difference of order 8 of the coefficients themselves, good to about 1e-13 of
    /// them where a model is smooth; a table gives the derivative of its polynomials.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn interacting_mobility_with_slope(
        &self,
        gap: Gap,
        set: MobilitySet,
        into: [&mut MobilityOfEach; 2],
    ) -> Result<(), SceneError> {
        let [value, slope] = into;
        *slope = MobilityOfEach::default();
        let mut beside = MobilityOfEach::default();
        for (offset, weight) in central_difference(STEP) {
            let gap = Gap::from_ln(gap.ln() + offset);
            self.interacting_mobility_of_any(gap, set, &mut beside)?;
            slope.add(weight, &beside, set);
        }
        self.interacting_mobility_of_any(gap, set, value)
    }

    /// Fills in how each cause of either squirmer moves the pair at `gap`, whether its radii are alike or not.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn interacting_mobility_of_any(
        &self,
        gap: Gap,
        set: MobilitySet,
        into: &mut MobilityOfEach,
    ) -> Result<(), SceneError> {
        if self.has_unlike_radii() {
            *into = self.interacting_mobility_of_each(gap, set)?;
            return Ok(());
        }
        let Mobility { pair, modes, swirl } = &mut into.by[0];
        if set.loads.swirl > 0 {
            self.interacting_mobility_with_swirl(gap, set, (pair, modes), swirl)?;
        } else {
            self.interacting_mobility(gap, set, (pair, modes))?;
        }
        into.take_out_of_sums(set);
        Ok(())
    }

    /// Refuses to take the loads of sphere 1 for those of both.
    ///
    /// # Errors
    /// [`SceneError::OtherRatio`] of unlike spheres.
    fn check_equal_radii(&self) -> Result<(), SceneError> {
        if self.has_unlike_radii() {
            return Err(SceneError::OtherRatio {
                model: self.description().ratio,
                asked: 1.0,
            });
        }
        Ok(())
    }

    /// Whether the model is one of unlike spheres.
    fn has_unlike_radii(&self) -> bool {
        are_unlike(self.description().ratio)
    }

    /// The model's own estimate of its error at `gap`: the largest over all loads of the error
    /// relative to the larger of the load and 1. None for a model that has none: a closed form such as lubrication
    /// theory is exact as a formula, and does not know what the formula is worth.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError>;

    /// The loads of `set` at `gap`, but for those by swirl: beyond the cut those of lone spheres.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        if self.is_cut(gap) {
            Ok(PairLoads::isolated(set.check()?))
        } else {
            self.interacting_loads(gap, set)
        }
    }

    /// The same with the loads by the swirl modes of `set`.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        if self.is_cut(gap) {
            let set = set.check()?;
            Ok((PairLoads::isolated(set), SwirlLoads::isolated(set)))
        } else {
            self.interacting_loads_with_swirl(gap, set)
        }
    }

    /// All coefficients of `set` at `gap`, of spheres that interact.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn interacting_mobilities(&self, gap: Gap, set: MobilitySet) -> Result<Mobility, SceneError> {
        let mut mobility = Mobility::default();
        let Mobility { pair, modes, swirl } = &mut mobility;
        if set.loads.swirl > 0 {
            self.interacting_mobility_with_swirl(gap, set, (pair, modes), swirl)?;
        } else {
            self.interacting_mobility(gap, set, (pair, modes))?;
        }
        Ok(mobility)
    }

    /// All coefficients of `set` at `gap`: beyond the cut those of lone spheres.
    ///
    /// # Errors
    /// As [`Self::interacting_loads`].
    fn mobility(&self, gap: Gap, set: MobilitySet) -> Result<Mobility, SceneError> {
        if !self.is_cut(gap) {
            return self.interacting_mobilities(gap, set);
        }
        let loads = PairLoads::isolated(set.loads.check()?);
        let mut mobility = balance::solve(gap, &loads, set);
        let swirl = SwirlLoads::isolated(set.loads);
        balance::solve_swirl_into(gap, (&loads, &swirl), set, &mut mobility.swirl);
        Ok(mobility)
    }

    /// Whether `gap` lies beyond the cut.
    fn is_cut(&self, gap: Gap) -> bool {
        self.cutoff().is_some_and(|cut| gap.eps() > cut)
    }

    /// Gaps for which the model answers.
    fn range(&self) -> GapRange {
        self.description().range
    }

    /// Gap beyond which the spheres do not interact at all, if there is one.
    fn cutoff(&self) -> Option<f64> {
        self.description().cutoff
    }
}
