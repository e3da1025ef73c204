//! `squirmers growth`: what it writes and prints, that it goes on after a stop, and what it refuses.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod program;

use std::path::Path;

use program::squirmers;

const MAP: [&str; 7] = ["growth", "--beta", "1,5", "--grid", "4", "--method", "lt"];

fn text(out: &Path, file: &str) -> String {
    std::fs::read_to_string(out.join(file)).unwrap()
}

#[test]
fn growth_has_a_row_for_each_point_a_picture_and_tables_that_fit_a_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let method = ["--method", "lt-corrected,exact"];
    let arguments = [&MAP[..5], &method].concat();
    let output = squirmers(folder.path(), &arguments);
    assert!(output.status.success(), "{output:?}");
    let csv = text(folder.path(), "growth.csv");
    let header = "method,beta,delta,sigma,outcome,tilt1_per_dz,tilt2_per_dz,growth,exponent,truncation,status";
    assert!(csv.starts_with(header), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 4 * 16);
    assert_eq!(text(folder.path(), "growth-shares.csv").lines().count(), 5);
    let svg = text(folder.path(), "growth.svg");
    assert_eq!(svg.matches("data:image/png").count(), 4);
    let printed = String::from_utf8(output.stdout).unwrap();
    for line in printed.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    assert!(printed.contains("lt-corrected"), "{printed}");
    let states = text(folder.path(), "bound-states.csv");
    assert!(states.contains("growth_off_plane,stable_in_plane,stable_in_space"));
    // Swimming together attracts in the plane, and not in space.
    let together = states
        .lines()
        .find(|line| line.starts_with("exact,1.0,pairwise") && line.contains(",yes,no,"));
    assert!(together.is_some(), "{states}");
}

#[test]
fn growth_does_not_depend_on_threads_and_goes_on_after_a_stop() {
    let [one, two] = ["1", "2"].map(|threads| {
        let folder = tempfile::tempdir().unwrap();
        let output = squirmers(folder.path(), &[&MAP[..], &["--threads", threads]].concat());
        assert!(output.status.success(), "{output:?}");
        text(folder.path(), "growth.csv")
    });
    assert_eq!(one, two);
    let folder = tempfile::tempdir().unwrap();
    let stopped = squirmers(folder.path(), &[&MAP[..], &["--time-limit", "0"]].concat());
    assert_eq!(stopped.status.code(), Some(75), "{stopped:?}");
    assert!(!folder.path().join("growth-shares.csv").exists());
    assert!(squirmers(folder.path(), &MAP).status.success());
    assert_eq!(text(folder.path(), "growth.csv"), one);
}

#[test]
fn an_offset_that_is_none_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for offset in ["0", "-1", "nan", "inf"] {
        let output = squirmers(folder.path(), &[&MAP[..], &["--offset", offset]].concat());
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{offset}: {message}");
        assert!(message.contains("--offset"), "{message}");
    }
}
