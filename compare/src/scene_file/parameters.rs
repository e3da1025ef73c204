//! `[parameters]`: names with their defaults, which are numbers or expressions of the parameters above them.

use std::ops::Range;

use super::functions::function;
use super::mistakes::Notes;
use super::number::{FINITE, Number, Reader};
use super::scope::Scope;
use super::table::Table;

/// A parameter of a family.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    pub name: String,
    pub default: Number,
    /// Where the name stands.
    span: Range<usize>,
}

/// Reads `[parameters]`, if it is there, and lets what follows read them.
pub(super) fn read(file: &mut Table<'_, '_>, reader: &mut Reader<'_>) -> Vec<Parameter> {
    let Some(table) = file.table("parameters", reader) else {
        return Vec::new();
    };
    let entries = table.all_in_order();
    reader.scope.names = (entries.iter())
        .map(|(name, ..)| ((*name).to_owned(), false))
        .collect();
    let mut parameters = Vec::new();
    for (place, (name, span, entry)) in entries.into_iter().enumerate() {
        if let Err(allowed) = check_name(name) {
            reader.notes.wrong(span.clone(), &entry.key, allowed);
        }
        reader.scope.above = place;
        parameters.push(Parameter {
            name: name.to_owned(),
            default: Number::read(&entry, reader, &FINITE),
            span,
        });
    }
    reader.scope.above = parameters.len();
    parameters
}

/// Takes down the parameters that nothing reads, which are misspelt somewhere.
pub(super) fn note_unread(parameters: &[Parameter], scope: &Scope, notes: &mut Notes<'_>) {
    for (parameter, (_, is_read)) in parameters.iter().zip(&scope.names) {
        if !is_read {
            let key = format!("parameters.{}", parameter.name);
            let allowed = "no expression reads this parameter: use it, or take it out";
            notes.wrong(parameter.span.clone(), &key, allowed);
        }
    }
}

/// Refuses names that no expression could read.
fn check_name(name: &str) -> Result<(), String> {
    let letter = |c: char| c.is_ascii_alphabetic() || c == '_';
    let is_name = name.starts_with(letter) && name.chars().all(|c| letter(c) || c.is_ascii_digit());
    if !is_name {
        return Err(
            "give a name of letters, digits and _ that does not begin with a digit".to_owned(),
        );
    }
    if name == "pi" || function(name).is_some() {
        return Err(format!(
            "{name} has a meaning in expressions: give another name"
        ));
    }
    Ok(())
}
