//! Slip velocity of squirming modes on the unit sphere.
//!
//! `u_s = Σ B_n W_n(c) (c n - p)`, `W_n = 2 P_n'(c)/(n (n+1))`, `c = p.n`, is minus the surface gradient
//! of `Σ B_n 2/(n (n+1)) P_n(c)` (Blake, *J. Fluid Mech.* 46 (1971) 199). The addition theorem splits
//! `P_n(p.n)` into azimuthal parts about an axis d; those that carry load are
//!
//! ```text
//! m = 0:  P_n(p.d) P_n(n.d),          m = 1:  W_n(p.d) P_n'(n.d) (n.p_t),   p_t = p - (p.d) d.
//! ```
//!
//! Swirl `Σ C_n W_n(c) p x n` is the same turned by a quarter about the normal, `n x u_s`, part by part.

use nalgebra::{Complex, Vector3};
use scene::stress::legendre_derivative;

/// `P_n(c)` and its first two derivatives.
#[must_use]
pub fn legendre(n: usize, c: f64) -> [f64; 3] {
    let (mut before, mut now) = ([0.0; 3], [1.0, 0.0, 0.0]);
    for k in 0..n {
        let k = k as f64;
        let next = |i: usize| {
            // Derivatives of (k+1) P_{k+1} = (2k+1) c P_k - k P_{k-1}.
            let lower = if i > 0 { i as f64 * now[i - 1] } else { 0.0 };
            ((2.0 * k + 1.0) * (c * now[i] + lower) - k * before[i]) / (k + 1.0)
        };
        (before, now) = (now, [next(0), next(1), next(2)]);
    }
    now
}

fn factor(n: usize) -> f64 {
    2.0 / (n * (n + 1)) as f64
}

/// Slip at the unit normal `normal` of the mode `n` of a squirmer with unit orientation `p`.
#[must_use]
pub fn axisymmetric(n: usize, p: &Vector3<f64>, normal: &Vector3<f64>) -> Vector3<f64> {
    let c = p.dot(normal);
    (normal * c - p) * (factor(n) * legendre(n, c)[1])
}

/// Slip at `normal` of the azimuthal part m = 1 of the mode `n`, per `W_n(p.d)`, for `p_t = t`.
#[must_use]
pub fn transverse(
    n: usize,
    d: &Vector3<f64>,
    t: &Vector3<f64>,
    normal: &Vector3<f64>,
) -> Vector3<f64> {
    let (c, across) = (normal.dot(d), normal.dot(t));
    let [_, first, second] = legendre(n, c);
    ((normal * c - d) * (second * across) + (normal * across - t) * first) * factor(n)
}

/// Swirl at `normal` of the mode `n` of a squirmer with unit orientation `p`: `W_n(c) p x n`.
#[must_use]
pub fn axisymmetric_swirl(n: usize, p: &Vector3<f64>, normal: &Vector3<f64>) -> Vector3<f64> {
    normal.cross(&axisymmetric(n, p, normal))
}

/// Swirl at `normal` of the azimuthal part m = 1 of the mode `n`, per `W_n(p.d)`, for `p_t = t`.
#[must_use]
pub fn transverse_swirl(
    n: usize,
    d: &Vector3<f64>,
    t: &Vector3<f64>,
    normal: &Vector3<f64>,
) -> Vector3<f64> {
    normal.cross(&transverse(n, d, t, normal))
}

/// Slip at `normal` of the azimuthal part `order` of the mode `n` about z, for the unit amplitude of [`scene::stress`]: minus the surface gradient of
/// `2/(n(n+1)) Re[(x - i y)^order] P_n^(order)(z)`. Zero for an order above n.
#[must_use]
pub fn of_order(n: usize, order: usize, normal: &Vector3<f64>) -> Vector3<f64> {
    -potential_gradient(n, order, Complex::new(1.0, 0.0), normal)
}

/// The potential of [`of_order`] at `normal`.
#[must_use]
pub fn potential_of_order(n: usize, order: usize, normal: &Vector3<f64>) -> f64 {
    let across = Complex::new(normal.x, -normal.y).powu(order as u32);
    factor(n) * across.re * legendre_derivative(n, order, normal.z)
}

/// Swirl likewise: `n x` the slip of the same potential, but for orders above 0 with `Re[-i (x - i y)^order]`.
#[must_use]
pub fn swirl_of_order(n: usize, order: usize, normal: &Vector3<f64>) -> Vector3<f64> {
    let phase = if order == 0 {
        Complex::new(1.0, 0.0)
    } else {
        Complex::new(0.0, -1.0)
    };
    -normal.cross(&potential_gradient(n, order, phase, normal))
}

/// Surface gradient of `2/(n(n+1)) Re[phase (x - i y)^order] P_n^(order)(z)`.
fn potential_gradient(
    n: usize,
    order: usize,
    phase: Complex<f64>,
    normal: &Vector3<f64>,
) -> Vector3<f64> {
    let derivative = |order: usize| {
        if order > n {
            0.0
        } else {
            legendre_derivative(n, order, normal.z)
        }
    };
    let across = Complex::new(normal.x, -normal.y);
    let value = (phase * across.powu(order as u32)).re;
    let slope = match order.checked_sub(1) {
        Some(less) => phase * across.powu(less as u32) * order as f64,
        None => Complex::new(0.0, 0.0),
    };
    // d/dy of (x - i y)^m is -i times d/dx of it.
    let gradient = Vector3::new(
        slope.re * derivative(order),
        slope.im * derivative(order),
        value * derivative(order + 1),
    );
    (gradient - normal * normal.dot(&gradient)) * factor(n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_mode_is_the_same_in_every_azimuthal_part() {
        let (d, t) = (Vector3::z(), Vector3::x());
        let normal = Vector3::new(0.48, 0.6, 0.64);
        assert!((transverse(1, &d, &t, &normal) - axisymmetric(1, &t, &normal)).norm() < 1e-15);
    }

    #[test]
    fn the_first_two_orders_are_those_that_carry_load() {
        let (d, t) = (Vector3::z(), Vector3::x());
        let normal = Vector3::new(0.48, 0.6, 0.64);
        for n in 1..=4 {
            for (of_order, expected) in [
                (of_order(n, 0, &normal), axisymmetric(n, &d, &normal)),
                (of_order(n, 1, &normal), transverse(n, &d, &t, &normal)),
                (
                    swirl_of_order(n, 0, &normal),
                    axisymmetric_swirl(n, &d, &normal),
                ),
                (
                    swirl_of_order(n, 1, &normal),
                    transverse_swirl(n, &d, &-Vector3::y(), &normal),
                ),
            ] {
                assert!((of_order - expected).norm() < 1e-14, "{n}");
            }
        }
    }

    #[test]
    fn swirl_is_azimuthal_and_its_first_mode_a_rotation() {
        let (p, d) = (Vector3::new(0.6, 0.0, 0.8), Vector3::z());
        let normal = Vector3::new(0.48, 0.6, 0.64);
        assert!((axisymmetric_swirl(1, &p, &normal) - p.cross(&normal)).norm() < 1e-15);
        assert!((transverse_swirl(1, &d, &p, &normal) - p.cross(&normal)).norm() < 1e-15);
        let second = p.cross(&normal) * p.dot(&normal);
        assert!((axisymmetric_swirl(2, &p, &normal) - second).norm() < 1e-15);
    }

    #[test]
    fn azimuthal_parts_add_up_to_the_slip_averaged_over_the_others() {
        // For p in the plane of d and t, averaging u against cos(phi) leaves m = 1 alone.
        let (d, t, n) = (Vector3::z(), Vector3::x(), 4);
        let (theta, tilt) = (0.7f64, 1.1f64);
        let p = Vector3::new(tilt.sin(), 0.0, tilt.cos());
        let count = 32;
        let mut found = 0.0;
        let mut expected = 0.0;
        for k in 0..count {
            let phi = std::f64::consts::TAU * f64::from(k) / f64::from(count);
            let normal = Vector3::new(
                theta.sin() * phi.cos(),
                theta.sin() * phi.sin(),
                theta.cos(),
            );
            let along = Vector3::new(
                theta.cos() * phi.cos(),
                theta.cos() * phi.sin(),
                -theta.sin(),
            );
            found += axisymmetric(n, &p, &normal).dot(&along) * phi.cos();
            let weight = factor(n) * legendre(n, tilt.cos())[1] * tilt.sin();
            expected += weight * transverse(n, &d, &t, &normal).dot(&along) * phi.cos();
        }
        approx::assert_relative_eq!(found, expected, max_relative = 1e-12);
    }
}
