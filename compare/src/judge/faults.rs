//! What is wrong with a submission, and what would mend it.

use std::f64::consts::PI;

use super::contact::{self, Contact};
use super::points::{Item, Point};
use crate::numbers::{few_digits, rounded};
use crate::submission::Quantity;

/// Error from which on something is wrong, relative to the larger of the truth and its value of a lone sphere.
pub const FAULT: f64 = 1e-4;

/// Spread of ratios up to which they are one factor.
const ONE_FACTOR: f64 = 5e-3;

/// Deviation of a factor from 1 that is told as one.
const LEAST_FACTOR: f64 = 2e-3;

/// What is far, how far a ratio may be off there, how much of that may change from one gap to the next, and the size of noise.
const FAR: f64 = 8.0;
const FAR_OFF: f64 = 0.01;
const LASTING: f64 = 0.2;
pub(super) const NOISE: f64 = 5e-6;

/// Truth below which a ratio is one of rounding errors.
pub(super) const FAINT: f64 = 1e-8;

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

/// A fault of some quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// What is wrong.
    pub kind: Kind,
    /// With what.
    pub items: Vec<Item>,
    /// Largest error of each, and the gap where it is.
    pub worst_of: Vec<(f64, f64)>,
    /// The number that it comes with, of each.
    pub numbers: Vec<f64>,
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

impl Fault {
    /// Of one item with these points.
    pub(super) fn of(kind: Kind, item: Item, points: &[Point]) -> Self {
        Self {
            kind,
            items: vec![item],
            worst_of: vec![worst(points)],
            numbers: vec![kind.number()],
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
            | Kind::Alone => 2.0 + 0.5 * self.items.len() as f64,
            _ => 1.0,
        }
    }

    /// Largest error, and the gap where it is.
    #[must_use]
    pub fn worst(&self) -> (f64, f64) {
        let all = self.worst_of.iter().copied();
        all.fold((0.0, f64::NAN), |worst, error| {
            if error.0 > worst.0 { error } else { worst }
        })
    }

    /// The fault in a sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        let names = listed(&self.items);
        let (worst, at) = self.worst();
        let percent = size_percent(worst);
        let at = few_digits(at);
        let (is, should) = if self.items.len() == 1 {
            ("is", "it should")
        } else {
            ("are", "they should")
        };
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
                hint(factor, &self.items),
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
                    "near contact {names} {} {} where {} belongs, in front of the singular term",
                    if self.items.len() == 1 { "has" } else { "have" },
                    number(sign * value.abs()),
                    number(truth.abs())
                )
            }
            Kind::Constant => format!(
                "near contact {names} {} the right singular terms and wrong constants next to them: off by up to {percent} (gap {at})",
                if self.items.len() == 1 { "has" } else { "have" }
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
}

impl Fault {
    /// The factors far away, one by one unless they are one.
    fn each_far(&self) -> String {
        let factors = || self.numbers.iter().copied();
        let (least, most) = (
            factors().fold(f64::INFINITY, f64::min),
            factors().fold(0.0, f64::max),
        );
        if most / least - 1.0 < ONE_FACTOR {
            let (is, should) = if self.items.len() == 1 {
                ("is", "it should")
            } else {
                ("are", "they should")
            };
            return format!(
                "far away {} {is} {} times what {should} be",
                listed(&self.items),
                number(most)
            );
        }
        const MOST: usize = 4;
        let each: Vec<String> = (self.items.iter().zip(&self.numbers).take(MOST))
            .map(|(item, factor)| format!("{item} is {}", number(*factor)))
            .collect();
        let more = self.items.len().saturating_sub(MOST);
        let more = if more > 0 {
            format!(", {more} more")
        } else {
            String::new()
        };
        format!("far away {} times what it should be{more}", each.join(", "))
    }

    /// The largest errors one by one, and how many are smaller.
    fn each_error(&self) -> String {
        const MOST: usize = 4;
        let mut all: Vec<_> = self.items.iter().zip(&self.worst_of).collect();
        all.sort_by(|a, b| b.1.0.total_cmp(&a.1.0));
        let each: Vec<String> = (all.iter().take(MOST).enumerate())
            .map(|(place, (item, (error, gap)))| {
                let is = if place == 0 { "is off by" } else { "by" };
                format!(
                    "{item} {is} {} (gap {})",
                    size_percent(*error),
                    few_digits(*gap)
                )
            })
            .collect();
        let more = match all.get(MOST..).unwrap_or_default() {
            [] => String::new(),
            rest => format!(", {} more by less", rest.len()),
        };
        format!("{}{more}", each.join(", "))
    }
}

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

/// Replaces the faults of both quantities of a pair, if each is that of the other sphere.
pub(super) fn exchanged(mut faults: Vec<Fault>, items: &[(Item, Vec<Point>)]) -> Vec<Fault> {
    let has_fault =
        |faults: &[Fault], item: Item| faults.iter().any(|fault| fault.items.contains(&item));
    for (item, own) in items {
        let Item::Quantity(quantity) = *item else {
            continue;
        };
        let partner = Item::Quantity(quantity.partner());
        let Some((_, other)) = items.iter().find(|(item, _)| *item == partner) else {
            continue;
        };
        let fits = |value: &Point, truth: &Point| {
            (value.value - truth.truth).abs() <= FAULT * truth.scale
                && value.gap.total_cmp(&truth.gap).is_eq()
        };
        let is_exchanged = quantity.is_own()
            && own.len() == other.len()
            && own
                .iter()
                .zip(other)
                .all(|(own, other)| fits(own, other) && fits(other, own));
        if is_exchanged && has_fault(&faults, *item) && has_fault(&faults, partner) {
            faults.retain(|fault| !fault.items.contains(item) && !fault.items.contains(&partner));
            faults.push(Fault::of(Kind::Swapped, *item, own));
            faults.push(Fault::of(Kind::Swapped, partner, other));
        }
    }
    faults
}

/// Adds to a fault with one factor the items that fit with the same factor, and were told otherwise because the other sphere is felt at too few of their gaps.
pub(super) fn joined(mut faults: Vec<Fault>, items: &[(Item, Vec<Point>)]) -> Vec<Fault> {
    let factors: Vec<(usize, f64)> = (faults.iter().enumerate())
        .filter_map(|(place, fault)| match fault.kind {
            Kind::Factor(factor) | Kind::SignAndFactor(factor) => Some((place, factor)),
            Kind::Sign => Some((place, -1.0)),
            _ => None,
        })
        .collect();
    for (item, points) in items {
        let fits = |factor: f64| {
            points
                .iter()
                .all(|point| (point.value / factor - point.truth).abs() <= FAULT * point.scale)
        };
        let vague = faults
            .iter()
            .any(|fault| fault.vagueness() > 1.0 && fault.items.contains(item));
        let joins = factors.iter().find(|(_, factor)| vague && fits(*factor));
        let Some(&(place, factor)) = joins else {
            continue;
        };
        for fault in faults.iter_mut().filter(|fault| fault.vagueness() > 1.0) {
            while let Some(at) = fault.items.iter().position(|other| other == item) {
                fault.items.remove(at);
                fault.worst_of.remove(at);
                fault.numbers.remove(at);
            }
        }
        let fault = &mut faults[place];
        fault.items.push(*item);
        fault.worst_of.push(worst(points));
        fault.numbers.push(factor);
    }
    faults.retain(|fault| !fault.items.is_empty());
    faults
}

/// Puts like faults of several quantities together.
pub(super) fn merged(faults: Vec<Fault>) -> Vec<Fault> {
    let mut merged: Vec<Fault> = Vec::new();
    for fault in faults {
        match merged
            .iter_mut()
            .find(|other| other.kind.is_like(fault.kind))
        {
            Some(other) => {
                other.items.extend(fault.items);
                other.worst_of.extend(fault.worst_of);
                other.numbers.extend(fault.numbers);
            }
            None => merged.push(fault),
        }
    }
    merged
}

/// The point with the largest error.
pub(super) fn worst(points: &[Point]) -> (f64, f64) {
    let errors = points.iter().map(|point| (point.error().abs(), point.gap));
    errors.fold((0.0, f64::NAN), |worst, error| {
        if error.0 > worst.0 { error } else { worst }
    })
}

/// The faults of a quantity that is given, from its points by rising gap, those between its gaps by its own interpolation, and the
/// fit of its singular part. `stated` is the largest error that it states.
pub(super) fn of_quantity(
    (quantity, points): (Quantity, &[Point]),
    between: &[Point],
    contact: Option<&Contact>,
    stated: f64,
) -> Vec<Fault> {
    let tolerance = FAULT.max(3.0 * stated);
    let item = Item::Quantity(quantity);
    let fault = |kind: Kind, points: &[Point]| Fault::of(kind, item, points);
    let mut faults = Vec::new();
    let whole = whole(quantity, points, tolerance);
    let mut is_explained = false;
    if let Some(kind) = whole {
        faults.push(fault(kind, points));
        if let Kind::Cut(cut) = kind {
            // What is wrong within.
            let within = points.iter().filter(|point| point.gap < cut);
            let within: Vec<Point> = within.copied().collect();
            faults.extend(of_quantity((quantity, &within), &[], contact, stated));
        }
    } else if worst(points).0 > tolerance {
        let log = contact::log_alone(item, points, tolerance);
        is_explained = log.as_ref().is_some_and(|log| log.everywhere);
        let log = log.map(|log| Kind::Coefficient(log.value, log.truth));
        let near = contact.and_then(|contact| near_contact(contact, points, tolerance));
        let near = log.or(near);
        faults.push(fault(near.unwrap_or(Kind::Error), points));
    } else if worst(between).0 > tolerance.max(10.0 * worst(points).0) {
        faults.push(fault(Kind::Between, between));
    }
    if whole.is_none() && !is_explained {
        faults.extend(far(points, stated).map(|kind| fault(kind, points)));
        faults.extend(signs(points, stated).map(|kind| fault(kind, points)));
    }
    faults
}

/// One fault that explains all points.
fn whole(quantity: Quantity, points: &[Point], tolerance: f64) -> Option<Kind> {
    let is_right = |point: &Point| point.error().abs() <= tolerance;
    if points.iter().all(is_right) {
        return None;
    }
    // Points at which the other sphere is felt.
    let largest = points
        .iter()
        .fold(0.0, |largest: f64, point| largest.max(point.truth.abs()));
    let felt: Vec<&Point> = (points.iter())
        .filter(|point| point.truth.abs() > 1e-3 * largest.max(1e-3))
        .collect();
    let one_factor = |points: &[&Point]| -> Option<f64> {
        let ratios: Vec<f64> = points
            .iter()
            .map(|point| point.value / point.truth)
            .collect();
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        let is_one = ratios.iter().all(|ratio| {
            (ratio / mean - 1.0).abs() <= ONE_FACTOR * (1.0 - 1.0 / mean).abs().clamp(0.02, 1.0)
        });
        (is_one && mean.is_finite() && (mean - 1.0).abs() > LEAST_FACTOR.max(tolerance))
            .then_some(mean)
    };
    if felt.len() >= 3
        && let Some(factor) = one_factor(&felt)
    {
        return Some(match factor {
            sign if (sign + 1.0).abs() < ONE_FACTOR => Kind::Sign,
            negative if negative < 0.0 => Kind::SignAndFactor(negative),
            factor => Kind::Factor(factor),
        });
    }
    if let Some(kind) = alone(quantity, points, tolerance) {
        return Some(kind);
    }
    if let Some(kind) = straight(points) {
        return Some(kind);
    }
    // Right from some gap on, and one factor below.
    let right = points
        .iter()
        .rev()
        .take_while(|point| is_right(point))
        .count();
    let (below, beyond) = points.split_at(points.len() - right);
    if beyond.len() >= 2 && below.len() >= 2 {
        let felt: Vec<&Point> = below
            .iter()
            .filter(|point| point.truth.abs() > 1e-3)
            .collect();
        let last = below.last()?;
        if felt.len() >= 2
            && let Some(factor) = one_factor(&felt)
        {
            return Some(Kind::FactorBelow(factor, last.gap));
        }
    }
    // One in the middle, far worse than its neighbours.
    let mut middles = points.windows(3);
    let wrong = points.iter().filter(|point| !is_right(point)).count();
    let stands_out = |three: &[Point]| {
        let [before, here, after] = [0, 1, 2].map(|k| three[k].error().abs());
        here > tolerance && here > 20.0 * before.max(after)
    };
    if wrong != 1 {
        return None;
    }
    // Or the last, where errors do not begin by themselves.
    if let [.., before, last] = points
        && last.error().abs() > tolerance.max(20.0 * before.error().abs())
    {
        return Some(Kind::OneValue(last.gap));
    }
    let one = middles.find(|three| stands_out(three))?;
    Some(Kind::OneValue(one[1].gap))
}

/// Whether the value is that of a lone sphere from some gap on, although it should not be.
fn alone(quantity: Quantity, points: &[Point], tolerance: f64) -> Option<Kind> {
    let lone = quantity.isolated();
    let is_lone = |point: &&Point| (point.value - lone).abs() < 1e-9;
    let count = points.iter().rev().take_while(is_lone).count();
    let (below, beyond) = points.split_at(points.len() - count);
    if !beyond.iter().any(|point| point.error().abs() > tolerance) {
        return None;
    }
    match (below, beyond) {
        ([], _) => Some(Kind::Alone),
        // It was felt before.
        ([.., last], [first, ..]) if (last.value - lone).abs() > 1e-6 => Some(Kind::Cut(first.gap)),
        _ => None,
    }
}

/// Whether points lie on straight lines between their neighbours, in the gap or in its logarithm, where the truth does not. Not all of
/// them: that is a formula.
fn straight(points: &[Point]) -> Option<Kind> {
    let best = |tolerance: f64, bent: f64| {
        let in_gap = on_lines(points, |gap| gap, tolerance, bent);
        in_gap.max(on_lines(points, f64::ln, tolerance, bent))
    };
    let (told, all) = best(1e-9, 1e-5);
    // One may be chance, unless it is one to rounding.
    let is_table = told >= 2 || best(1e-14, 1e-3).0 >= 1;
    (is_table && all + 2 < points.len()).then(|| Kind::StraightLines(points.len() - all))
}

/// How many points lie on the line between their neighbours, within `tolerance`: those of which the truth is off by more than `bent`, and all.
fn on_lines(
    points: &[Point],
    coordinate: fn(f64) -> f64,
    tolerance: f64,
    bent: f64,
) -> (usize, usize) {
    let (mut told, mut all) = (0, 0);
    for three in points.windows(3) {
        let x = [0, 1, 2].map(|k| coordinate(three[k].gap));
        let share = (x[1] - x[0]) / (x[2] - x[0]);
        let off = |of: &dyn Fn(&Point) -> f64| {
            let chord = of(&three[0]) * (1.0 - share) + of(&three[2]) * share;
            (of(&three[1]) - chord).abs()
        };
        let is_constant =
            (three[0].value - three[2].value).abs() <= f64::EPSILON * three[0].value.abs();
        let size = three
            .iter()
            .fold(0.0, |size: f64, point| size.max(point.value.abs()));
        if off(&|point| point.value) < tolerance * size && !is_constant {
            all += 1;
            let truth = three[1].truth.abs().max(1.0);
            told += usize::from(off(&|point| point.truth) > bent * truth);
        }
    }
    (told, all)
}

/// Deviation of a singular term that is told, and the largest share of the error that it may leave unexplained.
const COEFFICIENT_OFF: f64 = 0.05;
const UNEXPLAINED: f64 = 0.2;

fn near_contact(contact: &Contact, points: &[Point], tolerance: f64) -> Option<Kind> {
    if contact.is_missing() {
        return Some(Kind::NoLubrication);
    }
    // A term is told only where it explains what is wrong.
    if contact.misfit > UNEXPLAINED * worst(points).0 {
        return None;
    }
    if (contact.ratio() - 1.0).abs() > COEFFICIENT_OFF {
        return Some(Kind::Coefficient(contact.value, contact.truth));
    }
    (contact.constant.abs() > 10.0 * tolerance).then_some(Kind::Constant)
}

/// Size of what is more than noise: that of six digits, or three times the error that is stated, which is relative to the larger of the value and 1.
fn noise(point: &Point, stated: f64) -> f64 {
    NOISE.max(3.0 * stated * point.truth.abs().max(1.0))
}

/// Whether it is a constant factor off where the spheres are far from each other: the same at all far gaps, or by more than could be noise.
fn far(points: &[Point], stated: f64) -> Option<Kind> {
    let far = points
        .iter()
        .filter(|point| point.gap >= FAR && point.truth.abs() > FAINT);
    let far: Vec<&Point> = far.collect();
    let (first, last) = (far.first()?, far.last()?);
    let off = |point: &Point| point.value / point.truth - 1.0;
    let lasts = last.gap > 2.0 * first.gap
        && far
            .iter()
            .all(|point| (off(point) - off(last)).abs() <= LASTING * off(last).abs());
    let felt = |point: &Point| (point.value - point.truth).abs() > noise(point, stated);
    // What is felt nearer and lasts, or what is felt at the last gap.
    let is_told = (lasts && (felt(first) || stated <= 0.0)) || felt(last);
    (is_told && off(last).abs() > FAR_OFF && off(last) > -1.0).then_some(Kind::Far(1.0 + off(last)))
}

/// The gaps at which it has the wrong sign, where it is no rounding error.
fn signs(points: &[Point], stated: f64) -> Option<Kind> {
    let largest = points
        .iter()
        .fold(0.0, |largest: f64, point| largest.max(point.truth.abs()));
    // Beside a zero of the truth a small error changes the sign.
    let crosses = |place: usize| {
        let around = points.get(place.saturating_sub(1)..(place + 2).min(points.len()));
        around
            .unwrap_or_default()
            .windows(2)
            .any(|two| two[0].truth * two[1].truth < 0.0)
    };
    let wrong = points.iter().enumerate().filter(|(place, point)| {
        point.value * point.truth < 0.0
            && point.truth.abs() > (1e-3 * largest).max(FAINT)
            && (point.value - point.truth).abs() > noise(point, stated)
            && !crosses(*place)
    });
    let gaps: Vec<f64> = wrong.map(|(_, point)| point.gap).collect();
    Some(Kind::SignAt(*gaps.first()?, *gaps.last()?))
}
