//! A number of a scene file, as it stands there: a constant or an expression of the parameters.

use std::ops::Range;

use toml::de::DeValue;

use super::expression::{Expression, Fault};
use super::mistakes::Notes;
use super::scope::Scope;

/// A value with its full key.
pub(super) struct Entry<'a, 'i> {
    pub key: String,
    pub span: Range<usize>,
    pub value: &'a DeValue<'i>,
}

/// What is noted and known while a file is read.
pub(super) struct Reader<'t> {
    pub notes: Notes<'t>,
    pub scope: Scope,
}

/// Which numbers are allowed: in words, and as a test of a finite number.
#[derive(Debug)]
pub(super) struct Rule {
    pub allowed: fn() -> String,
    pub holds: fn(f64) -> bool,
}

pub(super) const FINITE: Rule = Rule {
    allowed: || "a finite number".to_owned(),
    holds: |_| true,
};

/// A number, where it stands, and which ones are allowed there.
#[derive(Clone, Debug)]
pub(super) struct Number {
    pub span: Range<usize>,
    pub key: String,
    pub rule: &'static Rule,
    pub formula: Formula,
}

/// How a number is given.
#[derive(Clone, Debug)]
pub(super) enum Formula {
    Constant(f64),
    Expression(Expression),
    /// In a way that is a mistake, which is noted.
    Wrong,
}

/// A list of numbers, and where it stands; none if it is no list, which is noted.
#[derive(Clone, Debug)]
pub(super) struct List {
    pub span: Range<usize>,
    pub key: String,
    pub numbers: Option<Vec<Number>>,
}

impl Number {
    /// Reads a number or an expression; whether it is allowed is seen when it has a value.
    pub(super) fn read(
        entry: &Entry<'_, '_>,
        reader: &mut Reader<'_>,
        rule: &'static Rule,
    ) -> Self {
        let formula = match entry.value {
            DeValue::String(text) => expression(entry, text, reader),
            value => constant(value).map(Formula::Constant),
        };
        if formula.is_none() && entry.value.as_str().is_none() {
            let allowed = format!("give {}", (rule.allowed)());
            (reader.notes).wrong(entry.span.clone(), &entry.key, allowed);
        }
        Self {
            span: entry.span.clone(),
            key: entry.key.clone(),
            rule,
            formula: formula.unwrap_or(Formula::Wrong),
        }
    }

    /// The value at these values of the parameters, finite or not; none if the number is a mistake.
    pub(super) fn value(&self, parameters: &[f64]) -> Option<f64> {
        match &self.formula {
            Formula::Constant(value) => Some(*value),
            Formula::Expression(expression) => Some(expression.value(parameters)),
            Formula::Wrong => None,
        }
    }

    /// Whether the number depends on how it is computed.
    pub(super) fn is_expression(&self) -> bool {
        matches!(self.formula, Formula::Expression(_))
    }
}

/// A finite number, written as one or as an integer.
fn constant(value: &DeValue<'_>) -> Option<f64> {
    let parsed = match value {
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse(),
        DeValue::Float(float) => float.as_str().parse::<f64>(),
        _ => return None,
    };
    parsed.ok().filter(|value| value.is_finite())
}

/// The expression in a string; none if there are mistakes in it, which are noted where they stand.
fn expression(entry: &Entry<'_, '_>, text: &str, reader: &mut Reader<'_>) -> Option<Formula> {
    let faults = match Expression::parse(text, &mut reader.scope) {
        Ok(expression) => return Some(Formula::Expression(expression)),
        Err(faults) => faults,
    };
    // With escapes a string does not stand in the file as it is read.
    let inside = (reader.notes.piece(&entry.span)).and_then(|quoted| quoted.find(text));
    for Fault { at, allowed } in faults {
        let span = inside.map_or(entry.span.clone(), |inside| {
            let start = entry.span.start + inside;
            start + at.start..start + at.end
        });
        let found = reader.notes.quote(span.clone());
        reader.notes.note(span, &entry.key, found, allowed);
    }
    None
}
