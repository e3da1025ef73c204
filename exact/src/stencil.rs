//! Operators on bispherical harmonics: each couples degree `n` to `n - 1`, `n`, `n + 1` only.
//!
//! With `s = cosh(xi) - mu`, `lambda = n + 1/2` and `P_n^(m)` the m-th derivative of the Legendre
//! polynomial,
//!
//! ```text
//! psi_n^m = s^(1/2) sin^m(eta) P_n^(m)(mu) {cosh, sinh}(lambda xi)
//! ```
//!
//! times `cos(m phi)` is harmonic. In units of the focal length, dilation and gradient map these
//! functions into each other because bispherical harmonics are Kelvin transforms of solid ones:
//!
//! ```text
//! (r d/dr + 1/2) psi_n^m      = [ -(n-m+1) psi_(n+1) + (n+m) psi_(n-1) ]^m / 2
//! d/dz           psi_n^m      = (n+1/2) psi_n^m - [ (n-m+1) psi_(n+1) + (n+m) psi_(n-1) ]^m / 2   (cosh <-> sinh)
//! (d/drho - m/rho) psi_n^m    = [ psi_n - (psi_(n+1) + psi_(n-1)) / 2 ]^(m+1)
//! (d/drho + (m+1)/rho) psi_n^(m+1) = -(n-m)(n+m+1) psi_n^m + [ (n-m)(n-m+1) psi_(n+1) + (n+m+1)(n+m) psi_(n-1) ]^m / 2
//! ```
//!
//! They are the recurrences behind Dean & O'Neill, *Mathematika* 10 (1963) 13, O'Neill,
//! *Mathematika* 11 (1964) 67 and Lee & Leal, *J. Fluid Mech.* 98 (1980) 193.
//! Here each is transposed: the contribution of degrees `n-1`, `n`, `n+1` to row `n`.

/// Weights of the degrees `n - 1`, `n`, `n + 1` in row `n`.
#[derive(Clone, Copy, Debug)]
pub struct Stencil {
    /// Weight of degree `n - 1`.
    pub below: f64,
    /// Weight of degree `n`.
    pub at: f64,
    /// Weight of degree `n + 1`.
    pub above: f64,
}

impl Stencil {
    /// Weight on degree `n` alone.
    pub fn diagonal(at: f64) -> Self {
        Self {
            below: 0.0,
            at,
            above: 0.0,
        }
    }

    /// All weights times `factor`.
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            below: factor * self.below,
            at: factor * self.at,
            above: factor * self.above,
        }
    }
}

/// `3 q + r dq/dr` for a harmonic `q` of order `m`: twice the divergence of `x q / 2`.
pub fn divergence_of_position_times(n: usize, m: usize) -> Stencil {
    let (n, m) = (n as f64, m as f64);
    Stencil {
        below: -0.5 * (n - m),
        at: 2.5,
        above: 0.5 * (n + 1.0 + m),
    }
}

/// `d/dz` of a harmonic of order `m`.
pub fn axial_derivative(n: usize, m: usize) -> Stencil {
    let (n, m) = (n as f64, m as f64);
    Stencil {
        below: -0.5 * (n - m),
        at: n + 0.5,
        above: -0.5 * (n + 1.0 + m),
    }
}

/// `d/drho - m/rho` of a harmonic of order `m`, as one of order `m + 1`, for any `m`.
pub fn raising_derivative() -> Stencil {
    Stencil {
        below: -0.5,
        at: 1.0,
        above: -0.5,
    }
}

/// `d/drho + (m+1)/rho` of a harmonic of order `m + 1`, as one of order `m`.
pub fn lowering_derivative(n: usize, m: usize) -> Stencil {
    let (n, m) = (n as f64, m as f64);
    Stencil {
        below: 0.5 * (n - 1.0 - m) * (n - m),
        at: -(n - m) * (n + m + 1.0),
        above: 0.5 * (n + m + 2.0) * (n + m + 1.0),
    }
}

/// Multiplication by `mu` of a series in `P_n^(m)`.
pub fn times_mu(n: usize, m: usize) -> Stencil {
    let (n, m) = (n as f64, m as f64);
    Stencil {
        below: (n - m) / (2.0 * n - 1.0),
        at: 0.0,
        above: (n + 1.0 + m) / (2.0 * n + 3.0),
    }
}

/// Multiplication by `cosh(alpha) - mu` of a series in `P_n^(m)`.
pub fn times_denominator(n: usize, m: usize, cosh: f64) -> Stencil {
    let mu = times_mu(n, m);
    Stencil {
        below: -mu.below,
        at: cosh,
        above: -mu.above,
    }
}

/// A series in `P_n^(m)` rewritten in `P_n^(m+1)`, for any `m`.
pub fn in_next_derivative(n: usize) -> Stencil {
    let n = n as f64;
    Stencil {
        below: 1.0 / (2.0 * n - 1.0),
        at: 0.0,
        above: -1.0 / (2.0 * n + 3.0),
    }
}

/// `sin^2(eta)` times a series in `P_n^(m)`, rewritten in `P_n^(m-1)`.
pub fn sine_squared_lowered(n: usize, m: usize) -> Stencil {
    let (n, m) = (n as f64, m as f64);
    Stencil {
        below: -(n - m) * (n - m + 1.0) / (2.0 * n - 1.0),
        at: 0.0,
        above: (n + m) * (n + m + 1.0) / (2.0 * n + 3.0),
    }
}
