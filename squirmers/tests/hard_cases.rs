//! `squirmers hard-cases`: what it prints and writes, and what it refuses. The groups' bounds are tests of the
//! workspace's crate `tests`; here run only quick ones.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;
use std::process::{Command, Output};

fn hard_cases(out: &Path, more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .arg("hard-cases")
        .args(more)
        .arg("--out")
        .arg(out)
        .output()
        .unwrap()
}

#[test]
fn chosen_groups_are_printed_in_their_order_and_their_rows_written() {
    let folder = tempfile::tempdir().unwrap();
    let output = hard_cases(folder.path(), &["--only", "standoff,no-repulsion"]);
    assert!(output.status.success(), "{output:?}");
    let mut reader = csv::Reader::from_path(folder.path().join("hard-cases.csv")).unwrap();
    let headers = reader.headers().unwrap().clone();
    let headers: Vec<_> = headers.iter().collect();
    let expected = [
        "case",
        "method",
        "measure",
        "bound",
        "value",
        "holds",
        "hazard",
        "bound_from",
    ];
    assert_eq!(headers, expected);
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    for row in &rows {
        let [bound, value] = [3, 4].map(|k| row[k].parse::<f64>().unwrap());
        assert_eq!(&row[5] == "true", value <= bound, "{row:?}");
    }
    let mut groups: Vec<_> = rows.iter().map(|row| row[0].to_owned()).collect();
    groups.dedup();
    assert_eq!(groups, ["no repulsion", "standoff"]);
    let printed = String::from_utf8(output.stdout).unwrap();
    for line in printed.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    let headings = ["no repulsion: ", "standoff: "].map(|heading| printed.find(heading).unwrap());
    assert!(headings.is_sorted(), "{printed}");
    let verdict = format!("all {} bounds hold", rows.len());
    assert!(printed.ends_with(&format!("{verdict}\n")), "{printed}");
    let held = printed
        .lines()
        .filter(|line| line.trim_end().ends_with(" yes"))
        .count();
    assert_eq!(held, rows.len(), "{printed}");
}

#[test]
fn bad_arguments_are_refused_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, named) in [
        (["--threads", "0"], "'0'"),
        (
            ["--only", "files"],
            "'files' is not a group: use contact, no-repulsion, stiff-forces, standoff, \
             separatrix, long-runs, out-of-plane, far, boundary-elements, starts, tangents, unlike-radii, submissions, machine",
        ),
        (["--only", "far,far"], "twice"),
        (["--only", ""], "--only"),
    ] {
        let output = hard_cases(&folder.path().join("out"), &arguments);
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(message.trim().lines().count(), 1, "{message}");
        assert!(message.contains(named), "{message}");
        assert!(!folder.path().join("out").exists());
    }
}
