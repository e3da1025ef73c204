//! Building a table: adaptively, in parallel, to a tolerance or the model's noise.

use std::sync::Arc;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::columns::Group;
use super::parts::{Piece, Stretch};
use super::tally::Tally;
use super::{BuildProgress, FAR_GAP, TableLimit, Tabulated};
use crate::chebyshev::{FIRST_DEGREE, MAX_DEGREE, coefficients, points, tail, variation};
use crate::{Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, SceneError};

/// How to build a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableOptions {
    /// The loads whose balance the motion reads; squirming modes 1 and 2 are always tabulated.
    pub set: LoadSet,
    /// Interpolation error to reach, relative to the larger of the coefficient and 1: an error of velocity.
    pub tolerance: f64,
    /// Smallest gap of the table, below which the model itself is asked; the model's smallest if that
    /// is larger.
    pub smallest_gap: f64,
}

/// Share of the interpolation error that the parts of a piece may add.
const PARTS_ACCURACY: f64 = 1e-2;

/// Halvings of a piece after which its interpolant is taken as it is.
const MAX_HALVINGS: u32 = 12;

/// A gap so large that the two spheres do not feel each other to the last bit.
const INFINITE_GAP: f64 = 1e18;

/// A stretch of a table's coordinate: `ln eps` up to [`FAR_GAP`], `1/r` beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub low: f64,
    pub high: f64,
    pub far: bool,
    /// Distance of the centres at contact.
    pub touching: f64,
}

/// Width of parts that nearly all columns take, in `ln eps` and in `1/r`, and their highest number. Those that would do with wider
/// ones have them too, so that a look-up finds its part once for all columns.
const USUAL_WIDTH: [f64; 2] = [0.16, 0.02];
const MOST_USUAL: f64 = 64.0;

/// `ln eps` from which on stretches are twice as long as the one before: near contact the coefficients are functions of `1/ln eps`.
const LOG_STRETCHES_FROM: f64 = -16.0;

impl Interval {
    /// The least number of parts, as a power of two.
    pub fn least_parts(&self) -> u32 {
        let parts = (self.high - self.low) / USUAL_WIDTH[usize::from(self.far)];
        parts.clamp(1.0, MOST_USUAL).log2().ceil() as u32
    }

    /// The gap at `x`, which is kept off the ends, where a seam may belong to the neighbour.
    fn gap(&self, x: f64) -> Result<Gap, SceneError> {
        let margin = 1e-12 * (self.high - self.low);
        let x = x.clamp(self.low + margin, self.high - margin);
        if self.far {
            Gap::new((1.0 / x - self.touching).min(INFINITE_GAP))
        } else {
            Ok(Gap::from_ln(x))
        }
    }
}

/// The gaps of a table, and the stretches between its ends and the model's seams: near ones by rising gap, then far ones by rising
/// `1/r`.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub range: GapRange,
    /// Gap at which the coordinate changes.
    pub far_gap: f64,
    pub stretches: Vec<Interval>,
}

impl Layout {
    pub fn of(model: &dyn Hydrodynamics, options: &TableOptions) -> Result<Self, SceneError> {
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
            ratio,
            ..
        } = model.description();
        let far_gap = FAR_GAP * ratio.max(1.0);
        let smallest = options.smallest_gap.max(answers.smallest);
        // Spheres that no longer interact have no mobility far apart that anybody reads.
        let beyond_cut = cutoff.filter(|&cut| cut > smallest);
        let range = GapRange {
            smallest,
            largest: beyond_cut.map_or(answers.largest, |cut| (2.0 * cut).max(far_gap)),
        };
        let stretches = stretches(range, seams, (far_gap, ratio))?;
        Ok(Self {
            range,
            far_gap,
            stretches,
        })
    }
}

/// The stretches between the ends of the range and the seams in between.
fn stretches(
    range: GapRange,
    seams: &[f64],
    (far_gap, ratio): (f64, f64),
) -> Result<Vec<Interval>, SceneError> {
    let split = far_gap.ln();
    let largest = Gap::new(range.largest.min(INFINITE_GAP))?;
    let smallest = range.smallest.max(f64::MIN_POSITIVE).ln();
    let mut near = vec![smallest, split];
    let doubled = std::iter::successors(Some(LOG_STRETCHES_FROM), |end| Some(2.0 * end));
    near.extend(doubled.take_while(|end| *end > smallest));
    let farthest = if range.largest.is_finite() {
        1.0 / largest.distance_at_ratio(ratio)
    } else {
        0.0
    };
    let touching = 1.0 + ratio;
    let begins = 1.0 / (touching + far_gap);
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
            far.push(1.0 / seam.distance_at_ratio(ratio));
        }
    }
    let mut all = Vec::new();
    for (mut ends, far) in [(near, false), (far, true)] {
        ends.sort_by(f64::total_cmp);
        all.extend((ends.windows(2)).map(|ends| Interval {
            low: ends[0],
            high: ends[1],
            far,
            touching,
        }));
    }
    Ok(all)
}

/// A group of columns as it is worked out, and kept on disk.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Tabulation {
    /// For each stretch of the layout.
    pub stretches: Vec<Stretch>,
    /// Estimate of the largest interpolation error, relative to the larger of the coefficient and 1.
    pub error: f64,
    /// Number of gaps at which the model was evaluated.
    pub evaluations: usize,
}

/// What the interpolation error of a table is brought down to, if it is.
pub(super) fn limit(options: &TableOptions, noise: f64, error: f64) -> TableLimit {
    if error > noise.max(options.tolerance) {
        TableLimit::Missed(error)
    } else if noise > options.tolerance {
        TableLimit::Noise(noise)
    } else {
        TableLimit::Tolerance(options.tolerance)
    }
}

struct Builder<'a> {
    model: &'a dyn Hydrodynamics,
    /// The tolerance asked for or the model's noise, whichever is larger.
    target: f64,
    tally: &'a Tally<'a>,
}

/// A group of columns on part of a stretch, with its interpolation error and the number of gaps that it took.
struct Built {
    group: Group,
    pieces: Vec<Piece>,
    error: f64,
    evaluations: usize,
}

/// The columns of each group of a batch at one gap.
type Values = Vec<Vec<f64>>;

impl Tabulated {
    /// Tabulates `model`; `progress` is told how far it is.
    ///
    /// # Errors
    /// Those of the model; [`SceneError::NotPositive`] for a tolerance or smallest gap that is not
    /// positive; [`SceneError::TooManyModes`].
    pub fn build(
        model: Arc<dyn Hydrodynamics>,
        options: TableOptions,
        progress: &(dyn Fn(BuildProgress) + Sync),
    ) -> Result<Self, SceneError> {
        let layout = Layout::of(model.as_ref(), &options)?;
        let tally = Tally::new(progress);
        let tabulations = tabulate(
            model.as_ref(),
            &Group::of(options.set, model.has_unlike_radii()),
            &options,
            &layout,
            &tally,
        )?;
        Self::new(model, &options, &layout, tabulations)
    }
}

/// Tabulates `groups` of columns. Those of a batch ask the model at the same gaps, until each is done.
pub(super) fn tabulate(
    model: &dyn Hydrodynamics,
    groups: &[Group],
    options: &TableOptions,
    layout: &Layout,
    tally: &Tally<'_>,
) -> Result<Vec<(Group, Tabulation)>, SceneError> {
    let batches = Group::batches(groups);
    tally.wait_for(batches.len() * layout.stretches.len());
    let builder = Builder {
        model,
        target: model.description().noise.max(options.tolerance),
        tally,
    };
    let tabulated = (batches.par_iter())
        .map(|batch| builder.tabulate(batch, &layout.stretches))
        .collect::<Result<Vec<_>, _>>()?;
    Ok(tabulated.into_iter().flatten().collect())
}

impl Builder<'_> {
    fn tabulate(
        &self,
        batch: &[Group],
        stretches: &[Interval],
    ) -> Result<Vec<(Group, Tabulation)>, SceneError> {
        let built = (stretches.par_iter())
            .map(|stretch| self.built(stretch, (stretch.low, stretch.high), 0, batch))
            .collect::<Result<Vec<_>, SceneError>>()?;
        let tabulation = |&group: &Group| {
            let on_stretches: Vec<&Built> = (built.iter().flatten())
                .filter(|built| built.group == group)
                .collect();
            let stretch = |(built, stretch): (&&Built, &Interval)| {
                let accuracy = PARTS_ACCURACY * self.target;
                Stretch::of_pieces(&built.pieces, accuracy, stretch.least_parts())
            };
            let (stretches, left): (Vec<_>, Vec<_>) =
                (on_stretches.iter().zip(stretches).map(stretch)).unzip();
            let errors = on_stretches.iter().map(|built| built.error).chain(left);
            let tabulation = Tabulation {
                stretches,
                error: errors.fold(0.0, f64::max),
                evaluations: on_stretches.iter().map(|built| built.evaluations).sum(),
            };
            (group, tabulation)
        };
        Ok(batch.iter().map(tabulation).collect())
    }

    /// Each group of the batch from `low` to `high`, on one piece, or on the halves where it does not converge.
    fn built(
        &self,
        stretch: &Interval,
        (low, high): (f64, f64),
        halvings: u32,
        batch: &[Group],
    ) -> Result<Vec<Built>, SceneError> {
        let mut degree = FIRST_DEGREE;
        self.tally.begin();
        let (mut left, mut done) = (batch.to_vec(), Vec::new());
        let mut values = self.values(stretch, (low, high), degree, &left, None)?;
        loop {
            let last = degree == MAX_DEGREE && halvings == MAX_HALVINGS;
            for k in (0..left.len()).rev() {
                let of_group: Vec<Vec<f64>> = values.iter().map(|all| all[k].clone()).collect();
                let series = coefficients(&of_group);
                let error = tail(&series, &of_group);
                let converged = error <= self.target;
                if converged || last {
                    let missed = if converged { 0.0 } else { variation(&of_group) };
                    done.push(Built {
                        group: left.remove(k),
                        pieces: vec![Piece { halvings, series }],
                        error: error.max(missed),
                        evaluations: degree + 1,
                    });
                    for all in &mut values {
                        all.remove(k);
                    }
                }
            }
            if left.is_empty() {
                self.tally.finish(degree);
                return Ok(done);
            }
            if degree == MAX_DEGREE {
                self.tally.halve();
                let middle = 0.5 * (low + high);
                let (lower, upper) = rayon::join(
                    || self.built(stretch, (low, middle), halvings + 1, &left),
                    || self.built(stretch, (middle, high), halvings + 1, &left),
                );
                let mut upper = upper?;
                for mut built in lower? {
                    // Both halves have the same groups.
                    let Some(k) = upper.iter().position(|other| other.group == built.group) else {
                        continue;
                    };
                    let other = upper.swap_remove(k);
                    built.pieces.extend(other.pieces);
                    built.error = built.error.max(other.error);
                    built.evaluations += other.evaluations + degree + 1;
                    done.push(built);
                }
                return Ok(done);
            }
            self.tally.try_beyond(degree);
            degree *= 2;
            values = self.values(stretch, (low, high), degree, &left, Some(values))?;
        }
    }

    /// The columns at the Chebyshev points from `low` to `high`; every other one is already known from
    /// half the degree.
    fn values(
        &self,
        stretch: &Interval,
        (low, high): (f64, f64),
        degree: usize,
        batch: &[Group],
        known: Option<Vec<Values>>,
    ) -> Result<Vec<Values>, SceneError> {
        let gap = |u: f64| stretch.gap(0.5 * (low + high) + 0.5 * (high - low) * u);
        // From half the degree every other point is known.
        let every = if known.is_some() { 2 } else { 1 };
        let new = points(degree).skip(every - 1).step_by(every).map(gap);
        let new = new.collect::<Result<Vec<_>, _>>()?;
        self.model.foresee(&new)?;
        let value = |&gap: &Gap| {
            let values = Group::values(batch, self.model, gap, stretch.far)?;
            self.tally.one_done();
            Ok(values)
        };
        let mut new = (new.par_iter().map(value))
            .collect::<Result<Vec<_>, SceneError>>()?
            .into_iter();
        let Some(known) = known else {
            return Ok(new.collect());
        };
        let mut values = Vec::with_capacity(degree + 1);
        for known in known {
            values.push(known);
            values.extend(new.next());
        }
        Ok(values)
    }
}
