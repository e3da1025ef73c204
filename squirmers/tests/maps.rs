//! Maps over the incoming angles: what they write, that they go on after a stop, and that bad input
//! costs one clear line.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

#[cfg(target_os = "linux")]
mod memory;

mod program;

use std::path::Path;
use std::process::{Command, Output};

use program::squirmers;

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
    let stopped = more.contains(&"--time-limit");
    let status = if stopped { 75 } else { 0 };
    assert_eq!(output.status.code(), Some(status), "{output:?}");
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
    let pieces = pieces_of_a_killed_map();
    let torn = format!("{key}{}{}{}", pieces[0], pieces[1], &pieces[2][..70]);
    std::fs::write(out.join("scatter.csv.part"), torn).unwrap();
    let third = map(out, "scatter", "2", &["--time-limit", "0"]);
    let message = String::from_utf8(third.stderr).unwrap();
    assert!(message.contains("14 of 16 lines"), "{message}");
    map(out, "scatter", "1", &[]);
    assert_eq!(text(out, "scatter.csv"), text(whole.path(), "scatter.csv"));
    assert!(!out.join("scatter.csv.part").exists());
}

/// Finished pieces of the map, at least three, as they are when it is killed.
fn pieces_of_a_killed_map() -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let arguments = [&["scatter"][..], &MAP, &["2"]].concat();
    let part = loop {
        let mut child = Command::new(env!("CARGO_BIN_EXE_squirmers"))
            .args(&arguments)
            .arg("--out")
            .arg(out)
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        while finished(out) < 3 && child.try_wait().unwrap().is_none() {}
        let part = std::fs::read_to_string(out.join("scatter.csv.part"));
        child.kill().unwrap();
        child.wait().unwrap();
        let part = part.unwrap_or_default();
        if part.matches("\ndone ").count() >= 3 {
            break part;
        }
    };
    let (_, rest) = part.split_once('\n').unwrap();
    let mut pieces = vec![String::new()];
    for line in rest.split_inclusive('\n') {
        pieces.last_mut().unwrap().push_str(line);
        if line.starts_with("done ") {
            pieces.push(String::new());
        }
    }
    pieces
}

/// Leaves a part file with one finished line of the map; its text.
fn interrupt_a_map(out: &Path) -> String {
    map(out, "scatter", "2", &["--time-limit", "0"]);
    let key = text(out, "scatter.csv.part");
    let kept = format!("{key}{}", pieces_of_a_killed_map()[0]);
    std::fs::write(out.join("scatter.csv.part"), &kept).unwrap();
    kept
}

#[test]
fn a_piece_of_an_interrupted_map_that_was_edited_is_computed_again() {
    let whole = tempfile::tempdir().unwrap();
    map(whole.path(), "scatter", "2", &[]);
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    map(out, "scatter", "2", &["--time-limit", "0"]);
    let key = text(out, "scatter.csv.part");
    let pieces = pieces_of_a_killed_map();
    let edited = pieces[1].replacen("scattered", "standoff", 1);
    assert_ne!(edited, pieces[1]);
    let part = format!("{key}{}{edited}", pieces[0]);
    std::fs::write(out.join("scatter.csv.part"), part).unwrap();
    let done = map(out, "scatter", "2", &[]);
    let message = String::from_utf8(done.stderr).unwrap();
    assert!(
        message.contains("1 finished pieces were edited"),
        "{message}"
    );
    assert_eq!(text(out, "scatter.csv"), text(whole.path(), "scatter.csv"));
}

#[test]
fn an_interrupted_map_is_not_thrown_away_by_another_one_unless_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let kept = interrupt_a_map(out);
    let other = ["scatter", "--beta", "1", "--grid", "6", "--method", "lt"];
    let refused = squirmers(out, &other);
    let message = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(
        message.contains("--fresh") && message.contains("scatter.csv.part"),
        "{message}"
    );
    assert_eq!(text(out, "scatter.csv.part"), kept);
    let fresh = squirmers(out, &[&other[..], &["--fresh"]].concat());
    let message = String::from_utf8(fresh.stderr).unwrap();
    assert!(
        fresh.status.success() && message.contains("is deleted"),
        "{message}"
    );
    assert_eq!(text(out, "scatter.csv").lines().count(), 1 + 36);
}

#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_number_of_maps() {
    let of = |beta: &str| {
        let folder = tempfile::tempdir().unwrap();
        let map = [
            "scatter", "--method", "lt", "--grid", "60", "--beta", beta, "--tol", "1e-4",
        ];
        let peak = memory::peak_memory(folder.path(), &map);
        (peak, text(folder.path(), "scatter.csv").lines().count())
    };
    let (few, _) = of("-1:1:1");
    let (many, lines) = of("-12:12:1");
    assert_eq!(lines, 1 + 25 * 3600);
    // The text of the 22 maps more is 10 MB, and their rows are more than that.
    let growth = many.saturating_sub(few);
    assert!(growth < 4 << 20, "{few} bytes, then {many}");
}

#[test]
fn a_report_refuses_another_command_s_unfinished_map_before_it_computes_anything() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let kept = interrupt_a_map(out);
    let refused = squirmers(out, &["report", "--method", "lt,exact"]);
    let message = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(message.contains("--fresh"), "{message}");
    assert_eq!(
        std::fs::read_dir(out).unwrap().count(),
        1,
        "nothing else is written"
    );
    assert_eq!(text(out, "scatter.csv.part"), kept);
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
fn bound_states_that_one_model_lacks_are_printed_with_whole_names() {
    let folder = tempfile::tempdir().unwrap();
    let method = "lt-corrected,exact";
    let trust = ["trust", "--beta", "5", "--grid", "4", "--method", method];
    let output = squirmers(folder.path(), &trust);
    assert!(output.status.success(), "{output:?}");
    let printed = String::from_utf8(output.stdout).unwrap();
    let examples = csv_rows(&text(folder.path(), "trust-examples.csv"));
    assert!(!examples.is_empty());
    for line in printed.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    for row in examples {
        let [judged, its, exact] = [0, 2, 3].map(|column| row[column].to_owned());
        let is_whole = |line: &&str| {
            let words: Vec<_> = line.split_whitespace().collect();
            words.starts_with(&[&judged, "5", &its, &exact])
        };
        assert!(printed.lines().any(|line| is_whole(&line)), "{printed}");
    }
}

/// The rows of CSV text.
fn csv_rows(text: &str) -> Vec<csv::StringRecord> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    reader.records().map(Result::unwrap).collect()
}
