//! What is told of values that are wrong in one known way.

use super::*;
use crate::judge::points::made::{item, point};

/// Twelve gaps a decade, from 1e-3 to about 40.
fn gaps() -> impl Iterator<Item = f64> {
    (0..56).map(|k| 1e-3 * 10f64.powf(f64::from(k) / 12.0))
}

fn points(name: &str, truth: impl Fn(f64) -> f64, value: impl Fn(f64) -> f64) -> Vec<Point> {
    gaps()
        .map(|gap| point(name, gap, value(gap), truth(gap)))
        .collect()
}

fn told(points: &[Point]) -> Vec<Kind> {
    let Item::Quantity(quantity) = points[0].item else {
        panic!("no quantity")
    };
    let faults = of_quantity((quantity, points), &[], None, 0.0);
    faults.into_iter().map(|fault| fault.kind).collect()
}

/// Felt at all gaps, and gone far away: a mobility of the other sphere.
fn falls(gap: f64) -> f64 {
    1.5 / (2.0 + gap) + 0.3 / (1.0 + gap).powi(2)
}

/// Diverges as the logarithm, with the factor that `Y11A` has.
fn diverges(gap: f64) -> f64 {
    1.0 + (1.0 + 1.0 / gap).ln() / 6.0
}

/// The value at one of the gaps is another one.
fn except(k: usize, of: fn(f64) -> f64, add: f64) -> impl Fn(f64) -> f64 {
    let at = gaps().nth(k).unwrap();
    move |gap| of(gap) + if gap.total_cmp(&at).is_eq() { add } else { 0.0 }
}

#[test]
fn one_factor_is_told_with_its_sign_and_a_small_one_is_none() {
    let by = |factor: f64| told(&points("x12a", falls, |gap| factor * falls(gap)));
    assert_eq!(by(1.0), []);
    assert_eq!(by(-1.0), [Kind::Sign]);
    for factor in [2.0, 0.5, 1.01, 1.003] {
        let found = by(factor);
        let [Kind::Factor(one)] = found[..] else {
            panic!("{factor}: {found:?}")
        };
        assert!((one - factor).abs() < 1e-12, "{one}");
    }
    let found = by(-2.0);
    let [Kind::SignAndFactor(two)] = found[..] else {
        panic!("{found:?}")
    };
    assert!((two + 2.0).abs() < 1e-12, "{two}");
    assert_ne!(by(1.001), [Kind::Factor(1.001)]);
}

#[test]
fn a_sphere_that_is_alone_everywhere_or_from_some_gap_on_is_told_apart() {
    assert_eq!(
        told(&points("x11a", |gap| 1.0 - 0.5 * falls(gap), |_| 1.0)),
        [Kind::Alone]
    );
    let found = told(&points(
        "x11a",
        |gap| 1.0 - 0.5 * falls(gap),
        |gap| {
            if gap < 0.7 {
                1.0 - 0.5 * falls(gap)
            } else {
                1.0
            }
        },
    ));
    let [Kind::Cut(cut)] = found[..] else {
        panic!("{found:?}")
    };
    assert!((0.7..0.9).contains(&cut), "{cut}");
    // What is wrong within the cut is told beside it.
    let found = told(&points(
        "x11a",
        |gap| 1.0 - 0.5 * falls(gap),
        |gap| {
            if gap < 0.7 {
                2.0 * (1.0 - 0.5 * falls(gap))
            } else {
                1.0
            }
        },
    ));
    assert!(
        matches!(found[..], [Kind::Cut(_), Kind::Factor(two)] if (two - 2.0).abs() < 1e-9),
        "{found:?}"
    );
    // Far away every sphere is alone.
    assert_eq!(told(&points("x11a", |_| 1.0, |_| 1.0)), []);
}

#[test]
fn one_wrong_value_is_told_in_the_middle_and_at_the_end_but_not_two() {
    for k in [1, 20, 54, 55] {
        let found = told(&points("x12a", falls, except(k, falls, 0.02)));
        let at = gaps().nth(k).unwrap();
        assert!(
            matches!(found[0], Kind::OneValue(gap) if gap.total_cmp(&at).is_eq()),
            "{k}: {found:?}"
        );
    }
    // At the smallest gap an error may just begin.
    let found = told(&points("x12a", falls, except(0, falls, 0.02)));
    assert!(!matches!(found[0], Kind::OneValue(_)), "{found:?}");
    let (one, other) = (except(20, falls, 0.02), except(30, falls, 0.02));
    let found = told(&points("x12a", falls, |gap| {
        one(gap) + other(gap) - falls(gap)
    }));
    assert_eq!(found, [Kind::Error]);
}

#[test]
fn a_factor_below_a_gap_is_told_with_the_last_gap_that_it_spoils() {
    let found = told(&points("x12a", falls, |gap| {
        if gap < 0.05 {
            1.02 * falls(gap)
        } else {
            falls(gap)
        }
    }));
    let [Kind::FactorBelow(factor, below)] = found[..] else {
        panic!("{found:?}")
    };
    assert!(
        (factor - 1.02).abs() < 1e-12 && (0.04..0.05).contains(&below),
        "{found:?}"
    );
    // One gap beyond or below is too few for that.
    for edge in [1.05e-3, 37.0] {
        let found = told(&points("x12a", falls, |gap| {
            if gap < edge {
                1.02 * falls(gap)
            } else {
                falls(gap)
            }
        }));
        assert!(
            !found
                .iter()
                .any(|kind| matches!(kind, Kind::FactorBelow(..))),
            "{edge}: {found:?}"
        );
    }
    // Two that end at different gaps are two faults; two that end at one are one.
    let fault =
        |name: &str, below: f64| Fault::new(Kind::FactorBelow(1.02, below), item(name), &[]);
    let count = |below: f64| merged(vec![fault("x11a", 0.05), fault("x12a", below)]).len();
    assert_eq!([count(0.05), count(0.5)], [1, 2]);
}

#[test]
fn straight_lines_between_some_gaps_are_a_table_and_one_straight_line_is_a_formula() {
    // Every fourth gap is a node.
    let nodes: Vec<f64> = gaps().step_by(5).collect();
    for coordinate in [(|gap| gap) as fn(f64) -> f64, f64::ln] {
        let found = told(&points("x12a", falls, |gap| {
            let next = nodes
                .partition_point(|node| *node < gap)
                .clamp(1, nodes.len() - 1);
            let [a, b] = [nodes[next - 1], nodes[next]];
            let share = (coordinate(gap) - coordinate(a)) / (coordinate(b) - coordinate(a));
            falls(a) * (1.0 - share) + falls(b) * share
        }));
        // Nodes, and both ends.
        assert!(
            matches!(found[0], Kind::StraightLines(off) if (10..=14).contains(&off)),
            "{found:?}"
        );
    }
    // A value that does not change is no line of a table.
    let steps = |gap: f64| falls(10f64.powf((4.0 * gap.log10()).floor() / 4.0));
    let found = told(&points("x12a", falls, steps));
    assert!(
        !found
            .iter()
            .any(|kind| matches!(kind, Kind::StraightLines(_))),
        "{found:?}"
    );
    for formula in [|gap: f64| 1.0 - 0.02 * gap, |gap: f64| 0.9 - 0.1 * gap.ln()] {
        let found = told(&points("x12a", falls, formula));
        assert!(
            !found
                .iter()
                .any(|kind| matches!(kind, Kind::StraightLines(_))),
            "{found:?}"
        );
    }
}

#[test]
fn a_wrong_sign_beside_a_zero_of_the_truth_is_a_small_error_and_elsewhere_a_fault() {
    let crosses = |gap: f64| (0.1_f64 / gap).ln() / (1.0 + gap).powi(2);
    let wrong = |kinds: &[Kind]| kinds.iter().any(|kind| matches!(kind, Kind::SignAt(..)));
    // Shifted by less than a gap to the next.
    let beside = told(&points("x12a", crosses, |gap| crosses(gap * 0.9)));
    assert!(!wrong(&beside), "{beside:?}");
    let elsewhere = told(&points("x12a", crosses, |gap| {
        if (1e-2..2e-2).contains(&gap) {
            -crosses(gap)
        } else {
            crosses(gap)
        }
    }));
    let found = elsewhere.iter().find_map(|kind| match kind {
        Kind::SignAt(from, to) => Some((*from, *to)),
        _ => None,
    });
    let (from, to) = found.unwrap_or_else(|| panic!("{elsewhere:?}"));
    assert!(
        (1e-2..1.3e-2).contains(&from) && (1.6e-2..2e-2).contains(&to),
        "{elsewhere:?}"
    );
}

#[test]
fn a_wrong_logarithm_explains_far_gaps_only_if_it_is_there_too() {
    let wrong = |gap: f64| diverges(gap) - 0.05 * gap.ln();
    let near = |gap: f64| if gap < 0.6 { wrong(gap) } else { diverges(gap) };
    let both = |gap: f64| {
        if gap < 5.0 {
            near(gap)
        } else {
            1.3 * diverges(gap)
        }
    };
    let coefficient = |kinds: &[Kind]| {
        let of = |kind: &Kind| match kind {
            Kind::Coefficient(value, truth) => Some((*value, *truth)),
            _ => None,
        };
        let (value, truth) = kinds
            .iter()
            .find_map(of)
            .unwrap_or_else(|| panic!("{kinds:?}"));
        assert!((truth - 1.0 / 6.0).abs() < 1e-8, "{truth}");
        assert!((value - truth - 0.05).abs() < 1e-9, "{value}");
        kinds.len()
    };
    assert_eq!(coefficient(&told(&points("Y11A", diverges, wrong))), 1);
    assert_eq!(coefficient(&told(&points("Y11A", diverges, near))), 1);
    let found = told(&points("Y11A", diverges, both));
    assert_eq!(coefficient(&found), 2);
    assert!(
        matches!(found[1], Kind::Far(of) if (of - 1.3).abs() < 1e-9),
        "{found:?}"
    );
}

#[test]
fn a_factor_far_away_is_told_if_it_lasts_or_is_more_than_noise() {
    let far = |kinds: &[Kind]| kinds.iter().any(|kind| matches!(kind, Kind::Far(_)));
    let only_far = |gap: f64| {
        if gap > 7.0 {
            1.1 * falls(gap)
        } else {
            falls(gap)
        }
    };
    assert!(far(&told(&points("x12a", falls, only_far))));
    // An error that has gone there says nothing of the far field.
    let gone = |gap: f64| falls(gap) * (1.0 + 0.1 / (1.0 + gap).powi(4));
    assert!(!far(&told(&points("x12a", falls, gone))));
    // Noise of six digits on what has faded.
    let faded = |gap: f64| 1e-4 / (1.0 + gap).powi(3);
    let noisy = |gap: f64| faded(gap) + 2e-6 * (100.0 * gap).sin();
    assert!(!far(&told(&points("x12a", faded, noisy))));
}

#[test]
fn values_of_either_sphere_in_the_others_place_are_told_as_exchanged() {
    let [own, other] = [|gap: f64| 1.0 - 0.3 * falls(gap), falls as fn(f64) -> f64];
    let items = |value: [&dyn Fn(f64) -> f64; 2]| {
        [
            ("x11a", own as fn(f64) -> f64, value[0]),
            ("x12a", other, value[1]),
        ]
        .map(|(name, truth, value)| {
            let points = points(name, truth, value);
            (points[0].item, points)
        })
    };
    let submission = Submission::of_answers(crate::submission::Header::default(), Vec::new());
    let kinds = |items: &[(Item, Vec<Point>)]| -> Vec<(Kind, usize)> {
        let faults = faults(&submission, items, &[], &[]);
        faults
            .iter()
            .map(|fault| (fault.kind, fault.of.len()))
            .collect()
    };
    assert_eq!(kinds(&items([&own, &other])), []);
    assert_eq!(kinds(&items([&other, &own])), [(Kind::Swapped, 2)]);
    // One of them alone is no exchange.
    let one = kinds(&items([&other, &other]));
    assert!(
        !one.iter().any(|(kind, _)| *kind == Kind::Swapped),
        "{one:?}"
    );
}

#[test]
fn what_is_felt_at_too_few_gaps_joins_the_factor_that_fits() {
    // Felt at the smallest gap alone.
    let faint = |gap: f64| if gap < 1.1e-3 { 0.4 } else { 1e-5 };
    let items = |factor: f64, other: f64| -> Vec<(Item, Vec<Point>)> {
        [
            points("x12a", falls, |gap| factor * falls(gap)),
            points("y12b", faint, |gap| other * faint(gap)),
        ]
        .map(|points| (points[0].item, points))
        .into()
    };
    let submission = Submission::of_answers(crate::submission::Header::default(), Vec::new());
    let kinds = |factor: f64, other: f64| -> Vec<(Kind, usize)> {
        let faults = faults(&submission, &items(factor, other), &[], &[]);
        faults
            .iter()
            .map(|fault| (fault.kind, fault.of.len()))
            .collect()
    };
    assert_eq!(kinds(-1.0, -1.0), [(Kind::Sign, 2)]);
    assert!(
        matches!(kinds(2.0, 2.0)[..], [(Kind::Factor(_), 2)]),
        "{:?}",
        kinds(2.0, 2.0)
    );
    assert!(
        matches!(kinds(-3.0, -3.0)[..], [(Kind::SignAndFactor(_), 2)]),
        "{:?}",
        kinds(-3.0, -3.0)
    );
    // Another factor joins nothing.
    assert!(kinds(2.0, -1.0).iter().all(|(_, items)| *items == 1));
}

#[test]
fn noise_is_relative_to_the_larger_of_the_truth_and_one() {
    let at = |truth: f64| point("x12a", 1.0, 0.0, truth);
    for (truth, stated, size) in [
        (0.5, 0.0, NOISE),
        (0.5, 1e-3, 3e-3),
        (-20.0, 1e-3, 6e-2),
        (20.0, 1e-9, NOISE),
    ] {
        let found = noise(&at(truth), stated);
        assert!((found - size).abs() < 1e-12, "{truth} {stated}: {found}");
    }
}
