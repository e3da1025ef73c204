//! Motion of a pair of unlike radii: each squirmer's causes have coefficients of their own.

use super::{
    Across, External, Heading, Mobility, MobilitySet, ModeMobility, PairVelocity, SwirlMobility,
    Transverse, Twist,
};
use crate::{Squirmer, legendre};

/// The coefficients of a pair of unlike radii at one gap. Where the two are equal, those of squirmer 1 and 2 follow from sums and
/// differences of causes, as in the [module](super); here they multiply the causes of either squirmer themselves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MobilityOfEach {
    /// By the causes of each squirmer, `q_k, s_k, r_k, t_k` and `T_k . d`. Repulsion, which is one cause, opens the gap by that of squirmer 1;
    /// that of squirmer 2 is zero.
    pub by: [Mobility; 2],
    /// Mean velocity along `d` per repulsive force.
    pub mean_axial_by_repulsion: f64,
}

impl MobilityOfEach {
    /// Fills in the coefficients of `set` by the causes of squirmer 2 where those of squirmer 1 are the coefficients of equal radii, by sums and differences of
    /// causes. A cause that moves the two alike as a sum, or oppositely as a difference, has the sign of its place in it.
    pub(crate) fn take_out_of_sums(&mut self, set: MobilitySet) {
        let [first, second] = &mut self.by;
        let by_difference = |of: &Across| Across {
            turning: -of.turning,
            mean_spin: -of.mean_spin,
            ..*of
        };
        let by_sum = |of: &Across| Across {
            mean_transverse: -of.mean_transverse,
            counter_spin: -of.counter_spin,
            ..*of
        };
        self.mean_axial_by_repulsion = 0.0;
        second.pair.repulsion = 0.0;
        second.pair.torque = by_sum(&first.pair.torque);
        second.pair.twist = Twist {
            half_difference: -first.pair.twist.half_difference,
            ..first.pair.twist
        };
        let modes = first.modes.iter().zip(&mut second.modes);
        for (of, second) in modes.take(set.loads.modes) {
            *second = ModeMobility {
                opening: of.opening,
                mean_axial: -of.mean_axial,
                across: by_difference(&of.across),
            };
        }
        let swirl = first.swirl.iter().zip(&mut second.swirl);
        for (of, second) in swirl.take(set.loads.swirl) {
            *second = SwirlMobility {
                twist: Twist {
                    mean: -of.twist.mean,
                    ..of.twist
                },
                across: by_sum(&of.across),
            };
        }
    }

    /// Adds `weight` times the coefficients of `set` of another one.
    pub(crate) fn add(&mut self, weight: f64, other: &Self, set: MobilitySet) {
        for (of, other) in self.by.iter_mut().zip(&other.by) {
            of.add(weight, other, set);
        }
        self.mean_axial_by_repulsion += weight * other.mean_axial_by_repulsion;
    }

    /// Every coefficient of `set` by the causes of squirmer 1, then by those of squirmer 2, with its effect, its cause and its mode, such as
    /// `opening, d(ln eps)/dt by q1, mode 2`.
    #[must_use]
    pub fn named(&self, set: MobilitySet) -> Vec<(String, f64)> {
        let of = |k: usize| {
            // Repulsion is one cause.
            let named = self.by[k].named(set).into_iter();
            let named = named.filter(move |(name, _)| k == 0 || !name.ends_with(" by f"));
            named.map(move |(name, value)| (of_squirmer(&name, k + 1), value))
        };
        let drift = (
            "mean velocity along d by f".to_owned(),
            self.mean_axial_by_repulsion,
        );
        of(0).chain(of(1)).chain([drift]).collect()
    }
}

/// The name of a coefficient with the cause of one squirmer instead of a combination of both.
fn of_squirmer(name: &str, squirmer: usize) -> String {
    let Some((effect, cause)) = name.split_once(" by ") else {
        return name.to_owned();
    };
    let (cause, mode) = cause.split_once(", mode").unwrap_or((cause, ""));
    let kind = match cause {
        _ if cause.starts_with('(') => format!("T{squirmer} . d"),
        _ if cause.starts_with('C') => format!("C_n P_n(c{squirmer})"),
        "f" => "f".to_owned(),
        _ => cause
            .chars()
            .take(1)
            .chain(squirmer.to_string().chars())
            .collect(),
    };
    let mode = if mode.is_empty() {
        String::new()
    } else {
        format!(", mode{mode}")
    };
    format!("{effect} by {kind}{mode}")
}

/// Motion across `d` by a cause, as it is added up.
#[derive(Clone, Copy)]
struct Sum<T> {
    mean_transverse: T,
    turning: T,
    spin: [T; 2],
}

impl<T: Transverse> Sum<T> {
    fn none(zero: T) -> Self {
        Self {
            mean_transverse: zero,
            turning: zero,
            spin: [zero; 2],
        }
    }

    fn add(&mut self, of: &Across, cause: T) {
        self.mean_transverse = self.mean_transverse + cause * of.mean_transverse;
        self.turning = self.turning + cause * of.turning;
        let [one, two] = self.spin;
        self.spin = [
            one + cause * (of.mean_spin + of.counter_spin),
            two + cause * (of.mean_spin - of.counter_spin),
        ];
    }
}

/// What the slip of one mode of a squirmer does: along the line of centres and across it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slip<T> {
    /// `B_n P_n(c)`, or of swirl `C_n P_n(c)`.
    pub along: f64,
    /// `B_n W_n(c)` times the transverse heading, or of swirl `C_n W_n(c)` times that turned by a quarter.
    pub across: T,
}

/// Velocities of a pair of squirmers of unlike radii, which are free but for `external`, by the first `modes` squirming modes;
/// `headings` in the pair frame.
pub fn velocity_of_each<T: Transverse>(
    mobility: &MobilityOfEach,
    modes: usize,
    squirmers: &[Squirmer; 2],
    headings: &[Heading<T>; 2],
    external: &External<T>,
) -> PairVelocity<T> {
    let slip = [0, 1].map(|k| {
        let heading = headings[k];
        let orders = legendre(heading.cosine).take(modes).enumerate();
        orders.map(move |(n, order)| {
            let b = squirmers[k].mode(n);
            Slip {
                along: b * order.p,
                across: heading.transverse * (b * order.w),
            }
        })
    });
    let zero = headings[0].transverse * 0.0;
    velocity_by(mobility, slip, zero, external)
}

/// Velocities of a pair by the slip of each squirmer, from its first mode on, and by `external`. They are linear in the causes and in the coefficients.
pub(crate) fn velocity_by<T: Transverse>(
    mobility: &MobilityOfEach,
    slip: [impl Iterator<Item = Slip<T>>; 2],
    zero: T,
    external: &External<T>,
) -> PairVelocity<T> {
    let mut across = Sum::none(zero);
    let mut opening = mobility.by[0].pair.repulsion * external.repulsion;
    let mut mean_axial = mobility.mean_axial_by_repulsion * external.repulsion;
    for (k, slip) in slip.into_iter().enumerate() {
        let by = &mobility.by[k];
        for (mode, slip) in by.modes.iter().zip(slip) {
            opening += slip.along * mode.opening;
            mean_axial += slip.along * mode.mean_axial;
            across.add(&mode.across, slip.across);
        }
        if let Some(torque) = external.torque {
            across.add(&by.pair.torque, torque[k]);
        }
    }
    PairVelocity {
        opening,
        mean_axial,
        mean_transverse: across.mean_transverse,
        turning: across.turning,
        spin: across.spin,
    }
}

/// Adds the motion across `d` by swirl, and returns the spin of each squirmer about `d` by it; `turned` are the transverse headings
/// turned by a quarter, `d x v`.
pub fn add_swirl_of_each<T: Transverse>(
    velocity: &mut PairVelocity<T>,
    mobility: &MobilityOfEach,
    squirmers: &[Squirmer; 2],
    (headings, turned): (&[Heading<T>; 2], &[T; 2]),
) -> [f64; 2] {
    let swirl = [0, 1].map(|k| {
        let turned = turned[k];
        let of_modes = squirmers[k].swirl().iter();
        (of_modes.zip(legendre(headings[k].cosine))).map(move |(strength, order)| Slip {
            along: strength * order.p,
            across: turned * (strength * order.w),
        })
    });
    add_swirl_by(velocity, mobility, swirl)
}

/// The same by the swirl of each squirmer, from its first mode on.
pub(crate) fn add_swirl_by<T: Transverse>(
    velocity: &mut PairVelocity<T>,
    mobility: &MobilityOfEach,
    swirl: [impl Iterator<Item = Slip<T>>; 2],
) -> [f64; 2] {
    let mut across = Sum {
        mean_transverse: velocity.mean_transverse,
        turning: velocity.turning,
        spin: velocity.spin,
    };
    let mut axial = [0.0; 2];
    for (by, swirl) in mobility.by.iter().zip(swirl) {
        for (of, slip) in by.swirl.iter().zip(swirl) {
            across.add(&of.across, slip.across);
            let spins = of.twist.spins(slip.along, slip.along);
            axial = [axial[0] + spins[0], axial[1] + spins[1]];
        }
    }
    velocity.mean_transverse = across.mean_transverse;
    velocity.turning = across.turning;
    velocity.spin = across.spin;
    axial
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LoadSet;

    #[test]
    fn each_coefficient_has_one_name_by_either_squirmer_and_repulsion_is_one_cause() {
        let set = MobilitySet {
            loads: LoadSet::all(2).with_swirl(1),
            torque: true,
        };
        let of_one = MobilityOfEach::default().by[0].named(set);
        let by_repulsion = |name: &str| name.ends_with(" by f");
        let once = of_one.iter().filter(|(name, _)| by_repulsion(name)).count();
        let named = MobilityOfEach::default().named(set);
        assert!(once > 0);
        assert_eq!(named.len(), 2 * (of_one.len() - once) + once + 1);
        let names: std::collections::BTreeSet<&str> =
            named.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names.len(), named.len(), "{names:#?}");
        for (one, two) in [
            (
                "opening, d(ln eps)/dt by q1, mode 2",
                "opening, d(ln eps)/dt by q2, mode 2",
            ),
            (
                "mean velocity along d by q1, mode 1",
                "mean velocity along d by q2, mode 1",
            ),
        ] {
            assert!(names.contains(one) && names.contains(two), "{names:#?}");
        }
        assert!(names.contains("mean velocity along d by f"));
    }
}
