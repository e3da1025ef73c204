//! Axisymmetric swirl: spheres that turn about their line of centres.
//!
//! `u_phi` is harmonic of order 1, and the whole series is known (Jeffery, *Proc. Lond. Math. Soc.*
//! 14 (1915) 327): torque over that of a lone sphere
//!
//! ```text
//! 4 sinh^3(alpha) Σ n (n+1) / (exp((2n+1) alpha) ± 1),
//! ```
//!
//! `+` for equal and `-` for opposite rotations.

use scene::SelfOther;

use crate::geometry::{Geometry, Parity};

/// `X11C` and `X12C`.
pub fn axial_rotation(geometry: &Geometry) -> SelfOther {
    SelfOther {
        sum: torque(geometry, Parity::Even),
        difference: torque(geometry, Parity::Odd),
    }
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
