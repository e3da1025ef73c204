//! Interrupts from the keyboard (`Ctrl-C`, SIGINT). While a sweep keeps its pieces the first one lets those under way
//! be finished, and no other is begun; any other ends the command at once.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::SeqCst};
use std::sync::{Mutex, PoisonError};

use crate::progress;
use crate::streams::complain;

/// Exit status of a command that was interrupted.
pub(crate) const STATUS: u8 = 130;

/// Whether there was an interrupt.
static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Sweeps under way that keep their pieces.
static KEEPING: AtomicUsize = AtomicUsize::new(0);

/// What is left where the command is ended at once.
static LEFT: Mutex<Option<String>> = Mutex::new(None);

/// From now on interrupts do what this module says.
pub(crate) fn listen() {
    // Also where whoever started the command has interrupts ignored, as shells do in the background: an interrupt that
    // comes all the same is meant. If the system refuses, an interrupt ends the command as it would without this.
    let _ = ctrlc::set_handler(|| {
        if REQUESTED.swap(true, SeqCst) {
            std::process::exit(STATUS.into());
        }
        progress::aside(|| {
            if KEEPING.load(SeqCst) > 0 {
                complain!(
                    "interrupted: the pieces under way are finished first; a second interrupt ends at once"
                );
            } else {
                let left = LEFT.lock().unwrap_or_else(PoisonError::into_inner).take();
                let left = left.map_or(String::new(), |left| format!(": {left}"));
                complain!("interrupted{left}");
                std::process::exit(STATUS.into());
            }
        });
    });
}

/// Whether no further piece is to be begun.
pub(crate) fn requested() -> bool {
    REQUESTED.load(SeqCst)
}

/// As long as this lives, an interrupt lets pieces under way be finished.
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

/// As long as this lives, a command that is interrupted says what it has left.
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
