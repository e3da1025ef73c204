//! The shape of the pressure between two close spheres.
//!
//! Squeezed out of the gap of width `H = 2 + eps - 2 z` (z along the line of centres, from the
//! sphere's own centre), the fluid's pressure goes as `1/H²` (Kim & Karrila, *Microhydrodynamics*
//! (2005), section 9.2). Normal densities are interpolated relative to it.

use nalgebra::Vector3;

/// `φ = 1/H²`, or 1 for a sphere alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    gap: f64,
}

impl Profile {
    /// The profile beside a mirror image at the gap `eps` on the side of `+z`.
    #[must_use]
    pub fn beside_mirror_image(eps: f64) -> Self {
        Self { gap: eps }
    }

    /// No profile: a sphere alone.
    #[must_use]
    pub fn alone() -> Self {
        Self { gap: f64::INFINITY }
    }

    /// Width of the gap at a point of the unit sphere.
    #[inline]
    pub(crate) fn width(&self, point: &Vector3<f64>) -> f64 {
        2.0 + self.gap - 2.0 * point.z
    }

    /// The profile at a point of the unit sphere.
    #[inline]
    pub fn at(&self, point: &Vector3<f64>) -> f64 {
        if self.gap.is_finite() {
            self.width(point).powi(-2)
        } else {
            1.0
        }
    }
}
