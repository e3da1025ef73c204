//! Fits of singular terms to made-up loads, and sums that cancel.

use super::*;
use crate::judge::points::made::{item, point};

fn points(
    name: &str,
    gaps: &[f64],
    truth: impl Fn(f64) -> f64,
    wrong: impl Fn(f64) -> f64,
) -> Vec<Point> {
    gaps.iter()
        .map(|&gap| point(name, gap, truth(gap) + wrong(gap), truth(gap)))
        .collect()
}

fn gaps(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| from * (to / from).powf(k as f64 / (count - 1) as f64))
        .collect()
}

fn fitted(
    name: &str,
    gaps: &[f64],
    truth: impl Fn(f64) -> f64,
    wrong: impl Fn(f64) -> f64,
) -> Option<Contact> {
    let points = points(name, gaps, truth, wrong);
    fit(points[0].item, &points)
}

#[test]
fn val_singular_factors_are_the_published_ones() {
    // Jeffrey & Onishi 1984, in units of 6 pi and 8 pi; slip by Ishikawa et al. 2006, corrected.
    for (name, is_inverse, expected) in [
        ("X11A", true, 0.25),
        ("X12A", true, -0.25),
        ("X11A", false, 0.25 * std::f64::consts::E + 0.225),
        ("Y11A", false, 1.0 / 6.0),
        ("Y12A", false, -1.0 / 6.0),
        ("Y11B", false, -0.25),
        ("Y12B", false, 0.25),
        ("Y11C", false, 0.2),
        ("Y12C", false, 0.05),
        ("XF1_1", false, 3.0),
        ("XF2_1", false, -3.0),
    ] {
        let found = factor(name, is_inverse).unwrap();
        assert!(
            (found - expected).abs() < 1e-8,
            "{name}: {found}, {expected}"
        );
    }
}

#[test]
fn a_fit_finds_the_term_that_is_added_and_the_constant_next_to_it() {
    let near = gaps(1e-3, 0.1, 9);
    // 1/gap, with a logarithm beside it.
    let found = fitted(
        "X11A",
        &near,
        |gap| 0.25 / gap + 1.0,
        |gap| 0.02 / gap - 0.3 * gap.ln() + 0.7,
    )
    .unwrap();
    assert_eq!(found.term, "1/gap");
    assert!(
        (found.truth - 0.25).abs() < 1e-9 && (found.value - 0.27).abs() < 1e-8,
        "{found:?}"
    );
    assert!(
        (found.constant - 0.7).abs() < 1e-6 && found.misfit < 1e-9,
        "{found:?}"
    );
    assert!((found.ratio() - 1.08).abs() < 1e-7 && !found.is_missing());
    // A logarithm.
    let found = fitted(
        "Y11A",
        &near,
        |gap| 1.0 - gap.ln() / 6.0,
        |gap| 0.1 * gap.ln() + 0.05 + 0.2 * gap * gap.ln(),
    )
    .unwrap();
    assert_eq!(found.term, "ln(1/gap)");
    assert!((found.value - (1.0 / 6.0 - 0.1)).abs() < 1e-9, "{found:?}");
    assert!(
        (found.constant - 0.05).abs() < 1e-9 && found.misfit < 1e-12,
        "{found:?}"
    );
    assert!(found.is_missing());
    // What no term explains stays as misfit, relative to the load.
    let found = fitted(
        "Y11A",
        &near,
        |_| 10.0,
        |gap| if gap > 0.05 { 0.5 } else { 0.0 },
    )
    .unwrap();
    assert!((0.005..0.05).contains(&found.misfit), "{found:?}");
}

#[test]
fn too_few_gaps_or_too_near_to_each_other_are_not_fitted() {
    let is_fitted = |gaps: &[f64]| fitted("Y11A", gaps, |gap| 1.0 - gap.ln(), |_| 0.0).is_some();
    assert!(is_fitted(&gaps(0.02, 0.1, 4)));
    assert!(!is_fitted(&gaps(0.02, 0.1, 3)));
    assert!(is_fitted(&gaps(0.025, 0.1, 4)));
    assert!(!is_fitted(&gaps(0.03, 0.1, 4)));
    // Beyond 0.11 nothing is near contact.
    assert!(is_fitted(&[0.01, 0.02, 0.05, 0.11]));
    assert!(!is_fitted(&[0.01, 0.02, 0.05, 0.12]));
    assert!(!is_fitted(&[1.0, 2.0, 5.0, 10.0]));
    // Nor are loads fitted that do not diverge, or velocities.
    for name in ["X11C", "x11a", "UX1_1"] {
        assert!(
            fitted(name, &gaps(0.01, 0.1, 6), |_| 1.0, |_| 0.0).is_none(),
            "{name}"
        );
    }
}

#[test]
fn a_logarithm_alone_is_told_from_two_gaps_if_it_is_one_multiple_of_it() {
    let of = |name: &str, gaps: &[f64], wrong: fn(f64) -> f64| {
        let points = points(name, gaps, |gap| 2.0 - gap.ln(), wrong);
        log_alone(points[0].item, &points, 1e-4)
    };
    let log = |gap: f64| -0.1 * gap.ln();
    let all = [0.01, 0.1, 0.5, 1.0, 5.0];
    let found = of("Y11A", &all, log).unwrap();
    assert!((found.value - 1.0 / 6.0 - 0.1).abs() < 1e-9 && (found.truth - 1.0 / 6.0).abs() < 1e-9);
    assert!(found.everywhere);
    // Only near contact.
    let found = of(
        "Y11A",
        &all,
        |gap| if gap < 0.6 { -0.1 * gap.ln() } else { 0.0 },
    )
    .unwrap();
    assert!(!found.everywhere);
    assert!(of("Y11A", &[0.1, 0.5], log).is_some());
    assert!(
        of("Y11A", &[0.1, 0.7], log).is_none(),
        "one gap is not enough"
    );
    assert!(
        of("Y11A", &all, |gap| -0.1 * gap.ln() + 0.05).is_none(),
        "not one multiple"
    );
    assert!(
        of("Y11A", &all, |gap| -1e-4 * gap.ln()).is_none(),
        "too small"
    );
    assert!(of("X11A", &all, log).is_none(), "diverges faster");
    assert!(of("x11a", &all, log).is_none(), "no load");
}

#[test]
fn val_true_singular_terms_obey_action_and_reaction_and_a_wrong_one_does_not() {
    let names = [
        "X11A", "X12A", "Y11A", "Y12A", "Y11B", "Y12B", "XF1_1", "XF2_1", "YF1_1", "YF2_1",
        "YT1_1", "YT2_1",
    ];
    let contacts = |wrong: &str, by: f64| -> Vec<Contact> {
        (names.iter())
            .map(|name| {
                let is_inverse = diverges(name).unwrap();
                let truth = factor(name, is_inverse).unwrap();
                Contact {
                    item: item(name),
                    term: if is_inverse { "1/gap" } else { "ln(1/gap)" },
                    value: truth + if *name == wrong { by } else { 0.0 },
                    truth,
                    constant: 0.0,
                    misfit: 0.0,
                }
            })
            .collect()
    };
    let laws = third_law(&contacts("", 0.0));
    let cases: Vec<&str> = laws.iter().map(|(case, _)| case.as_str()).collect();
    assert_eq!(
        cases,
        [
            "X11A + X12A, 1/gap",
            "Y11A + Y12A, ln(1/gap)",
            "Y11B + Y12B, ln(1/gap)",
            "XF1_1 + XF2_1, ln(1/gap)",
            "YF1_1 + YF2_1, ln(1/gap)",
            "YT1_1 + YT2_1 - 2 YF1_1, ln(1/gap)",
        ]
    );
    for (case, sum) in &laws {
        assert!(sum.abs() < 1e-8, "{case}: {sum}");
    }
    // Relative to the true factor, 0.25; the couple to twice that of the force.
    let broken = third_law(&contacts("X12A", 0.05));
    assert!(
        (broken[0].1 - 0.2).abs() < 1e-8 && broken[1].1.abs() < 1e-8,
        "{broken:?}"
    );
    let broken = third_law(&contacts("YT2_1", 0.4));
    let force = factor("YF1_1", false).unwrap().abs();
    assert!(
        (broken[5].1 - 0.2 / force).abs() < 1e-8 && broken[4].1.abs() < 1e-8,
        "{broken:?}"
    );
    // A load without its partner obeys nothing.
    assert!(third_law(&contacts("", 0.0)[..1]).is_empty());
}
