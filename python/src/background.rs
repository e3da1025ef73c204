//! Long work: in a thread of its own, while the interpreter handles interrupts and shows progress.

use std::fmt::Arguments;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, Once, OnceLock, PoisonError};
use std::time::Duration;

use compare::CompareError;
use compare::watch::{self, Pieces, Shown, Watch, Work};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;

use crate::array::Show;
use crate::error::{impossible, input, raised};

/// Time between two looks at interrupts and progress.
const TICK: Duration = Duration::from_millis(50);

/// Most threads that somebody may ask for.
const MOST_THREADS: usize = 1024;

/// Work that is shown.
struct Entry {
    number: usize,
    what: &'static str,
    /// Whether its pieces are worth counting: the number of the gaps of a table is known only at its end.
    counted: bool,
    done: AtomicUsize,
    total: AtomicUsize,
}

static ENTRIES: Mutex<Vec<Arc<Entry>>> = Mutex::new(Vec::new());
static NOTICES: Mutex<Vec<String>> = Mutex::new(Vec::new());
static NUMBERS: AtomicUsize = AtomicUsize::new(0);

fn locked<T>(of: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps progress and notices until the interpreter asks for them: threads that compute never wait for it.
struct Board;

impl Watch for Board {
    fn begin(&self, work: Work) -> Box<dyn Shown> {
        let entry = Arc::new(Entry {
            number: NUMBERS.fetch_add(1, Relaxed),
            what: work.what,
            counted: work.pieces != Pieces::Gaps,
            done: AtomicUsize::new(0),
            total: AtomicUsize::new(work.total),
        });
        locked(&ENTRIES).push(Arc::clone(&entry));
        Box::new(Running(entry))
    }

    fn notice(&self, line: Arguments<'_>) {
        locked(&NOTICES).push(line.to_string());
    }
}

struct Running(Arc<Entry>);

impl Shown for Running {
    fn reach(&self, done: usize, total: usize) {
        self.0.done.store(done, Relaxed);
        self.0.total.store(total, Relaxed);
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        locked(&ENTRIES).retain(|entry| entry.number != self.0.number);
    }
}

/// From now on progress and notices of the library are kept for Python.
pub(crate) fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| watch::install(Box::new(Board)));
}

/// Passes on what a person should read: to the logger `squirmers`.
pub(crate) fn tell(py: Python<'_>) -> PyResult<()> {
    let lines = std::mem::take(&mut *locked(&NOTICES));
    if lines.is_empty() {
        return Ok(());
    }
    let logger = py
        .import("logging")?
        .call_method1("getLogger", ("squirmers",))?;
    for line in lines {
        logger.call_method1("warning", ("%s", line))?;
    }
    Ok(())
}

/// The work that is running: number, name, pieces done, all pieces.
fn running() -> Vec<(usize, &'static str, usize, Option<usize>)> {
    let entry = |entry: &Arc<Entry>| {
        let total = entry.total.load(Relaxed);
        (
            entry.number,
            entry.what,
            entry.done.load(Relaxed),
            (entry.counted && total > 0).then_some(total),
        )
    };
    locked(&ENTRIES).iter().map(entry).collect()
}

fn shown(show: Option<&Show<'_>>) -> PyResult<()> {
    show.map_or(Ok(()), |show| show.0.call1((running(),)).map(drop))
}

/// Refuses a process that was forked after work had begun: it lacks the threads, and would wait for them forever.
fn check_process() -> PyResult<()> {
    static BEGAN: OnceLock<u32> = OnceLock::new();
    let own = std::process::id();
    if *BEGAN.get_or_init(|| own) == own {
        return Ok(());
    }
    Err(impossible(
        "this process was forked from one whose work had begun, and lacks its threads: start processes otherwise, as by \
         multiprocessing.set_start_method('spawn')",
    ))
}

/// Does `work` in a thread of its own. Meanwhile the interpreter is free, Ctrl-C stops the work, and `show` is called with what is running; none of it
/// is shown without. A sweep that keeps its pieces finishes those under way after the first interrupt; everything else ends at once.
///
/// # Errors
/// The error of `work`; `KeyboardInterrupt`; what `show` raises.
pub(crate) fn in_background<T: Send + 'static>(
    py: Python<'_>,
    show: Option<&Show<'_>>,
    work: impl FnOnce() -> Result<T, CompareError> + Send + 'static,
) -> PyResult<T> {
    check_process()?;
    listen();
    let (to, mut from) = mpsc::channel();
    let begun = std::thread::Builder::new()
        .name("squirmers".to_owned())
        .spawn(move || {
            // Whoever no longer waits needs no answer.
            let _ = to.send(work());
        });
    begun.map_err(|error| PyRuntimeError::new_err(format!("no thread can be started: {error}")))?;
    let mut raised_meanwhile: Option<PyErr> = None;
    let ended = loop {
        // A receiver cannot be lent to another thread, only be handed over.
        let (back, heard) = py.detach(move || {
            let heard = from.recv_timeout(TICK);
            (from, heard)
        });
        from = back;
        match heard {
            Ok(result) => break Some(result),
            Err(RecvTimeoutError::Disconnected) => break None,
            Err(RecvTimeoutError::Timeout) => {}
        }
        let seen = shown(show);
        if let Err(error) = py.check_signals().and(seen).and_then(|()| tell(py)) {
            if raised_meanwhile.is_none() && watch::keeps_pieces() {
                watch::request_stop();
            } else {
                watch::give_up();
            }
            raised_meanwhile = Some(error);
        }
    };
    if raised_meanwhile.is_some() {
        watch::go_on();
    }
    let last = shown(show);
    let told = tell(py);
    match (raised_meanwhile, ended) {
        // What is kept is said, if the work was stopped in time.
        (Some(error), Some(Err(kept @ CompareError::Interrupted { .. }))) => {
            if error.is_instance_of::<PyKeyboardInterrupt>(py) {
                Err(raised(kept))
            } else {
                Err(error)
            }
        }
        (Some(error), _) => Err(error),
        (None, Some(result)) => {
            let value = result.map_err(raised)?;
            last.and(told)?;
            Ok(value)
        }
        (None, None) => Err(PyRuntimeError::new_err(
            "the work ended without a result; this is a fault of squirmers: please report it",
        )),
    }
}

/// Sets the number of threads for all further work of this process, once, before any.
#[pyo3::pyfunction]
pub(crate) fn set_threads(threads: usize) -> PyResult<()> {
    if !(1..=MOST_THREADS).contains(&threads) {
        let allowed = format!("give a number from 1 to {MOST_THREADS}");
        return Err(input("threads", threads, allowed));
    }
    check_process()?;
    let built = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global();
    match built {
        Ok(()) => Ok(()),
        Err(_) if rayon::current_num_threads() == threads => Ok(()),
        Err(_) => Err(input(
            "threads",
            threads,
            format!(
                "work has begun with {} threads: set the number before any work, or in RAYON_NUM_THREADS",
                rayon::current_num_threads()
            ),
        )),
    }
}
