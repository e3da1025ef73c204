//! `squirmers cost` refuses bad input before it measures anything.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::process::Command;

#[test]
fn targets_that_are_no_angles_are_refused() {
    for target in ["-1deg", "0", "nan", "abc", "0.1rad"] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("results");
        let output = Command::new(env!("CARGO_BIN_EXE_squirmers"))
            .args(["cost", "--target", target, "--out"])
            .arg(&out)
            .output()
            .unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{target}: {message}");
        assert_eq!(message.trim().lines().count(), 1, "{message}");
        assert!(
            message.contains("--target") && message.contains(target),
            "{message}"
        );
        assert!(!out.exists(), "{target} left files behind");
    }
}
