//! Interrupts from the keyboard (`Ctrl-C`, SIGINT). If a sweep keeps its pieces, the first interrupt lets it finish its
//! current pieces and begin no others. Any other interrupt ends the command at once.

use compare::submission::end_processes;
use compare::watch;

use crate::error::INTERRUPTED;
use crate::progress;
use crate::streams::print_error;

/// Installs the handler of interrupts.
pub(crate) fn listen() {
    // Shells ignore interrupts for commands in the background. The handler is installed even then, because an interrupt
    // that is sent to such a command is intended. If the system refuses the handler, an interrupt ends the command.
    let _ = ctrlc::set_handler(|| {
        if watch::request_stop() {
            exit();
        }
        progress::aside(|| {
            if watch::keeps_pieces() {
                print_error!(
                    "interrupted: finishing the current pieces first; a second interrupt ends the command at once"
                );
            } else {
                let left = watch::left().map_or(String::new(), |left| format!(": {left}"));
                print_error!("interrupted{left}");
                exit();
            }
        });
    });
}

/// Ends the command, and the processes that answer as models first.
fn exit() -> ! {
    end_processes();
    std::process::exit(INTERRUPTED.into())
}
