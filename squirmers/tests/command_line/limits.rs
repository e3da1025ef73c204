//! Time limits, interrupted work and many runs.

use super::*;

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
    let listed = columns::listed("report");
    assert!(
        columns::described(out)
            .iter()
            .all(|file| listed.contains(&&**file))
    );
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
