//! Least squares for the forms that continue the series: near contact and far apart.

use nalgebra::DMatrix;
use rayon::prelude::*;
use scene::{Gap, LoadSet, MAX_MODES, PairLoads, SelfOther, SwirlLoads};

use crate::ExactError;
use crate::series::Solved;

/// Terms that tell what those there are leave out, over their number.
pub const MORE_TERMS: f64 = 1.5;

/// Factors of some functions of the gap (rows) in every column of the loads.
#[derive(Clone, Debug)]
pub struct Fit {
    factors: DMatrix<f64>,
    set: LoadSet,
}

/// The functions of the gap that a form is a combination of.
pub type Functions = fn(Gap) -> Vec<f64>;

/// What is known of the loads at a gap.
pub type Known = fn(Gap, LoadSet) -> (PairLoads, SwirlLoads);

impl Fit {
    /// Fits `functions` to the loads at `gaps` by series with `factor` times the usual number of terms, less `known`,
    /// every load weighted by what rounding leaves of it.
    pub fn new(
        (gaps, factor): (&[Gap], f64),
        set: LoadSet,
        functions: Functions,
        known: Known,
    ) -> Result<Self, ExactError> {
        let rows: Vec<Vec<f64>> = gaps.iter().map(|gap| functions(*gap)).collect();
        let sizes: Vec<Vec<f64>> = gaps
            .par_iter()
            .map(|gap| Ok(Solved::new(gap.eps(), set, factor)?.columns()))
            .collect::<Result<_, ExactError>>()?;
        let targets = gaps.iter().zip(&sizes).map(|(gap, loads)| {
            let (pair, swirl) = known(*gap, set);
            let known = pair.columns().chain(swirl.columns());
            loads.iter().zip(known).map(|(l, k)| l - k).collect()
        });
        let targets: Vec<Vec<f64>> = targets.collect();
        let count = rows.first().map_or(0, Vec::len);
        let mut factors = DMatrix::zeros(count, sizes.first().map_or(0, Vec::len));
        for column in 0..factors.ncols() {
            let weight = |i: usize| 1.0 / sizes[i][column].abs().max(1.0);
            let matrix = DMatrix::from_fn(gaps.len(), count, |i, j| weight(i) * rows[i][j]);
            let target = DMatrix::from_fn(gaps.len(), 1, |i, _| weight(i) * targets[i][column]);
            factors.set_column(column, &least_squares(matrix, &target)?.column(0));
        }
        Ok(Self { factors, set })
    }

    /// `known` and the combination of the values of the functions, for the loads of the pair in its set,
    /// which must be among those fitted.
    pub fn add_to(&self, known: &PairLoads, functions: &[f64]) -> PairLoads {
        let mut loads = PairLoads::from_column_pairs(known.set(), self.set, |k| SelfOther {
            sum: self.combined(2 * k, functions),
            difference: self.combined(2 * k + 1, functions),
        });
        loads += known;
        loads
    }

    /// The same for the loads by swirl in `set`.
    pub fn add_to_swirl(&self, known: &SwirlLoads, set: LoadSet, functions: &[f64]) -> SwirlLoads {
        let mut columns = [0.0; LoadSet::all(MAX_MODES).column_count()];
        let first = self.set.column_count();
        for (k, (column, known)) in columns.iter_mut().zip(known.columns()).enumerate() {
            *column = known + self.combined(first + k, functions);
        }
        SwirlLoads::from_columns(set, &columns)
    }

    /// The combination in one column.
    fn combined(&self, column: usize, functions: &[f64]) -> f64 {
        let factors = self.factors.column(column);
        let terms = functions.iter().zip(factors.iter()).map(|(f, c)| f * c);
        terms.sum()
    }

    /// The factors of the function number `index`, those of the loads by swirl last.
    pub fn factors(&self, index: usize) -> (PairLoads, SwirlLoads) {
        let row: Vec<f64> = self.factors.row(index).iter().copied().collect();
        let (pair, swirl) = row.split_at(self.set.column_count());
        (
            PairLoads::from_columns(self.set, self.set, pair),
            SwirlLoads::from_columns(self.set, swirl),
        )
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

/// Largest difference at `gaps` of `form`, fitted to series with `factor` times the usual number of terms, from series
/// with half as many again, relative to the larger of load and 1: what the form and the terms leave out.
pub fn largest_error(
    (gaps, factor): (&[f64], f64),
    set: LoadSet,
    form: impl Fn(Gap) -> (PairLoads, SwirlLoads) + Sync,
) -> Result<f64, ExactError> {
    gaps.par_iter()
        .map(|eps| {
            let series = Solved::new(*eps, set, MORE_TERMS * factor)?.columns();
            let (pair, swirl) = form(Gap::from_ln(eps.ln()));
            let form: Vec<f64> = pair.columns().chain(swirl.columns()).collect();
            Ok(relative_distance(&form, &series))
        })
        .try_reduce(|| 0.0, |a, b| Ok(a.max(b)))
}

/// Largest difference of two sets of columns, relative to the larger of the load and 1.
pub fn relative_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs() / b.abs().max(1.0))
        .fold(0.0, f64::max)
}
