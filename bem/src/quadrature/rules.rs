//! Product rules on the triangle, from Gauss rules on an interval.
//!
//! With `λ = (1 - u, u (1 - v), u v)` the triangle is the image of the unit square with Jacobian u
//! (Stroud, *Approximate Calculation of Multiple Integrals* (1971), section 2.4, conical products;
//! Duffy, *SIAM J. Numer. Anal.* 19 (1982) 1260). With Gauss-Jacobi in u and Gauss-Legendre in v, n
//! points each, polynomials of degree 2n - 1 are exact. With Gauss-Legendre in both, and the
//! Jacobian in the weight, a 1/r singularity at the corner `u = 0` is cancelled.

use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;

use crate::slip::legendre;

/// A quadrature point: barycentric coordinates, and a weight relative to twice the area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Barycentric coordinates, the values of the three hat functions.
    pub hats: [f64; 3],
    /// Weight; the weights of a rule add up to 1/2.
    pub weight: f64,
}

/// Rule of `n²` points, exact for polynomials of degree `2n - 1`.
#[must_use]
pub fn product_rule(n: usize) -> Vec<Point> {
    tensor(weighted_interval(n).into_iter(), n)
}

/// Gauss nodes and weights on (0, 1) for the weight u.
///
/// They are the inner nodes of the Gauss-Radau rule of n + 1 points on (-1, 1), zeros of
/// `P_n + P_{n+1}`, one between each two neighbouring zeros of `P_{n+1}`, with weights
/// `(1 - s)/((n + 1) P_n(s))²` (Abramowitz & Stegun 25.4.31), times `1 + s`. (The Gauss-Jacobi rules
/// of gauss-quad 0.3 set the middle node to zero, which is wrong for unequal exponents.)
fn weighted_interval(n: usize) -> Vec<(f64, f64)> {
    let value = |s: f64| legendre(n, s)[0] + legendre(n + 1, s)[0];
    let mut brackets: Vec<f64> = GaussLegendre::new(at_least_one(n + 1))
        .nodes()
        .copied()
        .collect();
    brackets.sort_by(f64::total_cmp);
    brackets
        .windows(2)
        .map(|ends| {
            let s = zero_between(value, ends[0], ends[1]);
            let radau = (1.0 - s) / ((n + 1) as f64 * legendre(n, s)[0]).powi(2);
            (f64::midpoint(1.0, s), 0.25 * radau * (1.0 + s))
        })
        .collect()
}

/// Zero of a function that changes sign between `low` and `high`, by bisection to the last bit.
fn zero_between(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rising = function(high) > 0.0;
    loop {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            return middle;
        }
        if (function(middle) > 0.0) == rising {
            high = middle;
        } else {
            low = middle;
        }
    }
}

/// Rule of `along * across` points for a kernel singular as 1/r at the first corner: `along` the
/// rays from it and `across` them.
#[must_use]
pub fn corner_rule(along: usize, across: usize) -> Vec<Point> {
    let outer = unit_interval(along).into_iter().map(|(u, w)| (u, w * u));
    tensor(outer, across)
}

fn tensor(outer: impl Iterator<Item = (f64, f64)>, across: usize) -> Vec<Point> {
    let inner = unit_interval(across);
    outer
        .flat_map(|(u, wu)| {
            inner.iter().map(move |&(v, wv)| Point {
                hats: [1.0 - u, u * (1.0 - v), u * v],
                weight: wu * wv,
            })
        })
        .collect()
}

/// Gauss-Legendre nodes and weights on (0, 1).
fn unit_interval(n: usize) -> Vec<(f64, f64)> {
    GaussLegendre::new(at_least_one(n))
        .as_node_weight_pairs()
        .iter()
        .map(|&(s, w)| (f64::midpoint(1.0, s), 0.5 * w))
        .collect()
}

fn at_least_one(n: usize) -> NonZeroUsize {
    NonZeroUsize::new(n).unwrap_or(NonZeroUsize::MIN)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `∫ λ1^i λ2^j` over the triangle, relative to twice its area: `i! j! / (i + j + 2)!`.
    fn exact(i: i32, j: i32) -> f64 {
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        factorial(i) * factorial(j) / factorial(i + j + 2)
    }

    #[test]
    fn product_rules_integrate_every_monomial_of_their_degree() {
        for n in 1..=8 {
            let rule = product_rule(n);
            for degree in 0..2 * n as i32 {
                for i in 0..=degree {
                    let j = degree - i;
                    let sum: f64 = rule
                        .iter()
                        .map(|p| p.weight * p.hats[1].powi(i) * p.hats[2].powi(j))
                        .sum();
                    approx::assert_relative_eq!(sum, exact(i, j), max_relative = 1e-12);
                }
            }
        }
    }

    #[test]
    fn every_weight_is_positive_and_every_point_inside() {
        for point in product_rule(7).into_iter().chain(corner_rule(6, 10)) {
            assert!(point.weight > 0.0);
            assert!(point.hats.iter().all(|&h| h > 0.0 && h < 1.0));
        }
    }
}
