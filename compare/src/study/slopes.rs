//! How fast the loads by squirming grow as the gap closes, and which coefficient of lubrication theory holds: its factor of `ln(1/eps)`,
//! fitted to exact loads, next to that which the paper prints and the corrected one.

use exact::Exact;
use rayon::prelude::*;
use scene::{Gap, LoadSet, SceneError, singular};
use serde::Serialize;

use crate::CompareError;
use crate::columns::columns;

columns! {
    /// A row for each ratio of the radii, squirmer and load: the factor of `ln(1/gap)` in the load as the gap closes.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct SlopeRow {
        /// Radius of sphere 2 over that of sphere 1.
        #[unit = "-"]
        pub ratio: f64,
        /// Name of the load, with the number of the loaded sphere and that of the squirming one, and the squirming mode.
        #[unit = "-"]
        pub name: String,
        /// Fitted to exact loads at gaps of 1e-4 to 1e-3 radii of the smaller sphere.
        #[unit = "-"]
        pub exact: f64,
        /// By lubrication theory as the paper prints it.
        #[unit = "-"]
        pub published: f64,
        /// By lubrication theory with 12 in place of 9 in the axial force.
        #[unit = "-"]
        pub corrected: f64,
    }
}

/// The rows for some ratios of the radii, for the squirming modes 1 to `modes`.
///
/// # Errors
/// [`CompareError::Scene`] for a ratio that is not allowed; the errors of the exact model.
pub fn contact_slopes(ratios: &[f64], modes: usize) -> Result<Vec<SlopeRow>, CompareError> {
    let rows: Result<Vec<Vec<SlopeRow>>, CompareError> = ratios
        .par_iter()
        .map(|&ratio| of_ratio(ratio, modes))
        .collect();
    Ok(rows?.concat())
}

fn of_ratio(ratio: f64, modes: usize) -> Result<Vec<SlopeRow>, CompareError> {
    let set = LoadSet::planar(modes);
    let exact = Exact::of_ratio(ratio).map_err(SceneError::from)?;
    let slopes = exact.log_slopes_of_each(set).map_err(SceneError::from)?;
    // Where the logarithm is 1: squirming loads have no other part than its coefficient times it.
    let gap = Gap::from_ln(ratio.min(1.0).ln() - 1.0);
    let of_form = |form: lt::Form| {
        let loads = singular::of_each(gap, ratio, set, form.axial_squirming());
        [0, 1].map(|k| loads[k].named(k + 1))
    };
    let (published, corrected) = (of_form(lt::Form::Published), of_form(lt::Form::Corrected));
    let mut rows = Vec::new();
    for k in [0, 1] {
        let exact = slopes[k].named(k + 1).into_iter();
        for (((name, exact), (_, published)), (_, corrected)) in
            exact.zip(&published[k]).zip(&corrected[k])
        {
            // Those by squirming.
            if name.starts_with("XF") || name.starts_with("YF") || name.starts_with("YT") {
                rows.push(SlopeRow {
                    ratio,
                    name,
                    exact,
                    published: *published,
                    corrected: *corrected,
                });
            }
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
    use super::*;

    #[test]
    fn val_the_corrected_coefficients_hold_at_all_radii_and_the_published_ones_but_for_the_axial_force()
     {
        let rows = contact_slopes(&[0.5, 2.0], 2).unwrap();
        // Two ratios, two squirmers, two modes, three loads on two spheres.
        assert_eq!(rows.len(), 48);
        for row in rows {
            let close = |coefficient: f64| (row.exact / coefficient - 1.0).abs() < 1e-3;
            assert!(close(row.corrected), "{row:?}");
            assert_eq!(close(row.published), !row.name.starts_with("XF"), "{row:?}");
            if row.name.starts_with("XF") {
                assert!((row.published / row.corrected - 0.75).abs() < 1e-12);
            }
        }
    }
}
