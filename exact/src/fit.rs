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
pub struct Factors(DMatrix<f64>);

impl Factors {
    /// Fits `functions` to the columns that are `solved` at `gaps`, less those `known`, every column weighted by what rounding leaves
    /// of it.
    pub fn new(
        gaps: &[Gap],
        functions: impl Fn(Gap) -> Vec<f64>,
        solved: impl Fn(Gap) -> Result<Vec<f64>, ExactError> + Sync,
        known: impl Fn(Gap) -> Vec<f64>,
    ) -> Result<Self, ExactError> {
        let rows: Vec<Vec<f64>> = gaps.iter().map(|gap| functions(*gap)).collect();
        let sizes: Vec<Vec<f64>> = gaps
            .par_iter()
            .map(|gap| solved(*gap))
            .collect::<Result<_, ExactError>>()?;
        let targets = gaps.iter().zip(&sizes).map(|(gap, loads)| {
            let known = known(*gap);
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
        Ok(Self(factors))
    }

    /// The combination of the values of the functions in one column.
    pub fn combined(&self, column: usize, functions: &[f64]) -> f64 {
        let factors = self.0.column(column);
        let terms = functions.iter().zip(factors.iter()).map(|(f, c)| f * c);
        terms.sum()
    }

    /// The factors of the function number `index` in all columns.
    pub fn of(&self, index: usize) -> Vec<f64> {
        self.0.row(index).iter().copied().collect()
    }
}

/// Factors for the loads of equal spheres.
#[derive(Clone, Debug)]
pub struct Fit {
    factors: Factors,
    set: LoadSet,
}

/// The functions of the gap that a form is a combination of.
pub type Functions = fn(Gap) -> Vec<f64>;

/// What is known of the loads at a gap.
pub type Known = fn(Gap, LoadSet) -> (PairLoads, SwirlLoads);

impl Fit {
    /// Fits `functions` to the loads at `gaps` by series with `factor` times the usual number of terms, less `known`.
    pub fn new(
        (gaps, factor): (&[Gap], f64),
        set: LoadSet,
        functions: Functions,
        known: Known,
    ) -> Result<Self, ExactError> {
        let solved = |gap: Gap| Ok(Solved::new(gap.eps(), set, factor)?.columns());
        let known = |gap: Gap| {
            let (pair, swirl) = known(gap, set);
            pair.columns().chain(swirl.columns()).collect()
        };
        let factors = Factors::new(gaps, functions, solved, known)?;
        Ok(Self { factors, set })
    }

    /// `known` and the combination of the values of the functions, for the loads of the pair in its set,
    /// which must be among those fitted.
    pub fn add_to(&self, known: &PairLoads, functions: &[f64]) -> PairLoads {
        let mut loads = PairLoads::from_column_pairs(known.set(), self.set, |k| SelfOther {
            sum: self.factors.combined(2 * k, functions),
            difference: self.factors.combined(2 * k + 1, functions),
        });
        loads += known;
        loads
    }

    /// The same for the loads by swirl in `set`.
    pub fn add_to_swirl(&self, known: &SwirlLoads, set: LoadSet, functions: &[f64]) -> SwirlLoads {
        let mut columns = [0.0; LoadSet::all(MAX_MODES).column_count()];
        let first = self.set.column_count();
        for (k, (column, known)) in columns.iter_mut().zip(known.columns()).enumerate() {
            *column = known + self.factors.combined(first + k, functions);
        }
        SwirlLoads::from_columns(set, &columns)
    }

    /// The factors of the function number `index`, those of the loads by swirl last.
    pub fn factors(&self, index: usize) -> (PairLoads, SwirlLoads) {
        let row = self.factors.of(index);
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
    let series = |eps| Ok(Solved::new(eps, set, MORE_TERMS * factor)?.columns());
    largest_difference(gaps, series, |gap| {
        let (pair, swirl) = form(gap);
        pair.columns().chain(swirl.columns()).collect()
    })
}

/// Largest difference at `gaps` of the columns of a form from those of series.
pub fn largest_difference(
    gaps: &[f64],
    series: impl Fn(f64) -> Result<Vec<f64>, ExactError> + Sync,
    form: impl Fn(Gap) -> Vec<f64> + Sync,
) -> Result<f64, ExactError> {
    gaps.par_iter()
        .map(|eps| {
            let series = series(*eps)?;
            Ok(relative_distance(&form(Gap::from_ln(eps.ln())), &series))
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
