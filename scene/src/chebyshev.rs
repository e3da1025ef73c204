//! Chebyshev interpolation of several functions at once on one interval.

use std::f64::consts::PI;

/// Degree at which the search for one begins.
pub(crate) const FIRST_DEGREE: usize = 4;

/// Highest degree of a piece.
pub(crate) const MAX_DEGREE: usize = 32;

/// The `degree + 1` Chebyshev points `cos(pi k/degree)` of [-1, 1], from 1 to -1; those of twice
/// the degree contain them at even `k`.
pub(crate) fn points(degree: usize) -> impl Iterator<Item = f64> {
    (0..=degree).map(move |k| (PI * k as f64 / degree as f64).cos())
}

/// Coefficients `c_0 ... c_degree` of the interpolant `sum c_j T_j` through `values[k]` at
/// [`points`], column by column: `values[k][column]` gives `coefficients[j][column]`.
pub(crate) fn coefficients(values: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let degree = values.len() - 1;
    let columns = values.first().map_or(0, Vec::len);
    let end_weight = |k: usize| if k == 0 || k == degree { 0.5 } else { 1.0 };
    (0..=degree)
        .map(|j| {
            let mut row = vec![0.0; columns];
            for (k, value) in values.iter().enumerate() {
                // The angle is reduced to the first period to keep its digits.
                let angle = PI * ((j * k) % (2 * degree)) as f64 / degree as f64;
                let weight = 2.0 / degree as f64 * end_weight(k) * end_weight(j) * angle.cos();
                for (c, v) in row.iter_mut().zip(value) {
                    *c += weight * v;
                }
            }
            row
        })
        .collect()
}

/// Size of the last coefficients, in columns relative to the larger of their values and 1.
pub(crate) fn tail(rows: &[Vec<f64>], values: &[Vec<f64>]) -> f64 {
    let columns = rows.first().map_or(0, Vec::len);
    (0..columns)
        .map(|column| {
            let scale = values.iter().map(|v| v[column].abs()).fold(1.0, f64::max);
            let last = rows.iter().rev().take(2).map(|row| row[column].abs());
            last.sum::<f64>() / scale
        })
        .fold(0.0, f64::max)
}

/// Largest variation of a column over the values, relative to the larger of the values and 1: what an interpolant that has not
/// converged may be off by.
pub(crate) fn variation(values: &[Vec<f64>]) -> f64 {
    let columns = values.first().map_or(0, Vec::len);
    (0..columns)
        .map(|column| {
            let of = || values.iter().map(|v| v[column]);
            let scale = of().map(f64::abs).fold(1.0, f64::max);
            (of().fold(f64::MIN, f64::max) - of().fold(f64::MAX, f64::min)) / scale
        })
        .fold(0.0, f64::max)
}

/// All columns of `sum_j series[j] T_j(u)`.
pub(crate) fn interpolant(series: &[Vec<f64>], u: f64) -> Vec<f64> {
    let columns = series.first().map_or(0, Vec::len);
    let mut sums = vec![0.0; columns];
    let (mut t, mut before) = (1.0, u);
    for row in series {
        for (sum, c) in sums.iter_mut().zip(row) {
            *sum += c * t;
        }
        // T_{j+1} = 2 u T_j - T_{j-1}, from T_0 = 1 and T_{-1} = u.
        (t, before) = (2.0 * u * t - before, t);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn val_an_interpolant_reproduces_a_polynomial_between_its_points() {
        let polynomials = |u: f64| vec![1.0 - 2.0 * u + u.powi(5), u.powi(3)];
        let values: Vec<_> = points(8).map(polynomials).collect();
        let series = coefficients(&values);
        for u in [-1.0, -0.3, 0.0, 0.77, 1.0] {
            for (found, expected) in interpolant(&series, u).into_iter().zip(polynomials(u)) {
                assert_relative_eq!(found, expected, epsilon = 1e-14);
            }
        }
    }
}
