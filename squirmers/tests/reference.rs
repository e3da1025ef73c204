//! `squirmers reference` writes the package that ships, and into no folder that has other files.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Files whose text is the same on every machine.
const TEXTS: [&str; 4] = ["README.md", "CITATION.cff", "LICENSE", "far-field.csv"];

/// Data files, with the columns that say how far the numbers of a row may be off.
const NUMBERS: [(&str, &[&str]); 6] = [
    ("loads.csv", &["error_estimate"]),
    ("mobilities.csv", &["error_estimate"]),
    ("near-contact.csv", &["error_estimate"]),
    (
        "deflections.csv",
        &["error_deg", "min_gap_error", "tau_error"],
    ),
    ("bound-states.csv", &["error_estimate", "rate_error"]),
    ("shares.csv", &[]),
];

fn shipped() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/reference")
}

fn reference(out: &Path) -> Output {
    let cache = tempfile::tempdir().unwrap();
    Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .args(["reference", "--out"])
        .arg(out)
        .arg("--cache")
        .arg(cache.path())
        .output()
        .unwrap()
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// Header and cells.
fn cells(text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let words = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
    let header = words(reader.headers().unwrap());
    let rows = reader.records().map(|record| words(&record.unwrap()));
    (header, rows.collect())
}

/// Whether a column is an error: it has two digits, of which the size alone matters.
fn is_error(column: &str) -> bool {
    column.contains("error")
        || [
            "model_deg",
            "interpolation_deg",
            "integration_deg",
            "truncation_deg",
        ]
        .contains(&column)
}

/// Compares a data file with the one that ships: words as they are, numbers within the errors of both rows.
fn compare(name: &str, errors: &[&str], ours: &str, kept: &str) {
    let ((header, ours), (kept_header, kept)) = (cells(ours), cells(kept));
    assert_eq!(header, kept_header, "{name}");
    assert_eq!(ours.len(), kept.len(), "{name}");
    for (ours, kept) in ours.iter().zip(&kept) {
        let number = |row: &[String], column: &str| -> f64 {
            let place = header.iter().position(|known| known == column).unwrap();
            row[place].parse().unwrap()
        };
        let largest = |row: &[String]| {
            errors
                .iter()
                .map(|column| number(row, column))
                .fold(1e-12, f64::max)
        };
        // A start beside a boundary between outcomes may fall on its other side: two of 10,000.
        let allowed = if name == "shares.csv" {
            2.1e-4
        } else {
            largest(ours) + largest(kept)
        };
        // Newton's method finds a state of a line anywhere on it.
        let of_a_line = header.last().is_some_and(|last| last == "one_of_a_line")
            && kept.last().is_some_and(|cell| cell == "true");
        for ((column, a), b) in header.iter().zip(ours).zip(kept) {
            match (a.parse::<f64>(), b.parse::<f64>()) {
                (Ok(a), Ok(b)) if is_error(column) => {
                    // Roundings differ between machines: where they are all that there is, so does the error.
                    let of_one_size = a < 20.0 * b && b < 20.0 * a;
                    assert!(
                        of_one_size || a.max(b) < 1e-9,
                        "{name}, {column}: {ours:?} {kept:?}"
                    );
                }
                (Ok(a), Ok(b)) => {
                    let allowed = if of_a_line { 1e-2 } else { allowed };
                    let off = (a - b).abs();
                    assert!(off <= allowed, "{name}, {column}: {ours:?} {kept:?}");
                }
                _ => assert_eq!(a, b, "{name}, {column}: {ours:?} {kept:?}"),
            }
        }
    }
}

/// Compares the descriptor with the one that ships; sizes and checksums only of files that have the same bytes.
fn same_descriptor(out: &Path) {
    let parse = |folder: &Path| -> serde_json::Value {
        serde_json::from_str(&read(folder, "datapackage.json")).unwrap()
    };
    let (mut ours, mut kept) = (parse(out), parse(&shipped()));
    let count = kept["resources"].as_array().unwrap().len();
    for place in 0..count {
        let path = kept["resources"][place]["path"]
            .as_str()
            .unwrap()
            .to_owned();
        let text = read(out, &path);
        assert_eq!(ours["resources"][place]["bytes"], text.len(), "{path}");
        if text != read(&shipped(), &path) {
            for of in [&mut ours, &mut kept] {
                for name in ["bytes", "hash"] {
                    of["resources"][place][name].take();
                }
            }
        }
    }
    assert_eq!(ours, kept);
}

#[test]
fn the_package_that_ships_is_the_one_that_the_program_writes() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("package");
    let output = reference(&out);
    assert!(output.status.success(), "{output:?}");
    for name in TEXTS {
        assert!(
            read(&out, name) == read(&shipped(), name),
            "fixtures/reference/{name} is out of date: renew the folder by `squirmers reference --out fixtures/reference`"
        );
    }
    for (name, errors) in NUMBERS {
        compare(name, errors, &read(&out, name), &read(&shipped(), name));
    }
    same_descriptor(&out);
    // A newer package takes the place of an older one: nothing else is there.
    let count = |folder: &Path| std::fs::read_dir(folder).unwrap().count();
    assert_eq!(count(&out), count(&shipped()));
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(
        printed
            .lines()
            .all(|line| line.chars().count() <= 80 || line.ends_with(".json"))
    );
}

#[test]
fn a_folder_with_other_files_is_refused_and_left_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("README.md"), "mine").unwrap();
    std::fs::write(
        folder.path().join("datapackage.json"),
        "{\"name\": \"mine\"}",
    )
    .unwrap();
    let output = reference(folder.path());
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(
        message.contains("--out") && message.contains("other files"),
        "{message}"
    );
    assert_eq!(read(folder.path(), "README.md"), "mine");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn a_place_that_cannot_be_written_is_refused_before_anything_is_computed() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let started = std::time::Instant::now();
    let output = reference(&file.path().join("package"));
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.contains("cannot write"), "{message}");
    assert!(started.elapsed().as_secs() < 5, "it computed first");
}

#[test]
fn the_help_has_an_example() {
    let output = Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .args(["reference", "--help"])
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("squirmers reference --out"), "{text}");
}
