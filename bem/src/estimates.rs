//! What the loads of a level may be off by, load by load, from two coarser levels.

use scene::{
    ActiveLoads, LoadSet, ModeLoads, PairLoads, Parities, SelfOther, SwirlLoads, SwirlModeLoads,
};

/// Errors are taken to fall at least by this factor over two levels, by two a level. Against `exact`, with 34 loads
/// at gaps from 0.001 to 1, the fall from a level to the next is 4.6, 4.1 and 3.8 in the middle for levels 2, 3 and
/// 4, so that errors go with the power 4.6 to 5.3 of the size of panels. It is above 2.4 for nine in ten, but below 2
/// for one in twenty, where an error changes its sign nearby. With 9, by three a level, 2 of 816 loads were
/// off by more than their estimate at levels 3 to 5; with 4 none.
const TWO_LEVELS: f64 = 4.0;

/// No load is trusted this much more than the worst one: all come from the same densities.
const TRUST: f64 = 0.01;

/// Factors on the estimates at levels 0, 1 and 2; finer ones need none.
const CAUTION: [f64; 3] = [3.0, 3.0, 2.0];

/// Least factor for unlike spheres. Their scalars are not split into two that are solved for apart, so that levels agree by
/// chance more often: at level 3, 94 of 14,000 loads were off by more than their estimate with the factor 1, and 12 with 2
/// (example `unlike`).
const CAUTION_UNLIKE: f64 = 2.0;

/// What is done to the estimate of a load by itself.
#[derive(Clone, Copy)]
struct Caution {
    /// Whether the radii are unlike.
    unlike: bool,
    factor: f64,
    /// Smallest estimate, relative to the larger of the load and 1.
    least: f64,
}

/// An error estimate for each load, in the units of the load itself and never negative.
///
/// With `q_l` the sum or the difference of a load's scalars at level l, which are solved for apart, it is
///
/// ```text
/// E = max(|q_l - q_(l-1)|, |q_(l-1) - q_(l-2)|/4),
/// ```
///
/// and for the scalars themselves, self and other alike, half of the sum of both. Of unlike spheres the scalars themselves are solved for, and may
/// differ by the cube of the ratio of radii: `q_l` is each of these, and E, relative to the larger of the load and 1, not less than
/// the mean of both. Two levels may agree by chance
/// where the error changes its sign; three hardly do, nor both sum and difference. What is below a hundredth of the
/// largest estimate, each relative to the larger of the load and 1, is raised to that.
///
/// Levels 1 and 2 are compared with levels 0 and -1, which are used for nothing else and so coarse that their errors do
/// not fall evenly: there errors were up to 2.0 (level 1, X12A at gap 0.02) and 1.004 (level 2) times E. Estimates are
/// `3 E` at level 1 and `2 E` at level 2; of unlike spheres `2 E` from there on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimates {
    /// For each load its estimate: [`PairLoads::named`] lists them under the names of the loads. For a set of a
    /// pair without symmetry these are the estimates of `own` and `other`; for one with a symmetry, those of the sum
    /// and the difference, of which it reads one.
    pub loads: PairLoads,
    /// The same for the loads by swirl, always of `own` and `other`.
    pub swirl: SwirlLoads,
    /// That of the torque on the other sphere by translation, for a pair without symmetry; of equal spheres it is that of `Y12B`.
    pub torque_on_other: f64,
}

impl Estimates {
    /// From the loads of `level` and the two coarser ones, the finest first.
    pub(crate) fn of_levels(
        (level, unlike): (usize, bool),
        set: LoadSet,
        levels: [&ActiveLoads; 3],
    ) -> Self {
        let factor = CAUTION.get(level).copied().unwrap_or(1.0);
        let caution = Caution {
            unlike,
            factor: factor.max(if unlike { CAUTION_UNLIKE } else { 1.0 }),
            least: 0.0,
        };
        let ActiveLoads { pair, swirl, .. } = levels[0];
        let largest = Self::with(caution, set, levels).largest(pair, swirl);
        let least = TRUST * largest;
        Self::with(Caution { least, ..caution }, set, levels)
    }

    fn with(caution: Caution, set: LoadSet, levels: [&ActiveLoads; 3]) -> Self {
        let loads = levels.map(|level| &level.pair);
        let swirl = levels.map(|level| &level.swirl);
        let (along, across) = (
            set.axial == Parities::BOTH,
            set.transverse == Parities::BOTH,
        );
        let rigid =
            |both, part: fn(&PairLoads) -> SelfOther| caution.of_scalars(both, loads.map(part));
        let by_mode = |both, n: usize, part: fn(&ModeLoads) -> SelfOther| {
            caution.of_scalars(both, loads.map(|l| part(&l.mode(n))))
        };
        let by_swirl = |n: usize, part: fn(&SwirlModeLoads) -> SelfOther| {
            caution.of_scalars(true, swirl.map(|s| part(&s.modes()[n])))
        };
        let rigid = [
            rigid(along, |l| l.xa),
            rigid(across, |l| l.ya),
            rigid(across, |l| l.yb),
            // Spin about the line of centres is read whole whatever the symmetry.
            rigid(true, |l| l.xc),
            rigid(across, |l| l.yc),
        ];
        Self {
            loads: PairLoads::from_parts(rigid, set, |n| ModeLoads {
                xf: by_mode(along, n, |m| m.xf),
                yf: by_mode(across, n, |m| m.yf),
                yt: by_mode(across, n, |m| m.yt),
            }),
            swirl: SwirlLoads::from_modes(set, |n| SwirlModeLoads {
                xtc: by_swirl(n, |m| m.xtc),
                yfc: by_swirl(n, |m| m.yfc),
                ytc: by_swirl(n, |m| m.ytc),
            }),
            torque_on_other: caution.of_torque(levels),
        }
    }
}

impl Estimates {
    /// The largest, each relative to the larger of its load and 1.
    #[must_use]
    pub fn largest(&self, loads: &PairLoads, swirl: &SwirlLoads) -> f64 {
        let own = self.loads.named().into_iter().zip(loads.named());
        let by_swirl = self.swirl.named().into_iter().zip(swirl.named());
        own.chain(by_swirl)
            .map(|((_, estimate), (_, load))| estimate / load.abs().max(1.0))
            .fold(0.0, f64::max)
    }

    /// The largest, that of the torque on the other sphere included.
    pub(crate) fn largest_of(&self, loads: &ActiveLoads) -> f64 {
        let torque = self.torque_on_other / loads.torque_on_other.abs().max(1.0);
        self.largest(&loads.pair, &loads.swirl).max(torque)
    }
}

impl Caution {
    /// Of the torque on the other sphere by translation, with that on the sphere itself for the other number.
    fn of_torque(self, levels: [&ActiveLoads; 3]) -> f64 {
        let both = levels.map(|of| SelfOther::new(of.pair.yb.own(), of.torque_on_other));
        self.of_scalars(true, both).other()
    }

    /// Of three levels' scalars, for `own` and `other`, or for the sum and the difference where a symmetry
    /// makes a set read one of these alone.
    fn of_scalars(self, both: bool, levels: [SelfOther; 3]) -> SelfOther {
        let raised = |estimate: f64, load: f64| {
            (self.factor * estimate).max(self.least * load.abs().max(1.0))
        };
        let fine = levels[0];
        if self.unlike {
            let scales = [fine.own(), fine.other()].map(|load| load.abs().max(1.0));
            let own = of_numbers(levels.map(SelfOther::own)) / scales[0];
            let other = of_numbers(levels.map(SelfOther::other)) / scales[1];
            let mean = f64::midpoint(own, other);
            return SelfOther::new(
                raised(own.max(mean) * scales[0], fine.own()),
                raised(other.max(mean) * scales[1], fine.other()),
            );
        }
        let sum = of_numbers(levels.map(|s| s.sum));
        let difference = of_numbers(levels.map(|s| s.difference));
        if both {
            let either = f64::midpoint(sum, difference);
            SelfOther::new(raised(either, fine.own()), raised(either, fine.other()))
        } else {
            SelfOther {
                sum: raised(sum, fine.sum),
                difference: raised(difference, fine.difference),
            }
        }
    }
}

/// Of one number at three levels, the finest first.
fn of_numbers([fine, middle, coarse]: [f64; 3]) -> f64 {
    (fine - middle)
        .abs()
        .max((middle - coarse).abs() / TWO_LEVELS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_levels_that_agree_by_chance_are_not_believed() {
        let estimate = of_numbers([1.0, 1.0, 1.9]);
        approx::assert_relative_eq!(estimate, 0.9 / TWO_LEVELS, max_relative = 1e-12);
    }

    #[test]
    fn each_load_has_its_own_estimate_under_its_own_name() {
        let set = LoadSet::all(2).with_swirl(1);
        let level = |change: f64| {
            let mut loads = PairLoads::isolated(set);
            loads.xa += SelfOther::new(0.0, change);
            loads.modes_mut()[1].yt += SelfOther::new(3.0 * change, 0.0);
            let mut swirl = SwirlLoads::isolated(set);
            swirl.modes_mut()[0].ytc += SelfOther::new(2.0 * change, 0.0);
            ActiveLoads::of_equal(loads, swirl)
        };
        let [fine, middle] = [level(0.25), level(0.0)];
        let found = Estimates::of_levels((3, false), set, [&fine, &middle, &middle]);
        let largest = found.largest_of(&fine);
        approx::assert_relative_eq!(largest, 0.75, epsilon = 1e-14);
        let all = (found.loads.named().into_iter()).chain(found.swirl.named());
        let loads = (fine.pair.named().into_iter()).chain(fine.swirl.named());
        for ((name, estimate), (_, load)) in all.zip(loads) {
            let expected = match name.as_str() {
                "X11A" | "X12A" => 0.25,
                "YT1_2" | "YT2_2" => 0.75,
                "YTC1_1" | "YTC2_1" => 0.5,
                _ => TRUST * largest * load.abs().max(1.0),
            };
            approx::assert_relative_eq!(estimate, expected, epsilon = 1e-14);
        }
    }

    #[test]
    fn a_symmetric_pair_reads_the_estimate_of_the_combination_that_it_reads() {
        let set = LoadSet::axial(1).point_symmetric();
        let level = |change: f64| {
            let mut loads = PairLoads::isolated(set);
            loads.xa += SelfOther::new(change, -change);
            ActiveLoads::of_equal(loads, SwirlLoads::isolated(set))
        };
        let [fine, middle] = [level(0.25), level(0.0)];
        let found = Estimates::of_levels((3, false), set, [&fine, &middle, &middle]);
        let (name, estimate) = found.loads.named().remove(0);
        assert_eq!(name, "X11A - X12A");
        approx::assert_relative_eq!(estimate, 0.5, max_relative = 1e-12);
    }
}
