//! Maps over the plane of initial directions: what becomes of the pair, how often, and where
//! lubrication theory can be trusted.

mod bound;
mod fates;
mod grid;
pub(crate) mod resume;
mod scatter;
mod trust;

use std::io::Write;

use scene::{Hydrodynamics, RunOptions};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::output::{OutputFolder, csv_text, rows_of};
use crate::sweep::SweepOptions;
use crate::watch::notice;
use crate::{CompareError, Model};
use resume::Journal;

pub use bound::{BoundExample, BoundRow, bound_examples, bound_rows};
pub use fates::Share;
pub use fates::{FateRow, fates_of};
pub use grid::{Grid, Pair, unsymmetric_starts};
pub use scatter::{ScatterRow, scatter_row};
pub use trust::{CLASSES as TRUST_CLASSES, same_map};
pub use trust::{TrustRow, TrustShares, trust_rows, trust_shares};

/// What is handed a map's model, pair and rows.
pub type SeeMap<'s, R, E> = dyn FnMut(&Model, Pair, Vec<R>) -> Result<(), E> + 's;

/// Maps of every model and pair, in this order: each a grid of which every line of constant `Sigma` is computed, and
/// kept, by itself. What was stopped goes on with the lines that are missing.
pub struct Maps<'a> {
    /// Name of the file of their rows, without its ending.
    pub name: &'static str,
    /// The models.
    pub models: Vec<&'a Model>,
    /// What they are judged by, if they are.
    pub exact: Option<&'a Model>,
    /// The pairs of squirmers.
    pub pairs: Vec<Pair>,
    /// The points of each map.
    pub grid: Grid,
    /// How each run is made, and for how long.
    pub options: SweepOptions,
    /// Where lines are kept.
    pub out: &'a OutputFolder,
}

impl Maps<'_> {
    /// Makes sure that no finished lines of other maps would be lost, before anything is computed.
    ///
    /// # Errors
    /// [`CompareError::OtherSweep`] if lines would be; [`CompareError::Write`].
    pub fn check(&self) -> Result<(), CompareError> {
        Journal::check(self.out, self.name, &self.key())
    }

    /// All that the rows depend on, in one line.
    fn key(&self) -> String {
        let named = |model: &Model| format!("{} ({})", model.method(), model.fingerprint());
        let models: Vec<_> = self.models.iter().map(|model| named(model)).collect();
        let judge = self.exact.map_or(String::new(), |exact| {
            format!(" judged by {}", named(exact))
        });
        let pairs: Vec<_> = (self.pairs.iter())
            .map(|pair| format!("{:?}/{:?}/{:?}", pair.beta, pair.g, pair.dz))
            .collect();
        format!(
            "squirmers {} {}: {}{judge}; beta/g/dz {}; grid {}; {:?}",
            env!("CARGO_PKG_VERSION"),
            self.name,
            models.join(", "),
            pairs.join(", "),
            self.grid.points(),
            self.run_options(),
        )
        .replace('\n', " ")
    }

    fn run_options(&self) -> RunOptions {
        RunOptions {
            sample_interval: None,
            ..self.options.run
        }
    }

    /// The model and the pair of each map, in order.
    fn each(&self) -> impl Iterator<Item = (&Model, Pair)> {
        (self.models.iter()).flat_map(|model| self.pairs.iter().map(move |&pair| (*model, pair)))
    }

    /// Computes the lines that are missing, each to CSV lines; `None`, and a note on standard error, if the time
    /// limit left some out.
    fn lines(
        &self,
        compute: impl Fn(&Model, Pair, f64, &RunOptions) -> Result<String, CompareError> + Sync,
    ) -> Result<Option<Journal>, CompareError> {
        let sigmas = self.grid.values();
        let chunks = self.models.len() * self.pairs.len() * sigmas.len();
        let (journal, run) = (
            Journal::open(self.out, self.name, &self.key())?,
            self.run_options(),
        );
        let limit = self.options.time_limit;
        let left = journal.run(chunks, "lines of the map", limit, |chunk| {
            let (map, line) = (chunk / sigmas.len(), chunk % sigmas.len());
            let model = self.models[map / self.pairs.len()];
            let pair = self.pairs[map % self.pairs.len()];
            compute(model, pair, sigmas[line], &run)
        })?;
        if left > 0 {
            self.out.account().skipped(left);
            notice!(
                "skipped: the time limit was reached before {left} of {chunks} lines of constant \
                 Sigma; the same command goes on from {}.csv.part",
                self.name
            );
            return Ok(None);
        }
        Ok(Some(journal))
    }

    /// The rows of the map with this number.
    fn rows_of_map<R: DeserializeOwned>(
        &self,
        journal: &Journal,
        map: usize,
    ) -> Result<Vec<R>, CompareError> {
        let lines = self.grid.points();
        let mut rows = Vec::new();
        for chunk in map * lines..(map + 1) * lines {
            if let Some(text) = journal.lines(chunk)? {
                rows.extend(rows_of::<R>(&text)?);
            }
        }
        Ok(rows)
    }

    /// Hands each map's rows to `see`, one map at a time, and writes them to the maps' file if they are to be kept.
    fn hand_over<R: Serialize + DeserializeOwned, E: From<CompareError>>(
        &self,
        journal: Journal,
        kept: bool,
        see: &mut SeeMap<'_, R, E>,
    ) -> Result<(), E> {
        let mut maps = |file: Option<&mut dyn Write>| -> Result<(), E> {
            let mut file = file;
            for (map, (model, pair)) in self.each().enumerate() {
                let rows = self.rows_of_map(&journal, map)?;
                if let Some(file) = &mut file {
                    self.write_map(&journal, map, &rows, file)?;
                }
                see(model, pair, rows)?;
            }
            Ok(())
        };
        if !kept {
            // The lines go when the file that is made of them is there.
            return maps(None);
        }
        let name = format!("{}.csv", self.name);
        self.out.write_by(&name, |file| maps(Some(file)))?;
        Ok(journal.close()?)
    }

    /// Writes a map's lines, below the header if it is the first one.
    fn write_map<R: Serialize>(
        &self,
        journal: &Journal,
        map: usize,
        rows: &[R],
        file: &mut dyn Write,
    ) -> Result<(), CompareError> {
        let name = format!("{}.csv", self.name);
        let mut write = |text: &str| {
            let written = file.write_all(text.as_bytes());
            written.map_err(|source| self.out.failed(&name, source))
        };
        if map == 0 {
            let text = csv_text(rows.get(..1).unwrap_or_default())?;
            write(text.split_inclusive('\n').next().unwrap_or_default())?;
        }
        let lines = self.grid.points();
        for chunk in map * lines..(map + 1) * lines {
            write(&journal.lines(chunk)?.unwrap_or_default())?;
        }
        Ok(())
    }
}
