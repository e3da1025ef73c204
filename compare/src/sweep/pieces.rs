//! Rows in numbered units, computed in parallel and kept on disk as they come.

use std::collections::BTreeMap;
use std::io::Write;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use serde::de::DeserializeOwned;

use super::journal::Journal;
use crate::CompareError;
use crate::encounter::{FAILED, SKIPPED};
use crate::output::{OutputFolder, rows_of};
use crate::watch::notice;

/// Pieces that a large sweep is kept in.
const PIECES: usize = 1000;

/// Reasons of failures that are told.
const REASONS: usize = 20;

/// A row that says what became of a run.
pub trait Row: DeserializeOwned {
    /// Outcome, `failed` or `skipped`.
    fn outcome(&self) -> &str;
}

/// Units of rows. Several units may be kept together, as a piece; the rows of a file are those of its units in order.
pub struct Sweep<'a> {
    /// Name of its file, without the ending.
    pub name: &'a str,
    /// Its units.
    pub units: Range<usize>,
    /// Units that are kept together.
    pub size: usize,
    /// What its pieces are called, in words.
    pub what: &'static str,
    /// All that the rows depend on, in one line.
    pub key: String,
    /// Time after which no further piece is begun.
    pub time_limit: Option<Duration>,
    /// Where rows are kept.
    pub out: &'a OutputFolder,
}

/// The rows of a unit.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Computed {
    /// Rows, as CSV lines without a header.
    pub lines: String,
    /// Why a run of them has no result, in one line.
    pub failure: Option<String>,
}

/// Rows that have been counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Done {
    /// All rows.
    pub rows: usize,
    /// Rows of runs that failed.
    pub failed: usize,
    /// Rows of runs that the time limit left out.
    pub skipped: usize,
}

impl Done {
    /// Counts a row by its outcome.
    pub fn add(&mut self, outcome: &str) {
        self.rows += 1;
        self.failed += usize::from(outcome == FAILED);
        self.skipped += usize::from(outcome == SKIPPED);
    }

    /// Whether every run has been begun.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.skipped == 0
    }
}

impl<'a> Sweep<'a> {
    /// Units that are kept together in a sweep of so many.
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

    /// Makes sure that [`Self::run`] loses no rows of another sweep; nothing is changed or told.
    ///
    /// # Errors
    /// [`CompareError::OtherSweep`] if it would; [`CompareError::Write`].
    pub fn check(&self) -> Result<(), CompareError> {
        Journal::check(self.out, self.name, &self.key)
    }

    /// Computes the units that an earlier command has not, and keeps them.
    ///
    /// # Errors
    /// [`CompareError::OtherSweep`] if rows of another sweep would be lost; [`CompareError::Interrupted`] after an
    /// interrupt; [`CompareError::Write`]; those of `compute`.
    pub fn run(
        &'a self,
        compute: impl Fn(usize) -> Result<Computed, CompareError> + Sync,
    ) -> Result<Kept<'a>, CompareError> {
        let journal = Journal::open(self.out, self.name, &self.key)?;
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
            journal,
            left,
            reasons: reasons.into_values().collect(),
        })
    }
}

/// Units that have been computed, on disk.
pub struct Kept<'a> {
    sweep: &'a Sweep<'a>,
    journal: Journal,
    left: usize,
    reasons: Vec<String>,
}

impl Kept<'_> {
    /// Pieces that the time limit has left out.
    #[must_use]
    pub fn left(&self) -> usize {
        self.left
    }

    /// Pieces in all.
    #[must_use]
    pub fn pieces(&self) -> usize {
        self.sweep.pieces()
    }

    /// The lines of a piece, if it has been computed.
    ///
    /// # Errors
    /// [`CompareError::Write`] if they can't be read back.
    pub fn lines(&self, piece: usize) -> Result<Option<String>, CompareError> {
        self.journal.lines(piece)
    }

    /// The rows of some pieces that have been computed.
    ///
    /// # Errors
    /// [`CompareError::Write`] if they can't be read back; [`CompareError::Rows`] if they are other rows.
    pub fn rows<R: DeserializeOwned>(&self, pieces: Range<usize>) -> Result<Vec<R>, CompareError> {
        let mut rows = Vec::new();
        for piece in pieces {
            if let Some(lines) = self.lines(piece)? {
                rows.extend(rows_of::<R>(&lines)?);
            }
        }
        Ok(rows)
    }

    /// Takes the part file away: what was made of it is there.
    ///
    /// # Errors
    /// [`CompareError::Write`].
    pub fn close(self) -> Result<(), CompareError> {
        self.journal.close()
    }

    /// Writes the file below a line of `header`, and hands each row to `see`, in order; `skipped` makes up the lines of
    /// a unit that the time limit has left out. A file that holds more rows already stays as it is. Tells what failed
    /// or was left out.
    ///
    /// # Errors
    /// [`CompareError::Write`]; [`CompareError::Rows`].
    pub fn write<R: Row>(
        self,
        header: &str,
        skipped: &dyn Fn(usize) -> Result<Computed, CompareError>,
        see: &mut dyn FnMut(R),
    ) -> Result<Done, CompareError> {
        let Sweep { name, out, .. } = *self.sweep;
        let file = format!("{name}.csv");
        let mut done = Done::default();
        let mut left_out = Vec::new();
        let mut fill = |to: &mut dyn Write| -> Result<(), CompareError> {
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
                    done.add(row.outcome());
                    see(row);
                }
            }
            Ok(())
        };
        if self.left > 0 && self.file_holds_more(&file)? {
            fill(&mut std::io::sink())?;
            notice!("'{file}' holds more of a sweep already and stays as it is");
        } else {
            out.write_by(&file, fill)?;
        }
        for reason in left_out.iter().chain(&self.reasons) {
            notice!("{reason}");
        }
        if done.failed > self.reasons.len() {
            notice!("{} of {} rows failed", done.failed, done.rows);
        }
        if done.skipped > 0 {
            notice!(
                "{} of {} rows are left; the same command goes on from {file}.part",
                done.skipped,
                done.rows
            );
        }
        if self.left == 0 {
            self.close()?;
        }
        Ok(done)
    }

    /// Whether the file is there already, and is not an unfinished one with no more finished rows than are kept here.
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
