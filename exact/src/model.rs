//! The referee as a hydrodynamic model: series where they serve, their limiting forms beyond.

use std::sync::OnceLock;

use scene::{
    Gap, GapRange, Hydrodynamics, LoadSet, MAX_MODES, ModelDescription, PairLoads, SceneError,
    SwirlLoads,
};

use crate::ExactError;
use crate::error::check;
use crate::far_field::{FarField, SERIES_TO};
use crate::fit::{MORE_TERMS, relative_distance};
use crate::geometry::Geometry;
use crate::near_contact::{self, NearContact, SERIES_FROM};
use crate::series::Solved;

/// Pairs of surface points at which the residual is taken.
const RESIDUAL_POINTS: usize = 24;
/// To be raised with every change that changes loads.
const REVISION: u32 = 2;
/// Rounding of the matrices over the gap. It hardly shows when terms are added, because the
/// entries stay the same; against series in 80-bit arithmetic it is 0.8e-14 over the gap.
const ROUNDING: f64 = 1e-14;

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
#[derive(Clone, Debug)]
pub struct Exact {
    factor: f64,
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
    /// The model with the number of terms that reaches rounding.
    #[must_use]
    pub fn new() -> Self {
        Self {
            factor: 1.0,
            near_contact: Default::default(),
            far_field: Default::default(),
        }
    }

    /// The model with `factor` times as many terms, to see what they change.
    ///
    /// # Errors
    /// [`ExactError::InvalidTermsFactor`] unless `0.25 <= factor <= 16`.
    pub fn with_terms(factor: f64) -> Result<Self, ExactError> {
        if (0.25..=16.0).contains(&factor) {
            Ok(Self {
                factor,
                ..Self::new()
            })
        } else {
            Err(ExactError::InvalidTermsFactor { factor })
        }
    }

    /// Highest degree of the series at `gap` for the loads of `set`.
    ///
    /// # Errors
    /// [`ExactError::TooManyTerms`] at a gap too small for the series.
    pub fn terms(&self, gap: Gap, set: LoadSet) -> Result<usize, ExactError> {
        Ok(Geometry::new(gap.eps(), set.modes, self.factor)?.degree)
    }

    /// The loads by the series, also where [`Hydrodynamics::loads`] takes the asymptotic form.
    ///
    /// # Errors
    /// [`ExactError::TooManyTerms`] at a gap too small for the series,
    /// [`ExactError::TooManyModes`].
    pub fn series_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, ExactError> {
        Ok(Solved::new(gap.eps(), set, self.factor)?.loads())
    }

    /// The loads by the asymptotic form, whatever the gap.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn near_contact_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, ExactError> {
        check(set)?;
        Ok(self.near_contact(set)?.loads(gap, set))
    }

    /// What is left of the loads at contact when their singular parts are taken out.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn contact_constants(&self, set: LoadSet) -> Result<PairLoads, ExactError> {
        check(set)?;
        let (constants, _) = self.near_contact(set)?.constants();
        let columns: Vec<f64> = constants.columns().collect();
        Ok(PairLoads::from_columns(set, constants.set(), &columns))
    }

    /// The factors of `L = ln(1/eps)` in the loads, fitted freely to the series at gaps between
    /// 1e-4 and 1e-3: what lubrication theory has to reproduce.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn log_slopes(&self, set: LoadSet) -> Result<(PairLoads, SwirlLoads), ExactError> {
        check(set)?;
        near_contact::log_slopes(set, self.factor)
    }

    /// Largest difference between the flow and its boundary velocity (of order 1) at surface points
    /// that were not fitted. The loads are closer than this: their error is its square, but for
    /// rounding.
    ///
    /// # Errors
    /// As [`Self::series_loads`].
    pub fn residual(&self, gap: Gap, set: LoadSet) -> Result<f64, ExactError> {
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

/// Limiting forms are fitted for sets with and without transverse loads and swirl.
const KINDS: usize = 4;

/// Which of the limiting forms serves for a set.
fn kind(set: LoadSet) -> usize {
    usize::from(set.transverse.any()) + 2 * usize::from(set.swirl > 0)
}

/// All loads of the kind of a set.
fn whole(set: LoadSet) -> LoadSet {
    LoadSet {
        swirl: if set.swirl > 0 { MAX_MODES } else { 0 },
        twist: true,
        ..if set.transverse.any() {
            LoadSet::planar(MAX_MODES)
        } else {
            LoadSet::axial(MAX_MODES)
        }
    }
}

/// Not `get_or_init` with the fit inside: a fit runs on the threads of the pool, one of which may
/// come back here for the same form and would wait for itself. Two fits at once do no harm.
fn get_or_fit<T>(
    cell: &OnceLock<T>,
    fit: impl Fn() -> Result<T, ExactError>,
) -> Result<&T, ExactError> {
    match cell.get() {
        Some(form) => Ok(form),
        None => {
            let form = fit()?;
            Ok(cell.get_or_init(|| form))
        }
    }
}

/// The series and their limiting forms answer at every gap.
const RANGE: GapRange = GapRange::from(f64::MIN_POSITIVE);

impl Hydrodynamics for Exact {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            range: RANGE,
            cutoff: None,
            seams: &[SERIES_FROM, SERIES_TO],
            // At the smallest gap that the series serve; it falls as the gap grows.
            noise: ROUNDING / SERIES_FROM,
        }
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        RANGE.check(gap)?;
        check(set)?;
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
        match self.form(gap, set)? {
            Form::NearContact(form) => Ok((form.loads(gap, set), form.swirl(gap, set))),
            Form::Series => {
                let solved = Solved::new(gap.eps(), set, self.factor)?;
                Ok((solved.loads(), solved.swirl_loads()))
            }
            Form::FarField(form) => Ok((form.loads(gap, set), form.swirl(gap, set))),
        }
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        RANGE.check(gap)?;
        check(set)?;
        match self.form(gap, set)? {
            Form::NearContact(form) => Ok(Some(form.error())),
            Form::Series => Ok(Some(self.series_error(gap, set)?)),
            Form::FarField(form) => Ok(Some(form.error())),
        }
    }

    fn fingerprint(&self) -> String {
        format!("exact, terms times {}, revision {REVISION}", self.factor)
    }
}
