//! Polynomials of the surface position as series on the sphere `xi = alpha`.
//!
//! Boundary velocities are polynomials in `x = n.d` times a power of the distance `rho` from the
//! axis. With `S = cosh(alpha) - mu` they are wanted times `S^(1/2)`, in `sin^m(eta) P_n^(m)`. From
//! the generating function of the Legendre polynomials and its derivatives by `mu`,
//!
//! ```text
//! S^(1/2) rho^m = sinh^m(alpha) / [(1/2)(3/2)...((2m-3)/2)]  sin^m(eta)  Σ_(n>=m) g_n P_n^(m)(mu),   -1/2 for m = 0,
//! g_n = sqrt(2) e^(-(n+1/2) alpha) [4 e^alpha + 2 (2n-1) sinh(alpha)] / ((2n-1)(2n+3)),
//! ```
//!
//! where nothing cancels. A factor `x = (1 - mu cosh(alpha))/S = cosh(alpha) - sinh^2(alpha)/S`
//! costs one tridiagonal solve, because `S` couples neighbours only and dominates its diagonal.

use crate::geometry::Geometry;
use crate::stencil::{Stencil, times_denominator, times_mu};

/// Series on the sphere of azimuthal order `m`, with all that is needed to multiply them by `x`.
pub struct Surface {
    geometry: Geometry,
    order: usize,
    unit: Vec<f64>,
    /// Thomas algorithm for `S`: multipliers below, pivots, entries above.
    below: Vec<f64>,
    pivots: Vec<f64>,
    above: Vec<f64>,
}

/// The derivatives `P_k^(j)(x)` times `S^(1/2) rho^m`, for `k = 0, 1, ...`, one list for each `j`.
pub struct LegendreSeries(Vec<Vec<Vec<f64>>>);

impl LegendreSeries {
    /// The derivatives of one order `j`, by degree.
    pub fn derivative(&self, j: usize) -> &[Vec<f64>] {
        &self.0[j]
    }
}

impl Surface {
    /// Series of azimuthal order `order`.
    pub fn new(geometry: Geometry, order: usize) -> Self {
        let mut surface = Self {
            geometry,
            order,
            unit: unit(&geometry, order),
            below: Vec::new(),
            pivots: Vec::new(),
            above: Vec::new(),
        };
        surface.factor();
        surface
    }

    fn factor(&mut self) {
        let size = self.geometry.degree + 1;
        let (mut above_previous, mut pivot) = (0.0, 1.0);
        for n in 0..size {
            let row = self.row(n);
            let below = if n > self.order {
                row.below / pivot
            } else {
                0.0
            };
            pivot = row.at - below * above_previous;
            above_previous = row.above;
            self.below.push(below);
            self.pivots.push(pivot);
            self.above.push(row.above);
        }
    }

    fn row(&self, n: usize) -> Stencil {
        if n < self.order {
            Stencil::diagonal(1.0)
        } else {
            times_denominator(n, self.order, self.geometry.cosh)
        }
    }

    /// A series over `S`.
    pub fn over_denominator(&self, mut series: Vec<f64>) -> Vec<f64> {
        for n in 1..series.len() {
            series[n] -= self.below[n] * series[n - 1];
        }
        let mut above = 0.0;
        for (n, value) in series.iter_mut().enumerate().rev() {
            *value = (*value - self.above[n] * above) / self.pivots[n];
            above = *value;
        }
        series
    }

    /// `x` times a series. Close spheres take the form where nearly equal terms do not cancel for
    /// small `alpha`, distant ones the other.
    pub fn times_cosine(&self, series: &[f64]) -> Vec<f64> {
        let Geometry {
            alpha, sinh, cosh, ..
        } = self.geometry;
        if alpha < 1.0 {
            let mut product = self.over_denominator(series.to_vec());
            for (p, s) in product.iter_mut().zip(series) {
                *p = cosh * s - sinh * sinh * *p;
            }
            product
        } else {
            let mut numerator = apply(series, self.order, |n| times_mu(n, self.order));
            for (p, s) in numerator.iter_mut().zip(series) {
                *p = s - cosh * *p;
            }
            self.over_denominator(numerator)
        }
    }

    /// Legendre polynomials of `x`, of degrees 0 to `highest`, and their derivatives up to the order `most`.
    pub fn legendre(&self, highest: usize, most: usize) -> LegendreSeries {
        let zero = vec![0.0; self.unit.len()];
        let mut series: Vec<Vec<Vec<f64>>> = (0..=most)
            .map(|j| match j {
                0 => vec![self.unit.clone(), self.times_cosine(&self.unit)],
                1 => vec![zero.clone(), self.unit.clone()],
                _ => vec![zero.clone(), zero.clone()],
            })
            .collect();
        for k in 1..highest {
            let degree = k as f64;
            let value = combine(
                (2.0 * degree + 1.0) / (degree + 1.0),
                &self.times_cosine(&series[0][k]),
                -degree / (degree + 1.0),
                &series[0][k - 1],
            );
            // P_(k+1)^(j) = x P_k^(j) + (k+j) P_k^(j-1).
            let derivatives: Vec<Vec<f64>> = (1..=most)
                .map(|j| {
                    let below = &series[j - 1][k];
                    let along = self.times_cosine(&series[j][k]);
                    combine(1.0, &along, degree + j as f64, below)
                })
                .collect();
            for (of, next) in series
                .iter_mut()
                .zip(std::iter::once(value).chain(derivatives))
            {
                of.push(next);
            }
        }
        LegendreSeries(series)
    }
}

/// `p a + q b`, entry by entry.
pub fn combine(p: f64, a: &[f64], q: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| p * a + q * b).collect()
}

/// A stencil of degrees from `order` on, applied to a series.
pub fn apply(series: &[f64], order: usize, stencil: impl Fn(usize) -> Stencil) -> Vec<f64> {
    let entry = |n: usize| series.get(n).copied().unwrap_or(0.0);
    (0..series.len())
        .map(|n| {
            if n < order {
                return 0.0;
            }
            let s = stencil(n);
            let below = if n > order {
                s.below * entry(n - 1)
            } else {
                0.0
            };
            below + s.at * entry(n) + s.above * entry(n + 1)
        })
        .collect()
}

/// `∫ f g dmu` of two series in `sin^m(eta) P_n^(m)`.
pub fn product(order: usize, f: &[f64], g: &[f64]) -> f64 {
    let terms = f.iter().zip(g).enumerate().skip(order);
    terms
        .map(|(n, (f, g))| {
            // (n+m)!/(n-m)!
            let growth: f64 = (n + 1 - order..=n + order).map(|k| k as f64).product();
            2.0 / (2.0 * n as f64 + 1.0) * growth * f * g
        })
        .sum()
}

/// `S^(1/2) rho^m` in `sin^m(eta) P_n^(m)`: the module's `g_n` with its prefactor.
fn unit(geometry: &Geometry, order: usize) -> Vec<f64> {
    let Geometry { alpha, sinh, .. } = *geometry;
    let prefactor = if order == 0 {
        -0.5
    } else {
        (1..order).fold(sinh, |product, j| product * sinh / (j as f64 - 0.5))
    };
    (0..=geometry.degree)
        .map(|n| {
            if n < order {
                return 0.0;
            }
            let n = n as f64;
            let decay = (-(n + 0.5) * alpha).exp();
            let bracket = 4.0 * alpha.exp() + 2.0 * (2.0 * n - 1.0) * sinh;
            prefactor * std::f64::consts::SQRT_2 * decay * bracket
                / ((2.0 * n - 1.0) * (2.0 * n + 3.0))
        })
        .collect()
}
