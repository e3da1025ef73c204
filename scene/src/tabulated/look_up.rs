//! Tabulated columns as they are read.

mod of_each;

pub(super) use of_each::{ColumnsOfEach, shrink_of_each, shrink_slopes_of_each};

use super::build::Tabulation;
use super::columns::{BASE_MODES, Group};
use super::parts::{Parts, Place};
use crate::mobility::{
    Across, Block, MobilitySet, ModeMobility, PairMobility, SwirlMobility, Twist,
};
use crate::{Gap, LoadSet};

/// What is tabulated, in pairs of columns. What is not has no stretches.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Columns {
    /// Opening by the modes 1 and 2 and by repulsion, and a zero.
    opening: Parts<2>,
    /// Mean axial velocity by the modes 1 and 2.
    mean_axial: Parts<1>,
    /// Turning and mean spin by the modes 1 and 2 and by torque.
    turning: Parts<3>,
    /// Mean transverse velocity and counter spin by the modes 1 and 2 and by torque.
    mean_transverse: Parts<3>,
    /// Spins about `d` by torque.
    twist: Parts<1>,
    /// All by each squirming mode from 3 on.
    modes: Vec<Parts<3>>,
    /// All by each swirl mode.
    swirl: Vec<Parts<3>>,
}

/// A tabulation, laid out for look-ups; none if it does not fit. With it stand the numbers of parts that most columns have.
fn laid_out<const PAIRS: usize>((tabulation, usual): (&Tabulation, &[u32])) -> Parts<PAIRS> {
    Parts::new(&tabulation.stretches, usual).unwrap_or_default()
}

/// The same in its place among those of all modes.
fn put<const PAIRS: usize>(all: &mut Vec<Parts<PAIRS>>, at: usize, of: (&Tabulation, &[u32])) {
    all.resize(all.len().max(at + 1), Parts::default());
    all[at] = laid_out(of);
}

impl Columns {
    /// Lays out a tabulation for look-ups; one that does not fit, or is of unlike radii, is left out. `usual` are the numbers of parts that most columns have.
    pub fn take(&mut self, group: Group, tabulation: &Tabulation, usual: &[u32]) {
        let of = (tabulation, usual);
        match group {
            Group::Block(Block::Opening) => self.opening = laid_out(of),
            Group::Block(Block::MeanAxial) => self.mean_axial = laid_out(of),
            Group::Block(Block::Turning) => self.turning = laid_out(of),
            Group::Block(Block::MeanTransverse) => self.mean_transverse = laid_out(of),
            Group::Block(Block::Twist) => self.twist = laid_out(of),
            Group::Mode(n) => put(&mut self.modes, n - BASE_MODES - 1, of),
            Group::Swirl(n) => put(&mut self.swirl, n - 1, of),
            _ => {}
        }
    }

    /// Fills in the coefficients of `set`, or their derivatives; none if one is not tabulated.
    #[inline(always)]
    pub fn read<const SLOPE: bool>(
        &self,
        place: &Place<SLOPE>,
        set: MobilitySet,
        pair: &mut PairMobility,
        modes: &mut [ModeMobility],
    ) -> Option<()> {
        let LoadSet {
            axial,
            transverse,
            twist,
            ..
        } = set.loads;
        let [one, two, ..] = modes else {
            return self.read_fewer(place, set, pair, modes);
        };
        if axial.difference {
            let parts = &self.opening;
            [[one.opening, two.opening], [pair.repulsion, _]] = parts.at(place)?;
        }
        if axial.sum {
            let parts = &self.mean_axial;
            [[one.mean_axial, two.mean_axial]] = parts.at(place)?;
        }
        if transverse.difference {
            let parts = &self.turning;
            let (a, b, torque) = (&mut one.across, &mut two.across, &mut pair.torque);
            if set.torque {
                [
                    [a.turning, a.mean_spin],
                    [b.turning, b.mean_spin],
                    [torque.turning, torque.mean_spin],
                ] = parts.at(place)?;
            } else {
                [[a.turning, a.mean_spin], [b.turning, b.mean_spin]] = parts.at(place)?;
            }
        }
        if transverse.sum {
            let parts = &self.mean_transverse;
            let (a, b, torque) = (&mut one.across, &mut two.across, &mut pair.torque);
            if set.torque {
                [
                    [a.mean_transverse, a.counter_spin],
                    [b.mean_transverse, b.counter_spin],
                    [torque.mean_transverse, torque.counter_spin],
                ] = parts.at(place)?;
            } else {
                [
                    [a.mean_transverse, a.counter_spin],
                    [b.mean_transverse, b.counter_spin],
                ] = parts.at(place)?;
            }
        }
        if twist {
            let parts = &self.twist;
            let twist = &mut pair.twist;
            [[twist.mean, twist.half_difference]] = parts.at(place)?;
        }
        let higher = set.loads.modes.saturating_sub(BASE_MODES);
        for (n, of_mode) in modes.iter_mut().skip(BASE_MODES).enumerate().take(higher) {
            let parts = self.modes.get(n)?;
            let [[opening, mean_axial], even, odd] = parts.at(place)?;
            *of_mode = ModeMobility {
                opening,
                mean_axial,
                across: across(even, odd),
            };
        }
        Some(())
    }

    /// The same where there is no room for the second mode.
    #[cold]
    fn read_fewer<const SLOPE: bool>(
        &self,
        place: &Place<SLOPE>,
        set: MobilitySet,
        pair: &mut PairMobility,
        modes: &mut [ModeMobility],
    ) -> Option<()> {
        let mut both = [ModeMobility::default(); BASE_MODES];
        self.read(place, set, pair, &mut both)?;
        modes.copy_from_slice(&both[..modes.len()]);
        Some(())
    }

    /// The coefficients by a swirl mode, counted from 0, if it is tabulated.
    pub fn swirl<const SLOPE: bool>(
        &self,
        place: &Place<SLOPE>,
        n: usize,
    ) -> Option<SwirlMobility> {
        let parts = self.swirl.get(n)?;
        let [[mean, half_difference], even, odd] = parts.at(place)?;
        Some(SwirlMobility {
            twist: Twist {
                mean,
                half_difference,
            },
            across: across(even, odd),
        })
    }
}

/// From the pairs of columns of a mode that is tabulated alone.
#[inline(always)]
fn across([mean_transverse, counter_spin]: [f64; 2], [turning, mean_spin]: [f64; 2]) -> Across {
    Across {
        mean_transverse,
        counter_spin,
        turning,
        mean_spin,
    }
}

/// From what is tabulated far apart, with the centres at `distance`, to the coefficients: by [`FarScale`](crate::mobility::FarScale).
pub(super) fn shrink(gap: Gap, distance: f64, pair: &mut PairMobility, modes: &mut [ModeMobility]) {
    let (by_gap, by_distance) = (1.0 / gap.eps(), 1.0 / distance);
    pair.repulsion *= by_gap;
    pair.torque.turning *= by_distance;
    for mode in modes {
        mode.opening *= by_gap;
        let across = &mut mode.across;
        for far in [
            &mut across.turning,
            &mut across.mean_spin,
            &mut across.counter_spin,
        ] {
            *far *= by_distance;
        }
    }
}

/// From the slopes of what is tabulated far apart, already times those of its coordinate, to those of the coefficients by `ln eps`: [`shrink`] of them,
/// and how the factors change. The coefficients are given as they are.
fn shrink_slopes(
    gap: Gap,
    distance: f64,
    (pair, modes): (&PairMobility, &[ModeMobility]),
    (pair_slope, mode_slopes): (&mut PairMobility, &mut [ModeMobility]),
) {
    shrink(gap, distance, pair_slope, mode_slopes);
    // d(1/eps) = -1/eps and d(1/r) = -eps/r^2 over d(ln eps).
    let by_distance = gap.eps() / distance;
    pair_slope.repulsion -= pair.repulsion;
    pair_slope.torque.turning -= by_distance * pair.torque.turning;
    for (mode, slope) in modes.iter().zip(mode_slopes) {
        slope.opening -= mode.opening;
        slope.across.turning -= by_distance * mode.across.turning;
        slope.across.mean_spin -= by_distance * mode.across.mean_spin;
        slope.across.counter_spin -= by_distance * mode.across.counter_spin;
    }
}
