//! Hydrodynamics, repulsion and gravity of a scene file.

use std::ops::Range;

use bem::Bem;
use nalgebra::Vector3;
use scene::{Gravity, Repulsion};
use toml::de::DeValue;

use super::mistakes::Notes;
use super::table::{Entry, Table, word};
use crate::Method;

/// Hydrodynamics of a scene file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hydrodynamics {
    pub method: Method,
    pub mesh: usize,
    pub direct: bool,
}

impl From<Method> for Hydrodynamics {
    fn from(method: Method) -> Self {
        Self {
            method,
            mesh: Bem::DEFAULT_LEVEL,
            direct: false,
        }
    }
}

/// Names in a scene file; lubrication theory has two forms.
const METHODS: [(&str, Method); 4] = [
    (Method::Isolated.name(), Method::Isolated),
    ("lubrication", Method::Lt),
    (Method::Exact.name(), Method::Exact),
    (Method::Bem.name(), Method::Bem),
];

const FORMS: [(&str, Method); 2] = [
    ("published", Method::Lt),
    ("corrected", Method::LtCorrected),
];

/// The table `name`, if it is there; anything else under that name is a mistake.
pub(super) fn table<'a, 'i>(
    file: &mut Table<'a, 'i>,
    name: &'static str,
    notes: &mut Notes<'_>,
) -> Option<Table<'a, 'i>> {
    let Entry { key, span, value } = file.get(name)?;
    match value {
        DeValue::Table(table) => Some(Table::new(&key, span, table)),
        _ => {
            notes.wrong(span, &key, format!("give a table [{name}]"));
            None
        }
    }
}

/// `hydrodynamics`: a word or a table.
pub(super) fn hydrodynamics(
    file: &mut Table<'_, '_>,
    notes: &mut Notes<'_>,
) -> Option<Hydrodynamics> {
    const NEEDED: &str = "give \"none\", \"lubrication\", \"exact\" or \"bem\"";
    let Some(entry) = file.get("hydrodynamics") else {
        notes.missing(file.span(), "hydrodynamics", NEEDED);
        return None;
    };
    let DeValue::Table(inner) = entry.value else {
        let otherwise = " or a table [hydrodynamics]";
        return word(&entry, notes, &METHODS, otherwise).map(Hydrodynamics::from);
    };
    let before = notes.count();
    let mut table = Table::new(&entry.key, entry.span, inner);
    let method = table.word("model", notes, &METHODS);
    if method.is_none() && notes.count() == before {
        notes.missing(table.span(), &table.key("model"), NEEDED);
    }
    let mut chosen = Hydrodynamics::from(method.unwrap_or(Method::Isolated));
    // Only keys of the model are known; without one, all are.
    let of = |models: &[Method]| method.is_none_or(|method| models.contains(&method));
    if of(&[Method::Lt]) {
        chosen.method = table.word("form", notes, &FORMS).unwrap_or(chosen.method);
    }
    if of(&[Method::Bem]) {
        let (lowest, highest) = Bem::LEVELS;
        let level = table.whole("level", notes, lowest..=highest);
        chosen.mesh = level.unwrap_or(chosen.mesh);
    }
    if of(&[Method::Exact, Method::Bem]) {
        chosen.direct = table.flag("direct", notes).unwrap_or(false);
    }
    table.finish(notes);
    (notes.count() == before).then_some(chosen)
}

/// `repulsion`: none unless there is a word or a table; with its place.
pub(super) fn repulsion(
    file: &mut Table<'_, '_>,
    notes: &mut Notes<'_>,
) -> Option<Option<(Repulsion, Range<usize>)>> {
    const WORDS: [(&str, Option<Repulsion>); 2] =
        [("paper", Some(Repulsion::PAPER)), ("off", None)];
    let Some(entry) = file.get("repulsion") else {
        return Some(None);
    };
    let span = entry.span.clone();
    let DeValue::Table(inner) = entry.value else {
        let otherwise = " or a table [repulsion]";
        let word = word(&entry, notes, &WORDS, otherwise)?;
        return Some(word.map(|repulsion| (repulsion, span)));
    };
    let before = notes.count();
    let mut table = Table::new(&entry.key, entry.span, inner);
    let mut kappa = |name, otherwise: f64, notes: &mut Notes<'_>| {
        (table.number(name, notes, "a number greater than 0", |v| v > 0.0)).unwrap_or(otherwise)
    };
    let kappa1 = kappa("kappa1", Repulsion::PAPER.kappa1(), notes);
    let kappa2 = kappa("kappa2", Repulsion::PAPER.kappa2(), notes);
    table.finish(notes);
    if notes.count() > before {
        return None;
    }
    match Repulsion::new(kappa1, kappa2) {
        Ok(repulsion) => Some(Some((repulsion, span))),
        Err(error) => {
            notes.wrong(span, "repulsion", error.to_string());
            None
        }
    }
}

/// `[gravity]`: none unless it is there.
pub(super) fn gravity(file: &mut Table<'_, '_>, notes: &mut Notes<'_>) -> Option<Option<Gravity>> {
    let before = notes.count();
    let Some(mut table) = table(file, "gravity", notes) else {
        return (notes.count() == before).then_some(None);
    };
    let direction = direction(&mut table, "direction", notes);
    if direction.is_none() && notes.count() == before {
        let allowed = "give the vector along which gravity pulls, such as [0, -1]";
        notes.missing(table.span(), &table.key("direction"), allowed);
    }
    table.finish(notes);
    let (direction, span) = direction?;
    match Gravity::new(direction) {
        Ok(gravity) => Some(Some(gravity)),
        Err(error) => {
            notes.wrong(span, "gravity.direction", error.to_string());
            None
        }
    }
}

/// A vector of two or three numbers.
pub(super) fn direction(
    table: &mut Table<'_, '_>,
    name: &'static str,
    notes: &mut Notes<'_>,
) -> Option<(Vector3<f64>, Range<usize>)> {
    let (numbers, span) = table.numbers(name, notes, 2..=3)?;
    Some((vector(&numbers), span))
}

/// Missing components are zero.
pub(super) fn vector(numbers: &[f64]) -> Vector3<f64> {
    let at = |i: usize| numbers.get(i).copied().unwrap_or(0.0);
    Vector3::new(at(0), at(1), at(2))
}
