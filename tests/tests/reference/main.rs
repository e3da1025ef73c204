//! The package of reference numbers that ships (`fixtures/reference`): whether it is whole, and whether its numbers are those of published
//! tables, closed forms and boundary elements. That `squirmers reference` writes it is a test of that program.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod collisions;
mod descriptor;
mod far_field;
mod loads;
mod mobilities;
mod near_contact;
mod reading;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// The folder of the package.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/reference")
}

fn text_of(name: &str) -> String {
    std::fs::read_to_string(folder().join(name)).unwrap()
}

/// The rows of a data file, by the names of its columns.
fn rows_of(name: &str) -> Vec<HashMap<String, String>> {
    let text = text_of(name);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    reader.deserialize().collect::<Result<_, _>>().unwrap()
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap()
}

/// A number of the package, with how far it may be off.
#[derive(Clone, Copy, Debug)]
struct Known {
    value: f64,
    error: f64,
}

/// Numbers by ratio of the radii, gap (both rounded to nine digits) and name.
struct Numbers(HashMap<(String, String, String), Known>);

impl Numbers {
    fn read(file: &str, value: &str) -> Self {
        let entry = |row: HashMap<String, String>| {
            let ratio = row.get("ratio").map_or(1.0, |ratio| ratio.parse().unwrap());
            let gap = row.get("gap").map_or(1.0, |gap| gap.parse().unwrap());
            let known = Known {
                value: number(&row, value),
                error: number(&row, "error_estimate"),
            };
            (key(ratio, gap, &row["name"]), known)
        };
        Self(rows_of(file).into_iter().map(entry).collect())
    }

    fn find(&self, ratio: f64, gap: f64, name: &str) -> Option<Known> {
        self.0.get(&key(ratio, gap, name)).copied()
    }

    fn at(&self, ratio: f64, gap: f64, name: &str) -> Known {
        let found = self.find(ratio, gap, name);
        found.unwrap_or_else(|| panic!("no {name} at the gap {gap} for the ratio {ratio}"))
    }
}

fn key(ratio: f64, gap: f64, name: &str) -> (String, String, String) {
    (
        format!("{ratio:.8e}"),
        format!("{gap:.8e}"),
        name.to_owned(),
    )
}

static LOADS: LazyLock<Numbers> = LazyLock::new(|| Numbers::read("loads.csv", "value"));

static MOBILITIES: LazyLock<Numbers> = LazyLock::new(|| Numbers::read("mobilities.csv", "value"));

/// The rows of a published table: cells by column.
fn published(text: &str) -> Vec<HashMap<String, String>> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    reader.deserialize().collect::<Result<_, _>>().unwrap()
}
