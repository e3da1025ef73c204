//! Starts the program.

use std::path::Path;
use std::process::{Command, Output};

/// Runs a command, whose results go to `out`, to its end.
pub fn squirmers(out: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .args(arguments)
        .arg("--out")
        .arg(out)
        .output()
        .unwrap()
}
