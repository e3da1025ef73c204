//! What an offset out of the plane becomes, over the plane of initial directions: where motion in a plane is a fiction.

use nalgebra::{DMatrix, SVector, Vector3};
use scene::{
    Outcome, Perturbation, Plan, RunOptions, Scene, TangentRun, run_plan, run_with_tangents,
};
use serde::{Deserialize, Serialize};

use super::grid::Pair;
use super::{EachMap, Maps};
use crate::columns::columns;
use crate::no_run::FAILED;
use crate::output::csv_lines;
use crate::sweep::Row;
use crate::{CompareError, Method, Model};

columns! {
    /// A row for each method, squirmer parameter and point of the grid of initial angles: the derivatives of the motion by its start, where the pair moves
    /// in a plane. The offset out of the plane is `dz` if squirmer 1 starts at `z = dz/2` and squirmer 2 at `z = -dz/2`. NaN stands for a number that does
    /// not exist, for the reason in `status`.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct GrowthRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Difference of the initial angles from the x axis divided by pi, `(phi2 - phi1)/pi`.
        #[unit = "-"]
        pub delta: f64,
        /// Sum of the initial angles from the x axis divided by pi, `(phi2 + phi1)/pi`.
        #[unit = "-"]
        pub sigma: f64,
        /// Outcome of the run, which is one in three dimensions.
        #[unit = "-"]
        pub outcome: String,
        /// Angle by which the outgoing orientation of squirmer 1 turns out of the plane, towards +z, per offset out of the plane. For a pair that does not
        /// part it is that at the end of the run (t = 200).
        #[unit = "rad/a"]
        pub tilt1_per_dz: f64,
        /// The same of squirmer 2.
        #[unit = "rad/a"]
        pub tilt2_per_dz: f64,
        /// The larger of the two in size.
        #[unit = "rad/a"]
        pub growth: f64,
        /// Largest finite-time exponent of a pair that does not part: the logarithm of the largest singular value of the derivative of the end of the run by its
        /// start, over the time between. Starts and ends are the separation of the centres, in radii, and both orientations, in radians, in and out of
        /// the plane. NaN for a pair that parts.
        #[unit = "V_s/a"]
        pub exponent: f64,
        /// By how much the tilts still changed at last when the pair was followed to twice the distance, relative to the larger of the tilt and 1.
        #[unit = "-"]
        pub truncation: f64,
        /// `known`; or the reason why there is no growth: `grazing` (the pair touches the gap where the model is cut off without crossing it, so that no derivative
        /// exists), `no limit` (its orientations turn for ever), `no end` (contact, or a gap too small for the model), `failed`.
        #[unit = "-"]
        pub status: String,
    }
}

/// Why the growth of a row is known, or not.
pub const KNOWN: &str = "known";
const GRAZING: &str = "grazing";
const NO_LIMIT: &str = "no limit";
const NO_END: &str = "no end";

/// Squirmer 1 raised by half of an offset out of the plane, squirmer 2 lowered by the other half.
#[must_use]
pub fn raised() -> Perturbation {
    apart(-Vector3::z())
}

/// A longer separation of the centres, about the same midpoint.
pub(crate) fn apart(separation: Vector3<f64>) -> Perturbation {
    Perturbation {
        positions: [separation * -0.5, separation * 0.5],
        ..Perturbation::NONE
    }
}

/// Numbers of a start, or end: the separation and both orientations.
const RELATIVE: usize = 7;

/// The offset out of the plane and, after it, what else a start has besides: the separation in the plane, and each orientation in and out of the plane.
fn starts(scene: &Scene) -> Result<[Perturbation; RELATIVE], CompareError> {
    let [one, two] = [0, 1].map(|k| scene.start[k].orientation.vector());
    let turned = |k: usize, across: Vector3<f64>| {
        let mut orientations = [Vector3::zeros(); 2];
        orientations[k] = across;
        Perturbation {
            orientations,
            ..Perturbation::NONE
        }
    };
    let (z, one, two) = (Vector3::z(), one?, two?);
    Ok([
        raised(),
        apart(Vector3::x()),
        apart(Vector3::y()),
        turned(0, z),
        turned(1, z),
        turned(0, z.cross(&one)),
        turned(1, z.cross(&two)),
    ])
}

/// The largest finite-time exponent, in `V_s/a`; NaN if the derivatives are not finite.
fn exponent(tangents: &TangentRun) -> f64 {
    let columns: Vec<SVector<f64, 9>> = (tangents.end.iter())
        .map(|of| {
            let [x1, x2] = of.positions;
            let [p1, p2] = of.orientations;
            SVector::from_iterator([x2 - x1, p1, p2].iter().flatten().copied())
        })
        .collect();
    let largest = columns.iter().map(SVector::amax).fold(0.0, f64::max);
    if !columns.iter().all(|column| column.amax().is_finite()) || largest == 0.0 {
        return f64::NAN;
    }
    // Squares of the largest may be too large for a number.
    let matrix = DMatrix::from_fn(9, columns.len(), |i, j| columns[j][i] / largest);
    let stretched = matrix.singular_values().max();
    (largest.ln() + stretched.ln()) / tangents.run.end_time
}

/// Whether pairs with an outcome stay together until the end of the run.
fn stays(outcome: Outcome) -> bool {
    !matches!(
        outcome,
        Outcome::Scattered | Outcome::Contact | Outcome::Unresolved
    )
}

/// Runs the pair from one point of the plane, with what becomes of an offset out of the plane.
#[must_use]
pub fn growth_row(
    model: &Model,
    pair: Pair,
    (delta, sigma): (f64, f64),
    options: &RunOptions,
) -> GrowthRow {
    let mut row = GrowthRow {
        method: model.method(),
        beta: pair.beta,
        delta,
        sigma,
        outcome: FAILED.to_owned(),
        tilt1_per_dz: f64::NAN,
        tilt2_per_dz: f64::NAN,
        growth: f64::NAN,
        exponent: f64::NAN,
        truncation: f64::NAN,
        status: FAILED.to_owned(),
    };
    let Ok(tangents) = tangents(model, pair, (delta, sigma), options) else {
        return row;
    };
    let outcome = tangents.run.outcome;
    row.outcome = outcome.to_string();
    if stays(outcome) {
        row.exponent = exponent(&tangents);
    }
    // No negative zeros.
    let tilts = tangents.outgoing[0].map(|turned| turned.z + 0.0);
    row.truncation = tangents.truncation;
    let status = if !tangents.run.has_outgoing_angles() {
        NO_END
    } else if !tilts.iter().all(|tilt| tilt.is_finite()) {
        GRAZING
    } else if !tangents.truncation.is_finite() {
        NO_LIMIT
    } else {
        [row.tilt1_per_dz, row.tilt2_per_dz] = tilts;
        row.growth = tilts[0].abs().max(tilts[1].abs());
        KNOWN
    };
    status.clone_into(&mut row.status);
    row
}

/// The run with its derivative by the offset out of the plane; if the pair does not part, with all others too.
fn tangents(
    model: &Model,
    pair: Pair,
    (delta, sigma): (f64, f64),
    options: &RunOptions,
) -> Result<TangentRun, CompareError> {
    let scene = pair.scene(delta, sigma)?;
    let plan = Plan::new(&scene)?.in_three_dimensions();
    let directions = if stays(run_plan(&plan, &**model, options)?.outcome) {
        starts(&scene)?.to_vec()
    } else {
        vec![raised()]
    };
    Ok(run_with_tangents(&scene, &**model, options, &directions)?)
}

impl Row for GrowthRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
    }
}

impl GrowthRow {
    /// Whether the pair parts.
    #[must_use]
    pub fn parts(&self) -> bool {
        self.outcome == Outcome::Scattered.to_string()
    }

    /// Whether the run failed.
    #[must_use]
    pub fn failed(&self) -> bool {
        self.outcome == FAILED
    }

    /// Whether the growth is known.
    #[must_use]
    pub fn is_known(&self) -> bool {
        self.status == KNOWN
    }

    /// Whether motion in the plane is a fiction for pairs that start with this offset out of it, in radii: to first order it turns a squirmer by more
    /// than a radian.
    #[must_use]
    pub fn is_fiction(&self, offset: f64) -> bool {
        self.growth * offset > 1.0
    }
}

columns! {
    /// A row for each method and squirmer parameter: shares of all points of a grid of initial angles, from 0 to 1, and numbers over them.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct GrowthShares {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Offset out of the plane: squirmer 1 starts at `z = dz/2`, squirmer 2 at `z = -dz/2`.
        #[unit = "a"]
        pub offset: f64,
        /// Share of pairs that part.
        #[unit = "-"]
        pub parting: f64,
        /// Share of pairs that part for which motion in the plane is a fiction: the growth is larger than one over the offset.
        #[unit = "-"]
        pub parting_fiction: f64,
        /// Share of pairs that do not part.
        #[unit = "-"]
        pub staying: f64,
        /// Share of pairs that do not part, for which motion in the plane is a fiction at the end of the run (t = 200).
        #[unit = "-"]
        pub staying_fiction: f64,
        /// Share of pairs without a growth, failed runs included.
        #[unit = "-"]
        pub undefined: f64,
        /// Median growth of pairs that part. NaN if none does.
        #[unit = "rad/a"]
        pub median_growth: f64,
        /// Largest growth of pairs that part. NaN if none does.
        #[unit = "rad/a"]
        pub largest_growth: f64,
        /// Largest finite-time exponent of pairs that do not part. NaN if all part.
        #[unit = "V_s/a"]
        pub largest_exponent: f64,
        /// Number of points of the grid.
        #[unit = "-"]
        pub points: usize,
    }
}

impl GrowthShares {
    /// Share of all pairs for which motion in the plane is a fiction.
    #[must_use]
    pub fn fiction(&self) -> f64 {
        self.parting_fiction + self.staying_fiction
    }
}

/// The shares of a finished map.
#[must_use]
pub fn growth_shares(model: &Model, pair: Pair, rows: &[GrowthRow], offset: f64) -> GrowthShares {
    let share = |of: &dyn Fn(&GrowthRow) -> bool| {
        rows.iter().filter(|row| of(row)).count() as f64 / rows.len() as f64
    };
    let fiction = |row: &GrowthRow| row.is_known() && row.is_fiction(offset);
    let mut growths: Vec<f64> = (rows.iter())
        .filter(|row| row.parts() && row.is_known())
        .map(|row| row.growth)
        .collect();
    growths.sort_by(f64::total_cmp);
    let at = |place: usize| growths.get(place).copied().unwrap_or(f64::NAN);
    GrowthShares {
        method: model.method(),
        beta: pair.beta,
        offset,
        parting: share(&GrowthRow::parts),
        parting_fiction: share(&|row| row.parts() && fiction(row)),
        staying: share(&|row| !row.parts() && !row.failed() && row.status != NO_END),
        staying_fiction: share(&|row| !row.parts() && fiction(row)),
        undefined: share(&|row| !row.is_known()),
        median_growth: at(growths.len() / 2),
        largest_growth: at(growths.len().wrapping_sub(1)),
        largest_exponent: (rows.iter().map(|row| row.exponent)).fold(f64::NAN, f64::max),
        points: rows.len(),
    }
}

impl Maps<'_> {
    /// Passes the rows of growth of each map to `each`, one map at a time, with `Delta` varying fastest. Writes all rows to the file of the maps. Returns
    /// whether all are done; if the time limit left something out, the same command continues.
    ///
    /// # Errors
    /// [`CompareError::Write`] if rows cannot be kept; the errors of `each`.
    pub fn growth<E: From<CompareError>>(
        &self,
        each: &mut EachMap<'_, GrowthRow, E>,
    ) -> Result<bool, E> {
        let sweep = self.sweep();
        let lines = self.lines(&sweep, |model, pair, sigma, options| {
            let deltas = self.grid.values().into_iter();
            let rows: Vec<_> = deltas
                .map(|delta| growth_row(model, pair, (delta, sigma), options))
                .collect();
            csv_lines(&rows)
        })?;
        let Some(lines) = lines else {
            return Ok(false);
        };
        self.write(lines, each)?;
        Ok(true)
    }
}

#[cfg(test)]
mod tests;
