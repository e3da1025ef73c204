//! Chebyshev interpolation of several functions at once on one interval.

use std::f64::consts::PI;

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

/// The first `N` columns of `sum_j coefficients[j] T_j(u)`, added to `start`, for `coefficients`
/// laid out row by row with `columns` numbers a row. Columns that the rows do not have stay as they are.
///
/// The number is a constant so that the sums stay in registers over all rows.
#[inline]
pub(crate) fn add_interpolant<const N: usize>(
    coefficients: &[f64],
    columns: usize,
    u: f64,
    start: [f64; N],
) -> [f64; N] {
    let mut sums = start;
    let (mut t, mut before) = (1.0, u);
    for row in coefficients.chunks_exact(columns) {
        match row.first_chunk::<N>() {
            Some(row) => {
                for (sum, c) in sums.iter_mut().zip(row) {
                    *sum += c * t;
                }
            }
            None => {
                for (sum, c) in sums.iter_mut().zip(row) {
                    *sum += c * t;
                }
            }
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
    fn an_interpolant_reproduces_a_polynomial_and_its_derivative_free_columns() {
        let polynomials = |u: f64| vec![1.0 - 2.0 * u + u.powi(5), u.powi(3)];
        let values: Vec<_> = points(8).map(polynomials).collect();
        let flat = coefficients(&values).concat();
        for u in [-1.0, -0.3, 0.0, 0.77, 1.0] {
            let out = add_interpolant(&flat, 2, u, [0.0; 2]);
            // Fewer or more columns than there are, to the bit.
            let [one] = add_interpolant(&flat, 2, u, [0.0]);
            let three = add_interpolant(&flat, 2, u, [0.0; 3]);
            let bits = [one, three[0], three[1], three[2]].map(f64::to_bits);
            assert_eq!(bits, [out[0], out[0], out[1], 0.0].map(f64::to_bits));
            assert_relative_eq!(out[0], polynomials(u)[0], epsilon = 1e-14);
            assert_relative_eq!(out[1], polynomials(u)[1], epsilon = 1e-14);
        }
    }
}
