//! The descriptor and the pages fit the files beside them.

use serde_json::Value;
use sha2::{Digest, Sha256};

use super::*;
use compare::columns::{FILES, names};

fn descriptor() -> Value {
    serde_json::from_str(&text_of("datapackage.json")).unwrap()
}

/// The text of a member.
fn word<'a>(of: &'a Value, name: &str) -> &'a str {
    of[name].as_str().unwrap()
}

#[test]
fn every_file_has_the_bytes_and_the_checksum_that_the_package_says() {
    let descriptor = descriptor();
    let resources = descriptor["resources"].as_array().unwrap();
    assert_eq!(resources.len(), 7);
    for resource in resources {
        let path = word(resource, "path");
        let bytes = std::fs::read(folder().join(path)).unwrap();
        assert_eq!(resource["bytes"], bytes.len(), "{path}");
        let digest = Sha256::digest(&bytes);
        let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(word(resource, "hash"), format!("sha256:{digest}"), "{path}");
    }
    // Nothing but these and the pages is there.
    let entries = std::fs::read_dir(folder()).unwrap();
    let found = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut found: Vec<_> = found.collect();
    found.sort();
    let mut expected: Vec<_> = (resources.iter().map(|of| word(of, "path")))
        .chain(["README.md", "CITATION.cff", "LICENSE", "datapackage.json"])
        .collect();
    expected.sort_unstable();
    assert_eq!(found, expected);
}

#[test]
fn every_field_is_a_column_with_cells_of_its_type() {
    for resource in descriptor()["resources"].as_array().unwrap() {
        let path = word(resource, "path");
        let listed = FILES
            .iter()
            .find(|of| of.name == format!("reference/{path}"));
        let listed = listed.unwrap_or_else(|| panic!("{path} is not in docs/COLUMNS.md"));
        let fields = resource["schema"]["fields"].as_array().unwrap();
        let of_fields: Vec<_> = fields.iter().map(|field| word(field, "name")).collect();
        let text = text_of(path);
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        assert_eq!(*reader.headers().unwrap(), of_fields, "{path}");
        assert_eq!(of_fields, names(listed.columns), "{path}");
        for (field, column) in fields.iter().zip(listed.columns) {
            assert_eq!(word(field, "unit"), column.unit);
            assert_eq!(word(field, "description"), column.doc);
        }
        let mut rows = 0;
        for record in reader.records() {
            rows += 1;
            for (cell, field) in record.unwrap().iter().zip(fields) {
                let fits = match word(field, "type") {
                    "integer" => cell.parse::<i64>().is_ok(),
                    "number" => cell.parse::<f64>().is_ok_and(f64::is_finite),
                    "boolean" => ["true", "false"].contains(&cell),
                    "string" => !cell.is_empty(),
                    other => panic!("{path}: type {other}"),
                };
                assert!(fits, "{path}, {}: {cell}", word(field, "name"));
            }
        }
        let line = format!("| `{path}` | {} | {rows} |", word(resource, "title"));
        assert!(text_of("README.md").contains(&line), "{line}");
    }
}

#[test]
fn version_names_and_licences_are_those_of_the_program() {
    let (descriptor, citation) = (descriptor(), text_of("CITATION.cff"));
    let version = env!("CARGO_PKG_VERSION");
    assert_eq!(word(&descriptor, "version"), version);
    assert_eq!(word(&descriptor, "profile"), "tabular-data-package");
    assert!(descriptor.get("created").is_none(), "the same each time");
    assert!(citation.contains(&format!("\nversion: {version}\n")));
    assert!(citation.contains(&format!("\ntitle: {}\n", word(&descriptor, "title"))));
    assert_eq!(env!("CARGO_PKG_LICENSE"), "MIT OR Apache-2.0");
    assert!(text_of("LICENSE").contains("SPDX-License-Identifier: MIT OR Apache-2.0"));
    let licenses = descriptor["licenses"].as_array().unwrap();
    for (license, name) in licenses.iter().zip(["MIT", "Apache-2.0"]) {
        assert_eq!(word(license, "name"), name);
        assert!(citation.contains(&format!("\n  - {name}\n")));
    }
    let author = word(&descriptor["contributors"][0], "title");
    assert!(citation.contains(&format!("\nauthors:\n  - name: {author}\n")));
}

#[test]
fn the_package_is_small() {
    let entries = std::fs::read_dir(folder()).unwrap();
    let bytes: u64 = (entries.map(|entry| entry.unwrap().metadata().unwrap().len())).sum();
    assert!(bytes < 600_000, "{bytes}");
}
