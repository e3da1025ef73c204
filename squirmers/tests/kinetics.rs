//! Collisions in three dimensions and their integrals: files, shares, resuming, refusals.

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

fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Runs a command that succeeds, and returns what it printed.
fn done(out: &Path, arguments: &[&str]) -> String {
    let output = squirmers(out, arguments);
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    String::from_utf8(output.stdout).unwrap()
}

/// Rows as maps from column to field.
fn rows(path: &Path) -> Vec<std::collections::HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

fn number(row: &std::collections::HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap()
}

const MAP: [&str; 7] = [
    "collisions",
    "--beta",
    "-5,1",
    "--count",
    "60",
    "--method",
    "lt,exact",
];

#[test]
fn shares_of_a_map_of_collisions_merge_to_the_bytes_of_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    let printed = done(&whole, &MAP);
    assert!(
        printed.lines().all(|line| line.chars().count() <= 80),
        "{printed}"
    );
    let mut shares = Vec::new();
    for number in 1..=3 {
        let share = folder.path().join(format!("share-{number}"));
        let partition = format!("{number}/3");
        let mut arguments = MAP.to_vec();
        // Stopped before its first row, and gone on with by another number of threads.
        let stopped = [
            &arguments[..],
            &["--partition", &partition, "--time-limit", "0"],
        ]
        .concat();
        assert_eq!(squirmers(&share, &stopped).status.code(), Some(75));
        arguments.extend(["--partition", &partition, "--threads", "1"]);
        done(&share, &arguments);
        shares.push(share);
    }
    let merged = folder.path().join("merged");
    let names: Vec<_> = shares.iter().map(|share| share.to_str().unwrap()).collect();
    done(&merged, &[&["merge"], &names[..]].concat());
    let [one, other] =
        [&whole, &merged].map(|of| std::fs::read(of.join("collisions.csv")).unwrap());
    assert!(one == other, "the merged file differs");
    // A share of something else is refused.
    let other = folder.path().join("other");
    let arguments = [
        &["collisions", "--by", "contact"],
        &MAP[1..],
        &["--partition", "3/3"],
    ]
    .concat();
    done(&other, &arguments);
    let mixed = [names[0], names[1], other.to_str().unwrap()];
    let refused = squirmers(
        &folder.path().join("none"),
        &[&["merge"], &mixed[..]].concat(),
    );
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        message(&refused).contains("the family differs"),
        "{}",
        message(&refused)
    );
}

#[test]
fn a_row_of_a_map_says_what_came_in_and_out() {
    let folder = tempfile::tempdir().unwrap();
    for by in ["impact", "contact"] {
        let arguments = [
            "collisions",
            "--by",
            by,
            "--beta",
            "1",
            "--count",
            "40",
            "--method",
            "lt",
        ];
        done(folder.path(), &arguments);
        let rows = rows(&folder.path().join("collisions.csv"));
        assert_eq!(rows.len(), 40);
        for row in &rows {
            assert_eq!(row["outcome"], "scattered");
            for k in ["1", "2"] {
                let out = ["x", "y", "z"].map(|axis| number(row, &format!("out{k}_{axis}")));
                let length: f64 = out.iter().map(|x| x * x).sum();
                assert!((length - 1.0).abs() < 1e-8);
                // The incoming heading, from the angle between the two.
                let half = 0.5 * number(row, "between_deg").to_radians();
                let x = if k == "1" { half.sin() } else { -half.sin() };
                let cosine = out[0] * x + out[1] * half.cos();
                let turn = number(row, &format!("turn{k}_deg")).to_radians();
                assert!((cosine - turn.cos()).abs() < 1e-8);
            }
            assert!(number(row, "impact") <= 3.0 && number(row, "min_gap") <= 1.0);
            let closing =
                ["polar1_deg", "polar2_deg"].map(|name| number(row, name).to_radians().cos());
            assert!(closing.iter().sum::<f64>() > 0.0);
        }
    }
}

const INTEGRALS: [&str; 11] = [
    "kinetics",
    "--beta",
    "-1,1",
    "--count",
    "32",
    "--replications",
    "4",
    "--impact",
    "3,4",
    "--method",
    "lt,exact",
];

#[test]
fn integrals_have_the_same_bits_by_any_number_of_threads_and_after_a_stop() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two] = ["one", "two"].map(|name| folder.path().join(name));
    let printed = done(&one, &[&INTEGRALS[..], &["--threads", "1"]].concat());
    assert!(
        printed.lines().all(|line| line.chars().count() <= 80),
        "{printed}"
    );
    let stopped = [&INTEGRALS[..], &["--time-limit", "0"]].concat();
    assert_eq!(squirmers(&two, &stopped).status.code(), Some(75));
    assert!(two.join("kinetics.csv.part").exists());
    done(&two, &INTEGRALS);
    assert!(!two.join("kinetics.csv.part").exists());
    for file in ["kinetics.csv", "kinetics-ratios.csv", "kinetics.svg"] {
        let [one, two] = [&one, &two].map(|of| std::fs::read(of.join(file)).unwrap());
        assert!(one == two, "{file}");
    }
    let rows = rows(&one.join("kinetics.csv"));
    assert_eq!(rows.len(), 2 * 2 * 2);
    for row in &rows {
        let shares = ["parting", "bound", "contact", "failed"].map(|name| number(row, name));
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let (rotation, translation) = (number(row, "rotation"), number(row, "translation"));
        assert!((6.0 * rotation * translation - 1.0).abs() < 1e-12);
        assert!(number(row, "rotation_error") > 0.0);
    }
    // Lubrication theory knows nothing of pairs beyond the gap 1: no rate depends on the larger impact parameter.
    for column in ["rotation", "growth", "displacement"] {
        let [near, far] = [0, 1].map(|k| number(&rows[k], column));
        assert!((near - far).abs() < 1e-12, "{column}: {near} {far}");
    }
}

#[test]
fn one_beta_against_the_impact_parameter_and_one_point_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    for impact in ["3", "3,6"] {
        let arguments = [
            "kinetics",
            "--beta",
            "0",
            "--count",
            "16",
            "--replications",
            "2",
            "--impact",
            impact,
            "--method",
            "lt",
        ];
        done(folder.path(), &arguments);
        let svg = std::fs::read_to_string(folder.path().join("kinetics.svg")).unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("no data"), "{impact}");
        assert_eq!(svg.contains("largest impact parameter"), impact == "3,6");
    }
}

#[test]
fn bad_input_is_one_line_and_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, named) in [
        (&["kinetics", "--impact", "0"][..], "--impact '0'"),
        (&["kinetics", "--impact", "3,-1"], "--impact"),
        (&["kinetics", "--count", "0"], "--count '0'"),
        (&["kinetics", "--count", "70000"], "65536"),
        (&["kinetics", "--replications", "1"], "--replications '1'"),
        (&["kinetics", "--beta", "inf"], "inf"),
        (&["kinetics", "--tol", "1"], "--tol"),
        (&["collisions", "--count", "0"], "--count '0'"),
        (&["collisions", "--impact", "-3"], "--impact"),
        (
            &["collisions", "--by", "contact", "--impact", "2"],
            "--impact '2'",
        ),
        (&["collisions", "--by", "speed"], "speed"),
        (&["collisions", "--partition", "3/2"], "3/2"),
        (
            &[
                "collisions",
                "--beta",
                "0",
                "--count",
                "2",
                "--method",
                "lt",
                "--partition",
                "1/3",
            ],
            "--partition '1/3'",
        ),
    ] {
        let output = squirmers(folder.path(), arguments);
        let message = message(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert_eq!(message.trim_end().lines().count(), 1, "{message}");
        assert!(message.contains(named), "{arguments:?}: {message}");
        assert_eq!(
            std::fs::read_dir(folder.path()).unwrap().count(),
            0,
            "{arguments:?}"
        );
    }
}
