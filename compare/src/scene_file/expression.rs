//! Expressions of parameters, such as `-dx/2`: read once, and evaluated for each scene.
//!
//! The order of operations is that of mathematics: `^` before signs, signs before `*` and `/`, these before `+` and `-`;
//! `-2^2` is -4, and `2^3^2` is `2^9`. Equal operations go from the left, so that a result has the bits of the same formula in
//! Rust.

use std::ops::Range;

use winnow::ascii::{digit1, multispace0};
use winnow::combinator::{
    Infix, Prefix, alt, cut_err, delimited, expression, opt, peek, separated, terminated,
};
use winnow::error::{ErrMode, ParserError};
use winnow::stream::{LocatingSlice, Location};
use winnow::token::{any, one_of, take_while};
use winnow::{Parser, Stateful};

use super::functions::{FUNCTIONS, Function, function};
use super::mistakes::unknown;
use super::parameters::Scope;
use crate::numbers::point_hint;

/// Longest expression, in bytes, and most brackets within one another: the parser's recursion must fit a thread's stack.
const LONGEST: usize = 250;
const DEEPEST: usize = 25;

/// A formula of parameters.
#[derive(Clone, Debug)]
pub(super) enum Expression {
    Number(f64),
    /// A parameter, by its place in the list.
    Parameter(usize),
    One(fn(f64) -> f64, Box<Self>),
    Two(fn(f64, f64) -> f64, Box<[Self; 2]>),
}

/// What is wrong within an expression, and where, in bytes of its text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    pub at: Range<usize>,
    pub allowed: String,
}

impl Expression {
    /// Reads an expression of the parameters in `scope`.
    ///
    /// # Errors
    /// Every unknown name, and the first place at which the text is no expression.
    pub(super) fn parse(text: &str, scope: &mut Scope) -> Result<Self, Vec<Fault>> {
        let whole = |allowed: String| {
            let at = 0..text.len();
            Err(vec![Fault { at, allowed }])
        };
        if text.trim().is_empty() {
            return whole("the expression is empty: give a number or an expression".to_owned());
        }
        if text.len() > LONGEST {
            return whole(format!(
                "an expression may have {LONGEST} bytes: give a part of it a name in [parameters]"
            ));
        }
        let mut input = Stateful {
            input: LocatingSlice::new(text),
            state: Reading {
                text,
                scope,
                faults: Vec::new(),
                open: 0,
            },
        };
        let whole = delimited(multispace0, sum, multispace0).parse_next(&mut input);
        let expression =
            whole.and_then(|expression| match peek(opt(any)).parse_next(&mut input)? {
                None => Ok(expression),
                Some(_) => Err(ErrMode::Cut(Fault::stray(&input))),
            });
        let mut faults = input.state.faults;
        match expression {
            Ok(expression) if faults.is_empty() => Ok(expression),
            Ok(_) => Err(faults),
            Err(error) => {
                faults.extend(error.into_inner());
                Err(faults)
            }
        }
    }

    /// The value at these values of the parameters; it may be no finite number.
    pub(super) fn value(&self, parameters: &[f64]) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Parameter(place) => parameters.get(*place).copied().unwrap_or(f64::NAN),
            Self::One(of, argument) => of(argument.value(parameters)),
            Self::Two(of, arguments) => {
                let [a, b] = &**arguments;
                of(a.value(parameters), b.value(parameters))
            }
        }
    }

    fn one(of: fn(f64) -> f64, argument: Self) -> Self {
        Self::One(of, Box::new(argument))
    }

    fn two(of: fn(f64, f64) -> f64, a: Self, b: Self) -> Self {
        Self::Two(of, Box::new([a, b]))
    }
}

/// What is known and found while an expression is read.
#[derive(Debug)]
struct Reading<'s> {
    text: &'s str,
    scope: &'s mut Scope,
    /// Names that are unknown, and calls that are wrong: reading goes on after them.
    faults: Vec<Fault>,
    /// Brackets that are open.
    open: usize,
}

type Input<'i, 's> = Stateful<LocatingSlice<&'i str>, Reading<'s>>;
type Parsed<T> = Result<T, ErrMode<Fault>>;

impl<'i, 's> ParserError<Input<'i, 's>> for Fault {
    type Inner = Self;

    /// Nothing but an operand can be missing.
    fn from_input(input: &Input<'i, 's>) -> Self {
        Self::here(input, "a number, a name or ( is missing here")
    }

    fn into_inner(self) -> Result<Self, Self> {
        Ok(self)
    }
}

impl Fault {
    /// A fault at the next character.
    fn here(input: &Input<'_, '_>, allowed: impl Into<String>) -> Self {
        let start = input.current_token_start();
        let length = input.input.chars().next().map_or(0, char::len_utf8);
        Self {
            at: start..start + length,
            allowed: allowed.into(),
        }
    }

    /// A fault at the next character, which can stand neither in an operand nor between two.
    fn stray(input: &Input<'_, '_>) -> Self {
        let allowed = match input.input.chars().next() {
            Some(')') => "no ( is closed by this",
            Some(',') => {
                let hint = point_hint(input.state.text);
                let allowed = "a comma only stands between the two numbers that a function takes";
                return Self::here(input, format!("{allowed}{hint}"));
            }
            Some(c) if c.is_alphanumeric() || "(._".contains(c) => {
                "an operator is missing before this: + - * / or ^"
            }
            _ => "this is no operator: allowed are + - * / and ^",
        };
        Self::here(input, allowed)
    }
}

/// `parser`, and the white space after it.
fn token<'i, 's, T>(
    parser: impl Parser<Input<'i, 's>, T, ErrMode<Fault>>,
) -> impl Parser<Input<'i, 's>, T, ErrMode<Fault>> {
    terminated(parser, multispace0)
}

/// Operands with signs and operators between them.
fn sum(input: &mut Input<'_, '_>) -> Parsed<Expression> {
    const SIGNS: i64 = 5;
    let signs = token(one_of(['-', '+'])).map(|sign| match sign {
        '-' => Prefix(SIGNS, |_, a| Ok(Expression::one(|a| -a, a))),
        _ => Prefix(SIGNS, |_, a| Ok(a)),
    });
    let operators = token(one_of(['+', '-', '*', '/', '^'])).map(|operator| match operator {
        '+' => Infix::Left(1, |_, a, b| Ok(Expression::two(|a, b| a + b, a, b))),
        '-' => Infix::Left(1, |_, a, b| Ok(Expression::two(|a, b| a - b, a, b))),
        '*' => Infix::Left(3, |_, a, b| Ok(Expression::two(|a, b| a * b, a, b))),
        '/' => Infix::Left(3, |_, a, b| Ok(Expression::two(|a, b| a / b, a, b))),
        _ => Infix::Right(7, |_, a, b| Ok(Expression::two(f64::powf, a, b))),
    });
    (expression(alt((number, named, bracket)))
        .prefix(signs)
        .infix(operators))
    .parse_next(input)
}

/// A number without a sign.
fn number(input: &mut Input<'_, '_>) -> Parsed<Expression> {
    let fraction = || ('.', opt(digit1));
    let digits = alt(((digit1, opt(fraction())).void(), ('.', digit1).void()));
    let exponent = (one_of(['e', 'E']), opt(one_of(['-', '+'])), digit1);
    (token((digits, opt(exponent)).take()).parse_to::<f64>())
        .map(Expression::Number)
        .parse_next(input)
}

/// An expression in brackets.
fn bracket(input: &mut Input<'_, '_>) -> Parsed<Expression> {
    let mut inner = within(input, 1)?;
    Ok(inner.remove(0))
}

/// Expressions in brackets, with commas between them.
fn within(input: &mut Input<'_, '_>, most: usize) -> Parsed<Vec<Expression>> {
    let open = input.current_token_start();
    token('(').parse_next(input)?;
    input.state.open += 1;
    if input.state.open > DEEPEST {
        let allowed = format!(
            "more than {DEEPEST} brackets within one another: name a part of it in [parameters]"
        );
        return Err(ErrMode::Cut(Fault {
            at: open..open + 1,
            allowed,
        }));
    }
    let inner = cut_err(separated(1..=most, sum, token(','))).parse_next(input)?;
    if opt(token(')')).parse_next(input)?.is_some() {
        input.state.open -= 1;
        return Ok(inner);
    }
    Err(ErrMode::Cut(if input.input.is_empty() {
        Fault {
            at: open..open + 1,
            allowed: "no ) closes this".to_owned(),
        }
    } else {
        Fault::stray(input)
    }))
}

/// A function of its arguments, a parameter or `pi`.
fn named(input: &mut Input<'_, '_>) -> Parsed<Expression> {
    let start = |c: char| c.is_alphabetic() || c == '_';
    let rest = take_while(0.., |c: char| c.is_alphanumeric() || c == '_');
    let (name, at) = token((one_of(start), rest).take().with_span()).parse_next(input)?;
    if !input.input.starts_with('(') {
        let found = match function(name) {
            Some(_) => Err(format!(
                "write what it is a function of in brackets: {name}(...)"
            )),
            None if name == "pi" => Ok(Expression::Number(std::f64::consts::PI)),
            None => input.state.scope.find(name).map(Expression::Parameter),
        };
        return Ok(found.unwrap_or_else(|allowed| wrong(input, at, allowed)));
    }
    let arguments = within(input, usize::MAX)?;
    let given = arguments.len();
    let mut arguments = arguments.into_iter();
    let call = match (function(name), arguments.next(), arguments.next(), given) {
        (Some(Function::One(of)), Some(a), None, 1) => Ok(Expression::one(of, a)),
        (Some(Function::Two(of)), Some(a), Some(b), 2) => Ok(Expression::two(of, a, b)),
        (Some(function), ..) => Err(match function {
            Function::One(_) => format!("{name} takes one number, and here are {given}"),
            Function::Two(_) => format!("{name} takes two numbers, and here are {given}"),
        }),
        (None, ..) => Err(unknown(
            "function",
            name,
            &FUNCTIONS.map(|(known, _)| known),
        )),
    };
    Ok(call.unwrap_or_else(|allowed| wrong(input, at, allowed)))
}

/// Takes down a fault, and stands in for the operand that has it.
fn wrong(input: &mut Input<'_, '_>, at: Range<usize>, allowed: String) -> Expression {
    input.state.faults.push(Fault { at, allowed });
    Expression::Number(f64::NAN)
}

#[cfg(test)]
mod tests {
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
            "(".repeat(DEEPEST)
                + &"-".repeat(LONGEST - 2 * DEEPEST - 1)
                + "x"
                + &")".repeat(DEEPEST),
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
}
