//! Multipoles at the centre of a sphere as bispherical series, in closed form.
//!
//! With the polar axis `d` towards the other sphere, lengths in units of the sphere's radius and `x = n.d`,
//!
//! ```text
//! phi_j^m = r^-(j+1) sin^m(theta) P_j^(m)(x) = s^(1/2) sin^m(eta) Σ_n Q_j^m(n) e^((n+1/2)(|xi| - alpha)) P_n^(m)(mu),
//! Q_m^m(n) = sqrt(2) (2 sinh(alpha))^m e^(-(n+1/2) alpha),
//! (j-m+1) Q_(j+1) = [(2j+1) cosh(alpha) - (2n+1) sinh(alpha)] Q_j - (j+m) Q_(j-1)
//! ```
//!
//! (the start is the generating function of the Legendre polynomials, differentiated `m` times). These are Meixner's polynomials of
//! `n`, alike in `j` and `n` but for a factor. No system is solved for them, and degrees beyond those kept do not matter. For `n < j`
//! the recurrence loses digits far apart, and the polynomial is summed:
//!
//! ```text
//! Q_j^m(n) = Q_m^m(n) binomial(j+m, 2m) e^(-(j-m) alpha) 2F1(m-j, m-n; 2m+1; 1 - e^(2 alpha)).
//! ```

use super::geometry::Pair;
use crate::geometry::Geometry;

/// Multipoles of a sphere, as their coefficients on the other sphere.
pub struct Multipoles {
    /// By azimuthal order, then by degree from that order on.
    values: [Vec<Vec<f64>>; 3],
    count: usize,
}

impl Multipoles {
    /// Of sphere `active` of a pair, on the other one, up to the degree `highest`.
    pub fn new(pair: &Pair, active: usize, highest: usize) -> Self {
        Self {
            values: [0, 1, 2].map(|order| series(pair, active, order, highest)),
            count: pair.degree() + 1,
        }
    }

    /// `Σ weight phi_degree` of one order, given as `(weight, degree)` with degrees up to the highest; multipoles of a degree below their order
    /// are zero.
    pub fn combine(&self, order: usize, terms: &[(f64, usize)]) -> Vec<f64> {
        let mut sum = vec![0.0; self.count];
        for (weight, degree) in terms {
            let Some(above) = degree.checked_sub(order) else {
                continue;
            };
            let series = &self.values[order][above];
            for (s, v) in sum.iter_mut().zip(series) {
                *s += weight * v;
            }
        }
        sum
    }
}

fn series(pair: &Pair, active: usize, order: usize, highest: usize) -> Vec<Vec<f64>> {
    let sphere = pair.spheres[active];
    let m = order as f64;
    // From the active sphere's surface on to the other's.
    let reach = sphere.alpha + 2.0 * pair.half_width();
    let front = std::f64::consts::SQRT_2 * (2.0 * sphere.sinh).powi(order as i32);
    let first = (0..=pair.degree()).map(|n| {
        if n < order {
            0.0
        } else {
            front * (-(n as f64 + 0.5) * reach).exp()
        }
    });
    let mut degrees: Vec<Vec<f64>> = vec![first.collect()];
    for degree in order..highest {
        let j = degree as f64;
        let current = &degrees[degree - order];
        let below = (degree > order).then(|| &degrees[degree - order - 1]);
        let next = current.iter().enumerate().map(|(n, value)| {
            if n <= degree {
                return degrees[0][n] * summed(&sphere, order, degree + 1, n);
            }
            let below = below.map_or(0.0, |series| series[n]);
            let middle = (2.0 * j + 1.0) * sphere.cosh - (2.0 * n as f64 + 1.0) * sphere.sinh;
            (middle * value - (j + m) * below) / (j - m + 1.0)
        });
        let next = next.collect();
        degrees.push(next);
    }
    degrees
}

/// `Q_j^m(n)/Q_m^m(n)` by its sum.
fn summed(sphere: &Geometry, order: usize, degree: usize, n: usize) -> f64 {
    let steps = (degree - order) as f64;
    // 1 - exp(2 alpha).
    let argument = -2.0 * sphere.sinh * sphere.alpha.exp();
    let (mut sum, mut term) = (0.0, (-steps * sphere.alpha).exp());
    for k in 1..=2 * order {
        term *= (steps + k as f64) / k as f64;
    }
    for i in 0..=n.saturating_sub(order) {
        sum += term;
        let i = i as f64;
        let top = (i - steps) * (i + order as f64 - n as f64);
        term *= argument * top / ((2.0 * order as f64 + 1.0 + i) * (i + 1.0));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Surface;

    #[test]
    fn multipoles_have_their_values_on_the_sphere_that_they_belong_to() {
        for (gap, ratio) in [(0.03, 0.5), (0.7, 2.0), (5.0, 3.0)] {
            check(&Pair::new(gap, ratio, 8, 6.0).unwrap());
        }
    }

    fn check(pair: &Pair) {
        for (active, sphere) in pair.spheres.into_iter().enumerate() {
            let multipoles = Multipoles::new(pair, active, 5);
            for order in 0..3 {
                let surface = Surface::new(sphere, order);
                let legendre = surface.legendre(5, 2);
                let on_sphere = legendre.derivative(order);
                for (degree, series) in on_sphere.iter().enumerate() {
                    let expected = surface.over_denominator(series.clone());
                    let found = multipoles.combine(order, &[(1.0, degree)]);
                    for (n, (e, f)) in expected.iter().zip(found).enumerate().take(20) {
                        let f = f * (2.0 * pair.half_width() * (n as f64 + 0.5)).exp();
                        let scale = e.abs().max(expected[order.max(n.min(degree))].abs());
                        assert!(
                            (e - f).abs() <= 1e-11 * scale,
                            "{order} {degree} {n}: {e} {f}"
                        );
                    }
                }
            }
        }
    }
}
