//! A TOML table that is read key by key, taking down what is wrong with it.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::number::{Entry, FINITE, List, Number, Reader, Rule};

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

    /// The keys of a table that may have any, with where they stand and their values, in the order of the file.
    pub(super) fn all_in_order(&self) -> Vec<(&'a str, Range<usize>, Entry<'a, 'i>)> {
        let mut all: Vec<_> = (self.table.iter())
            .map(|(key, value)| {
                let entry = Entry {
                    key: self.key(key.get_ref()),
                    span: value.span(),
                    value: value.get_ref(),
                };
                (key.get_ref().as_ref(), key.span(), entry)
            })
            .collect();
        all.sort_by_key(|(_, span, _)| span.start);
        all
    }

    /// The table `name`, if it is there; anything else under that name is a mistake.
    pub(super) fn table(&mut self, name: &'static str, reader: &mut Reader<'_>) -> Option<Self> {
        let Entry { key, span, value } = self.get(name)?;
        match value {
            DeValue::Table(table) => Some(Table::new(&key, span, table)),
            _ => {
                (reader.notes).wrong(span, &key, format!("give a table [{name}]"));
                None
            }
        }
    }

    /// A number or an expression, if it is there.
    pub(super) fn number(
        &mut self,
        name: &'static str,
        reader: &mut Reader<'_>,
        rule: &'static Rule,
    ) -> Option<Number> {
        let entry = self.get(name)?;
        Some(Number::read(&entry, reader, rule))
    }

    /// A whole number in a range.
    pub(super) fn whole(
        &mut self,
        name: &'static str,
        reader: &mut Reader<'_>,
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
            (reader.notes).wrong(entry.span, &entry.key, allowed);
        }
        whole
    }

    /// `true` or `false`.
    pub(super) fn flag(&mut self, name: &'static str, reader: &mut Reader<'_>) -> Option<bool> {
        let entry = self.get(name)?;
        let flag = entry.value.as_bool();
        if flag.is_none() {
            (reader.notes).wrong(entry.span, &entry.key, "give true or false");
        }
        flag
    }

    /// One of some words.
    pub(super) fn word<T: Copy>(
        &mut self,
        name: &'static str,
        reader: &mut Reader<'_>,
        words: &[(&str, T)],
    ) -> Option<T> {
        let entry = self.get(name)?;
        word(&entry, reader, words, "")
    }

    /// A list of numbers and expressions, as many as `lengths` allows, if it is there.
    pub(super) fn numbers(
        &mut self,
        name: &'static str,
        reader: &mut Reader<'_>,
        lengths: std::ops::RangeInclusive<usize>,
    ) -> Option<List> {
        let entry = self.get(name)?;
        Some(numbers(&entry, reader, lengths))
    }

    /// Takes down the keys that nobody asked for.
    pub(super) fn finish(self, reader: &mut Reader<'_>) {
        for key in self.table.keys() {
            let name = key.get_ref();
            if !self.known.contains(&name.as_ref()) {
                (reader.notes).unknown(key.span(), &self.key(name), &self.known);
            }
        }
    }
}

/// A list of numbers and expressions.
pub(super) fn numbers(
    entry: &Entry<'_, '_>,
    reader: &mut Reader<'_>,
    lengths: std::ops::RangeInclusive<usize>,
) -> List {
    let (least, most) = (*lengths.start(), *lengths.end());
    let found = (entry.value.as_array()).filter(|array| lengths.contains(&array.len()));
    if found.is_none() {
        let allowed = format!("give a list of {least} to {most} finite numbers");
        (reader.notes).wrong(entry.span.clone(), &entry.key, allowed);
    }
    let mut number = |index: usize, value: &Spanned<DeValue<'_>>| {
        let entry = Entry {
            key: format!("{}[{index}]", entry.key),
            span: value.span(),
            value: value.get_ref(),
        };
        Number::read(&entry, reader, &FINITE)
    };
    List {
        span: entry.span.clone(),
        key: entry.key.clone(),
        numbers: found.map(|array| {
            (array.iter().enumerate())
                .map(|(index, value)| number(index, value))
                .collect()
        }),
    }
}

/// One of some words, or `otherwise`.
pub(super) fn word<T: Copy>(
    entry: &Entry<'_, '_>,
    reader: &mut Reader<'_>,
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
        (reader.notes).wrong(entry.span.clone(), &entry.key, allowed);
    }
    word.map(|(_, value)| *value)
}
