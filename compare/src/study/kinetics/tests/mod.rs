//! Statements about collisions in three dimensions and their integrals.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod collisions;
mod kernels;
mod quadratures;
mod readme;

use scene::RunOptions;

use super::*;
use crate::made::model;
use crate::{Method, Model};

/// Options of the runs.
fn options() -> RunOptions {
    RunOptions {
        tolerance: 1e-8,
        ..RunOptions::default()
    }
}

/// A few pairs without any symmetry.
fn pairs() -> Vec<Incoming> {
    (0..6)
        .map(|k| Impact::of_point(point(k, 7), (0.0, 3.0)).incoming())
        .collect()
}

/// The coefficients of a kernel up to an impact parameter, by replications.
fn sampled(kernel: &Kernel<'_>, b: f64, points: usize) -> Vec<Coefficients> {
    let ring = (0.0, b);
    (0..8)
        .map(|seed| Coefficients::of(&[(ring, Means::sampled(kernel, ring, points, seed).0)]))
        .collect()
}

/// Checks that a coefficient is `expected` within three sampling errors, and that these are at most `most`.
fn holds(of: &[Coefficients], name: &str, expected: f64, most: f64) {
    let (_, value) = Coefficients::ALL.iter().find(|of| of.0 == name).unwrap();
    let values: Vec<f64> = of.iter().map(value).collect();
    let (mean, error) = mean_and_error(&values);
    assert!(error <= most, "{name}: error {error}");
    // Rounding remains where sampling adds nothing.
    let off = (mean - expected).abs();
    assert!(
        off <= 3.0 * error + 1e-12,
        "{name}: {mean} +- {error}, not {expected}"
    );
}
