//! Bispherical coordinates of two spheres of unlike radii.
//!
//! ```text
//! spheres xi = alpha_1 and xi = -alpha_2,  c = a_1 sinh(alpha_1) = a_2 sinh(alpha_2),
//! r = 1 + lambda + eps,
//! cosh(alpha_1) - 1 = eps (2 lambda + eps) / (2 r),  cosh(alpha_2) - 1 = eps (2 + eps) / (2 r lambda)
//! ```
//!
//! with `lambda = a_2/a_1` and the gap `eps` in units of `a_1` (Happel & Brenner, *Low Reynolds number
//! hydrodynamics*, 1965, appendix A-19). Each sphere has a [`Geometry`] in units of its own radius. The
//! unknowns go as `cosh` and `sinh` of `(n + 1/2) xi'`, `xi' = xi - (alpha_1 - alpha_2)/2`, so that the spheres
//! are `xi' = +-h`, `h = (alpha_1 + alpha_2)/2`.

use super::rounding::NearOne;
use crate::ExactError;
use crate::geometry::{Geometry, MAX_TERMS, terms_of_velocities};

/// What a lone sphere's flow leaves on the other one falls off as `exp(-n (alpha_1 + alpha_2))`, loads as its square: this many
/// e-folds of the former reach rounding.
const E_FOLDS: f64 = 36.0;
/// More e-folds for each slip mode, whose flow is that of a multipole of a higher degree.
const E_FOLDS_PER_MODE: f64 = 1.5;
/// Terms beyond the e-folds, for the algebraic factors in front of the exponential.
const SPARE_TERMS: f64 = 12.0;

/// The two spheres of a pair.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// Sphere 1, above, and sphere 2, below; each as the upper one of its own picture, in units of its own radius.
    pub spheres: [Geometry; 2],
    /// `(alpha_1 - alpha_2)/2`.
    pub shift: f64,
    /// `cosh(alpha)` of both.
    coshs: [NearOne; 2],
    /// `cosh` of the shift.
    cosh_shift: NearOne,
}

impl Pair {
    /// Spheres of radii 1 and `ratio` with gap `eps`; the degree is `factor` times the one at which the flows of
    /// `modes` slip modes reach rounding.
    pub fn new(eps: f64, ratio: f64, modes: usize, factor: f64) -> Result<Self, ExactError> {
        Self::with_terms(eps, ratio, |alphas| {
            let e_folds = E_FOLDS + E_FOLDS_PER_MODE * modes as f64;
            factor * (e_folds / (alphas[0] + alphas[1]) + SPARE_TERMS)
        })
    }

    /// The same with `factor` times the degree at which the boundary velocities of `modes` slip modes reach rounding on both spheres.
    pub fn resolving_velocities(
        eps: f64,
        ratio: f64,
        modes: usize,
        factor: f64,
    ) -> Result<Self, ExactError> {
        Self::with_terms(eps, ratio, |[one, two]| {
            factor * terms_of_velocities(one.min(two), modes)
        })
    }

    fn with_terms(
        eps: f64,
        ratio: f64,
        terms: impl Fn([f64; 2]) -> f64,
    ) -> Result<Self, ExactError> {
        if !(eps > 0.0 && eps.is_finite()) {
            return Err(ExactError::InvalidGap { eps });
        }
        let distance = 1.0 + ratio + eps;
        // cosh(alpha) - 1.
        let excesses = [
            eps * ((2.0 * ratio + eps) / (2.0 * distance)),
            eps * ((2.0 + eps) / (2.0 * distance * ratio)),
        ];
        let alphas = excesses.map(|excess| 2.0 * (0.5 * excess).sqrt().asinh());
        let degree = terms(alphas).ceil() as usize;
        if degree > MAX_TERMS {
            return Err(ExactError::TooManyTerms {
                eps,
                terms: degree,
                allowed: MAX_TERMS,
            });
        }
        let sphere = |k: usize| Geometry {
            alpha: alphas[k],
            sinh: (excesses[k] * (2.0 + excesses[k])).sqrt(),
            cosh: 1.0 + excesses[k],
            degree,
        };
        let shift = 0.5 * (alphas[0] - alphas[1]);
        Ok(Self {
            spheres: [sphere(0), sphere(1)],
            shift,
            coshs: excesses.map(NearOne::new),
            cosh_shift: NearOne::new(2.0 * (0.5 * shift).sinh().powi(2)),
        })
    }

    /// A sphere with its `cosh(alpha)` as equations of degree `n` have it.
    pub fn sphere_at(&self, sphere: usize, n: usize) -> Geometry {
        Geometry {
            cosh: self.coshs[sphere].at(n),
            ..self.spheres[sphere]
        }
    }

    /// `sinh` and `cosh` of the shift, as equations of degree `n` have them.
    pub fn shift_at(&self, n: usize) -> (f64, f64) {
        (self.shift.sinh(), self.cosh_shift.at(n))
    }

    /// `h = (alpha_1 + alpha_2)/2`.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.spheres[0].alpha + self.spheres[1].alpha)
    }

    /// Highest degree kept.
    pub fn degree(&self) -> usize {
        self.spheres[0].degree
    }
}
