//! Any hydrodynamic model as a table: full hydrodynamics at lubrication's price.
//!
//! Up to the gap [`FAR_GAP`] the table interpolates in `ln eps` what is left of the loads when the
//! parts that diverge at contact ([`singular`]) are subtracted; beyond, in `1/r`, out to infinity.
//! Pieces end at the model's seams. Chebyshev points are doubled, and pieces halved, until the
//! last coefficients are below the tolerance or the model's own noise; what is evaluated are polynomials
//! of low degree on equal parts of a piece (`parts`). Outside its gaps a
//! table asks the model, which may have a closed form there, or refuse. Of a model with a cut the table
//! holds the loads of spheres that interact, to the cut and some way beyond, so that nothing jumps; beyond the cut the
//! spheres are alone, as by the model.

mod build;
mod cache;
mod chebyshev;
mod parts;
mod tally;

pub use build::TableOptions;
pub use tally::BuildProgress;

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use self::parts::Parts;
use crate::loads::{MAX_MODES, PairLoads};
use crate::singular::Singular;
use crate::swirl::swirl_column_count;
use crate::{
    Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, SceneError, SwirlLoads, singular,
};

/// Gap at which the table changes from `ln eps` to `1/r`, in radii.
pub const FAR_GAP: f64 = 2.0;

/// What a table's interpolation error was brought down to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum TableLimit {
    /// The tolerance that was asked for.
    Tolerance(f64),
    /// The noise of the model, which is above the tolerance that was asked for.
    Noise(f64),
    /// Neither: pieces were halved as often as is allowed, and this error is left. The model is not smooth there.
    Missed(f64),
}

/// How a table was built.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TableSummary {
    /// What the interpolation error was brought down to.
    pub limit: TableLimit,
    /// Estimate of the largest interpolation error, relative to the larger of the load and 1.
    pub interpolation_error: f64,
    /// Number of gaps at which the model was evaluated.
    pub evaluations: usize,
}

/// An interval of the table's coordinate with its interpolant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Piece {
    low: f64,
    high: f64,
    /// The columns of [`PairLoads::columns`].
    pair: Parts,
    /// The columns of [`SwirlLoads::columns`].
    swirl: Parts,
    /// The largest of the model's error estimates in this piece, if it has any.
    error: Option<f64>,
}

impl Piece {
    /// Where `x` lies in the piece, as a number in [0, 1].
    #[inline]
    fn relative(&self, x: f64) -> f64 {
        (x - self.low) / (self.high - self.low)
    }
}

/// A model tabulated over its whole range.
#[derive(Clone)]
pub struct Tabulated {
    model: Arc<dyn Hydrodynamics>,
    table: Table,
}

impl fmt::Debug for Tabulated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (f.debug_struct("Tabulated"))
            .field("model", &self.model.fingerprint())
            .field("table", &self.table)
            .finish()
    }
}

/// What is worked out for a table, and kept on disk.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Table {
    set: LoadSet,
    range: GapRange,
    /// In `ln eps`, ascending.
    near: Vec<Piece>,
    /// In `1/r`, ascending.
    far: Vec<Piece>,
    summary: TableSummary,
}

impl Tabulated {
    /// The model behind the table.
    pub fn model(&self) -> &dyn Hydrodynamics {
        self.model.as_ref()
    }

    /// The loads that it has columns for.
    pub fn set(&self) -> LoadSet {
        self.table.set
    }

    /// How the table was built.
    pub fn summary(&self) -> TableSummary {
        self.table.summary
    }
}

impl Table {
    /// Whether `gap` lies outside the table, so that the model has to answer or refuse.
    #[inline]
    fn is_outside(&self, gap: Gap) -> bool {
        self.range.check(gap).is_err()
    }

    /// The piece that `gap` lies in, and its coordinate there.
    #[inline]
    fn piece(&self, gap: Gap) -> Result<(&Piece, f64), SceneError> {
        let (pieces, x) = if gap.eps() <= FAR_GAP {
            (&self.near, gap.ln())
        } else {
            (&self.far, 1.0 / gap.distance())
        };
        let index = pieces.partition_point(|piece| piece.high < x);
        pieces
            .get(index)
            .or(pieces.last())
            .map(|piece| (piece, x))
            .ok_or(SceneError::InvalidGap { eps: gap.eps() })
    }

    /// The loads of `set` from a table whose columns are laid out as those of `layout`, of which the
    /// first `N` are read.
    #[inline]
    fn loads<const N: usize>(
        &self,
        gap: Gap,
        set: LoadSet,
        layout: LoadSet,
    ) -> Result<PairLoads, SceneError> {
        let (piece, x) = self.piece(gap)?;
        let singular = if gap.eps() <= FAR_GAP {
            Singular::at(gap, singular::AXIAL_SQUIRMING).columns(layout)
        } else {
            [0.0; N]
        };
        let columns = piece.pair.add_to(piece.relative(x), singular);
        Ok(PairLoads::from_columns(set, layout, &columns))
    }

    /// The loads by swirl, from the first `N` columns.
    #[inline]
    fn swirl<const N: usize>(&self, gap: Gap, set: LoadSet) -> Result<SwirlLoads, SceneError> {
        let (piece, x) = self.piece(gap)?;
        let mut columns = [0.0; N];
        if gap.eps() <= FAR_GAP {
            let singular = singular::swirl(gap, set);
            for (column, s) in columns.iter_mut().zip(singular.columns()) {
                *column = s;
            }
        }
        let columns = piece.swirl.add_to(piece.relative(x), columns);
        Ok(SwirlLoads::from_columns(set, &columns))
    }

    /// The same, with the numbers of columns of 0, 1, 2 and all modes.
    #[inline]
    fn by_modes<const ZERO: usize, const ONE: usize, const TWO: usize, const ALL: usize>(
        &self,
        gap: Gap,
        set: LoadSet,
        layout: LoadSet,
    ) -> Result<PairLoads, SceneError> {
        match set.modes {
            0 => self.loads::<ZERO>(gap, set, layout),
            1 => self.loads::<ONE>(gap, set, layout),
            2 => self.loads::<TWO>(gap, set, layout),
            // All at once would not fit into registers, but nor is this what encounters ask for.
            _ => self.loads::<ALL>(gap, set, layout),
        }
    }
}

/// [`Table::by_modes`] for one layout, known to the compiler.
#[rustfmt::skip]
macro_rules! with_layout {
    ($table:expr, $gap:expr, $set:expr, $of:path) => {
        $table.by_modes::<
            { $of(0).column_count() },
            { $of(1).column_count() },
            { $of(2).column_count() },
            { $of(MAX_MODES).column_count() },
        >($gap, $set, $of(MAX_MODES))
    };
}

impl Hydrodynamics for Tabulated {
    /// The model's, but for the noise, which is the interpolation error.
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            noise: self.table.summary.interpolation_error,
            ..self.model.description()
        }
    }

    fn fingerprint(&self) -> String {
        format!("table of {}", self.model.fingerprint())
    }

    #[inline]
    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        let table = &self.table;
        if !table.set.holds(set) {
            return Err(SceneError::LoadsNotHeld {
                asked: set,
                held: table.set,
            });
        }
        if table.is_outside(gap) {
            return self.model.interacting_loads(gap, set);
        }
        match (table.set.transverse, table.set.twist) {
            (true, true) => with_layout!(table, gap, set, LoadSet::all),
            (true, false) => with_layout!(table, gap, set, LoadSet::planar),
            (false, true) => with_layout!(table, gap, set, LoadSet::axial_and_twist),
            (false, false) => with_layout!(table, gap, set, LoadSet::axial),
        }
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let table = &self.table;
        let loads = self.interacting_loads(gap, set)?;
        if table.is_outside(gap) {
            return self.model.interacting_loads_with_swirl(gap, set);
        }
        let swirl = match set.swirl {
            0 => SwirlLoads::zero(set),
            1 | 2 => table.swirl::<{ swirl_column_count(2) }>(gap, set)?,
            _ => table.swirl::<{ swirl_column_count(MAX_MODES) }>(gap, set)?,
        };
        Ok((loads, swirl))
    }

    /// The model's own, the largest of those in the same piece, and the interpolation's.
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        if self.table.is_outside(gap) {
            return self.model.error_estimate(gap, set);
        }
        let (piece, _) = self.table.piece(gap)?;
        let interpolation = self.table.summary.interpolation_error;
        Ok(piece.error.map(|error| error + interpolation))
    }
}

#[cfg(test)]
mod kept_tests;
#[cfg(test)]
mod tests;
