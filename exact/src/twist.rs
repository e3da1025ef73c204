//! Axisymmetric swirl: spheres that turn about their line of centres.
//!
//! `u_phi` is harmonic of order 1, and the whole series is known (Jeffery, *Proc. Lond. Math. Soc.*
//! 14 (1915) 327): torque over that of a lone sphere
//!
//! ```text
//! 4 sinh^3(alpha) Σ n (n+1) / (exp((2n+1) alpha) ± 1),
//! ```
//!
//! `+` for equal and `-` for opposite rotations. Any boundary velocity is a series in the same
//! functions, of which the coefficients `g_n` of `exp(+(n+1/2) xi)` carry the torque
//! `8 pi sqrt(2) sinh^2(alpha) Σ n (n+1) g_n`.

use scene::SelfOther;

use crate::geometry::{Geometry, Parity};
use crate::surface::Surface;

/// `X11C` and `X12C`.
pub fn axial_rotation(geometry: &Geometry) -> SelfOther {
    SelfOther {
        sum: torque(geometry, Parity::Even),
        difference: torque(geometry, Parity::Odd),
    }
}

/// `XTC1_n, XTC2_n` of the swirl modes 1 to `modes`: torques about `d` by the slip `W_n(x) d x n`.
pub fn swirl(geometry: &Geometry, modes: usize) -> Vec<SelfOther> {
    let surface = Surface::new(*geometry, 1);
    let series = surface.legendre(modes, 2);
    let slopes = series.derivative(1);
    (1..=modes)
        .map(|k| {
            let weight = 2.0 / (k * (k + 1)) as f64;
            let velocity = surface.over_denominator(slopes[k].clone());
            SelfOther {
                sum: weight * torque_by(geometry, Parity::Even, &velocity),
                difference: weight * torque_by(geometry, Parity::Odd, &velocity),
            }
        })
        .collect()
}

/// Torque over `pi` by the velocity `-u_phi`, given by its coefficients on the sphere.
fn torque_by(geometry: &Geometry, parity: Parity, velocity: &[f64]) -> f64 {
    let Geometry { alpha, sinh, .. } = *geometry;
    let sum: f64 = (velocity.iter().enumerate().skip(1))
        .map(|(n, value)| {
            let n = n as f64;
            let lambda = n + 0.5;
            n * (n + 1.0) * value * (-lambda * alpha).exp() / parity.envelope(lambda, alpha)
        })
        .sum();
    -8.0 * std::f64::consts::SQRT_2 * sinh * sinh * sum
}

fn torque(geometry: &Geometry, parity: Parity) -> f64 {
    let Geometry {
        alpha,
        sinh,
        degree,
        ..
    } = *geometry;
    // sinh^3 is shared out so that nothing overflows far apart: (sinh e^-alpha)^3 = O(1).
    let cubed = (sinh * (-alpha).exp()).powi(3);
    let sum: f64 = (1..=degree)
        .map(|n| {
            let n = n as f64;
            let decay = (-2.0 * (n - 1.0) * alpha).exp();
            n * (n + 1.0) * decay / parity.envelope(n + 0.5, alpha)
        })
        .sum();
    4.0 * cubed * sum
}
