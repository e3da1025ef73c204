//! What a submission does as the gap closes: the singular terms of its loads.

use nalgebra::{DMatrix, DVector};
use scene::{Gap, LoadSet, MAX_MODES, singular};

use super::points::{Item, Point};

/// Largest gap of a fit.
const LARGEST: f64 = 0.11;

/// Fewest points of a fit, and least ratio of the largest gap to the smallest.
const FEWEST: usize = 4;
const SPREAD: f64 = 4.0;

/// Share of the true singular term below which it is said to be missing or far too weak.
const MISSING: f64 = 0.5;

/// The strongest singular term of a load near contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// The load.
    pub item: Item,
    /// `1/gap` or `ln(1/gap)`.
    pub term: &'static str,
    /// Factor of the term: the true one, and what a fit to the difference from exact loads adds.
    pub value: f64,
    /// The true factor, from the closed form.
    pub truth: f64,
    /// The same of the constant next to the singular terms, without the true one.
    pub constant: f64,
    /// Largest misfit of the difference from exact loads, relative to the larger of the load and 1.
    pub misfit: f64,
}

impl Contact {
    /// The share of the true term that is there.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.value / self.truth
    }

    /// Whether the submission has nothing of the term.
    #[must_use]
    pub fn is_missing(&self) -> bool {
        self.ratio().abs() < MISSING
    }
}

/// Names of loads with a singular part, and whether it is `1/gap`.
fn diverges(name: &str) -> Option<bool> {
    match name {
        "X11A" | "X12A" => Some(true),
        "Y11A" | "Y12A" | "Y11B" | "Y12B" | "Y11C" | "Y12C" => Some(false),
        _ => ["XF", "YF", "YT"]
            .iter()
            .any(|kind| name.starts_with(kind) && !name.starts_with("YFC"))
            .then_some(false),
    }
}

/// The true factor of the strongest singular term.
fn factor(name: &str, is_inverse: bool) -> Option<f64> {
    // Where 1/gap is all there is, and where the logarithm is 1.
    let gap = Gap::from_ln(if is_inverse { -30.0 } else { -1.0 });
    let loads = singular::loads(gap, LoadSet::all(MAX_MODES), AXIAL_SQUIRMING);
    let named = loads.named().into_iter().find(|(other, _)| other == name);
    let factor = named?.1 * if is_inverse { gap.eps() } else { 1.0 };
    // In digits that the other terms do not reach.
    Some((factor * 1e9).round() / 1e9)
}

/// Coefficient of the axial loads by squirming; the paper prints 9/4.
const AXIAL_SQUIRMING: f64 = 3.0;

/// Fits the singular part of a load to its points; none of other quantities, and of too few points near contact.
pub(super) fn fit(item: Item, points: &[Point]) -> Option<Contact> {
    let Item::Quantity(quantity) = item else {
        return None;
    };
    let is_inverse = diverges(quantity.name()).filter(|_| quantity.is_load())?;
    let near: Vec<&Point> = points.iter().filter(|point| point.gap <= LARGEST).collect();
    let (first, last) = (near.first()?, near.last()?);
    if near.len() < FEWEST || last.gap / first.gap < SPREAD {
        return None;
    }
    // Relative to the load, so that the smallest gaps do not have all the weight. With enough points the next term keeps its part out of the others.
    let terms = |gap: f64| {
        let log = -gap.ln();
        let mut terms = vec![log, 1.0];
        if is_inverse {
            terms.insert(0, 1.0 / gap);
        }
        if near.len() > terms.len() + 1 {
            terms.push(gap * log);
        }
        terms
    };
    let columns = terms(1.0).len();
    let weight = |point: &Point| 1.0 / point.truth.abs().max(1.0);
    let matrix = DMatrix::from_fn(near.len(), columns, |row, column| {
        terms(near[row].gap)[column] * weight(near[row])
    });
    let solve = |of: &dyn Fn(&Point) -> f64| -> Option<(DVector<f64>, f64)> {
        let right = DVector::from_iterator(
            near.len(),
            near.iter().map(|point| of(point) * weight(point)),
        );
        let solved = matrix.clone().svd(true, true).solve(&right, 1e-13).ok()?;
        let misfit = (&matrix * &solved - right).amax();
        Some((solved, misfit))
    };
    let (difference, misfit) = solve(&|point| point.value - point.truth)?;
    let truth = factor(quantity.name(), is_inverse)?;
    Some(Contact {
        item,
        term: if is_inverse { "1/gap" } else { "ln(1/gap)" },
        value: truth + difference[0],
        truth,
        constant: difference[if is_inverse { 2 } else { 1 }],
        misfit,
    })
}

/// Largest gap at which a logarithm is told by itself.
const LOG: f64 = 0.6;

/// A logarithm with a wrong factor.
pub(super) struct LogAlone {
    /// The factor.
    pub value: f64,
    /// The true one.
    pub truth: f64,
    /// Whether the difference is that logarithm at all gaps, far ones too.
    pub everywhere: bool,
}

/// The factor of the logarithm of a load, and the true one, if a wrong factor is all that is wrong near contact: then the difference is a multiple of the
/// logarithm at each gap, and a few gaps are enough.
pub(super) fn log_alone(item: Item, points: &[Point], tolerance: f64) -> Option<LogAlone> {
    /// Largest deviation from one multiple.
    const SAME: f64 = 0.01;
    let Item::Quantity(quantity) = item else {
        return None;
    };
    if diverges(quantity.name())? || !quantity.is_load() {
        return None;
    }
    let multiple = |point: &Point| (point.value - point.truth) / -point.gap.ln();
    let near: Vec<f64> = points
        .iter()
        .filter(|point| point.gap <= LOG)
        .map(multiple)
        .collect();
    let [first, _, ..] = near.as_slice() else {
        return None;
    };
    let is_one = |multiple: f64| (multiple / first - 1.0).abs() <= SAME;
    if !near.iter().all(|multiple| is_one(*multiple)) || first.abs() <= 10.0 * tolerance {
        return None;
    }
    let truth = factor(quantity.name(), false)?;
    // Where the logarithm vanishes there is no multiple of it.
    let mut others = points.iter().filter(|point| point.gap.ln().abs() > 0.1);
    Some(LogAlone {
        value: truth + first,
        truth,
        everywhere: others.all(|point| is_one(multiple(point))),
    })
}

/// Sums of singular terms that cancel because lubrication acts on both spheres with opposite forces: the names of the loads, their factors, and the value.
pub(super) fn third_law(contacts: &[Contact]) -> Vec<(String, f64)> {
    let of = |name: &str| {
        contacts
            .iter()
            .find(|contact| contact.item.to_string() == name)
    };
    let mut laws = Vec::new();
    // Forces on both spheres cancel.
    for contact in contacts {
        let name = contact.item.to_string();
        let other = match name.as_str() {
            "X11A" => "X12A".to_owned(),
            "Y11A" => "Y12A".to_owned(),
            "Y11B" => "Y12B".to_owned(),
            _ if name.starts_with("XF1") || name.starts_with("YF1") => name.replacen('1', "2", 1),
            _ => continue,
        };
        if let Some(other) = of(&other) {
            let sum = (contact.value + other.value) / contact.truth.abs();
            laws.push((
                format!("{} + {}, {}", contact.item, other.item, contact.term),
                sum,
            ));
        }
    }
    // The couple of the forces on both, whose distance is 2, is the sum of the torques.
    let torques = contacts.iter().filter_map(|force| {
        let name = force.item.to_string();
        let mode = name.strip_prefix("YF1")?;
        let [one, two] = [1, 2].map(|k| of(&format!("YT{k}{mode}")));
        let (one, two) = one.zip(two)?;
        let sum = (one.value + two.value - 2.0 * force.value) / (2.0 * force.truth.abs());
        Some((
            format!("{} + {} - 2 {name}, ln(1/gap)", one.item, two.item),
            sum,
        ))
    });
    laws.extend(torques);
    laws
}

#[cfg(test)]
mod tests;
