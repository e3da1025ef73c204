//! The limiting forms of the loads of unlike spheres, near contact and far apart.
//!
//! ```text
//! near contact: load = singular + c_0 + Σ_(p=1..4) eps^p (l_p L + c_p),   eps = gap/(smaller radius)
//! far apart:    load = isolated + Σ_(p=1..8) c_p r^-p
//! ```
//!
//! as for equal spheres ([`crate::near_contact`], [`crate::far_field`]), fitted to the series' own loads at the same gaps: in units of
//! the smaller radius near contact, of the larger one far apart. The singular parts are those of [`scene::singular::of_each`].

use scene::{ActiveLoads, Gap, LoadSet, singular};

use super::columns::{columns, from_columns};
use super::series::Solved;
use crate::ExactError;
use crate::far_field::{self, SERIES_TO};
use crate::fit::{Factors, MORE_TERMS, geometric, largest_difference};
use crate::model::ROUNDING;
use crate::near_contact::{self, SERIES_FROM};

/// The radii of a pair and the terms of its series, over the usual number.
#[derive(Clone, Copy, Debug)]
pub struct Terms {
    /// Radius of sphere 2 over that of sphere 1.
    pub ratio: f64,
    /// Factor on the number of terms.
    pub factor: f64,
}

impl Terms {
    /// The solved problems at the gap `eps`.
    pub fn solve(&self, eps: f64, set: LoadSet) -> Result<Solved, ExactError> {
        Solved::new(eps, self.ratio, set, self.factor)
    }

    /// The smallest and the largest gap at which the series is used.
    pub fn seams(&self) -> [f64; 2] {
        [
            SERIES_FROM * self.smaller(),
            SERIES_TO * self.ratio.max(1.0),
        ]
    }

    /// What rounding leaves of the loads at the gap `eps`, and of their sums and differences: measured against the limiting form, up to
    /// nine tenths of this. It is that of equal spheres with the gap in smaller radii, times about the larger radius over the smaller one.
    pub fn rounding(&self, eps: f64) -> f64 {
        let unlikeness = self.ratio.max(1.0) / self.smaller();
        3.0 * ROUNDING * unlikeness * (self.smaller() / eps).max(1.0)
    }

    fn smaller(&self) -> f64 {
        self.ratio.min(1.0)
    }

    fn in_smaller_radii(&self, gap: Gap) -> Gap {
        Gap::from_ln(gap.ln() - self.smaller().ln())
    }

    fn columns(&self, eps: f64, set: LoadSet) -> Result<Vec<f64>, ExactError> {
        Ok(columns(&self.solve(eps, set)?.loads()))
    }

    /// Functions of the gap near contact.
    fn near_contact(&self, gap: Gap) -> Vec<f64> {
        near_contact::powers(self.in_smaller_radii(gap)).into()
    }

    /// Inverse powers of the distance in units of the mean radius.
    fn far_field(&self, gap: Gap) -> Vec<f64> {
        let distance = gap.distance_at_ratio(self.ratio) / (0.5 * (1.0 + self.ratio));
        far_field::inverse_powers(distance)
    }
}

/// Where a form serves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// Below the smallest gap of the series.
    NearContact,
    /// Beyond the largest.
    FarField,
}

/// A limiting form with its fitted factors.
#[derive(Clone, Debug)]
pub struct LimitingForm {
    limit: Limit,
    terms: Terms,
    set: LoadSet,
    factors: Factors,
    error: f64,
}

impl LimitingForm {
    /// Fits the form for the loads of `set`.
    pub fn fit(limit: Limit, terms: Terms, set: LoadSet) -> Result<Self, ExactError> {
        let (gaps, scale) = match limit {
            Limit::NearContact => (near_contact::fitted_gaps(), terms.smaller()),
            Limit::FarField => (far_field::fitted_gaps(), terms.ratio.max(1.0)),
        };
        let gaps: Vec<Gap> = (gaps.iter())
            .map(|gap| Gap::from_ln(gap.ln() + scale.ln()))
            .collect();
        let factors = Factors::new(
            &gaps,
            |gap| functions(limit, terms, gap),
            |gap| terms.columns(gap.eps(), set),
            |gap| columns(&known(limit, terms, gap, set)),
        )?;
        let mut form = Self {
            limit,
            terms,
            set,
            factors,
            error: 0.0,
        };
        form.error = form.measured_error(scale)?;
        Ok(form)
    }

    fn measured_error(&self, scale: f64) -> Result<f64, ExactError> {
        let gaps = match self.limit {
            Limit::NearContact => near_contact::CONTROL_GAPS,
            Limit::FarField => far_field::CONTROL_GAPS,
        };
        let finer = Terms {
            factor: MORE_TERMS * self.terms.factor,
            ..self.terms
        };
        largest_difference(
            &gaps.map(|gap| gap * scale),
            |eps| finer.columns(eps, self.set),
            |gap| columns(&self.loads(gap, self.set)),
        )
    }

    /// The loads at `gap`, of a set that was fitted.
    pub fn loads(&self, gap: Gap, set: LoadSet) -> [ActiveLoads; 2] {
        let functions = functions(self.limit, self.terms, gap);
        let known = columns(&known(self.limit, self.terms, gap, self.set));
        let values: Vec<f64> = (known.iter().enumerate())
            .map(|(k, known)| known + self.factors.combined(k, &functions))
            .collect();
        from_columns(set, self.set, &values)
    }

    /// The factors of the first function: near contact what is left there when the singular parts are taken out.
    pub fn first_factors(&self, set: LoadSet) -> [ActiveLoads; 2] {
        from_columns(set, self.set, &self.factors.of(0))
    }

    /// Largest difference from the series at gaps not fitted, relative to the larger of the load
    /// and 1.
    pub fn error(&self) -> f64 {
        self.error
    }
}

fn functions(limit: Limit, terms: Terms, gap: Gap) -> Vec<f64> {
    match limit {
        Limit::NearContact => terms.near_contact(gap),
        Limit::FarField => terms.far_field(gap),
    }
}

fn known(limit: Limit, terms: Terms, gap: Gap, set: LoadSet) -> [ActiveLoads; 2] {
    match limit {
        Limit::NearContact => singular::of_each(gap, terms.ratio, set, singular::AXIAL_SQUIRMING),
        Limit::FarField => [ActiveLoads::isolated(set); 2],
    }
}

/// The factors of `L` fitted freely near contact, as for equal spheres.
pub fn log_slopes(terms: Terms, set: LoadSet) -> Result<[ActiveLoads; 2], ExactError> {
    let gaps: Vec<Gap> = geometric(SERIES_FROM, 1e-3, 10)
        .iter()
        .map(|gap| Gap::from_ln(gap.ln() + terms.smaller().ln()))
        .collect();
    let factors = Factors::new(
        &gaps,
        |gap| near_contact::singular_functions(terms.in_smaller_radii(gap)),
        |gap| terms.columns(gap.eps(), set),
        |_| vec![0.0; columns(&[ActiveLoads::isolated(set); 2]).len()],
    )?;
    Ok(from_columns(set, set, &factors.of(0)))
}
