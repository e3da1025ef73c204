//! Maps over the plane of initial directions: what becomes of the pair, how often, and where
//! lubrication theory can be trusted.

mod bound;
mod fates;
mod grid;
mod scatter;
mod trust;

use std::io::Write;

use scene::{Hydrodynamics, RunOptions};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::output::{OutputFolder, csv_header};
use crate::sweep::{Computed, Kept, Sweep, SweepOptions};
use crate::watch::notice;
use crate::{CompareError, Model};

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
        self.sweep().check()
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

    /// Its lines of constant `Sigma`, each kept by itself.
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

    /// Computes the lines that are missing, each to CSV lines; whether that is all of them. A note tells of those that
    /// the time limit left out.
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
        let left = kept.left();
        if left > 0 {
            self.out.account().skipped(left);
            notice!(
                "skipped: the time limit was reached before {left} of {} lines of constant Sigma; the same command \
                 goes on from {}.csv.part",
                kept.pieces(),
                self.name
            );
            return Ok(None);
        }
        Ok(Some(kept))
    }

    /// The lines of the map with this number.
    fn lines_of_map(&self, map: usize) -> std::ops::Range<usize> {
        let lines = self.grid.points();
        map * lines..(map + 1) * lines
    }

    /// Hands each map's rows to `see`, one map at a time, and writes them to the maps' file if they are to be kept.
    fn hand_over<R: Serialize + DeserializeOwned, E: From<CompareError>>(
        &self,
        kept: Kept<'_>,
        to_file: bool,
        see: &mut SeeMap<'_, R, E>,
    ) -> Result<(), E> {
        let mut maps = |file: Option<&mut dyn Write>| -> Result<(), E> {
            let mut file = file;
            for (map, (model, pair)) in self.each().enumerate() {
                let rows = kept.rows(self.lines_of_map(map))?;
                if let Some(file) = &mut file {
                    self.write_map(&kept, map, &rows, file)?;
                }
                see(model, pair, rows)?;
            }
            Ok(())
        };
        if !to_file {
            // The lines go when the file that is made of them is there.
            return maps(None);
        }
        let name = format!("{}.csv", self.name);
        self.out.write_by(&name, |file| maps(Some(file)))?;
        Ok(kept.close()?)
    }

    /// Writes a map's lines, below the header if it is the first one.
    fn write_map<R: Serialize>(
        &self,
        kept: &Kept<'_>,
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
            write(&(csv_header(rows.get(..1).unwrap_or_default())? + "\n"))?;
        }
        for line in self.lines_of_map(map) {
            write(&kept.lines(line)?.unwrap_or_default())?;
        }
        Ok(())
    }
}
