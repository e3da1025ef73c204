//! Tests of the page with invented content.

use super::table::displayed;
use super::{Figure, MethodCost, Page, Provenance, Section, Table, render};
use compare::{Method, OffsetRow};

fn rows() -> Vec<OffsetRow> {
    [0.0, 0.1]
        .map(|dz| OffsetRow {
            case: "head-on".to_owned(),
            method: Method::Lt,
            beta: 5.0,
            dx: 1.0,
            dz,
            change1_deg: 1.23456789,
            change2_deg: f64::NAN,
            min_gap: 0.00123456,
            outcome: "scattered".to_owned(),
            outcome_in_plane: "scattered".to_owned(),
        })
        .into()
}

fn page() -> Page {
    let svg = "<svg width=\"400\" height=\"300\" xmlns=\"http://www.w3.org/2000/svg\"></svg>";
    let table = Table::from_rows("Offsets", "offset.csv", &rows()).expect("flat rows");
    Page {
        title: "Two squirmers".to_owned(),
        lead: vec!["1 < 2 & 3".to_owned()],
        sections: vec![Section {
            id: "offset".to_owned(),
            title: "Offset out of the plane".to_owned(),
            finding: "Offsets matter.".to_owned(),
            prose: vec!["Prose.".to_owned()],
            figures: vec![Figure {
                svg: svg.to_owned(),
                caption: "Caption.".to_owned(),
            }],
            tables: vec![table],
        }],
        costs: vec![MethodCost {
            method: "bem".to_owned(),
            limit: "noise, not tolerance".to_owned(),
            error_at_contact: vec![(0.01, 0.003)],
            interpolation_error: f64::NAN,
            ..MethodCost::default()
        }],
        notes: vec!["A failure.".to_owned()],
        provenance: Provenance {
            command: "squirmers report --out out".to_owned(),
            ..Provenance::default()
        },
    }
}

#[test]
fn page_holds_every_section() {
    let html = render(&page());
    for part in [
        "<!DOCTYPE html>",
        "<section id=\"offset\">",
        "<section id=\"cost\">",
        "<section id=\"notes\">",
        "Caption.",
        "A failure.",
        "error_at_gap_0.01",
        "squirmers report --out out",
        "1 &lt; 2 &amp; 3",
        "download=\"offset.csv\"",
    ] {
        assert!(html.contains(part), "{part}");
    }
}

#[test]
fn the_page_begins_with_what_was_found_and_links_to_where() {
    let html = render(&page());
    let (first, rest) = html
        .split_once("aria-label=\"Contents\"")
        .expect("contents");
    let link = "<a href=\"#offset\">Offset out of the plane</a>: Offsets matter.";
    assert!(first.contains(link), "{first}");
    assert!(rest.contains("<p class=\"finding\">Offsets matter.</p>"));
    let mut without = page();
    without.sections[0].finding.clear();
    assert!(!render(&without).contains("id=\"findings\""));
}

#[test]
fn a_long_table_is_shown_when_it_is_asked_for() {
    let mut page = page();
    assert!(!render(&page).contains("<details>"));
    let long: Vec<_> = (0..9).flat_map(|_| rows()).collect();
    page.sections[0].tables[0] =
        Table::from_rows("Offsets", "offset.csv", &long).expect("flat rows");
    let html = render(&page);
    assert!(html.contains("<details><summary>Show the 18 rows</summary>"));
    assert!(html.contains("download=\"offset.csv\""));
}

#[test]
fn a_table_too_large_for_the_page_is_the_file_beside_it() {
    let mut page = page();
    page.sections[0].tables[0].csv = "1,2\n".repeat(300_000);
    let html = render(&page);
    assert!(html.len() < 100_000);
    assert!(html.contains("<a href=\"offset.csv\">offset.csv</a>"));
}

#[test]
fn page_loads_nothing() {
    let html = render(&page()).replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    assert!(!html.contains("http://") && !html.contains("https://"));
    assert!(!html.contains("<script") && !html.contains("@import"));
}

#[test]
fn fields_are_rounded_for_reading_only() {
    assert_eq!(displayed("change1_deg", "NaN"), "–");
    assert_eq!(displayed("change1_deg", "-1.23456789"), "−1.2346");
    assert_eq!(displayed("change1_deg", "-1e-9"), "0.0000");
    assert_eq!(displayed("min_gap", "0.00123456"), "0.0012346");
    assert_eq!(displayed("min_gap", "1.5e-7"), "1.5e−7");
    assert_eq!(displayed("dx", "10.0"), "10");
    assert_eq!(displayed("beta", "-1.0"), "−1");
    assert_eq!(displayed("steps", "140"), "140");
    assert_eq!(displayed("seconds", "0.0123456"), "0.0123");
    assert_eq!(displayed("method", "lt-corrected"), "lt-corrected");
    let html = render(&page());
    assert!(html.contains("<td class=\"number\">–</td>"));
    let table = Table::from_rows("", "offset.csv", &rows()).expect("flat rows");
    assert!(table.csv.contains("1.23456789,NaN,0.00123456"));
}

#[test]
fn fields_with_commas_are_quoted() {
    let table = MethodCost::table(&page().costs);
    assert!(table.csv.contains("\"noise, not tolerance\""));
    assert_eq!(table.records[0].len(), table.headers.len());
}

#[test]
fn long_texts_wrap_and_print_is_not_cut_off() {
    let html = render(&page());
    let cells = html.lines().find(|line| line.starts_with("th, td {"));
    assert!(cells.is_some_and(|rule| !rule.contains("nowrap")));
    let print = html.split_once("@media print").expect("a print style").1;
    assert!(print.contains("overflow: visible") && print.contains("break-inside: avoid"));
}
