//! Bispherical coordinates of two equal unit spheres, and how many terms the series need.
//!
//! ```text
//! z = c sinh(xi) / (cosh(xi) - mu),  rho = c sin(eta) / (cosh(xi) - mu),  mu = cos(eta),
//! spheres xi = +-alpha,  cosh(alpha) = 1 + eps/2,  c = sinh(alpha)
//! ```
//!
//! (Happel & Brenner, *Low Reynolds number hydrodynamics*, 1965, appendix A-19, for radius 1).
//! Sphere 1, the one that moves or squirms, is the upper one, `xi = alpha`; so `d = -z`.

use crate::ExactError;

/// The boundary data fall off as `exp(-n alpha)`: this many e-folds reach rounding.
const E_FOLDS: f64 = 36.0;
/// More e-folds for each squirming mode, whose data fall off as `(n alpha)^(2k) exp(-n alpha)`.
const E_FOLDS_PER_MODE: f64 = 3.0;
/// Terms beyond the e-folds, for the algebraic factors in front of the exponential.
const SPARE_TERMS: f64 = 12.0;
/// About 0.5 GB of band; reached at gaps of 1e-7 or so.
pub const MAX_TERMS: usize = 120_000;

/// The sphere `xi = alpha` of a pair of unit spheres, and the degree at which series are cut.
#[derive(Clone, Copy, Debug)]
pub struct Geometry {
    /// `alpha`, with `cosh(alpha) = 1 + eps/2`.
    pub alpha: f64,
    /// `sinh(alpha)`: also the focal length `c`, in sphere radii.
    pub sinh: f64,
    /// `cosh(alpha)`: also the height of the sphere's centre above the mirror plane.
    pub cosh: f64,
    /// Highest degree `n` kept.
    pub degree: usize,
}

impl Geometry {
    /// Two spheres with gap `eps`; the degree is `factor` times the one at which the boundary
    /// velocities of `modes` squirming modes reach rounding.
    pub fn new(eps: f64, modes: usize, factor: f64) -> Result<Self, ExactError> {
        if !(eps > 0.0 && eps.is_finite()) {
            return Err(ExactError::InvalidGap { eps });
        }
        let alpha = 2.0 * (0.5 * eps.sqrt()).asinh();
        let degree = (factor * terms_of_velocities(alpha, modes)).ceil() as usize;
        if degree > MAX_TERMS {
            return Err(ExactError::TooManyTerms {
                eps,
                terms: degree,
                allowed: MAX_TERMS,
            });
        }
        Ok(Self {
            alpha,
            sinh: eps.sqrt() * (1.0 + 0.25 * eps).sqrt(),
            cosh: 1.0 + 0.5 * eps,
            degree,
        })
    }

    /// `cosh(alpha) - mu`, which is `sinh(eta)`-like small only at the outer pole `mu = 1`.
    pub fn denominator(&self, mu: f64) -> f64 {
        self.cosh - mu
    }

    /// `x = n.d`, cosine of the polar angle from the contact point, at the surface point `mu`.
    pub fn cosine(&self, mu: f64) -> f64 {
        (1.0 - mu * self.cosh) / self.denominator(mu)
    }

    /// The inverse of [`Self::cosine`].
    pub fn mu(&self, cosine: f64) -> f64 {
        (1.0 - cosine * self.cosh) / (self.cosh - cosine)
    }
}

/// Degree at which the boundary velocities of `modes` squirming modes reach rounding on the sphere `xi = alpha`.
pub fn terms_of_velocities(alpha: f64, modes: usize) -> f64 {
    (E_FOLDS + E_FOLDS_PER_MODE * modes as f64) / alpha + SPARE_TERMS
}

/// Behaviour of the flow under the mirror `z -> -z` between the spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// The flow is its own mirror image.
    Even,
    /// The flow is the negative of its mirror image.
    Odd,
}

impl Parity {
    /// `cosh` or `sinh` of `lambda alpha`, over `exp(lambda alpha)/2`: cannot overflow.
    ///
    /// Even fields go as `cosh(lambda xi)` for pressure and transverse velocity.
    pub fn envelope(self, lambda: f64, alpha: f64) -> f64 {
        match self {
            Self::Even => 1.0 + (-2.0 * lambda * alpha).exp(),
            Self::Odd => -(-2.0 * lambda * alpha).exp_m1(),
        }
    }

    /// The other one: the parity of the axial velocity in `xi`.
    pub fn flipped(self) -> Self {
        match self {
            Self::Even => Self::Odd,
            Self::Odd => Self::Even,
        }
    }
}
