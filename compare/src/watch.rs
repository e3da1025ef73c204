//! Progress of long work, and requests to stop it.
//!
//! As with the crate `log`, the library only reports, and the program decides what to show. Without a [`Watch`]
//! nothing is shown.

use std::fmt::Arguments;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed, Ordering::SeqCst};
use std::sync::{Mutex, OnceLock, PoisonError};

use scene::BuildProgress;

/// Work whose progress is reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Work {
    /// Name of its pieces, or of what is built.
    pub what: &'static str,
    /// Number of its pieces; for a table it is not known at first.
    pub total: usize,
    /// Kind of its pieces.
    pub pieces: Pieces,
}

/// Kinds of pieces of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pieces {
    /// All pieces take about the same time, so the remaining time follows from the elapsed time.
    Alike,
    /// The pieces take very different times.
    Unlike,
    /// Gaps at which the loads of a table are solved for. Their number is known only at the end.
    Gaps,
    /// Units `a/V_s` of the time of a run, which may end early.
    Time,
}

/// Shows the progress of long work to a person.
pub trait Watch: Send + Sync {
    /// Called when work begins. The work has ended when the returned value is dropped.
    fn begin(&self, work: Work) -> Box<dyn Shown>;

    /// Shows a line that a person should read, such as a report of a damaged file.
    fn notice(&self, line: Arguments<'_>);
}

/// The display of work that is running.
pub trait Shown: Send + Sync {
    /// Shows that `done` of `total` pieces are done.
    fn reach(&self, done: usize, total: usize);
}

static WATCH: OnceLock<Box<dyn Watch>> = OnceLock::new();

/// From now on `watch` shows all work. Only the first call of a process has an effect.
pub fn install(watch: Box<dyn Watch>) {
    let _ = WATCH.set(watch);
}

/// Reports the progress of work until this value is dropped.
pub struct Progress {
    done: AtomicUsize,
    total: AtomicUsize,
    shown: Option<Box<dyn Shown>>,
}

impl Progress {
    /// Begins work of `total` pieces.
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

    /// Reports that one more piece is done.
    pub fn advance(&self) {
        self.done.fetch_add(1, Relaxed);
        self.show();
    }

    /// Reports how far the building of a table is.
    pub fn follow(&self, table: BuildProgress) {
        self.total.store(table.expected, Relaxed);
        self.reach(table.done);
    }

    /// Reports that `done` pieces are done.
    pub fn reach(&self, done: usize) {
        // Threads may report out of order; the number shown must not decrease.
        self.done.fetch_max(done, Relaxed);
        self.show();
    }

    fn show(&self) {
        if let Some(shown) = &self.shown {
            shown.reach(self.done.load(Relaxed), self.total.load(Relaxed));
        }
    }
}

/// Shows a line that a person should read.
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

/// Whether work was requested to stop.
static STOP: AtomicBool = AtomicBool::new(false);

/// Number of running sweeps that keep their pieces.
static KEEPING: AtomicUsize = AtomicUsize::new(0);

/// What remains on disk if the process ends at once.
static LEFT: Mutex<Option<String>> = Mutex::new(None);

/// Requests sweeps to stop after their current pieces. Returns whether this was requested before.
pub fn request_stop() -> bool {
    STOP.swap(true, SeqCst)
}

/// Whether sweeps must not begin further pieces.
pub(crate) fn stop_requested() -> bool {
    STOP.load(SeqCst)
}

/// Whether work under way is to be given up.
static GIVEN_UP: AtomicBool = AtomicBool::new(false);

/// Makes runs and models that solve for their loads fail at once. A sweep keeps none of what it was computing. A program that ends at an interrupt needs
/// none of this; one that lives on, such as an interpreter, does.
pub fn give_up() {
    request_stop();
    GIVEN_UP.store(true, SeqCst);
}

/// Whether work under way is to be given up.
#[must_use]
pub fn given_up() -> bool {
    GIVEN_UP.load(SeqCst)
}

/// Takes back [`request_stop`] and [`give_up`], once the work that they stopped has ended.
pub fn go_on() {
    STOP.store(false, SeqCst);
    GIVEN_UP.store(false, SeqCst);
}

/// Whether a sweep that keeps its pieces is running.
#[must_use]
pub fn keeps_pieces() -> bool {
    KEEPING.load(SeqCst) > 0
}

/// What remains on disk if the process ends now, in words.
#[must_use]
pub fn left() -> Option<String> {
    LEFT.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// While this value exists, a request to stop lets the sweep finish and keep its current pieces.
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

/// While this value exists, [`left`] returns what a process that ends now leaves on disk.
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
