//! All processes that answer end together, in a program of its own: no other test may have one.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::process::Command;
use std::time::{Duration, Instant};

use compare::submission::{Process, end_processes};

/// By a shell of its own, for a process that nobody has waited for still has its number.
fn runs(id: &str) -> bool {
    let test = format!("kill -0 {id} 2>/dev/null");
    let status = Command::new("sh").args(["-c", &test]).status();
    status.unwrap().success()
}

#[test]
fn no_process_outlives_the_end_of_all() {
    let folder = tempfile::tempdir().unwrap();
    let script = "echo $$ > \"$1\"; read -r line; echo '{\"header\":{\"range\":[0.1,10]}}'; trap '' TERM INT HUP; \
                  while true; do sleep 0.01; done";
    let files = ["first", "second"].map(|name| folder.path().join(name));
    let processes = files.each_ref().map(|file| {
        let command = format!(
            "sh -c '{}' sh {}",
            script.replace('\'', "'\\''"),
            file.display()
        );
        Process::start(&command, Duration::from_secs(20)).unwrap()
    });
    let ids = files.map(|file| std::fs::read_to_string(file).unwrap().trim().to_owned());
    assert!(ids.iter().all(|id| runs(id)));
    let started = Instant::now();
    end_processes();
    assert!(started.elapsed() < Duration::from_secs(10));
    assert!(!ids.iter().any(|id| runs(id)));
    drop(processes);
}
