//! The loads near contact: what diverges, and the next constant.

use scene::{Gap, SceneError, singular};
use serde::Serialize;

use super::digits::Digits;
use super::gaps::ExactOf;
use super::loads::{LOADS, named, relative_error};
use crate::CompareError;
use crate::columns::columns;
use crate::numbers::as_typed;

columns! {
    /// A row for each ratio of the radii and load: near contact it is `inverse/eps + logarithm ln(1/eps) + constant`, with terms of
    /// the order `eps ln(1/eps)` left out, where `eps` is the gap over the radius of the smaller sphere. Names are those of loads.csv. The first two
    /// coefficients are closed forms of lubrication theory, with 3 and not 9/4 in the axial force of equal squirmers; the constant
    /// is fitted to exact loads.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct NearContactRow {
        /// Radius of sphere 2 over that of sphere 1.
        #[unit = "-"]
        pub ratio: f64,
        /// Name of the load.
        #[unit = "-"]
        pub name: String,
        /// Coefficient of `1/eps`.
        #[unit = "-"]
        pub inverse: f64,
        /// Coefficient of `ln(1/eps)`.
        #[unit = "-"]
        pub logarithm: f64,
        /// The constant, down to the last digit that the error leaves.
        #[unit = "-"]
        pub constant: String,
        /// Largest difference of the printed constant from the exact one, with that of rounding.
        #[unit = "-"]
        pub error_estimate: String,
    }
}

/// A gap, in smaller radii, at which the loads follow from their form near contact.
const CLOSE: f64 = 1e-9;

/// The rows of all models.
///
/// # Errors
/// Those of the exact model.
pub fn near_contact(models: &[ExactOf]) -> Result<Vec<NearContactRow>, CompareError> {
    let rows: Result<Vec<_>, CompareError> = models.iter().map(of_ratio).collect();
    Ok(rows?.concat())
}

fn of_ratio(of: &ExactOf) -> Result<Vec<NearContactRow>, CompareError> {
    let ratio = of.ratio;
    let smaller = ratio.min(1.0);
    let singular_at = |log: f64| {
        let gap = Gap::from_ln(smaller.ln() - log);
        let loads = singular::of_each(gap, ratio, LOADS, singular::AXIAL_SQUIRMING);
        named(ratio, &loads, 0.0)
    };
    // Where the logarithm is 0 the gap is 1, and where it is 1 the inverse of the gap is e.
    let (without, with) = (singular_at(0.0), singular_at(1.0));
    let constants = (of.exact.contact_constants_of_each(LOADS)).map_err(SceneError::from)?;
    let relative = relative_error(&of.exact, Gap::new(CLOSE * smaller)?)?;
    let constants = named(ratio, &constants, relative);
    let rows = without.into_iter().zip(with).zip(constants);
    Ok(rows
        .map(
            |(((name, inverse, _), (_, with, _)), (_, constant, error))| {
                let digits = Digits::of(constant, error);
                NearContactRow {
                    ratio,
                    name,
                    inverse: clean(inverse),
                    logarithm: clean(with - std::f64::consts::E * inverse),
                    constant: digits.value,
                    error_estimate: digits.error,
                }
            },
        )
        .collect())
}

/// A closed form without what rounding has left of it.
fn clean(coefficient: f64) -> f64 {
    // Thirteen digits after the point, and no negative zeros.
    as_typed(coefficient, 0.1) + 0.0
}
