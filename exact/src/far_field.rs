//! Far apart the loads are power series in the inverse distance of the centres.
//!
//! ```text
//! load = isolated + Σ_(p=1..8) c_p r^-p,   r = 2 + eps
//! ```
//!
//! (the method of reflections: Happel & Brenner, *Low Reynolds number hydrodynamics*, 1965,
//! chapter 6; convergent for r > 2). There the bispherical series loses digits in proportion to
//! `r`, because its pressure is multiplied by the distance from the mirror plane. The factors are
//! fitted to the series' own loads at gaps where it loses none, and checked at gaps not fitted.

use scene::{Gap, LoadSet, PairLoads, SwirlLoads};

use crate::ExactError;
use crate::fit::{Fit, geometric, largest_error};

/// Largest gap at which the series is used.
pub const SERIES_TO: f64 = 100.0;
const FIT_FROM: f64 = 20.0;
const FIT_TO: f64 = 400.0;
const FITTED_GAPS: usize = 24;
const POWERS: usize = 8;
/// Gaps at which the error is measured.
pub const CONTROL_GAPS: [f64; 3] = [77.0, 101.0, 333.0];

/// The far form with its fitted factors.
#[derive(Clone, Debug)]
pub struct FarField {
    fit: Fit,
    error: f64,
}

impl FarField {
    /// Fits the form for the loads of `set` to series with `factor` times the usual number of terms.
    pub fn fit(set: LoadSet, factor: f64) -> Result<Self, ExactError> {
        let fit = Fit::new((&fitted_gaps(), factor), set, powers, |_, set| {
            (PairLoads::isolated(set), SwirlLoads::isolated(set))
        })?;
        let mut form = Self { fit, error: 0.0 };
        form.error = largest_error((&CONTROL_GAPS, factor), set, |gap| {
            (form.loads(gap, set), form.swirl(gap, set))
        })?;
        Ok(form)
    }

    /// The loads at `gap`, of a set that was fitted.
    pub fn loads(&self, gap: Gap, set: LoadSet) -> PairLoads {
        let known = PairLoads::isolated(set);
        self.fit.add_to(&known, &powers(gap))
    }

    /// The loads by swirl at `gap`, of a set that was fitted.
    pub fn swirl(&self, gap: Gap, set: LoadSet) -> SwirlLoads {
        let known = SwirlLoads::isolated(set);
        self.fit.add_to_swirl(&known, set, &powers(gap))
    }

    /// Largest difference from the series at gaps not fitted, relative to the larger of the load
    /// and 1.
    pub fn error(&self) -> f64 {
        self.error
    }
}

/// The gaps that the form is fitted at.
pub fn fitted_gaps() -> Vec<Gap> {
    geometric(FIT_FROM, FIT_TO, FITTED_GAPS)
}

fn powers(gap: Gap) -> Vec<f64> {
    inverse_powers(gap.distance())
}

/// `1/r, 1/r^2, ...`.
pub fn inverse_powers(distance: f64) -> Vec<f64> {
    (1..=POWERS).map(|p| distance.powi(-(p as i32))).collect()
}
