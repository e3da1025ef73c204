//! `CITATION.cff` names the software as it is.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

#[test]
fn the_citation_has_the_version_of_the_packages() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../CITATION.cff");
    let text = std::fs::read_to_string(path).unwrap();
    let version = format!("version: {}", env!("CARGO_PKG_VERSION"));
    assert!(text.lines().any(|line| line == version), "no '{version}'");
}
