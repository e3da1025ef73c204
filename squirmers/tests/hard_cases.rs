//! The command for hard cases, and what processes can meet: a full disk, each other.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;
use std::process::{Command, Output, Stdio};

fn squirmers() -> Command {
    Command::new(env!("CARGO_BIN_EXE_squirmers"))
}

const QUICK: [&str; 7] = [
    "loads", "--gap", "0.1", "--method", "lt,exact", "--modes", "1",
];

fn loads(out: &Path, cache: &Path) -> Command {
    let mut command = squirmers();
    command.args(QUICK).arg("--out").arg(out);
    command.arg("--cache").arg(cache);
    command
}

fn files(folder: &Path) -> Vec<std::path::PathBuf> {
    let mut files: Vec<_> = (std::fs::read_dir(folder).unwrap())
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    files
}

#[test]
fn the_table_has_every_row_and_the_exit_status_says_whether_all_hold() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let output = squirmers()
        .args(["hard-cases", "--out"])
        .arg(out)
        .output()
        .unwrap();
    let mut reader = csv::Reader::from_path(out.join("hard-cases.csv")).unwrap();
    let headers = reader.headers().unwrap().clone();
    let start: Vec<_> = headers.iter().take(6).collect();
    assert_eq!(
        start,
        ["case", "method", "measure", "bound", "value", "holds"]
    );
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    for row in &rows {
        let [bound, value] = [3, 4].map(|k| row[k].parse::<f64>().unwrap());
        assert_eq!(&row[5] == "true", value <= bound, "{row:?}");
    }
    let broken = rows.iter().filter(|row| &row[5] != "true").count();
    let status = if broken == 0 { 0 } else { 1 };
    assert_eq!(output.status.code(), Some(status), "{output:?}");
}

#[test]
fn bad_arguments_are_refused_in_one_line() {
    let output = squirmers()
        .args(["hard-cases", "--threads", "0"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(message.trim().lines().count(), 1, "{message}");
}

/// A limit of no bytes a file stands for a full disk: the system refuses every write.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_costs_one_clear_line_and_leaves_nothing() {
    let (out, cache) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let command = loads(out.path(), cache.path());
    let arguments: Vec<_> = command.get_args().collect();
    let output = Command::new("sh")
        // Without the trap the system would end the program by a signal.
        .args(["-c", "trap '' XFSZ; ulimit -f 0; exec \"$0\" \"$@\""])
        .arg(command.get_program())
        .args(arguments)
        .stdout(Stdio::null())
        .output()
        .unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(message.contains("loads.csv"), "{message}");
    assert_eq!(files(out.path()), Vec::<std::path::PathBuf>::new());
    assert_eq!(files(cache.path()), Vec::<std::path::PathBuf>::new());
}

#[test]
fn processes_at_once_share_cache_and_output_folder() {
    let (out, cache) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (alone, kept) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let single: Output = loads(alone.path(), kept.path()).output().unwrap();
    assert!(single.status.success(), "{single:?}");
    let started: Vec<_> = (0..3)
        .map(|_| {
            let mut command = loads(out.path(), cache.path());
            command.stdout(Stdio::null()).spawn().unwrap()
        })
        .collect();
    for mut child in started {
        assert!(child.wait().unwrap().success());
    }
    for (shared, own) in [(out.path(), alone.path()), (cache.path(), kept.path())] {
        let (shared, own) = (files(shared), files(own));
        assert_eq!(shared.len(), own.len(), "{shared:?}");
        for (a, b) in shared.iter().zip(&own) {
            assert_eq!(a.file_name(), b.file_name());
            assert_eq!(std::fs::read(a).unwrap(), std::fs::read(b).unwrap());
        }
    }
}
