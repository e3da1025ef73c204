//! Near contact the series give way to their own asymptotic form.
//!
//! ```text
//! load = singular + c_0 + Σ_(p=1..4) eps^p (l_p L + c_p),   L = ln(1/eps)
//! ```
//!
//! The singular parts are known (see [`scene::singular`]; the powers after Jeffrey & Onishi, *J.
//! Fluid Mech.* 139 (1984) 261); the rest is fitted by least squares to the series' own loads
//! between the gaps [`SERIES_FROM`] and [`FIT_TO`], where neither rounding (which grows as `1/eps`)
//! nor the omitted `eps^5 L` matter. The error is measured at gaps that were not fitted, one of
//! them below the fit.

use scene::{Gap, LoadSet, PairLoads, SwirlLoads, singular};

use crate::ExactError;
use crate::fit::{Fit, geometric, largest_error};

/// Smallest gap at which the series is used; below, its asymptotic form continues it.
pub const SERIES_FROM: f64 = 1e-4;
const FIT_TO: f64 = 1e-2;
const FITTED_GAPS: usize = 60;
const POWERS: usize = 4;
/// Gaps at which the error is measured.
pub const CONTROL_GAPS: [f64; 3] = [5e-5, 1.3e-4, 7.7e-4];

/// The asymptotic form with its fitted constants.
#[derive(Clone, Debug)]
pub struct NearContact {
    fit: Fit,
    error: f64,
}

impl NearContact {
    /// Fits the form for the loads of `set` to series with `factor` times the usual number of terms.
    pub fn fit(set: LoadSet, factor: f64) -> Result<Self, ExactError> {
        let fit = Fit::new((&fitted_gaps(), factor), set, regular_functions, diverging)?;
        let mut form = Self { fit, error: 0.0 };
        form.error = largest_error((&CONTROL_GAPS, factor), set, |gap| {
            (form.loads(gap, set), form.swirl(gap, set))
        })?;
        Ok(form)
    }

    /// The loads at `gap`, of a set that was fitted.
    pub fn loads(&self, gap: Gap, set: LoadSet) -> PairLoads {
        let known = singular::loads(gap, set, singular::AXIAL_SQUIRMING);
        self.fit.add_to(&known, &powers(gap))
    }

    /// The loads by swirl at `gap`, of a set that was fitted.
    pub fn swirl(&self, gap: Gap, set: LoadSet) -> SwirlLoads {
        let known = singular::swirl(gap, set);
        self.fit.add_to_swirl(&known, set, &powers(gap))
    }

    /// What is left of the loads at contact when their singular parts are taken out.
    pub fn constants(&self) -> (PairLoads, SwirlLoads) {
        self.fit.factors(0)
    }

    /// Largest difference from the series at gaps not fitted, relative to the larger of the load
    /// and 1.
    pub fn error(&self) -> f64 {
        self.error
    }
}

/// The gaps that the form is fitted at.
pub fn fitted_gaps() -> Vec<Gap> {
    geometric(SERIES_FROM, FIT_TO, FITTED_GAPS)
}

/// The factors of `L` fitted freely to the loads at gaps between 1e-4 and 1e-3, with nothing known
/// beforehand but the form `s L + c + eps (l L + b) + k/eps`.
pub fn log_slopes(set: LoadSet, factor: f64) -> Result<(PairLoads, SwirlLoads), ExactError> {
    let gaps = geometric(SERIES_FROM, 1e-3, 10);
    let fit = Fit::new((&gaps, factor), set, singular_functions, |_, set| {
        (PairLoads::zero(set), SwirlLoads::zero(set))
    })?;
    Ok(fit.factors(0))
}

/// The known diverging parts.
fn diverging(gap: Gap, set: LoadSet) -> (PairLoads, SwirlLoads) {
    (
        singular::loads(gap, set, singular::AXIAL_SQUIRMING),
        singular::swirl(gap, set),
    )
}

/// `1, eps L, eps, eps^2 L, eps^2, ...`.
pub fn powers(gap: Gap) -> [f64; 1 + 2 * POWERS] {
    let (eps, log) = (gap.eps(), gap.log_inverse());
    let mut functions = [1.0; 1 + 2 * POWERS];
    let mut power = 1.0;
    for pair in functions[1..].chunks_exact_mut(2) {
        power *= eps;
        pair.copy_from_slice(&[power * log, power]);
    }
    functions
}

fn regular_functions(gap: Gap) -> Vec<f64> {
    powers(gap).into()
}

/// `L`, `1`, `eps L`, `eps`, `1/eps`.
pub fn singular_functions(gap: Gap) -> Vec<f64> {
    let (eps, log) = (gap.eps(), gap.log_inverse());
    vec![log, 1.0, eps * log, eps, 1.0 / eps]
}
