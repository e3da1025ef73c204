//! The referee for spheres of unlike radii: series where they serve, their limiting forms beyond.

use std::sync::OnceLock;

use scene::{ActiveLoads, Gap, LoadSet};

use super::columns::columns;
use super::limits::{Limit, LimitingForm, Terms, log_slopes};
use crate::ExactError;
use crate::fit::{MORE_TERMS, relative_distance};
use crate::kinds::{KINDS, get_or_fit, kind, whole};

/// A pair of unlike radii, with the limiting forms that were called for.
#[derive(Clone, Debug)]
pub struct Unlike {
    /// Radii and terms.
    pub terms: Terms,
    /// Smallest and largest gap of the series.
    pub seams: [f64; 2],
    near_contact: [OnceLock<LimitingForm>; KINDS],
    far_field: [OnceLock<LimitingForm>; KINDS],
}

impl Unlike {
    /// A pair whose limiting forms are not fitted yet.
    pub fn new(terms: Terms) -> Self {
        Self {
            terms,
            seams: terms.seams(),
            near_contact: Default::default(),
            far_field: Default::default(),
        }
    }

    /// A limiting form, for all loads of the kind of `set`.
    pub fn form(&self, limit: Limit, set: LoadSet) -> Result<&LimitingForm, ExactError> {
        let cells = match limit {
            Limit::NearContact => &self.near_contact,
            Limit::FarField => &self.far_field,
        };
        get_or_fit(&cells[kind(set)], || {
            LimitingForm::fit(limit, self.terms, whole(set))
        })
    }

    fn limit(&self, gap: Gap) -> Option<Limit> {
        let [smallest, largest] = self.seams;
        if gap.eps() < smallest {
            Some(Limit::NearContact)
        } else if gap.eps() > largest {
            Some(Limit::FarField)
        } else {
            None
        }
    }

    /// The loads of either active sphere.
    pub fn loads(&self, gap: Gap, set: LoadSet) -> Result<[ActiveLoads; 2], ExactError> {
        match self.limit(gap) {
            Some(limit) => Ok(self.form(limit, set)?.loads(gap, set)),
            None => Ok(self.terms.solve(gap.eps(), set)?.loads()),
        }
    }

    /// The factors of `L` near contact.
    pub fn log_slopes(&self, set: LoadSet) -> Result<[ActiveLoads; 2], ExactError> {
        log_slopes(self.terms, set)
    }

    /// The error of a limiting form; of the series what half as many terms again change, or two formulas for one load disagree by, or
    /// rounding.
    pub fn error(&self, gap: Gap, set: LoadSet) -> Result<f64, ExactError> {
        if let Some(limit) = self.limit(gap) {
            return Ok(self.form(limit, set)?.error());
        }
        let Terms { ratio, factor } = self.terms;
        let solved = self.terms.solve(gap.eps(), set)?;
        let finer = Terms {
            ratio,
            factor: MORE_TERMS * factor,
        };
        let loads = columns(&solved.loads());
        let by_terms = relative_distance(&loads, &columns(&finer.solve(gap.eps(), set)?.loads()));
        let by_formula = relative_distance(&loads, &columns(&solved.loads_by_second_formula()));
        let by_rounding = self.terms.rounding(gap.eps());
        Ok(by_terms.max(by_formula).max(by_rounding))
    }
}
