//! Families swept along parameters of their own, whole and in shares.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Two squirmers that differ in everything that may differ.
const FAMILY: &str = r#"
hydrodynamics = "lubrication"
repulsion = "paper"

[parameters]
turn = 0.0            # degrees
speed = 1.0
weight = 0.5
heading = "90 + turn"

[[squirmer]]
position = [-1.3, "0.2*sin(turn)"]
orientation = "heading"
swimming_speed = "speed"
beta = "4 - speed"
bottom_heaviness = "weight"

[[squirmer]]
position = [1.3, 0.0]
orientation = 100.0
modes = [1.5, -3.0, "speed/3"]

[gravity]
direction = ["sin(turn)", -1.0]

[run]
end_time = 40.0
tolerance = 1e-10
"#;

/// Three axes, 3 x 12 x 40 points.
const AXES: [&str; 6] = [
    "--vary",
    "speed=0.5:1.5:0.5",
    "--vary",
    "weight=0.01:100:log:12",
    "--vary",
    "turn=-78:78:4",
];

fn squirmers(arguments: &[&str], out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_squirmers"));
    command.args(arguments).arg("--out").arg(out);
    command.stdout(Stdio::null());
    command
}

fn family(folder: &Path) -> PathBuf {
    let path = folder.join("family.toml");
    std::fs::write(&path, FAMILY).unwrap();
    path
}

fn sweep(family: &Path, out: &Path, more: &[&str]) -> Command {
    let mut command = squirmers(&["sweep"], out);
    command.arg(family).args(AXES).args(more);
    command
}

fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn rows(folder: &Path) -> Vec<csv::StringRecord> {
    let mut reader = csv::Reader::from_path(folder.join("sweep.csv")).unwrap();
    reader.records().map(Result::unwrap).collect()
}

#[test]
fn a_family_of_ones_own_is_swept_along_three_axes() {
    let folder = tempfile::tempdir().unwrap();
    let (family, out) = (family(folder.path()), folder.path().join("out"));
    let output = sweep(&family, &out, &[]).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let header = std::fs::read_to_string(out.join("sweep.csv")).unwrap();
    assert_eq!(
        header.lines().next().unwrap(),
        "speed,weight,turn,method,deflection1_deg,deflection2_deg,min_gap,tau,outcome,steps"
    );
    let rows = rows(&out);
    assert_eq!(rows.len(), 3 * 12 * 40);
    assert_eq!(
        (&rows[0][0], &rows[0][1], &rows[0][2]),
        ("0.5", "0.01", "-78.0")
    );
    assert_eq!((&rows[1][1], &rows[1][2]), ("0.01", "-74.0"));
    // One row is the run of the scene that the file gives with these values.
    let text = [("turn", "-74.0"), ("speed", "0.5"), ("weight", "0.01")]
        .into_iter()
        .fold(FAMILY.to_owned(), |text, (name, value)| {
            let (old, new) = parameter(name, value);
            assert!(text.contains(&old), "{old}");
            text.replace(&old, &new)
        });
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, text).unwrap();
    let single = folder.path().join("single");
    let mut run = squirmers(&["run"], &single);
    assert!(run.arg(&scene).output().unwrap().status.success());
    let text = std::fs::read_to_string(single.join("run.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    for (column, name) in [
        (4, "deflection1_deg"),
        (5, "deflection2_deg"),
        (6, "min_gap"),
        (7, "contact_time"),
    ] {
        let found: f64 = rows[1][column].parse().unwrap();
        assert_eq!(
            found.to_bits(),
            summary[name].as_f64().unwrap().to_bits(),
            "{name}"
        );
    }
    assert_eq!(&rows[1][8], summary["outcome"].as_str().unwrap());
    assert_eq!(rows[1][9], summary["steps"].to_string());
}

/// The line of a parameter in the family, and the one with another value.
fn parameter(name: &str, value: &str) -> (String, String) {
    let line = (FAMILY.lines())
        .find(|line| line.starts_with(&format!("{name} = ")))
        .unwrap();
    (line.to_owned(), format!("{name} = {value}"))
}

#[test]
fn shares_that_were_killed_and_run_again_merge_to_the_file_of_the_whole() {
    const SHARES: usize = 7;
    const KILLED: [usize; 3] = [2, 5, 7];
    let folder = tempfile::tempdir().unwrap();
    let family = family(folder.path());
    let whole = folder.path().join("whole");
    let output = sweep(&family, &whole, &["--method", "lt"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let mut folders = Vec::new();
    for number in 1..=SHARES {
        let out = folder.path().join(format!("share-{number}"));
        let partition = format!("{number}/{SHARES}");
        // By one thread and by two.
        let threads = (1 + number % 2).to_string();
        let more = [
            "--method",
            "lt",
            "--partition",
            &partition,
            "--threads",
            &threads,
        ];
        if KILLED.contains(&number) {
            let mut child = sweep(&family, &out, &more).spawn().unwrap();
            let part = out.join("sweep.csv.part");
            let begun = Instant::now();
            while std::fs::read_to_string(&part).map_or(0, |text| text.matches("\ndone ").count())
                < 5
            {
                assert!(begun.elapsed() < Duration::from_secs(120), "no row is kept");
                std::thread::sleep(Duration::from_millis(1));
            }
            child.kill().unwrap();
            child.wait().unwrap();
            assert!(
                !out.join("sweep.json").exists(),
                "it ended before it was killed"
            );
            let refused = squirmers(&["merge"], &folder.path().join("early"))
                .arg(&out)
                .output()
                .unwrap();
            assert_eq!(refused.status.code(), Some(2));
            assert!(
                message(&refused).contains("not finished"),
                "{}",
                message(&refused)
            );
        }
        let output = sweep(&family, &out, &more).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", message(&output));
        folders.push(out);
    }
    folders.reverse();
    let merged = folder.path().join("merged");
    let output = squirmers(&["merge"], &merged)
        .args(&folders)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let [found, expected] =
        [&merged, &whole].map(|folder| std::fs::read(folder.join("sweep.csv")).unwrap());
    assert!(found == expected, "the merged file differs");
}

#[test]
fn what_is_wrong_with_a_sweep_is_told_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let family = family(folder.path());
    let out = folder.path().join("out");
    let file = family.to_str().unwrap();
    for (arguments, told) in [
        (vec![file, "--vary", "dx=1,2"], "turn, speed, weight"),
        (vec![file, "--vary", "speed"], "NAME=LIST"),
        (vec![file, "--vary", "speed=1:2:log:x"], "'x'"),
        (vec![file, "--vary", "speed=1", "--partition", "3/2"], "3/2"),
        (
            vec![file, "--vary", "speed=1", "--partition", "1/9"],
            "1 rows",
        ),
        (vec![file, "--tol", "1"], "--tol"),
        (vec!["no-such-family"], "no-such-family"),
    ] {
        let mut command = squirmers(&["sweep"], &out);
        let output = command.args(&arguments).output().unwrap();
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert_eq!(said.trim().lines().count(), 1, "{said}");
        assert!(said.contains(told), "{arguments:?}: {said}");
        assert!(!out.join("sweep.csv").exists());
    }
}

#[test]
fn the_papers_families_are_part_of_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let given = ["sweep", "opposed", "--vary", "dx=1,2", "--method", "lt"];
    let output = squirmers(&given, &out).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let known = folder.path().join("known");
    let given = ["head-on", "--dx", "1,2", "--method", "lt", "--beta", "5"];
    assert!(squirmers(&given, &known).output().unwrap().status.success());
    let mut reader = csv::Reader::from_path(known.join("head-on.csv")).unwrap();
    let encounters: Vec<_> = reader.records().map(Result::unwrap).collect();
    for (row, encounter) in rows(&out).iter().zip(&encounters) {
        // dx, then method, deflections, smallest gap, tau, outcome and steps.
        assert_eq!(row[0], encounter[2]);
        let found: Vec<_> = row.iter().skip(2).collect();
        let expected: Vec<_> = encounter.iter().skip(4).take(6).collect();
        assert_eq!(found, expected);
    }
    assert_eq!(encounters.len(), 2);
}
