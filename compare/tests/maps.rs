//! Maps over the incoming angles: what they write, that they go on after a stop, and that bad input
//! costs one clear line.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;
use std::process::{Command, Output};

fn squirmers(out: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .args(arguments)
        .arg("--out")
        .arg(out)
        .output()
        .unwrap()
}

fn text(out: &Path, file: &str) -> String {
    std::fs::read_to_string(out.join(file)).unwrap()
}

const MAP: [&str; 7] = [
    "--beta",
    "-5,5",
    "--grid",
    "8",
    "--method",
    "lt",
    "--threads",
];

fn map(out: &Path, command: &str, threads: &str, more: &[&str]) -> Output {
    let arguments = [&[command][..], &MAP, &[threads], more].concat();
    let output = squirmers(out, &arguments);
    assert!(output.status.success(), "{output:?}");
    output
}

#[test]
fn maps_do_not_depend_on_the_number_of_threads() {
    for command in ["scatter", "fates"] {
        let [one, two] = ["1", "2"].map(|threads| {
            let folder = tempfile::tempdir().unwrap();
            map(folder.path(), command, threads, &[]);
            text(folder.path(), &format!("{command}.csv"))
        });
        assert_eq!(one, two);
    }
}

#[test]
fn a_map_has_a_row_for_each_point_and_a_picture_for_each_pair() {
    let folder = tempfile::tempdir().unwrap();
    map(folder.path(), "scatter", "2", &[]);
    let csv = text(folder.path(), "scatter.csv");
    let header = "method,beta,g,delta,sigma,deflection1_deg,deflection2_deg,tau,outcome";
    assert!(csv.starts_with(header));
    assert_eq!(csv.lines().count(), 1 + 2 * 8 * 8);
    for beta in ["-5", "5"] {
        let svg = text(folder.path(), &format!("scatter-lt-beta{beta}.svg"));
        assert_eq!(svg.matches("data:image/png").count(), 4);
    }
}

#[test]
fn a_map_that_was_stopped_goes_on_to_the_same_file() {
    let whole = tempfile::tempdir().unwrap();
    map(whole.path(), "scatter", "2", &[]);
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let stopped = map(out, "scatter", "2", &["--time-limit", "0"]);
    let message = String::from_utf8(stopped.stderr).unwrap();
    assert!(message.contains("16 of 16 lines"), "{message}");
    assert!(!out.join("scatter.csv").exists());
    // A part file as it is when the program is killed in the middle of a line.
    let key = text(out, "scatter.csv.part");
    let rows = text(whole.path(), "scatter.csv");
    let rows: Vec<_> = rows.lines().skip(1).collect();
    let chunk = |k: usize| format!("{}\ndone {k}\n", rows[8 * k..8 * (k + 1)].join("\n"));
    let torn = format!("{key}{}{}{}", chunk(3), chunk(0), &chunk(5)[..70]);
    std::fs::write(out.join("scatter.csv.part"), torn).unwrap();
    let third = map(out, "scatter", "2", &["--time-limit", "0"]);
    let message = String::from_utf8(third.stderr).unwrap();
    assert!(message.contains("14 of 16 lines"), "{message}");
    map(out, "scatter", "1", &[]);
    assert_eq!(text(out, "scatter.csv"), text(whole.path(), "scatter.csv"));
    assert!(!out.join("scatter.csv.part").exists());
}

/// Chunks that a part file holds whole.
fn finished(out: &Path) -> usize {
    let text = std::fs::read_to_string(out.join("scatter.csv.part")).unwrap_or_default();
    text.lines()
        .filter(|line| line.starts_with("done "))
        .count()
}

#[test]
fn a_map_that_is_killed_loses_at_most_the_lines_under_way() {
    const LARGE: [&str; 9] = [
        "scatter",
        "--beta",
        "5",
        "--grid",
        "100",
        "--method",
        "lt",
        "--threads",
        "2",
    ];
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let mut child = Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .args(LARGE)
        .arg("--out")
        .arg(out)
        .spawn()
        .unwrap();
    let seen = loop {
        let seen = finished(out);
        let over = child.try_wait().unwrap().is_some();
        assert!(!over, "the map was done before it could be killed");
        if seen >= 3 {
            break seen;
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    };
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = finished(out);
    assert!(kept >= seen, "{kept} of {seen} kept");
    let stopped = squirmers(out, &[&LARGE[..], &["--time-limit", "0"]].concat());
    let message = String::from_utf8(stopped.stderr).unwrap();
    assert!(
        message.contains(&format!("{} of 100 lines", 100 - kept)),
        "{message}"
    );
    assert!(squirmers(out, &LARGE).status.success());
    let whole = tempfile::tempdir().unwrap();
    assert!(squirmers(whole.path(), &LARGE).status.success());
    assert_eq!(text(out, "scatter.csv"), text(whole.path(), "scatter.csv"));
}

#[test]
fn values_that_are_not_allowed_are_named() {
    for (arguments, named) in [
        (&["scatter", "--grid", "1"][..], "'1'"),
        (&["scatter", "--grid", "-4"], "-4"),
        (&["fates", "--g", "nan"], "'nan'"),
        (&["fates", "--tol", "0"], "'0.0'"),
        (&["scatter", "--beta", "5,x"], "'x'"),
        (&["trust", "--method", "lt"], "exact"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("results");
        let output = squirmers(&out, arguments);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert_eq!(message.trim().lines().count(), 1, "{message}");
        assert!(message.contains(named), "'{message}' does not name {named}");
        let left = std::fs::read_dir(&out).map_or(0, Iterator::count);
        assert_eq!(left, 0, "{arguments:?} left files behind");
    }
}
