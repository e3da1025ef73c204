//! Each fault in words, with its numbers.

use approx::assert_relative_eq;

use super::*;
use crate::judge::points::made::{item, point};

/// A fault of some quantities, each off by so much at a gap, with a number of its own.
fn fault(kind: Kind, of: &[(&str, f64, f64, f64)]) -> Fault {
    let affected = |&(name, error, gap, number): &(&str, f64, f64, f64)| Affected {
        item: item(name),
        worst: (error, gap),
        number,
    };
    Fault {
        kind,
        of: of.iter().map(affected).collect(),
    }
}

/// The sentence on one quantity, 12.34 % off at gap 0.05, and on two.
fn said(kind: Kind) -> [String; 2] {
    let x = ("X11A", 0.1234, 0.05, kind.number());
    let y = ("Y12B", 0.02, 0.2, kind.number());
    [fault(kind, &[x]), fault(kind, &[x, y])].map(|fault| fault.sentence())
}

#[test]
fn each_fault_is_a_sentence_about_one_quantity_or_several() {
    for (kind, one, two) in [
        (
            Kind::Sign,
            "X11A would fit with the other sign",
            "X11A and Y12B would fit with the other sign",
        ),
        (
            Kind::Swapped,
            "X11A would fit if those of the two spheres were exchanged",
            "X11A and Y12B would fit if those of the two spheres were exchanged",
        ),
        (
            Kind::Factor(2.0),
            "X11A is 2 times what it should be at every gap: would fit if divided by 2",
            "X11A and Y12B are 2 times what they should be at every gap: would fit if divided by 2",
        ),
        (
            Kind::SignAndFactor(-0.5),
            "X11A would fit with the other sign and divided by 0.5",
            "X11A and Y12B would fit with the other sign and divided by 0.5",
        ),
        (
            Kind::FactorBelow(1.02, 0.04),
            "X11A is 1.02 times what it should be at gaps up to 0.04 and right beyond: would fit if divided by 1.02 there",
            "X11A and Y12B are 1.02 times what they should be at gaps up to 0.04 and right beyond: would fit if divided by 1.02 there",
        ),
        (
            Kind::OneValue(0.05),
            "X11A is off by 12 % at gap 0.05 and right next to it",
            "X11A and Y12B are off by 12 % at gap 0.05 and right next to it",
        ),
        (
            Kind::Coefficient(0.75, 1.0 / 6.0),
            "near contact X11A has 0.75 where 0.167 belongs, in front of the singular term",
            "near contact X11A and Y12B have 0.75 where 0.167 belongs, in front of the singular term",
        ),
        (
            // Of a load that is negative there.
            Kind::Coefficient(-0.75, -1.0 / 6.0),
            "near contact X11A has 0.75 where 0.167 belongs, in front of the singular term",
            "near contact X11A and Y12B have 0.75 where 0.167 belongs, in front of the singular term",
        ),
        (
            Kind::Coefficient(0.75, -1.0 / 6.0),
            "near contact X11A has -0.75 where 0.167 belongs, in front of the singular term",
            "near contact X11A and Y12B have -0.75 where 0.167 belongs, in front of the singular term",
        ),
        (
            Kind::Far(1.3),
            "far away X11A is 1.3 times what it should be",
            "far away X11A and Y12B are 1.3 times what they should be",
        ),
    ] {
        assert_eq!(said(kind), [one, two]);
    }
    // Of one quantity each.
    for (kind, one) in [
        (
            Kind::SignAt(0.01, 0.02),
            "X11A has the wrong sign at gaps from 0.01 to 0.02",
        ),
        (
            Kind::SignAt(0.01, 0.01),
            "X11A has the wrong sign at gap 0.01",
        ),
        (Kind::Error, "X11A is off by 12 % (gap 0.05)"),
    ] {
        assert_eq!(said(kind)[0], one);
    }
    for kind in Kind::ALL {
        let [one, two] = said(kind);
        assert!(!one.contains("NaN") && !two.contains("NaN"), "{one} {two}");
    }
}

#[test]
fn the_largest_errors_come_first_and_the_rest_are_counted() {
    let of: Vec<(&str, f64, f64, f64)> = ["X11A", "X12A", "Y11A", "Y12A", "Y11B", "Y12B"]
        .into_iter()
        .zip([0.001, 0.3, 0.002, 12.0, 0.04, 2e4])
        .map(|(name, error)| (name, error, 0.1, f64::NAN))
        .collect();
    assert_eq!(
        fault(Kind::Error, &of).sentence(),
        "Y12B is off by 2.0e6 % (gap 0.1), Y12A by 1200 % (gap 0.1), X12A by 30 % (gap 0.1), Y11B by 4.0 % (gap 0.1), 2 more by less"
    );
    assert_eq!(
        fault(Kind::Error, &of[..4]).sentence(),
        "Y12A is off by 1200 % (gap 0.1), X12A by 30 % (gap 0.1), Y11A by 0.2 % (gap 0.1), X11A by 0.1 % (gap 0.1)"
    );
}

#[test]
fn factors_far_away_are_told_one_by_one_unless_they_are_one() {
    let of = |numbers: &[f64]| {
        let names = ["X11A", "X12A", "Y11A", "Y12A", "Y11B"];
        let of: Vec<_> = (names.into_iter().zip(numbers))
            .map(|(name, number)| (name, 0.1, 20.0, *number))
            .collect();
        fault(Kind::Far(numbers[0]), &of).sentence()
    };
    assert_eq!(
        of(&[1.5, 1.503]),
        "far away X11A and X12A are 1.503 times what they should be"
    );
    assert_eq!(
        of(&[1.5, 1.2, 0.5, 123.44, 2.0]),
        "far away X11A is 1.5, X12A is 1.2, Y11A is 0.5, Y12A is 123.4 times what it should be, 1 more"
    );
    assert_eq!(
        of(&[1.5, 1.2]),
        "far away X11A is 1.5, X12A is 1.2 times what it should be"
    );
}

#[test]
fn a_factor_of_units_or_of_the_viscosity_is_recognised() {
    let one = [item("X11A")];
    assert_eq!(hint(6.0 * PI, &one), " (a factor of 6 pi)");
    assert_eq!(hint(1.0 / (8.0 * PI), &one), " (a factor of 8 pi)");
    assert_eq!(hint(4.0 * PI * 1.0005, &one), " (a factor of 4 pi)");
    assert_eq!(hint(PI, &one), " (a factor of pi)");
    assert_eq!(hint(PI * 1.002, &one), "");
    assert_eq!(hint(2.0, &one), "");
    let rigid: Vec<Item> = [
        "X11A", "X12A", "Y11A", "Y12A", "Y11B", "Y12B", "X11C", "X12C", "Y11C", "Y12C",
    ]
    .map(item)
    .into();
    assert_eq!(hint(2.0, &rigid), " (all of them: another viscosity?)");
    assert_eq!(hint(2.0, &rigid[1..]), "");
    // Loads by slip beside them do not count.
    let more = [&rigid[1..], &[item("XF1_1")]].concat();
    assert_eq!(hint(2.0, &more), "");
}

#[test]
fn numbers_have_as_many_digits_as_a_person_reads() {
    for (value, text) in [
        (2.0, "2"),
        (0.16667, "0.167"),
        (-0.75, "-0.75"),
        (100.04, "100"),
        (123.45, "123.5"),
        (99.9994, "99.999"),
        (0.00123, "1.2e-3"),
        (0.01, "0.01"),
    ] {
        assert_eq!(number(value), text, "{value}");
    }
    for (error, text) in [
        (0.0, "0 %"),
        (-0.5, "50 %"),
        (0.1, "10 %"),
        (0.0999, "10.0 %"),
        (0.001, "0.1 %"),
        (0.000_99, "9.9e-2 %"),
        (9_999.0, "999900 %"),
        (1e4, "1.0e6 %"),
        (f64::INFINITY, "inf %"),
    ] {
        assert_eq!(size_percent(error), text, "{error}");
    }
}

#[test]
fn a_list_names_six_and_says_when_all_are_torques() {
    let list = |names: &[&str]| listed(&names.iter().map(|name| item(name)).collect::<Vec<_>>());
    assert_eq!(list(&[]), "");
    assert_eq!(list(&["X11A"]), "X11A");
    assert_eq!(list(&["X11C", "Y11C"]), "X11C and Y11C");
    assert_eq!(
        list(&["X11C", "Y11C", "YT1_1"]),
        "X11C, Y11C and YT1_1 (torques)"
    );
    assert_eq!(list(&["X11C", "Y11C", "X11A"]), "X11C, Y11C and X11A");
    let many = [
        "X11C", "X12C", "Y11C", "Y12C", "YT1_1", "YT2_1", "YT1_2", "YT2_2",
    ];
    assert_eq!(
        list(&many[..6]),
        "X11C, X12C, Y11C, Y12C, YT1_1 and YT2_1 (torques)"
    );
    assert_eq!(
        list(&many),
        "X11C, X12C, Y11C, Y12C, YT1_1, YT2_1 and 2 more (torques)"
    );
}

#[test]
fn like_faults_become_one_and_unlike_ones_stay_apart() {
    let merge = |a: Kind, b: Kind| {
        let both = [(a, "X11A"), (b, "X12A")].map(|(kind, name)| Fault::new(kind, item(name), &[]));
        merged(both.into()).len() == 1
    };
    for (a, b) in [
        (Kind::Factor(2.0), Kind::Factor(2.004)),
        (Kind::SignAndFactor(-2.0), Kind::SignAndFactor(-2.004)),
        (Kind::FactorBelow(1.02, 0.1), Kind::FactorBelow(1.02, 0.1)),
        (Kind::Cut(0.5), Kind::Cut(0.5)),
        (Kind::OneValue(0.5), Kind::OneValue(0.5)),
        (Kind::Coefficient(2.0, 3.0), Kind::Coefficient(-2.0, -3.0)),
        (Kind::Far(1.5), Kind::Far(0.5)),
        (Kind::Error, Kind::Error),
        (Kind::Alone, Kind::Alone),
    ] {
        assert!(merge(a, b), "{a:?} {b:?}");
    }
    for (a, b) in [
        (Kind::Factor(2.0), Kind::Factor(2.02)),
        (Kind::Factor(-2.0), Kind::SignAndFactor(-2.0)),
        (Kind::FactorBelow(1.02, 0.1), Kind::FactorBelow(1.1, 0.1)),
        (Kind::FactorBelow(1.02, 0.1), Kind::FactorBelow(1.02, 0.2)),
        (Kind::Cut(0.5), Kind::Cut(0.7)),
        (Kind::Cut(0.5), Kind::OneValue(0.5)),
        (Kind::Coefficient(2.0, 3.0), Kind::Coefficient(2.0, 1.0)),
        (Kind::Coefficient(2.0, 3.0), Kind::Coefficient(4.0, 6.0)),
        (Kind::SignAt(0.1, 0.2), Kind::SignAt(0.1, 0.2)),
        (Kind::Sign, Kind::Swapped),
    ] {
        assert!(!merge(a, b), "{a:?} {b:?}");
    }
}

#[test]
fn what_explains_nothing_is_vaguer_the_more_it_spoils() {
    let x = ("X11A", 0.1, 0.1, 1.0);
    let of = |kind: Kind, count: usize| fault(kind, &vec![x; count]).vagueness();
    for kind in [
        Kind::Sign,
        Kind::Factor(2.0),
        Kind::Swapped,
        Kind::Cut(1.0),
        Kind::NoLubrication,
    ] {
        assert_relative_eq!(of(kind, 1), 1.0);
        assert_relative_eq!(of(kind, 9), 1.0);
    }
    for kind in [
        Kind::Error,
        Kind::Far(2.0),
        Kind::Constant,
        Kind::Alone,
        Kind::OneValue(1.0),
        Kind::SignAt(1.0, 2.0),
    ] {
        assert_relative_eq!(of(kind, 1), 2.5);
        assert_relative_eq!(of(kind, 4), 4.0);
    }
}

#[test]
fn the_worst_of_a_fault_is_that_of_its_worst_quantity() {
    let found = fault(
        Kind::Error,
        &[
            ("X11A", 0.1, 0.5, 1.0),
            ("X12A", 0.3, 0.7, 1.0),
            ("Y11A", 0.2, 0.9, 1.0),
        ],
    );
    assert_eq!(found.worst(), (0.3, 0.7));
    assert!(found.is_of(item("X12A")) && !found.is_of(item("Y12A")));
    let points =
        [(0.1, 4.2), (0.2, 3.0), (0.3, 4.4)].map(|(gap, value)| point("X11A", gap, value, 4.0));
    assert_eq!(
        Fault::new(Kind::Sign, item("X11A"), &points).of[0].worst,
        (0.25, 0.2)
    );
    assert_relative_eq!(worst(&[]).0, 0.0);
}
