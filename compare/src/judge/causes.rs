//! What is wrong with a submission: the simplest cause that explains the errors of each quantity, and of all.

use scene::{Gap, SceneError};

use super::contact::{self, Contact};
use super::faults::{Affected, FAULT, Fault, Kind, ONE_FACTOR, merged, worst};
use super::points::{self, Item, Point, Truth};
use crate::submission::{Quantity, Submission, Values};

/// Deviation of a factor from 1 that is told as one.
const LEAST_FACTOR: f64 = 2e-3;

/// What is far, how far a ratio may be off there, how much of that may change from one gap to the next, and the size of noise.
const FAR: f64 = 8.0;
const FAR_OFF: f64 = 0.01;
const LASTING: f64 = 0.2;
pub(super) const NOISE: f64 = 5e-6;

/// Truth below which a ratio is one of rounding errors.
pub(super) const FAINT: f64 = 1e-8;

/// How much simpler the faults of what follows must be, to be told in place of those of what is given.
const SIMPLER: f64 = 3.0;

/// The faults of what is given; or those of what follows from it, where they are far simpler: the loads of a code that answers with velocities may have
/// one wrong coefficient, which spoils all velocities.
pub(super) fn faults(
    submission: &Submission,
    items: &[(Item, Vec<Point>)],
    between: &[Point],
    contacts: &[Contact],
) -> Vec<Fault> {
    let between = points::by_item(between);
    let of = |given: bool| {
        let mut faults = Vec::new();
        for (item, points) in items {
            let Item::Quantity(quantity) = *item else {
                continue;
            };
            let pick = |points: &[Point]| -> Vec<Point> {
                points
                    .iter()
                    .filter(|point| point.given == given)
                    .copied()
                    .collect()
            };
            let points = pick(points);
            if points.is_empty() {
                continue;
            }
            let contact = contacts.iter().find(|contact| contact.item == *item);
            let stated =
                (submission.answers().iter()).filter_map(|answer| answer.errors.get(quantity));
            let stated = stated.fold(0.0, f64::max);
            let between = between.iter().find(|(other, _)| other == item);
            let between = between.map_or(Vec::new(), |(_, points)| pick(points));
            faults.extend(of_quantity((quantity, &points), &between, contact, stated));
        }
        let mut faults = joined(merged(exchanged(faults, items)), items);
        faults.sort_by(|a, b| b.worst().0.total_cmp(&a.worst().0));
        faults
    };
    let (mut given, follow) = (of(true), of(false));
    let vagueness = |faults: &[Fault]| faults.iter().map(Fault::vagueness).sum::<f64>();
    // All that is given is in what follows: nothing is left out with it.
    let quantities = items
        .iter()
        .filter(|(item, _)| matches!(item, Item::Quantity(_)));
    let (told, followed): (Vec<_>, Vec<_>) =
        quantities.partition(|(_, points)| points.iter().all(|point| point.given));
    let follows_whole = told.len() == followed.len();
    if follows_whole && !follow.is_empty() && SIMPLER * vagueness(&follow) <= vagueness(&given) {
        return follow;
    }
    // Velocities do not show by themselves that lubrication is missing.
    if given.iter().any(|fault| fault.vagueness() > 1.0) {
        given.extend(
            follow
                .into_iter()
                .filter(|fault| fault.kind == Kind::NoLubrication),
        );
        given = merged(given);
        given.sort_by(|a, b| b.worst().0.total_cmp(&a.worst().0));
    }
    given
}

/// The one fault of a submission whose gaps are not what they should be (in diameters, half of them, distances of the centres), if all that it gives fits at other gaps.
pub(super) fn wrong_gaps(
    truth: &Truth,
    said: &[(Gap, Values)],
    points: &[Point],
) -> Result<Option<Fault>, SceneError> {
    let meanings = [Kind::GapUnit(2.0), Kind::GapUnit(0.5), Kind::Distance];
    let meant = |kind: Kind, gap: f64| match kind {
        Kind::GapUnit(factor) => factor * gap,
        _ => gap - 2.0,
    };
    for kind in meanings {
        let moved: Vec<(Gap, Values)> = (said.iter())
            .filter_map(|(gap, values)| {
                Some((Gap::new(meant(kind, gap.eps())).ok()?, values.clone()))
            })
            .collect();
        if moved.len() < said.len().max(2) {
            continue;
        }
        let fits = truth.points(&moved)?;
        if fits
            .iter()
            .filter(|point| point.given)
            .all(|point| !point.is_beyond(FAULT))
        {
            let of_item = |(item, points): (Item, Vec<Point>)| Fault::new(kind, item, &points);
            let all = points::by_item(points).into_iter().map(of_item);
            return Ok(merged(all.collect()).pop());
        }
    }
    Ok(None)
}

/// Replaces the faults of both quantities of a pair, if each is that of the other sphere.
fn exchanged(mut faults: Vec<Fault>, items: &[(Item, Vec<Point>)]) -> Vec<Fault> {
    let has_fault = |faults: &[Fault], item: Item| faults.iter().any(|fault| fault.is_of(item));
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
            faults.retain(|fault| !fault.is_of(*item) && !fault.is_of(partner));
            faults.push(Fault::new(Kind::Swapped, *item, own));
            faults.push(Fault::new(Kind::Swapped, partner, other));
        }
    }
    faults
}

/// Adds to a fault with one factor the items that fit with the same factor, and were told otherwise because the other sphere is felt at too few of their gaps.
fn joined(mut faults: Vec<Fault>, items: &[(Item, Vec<Point>)]) -> Vec<Fault> {
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
        let vague = |fault: &Fault| fault.vagueness() > 1.0 && fault.is_of(*item);
        let is_vague = faults.iter().any(vague);
        let joins = factors.iter().find(|(_, factor)| is_vague && fits(*factor));
        let Some(&(place, factor)) = joins else {
            continue;
        };
        for fault in faults.iter_mut().filter(|fault| vague(fault)) {
            fault.of.retain(|affected| affected.item != *item);
        }
        faults[place].of.push(Affected {
            item: *item,
            worst: worst(points),
            number: factor,
        });
    }
    faults.retain(|fault| !fault.of.is_empty());
    faults
}

/// The faults of a quantity that is given, from its points by rising gap, those between its gaps by its own interpolation, and the
/// fit of its singular part. `stated` is the largest error that it states.
fn of_quantity(
    (quantity, points): (Quantity, &[Point]),
    between: &[Point],
    contact: Option<&Contact>,
    stated: f64,
) -> Vec<Fault> {
    let tolerance = FAULT.max(3.0 * stated);
    let item = Item::Quantity(quantity);
    let fault = |kind: Kind, points: &[Point]| Fault::new(kind, item, points);
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

#[cfg(test)]
mod tests;
