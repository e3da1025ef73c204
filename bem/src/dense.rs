//! Dense linear systems, with the residual checked after every solve.

use std::time::Instant;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::{Mat, MatRef, Par};

use crate::BemError;

/// Largest residual allowed, relative to `|A| |x| + |b|`: far above rounding, far below any
/// discretisation error.
const ALLOWED: f64 = 1e-10;

/// Solutions of a system for some right-hand sides, and the seconds they took.
pub struct Solved {
    pub x: Vec<Vec<f64>>,
    pub factorisation: f64,
    /// Substitution and the check of the residual.
    pub substitution: f64,
}

/// Solves `A x = b` for all right-hand sides; `rows` holds A row by row.
///
/// One thread, so that the result has the same bits however many threads there are: systems are
/// solved side by side instead.
pub fn solve_all(rows: &[f64], right: &[Vec<f64>]) -> Result<Solved, BemError> {
    let start = Instant::now();
    let n = right.first().map_or(0, Vec::len);
    let matrix = MatRef::from_row_major_slice(rows, n, n);
    let b = Mat::from_fn(n, right.len(), |i, j| right[j][i]);
    let (x, factorised) = lu_solve(matrix, b.clone());
    let residual = relative_residual(matrix, &x, &b);
    // NaN must fail too.
    if residual <= ALLOWED {
        let columns = 0..right.len();
        Ok(Solved {
            x: columns
                .map(|j| x.col(j).iter().copied().collect())
                .collect(),
            factorisation: (factorised - start).as_secs_f64(),
            substitution: factorised.elapsed().as_secs_f64(),
        })
    } else {
        Err(BemError::Residual {
            unknowns: n,
            residual,
            allowed: ALLOWED,
        })
    }
}

/// The solution, and when the matrix was factorised.
fn lu_solve(matrix: MatRef<'_, f64>, mut b: Mat<f64>) -> (Mat<f64>, Instant) {
    let n = matrix.nrows();
    let par = Par::Seq;
    let mut lu = matrix.to_owned();
    let (mut forward, mut backward) = (vec![0usize; n], vec![0usize; n]);
    let scratch = factor::lu_in_place_scratch::<usize, f64>(n, n, par, Default::default()).or(
        solve::solve_in_place_scratch::<usize, f64>(n, b.ncols(), par),
    );
    let mut memory = MemBuffer::new(scratch);
    let (_, permutation) = factor::lu_in_place(
        lu.as_mut(),
        &mut forward,
        &mut backward,
        par,
        MemStack::new(&mut memory),
        Default::default(),
    );
    let factorised = Instant::now();
    solve::solve_in_place(
        lu.as_ref(),
        lu.as_ref(),
        permutation,
        b.as_mut(),
        par,
        MemStack::new(&mut memory),
    );
    (b, factorised)
}

/// Largest over smallest singular value of a square matrix, given row by row.
pub fn condition(rows: &[f64], unknowns: usize) -> Result<f64, BemError> {
    let matrix = MatRef::from_row_major_slice(rows, unknowns, unknowns);
    let values = (matrix.singular_values()).map_err(|_| BemError::SingularValues { unknowns })?;
    let (least, most) = (values.iter()).fold((f64::INFINITY, 0.0), |(least, most), &v| {
        (f64::min(least, v), f64::max(most, v))
    });
    Ok(most / least)
}

fn relative_residual(matrix: MatRef<'_, f64>, x: &Mat<f64>, b: &Mat<f64>) -> f64 {
    let mut worst = 0.0;
    let mut scale = 0.0;
    for i in 0..matrix.nrows() {
        for j in 0..b.ncols() {
            let (mut sum, mut size) = (-b[(i, j)], b[(i, j)].abs());
            for k in 0..matrix.ncols() {
                let term = matrix[(i, k)] * x[(k, j)];
                sum += term;
                size += term.abs();
            }
            // `max` would lose a NaN, which must fail the check.
            if sum.abs() > worst || sum.is_nan() {
                worst = sum.abs();
            }
            scale = f64::max(scale, size);
        }
    }
    if scale > 0.0 { worst / scale } else { worst }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_singular_system_is_an_error_not_a_number() {
        let rows = [1.0, 2.0, 2.0, 4.0];
        assert!(matches!(
            solve_all(&rows, &[vec![1.0, 0.0]]),
            Err(BemError::Residual { unknowns: 2, .. })
        ));
    }

    #[test]
    fn the_condition_of_a_rotated_diagonal_is_the_ratio_of_its_ends() {
        let (s, c) = 0.3_f64.sin_cos();
        let rows = [8.0 * c, -2.0 * s, 8.0 * s, 2.0 * c];
        approx::assert_relative_eq!(condition(&rows, 2).unwrap(), 4.0, max_relative = 1e-14);
    }

    #[test]
    fn a_system_that_needs_pivoting_is_solved() {
        let x = solve_all(&[0.0, 2.0, 1.0, 0.0], &[vec![4.0, 3.0]]).unwrap();
        assert_eq!(x.x, vec![vec![3.0, 2.0]]);
    }
}
