//! The pages that say how answers are given are as the code is.

use super::*;

fn page(name: &str) -> String {
    let file = format!("{}/../docs/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(file).unwrap()
}

#[test]
fn the_page_on_the_judge_lists_the_quantities_as_they_are() {
    let page = page("JUDGE.md");
    for (names, meaning) in KINDS {
        let row = format!("| `{}` | {meaning} |", names.replace(", ", "`, `"));
        assert!(page.contains(&row), "missing in docs/JUDGE.md: {row}");
    }
}

#[test]
fn the_page_on_the_judge_explains_every_key_of_the_header_and_no_other() {
    let page = page("JUDGE.md");
    let keys = page.split("## The header").nth(1).unwrap();
    let keys = keys.split("\n## ").next().unwrap();
    let explained = (keys.lines()).filter_map(|line| line.strip_prefix("| `")?.split('`').next());
    let mut explained: Vec<_> = explained.collect();
    let schema = schema();
    let properties = schema["$defs"]["Header"]["properties"].as_object().unwrap();
    let mut known: Vec<_> = properties.keys().map(String::as_str).collect();
    explained.sort_unstable();
    known.sort_unstable();
    assert_eq!(explained, known);
}

#[test]
fn the_example_stands_in_the_page_in_full() {
    let example = format!("```python\n{}```\n", page("judge_example.py"));
    assert!(page("JUDGE.md").contains(&example));
}

#[test]
fn the_files_in_the_page_are_read_and_its_numbers_to_check_are_exact() {
    let page = page("JUDGE.md");
    let mut files = 0;
    for block in page.split("```csv\n").skip(1) {
        let text = block.split("```").next().unwrap();
        // An excerpt of a matrix lacks most of its entries, and nothing else.
        match Submission::parse(text) {
            Ok(_) => files += 1,
            Err(error) => assert!(error.to_string().contains("give all entries"), "{error}"),
        }
    }
    assert!(files >= 1);
    let exact = Submission::parse(fixtures::EXACT_VELOCITIES).unwrap();
    let far = exact
        .answers()
        .iter()
        .find(|answer| (answer.gap.eps() - 38.0).abs() < 1e-9);
    let checked = page.split("## Check your signs").nth(1).unwrap();
    let checked = checked.split("\n## ").next().unwrap();
    let rows = checked.lines().filter_map(|line| {
        let mut cells = line.strip_prefix("| `")?.split(" | ");
        Some((cells.next()?.trim_end_matches('`'), cells.next()?))
    });
    let mut count = 0;
    for (name, written) in rows {
        let value = far
            .unwrap()
            .values
            .get(Quantity::named(name).unwrap())
            .unwrap();
        let written: f64 = written.parse().unwrap();
        assert!(
            (written - value).abs() < 5e-4 * value.abs(),
            "{name}: {value:e}"
        );
        count += 1;
    }
    assert!(count >= 3);
}

#[test]
fn the_schema_is_what_the_code_makes() {
    assert!(
        page("judge.schema.json") == format!("{:#}\n", schema()),
        "docs/judge.schema.json is out of date: renew it by \
         `cargo run -p squirmers-compare --example schema > docs/judge.schema.json`"
    );
}

#[test]
fn the_schema_has_every_name_and_what_is_written_has_its_keys() {
    let schema = schema();
    let names = &schema["$defs"]["PairAnswer"]["properties"]["values"]["propertyNames"]["enum"];
    assert_eq!(names.as_array().unwrap().len(), quantity::QUANTITIES);
    let of = |name: &str| schema["$defs"][name]["properties"].as_object().unwrap();
    let answer: PairAnswer = serde_json::from_value(serde_json::json!({
        "gap": 1.0, "values": {"x11a": 1.0}, "matrix": [[1.0]], "slip": {"B1_1z": [1.0]}, "error": "none",
    }))
    .unwrap();
    let written = serde_json::to_value(answer).unwrap();
    assert_eq!(written.as_object().unwrap().len(), of("PairAnswer").len());
    assert!(
        written
            .as_object()
            .unwrap()
            .keys()
            .all(|key| of("PairAnswer").contains_key(key))
    );
}
