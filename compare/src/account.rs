//! Account of the runs of a command: the exit status follows from it.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use scene::Run;

use crate::{CompareError, NoRun};

/// Runs, or lines of a map, and those without a result.
#[derive(Debug, Default)]
pub struct Account {
    failed: AtomicUsize,
    skipped: AtomicUsize,
    broken: AtomicUsize,
    bounds: AtomicUsize,
}

impl Account {
    /// So many runs failed.
    pub fn failed(&self, runs: usize) {
        self.failed.fetch_add(runs, Relaxed);
    }

    /// So many runs, or lines of a map, were left out at the time limit.
    pub fn skipped(&self, runs: usize) {
        self.skipped.fetch_add(runs, Relaxed);
    }

    /// The runs among these that have no result; whether the time limit has left some out.
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

    /// Enters bounds: for each whether it holds. How many of them are broken.
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

    /// Whether the time limit has left something out.
    pub fn stopped(&self) -> bool {
        self.skipped.load(Relaxed) > 0
    }

    /// What the command comes to when everything is written.
    ///
    /// # Errors
    /// [`CompareError::Stopped`] if the time limit has left something out, else [`CompareError::RunsFailed`] if
    /// something failed, else [`CompareError::BoundsBroken`] if bounds are broken.
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
