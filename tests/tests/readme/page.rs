//! What the README repeats.

use super::*;

/// Lines of the table and entries of the list, each without line breaks.
fn statements(text: &str) -> Vec<String> {
    let section = text.split_once("## What was found\n").unwrap().1;
    let section = section.split("\n## ").next().unwrap();
    let rows = section
        .lines()
        .filter(|line| line.starts_with("| "))
        .skip(1);
    let entries = section.split("\n- ").skip(1);
    let entries = entries.map(|entry| entry.split("\n\n").next().unwrap());
    (rows.chain(entries))
        .map(|one| one.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect()
}

#[test]
fn readme_repeats_what_the_findings_say() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../README.md");
    let readme = std::fs::read_to_string(path).unwrap();
    let findings = words_of("docs/FINDINGS.md");
    let statements = statements(&readme);
    // Four rows and four findings.
    assert_eq!(statements.len(), 8, "{statements:#?}");
    for statement in statements {
        assert!(
            findings.contains(&statement),
            "docs/FINDINGS.md lacks: {statement}"
        );
    }
}

#[test]
fn readme_shows_the_example_as_it_is() {
    let read = |file: &str| {
        let path = format!("{}/../{file}", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(path).unwrap()
    };
    let example = read("compare/examples/one_collision.rs");
    let (_, code) = example.split_once("\n\n").unwrap();
    assert!(read("README.md").contains(&format!("```rust\n{}\n```", code.trim_end())));
}
