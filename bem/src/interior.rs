//! The flow within a sphere of unit radius that meets the slip on its surface, in closed form.
//!
//! The single layer induces a flow within the spheres too, with the same velocity on the surface. Its traction is what the density lacks of the outer fluid's:
//! `t_outer = t_inner - f`. Rigid motions have none, but for a pressure. For slip `u = ∇_s Y`, with a surface
//! harmonic Y of degree n, Lamb's solution (Happel & Brenner, *Low Reynolds Number Hydrodynamics* (1965), section 3-2) with
//! `p = (n+1)(2n+3) r^n Y` is
//!
//! ```text
//! u.n = n(n+1)/2 (r^(n+1) - r^(n-1)) Y,   u_t = ((n+3)/2 r^(n+1) - (n+1)/2 r^(n-1)) ∇_s Y,
//! t = (2n+1) ∇_s Y - 3(n+1) Y n           at r = 1,
//! ```
//!
//! and for swirl `u = n x ∇_s Y` it is `r^n u`, with `t = (n-1) u`. On a sphere of radius a tractions of the same velocities are `1/a` of these.

use nalgebra::Vector3;
use scene::Squirmer;

use crate::slip;

/// Traction of the inner fluid at the outward unit normal, without its mean pressure, by the slip of a squirmer with unit orientation `p`; times its radius.
#[must_use]
pub fn traction(squirmer: &Squirmer, p: &Vector3<f64>, normal: &Vector3<f64>) -> Vector3<f64> {
    let c = p.dot(normal);
    let mut sum = Vector3::zeros();
    for (n, strength) in (1..).zip(squirmer.modes()) {
        // Y = -2/(n(n+1)) P_n.
        let pressure = 6.0 / n as f64 * slip::legendre(n, c)[0];
        let along = slip::axisymmetric(n, p, normal) * (2 * n + 1) as f64;
        sum += (along + normal * pressure) * *strength;
    }
    for (n, strength) in (1..).zip(squirmer.swirl()) {
        sum += slip::axisymmetric_swirl(n, p, normal) * ((n - 1) as f64 * strength);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;

    /// Velocity and pressure within, for `Y = P_n(z)`.
    fn within(n: usize, at: &Vector3<f64>) -> (Vector3<f64>, f64) {
        let (r, degree) = (at.norm(), n as f64);
        let normal = at / r;
        let [y, slope, _] = slip::legendre(n, normal.z);
        let gradient = (Vector3::z() - normal * normal.z) * slope;
        let (up, down) = (r.powi(n as i32 + 1), r.powi(n as i32 - 1));
        let along = 0.5 * degree * (degree + 1.0) * (up - down) * y;
        let across = 0.5 * ((degree + 3.0) * up - (degree + 1.0) * down);
        let pressure = (degree + 1.0) * (2.0 * degree + 3.0) * r.powi(n as i32) * y;
        (normal * along + gradient * across, pressure)
    }

    #[test]
    fn the_inner_flow_is_a_stokes_flow_with_the_stated_traction() {
        let step = 1e-3;
        for n in 1..=5 {
            let at = Vector3::new(0.3, -0.2, 0.45);
            let mut laplacian = -6.0 * within(n, &at).0;
            let mut slope = Vector3::zeros();
            let mut divergence = 0.0;
            for k in 0..3 {
                let e = Vector3::ith(k, step);
                let (ahead, behind) = (within(n, &(at + e)), within(n, &(at - e)));
                laplacian += ahead.0 + behind.0;
                slope[k] = (ahead.1 - behind.1) / (2.0 * step);
                divergence += (ahead.0 - behind.0)[k] / (2.0 * step);
            }
            laplacian /= step * step;
            assert!(divergence.abs() < 1e-4, "{n}: {divergence}");
            assert_relative_eq!(laplacian, slope, epsilon = 1e-3 * slope.norm());

            let normal = Vector3::new(0.48, 0.6, 0.64);
            let mut gradient = Matrix3::zeros();
            for k in 0..3 {
                let e = Vector3::ith(k, step);
                let change = within(n, &(normal + e)).0 - within(n, &(normal - e)).0;
                gradient.set_column(k, &(change / (2.0 * step)));
            }
            let (velocity, pressure) = within(n, &normal);
            let found = (gradient + gradient.transpose()) * normal - normal * pressure;
            let mut modes = vec![0.0; n];
            modes[n - 1] = -0.5 * (n * (n + 1)) as f64;
            let squirmer = Squirmer::new(&modes).unwrap();
            let expected = traction(&squirmer, &Vector3::z(), &normal);
            assert_relative_eq!(found, expected, epsilon = 1e-3 * expected.norm());
            let slip = slip::axisymmetric(n, &Vector3::z(), &normal) * modes[n - 1];
            assert_relative_eq!(velocity, slip, epsilon = 1e-13);
        }
    }
}
