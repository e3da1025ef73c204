//! `squirmers stress` on the command line: its three forms, that numbers do not depend on threads, and that bad input costs one line.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod program;

use std::path::Path;

use program::squirmers;

const SCENE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../fixtures/scenes/fig6-head-on-dx1.toml"
);

fn text(out: &Path, file: &str) -> String {
    std::fs::read_to_string(out.join(file)).unwrap()
}

/// The files of a command by one thread and by two, which are alike.
fn same_by_threads(arguments: &[&str], files: &[&str]) -> Vec<String> {
    let [one, two] = ["1", "2"].map(|threads| {
        let folder = tempfile::tempdir().unwrap();
        let arguments = [arguments, &["--method", "exact", "--threads", threads]].concat();
        let output = squirmers(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let printed = String::from_utf8(output.stdout).unwrap();
        assert!(
            printed.lines().all(|line| line.chars().count() <= 80),
            "{printed}"
        );
        let texts = files.iter().map(|file| text(folder.path(), file));
        texts.collect::<Vec<_>>()
    });
    assert!(one == two);
    one
}

#[test]
fn stresslets_by_gap_have_a_row_for_each_name() {
    let arguments = [
        "stress", "--gap", "1,0.1", "--modes", "3", "--swirl", "1", "--ratio", "1,0.5",
    ];
    let files = same_by_threads(
        &arguments,
        &["stress.csv", "stress.svg", "stress-ratio0.5.svg"],
    );
    for beginning in [
        "exact,1.0,1.0,XG11,",
        "exact,0.5,0.1,XS21_3,",
        "exact,1.0,0.1,YPBC2_2_1,",
    ] {
        let found = files[0].lines().filter(|line| line.starts_with(beginning));
        assert_eq!(found.count(), 1, "{beginning}");
    }
}

#[test]
fn stresslets_along_a_run_have_a_row_for_each_sample_and_a_picture() {
    let files = same_by_threads(&["stress", SCENE], &["stress-run.csv", "stress-run.svg"]);
    assert!(files[0].starts_with("method,t,gap,s1_xx,"), "{}", files[0]);
    assert!(files[0].lines().count() > 100);
    assert!(files[1].contains("Pair less two lone squirmers"));
}

#[test]
fn val_boundary_elements_have_the_stresslets_of_the_series_within_their_estimate() {
    let folder = tempfile::tempdir().unwrap();
    let output = squirmers(folder.path(), &["stress", "--gap", "0.1"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let csv = text(folder.path(), "stress.csv");
    let rows: Vec<Vec<&str>> = csv
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    let (exact, bem) = rows.split_at(rows.len() / 2);
    for (truth, row) in exact.iter().zip(bem) {
        assert_eq!((truth[0], row[0], truth[3]), ("exact", "bem", row[3]));
        let number = |text: &str| text.parse::<f64>().unwrap();
        let (truth, value) = (number(truth[4]), number(row[4]));
        let error = (value - truth).abs() / truth.abs().max(1.0);
        assert!(error < number(row[5]).max(1e-5), "{row:?}: {truth}");
    }
}

#[test]
fn bad_input_is_refused_in_one_line_and_leaves_nothing() {
    for (arguments, told) in [
        (
            &["stress", "--gap", "0.1", "--method", "lt"][..],
            "singular parts",
        ),
        (&["stress", "--method", "lt-corrected"], "singular parts"),
        (&["stress", "--gap", "-1"], "'-1.0'"),
        (&["stress", "--gap", "0.1", "--modes", "99"], "'99'"),
        (&["stress", "--gap", "0.1", "--ratio", "1000"], "1000"),
        (&["stress", "--modes", "3"], "--gap"),
        (&["stress", SCENE, "--gap", "1"], "--gap"),
        (&["stress", "missing.toml"], "missing.toml"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let output = squirmers(&out, arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(
            error.contains(told) && error.lines().count() == 1,
            "{error}"
        );
        assert!(!out.exists(), "{arguments:?}");
    }
}
