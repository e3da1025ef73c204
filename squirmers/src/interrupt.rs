//! Interrupts from the keyboard (`Ctrl-C`, SIGINT). While a sweep keeps its pieces the first one lets those under way
//! be finished, and no other is begun; any other ends the command at once.

use compare::watch;

use crate::progress;
use crate::streams::complain;

/// Exit status of a command that was interrupted.
pub(crate) const STATUS: u8 = 130;

/// From now on interrupts do what this module says.
pub(crate) fn listen() {
    // Also where whoever started the command has interrupts ignored, as shells do in the background: an interrupt that
    // comes all the same is meant. If the system refuses, an interrupt ends the command as it would without this.
    let _ = ctrlc::set_handler(|| {
        if watch::request_stop() {
            std::process::exit(STATUS.into());
        }
        progress::aside(|| {
            if watch::keeps_pieces() {
                complain!(
                    "interrupted: the pieces under way are finished first; a second interrupt ends at once"
                );
            } else {
                let left = watch::left().map_or(String::new(), |left| format!(": {left}"));
                complain!("interrupted{left}");
                std::process::exit(STATUS.into());
            }
        });
    });
}
