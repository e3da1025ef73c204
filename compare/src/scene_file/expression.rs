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
use super::scope::Scope;
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
    within(input, sum)
}

/// What stands in brackets.
fn within<'i, 's, T>(
    input: &mut Input<'i, 's>,
    inside: impl Parser<Input<'i, 's>, T, ErrMode<Fault>>,
) -> Parsed<T> {
    let open = input.current_token_start();
    let fault = |allowed: String| {
        let at = open..open + 1;
        Err(ErrMode::Cut(Fault { at, allowed }))
    };
    token('(').parse_next(input)?;
    input.state.open += 1;
    if input.state.open > DEEPEST {
        return fault(format!(
            "more than {DEEPEST} brackets within one another: give a part of it a name in [parameters]"
        ));
    }
    let inner = cut_err(inside).parse_next(input)?;
    if opt(token(')')).parse_next(input)?.is_some() {
        input.state.open -= 1;
        Ok(inner)
    } else if input.input.is_empty() {
        fault("no ) closes this".to_owned())
    } else {
        Err(ErrMode::Cut(Fault::stray(input)))
    }
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
    let arguments: Vec<_> = within(input, separated(1.., cut_err(sum), token(',')))?;
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
mod tests;
