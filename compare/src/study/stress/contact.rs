//! How stresslets and rates of work grow as the gap closes, told from their values at the smallest gaps.

use super::StressRow;
use crate::Method;

/// A law of growth with the gap `eps`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// As `1/eps`.
    Inverse,
    /// As `ln(1/eps)`.
    Logarithm,
    /// Not at all.
    Bounded,
}

/// How one number grows.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactLaw {
    /// Name of the number.
    pub name: String,
    /// The law.
    pub growth: Growth,
    /// Factor of `1/eps` or `ln(1/eps)`; for a bounded number its value at the smallest gap.
    pub factor: f64,
}

/// Changes between gaps, as a share of the larger of the number and 1, that are taken for none.
const NONE: f64 = 1e-2;

/// Share of the change of one decade that a bounded number may have left in the next: its corrections are of the order of `eps ln eps`.
const LEVELLING: f64 = 0.5;

/// The laws of the numbers of a method and a ratio of radii, from the three smallest gaps, each of which must be about a tenth of the next or less; none of
/// fewer gaps.
///
/// A number that grows as `1/eps` changes ten times as much with each gap, one that grows as `ln(1/eps)` as much again, a bounded one less and less.
#[must_use]
pub fn contact_laws(rows: &[StressRow], method: Method, ratio: f64) -> Vec<ContactLaw> {
    let mine = |row: &&StressRow| row.method == method && row.ratio.total_cmp(&ratio).is_eq();
    let mut gaps: Vec<f64> = rows.iter().filter(mine).map(|row| row.gap).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.dedup();
    let Some(&smallest) = gaps.first() else {
        return Vec::new();
    };
    let next = |above: f64| gaps.iter().copied().find(|gap| *gap >= 9.99 * above);
    let Some((middle, largest)) = next(smallest).and_then(|gap| Some((gap, next(gap)?))) else {
        return Vec::new();
    };
    let value = |gap: f64, name: &str| {
        let at = |row: &&StressRow| row.gap.total_cmp(&gap).is_eq() && row.name == name;
        rows.iter().filter(mine).find(at).map(|row| row.value)
    };
    let at_smallest = |row: &&StressRow| row.gap.total_cmp(&smallest).is_eq();
    let law = |row: &StressRow| {
        let (a, b, c) = (
            row.value,
            value(middle, &row.name)?,
            value(largest, &row.name)?,
        );
        let (near, far) = (a - b, b - c);
        // Per unit of ln(1/eps).
        let slope = near / (middle / smallest).ln();
        let before = far / (largest / middle).ln();
        let levels_off = slope.abs() < LEVELLING * before.abs();
        let (growth, factor) = if levels_off || near.abs() <= NONE * a.abs().max(1.0) {
            (Growth::Bounded, a)
        } else if slope.abs() > 4.0 * before.abs() {
            (Growth::Inverse, near / (smallest.recip() - middle.recip()))
        } else {
            (Growth::Logarithm, slope)
        };
        Some(ContactLaw {
            name: row.name.clone(),
            growth,
            factor,
        })
    };
    rows.iter()
        .filter(mine)
        .filter(at_smallest)
        .filter_map(law)
        .collect()
}
