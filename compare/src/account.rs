//! Counts the runs of a command and those without a result. The exit status follows from these counts.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use scene::Run;

use crate::{CompareError, NoRun};

/// Number of runs, or of lines of a map, and number of those without a result.
#[derive(Debug, Default)]
pub struct Account {
    failed: AtomicUsize,
    skipped: AtomicUsize,
    broken: AtomicUsize,
    bounds: AtomicUsize,
}

impl Account {
    /// Adds runs that failed.
    pub fn failed(&self, runs: usize) {
        self.failed.fetch_add(runs, Relaxed);
    }

    /// Adds runs, or lines of a map, that the time limit left out.
    pub fn skipped(&self, runs: usize) {
        self.skipped.fetch_add(runs, Relaxed);
    }

    /// Adds the runs among these that have no result. Returns whether the time limit left some out.
    pub fn enter<'a>(&self, runs: impl Iterator<Item = &'a Result<Run, NoRun>>) -> bool {
        let (mut failed, mut skipped) = (0, 0);
        for none in runs.filter_map(|run| run.as_ref().err()) {
            match none {
                NoRun::Skipped => skipped += 1,
                NoRun::Failed(_) => failed += 1,
            }
        }
        self.failed(failed);
        self.skipped(skipped);
        skipped > 0
    }

    /// Adds bounds: for each whether it holds. Returns how many are broken.
    pub fn bounds(&self, holds: impl Iterator<Item = bool>) -> usize {
        let (mut bounds, mut broken) = (0, 0);
        for holds in holds {
            bounds += 1;
            broken += usize::from(!holds);
        }
        self.bounds.fetch_add(bounds, Relaxed);
        self.broken.fetch_add(broken, Relaxed);
        broken
    }

    /// Whether the time limit left something out.
    pub fn stopped(&self) -> bool {
        self.skipped.load(Relaxed) > 0
    }

    /// The result of the command, after everything is written.
    ///
    /// # Errors
    /// [`CompareError::Stopped`] if the time limit left something out, else [`CompareError::RunsFailed`] if a run
    /// failed, else [`CompareError::BoundsBroken`] if bounds are broken.
    pub fn verdict(&self) -> Result<(), CompareError> {
        if self.stopped() {
            let skipped = self.skipped.load(Relaxed);
            return Err(CompareError::Stopped { skipped });
        }
        let failed = self.failed.load(Relaxed);
        if failed > 0 {
            return Err(CompareError::RunsFailed { failed });
        }
        match self.broken.load(Relaxed) {
            0 => Ok(()),
            broken => Err(CompareError::BoundsBroken {
                broken,
                bounds: self.bounds.load(Relaxed),
            }),
        }
    }
}
