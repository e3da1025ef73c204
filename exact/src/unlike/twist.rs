//! Rotation and swirl about the line of centres, in closed form degree by degree.
//!
//! `u_phi` is harmonic of order 1 (Jeffery, *Proc. Lond. Math. Soc.* 14 (1915) 327). Where the active sphere's own
//! multipole has the coefficients `V_n` on the other sphere, the answer has, as factors of the exponentials that are singular
//! within either of them and one on its surface,
//!
//! ```text
//! own: V_n e^(-nu Sigma)/(1 - e^(-2 nu Sigma)),   other: -V_n/(1 - e^(-2 nu Sigma)),   nu = n + 1/2, Sigma = alpha_1 + alpha_2.
//! ```
//!
//! The torque is `8 pi sqrt(2) c^2 Σ n (n+1) e^(-nu alpha)` times these.

use scene::SelfOther;

use super::geometry::Pair;
use super::multipole::Multipoles;

/// `XTC_n` of the swirl modes 1 to `modes` of one sphere: torques about `d`, less that of the lone sphere. The first of them is `-8 XC`.
pub fn answers(pair: &Pair, active: usize, modes: usize) -> Vec<SelfOther> {
    let multipoles = Multipoles::new(pair, active, modes);
    (1..=modes)
        .map(|k| {
            let weight = 2.0 / (k * (k + 1)) as f64;
            answer(pair, active, &multipoles.combine(1, &[(weight, k)]))
        })
        .collect()
}

fn answer(pair: &Pair, active: usize, on_other: &[f64]) -> SelfOther {
    let width = 2.0 * pair.half_width();
    let [own, other] = [active, 1 - active].map(|k| pair.spheres[k].alpha);
    let (mut by_own, mut by_other) = (0.0, 0.0);
    for (n, value) in on_other.iter().enumerate().skip(1) {
        let n = n as f64;
        let nu = n + 0.5;
        let charge = n * (n + 1.0) * value / -(-2.0 * nu * width).exp_m1();
        by_own += charge * (-nu * (width + own)).exp();
        by_other -= charge * (-nu * other).exp();
    }
    let scale = -8.0 * std::f64::consts::SQRT_2 * pair.spheres[active].sinh.powi(2);
    SelfOther::new(scale * by_own, scale * by_other)
}
