//! The rows of `kinetics.csv`, and what lubrication theory makes of each coefficient.

use serde::{Deserialize, Serialize};

use super::integrals::{Coefficients, mean_and_error};
use crate::Method;
use crate::columns::columns;

columns! {
    /// A row for each method, beta and largest impact parameter. `n` is the number of squirmers in a volume `a^3`. An error is the standard
    /// error from independent replications of the quasi-random points. docs/KINETICS.md has the definitions.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct KineticsRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of all squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Largest impact parameter of an encounter, of the straight paths that the pair comes on.
        #[unit = "a"]
        pub impact: f64,
        /// Rate of encounters of one squirmer, over n.
        #[unit = "a^2 V_s"]
        pub encounters: f64,
        /// Share of encounters that come within the gap 1.
        #[unit = "-"]
        pub meeting: f64,
        /// Share of encounters that part.
        #[unit = "-"]
        pub parting: f64,
        /// Share of encounters that stay together to the end of the run.
        #[unit = "-"]
        pub bound: f64,
        /// Share of encounters that touch, or come nearer than the model resolves.
        #[unit = "-"]
        pub contact: f64,
        /// Share of encounters whose run failed.
        #[unit = "-"]
        pub failed: f64,
        /// Mean time at gaps up to 1 of encounters that part.
        #[unit = "a/V_s"]
        pub tau: f64,
        /// Error of `tau`.
        #[unit = "a/V_s"]
        pub tau_error: f64,
        /// Rotational diffusivity by encounters, over n.
        #[unit = "a^2 V_s"]
        pub rotation: f64,
        /// Error of `rotation`.
        #[unit = "a^2 V_s"]
        pub rotation_error: f64,
        /// Translational diffusivity that follows from the rotational one, times n.
        #[unit = "V_s/a^2"]
        pub translation: f64,
        /// Error of `translation`.
        #[unit = "V_s/a^2"]
        pub translation_error: f64,
        /// Diffusivity by displacements besides swimming, over n. With a far field it grows as the logarithm of `impact`.
        #[unit = "a^4 V_s"]
        pub displacement: f64,
        /// Error of `displacement`.
        #[unit = "a^4 V_s"]
        pub displacement_error: f64,
        /// Mean change of the scalar product of both headings in encounters that part.
        #[unit = "-"]
        pub alignment: f64,
        /// Error of `alignment`.
        #[unit = "-"]
        pub alignment_error: f64,
        /// Growth rate of a slight polar order by encounters, over n.
        #[unit = "a^2 V_s"]
        pub growth: f64,
        /// Error of `growth`.
        #[unit = "a^2 V_s"]
        pub growth_error: f64,
        /// Number of encounters of all replications.
        #[unit = "-"]
        pub points: usize,
        /// Number of replications.
        #[unit = "-"]
        pub replications: usize,
    }
}

columns! {
    /// A row for each method but the exact one, beta, largest impact parameter and coefficient: what the method makes of it. Both
    /// methods have the same encounters, so that errors of differences are smaller than those of each.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct KineticsRatioRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of all squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Largest impact parameter of an encounter.
        #[unit = "a"]
        pub impact: f64,
        /// Name of the coefficient, a column of `kinetics.csv`.
        #[unit = "-"]
        pub quantity: String,
        /// By the method less by exact hydrodynamics, in the unit of the coefficient.
        #[unit = "varies"]
        pub difference: f64,
        /// Error of `difference`.
        #[unit = "varies"]
        pub difference_error: f64,
        /// By the method over by exact hydrodynamics. NaN where the exact coefficient is within three of its errors, or 1e-5, of zero.
        #[unit = "-"]
        pub ratio: f64,
        /// Error of `ratio`.
        #[unit = "-"]
        pub ratio_error: f64,
    }
}

/// A coefficient within this of zero is zero, but for the tolerance of the integrator.
const ZERO: f64 = 1e-5;

/// The replications of the coefficients of one method, beta and largest impact parameter.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// The method.
    pub method: Method,
    /// Squirmer parameter.
    pub beta: f64,
    /// Largest impact parameter.
    pub impact: f64,
    /// Encounters of each replication.
    pub points: usize,
    /// The coefficients of each replication.
    pub replications: Vec<Coefficients>,
}

impl Estimate {
    fn values(&self, of: impl Fn(&Coefficients) -> f64) -> Vec<f64> {
        self.replications.iter().map(of).collect()
    }

    fn mean(&self, of: impl Fn(&Coefficients) -> f64) -> f64 {
        mean_and_error(&self.values(of)).0
    }

    /// The row.
    #[must_use]
    pub fn row(&self) -> KineticsRow {
        let of = |of: fn(&Coefficients) -> f64| mean_and_error(&self.values(of));
        let (tau, tau_error) = of(|of| of.tau);
        let (rotation, rotation_error) = of(|of| of.rotation);
        // The reciprocal of a mean: the mean of reciprocals is biased, and infinite where one replication turns nothing.
        let translation = 1.0 / (6.0 * rotation);
        let (displacement, displacement_error) = of(|of| of.displacement);
        let (alignment, alignment_error) = of(|of| of.alignment);
        let (growth, growth_error) = of(|of| of.growth);
        KineticsRow {
            method: self.method,
            beta: self.beta,
            impact: self.impact,
            encounters: self.mean(|of| of.encounters),
            meeting: self.mean(|of| of.means.meeting),
            parting: self.mean(|of| of.means.parting),
            bound: self.mean(|of| of.means.bound),
            contact: self.mean(|of| of.means.contact),
            failed: self.mean(|of| of.means.failed),
            tau,
            tau_error,
            rotation,
            rotation_error,
            translation,
            translation_error: translation * rotation_error / rotation,
            displacement,
            displacement_error,
            alignment,
            alignment_error,
            growth,
            growth_error,
            points: self.points * self.replications.len(),
            replications: self.replications.len(),
        }
    }

    /// What this method makes of each coefficient, against the exact one at the same beta and impact parameter.
    #[must_use]
    pub fn against(&self, exact: &Self) -> Vec<KineticsRatioRow> {
        let row = |&(name, of): &(&'static str, fn(&Coefficients) -> f64)| {
            let (own, truth) = (self.values(of), exact.values(of));
            let (value, _) = mean_and_error(&own);
            let (reference, error) = mean_and_error(&truth);
            let pairs = || own.iter().zip(&truth);
            let differences: Vec<f64> = pairs().map(|(own, truth)| own - truth).collect();
            let (difference, difference_error) = mean_and_error(&differences);
            // A coefficient that is zero but for sampling has no ratio.
            let (ratio, ratio_error) = if reference.abs() > (3.0 * error).max(ZERO) {
                let ratio = value / reference;
                let off: Vec<f64> = pairs().map(|(own, truth)| own - ratio * truth).collect();
                (ratio, mean_and_error(&off).1 / reference.abs())
            } else {
                (f64::NAN, f64::NAN)
            };
            KineticsRatioRow {
                method: self.method,
                beta: self.beta,
                impact: self.impact,
                quantity: name.to_owned(),
                difference,
                difference_error,
                ratio,
                ratio_error,
            }
        };
        Coefficients::ALL.iter().map(row).collect()
    }
}

/// What each other method makes of each coefficient of the exact one; none without it.
#[must_use]
pub fn ratios(estimates: &[Estimate]) -> Vec<KineticsRatioRow> {
    let exact = |of: &Estimate| {
        (estimates.iter()).find(|exact| {
            exact.method == Method::Exact
                && exact.beta.total_cmp(&of.beta).is_eq()
                && exact.impact.total_cmp(&of.impact).is_eq()
        })
    };
    (estimates.iter())
        .filter(|of| of.method != Method::Exact)
        .filter_map(|of| Some(of.against(exact(of)?)))
        .flatten()
        .collect()
}
