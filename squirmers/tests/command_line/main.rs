//! The command line: what it writes, and that bad input costs one clear line and status 2.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod columns;
mod limits;
mod models;
mod refusals;

#[cfg(target_os = "linux")]
#[path = "../memory/mod.rs"]
mod memory;

#[path = "../program/mod.rs"]
mod program;

use std::path::Path;
use std::process::Command;

use program::squirmers;

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
        "sweep",
        "merge",
        "ratios",
        "cargo",
        "collisions",
        "kinetics",
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
        let ask = ["--modes", "3", "--swirl", "2", "--direct"];
        let mesh: &[&str] = if method == "bem" {
            &["--mesh", "1"]
        } else {
            &[]
        };
        let of = ["loads", "--gap", "0.5", "--method", method];
        let output = squirmers(folder.path(), &[&of[..], &ask[..], mesh].concat());
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

#[test]
fn a_closed_form_has_no_error_estimate() {
    let folder = tempfile::tempdir().unwrap();
    let output = squirmers(folder.path(), &["loads", "--gap", "0.1", "--method", "lt"]);
    assert!(output.status.success());
    let rows = rows(&folder.path().join("loads.csv"));
    assert!(rows.iter().all(|row| &row[4] == "none"), "{rows:?}");
    assert!(String::from_utf8(output.stdout).unwrap().contains("none"));
}

#[test]
fn each_load_by_boundary_elements_has_an_error_estimate_of_its_own_and_needs_no_table() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    let arguments = [
        "loads", "--gap", "0.1", "--method", "bem", "--mesh", "1", "--modes", "1",
    ];
    let arguments = [&arguments[..], &["--cache", cache.to_str().unwrap()]].concat();
    assert!(squirmers(folder.path(), &arguments).status.success());
    let rows = rows(&folder.path().join("loads.csv"));
    let mut estimates: Vec<String> = rows.iter().map(|row| row[4].to_owned()).collect();
    assert!(estimates.iter().all(|e| e.parse::<f64>().unwrap() > 0.0));
    estimates.sort();
    estimates.dedup();
    assert!(estimates.len() > 5, "{estimates:?}");
    assert_eq!(std::fs::read_dir(&cache).map_or(0, Iterator::count), 0);
}

#[test]
fn tables_fit_a_terminal_and_keep_their_numbers_whole() {
    let folder = tempfile::tempdir().unwrap();
    fn lt<'a>(command: &[&'a str]) -> Vec<&'a str> {
        [command, &["--method", "lt,lt-corrected"]].concat()
    }
    for (arguments, whole) in [
        (
            lt(&["head-on", "--beta", "-5", "--dx", "1,2.5", "--dz", "0.25"]),
            "lt-corrected",
        ),
        (lt(&["offset", "--dz", "0.25"]), "scattered"),
        (lt(&["scatter", "--grid", "4"]), "100.00"),
        (
            lt(&["fates", "--beta", "-5", "--grid", "4"]),
            "lt-corrected",
        ),
        (lt(&["bottom-heavy"]), "downward"),
        (lt(&["loads", "--gap", "1e-12"]), "e-12"),
    ] {
        let output = squirmers(folder.path(), &arguments);
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success(), "{arguments:?}");
        for line in text.lines() {
            assert!(line.chars().count() <= 80, "{arguments:?}: {line}");
        }
        assert!(text.contains(whole), "{arguments:?}: {text}");
    }
}

#[test]
fn help_is_printed_however_it_is_asked_for() {
    let printed = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_squirmers"))
            .args(arguments)
            .output()
            .unwrap();
        assert!(output.status.success(), "{arguments:?}: {output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let all = printed(&["--help"]);
    for arguments in [&["help"][..], &["help", "--help"], &["help", "-h"]] {
        assert_eq!(printed(arguments), all, "{arguments:?}");
    }
    let of_run = printed(&["run", "--help"]);
    for arguments in [&["help", "run"][..], &["help", "run", "--help"]] {
        assert_eq!(printed(arguments), of_run, "{arguments:?}");
    }
    refused(&["help", "nonsense"], "nonsense");
}

#[test]
fn help_names_the_methods_that_run_and_what_a_time_limit_leaves() {
    let folder = tempfile::tempdir().unwrap();
    let output = squirmers(folder.path(), &["bottom-heavy", "--help"]);
    let text = String::from_utf8(output.stdout).unwrap();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("[default: lt,exact]"), "{text}");
    assert!(text.contains("[default: 1e-8]"), "{text}");
    // Its runs are not kept.
    assert!(!text.contains("continues"), "{text}");
}
