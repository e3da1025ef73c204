//! A TOML table that is read key by key, taking down what is wrong with it.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::mistakes::Notes;

/// A value with its full key.
pub(super) struct Entry<'a, 'i> {
    pub key: String,
    pub span: Range<usize>,
    pub value: &'a DeValue<'i>,
}

/// A table, where it stands, and the keys that were asked for.
pub(super) struct Table<'a, 'i> {
    path: String,
    span: Range<usize>,
    table: &'a DeTable<'i>,
    known: Vec<&'static str>,
}

impl<'a, 'i> Table<'a, 'i> {
    pub(super) fn new(path: &str, span: Range<usize>, table: &'a DeTable<'i>) -> Self {
        Self {
            path: path.to_owned(),
            span,
            table,
            known: Vec::new(),
        }
    }

    /// Where the table stands.
    pub(super) fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// The full key of `name`.
    pub(super) fn key(&self, name: &str) -> String {
        if self.path.is_empty() {
            name.to_owned()
        } else {
            format!("{}.{name}", self.path)
        }
    }

    /// The value of `name`, if it is there.
    pub(super) fn get(&mut self, name: &'static str) -> Option<Entry<'a, 'i>> {
        if !self.known.contains(&name) {
            self.known.push(name);
        }
        let (_, value) = (self.table.iter()).find(|(key, _)| key.get_ref() == name)?;
        Some(Entry {
            key: self.key(name),
            span: value.span(),
            value: value.get_ref(),
        })
    }

    /// A number that `allowed` says in words and `is_allowed` tests.
    pub(super) fn number(
        &mut self,
        name: &'static str,
        notes: &mut Notes<'_>,
        allowed: &str,
        is_allowed: impl Fn(f64) -> bool,
    ) -> Option<f64> {
        let entry = self.get(name)?;
        let number = number(entry.value).filter(|value| is_allowed(*value));
        if number.is_none() {
            notes.wrong(entry.span, &entry.key, format!("give {allowed}"));
        }
        number
    }

    /// A whole number in a range.
    pub(super) fn whole(
        &mut self,
        name: &'static str,
        notes: &mut Notes<'_>,
        range: std::ops::RangeInclusive<usize>,
    ) -> Option<usize> {
        let entry = self.get(name)?;
        let whole = entry.value.as_integer().and_then(|integer| {
            let parsed = usize::from_str_radix(integer.as_str(), integer.radix());
            parsed.ok().filter(|value| range.contains(value))
        });
        if whole.is_none() {
            let (low, high) = range.into_inner();
            let allowed = format!("give a whole number from {low} to {high}");
            notes.wrong(entry.span, &entry.key, allowed);
        }
        whole
    }

    /// `true` or `false`.
    pub(super) fn flag(&mut self, name: &'static str, notes: &mut Notes<'_>) -> Option<bool> {
        let entry = self.get(name)?;
        let flag = entry.value.as_bool();
        if flag.is_none() {
            notes.wrong(entry.span, &entry.key, "give true or false");
        }
        flag
    }

    /// One of some words.
    pub(super) fn word<T: Copy>(
        &mut self,
        name: &'static str,
        notes: &mut Notes<'_>,
        words: &[(&str, T)],
    ) -> Option<T> {
        let entry = self.get(name)?;
        word(&entry, notes, words, "")
    }

    /// A list of finite numbers, as many as `lengths` allows.
    pub(super) fn numbers(
        &mut self,
        name: &'static str,
        notes: &mut Notes<'_>,
        lengths: std::ops::RangeInclusive<usize>,
    ) -> Option<(Vec<f64>, Range<usize>)> {
        let entry = self.get(name)?;
        numbers(&entry, notes, lengths).map(|numbers| (numbers, entry.span))
    }

    /// Takes down the keys that nobody asked for.
    pub(super) fn finish(self, notes: &mut Notes<'_>) {
        for key in self.table.keys() {
            let name = key.get_ref();
            if !self.known.contains(&name.as_ref()) {
                notes.unknown(key.span(), &self.key(name), &self.known);
            }
        }
    }
}

/// A finite number, written as one or as an integer.
pub(super) fn number(value: &DeValue<'_>) -> Option<f64> {
    let parsed = match value {
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse(),
        DeValue::Float(float) => float.as_str().parse::<f64>(),
        _ => return None,
    };
    parsed.ok().filter(|value| value.is_finite())
}

/// A list of finite numbers.
pub(super) fn numbers(
    entry: &Entry<'_, '_>,
    notes: &mut Notes<'_>,
    lengths: std::ops::RangeInclusive<usize>,
) -> Option<Vec<f64>> {
    let (least, most) = (*lengths.start(), *lengths.end());
    let found = (entry.value.as_array()).filter(|array| lengths.contains(&array.len()));
    let Some(array) = found else {
        let allowed = format!("give a list of {least} to {most} finite numbers");
        notes.wrong(entry.span.clone(), &entry.key, allowed);
        return None;
    };
    let mut all = Vec::new();
    for (index, value) in array.iter().enumerate() {
        match number(value.get_ref()) {
            Some(number) => all.push(number),
            None => {
                let key = format!("{}[{index}]", entry.key);
                notes.wrong(Spanned::span(value), &key, "give a finite number");
            }
        }
    }
    (all.len() == array.len()).then_some(all)
}

/// One of some words, or `otherwise`.
pub(super) fn word<T: Copy>(
    entry: &Entry<'_, '_>,
    notes: &mut Notes<'_>,
    words: &[(&str, T)],
    otherwise: &str,
) -> Option<T> {
    let typed = entry.value.as_str();
    let word = typed.and_then(|typed| words.iter().find(|(word, _)| *word == typed));
    if word.is_none() {
        let known: Vec<_> = words
            .iter()
            .map(|(word, _)| format!("\"{word}\""))
            .collect();
        let allowed = format!("give {}{otherwise}", known.join(" or "));
        notes.wrong(entry.span.clone(), &entry.key, allowed);
    }
    word.map(|(_, value)| *value)
}
