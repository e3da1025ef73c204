//! How many points a panel needs, from how far the target is.
//!
//! Seen from a panel of radius R, the kernel is analytic up to the target at distance ρR, so an
//! n-point Gauss rule errs by about `(ρ + sqrt(ρ² - 1))^(d-2n)` after a polynomial of degree d (the Bernstein ellipse; Trefethen,
//! *SIAM Review* 50 (2008) 67). The rule's order follows by requiring that this be the tolerance.

/// Orders of the product rules, `n` points in each direction.
pub const ORDERS: std::ops::RangeInclusive<usize> = 2..=8;

/// Relative error of the integral over a panel.
pub const TOLERANCE: f64 = 1e-8;

/// Squares of the relative distances ρ beyond which the rules of [`ORDERS`] are accurate to
/// `tolerance`, in descending order, if the kernel is multiplied with a polynomial of degree `degree`.
#[must_use]
pub fn order_limits(tolerance: f64, degree: usize) -> Vec<f64> {
    ORDERS
        .map(|n| {
            let ellipse = tolerance.powf(-1.0 / (2 * n - degree) as f64);
            let rho = f64::midpoint(ellipse, ellipse.recip());
            rho * rho
        })
        .collect()
}

/// The order for a target at the squared relative distance `rho_squared`; `None` if the panel must
/// be divided.
#[inline]
#[must_use]
pub fn order_for(limits: &[f64], rho_squared: f64) -> Option<usize> {
    let skipped = limits.iter().position(|&limit| rho_squared >= limit)?;
    Some(ORDERS.start() + skipped)
}
