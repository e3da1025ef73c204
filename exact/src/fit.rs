//! Least squares for the forms that continue the series: near contact and far apart.

use nalgebra::DMatrix;
use rayon::prelude::*;
use scene::{Gap, LoadSet, MAX_MODES, PairLoads};

use crate::ExactError;
use crate::series::Solved;

/// Factors of some functions of the gap (rows) in every column of the loads.
#[derive(Clone, Debug)]
pub struct Fit {
    factors: DMatrix<f64>,
    set: LoadSet,
}

/// The functions of the gap that a form is a combination of.
pub type Functions = fn(Gap) -> Vec<f64>;

impl Fit {
    /// Fits `functions` to the series' loads at `gaps` less `known`, every load weighted by what
    /// rounding leaves of it.
    pub fn new(
        gaps: &[Gap],
        set: LoadSet,
        functions: Functions,
        known: fn(Gap, LoadSet) -> PairLoads,
    ) -> Result<Self, ExactError> {
        let rows: Vec<Vec<f64>> = gaps.iter().map(|gap| functions(*gap)).collect();
        let loads: Vec<PairLoads> = gaps
            .par_iter()
            .map(|gap| Ok(Solved::new(gap.eps(), set, 1.0)?.loads()))
            .collect::<Result<_, ExactError>>()?;
        let targets = gaps.iter().zip(&loads).map(|(gap, loads)| {
            let known = known(*gap, set);
            loads
                .columns()
                .zip(known.columns())
                .map(|(l, k)| l - k)
                .collect()
        });
        let targets: Vec<Vec<f64>> = targets.collect();
        let sizes: Vec<Vec<f64>> = loads.iter().map(|l| l.columns().collect()).collect();
        let count = rows.first().map_or(0, Vec::len);
        let mut factors = DMatrix::zeros(count, set.column_count());
        for column in 0..factors.ncols() {
            let weight = |i: usize| 1.0 / sizes[i][column].abs().max(1.0);
            let matrix = DMatrix::from_fn(gaps.len(), count, |i, j| weight(i) * rows[i][j]);
            let target = DMatrix::from_fn(gaps.len(), 1, |i, _| weight(i) * targets[i][column]);
            factors.set_column(column, &least_squares(matrix, &target)?.column(0));
        }
        Ok(Self { factors, set })
    }

    /// The combination of the values of the functions, for the loads of `set`, which must be among those fitted.
    pub fn combine(&self, functions: &[f64], set: LoadSet) -> PairLoads {
        // On the stack: a trajectory's step may ask for this.
        let mut columns = [0.0; LoadSet::all(MAX_MODES).column_count()];
        let asked = LoadSet {
            modes: set.modes,
            ..self.set
        }
        .column_count();
        for (column, factors) in columns
            .iter_mut()
            .zip(self.factors.column_iter())
            .take(asked)
        {
            *column = functions
                .iter()
                .zip(factors.iter())
                .map(|(f, c)| f * c)
                .sum();
        }
        PairLoads::from_columns(set, self.set, &columns)
    }

    /// The factors of the function number `index`.
    pub fn factors(&self, index: usize) -> PairLoads {
        let row: Vec<f64> = self.factors.row(index).iter().copied().collect();
        PairLoads::from_columns(self.set, self.set, &row)
    }
}

fn least_squares(mut matrix: DMatrix<f64>, rhs: &DMatrix<f64>) -> Result<DMatrix<f64>, ExactError> {
    let gaps = matrix.nrows();
    // Functions of very different size: each column is brought to length 1 first.
    let lengths: Vec<f64> = matrix.column_iter().map(|c| c.norm()).collect();
    for (mut column, length) in matrix.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let qr = matrix.qr();
    let mut solution = qr
        .r()
        .solve_upper_triangular(&qr.q().tr_mul(rhs))
        .ok_or(ExactError::SingularFit { gaps })?;
    for (mut row, length) in solution.row_iter_mut().zip(&lengths) {
        row /= *length;
    }
    Ok(solution)
}

/// `count` gaps evenly spaced in `ln eps`.
pub fn geometric(from: f64, to: f64, count: usize) -> Vec<Gap> {
    let step = (to / from).ln() / (count - 1) as f64;
    (0..count)
        .map(|k| Gap::from_ln(from.ln() + step * k as f64))
        .collect()
}

/// Largest difference of `form` from the series at `gaps`, relative to the larger of load and 1.
pub fn largest_error(
    gaps: &[f64],
    set: LoadSet,
    form: impl Fn(Gap) -> PairLoads + Sync,
) -> Result<f64, ExactError> {
    gaps.par_iter()
        .map(|eps| {
            let series = Solved::new(*eps, set, 1.0)?.loads();
            Ok(relative_distance(&form(Gap::from_ln(eps.ln())), &series))
        })
        .try_reduce(|| 0.0, |a, b| Ok(a.max(b)))
}

/// Largest difference of two sets of loads, relative to the larger of the load and 1.
pub fn relative_distance(a: &PairLoads, b: &PairLoads) -> f64 {
    a.columns()
        .zip(b.columns())
        .map(|(a, b)| (a - b).abs() / b.abs().max(1.0))
        .fold(0.0, f64::max)
}

/// `a + b`, load by load.
pub fn sum(a: &PairLoads, b: &PairLoads, set: LoadSet) -> PairLoads {
    let mut columns = [0.0; LoadSet::all(MAX_MODES).column_count()];
    let both = a.columns().zip(b.columns());
    for (column, (a, b)) in columns.iter_mut().zip(both) {
        *column = a + b;
    }
    PairLoads::from_columns(set, set, &columns)
}
