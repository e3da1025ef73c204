//! Errors of a submission: what it gives, and what follows from that, against exact hydrodynamics.

use std::fmt;

use exact::Exact;
use rayon::prelude::*;
use scene::{Gap, LoadSet, SceneError};

use crate::numbers::written;
use crate::submission::{Quantity, Values, derived};

/// What is scored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Item {
    /// A load, mobility or velocity.
    Quantity(Quantity),
    /// Speed at which two squirmers with this `beta` that face each other approach, `B_1 = 3/2`.
    Approach(f64),
}

/// Squirmer parameters of the approach speeds.
const APPROACHES: [f64; 3] = [0.0, 5.0, -5.0];

impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Quantity(quantity) => f.write_str(quantity.name()),
            Self::Approach(beta) => write!(f, "approach speed, beta {}", written(*beta)),
        }
    }
}

/// A number of a submission at a gap, beside the true one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Gap, in radii.
    pub gap: f64,
    /// What it is.
    pub item: Item,
    /// Whether the submission says it, or it follows from what that says.
    pub given: bool,
    /// By the submission.
    pub value: f64,
    /// By exact hydrodynamics.
    pub truth: f64,
    /// What its error is measured in: the larger of the truth and its value of a lone sphere; of an approach speed, to which two modes may add with opposite
    /// signs, the sum of what either adds.
    pub scale: f64,
}

impl Point {
    /// The error, in units of [`Self::scale`].
    #[must_use]
    pub fn error(&self) -> f64 {
        (self.value - self.truth) / self.scale
    }

    /// Whether the error is beyond a bound, or no number.
    #[must_use]
    pub fn is_beyond(&self, bound: f64) -> bool {
        let compared = self.error().abs().partial_cmp(&bound);
        compared.is_none_or(std::cmp::Ordering::is_gt)
    }

    /// The error relative to the truth alone, in per cent.
    #[must_use]
    pub fn relative_percent(&self) -> f64 {
        100.0 * (self.value - self.truth) / self.truth.abs()
    }
}

/// Exact hydrodynamics, in the quantities of submissions.
pub struct Truth {
    exact: Exact,
    set: LoadSet,
}

impl Truth {
    /// For submissions with these slip modes, at least the first two.
    #[must_use]
    pub fn new(modes: usize, swirl: usize) -> Self {
        Self {
            exact: Exact::new(),
            set: LoadSet::all(modes.max(2)).with_swirl(swirl),
        }
    }

    /// For what these quantities are.
    pub(super) fn of(quantities: impl Iterator<Item = Quantity>) -> Self {
        let (mut modes, mut swirl) = (0, 0);
        for quantity in quantities {
            let highest = if quantity.is_by_swirl() {
                &mut swirl
            } else {
                &mut modes
            };
            *highest = (*highest).max(quantity.mode().unwrap_or(0));
        }
        Self::new(modes, swirl)
    }

    /// All quantities at `gap`: loads, and the velocities that follow from them.
    ///
    /// # Errors
    /// Those of the exact model.
    pub fn at(&self, gap: Gap) -> Result<Values, SceneError> {
        let mut values = Values::of_model(&self.exact, gap, self.set)?;
        let follow = derived(&values);
        for (quantity, value) in follow.iter() {
            values.set(quantity, value);
        }
        Ok(values)
    }

    /// The same at each of some gaps.
    pub(super) fn at_each(&self, said: &[(Gap, Values)]) -> Result<Vec<Values>, SceneError> {
        said.par_iter().map(|(gap, _)| self.at(*gap)).collect()
    }

    /// The points of what a submission says at some gaps.
    pub(super) fn points(&self, said: &[(Gap, Values)]) -> Result<Vec<Point>, SceneError> {
        Ok(against(said, &self.at_each(said)?))
    }
}

/// The points of what a submission says at some gaps, with the truth at each.
pub(super) fn against(said: &[(Gap, Values)], truths: &[Values]) -> Vec<Point> {
    let each = said.iter().zip(truths);
    each.flat_map(|((gap, values), truth)| points(*gap, values, truth))
        .collect()
}

fn points(gap: Gap, given: &Values, truth: &Values) -> Vec<Point> {
    let follow = derived(given);
    let said = (given.iter().map(|of| (of, true))).chain(follow.iter().map(|of| (of, false)));
    let mut points: Vec<Point> = said
        .filter_map(|((quantity, value), given)| {
            let truth = truth.get(quantity)?;
            Some(Point {
                gap: gap.eps(),
                item: Item::Quantity(quantity),
                given,
                value,
                truth,
                scale: quantity.scale(truth),
            })
        })
        .collect();
    for beta in APPROACHES {
        // Of both squirmers, by the first mode and by the second.
        let parts = |of: &dyn Fn(&str) -> Option<f64>| {
            let by_mode =
                |n: usize| Some(3.0 * (of(&format!("UX1_{n}"))? - of(&format!("UX2_{n}"))?));
            let second = if beta.abs() > 0.0 {
                beta * by_mode(2)?
            } else {
                0.0
            };
            Some([by_mode(1)?, second])
        };
        let of = |values: &Values, name: &str| values.get(Quantity::named(name)?);
        let said = parts(&|name| of(given, name).or_else(|| of(&follow, name)));
        if let Some((value, truth)) = said.zip(parts(&|name| of(truth, name))) {
            points.push(Point {
                gap: gap.eps(),
                item: Item::Approach(beta),
                given: false,
                value: value.iter().sum(),
                truth: truth.iter().sum(),
                scale: truth.iter().map(|part| part.abs()).sum(),
            });
        }
    }
    points
}

/// The points of each item, by rising gap, in the order in which items first come.
pub(super) fn by_item(points: &[Point]) -> Vec<(Item, Vec<Point>)> {
    let mut items: Vec<(Item, Vec<Point>)> = Vec::new();
    for point in points {
        match items.iter_mut().find(|(item, _)| *item == point.item) {
            Some((_, of_item)) => of_item.push(*point),
            None => items.push((point.item, vec![*point])),
        }
    }
    for (_, of_item) in &mut items {
        of_item.sort_by(|a, b| a.gap.total_cmp(&b.gap));
    }
    items
}

/// Bounds of errors that trust is stated for.
pub const TRUST: [f64; 3] = [0.01, 0.05, 0.2];

/// Down to which gap all errors are within a bound: the smallest gap from which on, up to the largest, every point is. None if not even the
/// largest gap is.
#[must_use]
pub fn trusted_down_to<'a>(
    points: impl Iterator<Item = &'a Point> + Clone,
    bound: f64,
) -> Option<f64> {
    let broken = points.clone().filter(|point| point.is_beyond(bound));
    let worst = broken.map(|point| point.gap).fold(0.0, f64::max);
    let within = points.map(|point| point.gap).filter(|&gap| gap > worst);
    within.reduce(f64::min)
}

/// Points as tests make them up.
#[cfg(test)]
pub(super) mod made {
    use super::{Item, Point};
    use crate::submission::Quantity;

    /// The quantity of a name.
    pub fn item(name: &str) -> Item {
        Item::Quantity(Quantity::named(name).unwrap())
    }

    /// What is given of a quantity at a gap, beside the truth.
    pub fn point(name: &str, gap: f64, value: f64, truth: f64) -> Point {
        let quantity = Quantity::named(name).unwrap();
        Point {
            gap,
            item: Item::Quantity(quantity),
            given: true,
            value,
            truth,
            scale: quantity.scale(truth),
        }
    }
}
