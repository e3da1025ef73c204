//! The ratios of radii and the gaps of the package.

use exact::Exact;
use scene::SceneError;

use crate::CompareError;
use crate::numbers::as_typed;

/// Radii of sphere 2 over that of sphere 1.
pub const RATIOS: [f64; 5] = [0.1, 0.5, 1.0, 2.0, 10.0];

/// Decades of the gaps, from 1e-6 to 100.
const DECADES: std::ops::Range<i32> = -6..2;

/// First digits of the gaps of a decade. With 1, 2 and 5 the gaps meet those of published tables.
const FIRST_DIGITS: [u8; 4] = [1, 2, 3, 5];

/// Gaps in units of the mean radius: 1, 2, 3 and 5 in each decade from 1e-6, and 100.
pub fn gaps() -> impl Iterator<Item = f64> {
    let of = |decade: i32| FIRST_DIGITS.map(|digit| f64::from(digit) * 10_f64.powi(decade));
    DECADES.flat_map(of).chain([100.0]).map(cleaned)
}

/// The same gaps in radii of sphere 1, for spheres whose radii are in the given `ratio`.
pub fn gaps_of_ratio(ratio: f64) -> Vec<f64> {
    let mean = 0.5 * (1.0 + ratio);
    gaps().map(|gap| cleaned(mean * gap)).collect()
}

/// A gap without the digits that are only rounding.
fn cleaned(gap: f64) -> f64 {
    as_typed(gap, gap)
}

/// The exact model of a ratio of radii.
#[derive(Debug)]
pub struct ExactOf {
    /// Radius of sphere 2 over that of sphere 1.
    pub ratio: f64,
    /// The model.
    pub exact: Exact,
}

impl ExactOf {
    /// The models of all [`RATIOS`].
    ///
    /// # Errors
    /// Those of the exact model.
    pub fn all() -> Result<Vec<Self>, CompareError> {
        (RATIOS.into_iter())
            .map(|ratio| {
                let exact = Exact::of_ratio(ratio).map_err(SceneError::from)?;
                Ok(Self { ratio, exact })
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_rise_from_a_millionth_to_a_hundred_and_print_as_typed() {
        let gaps: Vec<f64> = gaps().collect();
        assert_eq!(gaps.len(), 33);
        assert!(gaps.windows(2).all(|two| two[0] < two[1]));
        assert_eq!(gaps[..3], [1e-6, 2e-6, 3e-6]);
        assert_eq!(gaps.last(), Some(&100.0));
        let of_half = gaps_of_ratio(0.5);
        assert_eq!(of_half[..1], [7.5e-7]);
        assert!(of_half.iter().all(|gap| gap.to_string().len() < 12));
    }
}
