//! Building a table: adaptively, in parallel, to a tolerance or the model's noise.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::chebyshev::{FIRST_DEGREE, MAX_DEGREE, coefficients, points, tail, variation};
use super::parts::Parts;
use super::tally::{ESTIMATES, Tally};
use super::{BuildProgress, FAR_GAP, Piece, Table, TableLimit, TableSummary, Tabulated};
use crate::{Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, SceneError, singular};

/// How to build a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableOptions {
    /// Loads to tabulate.
    pub set: LoadSet,
    /// Interpolation error to reach, relative to the larger of the load and 1.
    pub tolerance: f64,
    /// Smallest gap of the table, below which the model itself is asked; the model's smallest if that
    /// is larger.
    pub smallest_gap: f64,
}

/// Share of the interpolation error that the parts of a piece may add.
const PARTS_ACCURACY: f64 = 1e-3;

/// Halvings of a piece after which its interpolant is taken as it is.
const MAX_HALVINGS: usize = 12;

/// A gap so large that the two spheres do not feel each other to the last bit.
const INFINITE_GAP: f64 = 1e18;

/// The coordinate of a region of the table.
#[derive(Clone, Copy)]
enum Coordinate {
    LogGap,
    InverseDistance,
}

impl Coordinate {
    fn gap(self, x: f64) -> Result<Gap, SceneError> {
        match self {
            Self::LogGap => Ok(Gap::from_ln(x)),
            Self::InverseDistance => Gap::new((1.0 / x - 2.0).min(INFINITE_GAP)),
        }
    }
}

struct Builder<'a> {
    model: &'a dyn Hydrodynamics,
    options: TableOptions,
    /// The tolerance asked for or the model's noise, whichever is larger.
    target: f64,
    evaluations: AtomicUsize,
    tally: Tally<'a>,
}

impl Tabulated {
    /// Tabulates `model`; `progress` is told how far it is.
    ///
    /// # Errors
    /// Those of the model; [`SceneError::NotPositive`] for a tolerance or smallest gap that is not
    /// positive; [`SceneError::TooManyModes`].
    pub fn build(
        model: impl Hydrodynamics + 'static,
        options: TableOptions,
        progress: &(dyn Fn(BuildProgress) + Sync),
    ) -> Result<Self, SceneError> {
        Self::of(Arc::new(model), options, progress)
    }

    fn of(
        model: Arc<dyn Hydrodynamics>,
        options: TableOptions,
        progress: &(dyn Fn(BuildProgress) + Sync),
    ) -> Result<Self, SceneError> {
        for (what, value) in [
            ("table tolerance", options.tolerance),
            ("smallest gap", options.smallest_gap),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SceneError::NotPositive { what, value });
            }
        }
        options.set.check()?;
        let ModelDescription {
            range: answers,
            cutoff,
            seams,
            noise,
        } = model.description();
        let smallest = options.smallest_gap.max(answers.smallest);
        // Spheres that no longer interact have no loads far apart that anybody reads.
        let beyond_cut = cutoff.filter(|&cut| cut > smallest);
        let range = GapRange {
            smallest,
            largest: beyond_cut.map_or(answers.largest, |cut| (2.0 * cut).max(FAR_GAP)),
        };
        let target = noise.max(options.tolerance);
        let builder = Builder {
            model: model.as_ref(),
            options,
            target,
            evaluations: AtomicUsize::new(0),
            tally: Tally::new(progress),
        };
        let (near, far) = regions(range, seams)?;
        (builder.tally).wait_for(
            [&near, &far]
                .map(|ends| ends.len().saturating_sub(1))
                .iter()
                .sum(),
        );
        let (near, near_error) = builder.region(Coordinate::LogGap, &near)?;
        let (far, far_error) = builder.region(Coordinate::InverseDistance, &far)?;
        let evaluations = builder.evaluations.into_inner();
        let interpolation_error = near_error.max(far_error);
        let limit = if interpolation_error > target {
            TableLimit::Missed(interpolation_error)
        } else if noise > options.tolerance {
            TableLimit::Noise(noise)
        } else {
            TableLimit::Tolerance(options.tolerance)
        };
        let table = Table {
            set: options.set,
            range,
            near,
            far,
            summary: TableSummary {
                limit,
                interpolation_error,
                evaluations,
            },
        };
        Ok(Self { model, table })
    }
}

impl Builder<'_> {
    /// The pieces between consecutive `ends`, and their largest interpolation error.
    fn region(
        &self,
        coordinate: Coordinate,
        ends: &[f64],
    ) -> Result<(Vec<Piece>, f64), SceneError> {
        let pieces: Vec<_> = ends
            .par_windows(2)
            .map(|ends| self.pieces(coordinate, ends[0], ends[1], 0))
            .collect::<Result<Vec<_>, _>>()?
            .concat();
        let error = pieces.iter().map(|(_, e)| *e).fold(0.0, f64::max);
        Ok((pieces.into_iter().map(|(piece, _)| piece).collect(), error))
    }

    /// One piece from `low` to `high`, or its halves if it does not converge.
    fn pieces(
        &self,
        coordinate: Coordinate,
        low: f64,
        high: f64,
        halvings: usize,
    ) -> Result<Vec<(Piece, f64)>, SceneError> {
        let mut degree = FIRST_DEGREE;
        self.tally.begin();
        let mut values = self.values(coordinate, low, high, degree, None)?;
        loop {
            let rows = coefficients(&values);
            let read = self.options.set.read_columns();
            let error = tail(&rows, &values, &read);
            let done = error <= self.target;
            if done || (degree == MAX_DEGREE && halvings == MAX_HALVINGS) {
                let error = if done {
                    error
                } else {
                    error.max(variation(&values, &read))
                };
                self.tally.settle(degree);
                let of_model = self.model_error(coordinate, low, high)?;
                let of_pair = self.options.set.column_count();
                let (pair, swirl): (Vec<_>, Vec<_>) = (rows.iter())
                    .map(|row| row.split_at(of_pair))
                    .map(|(pair, swirl)| (pair.to_vec(), swirl.to_vec()))
                    .unzip();
                let accuracy = PARTS_ACCURACY * self.target;
                let piece = Piece {
                    low,
                    high,
                    pair: Parts::of_series(&pair, accuracy, &read),
                    swirl: Parts::of_series(&swirl, accuracy, &[]),
                    error: of_model,
                };
                self.tally.finish(degree);
                return Ok(vec![(piece, error)]);
            }
            if degree == MAX_DEGREE {
                self.tally.halve();
                let middle = 0.5 * (low + high);
                let (left, right) = rayon::join(
                    || self.pieces(coordinate, low, middle, halvings + 1),
                    || self.pieces(coordinate, middle, high, halvings + 1),
                );
                let mut pieces = left?;
                pieces.extend(right?);
                return Ok(pieces);
            }
            self.tally.try_beyond(degree);
            degree *= 2;
            values = self.values(coordinate, low, high, degree, Some(values))?;
        }
    }

    /// The largest of the model's error estimates at the ends of a piece and in its middle.
    fn model_error(
        &self,
        coordinate: Coordinate,
        low: f64,
        high: f64,
    ) -> Result<Option<f64>, SceneError> {
        let mut largest: Option<f64> = None;
        let places: [f64; ESTIMATES] = [low, 0.5 * (low + high), high];
        for x in places {
            let gap = coordinate.gap(inside(x, low, high))?;
            let estimate = self.model.error_estimate(gap, self.options.set)?;
            self.tally.one_done();
            largest = match (largest, estimate) {
                (Some(a), Some(b)) => Some(a.max(b)),
                (a, b) => a.or(b),
            };
        }
        Ok(largest)
    }

    /// Smooth part of the loads at the Chebyshev points; every other one is already known from
    /// half the degree.
    fn values(
        &self,
        coordinate: Coordinate,
        low: f64,
        high: f64,
        degree: usize,
        known: Option<Vec<Vec<f64>>>,
    ) -> Result<Vec<Vec<f64>>, SceneError> {
        let points: Vec<_> = points(degree).collect();
        points
            .par_iter()
            .enumerate()
            .map(|(k, &u)| match &known {
                Some(known) if k % 2 == 0 => Ok(known[k / 2].clone()),
                _ => {
                    let x = 0.5 * (low + high) + 0.5 * (high - low) * u;
                    self.smooth_part(coordinate, inside(x, low, high))
                }
            })
            .collect()
    }

    fn smooth_part(&self, coordinate: Coordinate, x: f64) -> Result<Vec<f64>, SceneError> {
        let gap = coordinate.gap(x)?;
        let set = self.options.set;
        let mut columns: Vec<f64> = if set.swirl == 0 {
            self.model.interacting_loads(gap, set)?.columns().collect()
        } else {
            let (pair, swirl) = self.model.interacting_loads_with_swirl(gap, set)?;
            pair.columns().chain(swirl.columns()).collect()
        };
        if let Coordinate::LogGap = coordinate {
            let pair = singular::loads(gap, set, singular::AXIAL_SQUIRMING);
            let swirl = singular::swirl(gap, set);
            for (column, s) in (columns.iter_mut()).zip(pair.columns().chain(swirl.columns())) {
                *column -= s;
            }
        }
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        self.tally.one_done();
        Ok(columns)
    }
}

/// Ends of the pieces of both regions: ends of the range, and the seams in between.
fn regions(range: GapRange, seams: &[f64]) -> Result<(Vec<f64>, Vec<f64>), SceneError> {
    let split = FAR_GAP.ln();
    let largest = Gap::new(range.largest.min(INFINITE_GAP))?;
    let mut near = vec![range.smallest.ln(), split];
    let farthest = if range.largest.is_finite() {
        1.0 / largest.distance()
    } else {
        0.0
    };
    let begins = 1.0 / (2.0 + FAR_GAP);
    let mut far = if farthest < begins {
        vec![farthest, begins]
    } else {
        Vec::new()
    };
    for &seam in seams {
        let seam = Gap::new(seam)?;
        if seam.ln() > near[0] && seam.ln() < split {
            near.push(seam.ln());
        } else if seam.ln() > split && seam.eps() < largest.eps() {
            far.push(1.0 / seam.distance());
        }
    }
    near.sort_by(f64::total_cmp);
    far.sort_by(f64::total_cmp);
    Ok((near, far))
}

/// `x`, kept off the ends of a piece, where a seam may belong to the neighbour.
fn inside(x: f64, low: f64, high: f64) -> f64 {
    let margin = 1e-12 * (high - low);
    x.clamp(low + margin, high - margin)
}
