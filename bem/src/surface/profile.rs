//! The shape of the pressure between two close spheres.
//!
//! Squeezed out of the gap of width `H = 2 + eps - 2 z` (z along the line of centres, from the
//! sphere's own centre), the fluid's pressure goes as `1/H²` (Kim & Karrila, *Microhydrodynamics*
//! (2005), section 9.2). Normal densities are interpolated relative to it. Spheres of unlike radii have it too, each beside its mirror image
//! in the right plane ([`mirror_gap`]).

use nalgebra::Vector3;

/// Gap between a sphere and its mirror image beside another sphere of any radius, in its own radii; `gap` and the radii `[own, other]` are in one
/// unit.
///
/// The mirror is the radical plane, from whose points the tangents to both spheres are as long. A point of the sphere at the height z has the
/// power `w (w + 2 q)`, w its distance from the other sphere, with regard to that: it is linear in z, as the width `H = 2 + e - 2 z` beside a
/// mirror image is, and vanishes with it at
///
/// ```text
/// e = (2 q eps + eps²)/(1 + q + eps),   q = other/own,   eps = gap/own.
/// ```
///
/// Near contact `H = w 2 q/(1 + q)`: one and the same multiple of the gap's width all over the cap, so that all that goes by its shape holds
/// for the sphere beside its mirror image. Equal spheres have `e = eps`.
#[must_use]
pub fn mirror_gap(gap: f64, [own, other]: [f64; 2]) -> f64 {
    let eps = gap / own;
    #[expect(clippy::float_cmp, reason = "equal means exactly equal")]
    if own == other || !eps.is_finite() {
        return eps;
    }
    let q = other / own;
    eps * (2.0 * q + eps) / (1.0 + q + eps)
}

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
