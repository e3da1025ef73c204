//! What a look-up evaluates: polynomials of low degree on equal parts of a stretch.
//!
//! A piece converges as one Chebyshev series of up to 33 terms, the cheapest in solves of the model. On
//! parts of it the same series is matched by polynomials of a fraction of the length, which take no further solve,
//! and by Horner's rule no recurrence.

use serde::{Deserialize, Serialize};
use wide::f64x2;

use crate::chebyshev::{coefficients, interpolant, points, tail};

/// Degree on a part: with a lower one parts would have to be so narrow that they no longer fit into the first cache.
pub(super) const DEGREE: usize = 7;

/// Parts of a stretch after which it is taken as it is.
const MOST: usize = 1 << 14;

/// Rounding of a series: no part can be closer to it.
const ROUNDING: f64 = 1e-14;

/// A Chebyshev series of several columns on one of `2^halvings` equal pieces of a stretch.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub halvings: u32,
    /// The coefficients of `T_j` in row `j`.
    pub series: Vec<Vec<f64>>,
}

/// Several functions, the columns, on a stretch of the coordinate, as they are kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Stretch {
    columns: usize,
    /// Part by part, power by power of `u` in [-1, 1], the highest first, column by column.
    coefficients: Vec<f64>,
}

impl Stretch {
    /// Of the pieces that make up the stretch, in their order, to `accuracy` relative to the larger of the function and 1, in
    /// `2^least` parts at least; with the error that is left.
    pub fn of_pieces(pieces: &[Piece], accuracy: f64, least: u32) -> (Self, f64) {
        let accuracy = accuracy.max(ROUNDING);
        let columns = (pieces.first())
            .and_then(|piece| piece.series.first())
            .map_or(0, Vec::len);
        let (mut halvings, mut error) = (least, 0.0_f64);
        for piece in pieces {
            let mut more = 0;
            let left = loop {
                let left = unmatched(&piece.series, 1 << more);
                if left <= accuracy || 1 << (piece.halvings + more) >= MOST {
                    break left;
                }
                more += 1;
            };
            halvings = halvings.max(piece.halvings + more);
            error = error.max(left);
        }
        let coefficients = (pieces.iter())
            .flat_map(|piece| {
                let count = 1 << (halvings - piece.halvings);
                (0..count).flat_map(move |part| powers(&fitted(&piece.series, part, count).1))
            })
            .flatten()
            .collect();
        let stretch = Self {
            columns,
            coefficients,
        };
        (stretch, error)
    }
}

/// One power of all columns, two by two.
type Row<const PAIRS: usize> = [f64x2; PAIRS];

/// Stretches laid out for look-ups, with so many pairs of columns, of which the last one may be zero. Without stretches there is
/// nothing to be looked up.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Parts<const PAIRS: usize> {
    /// The parts of all stretches.
    parts: Vec<[Row<PAIRS>; DEGREE + 1]>,
    /// The first part of each stretch, and the number of them, if they are not as many as most columns have.
    finer: Vec<(usize, u32)>,
}

/// A place in a table whose stretches have as many parts as most columns have. With `SLOPE` the derivatives by the place on the stretch are read
/// there instead of the values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<const SLOPE: bool = false> {
    /// Index of the stretch.
    stretch: usize,
    /// The place there, from 0 to 1.
    x: f64,
    /// The part among all.
    part: usize,
    /// The place there, from -1 to 1.
    u: f64,
    /// Number of parts of the stretch.
    count: u32,
    /// What a derivative is multiplied by.
    factor: f64,
}

impl Place {
    /// The place `x`, which is below 1, on a stretch whose parts, so many from `first` on, are those of most columns.
    #[inline(always)]
    pub fn new(stretch: usize, x: f64, (first, count): (usize, u32)) -> Self {
        let place = x * f64::from(count);
        // It saturates, in 32 bits in three instructions: the first part goes on below.
        let part = place as u32;
        Self {
            stretch,
            x,
            part: first + part as usize,
            u: 2.0 * (place - f64::from(part)) - 1.0,
            count,
            factor: 1.0,
        }
    }

    /// The same place, where derivatives times a factor are read.
    pub fn of_slopes(self, factor: f64) -> Place<true> {
        let Self {
            stretch,
            x,
            part,
            u,
            count,
            ..
        } = self;
        Place {
            stretch,
            x,
            part,
            u,
            count,
            factor,
        }
    }
}

impl<const PAIRS: usize> Parts<PAIRS> {
    /// None if a stretch is not one of so many columns. `usual` are the numbers of parts that most columns have.
    pub fn new(stretches: &[Stretch], usual: &[u32]) -> Option<Self> {
        let (mut parts, mut finer) = (Vec::new(), Vec::new());
        for Stretch {
            columns,
            coefficients,
        } in stretches
        {
            let row = |row: &[f64]| {
                let column = |k: usize| row.get(k).copied().unwrap_or(0.0);
                std::array::from_fn(|pair| f64x2::from([column(2 * pair), column(2 * pair + 1)]))
            };
            let length = columns * (DEGREE + 1);
            if columns.div_ceil(2) != PAIRS || !coefficients.len().is_multiple_of(length) {
                return None;
            }
            finer.push((parts.len(), (coefficients.len() / length) as u32));
            parts.extend((coefficients.chunks_exact(length)).map(|part| {
                std::array::from_fn(|power| row(&part[power * columns..][..*columns]))
            }));
        }
        if finer.iter().map(|(_, count)| count).eq(usual) {
            finer.clear();
        }
        Some(Self { parts, finer })
    }

    /// The first `N` pairs of columns at a place, if they are tabulated: their values, or their derivatives where the place asks for these. The number is
    /// a constant so that the sums stay in registers over all powers.
    #[inline(always)]
    pub fn at<const N: usize, const SLOPE: bool>(
        &self,
        place: &Place<SLOPE>,
    ) -> Option<[[f64; 2]; N]> {
        const { assert!(N <= PAIRS, "more columns than there are") };
        let (part, u, count) = match &self.finer[..] {
            [] => (place.part, place.u, place.count),
            finer => {
                let own = Place::new(0, place.x, *finer.get(place.stretch)?);
                (own.part, own.u, own.count)
            }
        };
        let u = f64x2::splat(u);
        let [first, others @ ..] = self.parts.get(part)?;
        let mut sums: [f64x2; N] = std::array::from_fn(|pair| first[pair]);
        if SLOPE {
            // By Horner's rule too; `u` is two on a part.
            let mut slopes = [f64x2::ZERO; N];
            for row in others {
                for ((slope, sum), c) in slopes.iter_mut().zip(&mut sums).zip(row) {
                    *slope = *slope * u + *sum;
                    *sum = *sum * u + *c;
                }
            }
            let factor = f64x2::splat(2.0 * f64::from(count) * place.factor);
            return Some(slopes.map(|slope| (slope * factor).to_array()));
        }
        for row in others {
            for (sum, c) in sums.iter_mut().zip(row) {
                *sum = *sum * u + *c;
            }
        }
        Some(sums.map(f64x2::to_array))
    }
}

/// What polynomials on `count` equal parts leave of `series`, relative to the larger of it and 1.
fn unmatched(series: &[Vec<f64>], count: usize) -> f64 {
    let left = (0..count).map(|part| {
        let (values, rows) = fitted(series, part, count);
        tail(&rows, &values)
    });
    left.fold(0.0, f64::max)
}

/// The values of `series` at the Chebyshev points of one of `count` parts, and the series through them.
fn fitted(series: &[Vec<f64>], part: usize, count: usize) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let values: Vec<Vec<f64>> = points(DEGREE)
        .map(|u| {
            let x = (part as f64 + 0.5 * (1.0 + u)) / count as f64;
            interpolant(series, 2.0 * x - 1.0)
        })
        .collect();
    let rows = coefficients(&values);
    (values, rows)
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

    fn pieces_of(function: impl Fn(f64) -> Vec<f64>, degree: usize, halvings: u32) -> Vec<Piece> {
        let count = 1 << halvings;
        (0..count)
            .map(|number| {
                let values: Vec<_> = points(degree)
                    .map(|u| function((number as f64 + 0.5 * (1.0 + u)) / count as f64))
                    .collect();
                Piece {
                    halvings,
                    series: coefficients(&values),
                }
            })
            .collect()
    }

    #[test]
    fn val_a_polynomial_and_its_columns_are_reproduced_to_rounding() {
        let polynomials = |x: f64| vec![1.0 - 2.0 * x + x.powi(5), x.powi(3)];
        let (stretch, _) = Stretch::of_pieces(&pieces_of(polynomials, 8, 0), 1e-12, 0);
        let of = |usual| Parts::<1>::new(&[stretch.clone(), stretch.clone()], &[usual; 2]).unwrap();
        for x in [-0.1, 0.0, 0.3, 0.77, 0.999] {
            // In so many parts as they have, and in other ones.
            for usual in [1, 8] {
                let [both] = of(usual)
                    .at(&Place::new(1, x, (usual as usize, usual)))
                    .unwrap();
                assert_relative_eq!(both[0], polynomials(x)[0], epsilon = 1e-14);
                assert_relative_eq!(both[1], polynomials(x)[1], epsilon = 1e-14);
            }
        }
        let nowhere = Place::new(2, 0.5, (2, 1));
        assert_eq!(
            [of(1).at::<1, false>(&nowhere), of(8).at(&nowhere)],
            [None; 2]
        );
        assert!(
            Parts::<2>::new(&[stretch], &[1]).is_none(),
            "too few columns"
        );
    }

    #[test]
    fn val_parts_are_as_close_to_the_series_as_asked_for_everywhere() {
        // Poles at a distance of 0.25 from the interval: degree 32 has them to 1e-7.
        let function = |x: f64| vec![1.0 / ((2.0 * x - 1.0).powi(2) + 0.25), (6.0 * x).exp()];
        for halvings in [0, 2] {
            let pieces = pieces_of(function, 32, halvings);
            for accuracy in [1e-6, 1e-9, 1e-12] {
                let (stretch, left) = Stretch::of_pieces(&pieces, accuracy, 1);
                assert!(left <= accuracy);
                let parts = Parts::<1>::new(&[stretch], &[1]).unwrap();
                let count = parts.parts.len() as u32;
                assert!(parts.parts.len() > pieces.len());
                for k in 0..1000 {
                    let x = f64::from(k) / 1000.0;
                    let place = x * pieces.len() as f64;
                    let number = (place as usize).min(pieces.len() - 1);
                    let u = 2.0 * (place - number as f64) - 1.0;
                    let expected = interpolant(&pieces[number].series, u);
                    let [both] = parts.at(&Place::new(0, x, (0, count))).unwrap();
                    for (found, expected) in both.into_iter().zip(expected) {
                        let error = (found - expected).abs() / expected.abs().max(1.0);
                        assert!(error <= 2.0 * accuracy, "{error} at {x}, {accuracy}");
                    }
                }
            }
        }
    }
}
