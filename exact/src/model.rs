//! The referee as a hydrodynamic model: series where they serve, their limiting forms beyond.

use std::sync::OnceLock;

use scene::{
    ActiveLoads, Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, PairLoads, RATIOS,
    SceneError, SwirlLoads, are_unlike,
};

use crate::ExactError;
use crate::error::check;
use crate::far_field::{FarField, SERIES_TO};
use crate::fit::{MORE_TERMS, relative_distance};
use crate::geometry::Geometry;
use crate::kinds::{KINDS, get_or_fit, kind, whole};
use crate::near_contact::{self, NearContact, SERIES_FROM};
use crate::series::Solved;
use crate::unlike::{Limit, Pair, Terms, Unlike};

/// Pairs of surface points at which the residual is taken.
const RESIDUAL_POINTS: usize = 24;
/// To be raised with every change that changes loads.
const REVISION: u32 = 2;
/// Rounding of the matrices over the gap. It hardly shows when terms are added, because the
/// entries stay the same; against series in 80-bit arithmetic it is 0.8e-14 over the gap.
pub const ROUNDING: f64 = 1e-14;

/// Pair loads to about ten digits at every gap: bispherical series, continued to contact by the
/// asymptotic form and to infinity by inverse powers of the distance, both with constants fitted
/// to the series (once, when first needed).
///
/// ```
/// use exact::Exact;
/// use scene::{Gap, Hydrodynamics, LoadSet};
/// let loads = Exact::new().loads(Gap::new(1.0)?, LoadSet::all(2))?;
/// assert!((loads.xa.own() - 1.3684796).abs() < 1e-7);
/// # Ok::<(), scene::SceneError>(())
/// ```
///
/// [`Self::of_ratio`] gives the model for spheres of unlike radii, of which the loads are those of sphere 1 unless they
/// are asked for of each.
///
/// ```
/// use exact::Exact;
/// use scene::{Gap, Hydrodynamics, LoadSet};
/// let gap = Gap::new(1.5)?; // in radii of sphere 1
/// let [one, two] = Exact::of_ratio(2.0)?.interacting_loads_of_each(gap, LoadSet::all(2))?;
/// // Forces on one sphere by the other's motion are the same: reciprocal.
/// assert!((one.pair.xa.other() - 2.0 * two.pair.xa.other()).abs() < 1e-12);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Exact {
    factor: f64,
    /// Of unlike radii: what replaces all else.
    unlike: Option<Box<Unlike>>,
    /// The limiting forms of each kind of set, for all modes.
    near_contact: [OnceLock<NearContact>; KINDS],
    far_field: [OnceLock<FarField>; KINDS],
}

/// Which form answers at a gap.
enum Form<'a> {
    NearContact(&'a NearContact),
    Series,
    FarField(&'a FarField),
}

impl Default for Exact {
    fn default() -> Self {
        Self::new()
    }
}

impl Exact {
    /// The model of equal spheres with the number of terms that reaches rounding.
    #[must_use]
    pub fn new() -> Self {
        Self {
            factor: 1.0,
            unlike: None,
            near_contact: Default::default(),
            far_field: Default::default(),
        }
    }

    /// The model of spheres whose radii are in the given `ratio`, that of sphere 2 over that of sphere 1. Gaps are in radii of sphere 1.
    ///
    /// # Errors
    /// [`ExactError::InvalidRatio`] for a ratio outside [`RATIOS`].
    pub fn of_ratio(ratio: f64) -> Result<Self, ExactError> {
        if !RATIOS.contains(&ratio) {
            return Err(ExactError::InvalidRatio { ratio });
        }
        let terms = Terms { ratio, factor: 1.0 };
        Ok(Self {
            unlike: are_unlike(ratio).then(|| Box::new(Unlike::new(terms))),
            ..Self::new()
        })
    }

    /// The model of equal spheres with `factor` times as many terms, to see what they change.
    ///
    /// # Errors
    /// As [`Self::times_terms`].
    pub fn with_terms(factor: f64) -> Result<Self, ExactError> {
        Self::new().times_terms(factor)
    }

    /// The model of the same spheres with `factor` times as many terms as reach rounding.
    ///
    /// # Errors
    /// [`ExactError::InvalidTermsFactor`] unless `0.25 <= factor <= 16`.
    pub fn times_terms(self, factor: f64) -> Result<Self, ExactError> {
        if !(0.25..=16.0).contains(&factor) {
            return Err(ExactError::InvalidTermsFactor { factor });
        }
        let unlike = self.unlike.map(|unlike| {
            let terms = Terms {
                factor,
                ..unlike.terms
            };
            Box::new(Unlike::new(terms))
        });
        Ok(Self {
            factor,
            unlike,
            ..Self::new()
        })
    }

    /// Radius of sphere 2 over that of sphere 1.
    pub(crate) fn ratio(&self) -> f64 {
        (self.unlike.as_ref()).map_or(1.0, |unlike| unlike.terms.ratio)
    }

    /// Factor on the number of terms that reach rounding.
    pub(crate) fn factor(&self) -> f64 {
        self.factor
    }

    /// Refuses a pair of other radii.
    pub(crate) fn check_radii(&self, asked: f64) -> Result<(), SceneError> {
        let model = self.ratio();
        #[expect(clippy::float_cmp, reason = "a model is for one ratio, exactly")]
        if asked == model {
            Ok(())
        } else {
            Err(SceneError::OtherRatio { model, asked })
        }
    }

    /// Highest degree of the series at `gap` for the loads of `set`.
    ///
    /// # Errors
    /// [`ExactError::TooManyTerms`] at a gap too small for the series.
    pub fn terms(&self, gap: Gap, set: LoadSet) -> Result<usize, ExactError> {
        if let Some(unlike) = &self.unlike {
            let Terms { ratio, factor } = unlike.terms;
            return Ok(Pair::new(gap.eps(), ratio, set.modes, factor)?.degree());
        }
        Ok(Geometry::new(gap.eps(), set.modes, self.factor)?.degree)
    }

    /// The loads by the series, also where [`Hydrodynamics::loads`] takes the asymptotic form.
    ///
    /// # Errors
    /// [`ExactError::TooManyTerms`] at a gap too small for the series,
    /// [`ExactError::TooManyModes`].
    pub fn series_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, ExactError> {
        if let Some(unlike) = &self.unlike {
            let [first, _] = unlike.terms.solve(gap.eps(), set)?.loads();
            return Ok(first.pair);
        }
        Ok(Solved::new(gap.eps(), set, self.factor)?.loads())
    }

    /// The same when either sphere is the active one, with those by swirl.
    ///
    /// # Errors
    /// As [`Self::series_loads`].
    pub fn series_loads_of_each(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<[ActiveLoads; 2], ExactError> {
        if let Some(unlike) = &self.unlike {
            return Ok(unlike.terms.solve(gap.eps(), set)?.loads());
        }
        let solved = Solved::new(gap.eps(), set, self.factor)?;
        Ok([ActiveLoads::of_equal(solved.loads(), solved.swirl_loads()); 2])
    }

    /// The loads by the asymptotic form, whatever the gap.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn near_contact_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, ExactError> {
        check(set)?;
        if let Some(unlike) = &self.unlike {
            let [first, _] = unlike.form(Limit::NearContact, set)?.loads(gap, set);
            return Ok(first.pair);
        }
        Ok(self.near_contact(set)?.loads(gap, set))
    }

    /// What is left of the loads at contact when their singular parts are taken out; of unlike spheres when sphere 1 is the active one.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn contact_constants(&self, set: LoadSet) -> Result<PairLoads, ExactError> {
        check(set)?;
        if self.unlike.is_some() {
            let [first, _] = self.contact_constants_of_each(set)?;
            return Ok(first.pair);
        }
        let (constants, _) = self.near_contact(set)?.constants();
        let columns: Vec<f64> = constants.columns().collect();
        Ok(PairLoads::from_columns(set, constants.set(), &columns))
    }

    /// The same with those by swirl, when either sphere is the active one; next to the logarithm of the smaller radius over the gap.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn contact_constants_of_each(&self, set: LoadSet) -> Result<[ActiveLoads; 2], ExactError> {
        check(set)?;
        if let Some(unlike) = &self.unlike {
            return Ok(unlike.form(Limit::NearContact, set)?.first_factors(set));
        }
        let (_, swirl) = self.near_contact(set)?.constants();
        let columns: Vec<f64> = swirl.columns().collect();
        let swirl = SwirlLoads::from_columns(set, &columns);
        Ok([ActiveLoads::of_equal(self.contact_constants(set)?, swirl); 2])
    }

    /// The factors of `L = ln(1/eps)` in the loads, fitted freely to the series at gaps between
    /// 1e-4 and 1e-3: what lubrication theory has to reproduce. Of unlike spheres when sphere 1 is the active one.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn log_slopes(&self, set: LoadSet) -> Result<(PairLoads, SwirlLoads), ExactError> {
        check(set)?;
        if self.unlike.is_some() {
            let [first, _] = self.log_slopes_of_each(set)?;
            return Ok((first.pair, first.swirl));
        }
        near_contact::log_slopes(set, self.factor)
    }

    /// The same when either sphere is the active one, with gaps in units of the smaller radius.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn log_slopes_of_each(&self, set: LoadSet) -> Result<[ActiveLoads; 2], ExactError> {
        check(set)?;
        if let Some(unlike) = &self.unlike {
            return unlike.log_slopes(set);
        }
        let (pair, swirl) = near_contact::log_slopes(set, self.factor)?;
        Ok([ActiveLoads::of_equal(pair, swirl); 2])
    }

    /// Largest difference between the flow and its boundary velocity (of order 1) at surface points
    /// that were not fitted. The loads are closer than this: their error is its square, but for
    /// rounding.
    ///
    /// # Errors
    /// As [`Self::series_loads`].
    pub fn residual(&self, gap: Gap, set: LoadSet) -> Result<f64, ExactError> {
        if let Some(unlike) = &self.unlike {
            let solved = unlike.terms.solve(gap.eps(), set)?;
            return Ok(solved.residual(RESIDUAL_POINTS));
        }
        Ok(Solved::new(gap.eps(), set, self.factor)?.residual(RESIDUAL_POINTS))
    }

    fn near_contact(&self, set: LoadSet) -> Result<&NearContact, ExactError> {
        let whole = whole(set);
        get_or_fit(&self.near_contact[kind(set)], || {
            NearContact::fit(whole, self.factor)
        })
    }

    fn form(&self, gap: Gap, set: LoadSet) -> Result<Form<'_>, ExactError> {
        Ok(if gap.eps() < SERIES_FROM {
            Form::NearContact(self.near_contact(set)?)
        } else if gap.eps() > SERIES_TO {
            let whole = whole(set);
            Form::FarField(get_or_fit(&self.far_field[kind(set)], || {
                FarField::fit(whole, self.factor)
            })?)
        } else {
            Form::Series
        })
    }

    /// What half as many terms again change, or two formulas for one load disagree by, or rounding.
    fn series_error(&self, gap: Gap, set: LoadSet) -> Result<f64, ExactError> {
        let solved = Solved::new(gap.eps(), set, self.factor)?;
        let loads = solved.columns();
        let finer = Solved::new(gap.eps(), set, MORE_TERMS * self.factor)?.columns();
        let by_terms = relative_distance(&loads, &finer);
        let by_formula = relative_distance(&loads, &solved.columns_by_second_formula());
        let by_rounding = ROUNDING * (1.0 / gap.eps()).max(1.0);
        Ok(by_terms.max(by_formula).max(by_rounding))
    }
}

/// The series and their limiting forms answer at every gap.
const RANGE: GapRange = GapRange::from(f64::MIN_POSITIVE);

impl Hydrodynamics for Exact {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            ratio: self.unlike.as_ref().map_or(1.0, |u| u.terms.ratio),
            range: RANGE,
            cutoff: None,
            seams: (self.unlike.as_ref()).map_or(&[SERIES_FROM, SERIES_TO], |u| &u.seams),
            // At the smallest gap that the series serve; it falls as the gap grows.
            noise: (self.unlike.as_ref())
                .map_or(ROUNDING / SERIES_FROM, |u| u.terms.rounding(u.seams[0])),
        }
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        RANGE.check(gap)?;
        check(set)?;
        if let Some(unlike) = &self.unlike {
            let [first, _] = unlike.loads(gap, set)?;
            return Ok(first.pair);
        }
        match self.form(gap, set)? {
            Form::NearContact(form) => Ok(form.loads(gap, set)),
            Form::Series => Ok(self.series_loads(gap, set)?),
            Form::FarField(form) => Ok(form.loads(gap, set)),
        }
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        RANGE.check(gap)?;
        check(set)?;
        if let Some(unlike) = &self.unlike {
            let [first, _] = unlike.loads(gap, set)?;
            return Ok((first.pair, first.swirl));
        }
        match self.form(gap, set)? {
            Form::NearContact(form) => Ok((form.loads(gap, set), form.swirl(gap, set))),
            Form::Series => {
                let solved = Solved::new(gap.eps(), set, self.factor)?;
                Ok((solved.loads(), solved.swirl_loads()))
            }
            Form::FarField(form) => Ok((form.loads(gap, set), form.swirl(gap, set))),
        }
    }

    fn interacting_loads_of_each(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<[ActiveLoads; 2], SceneError> {
        RANGE.check(gap)?;
        check(set)?;
        if let Some(unlike) = &self.unlike {
            return Ok(unlike.loads(gap, set)?);
        }
        let (pair, swirl) = self.interacting_loads_with_swirl(gap, set)?;
        Ok([ActiveLoads::of_equal(pair, swirl); 2])
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        RANGE.check(gap)?;
        check(set)?;
        if let Some(unlike) = &self.unlike {
            return Ok(Some(unlike.error(gap, set)?));
        }
        match self.form(gap, set)? {
            Form::NearContact(form) => Ok(Some(form.error())),
            Form::Series => Ok(Some(self.series_error(gap, set)?)),
            Form::FarField(form) => Ok(Some(form.error())),
        }
    }

    fn fingerprint(&self) -> String {
        let of = self.unlike.as_ref().map_or_else(String::new, |unlike| {
            format!(", radius ratio {:?}", unlike.terms.ratio)
        });
        format!(
            "exact, terms times {}, revision {REVISION}{of}",
            self.factor
        )
    }
}
