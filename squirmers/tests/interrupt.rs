//! Interrupts from the keyboard: what is finished is kept, and the exit status says what happened.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod start;

use start::start;
use std::path::Path;
use std::process::{Child, Command, Output};
use std::time::{Duration, Instant};

fn interrupt(child: &Child) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(sent.success());
}

/// Waits until `is_there` for a command that is not to end before.
fn wait_for(child: &mut Child, is_there: impl Fn() -> bool) {
    while !is_there() {
        assert!(child.try_wait().unwrap().is_none(), "it ended too early");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// The standard error of a command that was interrupted.
fn interrupted(child: Child) -> String {
    let Output { status, stderr, .. } = child.wait_with_output().unwrap();
    let message = String::from_utf8(stderr).unwrap();
    assert_eq!(status.code(), Some(130), "{message}");
    message
}

fn text(out: &Path, file: &str) -> String {
    std::fs::read_to_string(out.join(file)).unwrap_or_default()
}

/// Chunks that a part file holds whole.
fn finished(part: &str) -> usize {
    part.lines()
        .filter(|line| line.starts_with("done "))
        .count()
}

/// Starts a sweep and interrupts it once pieces are finished; its standard error, or nothing if it was done before the
/// interrupt came.
fn interrupted_between(out: &Path, arguments: &[&str], part: &Path) -> Option<String> {
    let mut child = start(out, arguments);
    let kept = || finished(&std::fs::read_to_string(part).unwrap_or_default());
    while kept() < 2 && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    if child.try_wait().unwrap().is_none() {
        interrupt(&child);
    }
    let Output { status, stderr, .. } = child.wait_with_output().unwrap();
    let message = String::from_utf8(stderr).unwrap();
    if status.success() {
        return None;
    }
    assert_eq!(status.code(), Some(130), "{message}");
    Some(message)
}

/// Interrupts a sweep of so many pieces, which must say how many are left, and goes on with it to the file of a sweep
/// that was not interrupted; `same` is what of a file does not depend on the clock. Whether the sweep was long enough
/// to be interrupted.
fn goes_on(
    arguments: &[&str],
    (of, pieces): (usize, &str),
    same: impl Fn(&str) -> Vec<String>,
) -> bool {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let file = format!("{}.csv", arguments[0]);
    let part = out.join(format!("{file}.part"));
    let Some(message) = interrupted_between(out, arguments, &part) else {
        return false;
    };
    let kept = finished(&std::fs::read_to_string(&part).unwrap());
    assert!(kept >= 2);
    assert!(message.contains(part.to_str().unwrap()), "{message}");
    let left = of - kept;
    if left == 0 && !message.contains("finishing the current pieces") {
        // It came when the last piece was done, while the file was written.
        let kept = format!("interrupted: finished {pieces} are in");
        assert!(message.contains(&kept), "{message}");
        return false;
    }
    let left = format!("interrupted: {left} of {of} {pieces} are left; the same command");
    assert!(message.contains(&left), "{message}");
    let twice = "a second interrupt ends the command at once";
    assert!(message.contains(twice), "{message}");
    assert!(!message.contains("error"), "{message}");
    let whole = tempfile::tempdir().unwrap();
    for out in [out, whole.path()] {
        assert!(start(out, arguments).wait().unwrap().success());
    }
    assert!(!part.exists());
    assert_eq!(same(&text(out, &file)), same(&text(whole.path(), &file)));
    true
}

fn lines(text: &str) -> Vec<String> {
    text.lines().map(str::to_owned).collect()
}

/// The lines without the columns for seconds.
fn lines_but_for_seconds(text: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let seconds = (reader.headers().unwrap().iter()).position(|name| name == "seconds");
    let rows = reader.records().map(|row| {
        let row = row.unwrap();
        let fields = (row.iter().enumerate()).filter(|(column, _)| Some(*column) != seconds);
        fields.map(|(_, field)| field).collect::<Vec<_>>().join(",")
    });
    rows.collect()
}

/// Arguments of lubrication theory.
fn lt<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    [arguments, &["--method", "lt", "--threads", "2"]].concat()
}

#[test]
fn a_map_that_is_interrupted_keeps_its_finished_lines_and_goes_on() {
    // A fast machine may be done with the small one before the interrupt comes.
    let interrupted = [("40", 40), ("120", 120), ("360", 360)].map(|(grid, lines_of_map)| {
        let map = lt(&["scatter", "--beta", "5", "--grid", grid]);
        move || goes_on(&map, (lines_of_map, "lines of the map"), lines)
    });
    assert!(interrupted.iter().any(|is_interrupted| is_interrupted()));
}

#[test]
fn a_sweep_that_is_interrupted_keeps_its_finished_runs_and_goes_on() {
    let interrupted = [("0.01:4:0.01", 400), ("0.01:19:0.01", 1900)].map(|(dx, runs)| {
        let sweep = lt(&["orthogonal", "--beta", "1", "--dx", dx]);
        move || goes_on(&sweep, (runs, "encounters"), lines_but_for_seconds)
    });
    assert!(interrupted.iter().any(|is_interrupted| is_interrupted()));
}

#[test]
fn a_second_interrupt_ends_a_sweep_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    // One run that takes minutes.
    let slow = [
        "head-on", "--method", "bem", "--mesh", "3", "--direct", "--beta", "5", "--dx", "1",
    ];
    let mut child = start(out, &slow);
    wait_for(&mut child, || out.join("head-on.csv.part").exists());
    // The sweep begins a moment after its file is there.
    std::thread::sleep(Duration::from_secs(1));
    interrupt(&child);
    std::thread::sleep(Duration::from_secs(1));
    assert!(
        child.try_wait().unwrap().is_none(),
        "the run under way was given up"
    );
    let began = Instant::now();
    interrupt(&child);
    let message = interrupted(child);
    assert!(began.elapsed() < Duration::from_secs(5));
    assert!(
        message.contains("finishing the current pieces first"),
        "{message}"
    );
}

#[test]
fn a_run_that_is_interrupted_ends_at_once_and_says_where_its_rows_are() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("slow.toml");
    let squirmer = |x: f64, y: f64| {
        format!(
            "[[squirmer]]\nposition = [{x:?}, {y:?}]\norientation = {:?}\nbeta = 5.0\n",
            90.0 - 90.0 * x
        )
    };
    let slow = "hydrodynamics = { model = \"bem\", level = 2, direct = true }\noutput = { sample_interval = 1e-3 }\n";
    std::fs::write(
        &scene,
        format!("{slow}{}{}", squirmer(0.0, -2.0), squirmer(2.0, 2.0)),
    )
    .unwrap();
    let out = folder.path().join("out");
    let rows = || text(&out, "run.csv.partial").lines().count();
    let mut child = start(&out, &["run", scene.to_str().unwrap()]);
    wait_for(&mut child, || rows() >= 2);
    interrupt(&child);
    let message = interrupted(child);
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(
        message.contains("interrupted: finished rows are in '"),
        "{message}"
    );
    assert!(message.contains("run.csv.partial"), "{message}");
    assert!(text(&out, "run.csv.partial").ends_with('\n') && rows() >= 2);
}
