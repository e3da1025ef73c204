//! Rows in numbered units, computed in parallel and kept on disk as they finish.

use std::collections::BTreeMap;
use std::io::Write;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use serde::de::DeserializeOwned;

use scene::RunOptions;

use super::journal::Journal;
use crate::no_run::{FAILED, SKIPPED};
use crate::output::{OutputFolder, rows_of};
use crate::watch::{Leaving, notice};
use crate::{CompareError, Model};

/// Number of pieces of a large sweep.
const PIECES: usize = 1000;

/// Largest number of reasons of failures that are shown.
const REASONS: usize = 20;

/// A row that is read back from the kept lines.
pub trait Row: DeserializeOwned {
    /// Outcomes of its runs, `failed` or `skipped`.
    fn outcomes(&self) -> impl Iterator<Item = &str>;
}

/// Units of rows. A piece is one unit or several that are kept together. A file holds the rows of all units in order.
pub struct Sweep<'a> {
    /// Name of the file of the rows, without the ending.
    pub name: &'a str,
    /// The numbers of its units.
    pub units: Range<usize>,
    /// Number of units in a piece.
    pub size: usize,
    /// Name of its pieces in messages.
    pub what: &'static str,
    /// Everything that the rows depend on, in one line.
    pub key: String,
    /// Time after which no further piece begins.
    pub time_limit: Option<Duration>,
    /// The folder for the rows.
    pub out: &'a OutputFolder,
}

/// The rows of a unit.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Computed {
    /// Rows, as CSV lines without a header.
    pub lines: String,
    /// The reason why a run of this unit has no result, in one line.
    pub failure: Option<String>,
}

/// Counts of rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Done {
    /// Number of all rows.
    pub rows: usize,
    /// Number of failed runs.
    pub failed: usize,
    /// Number of runs that the time limit left out.
    pub skipped: usize,
}

impl Done {
    /// Counts a row by the outcomes of its runs.
    pub fn add(&mut self, row: &impl Row) {
        self.rows += 1;
        self.failed += row.outcomes().filter(|outcome| *outcome == FAILED).count();
        self.skipped += row.outcomes().filter(|outcome| *outcome == SKIPPED).count();
    }

    /// Whether no run was left out.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.skipped == 0
    }
}

/// Everything that the rows of a file depend on, in one line: the version, the models, the options of each run, and `rest`.
pub(crate) fn key<'m>(
    name: &str,
    models: impl IntoIterator<Item = &'m Model>,
    run: &RunOptions,
    rest: &str,
) -> String {
    let models: Vec<_> = (models.into_iter())
        .map(|model| format!("{} ({})", model.method(), model.fingerprint()))
        .collect();
    let version = env!("CARGO_PKG_VERSION");
    let models = models.join(", ");
    format!("squirmers {version} {name}: {models}; {rest}; {run:?}").replace('\n', " ")
}

impl<'a> Sweep<'a> {
    /// Number of units in a piece, for a sweep of `units` units.
    #[must_use]
    pub fn size_of(units: usize) -> usize {
        (units / PIECES).max(1)
    }

    fn pieces(&self) -> usize {
        self.units.len().div_ceil(self.size)
    }

    /// The units of a piece.
    fn piece(&self, piece: usize) -> Range<usize> {
        let start = self.units.start + piece * self.size;
        start..(start + self.size).min(self.units.end)
    }

    /// Checks that [`Self::run`] would not delete rows of another sweep. Changes nothing and reports nothing.
    ///
    /// # Errors
    /// [`CompareError::OtherSweep`] if it would delete such rows; [`CompareError::Write`].
    pub fn check(&self) -> Result<(), CompareError> {
        Journal::check(self.out, self.name, &self.key)
    }

    /// Computes and keeps all units that no earlier command has computed.
    ///
    /// # Errors
    /// [`CompareError::OtherSweep`] if this would delete rows of another sweep; [`CompareError::Interrupted`] after an
    /// interrupt; [`CompareError::Write`]; the errors of `compute`.
    pub fn run(
        &'a self,
        compute: impl Fn(usize) -> Result<Computed, CompareError> + Sync,
    ) -> Result<Kept<'a>, CompareError> {
        let journal = Journal::open(self.out, self.name, &self.key)?;
        let part = journal.path().display();
        let leaving = Leaving::of(format!(
            "finished {} are in '{part}'; the same command continues",
            self.what
        ));
        let reasons = Mutex::new(BTreeMap::new());
        let left = journal.run(self.pieces(), self.what, self.time_limit, |piece| {
            let mut text = String::new();
            for unit in self.piece(piece) {
                let Computed { lines, failure } = compute(unit)?;
                text.push_str(&lines);
                if let Some(reason) = failure {
                    let mut reasons = reasons.lock().unwrap_or_else(PoisonError::into_inner);
                    reasons.insert(unit, reason);
                    if reasons.len() > REASONS {
                        reasons.pop_last();
                    }
                }
            }
            Ok(text)
        })?;
        let reasons = reasons.into_inner().unwrap_or_else(PoisonError::into_inner);
        Ok(Kept {
            sweep: self,
            _leaving: leaving,
            journal,
            left,
            reasons: reasons.into_values().collect(),
        })
    }
}

/// The computed units, on disk.
pub struct Kept<'a> {
    sweep: &'a Sweep<'a>,
    /// What an interrupt leaves while the final file is written.
    _leaving: Leaving,
    journal: Journal,
    left: usize,
    reasons: Vec<String>,
}

impl Kept<'_> {
    /// Number of all pieces.
    fn pieces(&self) -> usize {
        self.sweep.pieces()
    }

    /// All units; none if the time limit left some out, which is said and counted in the account of the folder.
    #[must_use]
    pub fn complete(self) -> Option<Self> {
        if self.left == 0 {
            return Some(self);
        }
        let Sweep {
            what, name, out, ..
        } = self.sweep;
        out.account().skipped(self.left);
        notice!(
            "skipped: the time limit was reached before {} of {} {what}; the same command continues from {name}.csv.part",
            self.left,
            self.pieces()
        );
        None
    }

    /// The lines of a piece, if it has been computed.
    ///
    /// # Errors
    /// [`CompareError::Write`] if they can't be read back.
    pub fn lines(&self, piece: usize) -> Result<Option<String>, CompareError> {
        self.journal.lines(piece)
    }

    /// The rows of some computed pieces.
    ///
    /// # Errors
    /// [`CompareError::Write`] if they can't be read back; [`CompareError::Rows`] if they are not rows of this type.
    pub fn rows<R: DeserializeOwned>(&self, pieces: Range<usize>) -> Result<Vec<R>, CompareError> {
        let mut rows = Vec::new();
        for piece in pieces {
            if let Some(lines) = self.lines(piece)? {
                rows.extend(rows_of::<R>(&lines)?);
            }
        }
        Ok(rows)
    }

    /// Deletes the part file, because the final file is written.
    ///
    /// # Errors
    /// [`CompareError::Write`].
    pub fn close(self) -> Result<(), CompareError> {
        self.journal.close()
    }

    /// Writes the line `header` and all rows to the file, and passes each row to `each`, in order. The function
    /// `skipped` gives the lines of a unit that the time limit left out. A file that already has more finished rows is
    /// not changed. Reports failed runs and runs that were left out, and counts them in the account of the folder.
    ///
    /// # Errors
    /// [`CompareError::Write`]; [`CompareError::Rows`]; the errors of `each`.
    pub fn write<R: Row, E: From<CompareError>>(
        self,
        header: &str,
        skipped: &dyn Fn(usize) -> Result<Computed, CompareError>,
        each: &mut dyn FnMut(R) -> Result<(), E>,
    ) -> Result<Done, E> {
        let Sweep { name, out, .. } = *self.sweep;
        let file = format!("{name}.csv");
        let mut done = Done::default();
        let mut left_out = Vec::new();
        let mut fill = |to: &mut dyn Write| -> Result<(), E> {
            let failed = |source| out.failed(&file, source);
            writeln!(to, "{header}").map_err(failed)?;
            for piece in 0..self.pieces() {
                let lines = match self.lines(piece)? {
                    Some(lines) => lines,
                    None => {
                        let mut text = String::new();
                        for unit in self.sweep.piece(piece) {
                            let Computed { lines, failure } = skipped(unit)?;
                            text.push_str(&lines);
                            left_out.extend(failure.filter(|_| left_out.len() < REASONS));
                        }
                        text
                    }
                };
                to.write_all(lines.as_bytes()).map_err(failed)?;
                for row in rows_of::<R>(&lines)? {
                    done.add(&row);
                    each(row)?;
                }
            }
            Ok(())
        };
        if self.left > 0 && self.file_holds_more(&file)? {
            fill(&mut std::io::sink())?;
            notice!("'{file}' already has more finished rows and is not changed");
        } else {
            out.write_by(&file, fill)?;
        }
        for reason in left_out.iter().chain(&self.reasons) {
            notice!("{reason}");
        }
        if done.failed > self.reasons.len() {
            notice!("{} runs of {} rows failed", done.failed, done.rows);
        }
        if done.skipped > 0 {
            notice!(
                "{} of {} rows are left; the same command continues from {file}.part",
                done.skipped,
                done.rows
            );
        }
        out.account().failed(done.failed);
        out.account().skipped(done.skipped);
        if self.left == 0 {
            self.close()?;
        }
        Ok(done)
    }

    /// Whether the file exists and is finished, or has more finished rows than are kept here.
    fn file_holds_more(&self, file: &str) -> Result<bool, CompareError> {
        let Ok(mut reader) = csv::Reader::from_path(self.sweep.out.path().join(file)) else {
            return Ok(false);
        };
        let mut finished = 0;
        for piece in 0..self.pieces() {
            finished += self.lines(piece)?.map_or(0, |lines| lines.lines().count());
        }
        let (mut done, mut skipped) = (0, 0);
        for record in reader.records() {
            match record {
                Ok(record) if record.iter().any(|field| field == SKIPPED) => skipped += 1,
                Ok(_) => done += 1,
                Err(_) => {}
            }
        }
        Ok(done > finished || (skipped == 0 && done > 0))
    }
}

#[cfg(test)]
mod tests;
