//! Ratios of two radii, that of sphere 2 over that of sphere 1.

use std::ops::RangeInclusive;

use crate::SceneError;

/// The ratios that models and scenes allow.
pub const RATIOS: RangeInclusive<f64> = 0.01..=100.0;

/// The ratio, or a radius in radii of the first squirmer, if it is one of [`RATIOS`].
///
/// # Errors
/// [`SceneError::Radius`].
pub fn checked_ratio(ratio: f64) -> Result<f64, SceneError> {
    if RATIOS.contains(&ratio) {
        Ok(ratio)
    } else {
        Err(SceneError::Radius {
            radius: ratio,
            smallest: *RATIOS.start(),
            largest: *RATIOS.end(),
        })
    }
}

/// Whether two spheres are unlike. Equal means exactly equal: the models of equal spheres are others, with fewer loads.
///
/// ```
/// assert!(scene::are_unlike(1.5));
/// assert!(!scene::are_unlike(1.0));
/// ```
#[must_use]
pub fn are_unlike(ratio: f64) -> bool {
    #[expect(clippy::float_cmp, reason = "equal means exactly equal")]
    let unlike = ratio != 1.0;
    unlike
}
