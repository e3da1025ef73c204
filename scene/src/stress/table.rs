//! Stresslets and rates of work between the gaps at which a model was asked.

use rayon::prelude::*;

use super::Stresses;
use crate::chebyshev::{FIRST_DEGREE, MAX_DEGREE, coefficients, interpolant, points, tail};
use crate::{Fluid, Gap, GapRange, SceneError};

/// Halvings of a piece after which its interpolant is taken as it is.
const MAX_HALVINGS: u32 = 8;

/// A piece in `ln eps`, and its Chebyshev series, one row for each degree.
#[derive(Clone, Debug)]
struct Piece {
    low: f64,
    high: f64,
    series: Vec<Vec<f64>>,
}

/// The [`Stresses`] of a model in a range of gaps, by Chebyshev series of `ln eps`. No piece spans a seam of the model.
#[derive(Clone, Debug)]
pub struct StressTable {
    /// What is tabulated, with the numbers of one gap.
    like: Stresses,
    range: GapRange,
    pieces: Vec<Piece>,
    error: f64,
    evaluations: usize,
}

impl StressTable {
    /// Tabulates a model between two gaps for the squirming modes 1 to `modes` and the swirl modes 1 to `swirl`, to the `tolerance` relative to the
    /// larger of the number and 1, or to the model's noise. Gaps are asked in parallel.
    ///
    /// # Errors
    /// Those of the model.
    pub fn build(
        model: &dyn Fluid,
        [smallest, largest]: [Gap; 2],
        (modes, swirl): (usize, usize),
        tolerance: f64,
    ) -> Result<Self, SceneError> {
        let description = model.description();
        description.range.check(smallest)?;
        // A single gap is given room.
        let (low, high) = (smallest.ln(), largest.ln().max(smallest.ln() + 1e-3));
        let mut ends = vec![low, high];
        let seams = description.seams.iter().map(|seam| seam.ln());
        ends.extend(seams.filter(|seam| *seam > low && *seam < high));
        ends.sort_by(f64::total_cmp);
        let builder = Builder {
            model,
            modes: (modes, swirl),
            target: tolerance.max(description.noise),
        };
        let built = (ends.par_windows(2))
            .map(|ends| builder.pieces(ends[0], ends[1], 0))
            .collect::<Result<Vec<_>, _>>()?;
        let (pieces, errors): (Vec<_>, Vec<_>) = built.into_iter().flatten().unzip();
        let evaluations = pieces.iter().map(|piece: &Piece| piece.series.len()).sum();
        Ok(Self {
            like: model.stresses(smallest, modes, swirl)?,
            range: GapRange {
                smallest: low.exp(),
                largest: high.exp(),
            },
            pieces,
            error: errors.into_iter().fold(0.0, f64::max),
            evaluations,
        })
    }

    /// The numbers at a gap.
    ///
    /// # Errors
    /// [`SceneError::GapOutsideRange`] for a gap that is not between those of the table.
    pub fn at(&self, gap: Gap) -> Result<Stresses, SceneError> {
        self.range.check(gap)?;
        let x = gap.ln();
        let piece = (self.pieces.iter().find(|piece| x <= piece.high)).or(self.pieces.last());
        let columns = piece.map(|Piece { low, high, series }| {
            let u = (2.0 * x - low - high) / (high - low);
            interpolant(series, u.clamp(-1.0, 1.0))
        });
        Ok(self.like.with_columns(gap, &columns.unwrap_or_default()))
    }

    /// Estimate of the largest interpolation error, relative to the larger of the number and 1.
    #[must_use]
    pub fn interpolation_error(&self) -> f64 {
        self.error
    }

    /// Gaps that the model was asked at.
    #[must_use]
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }
}

struct Builder<'a> {
    model: &'a dyn Fluid,
    modes: (usize, usize),
    target: f64,
}

impl Builder<'_> {
    /// Pieces from `low` to `high` in `ln eps`, each with its error: one, or those of its halves where it does not converge.
    fn pieces(&self, low: f64, high: f64, halvings: u32) -> Result<Vec<(Piece, f64)>, SceneError> {
        let mut degree = FIRST_DEGREE;
        let mut values = self.values(low, high, points(degree).collect())?;
        loop {
            let series = coefficients(&values);
            let error = tail(&series, &values);
            if error <= self.target || (degree == MAX_DEGREE && halvings == MAX_HALVINGS) {
                return Ok(vec![(Piece { low, high, series }, error)]);
            }
            if degree == MAX_DEGREE {
                let middle = 0.5 * (low + high);
                let (lower, upper) = rayon::join(
                    || self.pieces(low, middle, halvings + 1),
                    || self.pieces(middle, high, halvings + 1),
                );
                let mut pieces = lower?;
                pieces.extend(upper?);
                return Ok(pieces);
            }
            degree *= 2;
            let new = points(degree).skip(1).step_by(2).collect();
            let mut between = self.values(low, high, new)?.into_iter();
            let known = values.into_iter();
            values = known
                .flat_map(|value| [Some(value), between.next()])
                .flatten()
                .collect();
        }
    }

    fn values(&self, low: f64, high: f64, at: Vec<f64>) -> Result<Vec<Vec<f64>>, SceneError> {
        let (modes, swirl) = self.modes;
        // Off the ends, where a seam may belong to the neighbour.
        let margin = 1e-12 * (high - low);
        at.into_par_iter()
            .map(|u| {
                let x = 0.5 * ((high - low) * u + low + high);
                let gap = Gap::from_ln(x.clamp(low + margin, high - margin));
                let stresses = self.model.stresses(gap, modes, swirl)?;
                Ok(stresses.columns().collect())
            })
            .collect()
    }
}
