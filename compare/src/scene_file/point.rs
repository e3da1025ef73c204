//! One point of a family: values of its parameters, and what is wrong with the scene that they give.

use std::ops::Range;

use nalgebra::Vector3;
use scene::MAX_MODES;

use super::mistakes::{Mistakes, Notes, unknown};
use super::number::{List, Number};
use super::parameters::Parameter;
use crate::numbers::written;

/// Values of the parameters, and mistakes that are found with them.
pub(super) struct Point<'f> {
    notes: Notes<'f>,
    parameters: &'f [Parameter],
    values: Vec<f64>,
}

impl<'f> Point<'f> {
    /// The point at which the parameters have the values `given`, or their defaults.
    pub(super) fn new(
        notes: Notes<'f>,
        parameters: &'f [Parameter],
        given: &[(&str, f64)],
    ) -> Self {
        let mut point = Self {
            notes,
            parameters,
            values: Vec::with_capacity(parameters.len()),
        };
        for parameter in parameters {
            let of_name = given.iter().rfind(|(name, _)| *name == parameter.name);
            let value = match of_name {
                Some((_, value)) if value.is_finite() => Some(*value),
                Some((name, value)) => {
                    let Number { span, key, .. } = &parameter.default;
                    let found = format!("{name} = {value}");
                    let allowed = "give a finite number".to_owned();
                    point.notes.note(span.clone(), key, found, allowed);
                    None
                }
                None => point.value(&parameter.default),
            };
            // What reads it is not a mistake of its own.
            point.values.push(value.unwrap_or(f64::NAN));
        }
        for (name, value) in given {
            if !parameters.iter().any(|parameter| parameter.name == *name) {
                let known: Vec<_> = parameters.iter().map(|known| known.name.as_str()).collect();
                let allowed = unknown("parameter", name, &known);
                let found = format!("{name} = {}", written(*value));
                point.notes.note(0..0, "parameters", found, allowed);
            }
        }
        point
    }

    /// The values of the parameters, in the order of the file.
    pub(super) fn parameters(&self) -> &[f64] {
        &self.values
    }

    /// The value of a number, if it is allowed.
    pub(super) fn value(&mut self, number: &Number) -> Option<f64> {
        let value = number.value(&self.values)?;
        if !value.is_finite() {
            // A parameter that has no value is noted already.
            let is_known = self.values.iter().all(|value| value.is_finite());
            if is_known {
                self.refuse(number, value, "a finite number");
            }
            return None;
        }
        if !(number.rule.holds)(value) {
            self.refuse(number, value, &(number.rule.allowed)());
            return None;
        }
        Some(value)
    }

    /// Takes down that a number has a value that is not allowed.
    pub(super) fn refuse(&mut self, number: &Number, value: f64, allowed: &str) {
        let quoted = self.notes.quote(number.span.clone());
        let (found, with) = if number.is_expression() {
            (format!("{quoted} = {}", written(value)), self.with())
        } else {
            (quoted, String::new())
        };
        let allowed = format!("give {allowed}{with}");
        self.notes
            .note(number.span.clone(), &number.key, found, allowed);
    }

    /// The values of a list and how many there are.
    pub(super) fn values(&mut self, list: &List) -> Option<([f64; MAX_MODES], usize)> {
        let numbers = list.numbers.as_ref()?;
        let mut values = [0.0; MAX_MODES];
        let mut known = 0;
        for (slot, number) in values.iter_mut().zip(numbers) {
            if let Some(value) = self.value(number) {
                *slot = value;
                known += 1;
            }
        }
        (known == numbers.len()).then_some((values, known))
    }

    /// The vector that a list of two or three numbers gives; the third component is zero if left out.
    pub(super) fn vector(&mut self, list: &List) -> Option<Vector3<f64>> {
        self.values(list)
            .map(|([x, y, z, ..], _)| Vector3::new(x, y, z))
    }

    /// A mistake about what stands at `span`, which may depend on the parameters.
    pub(super) fn wrong(&mut self, span: Range<usize>, key: &str, reason: &str) {
        let with = self.with();
        self.notes.wrong(span, key, format!("{reason}{with}"));
    }

    /// `result`, whose error is a mistake about what stands at `span`.
    pub(super) fn accept<T, E: std::fmt::Display>(
        &mut self,
        result: Result<T, E>,
        span: &Range<usize>,
        key: &str,
    ) -> Option<T> {
        result
            .map_err(|error| self.wrong(span.clone(), key, &error.to_string()))
            .ok()
    }

    /// `found`, unless there are mistakes.
    pub(super) fn finish<T>(self, found: Option<T>) -> Result<T, Mistakes> {
        match found {
            Some(found) if self.notes.is_empty() => Ok(found),
            _ => Err(self.notes.into_mistakes()),
        }
    }

    /// The values of the parameters in words, to go after what is wrong with them.
    fn with(&self) -> String {
        let values: Vec<_> = (self.parameters.iter().zip(&self.values))
            .map(|(parameter, value)| format!("{} = {}", parameter.name, written(*value)))
            .collect();
        if values.is_empty() {
            return String::new();
        }
        format!("; with {}", values.join(", "))
    }
}
