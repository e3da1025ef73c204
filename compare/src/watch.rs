//! What long work tells whoever watches it, and how it is asked to stop.
//!
//! As with the crate `log`, the library only reports; what a person sees is the program's choice. Without a
//! [`Watch`] nothing is shown.

use std::fmt::Arguments;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed, Ordering::SeqCst};
use std::sync::{Mutex, OnceLock, PoisonError};

use scene::BuildProgress;

/// A stretch of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Work {
    /// What its pieces are, or what is built, in words.
    pub what: &'static str,
    /// Its size, in pieces; of a table not known yet.
    pub total: usize,
    /// What its pieces are like.
    pub pieces: Pieces,
}

/// What the pieces of some work are like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pieces {
    /// They take about the same time each, so that the time left follows from the time gone.
    Alike,
    /// They take very different times.
    Unlike,
    /// Gaps at which a table is solved for; how many, only the work itself shows.
    Gaps,
    /// Units `a/V_s` of a run's time; it may end before them.
    Time,
}

/// Shows a person what long work tells.
pub trait Watch: Send + Sync {
    /// Work begins; it is over when what is returned is dropped.
    fn begin(&self, work: Work) -> Box<dyn Shown>;

    /// A line that a person should read, such as what was damaged and is computed again.
    fn notice(&self, line: Arguments<'_>);
}

/// Work under way, as it is shown.
pub trait Shown: Send + Sync {
    /// So many pieces are done, of so many.
    fn reach(&self, done: usize, total: usize);
}

static WATCH: OnceLock<Box<dyn Watch>> = OnceLock::new();

/// Shows all further work by `watch`; only the first call of a process counts.
pub fn install(watch: Box<dyn Watch>) {
    let _ = WATCH.set(watch);
}

/// Tells of work until it is dropped.
pub struct Progress {
    done: AtomicUsize,
    total: AtomicUsize,
    shown: Option<Box<dyn Shown>>,
}

impl Progress {
    /// Begins a stretch of work.
    #[must_use]
    pub fn begin(what: &'static str, total: usize, pieces: Pieces) -> Self {
        let work = Work {
            what,
            total,
            pieces,
        };
        Self {
            done: AtomicUsize::new(0),
            total: AtomicUsize::new(total),
            shown: WATCH.get().map(|watch| watch.begin(work)),
        }
    }

    /// One more piece is done.
    pub fn advance(&self) {
        self.done.fetch_add(1, Relaxed);
        self.show();
    }

    /// How far a table is.
    pub fn follow(&self, table: BuildProgress) {
        self.total.store(table.expected, Relaxed);
        self.reach(table.done);
    }

    /// So many pieces are done.
    pub fn reach(&self, done: usize) {
        // Threads may report out of order; what is shown must not run backwards.
        self.done.fetch_max(done, Relaxed);
        self.show();
    }

    fn show(&self) {
        if let Some(shown) = &self.shown {
            shown.reach(self.done.load(Relaxed), self.total.load(Relaxed));
        }
    }
}

/// Tells a line.
pub(crate) fn tell(line: Arguments<'_>) {
    if let Some(watch) = WATCH.get() {
        watch.notice(line);
    }
}

/// A line that a person should read.
macro_rules! notice {
    ($($text:tt)+) => {
        $crate::watch::tell(format_args!($($text)+))
    };
}

pub(crate) use notice;

/// Whether work is asked to stop.
static STOP: AtomicBool = AtomicBool::new(false);

/// Sweeps under way that keep their pieces.
static KEEPING: AtomicUsize = AtomicUsize::new(0);

/// What is left where the process is ended at once.
static LEFT: Mutex<Option<String>> = Mutex::new(None);

/// Asks sweeps to stop after the pieces under way; whether they were asked before.
pub fn request_stop() -> bool {
    STOP.swap(true, SeqCst)
}

/// Whether no further piece is to be begun.
pub(crate) fn stop_requested() -> bool {
    STOP.load(SeqCst)
}

/// Whether a sweep that keeps its pieces is under way.
#[must_use]
pub fn keeps_pieces() -> bool {
    KEEPING.load(SeqCst) > 0
}

/// What is left if the process ends now, in words.
#[must_use]
pub fn left() -> Option<String> {
    LEFT.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// As long as this lives, a sweep that is asked to stop finishes the pieces under way and keeps them.
pub(crate) struct Keeping(());

impl Keeping {
    pub(crate) fn begin() -> Self {
        KEEPING.fetch_add(1, SeqCst);
        Self(())
    }
}

impl Drop for Keeping {
    fn drop(&mut self) {
        KEEPING.fetch_sub(1, SeqCst);
    }
}

/// As long as this lives, [`left`] says what a process that ends now leaves.
pub(crate) struct Leaving(());

impl Leaving {
    pub(crate) fn of(what: String) -> Self {
        Self::set(Some(what));
        Self(())
    }

    fn set(what: Option<String>) {
        *LEFT.lock().unwrap_or_else(PoisonError::into_inner) = what;
    }
}

impl Drop for Leaving {
    fn drop(&mut self) {
        Self::set(None);
    }
}
