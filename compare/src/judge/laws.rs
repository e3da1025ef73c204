//! Laws that hold whatever the fluid does in detail: of matrices, of mobilities, and of the far field.

use super::causes;
use super::faults;
use super::points::{Item, Point};
use crate::submission::{Answer, Quantity};

/// A law that matrices obey or break.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// Name: `reciprocity`, `equal spheres`, `smallest eigenvalue`.
    pub name: &'static str,
    /// The size of the breach, in the units of the scalars; the eigenvalue itself.
    pub value: f64,
    /// Gap where it is.
    pub gap: f64,
    /// The entries of the matrix.
    pub entries: String,
}

impl Law {
    /// Whether it is broken.
    #[must_use]
    pub fn is_broken(&self) -> bool {
        match self.name {
            EIGENVALUE => self.value <= 0.0,
            _ => self.value > faults::FAULT,
        }
    }
}

const EIGENVALUE: &str = "smallest eigenvalue";

/// How fast a quantity falls off between the two largest gaps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decay {
    /// Which quantity.
    pub quantity: Quantity,
    /// Power of the distance of the centres, by the submission and truly.
    pub powers: [f64; 2],
    /// Whether its error there is more than noise.
    pub is_off: bool,
}

/// The worst breach of each law by matrices.
pub(super) fn matrix_laws(answers: &[Answer]) -> Vec<Law> {
    let mut laws: Vec<Law> = Vec::new();
    let mut keep = |law: Law, worse: fn(f64, f64) -> bool| match laws
        .iter_mut()
        .find(|other| other.name == law.name)
    {
        Some(other) if worse(law.value, other.value) => *other = law,
        Some(_) => {}
        None => laws.push(law),
    };
    for answer in answers {
        let Some(of) = &answer.laws else { continue };
        let gap = answer.gap.eps();
        for (name, (value, entries)) in [
            ("reciprocity", &of.asymmetry),
            ("equal spheres", &of.images),
        ] {
            let law = Law {
                name,
                value: *value,
                gap,
                entries: entries.clone(),
            };
            keep(law, |new, old| new > old);
        }
        let law = Law {
            name: EIGENVALUE,
            value: of.smallest_eigenvalue,
            gap,
            entries: String::new(),
        };
        keep(law, |new, old| new < old);
    }
    laws
}

/// Smallest eigenvalue of the mobility at each gap at which all ten scalars are there or follow.
pub(super) fn definite(points: &[Point]) -> Vec<(f64, f64)> {
    let mut smallest: Vec<(f64, f64)> = Vec::new();
    let mut gaps: Vec<f64> = points.iter().map(|point| point.gap).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.dedup();
    for gap in gaps {
        let of = |name: &str| {
            let item = Item::Quantity(Quantity::named(name)?);
            let point = points
                .iter()
                .find(|point| point.item == item && point.gap.total_cmp(&gap).is_eq());
            point.map(|point| point.value)
        };
        let pair = |kind: &str| {
            let (axis, letter) = kind.split_at(1);
            Some([
                of(&format!("{axis}11{letter}"))?,
                of(&format!("{axis}12{letter}"))?,
            ])
        };
        let all = (|| {
            Some([
                pair("xa")?,
                pair("ya")?,
                pair("yb")?,
                pair("xc")?,
                pair("yc")?,
            ])
        })();
        let Some([xa, ya, yb, xc, yc]) = all else {
            continue;
        };
        let mut least = f64::INFINITY;
        for sign in [1.0, -1.0] {
            for own in [xa, xc] {
                least = least.min(own[0] + sign * own[1]);
            }
            // In the units of the scalars, so that a lone sphere has ones.
            let (a, b, c) = (
                ya[0] + sign * ya[1],
                yb[0] - sign * yb[1],
                yc[0] - sign * yc[1],
            );
            let b = b * (6.0_f64 * 8.0).sqrt() / 4.0;
            let mean = 0.5 * (a + c);
            least = least.min(mean - (0.5 * (a - c)).hypot(b));
        }
        smallest.push((gap, least));
    }
    smallest
}

/// Powers of the distance between the two largest gaps, both far, of what vanishes far away.
pub(super) fn decays(items: &[(Item, Vec<Point>)]) -> Vec<Decay> {
    let mut decays = Vec::new();
    for (item, points) in items {
        let Item::Quantity(quantity) = *item else {
            continue;
        };
        let far: Vec<&Point> = points
            .iter()
            .filter(|point| point.given && point.gap >= 3.0)
            .collect();
        let [.., near, last] = far.as_slice() else {
            continue;
        };
        // Those that do not vanish have no power.
        if quantity.isolated().abs() > 0.0 || last.truth.abs() < causes::FAINT {
            continue;
        }
        let power = |of: fn(&Point) -> f64| {
            (of(near) / of(last)).abs().ln() / ((2.0 + near.gap) / (2.0 + last.gap)).ln()
        };
        decays.push(Decay {
            quantity,
            powers: [power(|point| point.value), power(|point| point.truth)],
            is_off: (last.value - last.truth).abs() > causes::NOISE,
        });
    }
    decays
}

#[cfg(test)]
mod tests;
