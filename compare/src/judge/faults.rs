//! What is wrong with a submission, and what would mend it.

use std::f64::consts::PI;

use super::points::{Item, Point};
use crate::numbers::{few_digits, rounded};

/// Error from which on something is wrong, relative to the larger of the truth and its value of a lone sphere.
pub const FAULT: f64 = 1e-4;

/// Spread of ratios up to which they are one factor.
pub(super) const ONE_FACTOR: f64 = 5e-3;

/// A kind of fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// It would fit with the other sign.
    Sign,
    /// It is that of the other sphere.
    Swapped,
    /// All would fit if gaps were multiplied by this.
    GapUnit(f64),
    /// All would fit if gaps were distances of the centres.
    Distance,
    /// It is this many times what it should be, at all gaps.
    Factor(f64),
    /// The same with the other sign.
    SignAndFactor(f64),
    /// It is this many times what it should be, at gaps up to the second number.
    FactorBelow(f64, f64),
    /// Beyond this gap the spheres are alone, and should not be.
    Cut(f64),
    /// It is that of a lone sphere at every gap.
    Alone,
    /// It lies on straight lines between some of the gaps; how many of its gaps are on none.
    StraightLines(usize),
    /// It is right at its gaps, and wrong between them by its own interpolation.
    Between,
    /// One value alone is wrong, at this gap.
    OneValue(f64),
    /// A singular term near contact is missing.
    NoLubrication,
    /// A singular term near contact has this factor instead of the second number.
    Coefficient(f64, f64),
    /// The singular terms are right, and the constant next to them is wrong.
    Constant,
    /// It has the wrong sign at some gaps, of which these are the smallest and the largest.
    SignAt(f64, f64),
    /// Far away it is this many times what it should be.
    Far(f64),
    /// It is off, and none of the other kinds says why.
    Error,
}

/// What a fault spoils.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affected {
    /// With what something is wrong.
    pub item: Item,
    /// Largest error, and the gap where it is.
    pub worst: (f64, f64),
    /// The number that the fault comes with.
    pub number: f64,
}

/// A fault of some quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// What is wrong.
    pub kind: Kind,
    /// With what.
    pub of: Vec<Affected>,
}

impl Kind {
    /// One of each kind, with numbers that mean nothing.
    pub const ALL: [Self; 18] = [
        Self::Sign,
        Self::Swapped,
        Self::GapUnit(2.0),
        Self::Distance,
        Self::Factor(2.0),
        Self::SignAndFactor(-2.0),
        Self::FactorBelow(2.0, 1.0),
        Self::Cut(1.0),
        Self::Alone,
        Self::StraightLines(8),
        Self::Between,
        Self::OneValue(1.0),
        Self::NoLubrication,
        Self::Coefficient(2.0, 1.0),
        Self::Constant,
        Self::SignAt(1.0, 2.0),
        Self::Far(2.0),
        Self::Error,
    ];

    /// Name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sign => "wrong sign",
            Self::Swapped => "spheres exchanged",
            Self::GapUnit(_) => "wrong unit of the gap",
            Self::Distance => "distances in place of gaps",
            Self::Factor(_) => "wrong factor",
            Self::SignAndFactor(_) => "wrong sign and factor",
            Self::FactorBelow(..) => "wrong factor near contact",
            Self::Cut(_) => "cut",
            Self::Alone => "no effect of the other sphere",
            Self::StraightLines(_) => "straight lines between few gaps",
            Self::Between => "wrong between its gaps",
            Self::OneValue(_) => "one wrong value",
            Self::NoLubrication => "missing lubrication",
            Self::Coefficient(..) => "wrong coefficient of lubrication",
            Self::Constant => "wrong constant next to lubrication",
            Self::SignAt(..) => "wrong sign at some gaps",
            Self::Far(_) => "wrong far field",
            Self::Error => "inaccurate",
        }
    }

    /// The number that it comes with.
    #[must_use]
    pub fn number(self) -> f64 {
        match self {
            Self::Factor(number)
            | Self::GapUnit(number)
            | Self::SignAndFactor(number)
            | Self::FactorBelow(number, _)
            | Self::Cut(number)
            | Self::OneValue(number)
            | Self::Coefficient(number, _)
            | Self::SignAt(number, _)
            | Self::Far(number) => number,
            Self::StraightLines(number) => number as f64,
            Self::Sign => -1.0,
            Self::Swapped
            | Self::Distance
            | Self::Alone
            | Self::Between
            | Self::NoLubrication
            | Self::Constant
            | Self::Error => f64::NAN,
        }
    }

    /// Whether two faults are one of several quantities.
    fn is_like(self, other: Self) -> bool {
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < ONE_FACTOR;
        match (self, other) {
            (Self::Factor(a), Self::Factor(b))
            | (Self::SignAndFactor(a), Self::SignAndFactor(b)) => close(a, b),
            (Self::FactorBelow(a, at), Self::FactorBelow(b, also)) => {
                close(a, b) && close(at, also)
            }
            (Self::Cut(a), Self::Cut(b)) | (Self::OneValue(a), Self::OneValue(b)) => close(a, b),
            (Self::Coefficient(a, at), Self::Coefficient(b, also)) => {
                close(a / at, b / also) && close(at.abs(), also.abs())
            }
            (Self::SignAt(..), _) => false,
            _ => std::mem::discriminant(&self) == std::mem::discriminant(&other),
        }
    }
}

/// To be, to have, and what should be.
type Verbs = (&'static str, &'static str, &'static str);

impl Fault {
    /// Of one item with these points.
    pub(super) fn new(kind: Kind, item: Item, points: &[Point]) -> Self {
        let affected = Affected {
            item,
            worst: worst(points),
            number: kind.number(),
        };
        Self {
            kind,
            of: vec![affected],
        }
    }

    /// With what something is wrong.
    #[must_use]
    pub fn items(&self) -> Vec<Item> {
        self.of.iter().map(|affected| affected.item).collect()
    }

    /// Whether it is one of this item.
    pub(super) fn is_of(&self, item: Item) -> bool {
        self.of.iter().any(|affected| affected.item == item)
    }

    /// The verbs that go with its items.
    fn verbs(&self) -> Verbs {
        if self.of.len() == 1 {
            ("is", "has", "it should")
        } else {
            ("are", "have", "they should")
        }
    }

    /// How little it explains: 1 for a cause, more for what has none, by the number of items.
    pub(super) fn vagueness(&self) -> f64 {
        match self.kind {
            Kind::Error
            | Kind::SignAt(..)
            | Kind::Far(_)
            | Kind::Constant
            | Kind::OneValue(_)
            | Kind::Alone => 2.0 + 0.5 * self.of.len() as f64,
            _ => 1.0,
        }
    }

    /// Largest error, and the gap where it is.
    #[must_use]
    pub fn worst(&self) -> (f64, f64) {
        largest(self.of.iter().map(|affected| affected.worst))
    }

    /// The fault in a sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        let names = listed(&self.items());
        let (worst, at) = self.worst();
        let percent = size_percent(worst);
        let at = few_digits(at);
        let (is, has, should) = self.verbs();
        match self.kind {
            Kind::Sign => format!("{names} would fit with the other sign"),
            Kind::Swapped => {
                format!("{names} would fit if those of the two spheres were exchanged")
            }
            Kind::GapUnit(factor) => format!(
                "all would fit if its gaps were multiplied by {}: they are in another unit than the radius",
                number(factor)
            ),
            Kind::Distance => {
                "all would fit if its gaps were distances of the centres: 2 radii less are the gaps"
                    .to_owned()
            }
            Kind::Factor(factor) => format!(
                "{names} {is} {} times what {should} be at every gap{}: would fit if divided by {}",
                number(factor),
                hint(factor, &self.items()),
                number(factor)
            ),
            Kind::SignAndFactor(factor) => format!(
                "{names} would fit with the other sign and divided by {}",
                number(factor.abs())
            ),
            Kind::FactorBelow(factor, below) => format!(
                "{names} {is} {} times what {should} be at gaps up to {} and right beyond: would fit if divided by {} there",
                number(factor),
                few_digits(below),
                number(factor)
            ),
            Kind::Cut(cut) => format!(
                "from gap {} on the spheres no longer feel each other ({names}): a cut, off by {percent} at gap {at}",
                few_digits(cut)
            ),
            Kind::Alone => format!(
                "{names} {is} that of a lone sphere at every gap, off by up to {percent} (gap {at})"
            ),
            Kind::StraightLines(_) => format!(
                "{names} {is} on straight lines between few gaps, as in a table that is read: off by up to {percent} between them (gap {at})"
            ),
            Kind::Between => format!(
                "{names} {is} right at the gaps of the file and off by up to {percent} between them (gap {at}): the gaps are too far apart for this interpolation"
            ),
            Kind::OneValue(gap) => format!(
                "{names} {is} off by {percent} at gap {} and right next to it",
                few_digits(gap)
            ),
            Kind::NoLubrication => {
                format!(
                    "lubrication is missing or far too weak in {names}: off by {percent} at gap {at}"
                )
            }
            Kind::Coefficient(value, truth) => {
                // Of several loads the size, whose signs alternate.
                let sign = if value * truth < 0.0 { -1.0 } else { 1.0 };
                format!(
                    "near contact {names} {has} {} where {} belongs, in front of the singular term",
                    number(sign * value.abs()),
                    number(truth.abs())
                )
            }
            Kind::Constant => format!(
                "near contact {names} {has} the right singular terms and wrong constants next to them: off by up to {percent} (gap {at})"
            ),
            Kind::SignAt(from, to) if from < to => format!(
                "{names} has the wrong sign at gaps from {} to {}",
                few_digits(from),
                few_digits(to)
            ),
            Kind::SignAt(at, _) => format!("{names} has the wrong sign at gap {}", few_digits(at)),
            Kind::Far(_) => self.each_far(),
            Kind::Error => self.each_error(),
        }
    }

    /// The factors far away, one by one unless they are one.
    fn each_far(&self) -> String {
        let factors = || self.of.iter().map(|affected| affected.number);
        let (least, most) = (
            factors().fold(f64::INFINITY, f64::min),
            factors().fold(0.0, f64::max),
        );
        if most / least - 1.0 < ONE_FACTOR {
            let (is, _, should) = self.verbs();
            return format!(
                "far away {} {is} {} times what {should} be",
                listed(&self.items()),
                number(most)
            );
        }
        let (first, rest) = self.of.split_at(self.of.len().min(MOST_ONE_BY_ONE));
        let each: Vec<String> = (first.iter())
            .map(|affected| format!("{} is {}", affected.item, number(affected.number)))
            .collect();
        let more = match rest.len() {
            0 => String::new(),
            more => format!(", {more} more"),
        };
        format!("far away {} times what it should be{more}", each.join(", "))
    }

    /// The largest errors one by one, and how many are smaller.
    fn each_error(&self) -> String {
        let mut all = self.of.clone();
        all.sort_by(|a, b| b.worst.0.total_cmp(&a.worst.0));
        let (first, rest) = all.split_at(all.len().min(MOST_ONE_BY_ONE));
        let each: Vec<String> = (first.iter().enumerate())
            .map(|(place, Affected { item, worst, .. })| {
                let is = if place == 0 { "is off by" } else { "by" };
                let (error, gap) = (size_percent(worst.0), few_digits(worst.1));
                format!("{item} {is} {error} (gap {gap})")
            })
            .collect();
        let more = match rest.len() {
            0 => String::new(),
            more => format!(", {more} more by less"),
        };
        format!("{}{more}", each.join(", "))
    }
}

/// Most items that are told one by one with their numbers.
const MOST_ONE_BY_ONE: usize = 4;

/// What a factor may come from.
fn hint(factor: f64, items: &[Item]) -> String {
    let times = factor.max(1.0 / factor);
    for (unit, name) in [
        (6.0 * PI, "6 pi"),
        (8.0 * PI, "8 pi"),
        (4.0 * PI, "4 pi"),
        (PI, "pi"),
    ] {
        if (times / unit - 1.0).abs() < 1e-3 {
            return format!(" (a factor of {name})");
        }
    }
    let is_rigid =
        |item: &&Item| matches!(item, Item::Quantity(quantity) if quantity.mode().is_none());
    if items.iter().filter(is_rigid).count() == 10 {
        " (all of them: another viscosity?)".to_owned()
    } else {
        String::new()
    }
}

/// A number as a person reads it.
fn number(value: f64) -> String {
    if value.abs() < 0.01 {
        return crate::numbers::size(value);
    }
    let digits = if value.abs() >= 100.0 { 1 } else { 3 };
    rounded(value, digits)
        .trim_end_matches('0')
        .trim_end_matches('.')
        .to_owned()
}

/// An error in per cent, with two digits.
pub(super) fn size_percent(error: f64) -> String {
    let percent = 100.0 * error.abs();
    if percent >= 1e6 || !percent.is_finite() {
        format!("{} %", crate::numbers::size(percent))
    } else if percent <= 0.0 {
        "0 %".to_owned()
    } else if percent >= 10.0 {
        format!("{percent:.0} %")
    } else if percent >= 0.1 {
        format!("{percent:.1} %")
    } else {
        format!("{} %", crate::numbers::size(percent))
    }
}

/// Names of some items, the first few of many.
pub(super) fn listed(items: &[Item]) -> String {
    const MOST: usize = 6;
    let names: Vec<String> = items.iter().take(MOST).map(Item::to_string).collect();
    let more = items.len().saturating_sub(MOST);
    let is_torque = |item: &Item| matches!(item, Item::Quantity(quantity) if quantity.is_torque());
    let kind = if items.len() > 2 && items.iter().all(is_torque) {
        " (torques)"
    } else {
        ""
    };
    match (names.split_last(), more) {
        (None, _) => String::new(),
        (Some((last, [])), 0) => last.clone(),
        (Some((last, first)), 0) => format!("{} and {last}{kind}", first.join(", ")),
        (Some(_), more) => format!("{} and {more} more{kind}", names.join(", ")),
    }
}

/// Puts like faults of several quantities together.
pub(super) fn merged(faults: Vec<Fault>) -> Vec<Fault> {
    let mut merged: Vec<Fault> = Vec::new();
    for fault in faults {
        match merged
            .iter_mut()
            .find(|other| other.kind.is_like(fault.kind))
        {
            Some(other) => other.of.extend(fault.of),
            None => merged.push(fault),
        }
    }
    merged
}

/// The largest error, and the gap where it is.
pub(super) fn worst(points: &[Point]) -> (f64, f64) {
    largest(points.iter().map(|point| (point.error().abs(), point.gap)))
}

/// The largest of some errors, with its gap.
fn largest(errors: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    errors.fold((0.0, f64::NAN), |worst, error| {
        if error.0 > worst.0 { error } else { worst }
    })
}

#[cfg(test)]
mod tests;
