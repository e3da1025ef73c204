//! Maps over the plane of initial directions: what becomes of the pair, how often, and where
//! lubrication theory can be trusted.

mod bound;
mod fates;
mod grid;
pub(crate) mod resume;
mod scatter;
mod trust;

use std::time::Duration;

use scene::{Hydrodynamics, RunOptions};

use crate::output::OutputFolder;
use crate::streams::complain;
use crate::sweep::SweepOptions;
use crate::{CompareError, Model};
use resume::Journal;

pub use bound::{BoundExample, BoundRow, bound_examples, bound_rows};
pub use fates::{FateRow, fates, fates_of};
pub(crate) use fates::{Share, fates_as};
pub use grid::{Grid, Pair, unsymmetric_starts};
pub use scatter::{ScatterRow, scatter, scatter_row};
pub(crate) use trust::{CLASSES as TRUST_CLASSES, same_map, trust_as};
pub use trust::{TrustRow, TrustShares, trust, trust_rows, trust_shares};

/// A sweep over models, pairs and the lines of a grid, each line a chunk.
struct Sweep<'a> {
    name: &'static str,
    models: &'a [&'a Model],
    pairs: &'a [Pair],
    grid: Grid,
    run: RunOptions,
    time_limit: Option<Duration>,
}

impl<'a> Sweep<'a> {
    fn new(
        name: &'static str,
        models: &'a [&'a Model],
        pairs: &'a [Pair],
        grid: Grid,
        options: &SweepOptions,
    ) -> Self {
        Self {
            name,
            models,
            pairs,
            grid,
            run: RunOptions {
                sample_interval: None,
                ..options.run
            },
            time_limit: options.time_limit,
        }
    }

    /// All that the rows depend on, in one line.
    fn key(&self) -> String {
        let models: Vec<_> = (self.models.iter())
            .map(|model| format!("{} ({})", model.method(), model.fingerprint()))
            .collect();
        let pairs: Vec<_> = (self.pairs.iter())
            .map(|pair| format!("{:?}/{:?}/{:?}", pair.beta, pair.g, pair.dz))
            .collect();
        format!(
            "squirmers {} {}: {}; beta/g/dz {}; grid {}; {:?}",
            env!("CARGO_PKG_VERSION"),
            self.name,
            models.join(", "),
            pairs.join(", "),
            self.grid.points(),
            self.run,
        )
        .replace('\n', " ")
    }

    /// The lines of every chunk, models outermost, then pairs, then `Sigma`; `None`, and a note on
    /// standard error, if the time limit left some out.
    fn run(
        &self,
        out: &OutputFolder,
        compute: impl Fn(&Model, Pair, f64, &RunOptions) -> Result<String, CompareError> + Sync,
    ) -> Result<Option<Vec<String>>, CompareError> {
        let sigmas = self.grid.values();
        let chunks = self.models.len() * self.pairs.len() * sigmas.len();
        let journal = Journal::open(out, self.name, &self.key())?;
        let left = journal.run(chunks, "lines of the map", self.time_limit, |chunk| {
            let (map, line) = (chunk / sigmas.len(), chunk % sigmas.len());
            let model = self.models[map / self.pairs.len()];
            let pair = self.pairs[map % self.pairs.len()];
            compute(model, pair, sigmas[line], &self.run)
        })?;
        if left > 0 {
            out.account().skipped(left);
            complain!(
                "skipped: the time limit was reached before {left} of {chunks} lines of constant \
                 Sigma; the same command goes on from {}.csv.part",
                self.name
            );
            return Ok(None);
        }
        let lines = (0..chunks).filter_map(|chunk| journal.lines(chunk).transpose());
        let lines = lines.collect::<Result<_, _>>()?;
        // The part file goes when the map's own file is there.
        Ok(Some(lines))
    }
}
