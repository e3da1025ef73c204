//! Rows of a judged copy of exact loads.

use approx::assert_relative_eq;

use super::*;
use crate::judge::tests::{file, judged};

#[test]
fn rows_have_each_error_the_largest_of_each_quantity_and_what_else_was_found() {
    // X11A 10 % too large at the smaller gap, and 1 % at the larger one.
    let mut card = judged(file("", &[0.1, 5.0], |gap, name, value| match name {
        "X11A" if gap < 1.0 => 1.1 * value,
        "X11A" => 1.01 * value,
        _ => value,
    }));
    card.seconds_per_gap = Some(0.5);
    card.exact_seconds_per_gap = 0.25;
    card.definite = vec![(0.1, 0.3)];
    card.third_law = vec![("a + b".to_owned(), 0.2)];
    let rows = card.rows();
    let of = |measure: &str, case: &str| {
        let found: Vec<&JudgeRow> = rows
            .iter()
            .filter(|row| row.measure == measure && row.case == case)
            .collect();
        let [row] = found[..] else {
            panic!("{measure}, {case}: {found:?}")
        };
        assert_eq!(row.model, "copy");
        (row.value, row.unit)
    };
    for (measure, case, value, unit) in [
        ("error", "X11A at gap 0.1", 0.1, "-"),
        ("error", "X11A at gap 5", 0.01, "-"),
        ("error", "X12A at gap 0.1", 0.0, "-"),
        ("relative_error", "X11A at gap 0.1", 10.0, "%"),
        ("worst_error", "X11A", 0.1, "-"),
        ("trusted_down_to", "X12A, 1 %", 0.1, "a"),
        ("trusted_down_to", "X11A, 5 %", 5.0, "a"),
        ("trusted_down_to", "X11A, 20 %", 0.1, "a"),
        (
            "law",
            "smallest eigenvalue of the mobility at gap 0.1",
            0.3,
            "-",
        ),
        ("third_law", "a + b", 0.2, "-"),
        ("seconds_per_gap", "stated or measured", 0.5, "s"),
        ("exact_seconds_per_gap", "measured now", 0.25, "s"),
        (
            "time_ratio",
            "seconds per gap over those of exact loads",
            2.0,
            "-",
        ),
    ] {
        let (found, in_unit) = of(measure, case);
        assert_relative_eq!(found, value, epsilon = 1e-9);
        assert_eq!(in_unit, unit, "{measure}, {case}");
    }
    let spoiled = card.spoiled_by(0.05).unwrap();
    assert_relative_eq!(spoiled.gap, 0.1);
    assert_eq!(card.spoiled_by(0.5), None);
    let known: Vec<&str> = MEASURES.iter().map(|(measure, _)| *measure).collect();
    assert!(rows.iter().all(|row| known.contains(&row.measure)));
    // Each error, its per cent, the worst of each quantity, and trust of each at three bounds and of all.
    let count = |measure: &str| rows.iter().filter(|row| row.measure == measure).count();
    let items = by_item(&card.points).len();
    assert_eq!(
        [count("error"), count("relative_error")],
        [card.points.len(); 2]
    );
    assert_eq!(
        [count("worst_error"), count("trusted_down_to")],
        [items, 3 * (items + 1)]
    );
}
