//! The loads of a pair of unlike radii: eleven resistance scalars and the loads by slip, for each sphere that moves or squirms.
//!
//! Definitions and signs are those of [`crate::loads`] with the sphere that moves or squirms (the active one) in the place of sphere 1,
//! `d` from it to the other one, and its radius for the unit of length: forces per `pi mu a_k B_n`, torques per `pi mu a_k^2 B_n`, scalars per
//! `6 pi mu a_k`, `4 pi mu a_k^2` and `8 pi mu a_k^3`. Scalars have the numbers of the sphere that is loaded and of the one that is active:
//! `X21A` is the axial force on sphere 2 by sphere 1, as `F2_d = -6 pi a_1 X21A U_d`, and `Y21B` the torque on it, as `T2 = 4 pi a_1^2 Y21B U`.
//!
//! Force by spin and torque by translation have the same scalar on the active sphere itself, but not on the other one:
//!
//! ```text
//! F_other = 4 pi a_k^2 YB omega,   T_other = 4 pi a_k^2 (torque on other) U,   equal spheres: (torque on other) = -YB
//! ```

use crate::{LoadSet, PairLoads, SelfOther, SwirlLoads};

/// Loads when one of two spheres moves or squirms. See the [module](self) for definitions and signs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveLoads {
    /// Ten resistance scalars and the loads by squirming; `yb` has the force on the other sphere by the spin of this one.
    pub pair: PairLoads,
    /// The eleventh: torque on the other sphere by transverse motion of this one.
    pub torque_on_other: f64,
    /// Loads by swirl.
    pub swirl: SwirlLoads,
}

impl ActiveLoads {
    /// Of either of two equal spheres.
    #[must_use]
    pub fn of_equal(pair: PairLoads, swirl: SwirlLoads) -> Self {
        Self {
            torque_on_other: -pair.yb.other(),
            pair,
            swirl,
        }
    }

    /// Loads of two spheres infinitely far apart.
    #[must_use]
    pub fn isolated(set: LoadSet) -> Self {
        Self::of_equal(PairLoads::isolated(set), SwirlLoads::isolated(set))
    }

    /// Every scalar with its name, if sphere `active` (1 or 2) is the active one: `X11A, X21A, ...`, the torque on the other sphere by
    /// translation as `Y21B` and the force on it by spin as `Y21B_force`, loads by mode as `XF21_n`.
    #[must_use]
    pub fn named(&self, active: usize) -> Vec<(String, f64)> {
        let other = 3 - active;
        let set = self.pair.set();
        let across = set.transverse.any();
        let of = |of: &str, kind: &str, s: SelfOther| {
            [(active, s.own()), (other, s.other())]
                .map(|(loaded, value)| (format!("{of}{loaded}{active}{kind}"), value))
        };
        let mut rows = Vec::from(of("X", "A", self.pair.xa));
        if across {
            rows.extend(of("Y", "A", self.pair.ya));
            rows.extend([
                (format!("Y{active}{active}B"), self.pair.yb.own()),
                (format!("Y{other}{active}B"), self.torque_on_other),
                (format!("Y{other}{active}B_force"), self.pair.yb.other()),
            ]);
        }
        if set.twist {
            rows.extend(of("X", "C", self.pair.xc));
        }
        if across {
            rows.extend(of("Y", "C", self.pair.yc));
        }
        for (n, mode) in (1..).zip(self.pair.modes()) {
            let n = format!("_{n}");
            rows.extend(of("XF", &n, mode.xf));
            if across {
                rows.extend(of("YF", &n, mode.yf));
                rows.extend(of("YT", &n, mode.yt));
            }
        }
        for (n, mode) in (1..).zip(self.swirl.modes()) {
            let n = format!("_{n}");
            rows.extend(of("XTC", &n, mode.xtc));
            rows.extend(of("YFC", &n, mode.yfc));
            rows.extend(of("YTC", &n, mode.ytc));
        }
        rows
    }
}

/// The resistance scalars of both spheres in the normalisation of Jeffrey & Onishi, *J. Fluid Mech.* 139 (1984) 261, by which tables are
/// published: `X11A, Y11A` per `6 pi mu a_1`, `X12A, Y12A` per `3 pi mu (a_1 + a_2)`, `Y11B` per `4 pi mu a_1^2`, `Y12B, Y21B` per
/// `pi mu (a_1 + a_2)^2`, `X11C, Y11C` per `8 pi mu a_1^3`, `X12C, Y12C` per `pi mu (a_1 + a_2)^3`; those of sphere 2 per its radius. Signs
/// as in [`crate::loads`], with `d` from sphere 1 to sphere 2 for both.
#[must_use]
pub fn jeffrey_onishi(loads: &[ActiveLoads; 2], ratio: f64) -> Vec<(&'static str, f64)> {
    let [one, two] = loads.each_ref().map(|of| &of.pair);
    let sum = 1.0 + ratio;
    let [by_area, by_volume] = [4.0 / (sum * sum), 8.0 / (sum * sum * sum)];
    vec![
        ("X11A", one.xa.own()),
        ("X12A", one.xa.other() * 2.0 / sum),
        ("X22A", two.xa.own()),
        ("Y11A", one.ya.own()),
        ("Y12A", one.ya.other() * 2.0 / sum),
        ("Y22A", two.ya.own()),
        ("Y11B", one.yb.own()),
        ("Y12B", one.yb.other() * by_area),
        ("Y21B", loads[0].torque_on_other * by_area),
        ("Y22B", -two.yb.own()),
        ("X11C", one.xc.own()),
        ("X12C", one.xc.other() * by_volume),
        ("X22C", two.xc.own()),
        ("Y11C", one.yc.own()),
        ("Y12C", one.yc.other() * by_volume),
        ("Y22C", two.yc.own()),
    ]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "the very numbers that were put in")]
    use super::*;
    use crate::loads::tests::counted;

    #[test]
    fn loads_of_unlike_spheres_name_the_loaded_sphere_and_then_the_active_one() {
        let (pair, swirl) = counted(LoadSet::all(1).with_swirl(1));
        let loads = ActiveLoads {
            pair,
            torque_on_other: 99.0,
            swirl,
        };
        for (active, other) in [(1, 2), (2, 1)] {
            let named = loads.named(active);
            let of = |name: String| {
                let found: Vec<f64> = named
                    .iter()
                    .filter(|(other, _)| *other == name)
                    .map(|(_, value)| *value)
                    .collect();
                assert_eq!(found.len(), 1, "{name} in {named:?}");
                found[0]
            };
            for (name, value) in [
                (format!("X{active}{active}A"), 1.0),
                (format!("X{other}{active}A"), 2.0),
                (format!("Y{active}{active}B"), 5.0),
                (format!("Y{other}{active}B"), 99.0),
                (format!("Y{other}{active}B_force"), 6.0),
                (format!("X{active}{active}C"), 7.0),
                (format!("Y{other}{active}C"), 10.0),
                (format!("XF{active}{active}_1"), 11.0),
                (format!("YT{other}{active}_1"), 16.0),
            ] {
                assert_eq!(of(name), value);
            }
        }
    }
}
