//! The one number that the hydrodynamics of a pair depends on: the gap between the surfaces.

use crate::SceneError;
use crate::elementary::exp;

/// Dimensionless gap `eps = (|x2 - x1| - a_1 - a_2)/a_1 > 0` between the surfaces of two spheres.
///
/// The gap is kept with its logarithm: motion carries `ln eps` as a variable of its own, so that
/// spheres cannot overlap and no digit is lost near contact, and lubrication needs
/// `L = ln(1/eps)`.
///
/// ```
/// use scene::Gap;
/// let gap = Gap::new(0.01)?;
/// assert_eq!(gap.eps(), 0.01);
/// assert!((gap.log_inverse() - 100f64.ln()).abs() < 1e-14);
/// assert!((gap.distance() - 2.01).abs() < 1e-15);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Gap {
    eps: f64,
    ln: f64,
}

impl Gap {
    /// The gap `eps`, in radii of sphere 1.
    ///
    /// # Errors
    /// [`SceneError::InvalidGap`] unless `eps` is positive and finite.
    pub fn new(eps: f64) -> Result<Self, SceneError> {
        if eps > 0.0 && eps.is_finite() {
            Ok(Self { eps, ln: eps.ln() })
        } else {
            Err(SceneError::InvalidGap { eps })
        }
    }

    /// The gap whose natural logarithm is `ln`; any finite number is a gap, NaN stays NaN.
    #[inline]
    #[must_use]
    pub fn from_ln(ln: f64) -> Self {
        Self { eps: exp(ln), ln }
    }

    /// `eps`, in radii of sphere 1.
    #[inline]
    #[must_use]
    pub fn eps(self) -> f64 {
        self.eps
    }

    /// `ln eps`.
    #[inline]
    #[must_use]
    pub fn ln(self) -> f64 {
        self.ln
    }

    /// `L = ln(1/eps)`, the large parameter of lubrication theory.
    #[inline]
    #[must_use]
    pub fn log_inverse(self) -> f64 {
        -self.ln
    }

    /// Distance of the centres of equal spheres, `2 + eps`, in sphere radii.
    #[inline]
    #[must_use]
    pub fn distance(self) -> f64 {
        2.0 + self.eps
    }

    /// Distance of the centres of spheres whose radii are in the given `ratio`, `1 + ratio + eps`, in radii of sphere 1.
    #[inline]
    #[must_use]
    pub fn distance_at_ratio(self, ratio: f64) -> f64 {
        1.0 + ratio + self.eps
    }
}
