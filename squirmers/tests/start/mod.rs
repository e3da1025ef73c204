//! Starts the program without waiting for its end.

use std::path::Path;
use std::process::{Child, Command, Stdio};

/// The running command, whose messages are piped.
pub fn start(out: &Path, arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .args(arguments)
        .arg("--out")
        .arg(out)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}
