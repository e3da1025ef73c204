//! The referee as a hydrodynamic model: series where they serve, their limiting forms beyond.

use std::sync::OnceLock;

use scene::{Gap, GapRange, Hydrodynamics, MAX_MODES, PairLoads, SceneError};

use crate::ExactError;
use crate::far_field::{FarField, SERIES_TO};
use crate::fit::relative_distance;
use crate::geometry::Geometry;
use crate::near_contact::{self, NearContact, SERIES_FROM};
use crate::series::Solved;

/// Pairs of surface points at which the residual is taken.
const RESIDUAL_POINTS: usize = 24;
/// To be raised with every change that changes loads.
const REVISION: u32 = 1;
/// Rounding of the matrices over the gap. It hardly shows when terms are added, because the
/// entries stay the same; against series in 80-bit arithmetic it is 0.8e-14 over the gap.
const ROUNDING: f64 = 1e-14;

/// Pair loads to about ten digits at every gap: bispherical series, continued to contact by the
/// asymptotic form and to infinity by inverse powers of the distance, both with constants fitted
/// to the series (once, when first needed).
///
/// ```
/// use exact::Exact;
/// use scene::{Gap, Hydrodynamics};
/// let loads = Exact::new().loads(Gap::new(1.0)?, 2)?;
/// assert!((loads.xa.own() - 1.3684796).abs() < 1e-7);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Exact {
    factor: f64,
    near_contact: OnceLock<NearContact>,
    far_field: OnceLock<FarField>,
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
            near_contact: OnceLock::new(),
            far_field: OnceLock::new(),
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

    /// Highest degree of the series at `gap` for `modes` squirming modes.
    ///
    /// # Errors
    /// [`ExactError::TooManyTerms`] at a gap too small for the series.
    pub fn terms(&self, gap: Gap, modes: usize) -> Result<usize, ExactError> {
        Ok(Geometry::new(gap.eps(), modes, self.factor)?.degree)
    }

    /// The loads by the series, also where [`Hydrodynamics::loads`] takes the asymptotic form.
    ///
    /// # Errors
    /// [`ExactError::TooManyTerms`] at a gap too small for the series,
    /// [`ExactError::TooManyModes`].
    pub fn series_loads(&self, gap: Gap, modes: usize) -> Result<PairLoads, ExactError> {
        Ok(Solved::new(gap.eps(), modes, self.factor)?.loads())
    }

    /// The loads by the asymptotic form, whatever the gap.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn near_contact_loads(&self, gap: Gap, modes: usize) -> Result<PairLoads, ExactError> {
        check_modes(modes)?;
        Ok(self.near_contact()?.loads(gap, modes))
    }

    /// What is left of the loads at contact when their singular parts are taken out.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn contact_constants(&self, modes: usize) -> Result<PairLoads, ExactError> {
        check_modes(modes)?;
        let columns: Vec<f64> = self.near_contact()?.constants().columns().collect();
        Ok(PairLoads::from_columns(modes, &columns))
    }

    /// The factors of `L = ln(1/eps)` in the loads, fitted freely to the series at gaps between
    /// 1e-4 and 1e-3: what lubrication theory has to reproduce.
    ///
    /// # Errors
    /// [`ExactError::TooManyModes`].
    pub fn log_slopes(&self, modes: usize) -> Result<PairLoads, ExactError> {
        near_contact::log_slopes(modes)
    }

    /// Largest difference between the flow and its boundary velocity (of order 1) at surface points
    /// that were not fitted. The loads are closer than this: their error is its square, but for
    /// rounding.
    ///
    /// # Errors
    /// As [`Self::series_loads`].
    pub fn residual(&self, gap: Gap, modes: usize) -> Result<f64, ExactError> {
        Ok(Solved::new(gap.eps(), modes, self.factor)?.residual(RESIDUAL_POINTS))
    }

    fn near_contact(&self) -> Result<&NearContact, ExactError> {
        get_or_fit(&self.near_contact, NearContact::fit)
    }

    fn form(&self, gap: Gap) -> Result<Form<'_>, ExactError> {
        Ok(if gap.eps() < SERIES_FROM {
            Form::NearContact(self.near_contact()?)
        } else if gap.eps() > SERIES_TO {
            Form::FarField(get_or_fit(&self.far_field, FarField::fit)?)
        } else {
            Form::Series
        })
    }

    /// What half as many terms again change, or two formulas for one load disagree by, or rounding.
    fn series_error(&self, gap: Gap, modes: usize) -> Result<f64, ExactError> {
        let solved = Solved::new(gap.eps(), modes, self.factor)?;
        let loads = solved.loads();
        let finer = Solved::new(gap.eps(), modes, 1.5 * self.factor)?.loads();
        let by_terms = relative_distance(&loads, &finer);
        let by_formula = relative_distance(&loads, &solved.loads_by_second_formula());
        let by_rounding = ROUNDING * (1.0 / gap.eps()).max(1.0);
        Ok(by_terms.max(by_formula).max(by_rounding))
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

fn check_modes(modes: usize) -> Result<(), ExactError> {
    if modes > MAX_MODES {
        return Err(ExactError::TooManyModes {
            modes,
            allowed: MAX_MODES,
        });
    }
    Ok(())
}

impl Hydrodynamics for Exact {
    fn range(&self) -> GapRange {
        GapRange {
            smallest: f64::MIN_POSITIVE,
            largest: f64::INFINITY,
        }
    }

    fn loads(&self, gap: Gap, modes: usize) -> Result<PairLoads, SceneError> {
        self.range().check(gap)?;
        check_modes(modes)?;
        match self.form(gap)? {
            Form::NearContact(form) => Ok(form.loads(gap, modes)),
            Form::Series => Ok(self.series_loads(gap, modes)?),
            Form::FarField(form) => Ok(form.loads(gap, modes)),
        }
    }

    fn error_estimate(&self, gap: Gap, modes: usize) -> Result<f64, SceneError> {
        self.range().check(gap)?;
        check_modes(modes)?;
        match self.form(gap)? {
            Form::NearContact(form) => Ok(form.error()),
            Form::Series => Ok(self.series_error(gap, modes)?),
            Form::FarField(form) => Ok(form.error()),
        }
    }

    fn seams(&self) -> Vec<f64> {
        vec![SERIES_FROM, SERIES_TO]
    }

    fn fingerprint(&self) -> String {
        format!("exact, terms times {}, revision {REVISION}", self.factor)
    }

    fn noise(&self) -> f64 {
        // At the smallest gap that the series serve; it falls as the gap grows.
        ROUNDING / SERIES_FROM
    }
}
