//! The list of coefficients, and the parts of the balance that they follow from.

use super::{Mobility, MobilitySet, ModeMobility, PairMobility, SwirlMobility};
use crate::{Gap, LoadSet, Parities};

/// What a coefficient belongs to: one for the pair, or one for each mode.
#[derive(Clone, Copy)]
pub(crate) enum Of {
    Pair(fn(&PairMobility) -> f64),
    Torque(fn(&PairMobility) -> f64),
    Mode(fn(&ModeMobility) -> f64),
    Swirl(fn(&SwirlMobility) -> f64),
}

/// The part of the balance that a coefficient follows from: coefficients of one block are always solved for together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// Opposed motion along `d`: differences of `XA, XF`.
    Opening,
    /// Like motion along `d`: sums of `XA, XF`.
    MeanAxial,
    /// Opposed translations across `d`, like spins: differences of `YA, YB, YF`, sums of `YC, YT`.
    Turning,
    /// Like translations across `d`, opposed spins: sums of `YA, YB, YF`, differences of `YC, YT`.
    MeanTransverse,
    /// Spins about `d`: `XC`.
    Twist,
}

/// What a coefficient times this stays bounded as the two part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FarScale {
    One,
    Gap,
    Distance,
    /// The distance too, for spins by slip, which fall faster: the turn by an interpolation error then adds up to a limit. Where they have
    /// faded into rounding it grows no more, or it would be rounding that is tabulated.
    Faded,
}

/// Distance from which on spins by slip, which fall as its third power, are rounding.
const FADED: f64 = 1e5;

/// One kind of coefficient, as the list of them has it.
#[derive(Clone, Copy)]
pub struct Coefficient {
    /// Its effect.
    pub effect: &'static str,
    /// Its cause, as the combination of the two squirmers' that it multiplies.
    pub cause: &'static str,
    /// Unit, for radius `a` and viscosity `mu`.
    pub unit: &'static str,
    /// Part of the balance.
    pub block: Block,
    pub(crate) far: FarScale,
    pub(crate) of: Of,
}

/// All kinds of coefficients. Slip and swirl are per unit of velocity, `q_k` and so on as in the [module](super); `f` is the
/// repulsive force, `T_k . d` a torque about `d`.
#[rustfmt::skip]
pub const COEFFICIENTS: [Coefficient; 19] = {
    use Block::{MeanAxial, MeanTransverse, Opening, Turning, Twist};
    use FarScale::{Distance, Faded, Gap, One};
    const fn row(
        (effect, cause, unit): (&'static str, &'static str, &'static str),
        block: Block,
        far: FarScale,
        of: Of,
    ) -> Coefficient {
        Coefficient { effect, cause, unit, block, far, of }
    }
    const OPENING: &str = "opening, d(ln eps)/dt";
    const AXIAL: &str = "mean velocity along d";
    const ACROSS: &str = "mean velocity across d";
    const TURNING: &str = "turning of d";
    const SPIN: &str = "mean spin across d";
    const COUNTER: &str = "half the difference of the spins across d";
    const TWIST: &str = "mean spin about d";
    const COUNTER_TWIST: &str = "half the difference of the spins about d";
    [
        row((OPENING, "f", "1/(pi mu a^2)"), Opening, Gap, Of::Pair(|m| m.repulsion)),
        row((OPENING, "q1 + q2", "1/a"), Opening, Gap, Of::Mode(|m| m.opening)),
        row((AXIAL, "q1 - q2", "1"), MeanAxial, One, Of::Mode(|m| m.mean_axial)),
        row((ACROSS, "s1 + s2", "1"), MeanTransverse, One, Of::Mode(|m| m.across.mean_transverse)),
        row((COUNTER, "s1 + s2", "1/a"), MeanTransverse, Faded, Of::Mode(|m| m.across.counter_spin)),
        row((TURNING, "s1 - s2", "1/a"), Turning, Distance, Of::Mode(|m| m.across.turning)),
        row((SPIN, "s1 - s2", "1/a"), Turning, Faded, Of::Mode(|m| m.across.mean_spin)),
        row((ACROSS, "t1 - t2", "1/(pi mu a^2)"), MeanTransverse, One, Of::Torque(|m| m.torque.mean_transverse)),
        row((COUNTER, "t1 - t2", "1/(pi mu a^3)"), MeanTransverse, One, Of::Torque(|m| m.torque.counter_spin)),
        row((TURNING, "t1 + t2", "1/(pi mu a^3)"), Turning, Distance, Of::Torque(|m| m.torque.turning)),
        row((SPIN, "t1 + t2", "1/(pi mu a^3)"), Turning, One, Of::Torque(|m| m.torque.mean_spin)),
        row((TWIST, "(T1 + T2) . d", "1/(pi mu a^3)"), Twist, One, Of::Pair(|m| m.twist.mean)),
        row((COUNTER_TWIST, "(T1 - T2) . d", "1/(pi mu a^3)"), Twist, One, Of::Pair(|m| m.twist.half_difference)),
        row((TWIST, "C_n (P_n(c1) - P_n(c2))", "1/a"), Twist, One, Of::Swirl(|m| m.twist.mean)),
        row((COUNTER_TWIST, "C_n (P_n(c1) + P_n(c2))", "1/a"), Twist, One, Of::Swirl(|m| m.twist.half_difference)),
        row((ACROSS, "r1 - r2", "1"), MeanTransverse, One, Of::Swirl(|m| m.across.mean_transverse)),
        row((COUNTER, "r1 - r2", "1/a"), MeanTransverse, One, Of::Swirl(|m| m.across.counter_spin)),
        row((TURNING, "r1 + r2", "1/a"), Turning, Distance, Of::Swirl(|m| m.across.turning)),
        row((SPIN, "r1 + r2", "1/a"), Turning, One, Of::Swirl(|m| m.across.mean_spin)),
    ]
};

impl MobilitySet {
    /// The number of coefficients.
    #[must_use]
    pub fn count(self) -> usize {
        COEFFICIENTS.iter().map(|of| of.count(self)).sum()
    }
}

impl Coefficient {
    /// Its value for the mode counted from 0, if it has one.
    pub(crate) fn value(&self, n: usize, of_pair: &Mobility) -> f64 {
        match self.of {
            Of::Pair(of) | Of::Torque(of) => of(&of_pair.pair),
            Of::Mode(of) => of(&of_pair.modes[n]),
            Of::Swirl(of) => of(&of_pair.swirl[n]),
        }
    }

    /// The number of modes of a set that have one, 1 where it belongs to none, 0 where it is not read.
    fn count(&self, set: MobilitySet) -> usize {
        let count = match self.of {
            Of::Pair(_) => 1,
            Of::Torque(_) => usize::from(set.torque),
            Of::Mode(_) => set.loads.modes,
            // All three loads of a swirl mode are read.
            Of::Swirl(_) => return set.loads.swirl,
        };
        if self.block.is_in(set.loads) {
            count
        } else {
            0
        }
    }
}

impl Mobility {
    /// Every coefficient of `set` with its effect, its cause and its mode, such as `opening, d(ln eps)/dt by q1 + q2, mode 2`.
    #[must_use]
    pub fn named(&self, set: MobilitySet) -> Vec<(String, f64)> {
        let of = |c: &Coefficient, n: usize| {
            let mode = match c.of {
                Of::Pair(_) | Of::Torque(_) => String::new(),
                Of::Mode(_) | Of::Swirl(_) => format!(", mode {}", n + 1),
            };
            let name = format!("{} by {}{mode}", c.effect, c.cause);
            (name, c.value(n, self))
        };
        (COEFFICIENTS.iter())
            .flat_map(|c| (0..c.count(set)).map(move |n| of(c, n)))
            .collect()
    }
}

impl Block {
    /// All blocks.
    pub const ALL: [Self; 5] = [
        Self::Opening,
        Self::MeanAxial,
        Self::Turning,
        Self::MeanTransverse,
        Self::Twist,
    ];

    /// Whether coefficients of this block are read where `loads` are.
    #[must_use]
    pub const fn is_in(self, loads: LoadSet) -> bool {
        match self {
            Self::Opening => loads.axial.difference,
            Self::MeanAxial => loads.axial.sum,
            Self::Turning => loads.transverse.difference,
            Self::MeanTransverse => loads.transverse.sum,
            Self::Twist => loads.twist,
        }
    }

    /// The loads of this block alone, for the squirming modes 1 to `modes`.
    #[must_use]
    pub const fn loads(self, modes: usize) -> LoadSet {
        let (mut axial, mut transverse) = (Parities::NONE, Parities::NONE);
        match self {
            Self::Opening => axial = Parities::DIFFERENCE,
            Self::MeanAxial => axial = Parities::SUM,
            Self::Turning => transverse = Parities::DIFFERENCE,
            Self::MeanTransverse => transverse = Parities::SUM,
            Self::Twist => {}
        }
        LoadSet {
            modes,
            axial,
            transverse,
            twist: matches!(self, Self::Twist),
            swirl: 0,
        }
    }
}

impl FarScale {
    /// What the coefficient is multiplied by at `gap`, with the centres at `distance`.
    pub(crate) fn at(self, gap: Gap, distance: f64) -> f64 {
        match self {
            Self::One => 1.0,
            Self::Gap => gap.eps(),
            Self::Distance => distance,
            Self::Faded => distance.min(FADED),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Across, Twist};
    use super::*;

    const ALL: MobilitySet = MobilitySet {
        loads: LoadSet::all(2).with_swirl(1),
        torque: true,
    };

    #[test]
    fn every_coefficient_is_in_the_list_once() {
        let mut number = 0.0;
        let mut next = || {
            number += 1.0;
            number
        };
        let mut across = || Across {
            mean_transverse: next(),
            counter_spin: next(),
            turning: next(),
            mean_spin: next(),
        };
        let (torque, of_modes, of_swirl) = (across(), [across(), across()], across());
        let mut twist = || Twist {
            mean: next(),
            half_difference: next(),
        };
        let (by_torque, by_swirl) = (twist(), twist());
        let mut mobility = Mobility::default();
        (mobility.pair.torque, mobility.pair.twist) = (torque, by_torque);
        mobility.pair.repulsion = next();
        for (mode, across) in mobility.modes.iter_mut().zip(of_modes) {
            (mode.opening, mode.mean_axial, mode.across) = (next(), next(), across);
        }
        let [swirl, ..] = &mut mobility.swirl;
        (swirl.twist, swirl.across) = (by_swirl, of_swirl);
        let named = mobility.named(ALL);
        let mut values: Vec<f64> = named.iter().map(|(_, value)| *value).collect();
        values.sort_by(f64::total_cmp);
        let expected: Vec<f64> = (1..=ALL.count()).map(|n| n as f64).collect();
        assert_eq!(values, expected);
        let mut names: Vec<_> = named.into_iter().map(|(name, _)| name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), expected.len());
    }

    #[test]
    fn a_set_counts_what_its_scenes_read() {
        let count = |loads, torque| MobilitySet { loads, torque }.count();
        // A planar pair reads 13 numbers, with gravity 17.
        assert_eq!(count(LoadSet::planar(2), false), 13);
        assert_eq!(count(LoadSet::planar(2), true), 17);
        assert_eq!(count(LoadSet::planar(2).point_symmetric(), false), 7);
        assert_eq!(count(LoadSet::axial(2).mirror_symmetric(), false), 3);
        assert_eq!(count(LoadSet::all(2).with_swirl(2), true), 31);
    }

    #[test]
    fn the_page_on_models_lists_the_coefficients_as_they_are() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/MODELS.md");
        let page = std::fs::read_to_string(file).unwrap();
        for of in &COEFFICIENTS {
            let row = format!("| {} | `{}` | `{}` |", of.effect, of.cause, of.unit);
            assert!(page.contains(&row), "missing in docs/MODELS.md: {row}");
        }
        assert_eq!(page.matches("(pi mu a^").count(), 7);
    }
}
