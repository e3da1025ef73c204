//! What the tests of the series share.

use scene::{Gap, PairLoads};

/// The gap `eps`.
pub fn at(eps: f64) -> Gap {
    Gap::new(eps).expect("a positive gap")
}

/// Largest difference of two sets of loads, relative to the larger of the load and 1.
pub fn distance(a: &PairLoads, b: &PairLoads) -> f64 {
    a.columns()
        .zip(b.columns())
        .map(|(a, b)| (a - b).abs() / b.abs().max(1.0))
        .fold(0.0, f64::max)
}
