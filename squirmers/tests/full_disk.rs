//! Full disks: one clear line, exit status 2, and no file that is not whole.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs::OpenOptions;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const PROGRAM: &str = env!("CARGO_BIN_EXE_squirmers");

/// Runs a command that can write so many blocks a file and no more: the system refuses as it does where a disk is full.
fn with_blocks(blocks: &str, arguments: &[&str], out: &Path, cache: &Path) -> Output {
    Command::new("sh")
        // Without the trap the system would end the program by a signal.
        .args(["-c", "trap '' XFSZ; ulimit -f \"$0\"; exec \"$@\"", blocks])
        .arg(PROGRAM)
        .args(arguments)
        .args([Path::new("--out"), out, Path::new("--cache"), cache])
        .stdout(Stdio::null())
        .output()
        .unwrap()
}

/// The command was refused in one line that names `what`.
fn refused(output: Output, what: &str) {
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(message.contains(what), "{message}");
}

fn is_empty(folder: &Path) -> bool {
    std::fs::read_dir(folder).unwrap().next().is_none()
}

#[test]
fn loads_that_do_not_fit_leave_no_file_and_no_table() {
    let (out, cache) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let loads = [
        "loads", "--gap", "0.1", "--method", "lt,exact", "--modes", "1",
    ];
    refused(
        with_blocks("0", &loads, out.path(), cache.path()),
        "loads.csv",
    );
    assert!(is_empty(out.path()) && is_empty(cache.path()));
}

#[test]
fn a_run_that_does_not_fit_names_the_file() {
    let (out, cache) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let scene = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../fixtures/scenes/fig6-head-on-dx1.toml"
    );
    for blocks in ["0", "4"] {
        let output = with_blocks(blocks, &["run", scene], out.path(), cache.path());
        refused(output, "run.csv");
    }
}

#[test]
fn what_is_printed_may_not_fit_either() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    for arguments in [
        &["loads", "--gap", "0.1", "--method", "lt", "--out", out][..],
        &["--help"],
        &["--version"],
        &["head-on", "--help"],
        &[],
    ] {
        let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = Command::new(PROGRAM)
            .args(arguments)
            .stdout(full)
            .stderr(Stdio::piped())
            .output()
            .unwrap();
        refused(output, "standard output");
    }
}
