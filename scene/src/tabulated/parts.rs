//! What a look-up evaluates: polynomials of low degree on equal parts of a piece.
//!
//! A piece converges as one Chebyshev series of up to 33 terms, the cheapest in solves of the model. On
//! parts of it the same series is matched by polynomials of a third of the length, which take no further solve,
//! and by Horner's rule no recurrence.

use serde::{Deserialize, Serialize};

use super::chebyshev::{coefficients, interpolant, points, tail};

/// Highest degree on a part.
const DEGREE: usize = 10;

/// Parts after which a piece is taken as it is.
const MOST: usize = 1024;

/// Rounding of a series: no part can be closer to it.
const ROUNDING: f64 = 1e-14;

/// Several functions, the columns, on the interval [0, 1].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Parts {
    count: usize,
    pub(super) columns: usize,
    /// Part by part, power by power of `u` in [-1, 1], the highest first, column by column.
    coefficients: Vec<f64>,
}

impl Parts {
    /// Of the Chebyshev series whose row `j` holds the coefficients of `T_j`, to `accuracy` relative to the larger
    /// of the function and 1, but for columns that are not `read`.
    pub fn of_series(series: &[Vec<f64>], accuracy: f64, read: &[bool]) -> Self {
        let columns = series.first().map_or(0, Vec::len);
        let of = |count, coefficients| Self {
            count,
            columns,
            coefficients,
        };
        if columns == 0 || series.len() <= DEGREE + 1 {
            return of(1, powers(series).concat());
        }
        let accuracy = accuracy.max(ROUNDING);
        let mut count = 2;
        loop {
            let parts: Vec<_> = (0..count)
                .map(|part| matched(series, part, count, read))
                .collect();
            let worst = parts.iter().map(|(_, tail)| *tail).fold(0.0, f64::max);
            if worst <= accuracy || count >= MOST {
                let rows = parts.iter().flat_map(|(series, _)| powers(series));
                return of(count, rows.flatten().collect());
            }
            count *= 2;
        }
    }

    /// The first `N` columns at `x` in [0, 1], added to `start`. Columns that there are not stay as they are.
    ///
    /// The number is a constant so that the sums stay in registers over all powers.
    #[inline]
    pub fn add_to<const N: usize>(&self, x: f64, start: [f64; N]) -> [f64; N] {
        let place = x * self.count as f64;
        // Saturates: outside of the interval its first and its last part go on.
        let part = (place as usize).min(self.count - 1);
        let u = 2.0 * (place - part as f64) - 1.0;
        let length = self.coefficients.len() / self.count;
        let of_part = &self.coefficients[part * length..(part + 1) * length];
        let mut sums = [0.0; N];
        for row in of_part.chunks_exact(self.columns.max(1)) {
            match row.first_chunk::<N>() {
                Some(row) => {
                    for (sum, c) in sums.iter_mut().zip(row) {
                        *sum = *sum * u + c;
                    }
                }
                None => {
                    for (sum, c) in sums.iter_mut().zip(row) {
                        *sum = *sum * u + c;
                    }
                }
            }
        }
        std::array::from_fn(|column| start[column] + sums[column])
    }
}

/// The series on one of `count` parts that matches `series` at the Chebyshev points there, and the size of its last
/// coefficients, relative to the larger of the function and 1.
fn matched(series: &[Vec<f64>], part: usize, count: usize, read: &[bool]) -> (Vec<Vec<f64>>, f64) {
    let values: Vec<Vec<f64>> = points(DEGREE)
        .map(|u| {
            let x = (part as f64 + 0.5 * (1.0 + u)) / count as f64;
            interpolant(series, 2.0 * x - 1.0)
        })
        .collect();
    let rows = coefficients(&values);
    let tail = tail(&rows, &values, read);
    (rows, tail)
}

/// The powers of `u`, the highest first, of a Chebyshev series.
fn powers(series: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let columns = series.first().map_or(0, Vec::len);
    let mut rows = vec![vec![0.0; columns]; series.len()];
    // T_j in powers of u: its own, and those of the one before and the next.
    let mut now = vec![0.0; series.len() + 1];
    let mut before = now.clone();
    now[0] = 1.0;
    // T_{-1} = T_1.
    before[1] = 1.0;
    for terms in series {
        for (row, power) in rows.iter_mut().rev().zip(&now) {
            for (c, term) in row.iter_mut().zip(terms) {
                *c += power * term;
            }
        }
        let mut next: Vec<f64> = before.iter().map(|c| -c).collect();
        for (k, c) in now.iter().enumerate().take(series.len()) {
            next[k + 1] += 2.0 * c;
        }
        before = std::mem::replace(&mut now, next);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn series_of(function: impl Fn(f64) -> Vec<f64>, degree: usize) -> Vec<Vec<f64>> {
        let values: Vec<_> = points(degree).map(function).collect();
        coefficients(&values)
    }

    #[test]
    fn val_a_polynomial_and_its_columns_are_reproduced_to_rounding() {
        let polynomials = |u: f64| vec![1.0 - 2.0 * u + u.powi(5), u.powi(3)];
        let parts = Parts::of_series(&series_of(polynomials, 8), 1e-12, &[]);
        assert_eq!(parts.count, 1);
        for u in [-1.0, -0.3, 0.0, 0.77, 1.0] {
            let x = 0.5 * (1.0 + u);
            let out = parts.add_to(x, [0.0; 2]);
            // Fewer or more columns than there are, to the bit.
            let [one] = parts.add_to(x, [0.0]);
            let three = parts.add_to(x, [0.0; 3]);
            let bits = [one, three[0], three[1], three[2]].map(f64::to_bits);
            assert_eq!(bits, [out[0], out[0], out[1], 0.0].map(f64::to_bits));
            assert_relative_eq!(out[0], polynomials(u)[0], epsilon = 1e-14);
            assert_relative_eq!(out[1], polynomials(u)[1], epsilon = 1e-14);
        }
    }

    #[test]
    fn val_parts_are_as_close_to_the_series_as_asked_for_everywhere() {
        // Poles at a distance of 0.5 from the interval: degree 32 has them to 1e-7.
        let function = |u: f64| vec![1.0 / (u * u + 0.25), (3.0 * u).exp()];
        let series = series_of(function, 32);
        for accuracy in [1e-6, 1e-9, 1e-12] {
            let parts = Parts::of_series(&series, accuracy, &[]);
            assert!(parts.count > 1);
            for k in 0..=1000 {
                let x = f64::from(k) / 1000.0;
                let expected = interpolant(&series, 2.0 * x - 1.0);
                for (found, expected) in parts.add_to(x, [0.0; 2]).into_iter().zip(expected) {
                    let error = (found - expected).abs() / expected.abs().max(1.0);
                    assert!(error <= 2.0 * accuracy, "{error} at {x}, {accuracy}");
                }
            }
        }
    }
}
