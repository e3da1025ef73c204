//! The command line: what it writes, and that bad input costs one clear line and status 2.

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

/// Runs `arguments`, which must be refused in one line that contains `named`, leaving no file.
fn refused(arguments: &[&str], named: &str) {
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

fn rows(path: &Path) -> Vec<csv::StringRecord> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.records().collect::<Result<_, _>>().unwrap()
}

#[test]
fn overlapping_spheres_are_refused() {
    // The paper's cases start far apart: only offsets so large that distances overflow can make
    // the gap meaningless.
    refused(
        &["orthogonal", "--dx", "10,1e200", "--method", "lt"],
        "1e200",
    );
    refused(
        &["head-on", "--dx", "1", "--dz", "1e308", "--method", "lt"],
        "1e308",
    );
}

#[test]
fn numbers_that_are_none_are_refused() {
    refused(&["head-on", "--beta", "nan", "--method", "lt"], "'nan'");
    refused(&["head-on", "--dx", "1,abc"], "'abc'");
    refused(&["offset", "--dz", "inf"], "'inf'");
    refused(&["loads", "--gap", "0.1,NaN"], "'NaN'");
    refused(&["head-on", "--tol", "nan"], "NaN");
    refused(&["head-on", "--tol", "-1e-8"], "-1e-8");
}

#[test]
fn empty_lists_are_refused() {
    refused(&["head-on", "--dx", ""], "--dx");
    refused(&["loads", "--gap", ""], "--gap");
    refused(&["loads", "--gap", "0.1", "--method", ""], "not a method");
}

#[test]
fn unknown_methods_and_commands_are_refused() {
    refused(&["head-on", "--method", "lt,magic"], "'magic'");
    refused(&["collide"], "collide");
    refused(&["loads"], "--gap");
}

#[test]
fn gaps_that_are_not_positive_or_under_the_range_are_refused() {
    refused(&["loads", "--gap", "0.1,-0.5", "--method", "lt"], "-0.5");
    refused(&["loads", "--gap", "0", "--method", "lt"], "'0.0'");
    refused(&["loads", "--gap", "1e-7", "--method", "bem"], "1e-7");
}

#[test]
fn mesh_levels_and_threads_out_of_range_are_refused() {
    refused(&["loads", "--gap", "1", "--mesh", "99"], "99");
    refused(&["loads", "--gap", "1", "--mesh", "-1"], "-1");
    refused(&["loads", "--gap", "1", "--threads", "0"], "'0'");
    refused(&["head-on", "--time-limit", "-3"], "-3");
}

#[test]
fn a_folder_that_cannot_be_written_is_refused() {
    // Even the superuser cannot make a folder below a file.
    let file = tempfile::NamedTempFile::new().unwrap();
    let below = file.path().join("results");
    let output = squirmers(&below, &["loads", "--gap", "1", "--method", "lt"]);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(message.contains("cannot write"), "{message}");
}

#[test]
fn no_command_prints_help_and_every_command_has_an_example() {
    let output = Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .output()
        .unwrap();
    assert!(String::from_utf8(output.stdout).unwrap().contains("Usage"));
    for command in [
        "loads",
        "head-on",
        "orthogonal",
        "offset",
        "bottom-heavy",
        "report",
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_squirmers"))
            .args([command, "--help"])
            .output()
            .unwrap();
        let help = String::from_utf8(output.stdout).unwrap();
        assert!(help.contains(&format!("Example:\n  squirmers {command}")));
        assert!(output.status.success());
    }
}

#[test]
fn loads_writes_all_twenty_two_numbers_of_each_method() {
    let folder = tempfile::tempdir().unwrap();
    let methods = "lt,lt-corrected";
    let output = squirmers(
        folder.path(),
        &["loads", "--gap", "0.1,0.5", "--method", methods],
    );
    assert!(output.status.success());
    let rows = rows(&folder.path().join("loads.csv"));
    assert_eq!(rows.len(), 2 * 2 * 22);
    assert_eq!(&rows[0][0], "lt");
    assert_eq!(&rows[0][2], "X11A");
    assert_eq!(rows[21][2], *"YT2_2");
}

#[test]
fn loads_writes_further_modes_and_swirl_where_they_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    for method in ["lt", "exact", "bem"] {
        let ask = ["--modes", "3", "--swirl", "2", "--mesh", "1", "--direct"];
        let of = ["loads", "--gap", "0.5", "--method", method];
        let output = squirmers(folder.path(), &[&of[..], &ask[..]].concat());
        assert!(output.status.success());
        let rows = rows(&folder.path().join("loads.csv"));
        let names: Vec<_> = rows.iter().map(|row| row[2].to_owned()).collect();
        assert_eq!(names.len(), 10 + 3 * 6 + 2 * 6);
        assert_eq!(names[28..31], ["XTC1_1", "XTC2_1", "YFC1_1"]);
    }
    refused(&["loads", "--gap", "1", "--swirl", "9"], "0 (none) to 8");
    refused(&["loads", "--gap", "1", "--modes", "9"], "0 (none) to 8");
    refused(&["loads", "--gap", "1", "--swirl", "-1"], "-1");
}

#[test]
fn negative_lists_and_ranges_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "orthogonal",
        "--beta",
        "-1,1,5",
        "--dx",
        "1:2:0.5",
        "--method",
        "lt",
    ];
    assert!(squirmers(folder.path(), &arguments).status.success());
    let rows = rows(&folder.path().join("orthogonal.csv"));
    let beta: Vec<_> = rows.iter().map(|row| row[1].to_owned()).collect();
    assert_eq!(
        beta,
        [
            "-1.0", "-1.0", "-1.0", "1.0", "1.0", "1.0", "5.0", "5.0", "5.0"
        ]
    );
    assert_eq!(&rows[1][2], "1.5");
}

#[test]
fn a_time_limit_names_what_it_skipped() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["head-on", "--method", "lt", "--time-limit", "0"];
    let output = squirmers(folder.path(), &arguments);
    assert!(output.status.success());
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(message.matches("skipped").count(), 5, "{message}");
    let rows = rows(&folder.path().join("head-on.csv"));
    assert!(
        rows.iter()
            .all(|row| &row[4] == "NaN" && &row[8] == "failed")
    );
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let text = |threads: &str| {
        let folder = tempfile::tempdir().unwrap();
        let arguments = ["offset", "--method", "lt", "--threads", threads];
        assert!(squirmers(folder.path(), &arguments).status.success());
        std::fs::read_to_string(folder.path().join("offset.csv")).unwrap()
    };
    assert_eq!(text("1"), text("2"));
}

#[test]
fn bottom_heavy_writes_six_panels_of_each_method() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["bottom-heavy", "--method", "lt,lt-corrected"];
    assert!(squirmers(folder.path(), &arguments).status.success());
    let rows = rows(&folder.path().join("bottom-heavy.csv"));
    for method in ["lt", "lt-corrected"] {
        for panel in ["a", "b", "c", "d", "e", "f"] {
            let of_panel: Vec<_> = (rows.iter())
                .filter(|row| &row[0] == method && &row[1] == panel)
                .collect();
            assert!(of_panel.len() > 100);
            assert_eq!(
                of_panel[0].iter().skip(2).take(5).collect::<Vec<_>>(),
                ["0.0", "-1.5", "0.0", "1.5", "0.0"]
            );
        }
    }
    let svg = std::fs::read_to_string(folder.path().join("bottom-heavy.svg")).unwrap();
    assert_eq!(svg.matches("x (radii a)").count(), 12);
    refused(&["bottom-heavy", "--tol", "1"], "1.0");
    refused(&["bottom-heavy", "--method", "lt,none"], "'none'");
}
