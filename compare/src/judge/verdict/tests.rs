//! The verdict on made-up scorecards.

use super::super::{
    BoundComparison, CaseScore, Collisions, Decay, Fault, Kind, Law, Missing, Scorecard,
};
use super::*;
use crate::judge::points::made::point;
use crate::study::maps::TrustShares;
use crate::submission::{Header, Quantity};
use crate::{Approach, Case};

/// Nothing wrong, and nothing but the errors of `X11A` known.
fn card(errors: &[(f64, f64)]) -> Scorecard {
    Scorecard {
        name: "some".to_owned(),
        header: Header::default(),
        unanswered: Vec::new(),
        points: errors
            .iter()
            .map(|(gap, error)| point("X11A", *gap, 1.0 + error, 1.0))
            .collect(),
        raw: Vec::new(),
        between: Vec::new(),
        missing: Vec::new(),
        matrix_laws: Vec::new(),
        definite: Vec::new(),
        contacts: Vec::new(),
        third_law: Vec::new(),
        decays: Vec::new(),
        faults: Vec::new(),
        collisions: Err("not asked for".to_owned()),
        seconds_per_gap: None,
        exact_seconds_per_gap: 1e-3,
    }
}

fn has(card: &Scorecard, sentence: &str) {
    let lines = card.verdict();
    assert!(lines.iter().any(|line| line == sentence), "{lines:#?}");
}

fn lacks(card: &Scorecard, part: &str) {
    let lines = card.verdict();
    assert!(!lines.iter().any(|line| line.contains(part)), "{lines:#?}");
}

#[test]
fn trust_is_told_bound_by_bound_until_all_gaps_are_within() {
    let of = |errors: &[(f64, f64)]| card(errors).verdict()[0].clone();
    assert_eq!(
        of(&[(0.1, 0.005), (40.0, 0.001)]),
        "some is within 1 % at all its gaps, down to 0.1."
    );
    assert_eq!(
        of(&[(0.1, -0.03), (1.0, 0.002), (40.0, 0.001)]),
        "some is within 1 % down to a gap of 1 (X11A is first to fail); within 5 % at all its gaps, down to 0.1."
    );
    assert_eq!(
        of(&[(0.1, 0.5), (40.0, 0.3)]),
        "some is nowhere within 1 % (X11A); nowhere within 5 % (X11A); nowhere within 20 % (X11A)."
    );
    let mut follows = card(&[(0.1, 0.5), (40.0, 0.0)]);
    follows.points[0].given = false;
    assert!(
        follows.verdict()[0].contains("(X11A, which follows from what it gives, is first to fail)"),
        "{:?}",
        follows.verdict()
    );
}

#[test]
fn no_fault_is_told_with_the_largest_error_of_what_is_given() {
    let mut good = card(&[(0.1, 0.002), (1.0, -0.004), (40.0, 0.001)]);
    has(
        &good,
        "No fault found in what it gives (largest error 0.4 % of X11A at gap 1).",
    );
    good.points[1].given = false;
    has(
        &good,
        "No fault found in what it gives (largest error 0.2 % of X11A at gap 0.1).",
    );
    // A law that is broken, or a mobility that is not positive, is a fault too.
    let law = |value: f64| Law {
        name: "reciprocity",
        value,
        gap: 0.2,
        entries: "(1, 2) and (2, 1)".to_owned(),
    };
    good.matrix_laws = vec![law(1e-5)];
    good.definite = vec![(0.1, 0.3)];
    assert!(good.is_faultless());
    good.definite = vec![(0.1, 0.0)];
    assert!(!good.is_faultless());
    good.definite.clear();
    good.matrix_laws = vec![law(0.5)];
    assert!(!good.is_faultless());
    lacks(&good, "No fault found");
}

#[test]
fn twelve_faults_are_told_and_the_rest_are_counted() {
    let of = |count: usize| {
        let mut bad = card(&[(0.1, 0.5), (40.0, 0.5)]);
        let item = bad.points[0].item;
        bad.faults = vec![Fault::new(Kind::Sign, item, &bad.points); count];
        bad
    };
    let told = |count: usize| {
        of(count)
            .verdict()
            .iter()
            .filter(|line| line.starts_with("Fault (wrong sign)"))
            .count()
    };
    assert_eq!([told(1), told(12), told(14)], [1, 12, 12]);
    lacks(&of(12), "More faults");
    has(&of(14), "More faults are in the table: 2.");
    lacks(&of(1), "No fault found");
}

#[test]
fn broken_laws_are_told_with_their_gaps() {
    let mut bad = card(&[(0.1, 0.0), (40.0, 0.0)]);
    let law = |name: &'static str, value: f64| Law {
        name,
        value,
        gap: 0.2,
        entries: "(1, 2) and (2, 1)".to_owned(),
    };
    bad.matrix_laws = vec![
        law("reciprocity", 0.12),
        law("equal spheres", 0.34),
        law("smallest eigenvalue", -0.5),
    ];
    has(
        &bad,
        "Law broken (reciprocity): the matrix is not symmetric: entries (1, 2) and (2, 1) differ by 0.1200 at gap 0.2 (relative to the larger of them and 1, the entry of a lone sphere).",
    );
    has(
        &bad,
        "Law broken (equal spheres): the two spheres are not alike, or x is not like y: entries (1, 2) and (2, 1) differ by 0.3400 at gap 0.2 (relative to the larger of them and 1, the entry of a lone sphere).",
    );
    has(
        &bad,
        "Law broken (positive definite): the matrix has the eigenvalue -0.5000 at gap 0.2: forces would not dissipate.",
    );
    bad.matrix_laws = vec![law("reciprocity", 1e-5)];
    bad.definite = vec![(0.1, -0.2), (0.2, -0.1), (0.3, 0.1)];
    has(
        &bad,
        "Law broken (positive definite): the mobility is not positive definite at gaps from 0.1 to 0.2.",
    );
    bad.definite = vec![(0.1, -0.2), (0.3, 0.1)];
    has(
        &bad,
        "Law broken (positive definite): the mobility is not positive definite at gap 0.1.",
    );
    lacks(&bad, "reciprocity");
    bad.third_law = vec![("a + b".to_owned(), 0.09), ("c + d".to_owned(), -0.2)];
    has(
        &bad,
        "Law broken (action and reaction near contact): singular terms do not cancel in c + d.",
    );
    bad.third_law.push(("e + f".to_owned(), 0.2));
    has(
        &bad,
        "Law broken (action and reaction near contact): singular terms do not cancel in c + d and 1 more.",
    );
}

#[test]
fn another_power_of_the_distance_and_a_far_field_that_is_not_there_are_told() {
    let mut far = card(&[(0.1, 0.0), (38.0, 0.0)]);
    let decay = |name: &str, theirs: f64| Decay {
        quantity: Quantity::named(name).unwrap(),
        powers: [theirs, -1.0],
        is_off: true,
    };
    far.decays = vec![decay("x12a", -1.05), decay("y12a", -2.0)];
    has(
        &far,
        "Far away y12a fall off with another power of the distance than they should (y12a: -2.00 instead of -1.00).",
    );
    lacks(&far, "could not be checked");
    let near = card(&[(0.1, 0.0), (30.0, 0.0)]);
    has(
        &near,
        "Units and signs of the far field could not be checked: its largest gap is 30, and 38 is needed.",
    );
}

#[test]
fn what_is_left_out_is_said() {
    let mut poor = card(&[(0.1, 0.0), (38.0, 0.0)]);
    poor.missing = vec![Missing {
        quantity: Quantity::named("Y11B").unwrap(),
        at: 2,
    }];
    poor.unanswered = vec![(0.3, "it gave up".to_owned()), (0.4, "again".to_owned())];
    poor.header.slip_calibration = vec![1.5, 2.0];
    poor.raw = vec![point("YT1_1", 0.1, 1.5, 1.0), point("YT1_1", 0.2, 0.4, 1.0)];
    has(&poor, "Missing, and so not scored: Y11B.");
    has(
        &poor,
        "It has no answer at 2 of the gaps that it was asked for, first at 0.3: it gave up.",
    );
    has(
        &poor,
        "Its slip was calibrated by the factors 1.5000, 2.0000 that it declares; without them it is off by up to 60 %.",
    );
    has(&poor, "No collisions: not asked for.");
    has(
        &poor,
        "Between its gaps nothing was scored: it does not say how it is interpolated.",
    );
    assert!(
        poor.verdict()
            .last()
            .unwrap()
            .starts_with("Not stated in its header: ")
    );
    poor.header.interpolation = Some(Interpolation::None);
    has(
        &poor,
        "Between its gaps nothing was scored: it declares no interpolation.",
    );
    poor.header.interpolation = Some(Interpolation::Linear);
    assert!(
        poor.verdict().iter().any(|line| line.starts_with("Between its gaps it was read by its own interpolation, ")),
        "{:?}",
        poor.verdict()
    );
}

#[test]
fn collisions_are_told_by_their_worst_and_by_what_ends_otherwise() {
    let score = |dx: f64, theirs: ([f64; 2], &str), exact: ([f64; 2], &str)| CaseScore {
        case: Case {
            approach: Approach::Orthogonal,
            beta: 5.0,
            dx,
            dz: 0.0,
        },
        theirs: (theirs.0, theirs.1.to_owned()),
        exact: (exact.0, exact.1.to_owned()),
    };
    let shares = |beta: f64, other_outcome: f64, failed: f64| TrustShares {
        beta,
        other_outcome,
        failed,
        method: crate::Method::Lt,
        g: 0.0,
        dz: 0.0,
        within_5_deg: 1.0 - other_outcome - failed,
        within_15_deg: 0.0,
        within_45_deg: 0.0,
        beyond_45_deg: 0.0,
        same_outcome: 0.0,
    };
    let mut colliding = card(&[(0.1, 0.0), (38.0, 0.0)]);
    let mut found = Collisions {
        cases: vec![
            score(1.0, ([10.0, 0.0], "scattered"), ([9.0, 0.0], "scattered")),
            score(2.0, ([10.0, 5.0], "scattered"), ([9.0, 1.0], "scattered")),
        ],
        outcomes: Vec::new(),
        trust: vec![shares(1.0, 0.125, 0.05), shares(5.0, 0.0, 0.0)],
        partings: Vec::new(),
        bound: [Vec::new(), Vec::new()],
        maps: Vec::new(),
    };
    colliding.collisions = Ok(found.clone());
    has(
        &colliding,
        "In the paper's cases deflections are off by up to 4.000 degrees (right angles, beta 5, dx 2); all outcomes are right.",
    );
    has(
        &colliding,
        "Of the incoming angles it gives another outcome for 17.5 % for beta 1, 0.0 % for beta 5.",
    );
    has(
        &colliding,
        "Bound states: 0 of 0 are there; missing: none; of its own: none.",
    );
    found.cases = vec![
        score(1.0, ([10.0, 0.0], "pairwise"), ([9.0, 0.0], "scattered")),
        score(2.0, ([10.0, 5.0], "pairwise"), ([9.0, 1.0], "pairwise")),
    ];
    colliding.collisions = Ok(found.clone());
    has(
        &colliding,
        "In the paper's cases no deflection to compare; 1 of 2 outcomes are wrong (right angles, beta 5, dx 1: pairwise instead of scattered).",
    );
    found.cases.push(score(
        3.0,
        ([10.0, 0.0], "pairwise"),
        ([9.0, 0.0], "scattered"),
    ));
    colliding.collisions = Ok(found);
    has(
        &colliding,
        "In the paper's cases no deflection to compare; 2 of 3 outcomes are wrong (right angles, beta 5, dx 1: pairwise instead of scattered, and 1 more).",
    );
    let none = BoundComparison {
        theirs: None,
        exact: None,
    };
    assert_eq!(none.name(), "");
}
