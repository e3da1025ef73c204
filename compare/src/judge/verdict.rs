//! The verdict in words.

use super::faults::{listed, size_percent};
use super::points::{Item, Point, TRUST};
use super::{FAR_GAP, Scorecard};
use crate::numbers::{few_digits, rounded, written};
use crate::submission::Interpolation;

/// The name of what a point is of, and whether it was given; `then` goes on.
fn named(point: &Point, then: &str) -> String {
    match (point.item, then) {
        (Item::Quantity(_), "") if !point.given => {
            format!("{}, which follows from what it gives", point.item)
        }
        (Item::Quantity(_), then) if !point.given => {
            format!("{}, which follows from what it gives, {then}", point.item)
        }
        (item, "") => item.to_string(),
        (item, then) => format!("{item} {then}"),
    }
}

/// Most sentences on faults.
const MOST_FAULTS: usize = 12;

/// Deviation of a power of the distance that is told.
const POWER: f64 = 0.1;

impl Scorecard {
    /// Whether nothing is found to be wrong.
    #[must_use]
    pub fn is_faultless(&self) -> bool {
        self.faults.is_empty()
            && !self.matrix_laws.iter().any(super::Law::is_broken)
            && self
                .definite
                .iter()
                .all(|(_, eigenvalue)| *eigenvalue > 0.0)
    }

    /// The verdict, a sentence in each line.
    #[must_use]
    pub fn verdict(&self) -> Vec<String> {
        let mut lines = vec![self.trust_sentence()];
        if self.is_faultless() {
            let given = self.points.iter().filter(|point| point.given);
            let worst = given.max_by(|a, b| a.error().abs().total_cmp(&b.error().abs()));
            let worst = worst.map_or(String::new(), |point| {
                format!(
                    " (largest error {} of {} at gap {})",
                    size_percent(point.error()),
                    point.item,
                    few_digits(point.gap)
                )
            });
            lines.push(format!("No fault found in what it gives{worst}."));
        }
        for fault in self.faults.iter().take(MOST_FAULTS) {
            lines.push(format!(
                "Fault ({}): {}.",
                fault.kind.name(),
                fault.sentence()
            ));
        }
        let more = self.faults.len().saturating_sub(MOST_FAULTS);
        if more > 0 {
            lines.push(format!("More faults are in the table: {more}."));
        }
        lines.extend(self.law_sentences());
        lines.extend(self.far_sentences());
        lines.extend(self.how_it_was_read());
        lines.extend(self.collision_sentences());
        lines.extend(self.what_is_left_out());
        lines
    }

    fn trust_sentence(&self) -> String {
        let mut parts = Vec::new();
        for bound in TRUST {
            let percent = format!("{} %", written(100.0 * bound));
            parts.push(match (self.trusted(bound), self.spoiled_by(bound)) {
                (Some(gap), None) => format!(
                    "within {percent} at all its gaps, down to {}",
                    few_digits(gap)
                ),
                (Some(gap), Some(first)) => {
                    format!(
                        "within {percent} down to a gap of {} ({})",
                        few_digits(gap),
                        named(&first, "is first to fail")
                    )
                }
                (None, Some(first)) => format!("nowhere within {percent} ({})", named(&first, "")),
                (None, None) => "without a number that is scored".to_owned(),
            });
            // Then it is within all larger bounds.
            if self.spoiled_by(bound).is_none() {
                break;
            }
        }
        format!("{} is {}.", self.name, parts.join("; "))
    }

    fn law_sentences(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for law in self.matrix_laws.iter().filter(|law| law.is_broken()) {
            let at = few_digits(law.gap);
            lines.push(match law.name {
                "reciprocity" => format!(
                    "Law broken (reciprocity): the matrix is not symmetric: entries {} differ by {} at gap {at} (relative to the larger of them and 1, the entry of a lone sphere).",
                    law.entries,
                    rounded(law.value, 4)
                ),
                "equal spheres" => format!(
                    "Law broken (equal spheres): the two spheres are not alike, or x is not like y: entries {} differ by {} at gap {at} (relative to the larger of them and 1, the entry of a lone sphere).",
                    law.entries,
                    rounded(law.value, 4)
                ),
                _ => format!("Law broken (positive definite): the matrix has the eigenvalue {} at gap {at}: forces would not dissipate.", rounded(law.value, 4)),
            });
        }
        let negative: Vec<f64> = self
            .definite
            .iter()
            .filter(|(_, least)| *least <= 0.0)
            .map(|(gap, _)| *gap)
            .collect();
        if let (Some(first), Some(last)) = (negative.first(), negative.last()) {
            let at = if first < last {
                format!("gaps from {} to {}", few_digits(*first), few_digits(*last))
            } else {
                format!("gap {}", few_digits(*first))
            };
            lines.push(format!(
                "Law broken (positive definite): the mobility is not positive definite at {at}."
            ));
        }
        let unbalanced: Vec<&str> = (self.third_law.iter())
            .filter(|(_, sum)| sum.abs() > 0.1)
            .map(|(case, _)| case.as_str())
            .collect();
        if let [first, rest @ ..] = unbalanced.as_slice() {
            let more = if rest.is_empty() {
                String::new()
            } else {
                format!(" and {} more", rest.len())
            };
            lines.push(format!("Law broken (action and reaction near contact): singular terms do not cancel in {first}{more}."));
        }
        lines
    }

    fn far_sentences(&self) -> Vec<String> {
        let mut lines = Vec::new();
        let off: Vec<_> = self
            .decays
            .iter()
            .filter(|decay| (decay.powers[0] - decay.powers[1]).abs() > POWER)
            .collect();
        if let Some(first) = off.first() {
            let items: Vec<Item> = off
                .iter()
                .map(|decay| Item::Quantity(decay.quantity))
                .collect();
            lines.push(format!(
                "Far away {} fall off with another power of the distance than they should ({}: {} instead of {}).",
                listed(&items),
                first.quantity,
                rounded(first.powers[0], 2),
                rounded(first.powers[1], 2)
            ));
        }
        let farthest = self
            .points
            .iter()
            .map(|point| point.gap)
            .fold(0.0, f64::max);
        if farthest < FAR_GAP * (1.0 - 1e-9) {
            lines.push(format!(
                "Units and signs of the far field could not be checked: its largest gap is {}, and {} is needed.",
                few_digits(farthest),
                written(FAR_GAP)
            ));
        }
        lines
    }

    fn collision_sentences(&self) -> Vec<String> {
        let collisions = match &self.collisions {
            Ok(collisions) => collisions,
            Err(reason) => return vec![format!("No collisions: {reason}.")],
        };
        let mut lines = Vec::new();
        let errors: Vec<(f64, &super::CaseScore)> = collisions
            .cases
            .iter()
            .filter_map(|score| Some((score.error_deg()?, score)))
            .collect();
        let others: Vec<_> = collisions
            .cases
            .iter()
            .filter(|score| score.theirs.1 != score.exact.1)
            .collect();
        let worst = errors.iter().max_by(|a, b| a.0.total_cmp(&b.0));
        let worst = worst.map_or("no deflection to compare".to_owned(), |(error, score)| {
            format!(
                "deflections are off by up to {} degrees ({})",
                rounded(*error, 3),
                score.name()
            )
        });
        let outcomes = match others.as_slice() {
            [] => "all outcomes are right".to_owned(),
            [first, rest @ ..] => {
                let more = if rest.is_empty() {
                    String::new()
                } else {
                    format!(", and {} more", rest.len())
                };
                format!(
                    "{} of {} outcomes are wrong ({}: {} instead of {}{more})",
                    others.len(),
                    collisions.cases.len(),
                    first.name(),
                    first.theirs.1,
                    first.exact.1
                )
            }
        };
        lines.push(format!("In the paper's cases {worst}; {outcomes}."));
        let shares: Vec<String> = (collisions.trust.iter())
            .map(|shares| {
                let wrong = shares.other_outcome + shares.failed;
                format!(
                    "{} % for beta {}",
                    rounded(100.0 * wrong, 1),
                    written(shares.beta)
                )
            })
            .collect();
        lines.push(format!(
            "Of the incoming angles it gives another outcome for {}.",
            shares.join(", ")
        ));
        let states = collisions.bound_states();
        let missing: Vec<String> = states
            .iter()
            .filter(|state| state.theirs.is_none())
            .map(super::BoundComparison::name)
            .collect();
        let extra: Vec<String> = states
            .iter()
            .filter(|state| state.exact.is_none())
            .map(super::BoundComparison::name)
            .collect();
        let list = |states: &[String]| {
            if states.is_empty() {
                "none".to_owned()
            } else {
                states.join("; ")
            }
        };
        lines.push(format!(
            "Bound states: {} of {} are there; missing: {}; of its own: {}.",
            states
                .iter()
                .filter(|state| state.theirs.is_some() && state.exact.is_some())
                .count(),
            states.iter().filter(|state| state.exact.is_some()).count(),
            list(&missing),
            list(&extra)
        ));
        lines
    }

    /// How it was read between its gaps.
    fn how_it_was_read(&self) -> Vec<String> {
        let mut lines = Vec::new();
        match self.header.interpolation {
            Some(Interpolation::None) => lines.push(
                "Between its gaps nothing was scored: it declares no interpolation.".to_owned(),
            ),
            Some(declared) => lines.push(format!(
                "Between its gaps it was read by its own interpolation, {}.",
                declared.in_words()
            )),
            None if self.header.range.is_none() => {
                let collisions = if self.collisions.is_ok() {
                    " Its collisions are read by cubics in the logarithm of the gap, which are not its own."
                } else {
                    ""
                };
                lines.push(format!(
                    "Between its gaps nothing was scored: it does not say how it is interpolated.{collisions}"
                ));
            }
            None => {}
        }
        lines
    }

    fn what_is_left_out(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some((gap, reason)) = self.unanswered.first() {
            lines.push(format!(
                "It has no answer at {} of the gaps that it was asked for, first at {}: {reason}.",
                self.unanswered.len(),
                few_digits(*gap)
            ));
        }
        if !self.raw.is_empty() {
            let factors: Vec<String> = self
                .header
                .slip_calibration
                .iter()
                .map(|factor| rounded(*factor, 4))
                .collect();
            let raw = self
                .raw
                .iter()
                .map(|point| point.error().abs())
                .fold(0.0, f64::max);
            lines.push(format!(
                "Its slip was calibrated by the factors {} that it declares; without them it is off by up to {}.",
                factors.join(", "),
                size_percent(raw)
            ));
        }
        if !self.missing.is_empty() {
            let items: Vec<Item> = self
                .missing
                .iter()
                .map(|missing| Item::Quantity(missing.quantity))
                .collect();
            lines.push(format!("Missing, and so not scored: {}.", listed(&items)));
        }
        let unstated = self.header.unstated();
        if !unstated.is_empty() {
            lines.push(format!(
                "Not stated in its header: {}.",
                unstated.join(", ")
            ));
        }
        lines
    }
}

#[cfg(test)]
mod tests;
