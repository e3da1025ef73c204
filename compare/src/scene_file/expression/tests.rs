//! Expressions: what they are worth, and where their faults are.

#![allow(clippy::float_cmp, reason = "exactly equal is what is claimed")]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
use proptest::prelude::*;

use super::*;

/// The value of an expression with x = 3 and y_2 = 0.5.
fn value(text: &str) -> f64 {
    let mut scope = Scope::of(&["x", "y_2"]);
    Expression::parse(text, &mut scope)
        .unwrap()
        .value(&[3.0, 0.5])
}

#[test]
fn the_order_of_operations_is_that_of_mathematics() {
    for (text, expected) in [
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^3^2", 512.0),
        ("2^-x", 0.125),
        ("8/4/2", 1.0),
        ("10-4-3", 3.0),
        ("1+2*x", 7.0),
        ("-x*2", -6.0),
        ("2*-x", -6.0),
        ("--x", 3.0),
        ("- -+x", 3.0),
        (" 1e-3 * 2E+3\t", 2.0),
        (".5 + 5. + 1.5", 7.0),
        ("y_2/ x *12", 2.0),
        ("-(x - 1)*(x + 1)", -8.0),
        ("max(x, min(7, 2*x)) - sqrt(16)", 2.0),
        ("4*sin(30 + 60) + cos(60*x)", 3.0),
        ("atan2(x, -x)", 135.0),
        ("abs(-x) + ln(exp(0))", 3.0),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
    assert_eq!(value("pi").to_bits(), std::f64::consts::PI.to_bits());
    assert!(value("0/0").is_nan());
}

#[test]
fn faults_are_told_with_their_places() {
    // The expression, the piece that is wrong and what is said of it.
    for (text, at, told) in [
        ("", 0..0, "empty"),
        ("  ", 0..2, "empty"),
        ("2 +", 3..3, "a number, a name or ( is missing"),
        ("2 * / x", 4..5, "a number, a name or ( is missing"),
        ("()", 1..2, "a number, a name or ( is missing"),
        ("(x + 1", 0..1, "no ) closes this"),
        ("2*(x + (1)", 2..3, "no ) closes this"),
        ("x + 1)", 5..6, "no ( is closed by this"),
        ("sin(x", 3..4, "no ) closes this"),
        ("sin()", 4..5, "a number, a name or ( is missing"),
        ("max(x, 2 -)", 10..11, "a number, a name or ( is missing"),
        ("2 x", 2..3, "an operator is missing"),
        ("2(x)", 1..2, "an operator is missing"),
        ("(x) x", 4..5, "an operator is missing"),
        ("1.2.3", 3..4, "an operator is missing"),
        ("x % 2", 2..3, "no operator"),
        ("x, 2", 1..2, "a comma only stands"),
        ("(x, 2)", 2..3, "a comma only stands"),
        (
            "((((((((((((((((((((((((((x))))))))))))))))))))))))))",
            25..26,
            "more than 25 brackets",
        ),
        ("x*0,5", 3..4, "decimals take a point, 0.5"),
        ("sim(x)", 0..3, "no such function: did you mean 'sin'?"),
        (
            "2*gamma(x)",
            2..7,
            "no such function: allowed are sin, cos,",
        ),
        ("1 + sin x", 4..7, "in brackets: sin(...)"),
        ("sin(x, 1)", 0..3, "takes one number, and here are 2"),
        ("max(x)", 0..3, "takes two numbers, and here are 1"),
        ("1 + y2", 4..6, "no such parameter: did you mean 'y_2'?"),
        (
            "1 + elsewhere",
            4..13,
            "no such parameter: allowed are x, y_2, pi",
        ),
        ("δ - x", 0..2, "no such parameter"),
    ] {
        let faults = Expression::parse(text, &mut Scope::of(&["x", "y_2"])).unwrap_err();
        assert!(faults[0].allowed.contains(told), "{text}: {faults:?}");
        assert_eq!(faults[0].at, at, "{text}: {faults:?}");
    }
    let faults = Expression::parse("a*b - sin()", &mut Scope::of(&["x"])).unwrap_err();
    assert_eq!(faults.len(), 3, "{faults:?}");
}

#[test]
fn the_deepest_expression_that_is_read_does_not_fill_the_stack() {
    let mut scope = Scope::of(&["x"]);
    let half = LONGEST / 2;
    let deep = [
        "(".repeat(DEEPEST) + &"-".repeat(LONGEST - 2 * DEEPEST - 1) + "x" + &")".repeat(DEEPEST),
        "-".repeat(LONGEST - 1) + "x",
        "x^".repeat(half - 1) + "x",
        "x+".repeat(half - 1) + "x",
        "abs(".repeat(DEEPEST) + "x" + &")".repeat(DEEPEST),
    ];
    for text in deep {
        let expression = Expression::parse(&text, &mut scope).unwrap();
        assert!(expression.value(&[1.0]).is_finite(), "{text}");
    }
    for open in ["(", "-", "sin(", "1^("] {
        let text = open.repeat(LONGEST / open.len());
        assert!(Expression::parse(&text, &mut scope).is_err());
        let text = open.repeat(100_000);
        let faults = Expression::parse(&text, &mut scope).unwrap_err();
        assert!(faults[0].allowed.contains("250 bytes"));
    }
}

/// A random expression of x with all brackets, and its value where x = 3.
fn formula() -> impl Strategy<Value = (String, f64)> {
    let leaf = prop_oneof![
        Just(("x".to_owned(), 3.0)),
        (0.0..1e3_f64).prop_map(|number| (format!("{number:?}"), number)),
    ];
    leaf.prop_recursive(6, 40, 2, |inner| {
        (inner.clone(), inner, 0..7).prop_map(|((a, x), (b, y), operation)| match operation {
            0 => (format!("({a} + {b})"), x + y),
            1 => (format!("({a}-{b})"), x - y),
            2 => (format!("({a}* {b})"), x * y),
            3 => (format!("({a}/{b})"), x / y),
            4 => (format!("({a}) ^ ({b})"), x.powf(y)),
            5 => (format!("sqrt({a})"), x.sqrt()),
            _ => (format!("(-{a})"), -x),
        })
    })
}

proptest! {
    #[test]
    fn random_expressions_have_the_bits_of_the_same_formula_in_rust((text, expected) in formula()) {
        prop_assume!(text.len() <= LONGEST);
        let expression = Expression::parse(&text, &mut Scope::of(&["x"])).unwrap();
        let found = expression.value(&[3.0]);
        prop_assert!(found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan());
    }
}
