//! Maps over the plane of initial directions: outcomes, their shares, where lubrication theory can be trusted, and where the plane can.

mod bound;
mod fates;
mod grid;
mod growth;
mod scatter;
mod trust;

use std::iter::Peekable;

use scene::RunOptions;

use crate::columns::{self, Columns};
use crate::output::OutputFolder;
use crate::sweep::{self, Computed, Done, Kept, Row, Sweep, SweepOptions};
use crate::{CompareError, Model};

pub use bound::{BoundExample, BoundRow, bound_examples, bound_rows};
pub use fates::Share;
pub use fates::{FateRow, fates_of};
pub use grid::{Grid, Pair, unsymmetric_starts};
pub(crate) use growth::apart;
pub use growth::{GrowthRow, GrowthShares, growth_row, growth_shares, raised};
pub use scatter::{ScatterRow, scatter_row};
pub use trust::{CLASSES as TRUST_CLASSES, same_map, trust_class};
pub use trust::{TrustRow, TrustShares, trust_rows, trust_shares};

/// A function that is called with the model, the pair and the rows of each map.
pub type EachMap<'s, R, E> = dyn FnMut(&Model, Pair, Vec<R>) -> Result<(), E> + 's;

/// Maps of every model and pair, in this order. A map is a grid; each of its lines of constant `Sigma` is computed and
/// kept separately. A command that was stopped continues with the missing lines.
pub struct Maps<'a> {
    /// Name of the file of the rows, without its ending.
    pub name: &'static str,
    /// The models.
    pub models: Vec<&'a Model>,
    /// The exact model, if the models are compared with it.
    pub exact: Option<&'a Model>,
    /// The pairs of squirmers.
    pub pairs: Vec<Pair>,
    /// The grid of each map.
    pub grid: Grid,
    /// Options of each run, and the time limit.
    pub options: SweepOptions,
    /// The folder for the rows.
    pub out: &'a OutputFolder,
}

impl Maps<'_> {
    /// Checks, before anything is computed, that no finished lines of other maps would be deleted.
    ///
    /// # Errors
    /// [`CompareError::OtherSweep`] if such lines would be deleted; [`CompareError::Write`].
    pub fn check(&self) -> Result<(), CompareError> {
        self.sweep().check()
    }

    /// Everything that the rows depend on, in one line.
    fn key(&self) -> String {
        let pairs: Vec<_> = (self.pairs.iter())
            .map(|pair| format!("{:?}/{:?}/{:?}", pair.beta, pair.g, pair.dz))
            .collect();
        let (pairs, points) = (pairs.join(", "), self.grid.points());
        let judge = self.exact.map_or("", |_| "compared with the last model; ");
        let rest = format!("{judge}beta/g/dz {pairs}; grid {points}");
        let models = self.models.iter().chain(&self.exact).copied();
        sweep::key(self.name, models, &self.run_options(), &rest)
    }

    fn run_options(&self) -> RunOptions {
        RunOptions {
            sample_interval: None,
            ..self.options.run
        }
    }

    /// The model and the pair of each map, in order.
    fn maps(&self) -> Peekable<impl Iterator<Item = (&Model, Pair)>> {
        (self.models.iter())
            .flat_map(|model| self.pairs.iter().map(move |&pair| (*model, pair)))
            .peekable()
    }

    /// The sweep of all lines of constant `Sigma`; each line is kept separately.
    fn sweep(&self) -> Sweep<'_> {
        Sweep {
            name: self.name,
            units: 0..self.models.len() * self.pairs.len() * self.grid.points(),
            size: 1,
            what: "lines of the map",
            key: self.key(),
            time_limit: self.options.time_limit,
            out: self.out,
        }
    }

    /// Computes the missing lines as CSV text. Returns `None`, and reports it, if the time limit left some out.
    fn lines<'s>(
        &self,
        sweep: &'s Sweep<'s>,
        compute: impl Fn(&Model, Pair, f64, &RunOptions) -> Result<String, CompareError> + Sync,
    ) -> Result<Option<Kept<'s>>, CompareError> {
        let (sigmas, run) = (self.grid.values(), self.run_options());
        let kept = sweep.run(|unit| {
            let (map, line) = (unit / sigmas.len(), unit % sigmas.len());
            let model = self.models[map / self.pairs.len()];
            let pair = self.pairs[map % self.pairs.len()];
            let lines = compute(model, pair, sigmas[line], &run)?;
            Ok(Computed {
                lines,
                failure: None,
            })
        })?;
        Ok(kept.complete())
    }

    /// Writes the file of the maps, and passes the rows of each map to `each`, one map at a time.
    fn write<R: Row + Columns, E: From<CompareError>>(
        &self,
        kept: Kept<'_>,
        each: &mut EachMap<'_, R, E>,
    ) -> Result<(), E> {
        let points = self.grid.points().pow(2);
        let (mut maps, mut rows) = (self.maps(), Vec::new());
        let left_out = |_| Ok(Computed::default());
        kept.write(&columns::header::<R>(), &left_out, &mut |row: R| {
            rows.push(row);
            match maps.next_if(|_| rows.len() == points) {
                Some((model, pair)) => each(model, pair, std::mem::take(&mut rows)),
                None => Ok(()),
            }
        })?;
        Ok(())
    }

    /// Passes the rows of each map to `each`, one map at a time. The kept lines are deleted when the caller has written a
    /// file of its own.
    fn read<R: Row, E: From<CompareError>>(
        &self,
        kept: &Kept<'_>,
        each: &mut EachMap<'_, R, E>,
    ) -> Result<(), E> {
        let lines = self.grid.points();
        let mut done = Done::default();
        for (map, (model, pair)) in self.maps().enumerate() {
            let rows = kept.rows::<R>(map * lines..(map + 1) * lines)?;
            rows.iter().for_each(|row| done.add(row));
            each(model, pair, rows)?;
        }
        self.out.account().failed(done.failed);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
