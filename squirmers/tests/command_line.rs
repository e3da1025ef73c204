//! The command line: what it writes, and that bad input costs one clear line and status 2.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

#[cfg(target_os = "linux")]
mod memory;

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
    refused(
        &["loads", "--gap", "1", "--mesh", "-1"],
        "'-1' is not a level",
    );
    let unused = ["loads", "--gap", "1", "--method", "lt", "--mesh", "2"];
    refused(&unused, "no method uses boundary elements");
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
fn a_time_limit_names_what_it_skipped() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["head-on", "--method", "lt", "--time-limit", "0"];
    let output = squirmers(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(75));
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(message.matches("skipped").count(), 5, "{message}");
    let rows = rows(&folder.path().join("head-on.csv"));
    assert!(
        rows.iter()
            .all(|row| &row[4] == "NaN" && &row[8] == "skipped")
    );
}

#[test]
fn a_run_that_fails_has_a_row_and_the_exit_status_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = |command: &str, more: &[&str]| {
        let arguments = [&[command, "--method", "lt"][..], more].concat();
        let output = squirmers(folder.path(), &arguments);
        (
            output.status.code(),
            String::from_utf8(output.stderr).unwrap(),
        )
    };
    for approach in ["head-on", "orthogonal"] {
        let (status, message) = sweep(approach, &["--beta", "1e150,1", "--dx", "1"]);
        assert_eq!(status, Some(1), "{message}");
        assert!(message.contains("1 of the runs failed"), "{message}");
        let rows = rows(&folder.path().join(format!("{approach}.csv")));
        let outcomes: Vec<_> = rows.iter().map(|row| row[8].to_owned()).collect();
        assert_eq!(outcomes, ["failed", "scattered"]);
    }
    let (status, message) = sweep("scatter", &["--beta", "1e150", "--grid", "2"]);
    assert_eq!(status, Some(1), "{message}");
    assert!(folder.path().join("scatter.csv").exists());
    let (status, message) = sweep("fates", &["--beta", "1e150", "--grid", "2"]);
    assert_eq!(status, Some(1), "{message}");
}

#[test]
fn every_command_that_a_time_limit_stops_says_so_and_keeps_a_whole_earlier_file() {
    for (command, file) in [
        ("head-on", "head-on.csv"),
        ("orthogonal", "orthogonal.csv"),
        ("offset", "offset.csv"),
        ("bottom-heavy", "bottom-heavy.csv"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let whole = squirmers(folder.path(), &[command, "--method", "lt"]);
        assert_eq!(whole.status.code(), Some(0), "{command}: {whole:?}");
        let text = || std::fs::read_to_string(folder.path().join(file)).unwrap();
        let earlier = text();
        let arguments = [command, "--method", "lt", "--time-limit", "0"];
        let output = squirmers(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(75), "{command}: {output:?}");
        assert_eq!(text(), earlier, "{command}");
        let again = squirmers(folder.path(), &[command, "--method", "lt"]);
        assert_eq!(again.status.code(), Some(0), "{command}: {again:?}");
        assert!(!folder.path().join(format!("{command}.csv.part")).exists());
    }
}

#[test]
fn a_report_that_the_time_limit_stops_keeps_the_runs_that_are_done() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let all = ["--method", "lt"];
    let done = squirmers(out, &[&["head-on"][..], &all].concat());
    assert!(done.status.success());
    let earlier = std::fs::read_to_string(out.join("head-on.csv")).unwrap();
    let stopped = squirmers(out, &[&["report", "--time-limit", "0"][..], &all].concat());
    assert_eq!(stopped.status.code(), Some(75), "{stopped:?}");
    // A whole file stays; what is new names what is left, and has the part file that goes on from there.
    let text = std::fs::read_to_string(out.join("head-on.csv")).unwrap();
    assert_eq!(text, earlier);
    let left = rows(&out.join("orthogonal.csv"));
    assert!(left.iter().all(|row| &row[8] == "skipped"), "{left:?}");
    assert!(out.join("orthogonal.csv.part").exists());
    let page = std::fs::read_to_string(out.join("index.unfinished.html")).unwrap();
    assert!(!out.join("index.html").exists());
    // All methods take part in them.
    assert!(page.contains("Left out: the hard cases") && !out.join("hard-cases.csv").exists());
}

#[test]
fn a_stopped_sweep_goes_on_with_the_runs_that_are_left() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let sweep = [
        "orthogonal",
        "--method",
        "lt",
        "--beta",
        "1",
        "--dx",
        "1:5:1",
    ];
    let stopped = squirmers(out, &[&sweep[..], &["--time-limit", "0"]].concat());
    assert_eq!(stopped.status.code(), Some(75));
    assert!(out.join("orthogonal.csv.part").exists());
    assert!(!out.join("orthogonal-trajectories.svg").exists());
    assert!(squirmers(out, &sweep).status.success());
    let rows = rows(&out.join("orthogonal.csv"));
    assert_eq!(rows.len(), 5);
    assert!(rows.iter().all(|row| &row[8] == "scattered"));
    assert!(out.join("orthogonal-trajectories.svg").exists());
    assert!(!out.join("orthogonal.csv.part").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_runs_of_a_sweep() {
    let memory = |dx: &str| {
        let folder = tempfile::tempdir().unwrap();
        let peak = memory::peak_memory(folder.path(), &["head-on", "--method", "lt", "--dx", dx]);
        let written = rows(&folder.path().join("head-on.csv")).len();
        (peak, written)
    };
    let (few, _) = memory("1:400:1");
    let (many, written) = memory("1:2400:1");
    assert_eq!(written, 2400);
    // Trajectories alone would be 2000 runs of hundreds of samples.
    let growth = many.saturating_sub(few);
    assert!(growth < 8 << 20, "{few} bytes, then {many}");
}

#[test]
fn a_sweep_of_too_many_runs_has_no_picture_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let sweep = |dx: &str| {
        let output = squirmers(out, &["head-on", "--method", "lt", "--dx", dx]);
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    sweep("1:3:1");
    assert!(out.join("head-on-trajectories.svg").exists());
    let printed = sweep("1:1500:1");
    assert!(
        printed.contains("no picture of the trajectories: 1500 runs"),
        "{printed}"
    );
    assert!(
        printed.contains("500 more rows in head-on.csv"),
        "{printed}"
    );
    // The picture of the earlier sweep would be taken for one of this.
    assert!(!out.join("head-on-trajectories.svg").exists());
    assert!(out.join("head-on-deflection.svg").exists());
    refused(
        &[
            "head-on", "--method", "lt", "--beta", "1:3000:1", "--dx", "1:3000:1",
        ],
        "4000000",
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
fn each_load_by_boundary_elements_has_an_error_estimate_of_its_own_and_few_gaps_need_no_table() {
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
fn distances_at_which_no_angle_can_be_read_are_refused() {
    refused(
        &["head-on", "--method", "lt", "--departure", "2"],
        "--departure",
    );
    refused(
        &["scatter", "--method", "lt", "--departure", "nan"],
        "--departure",
    );
}

#[test]
fn what_is_listed_twice_is_refused() {
    refused(&["head-on", "--dx", "1,2,1", "--method", "lt"], "twice");
    refused(&["head-on", "--dx", "1", "--method", "lt,lt"], "twice");
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
fn a_cache_that_is_no_folder_is_refused() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let path = file.path().to_str().unwrap();
    refused(
        &["loads", "--gap", "1", "--method", "lt", "--cache", path],
        path,
    );
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
fn decimal_commas_are_refused_with_the_point_that_they_stand_for() {
    for option in ["--tol", "--departure", "--time-limit"] {
        refused(&["head-on", option, "1,5"], "decimals take a point, 1.5");
    }
    refused(
        &["cost", "--target", "0,1deg"],
        "decimals take a point, 0.1",
    );
    refused(&["loads", "--gap", "0,1"], "decimals take a point");
    refused(
        &["head-on", "--dx", "0:1:0,5"],
        "range 0:1:0 is empty: the step must lead from the first to the second number; decimals take a point",
    );
}

#[test]
fn counts_that_are_none_are_named_in_words() {
    for (arguments, value) in [
        (&["scatter", "--grid"][..], "1.5"),
        (&["loads", "--gap", "1", "--modes"], "-1"),
        (&["loads", "--gap", "1", "--swirl"], "x"),
        (&["loads", "--gap", "1", "--threads"], "2,0"),
    ] {
        let named = format!("'{value}' is not a whole number");
        refused(&[arguments, &[value]].concat(), &named);
    }
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
