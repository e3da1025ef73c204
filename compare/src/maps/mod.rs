//! Maps over the plane of initial directions: outcomes, their shares, and where lubrication theory can be trusted.

mod bound;
mod fates;
mod grid;
mod scatter;
mod trust;

use std::io::Write;

use scene::RunOptions;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::output::{OutputFolder, csv_header};
use crate::sweep::{self, Computed, Kept, Sweep, SweepOptions};
use crate::watch::notice;
use crate::{CompareError, Model};

pub use bound::{BoundExample, BoundRow, bound_examples, bound_rows};
pub use fates::Share;
pub use fates::{FateRow, fates_of};
pub use grid::{Grid, Pair, unsymmetric_starts};
pub use scatter::{ScatterRow, scatter_row};
pub use trust::{CLASSES as TRUST_CLASSES, same_map};
pub use trust::{TrustRow, TrustShares, trust_rows, trust_shares};

/// A function that is called with the model, the pair and the rows of each map.
pub type SeeMap<'s, R, E> = dyn FnMut(&Model, Pair, Vec<R>) -> Result<(), E> + 's;

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
    fn each(&self) -> impl Iterator<Item = (&Model, Pair)> {
        (self.models.iter()).flat_map(|model| self.pairs.iter().map(move |&pair| (*model, pair)))
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
        let left = kept.left();
        if left > 0 {
            self.out.account().skipped(left);
            notice!(
                "skipped: the time limit was reached before {left} of {} lines of constant Sigma; the same command \
                 continues from {}.csv.part",
                kept.pieces(),
                self.name
            );
            return Ok(None);
        }
        Ok(Some(kept))
    }

    /// The range of lines of the map with number `map`.
    fn lines_of_map(&self, map: usize) -> std::ops::Range<usize> {
        let lines = self.grid.points();
        map * lines..(map + 1) * lines
    }

    /// Passes the rows of each map to `see`, one map at a time. Writes them to the file of the maps if `to_file`.
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
            // The caller deletes the kept lines after it has written its own file.
            return maps(None);
        }
        let name = format!("{}.csv", self.name);
        self.out.write_by(&name, |file| maps(Some(file)))?;
        Ok(kept.close()?)
    }

    /// Writes the lines of a map. The first map also gets the header.
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
