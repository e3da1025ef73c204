//! The balance of a pair of unlike radii: one 2 x 2 system along the line of centres, one 4 x 4 system across it.
//!
//! The unknowns are the mean `M` of the two velocities and half of their difference `D = (U1 - U2)/2`, because the forces on both by `M`
//! stay finite at contact, and the sums that go into them are kept by the loads. With `a_2 = lambda a_1`, all per `pi mu a_1`,
//!
//! ```text
//! F1 + F2 = 6 (XA1 sum + lambda XA2 sum) M + 6 (XA1 sum - lambda XA2 sum) D
//! F1 - F2 = 6 (XA1 sum - lambda XA2 sum) M + 6 (XA1 difference + lambda XA2 difference) D          (axial)
//! ```
//!
//! and the same across, with the spins `w_k = omega_k x d` besides. Of scalars that reciprocity makes equal that one is taken whose sum is
//! known: the force by a spin for the torque by a translation.

use nalgebra::{Matrix4, Vector4};

use crate::mobility::{
    Across, Mobility, MobilityOfEach, MobilitySet, ModeMobility, SwirlMobility, Twist,
};
use crate::{ActiveLoads, Gap, SelfOther};

/// Along `d`: what forces do to the mean velocity and to `ln eps`.
struct Axial {
    /// Drag on `M` by `M`, and on `M` by `D`.
    mean: f64,
    crossed: f64,
    /// `-2/eps` over the determinant.
    opening: f64,
    eps: f64,
}

impl Axial {
    fn new(gap: Gap, [one, two]: [SelfOther; 2], ratio: f64) -> Self {
        let mean = 6.0 * (one.sum + ratio * two.sum);
        let crossed = 6.0 * (one.sum - ratio * two.sum);
        // Near contact the differences go as 1/eps, so that these products are of order one.
        let apart = 6.0 * (one.difference * gap.eps() + ratio * (two.difference * gap.eps()));
        Self {
            mean,
            crossed,
            opening: -2.0 / (mean * apart - gap.eps() * (crossed * crossed)),
            eps: gap.eps(),
        }
    }

    /// `d(ln eps)/dt` and the mean velocity by the forces `F1 + F2` and `F1 - F2`.
    fn by(&self, sum: f64, difference: f64) -> [f64; 2] {
        let opening = (self.mean * difference - self.crossed * sum) * self.opening;
        let half_difference = -0.5 * self.eps * opening;
        [opening, (sum - self.crossed * half_difference) / self.mean]
    }
}

/// Across `d`: the inverse of the matrix that takes `M, D, w1, w2` to the forces `F1 + F2, F1 - F2` and the torques `T1, T2`.
struct Transverse {
    inverse: Matrix4<f64>,
    turning: f64,
}

impl Transverse {
    fn new(gap: Gap, loads: &[ActiveLoads; 2], ratio: f64) -> Self {
        let [one, two] = loads.each_ref().map(|of| &of.pair);
        let (area, volume) = (ratio * ratio, ratio * ratio * ratio);
        let mean = 6.0 * (one.ya.sum + ratio * two.ya.sum);
        let crossed = 6.0 * (one.ya.sum - ratio * two.ya.sum);
        let apart = 6.0 * (one.ya.difference + ratio * two.ya.difference);
        // In the common frame the spin of sphere 2 about d x t has the other sign.
        let [mean_w1, apart_w1] = [-4.0 * one.yb.sum, -4.0 * one.yb.difference];
        let [mean_w2, apart_w2] = [4.0 * area * two.yb.sum, -4.0 * area * two.yb.difference];
        let [w1, w2] = [8.0 * one.yc.own(), 8.0 * volume * two.yc.own()];
        let both = 4.0 * (one.yc.other() + volume * two.yc.other());
        let drag = Matrix4::new(
            mean, crossed, mean_w1, mean_w2, //
            crossed, apart, apart_w1, apart_w2, //
            mean_w1, apart_w1, w1, both, //
            mean_w2, apart_w2, both, w2,
        );
        // Loads that no fluid has move nothing by a number.
        let inverse = drag.cholesky().map(|factors| factors.inverse());
        Self {
            inverse: inverse.unwrap_or(Matrix4::repeat(f64::NAN)),
            // d(d)/dt is the difference of the velocities, of 2 from 1, over the distance.
            turning: -2.0 / gap.distance_at_ratio(ratio),
        }
    }

    /// By the forces `F1 + F2`, `F1 - F2` and the torques on the two.
    fn by(&self, sum: f64, difference: f64, [t1, t2]: [f64; 2]) -> Across {
        let motion = self.inverse * Vector4::new(sum, difference, t1, t2);
        Across {
            mean_transverse: motion[0],
            counter_spin: 0.5 * (motion[2] - motion[3]),
            turning: motion[1] * self.turning,
            mean_spin: 0.5 * (motion[2] + motion[3]),
        }
    }
}

/// Spins about `d` by torques about it.
struct About {
    inverse: [f64; 3],
}

impl About {
    fn new([one, two]: [SelfOther; 2], ratio: f64) -> Self {
        let volume = ratio * ratio * ratio;
        let (w1, w2) = (8.0 * one.own(), 8.0 * volume * two.own());
        let both = 4.0 * (one.other() + volume * two.other());
        let determinant = w1 * w2 - both * both;
        Self {
            inverse: [w2, -both, w1].map(|of| of / determinant),
        }
    }

    fn by(&self, [t1, t2]: [f64; 2]) -> Twist {
        let [w1, both, w2] = self.inverse;
        let spins = [w1 * t1 + both * t2, both * t1 + w2 * t2];
        Twist {
            mean: 0.5 * (spins[0] + spins[1]),
            half_difference: 0.5 * (spins[0] - spins[1]),
        }
    }
}

/// One squirmer as the cause, in the frame of the pair: of squirmer 2, `d` and `d x t` point the other way, and its own sphere is the
/// second.
struct Cause {
    second: bool,
    radius: f64,
    /// 1, or -1 of squirmer 2.
    side: f64,
}

impl Cause {
    fn new(second: bool, ratio: f64) -> Self {
        let (radius, side) = if second { (ratio, -1.0) } else { (1.0, 1.0) };
        Self {
            second,
            radius,
            side,
        }
    }

    /// `F1 + F2` and `F1 - F2` of forces along `t`.
    fn forces(&self, by: SelfOther) -> [f64; 2] {
        [
            self.radius * by.sum,
            self.side * self.radius * by.difference,
        ]
    }

    /// The same along `d` or `d x t`.
    fn turned_forces(&self, by: SelfOther) -> [f64; 2] {
        [
            self.side * self.radius * by.sum,
            self.radius * by.difference,
        ]
    }

    /// The torques on the two, times `sign`.
    fn torques(&self, sign: f64, by: SelfOther) -> [f64; 2] {
        let scale = sign * (self.radius * self.radius);
        let (own, other) = (scale * by.own(), scale * by.other());
        if self.second {
            [other, own]
        } else {
            [own, other]
        }
    }
}

/// The coefficients of `set` for each squirmer by the balance of `loads`, of spheres whose radii are in the given `ratio`.
///
/// ```
/// use scene::{ActiveLoads, Gap, LoadSet, balance, mobility::MobilitySet};
/// // A lone sphere of radius 2 moves by a force at F/(12 pi mu a).
/// let set = MobilitySet { loads: LoadSet::all(1), torque: true };
/// let loads = [ActiveLoads::isolated(set.loads); 2];
/// let mobility = balance::of_each(Gap::new(1e6)?, 2.0, &loads, set);
/// assert!((mobility.mean_axial_by_repulsion - 0.5 * (1.0 / 12.0 - 1.0 / 6.0)).abs() < 1e-15);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[must_use]
pub fn of_each(gap: Gap, ratio: f64, loads: &[ActiveLoads; 2], set: MobilitySet) -> MobilityOfEach {
    let axial = Axial::new(gap, loads.each_ref().map(|of| of.pair.xa), ratio);
    let transverse = (set.loads.transverse.any()).then(|| Transverse::new(gap, loads, ratio));
    let about = set
        .loads
        .twist
        .then(|| About::new(loads.each_ref().map(|of| of.pair.xc), ratio));
    let across = |[sum, difference]: [f64; 2], torques: [f64; 2]| {
        let transverse = transverse.as_ref();
        transverse.map_or(Across::default(), |transverse| {
            transverse.by(sum, difference, torques)
        })
    };
    let mut mobility = MobilityOfEach::default();
    for (k, (of, by)) in loads.iter().zip(&mut mobility.by).enumerate() {
        let cause = Cause::new(k == 1, ratio);
        let Mobility { pair, modes, swirl } = by;
        for (of_mode, mode) in modes.iter_mut().zip(of.pair.modes()) {
            let [sum, difference] = cause.turned_forces(mode.xf);
            let [opening, mean_axial] = axial.by(sum, difference);
            *of_mode = ModeMobility {
                opening,
                mean_axial,
                across: across(cause.forces(mode.yf), cause.torques(cause.side, mode.yt)),
            };
        }
        for (of_mode, mode) in swirl.iter_mut().zip(of.swirl.modes()) {
            let spin = cause.torques(cause.side, mode.xtc);
            *of_mode = SwirlMobility {
                twist: about
                    .as_ref()
                    .map_or(Twist::default(), |about| about.by(spin)),
                // Torques along t are -d x t in the form T x d.
                across: across(cause.turned_forces(mode.yfc), cause.torques(-1.0, mode.ytc)),
            };
        }
        let unit = |active: usize| if active == k { 1.0 } else { 0.0 };
        if let Some(transverse) = transverse.as_ref().filter(|_| set.torque) {
            pair.torque = transverse.by(0.0, 0.0, [unit(0), unit(1)]);
        }
        if let Some(about) = &about {
            pair.twist = about.by([unit(0), unit(1)]);
        }
    }
    let [opening, drift] = axial.by(0.0, -2.0);
    mobility.by[0].pair.repulsion = opening;
    mobility.mean_axial_by_repulsion = drift;
    mobility
}

#[cfg(test)]
mod tests {
    use super::super::tests::{
        HEADINGS, REPULSION, TORQUE, assert_balanced, exerted, made_up, squirmers,
    };
    use super::*;
    use crate::balance::{solve, solve_swirl_into};
    use crate::mobility::{
        External, PairVelocity, add_swirl, add_swirl_of_each, pair_velocity, velocity_of_each,
    };
    use crate::{LoadSet, SwirlLoads};
    use approx::assert_relative_eq;

    /// Made-up loads of both spheres that obey reciprocity, which the balance reads one half of.
    fn reciprocal(set: LoadSet, ratio: f64) -> [ActiveLoads; 2] {
        let (area, volume) = (ratio * ratio, ratio * ratio * ratio);
        let mut one = ActiveLoads::of_equal(made_up(set, 2.7), SwirlLoads::zero(set));
        let mut two = ActiveLoads::of_equal(made_up(set, 1.9), SwirlLoads::zero(set));
        two.pair.yb = SelfOther::new(-0.3, 0.23);
        let other = |own: SelfOther, value: f64| SelfOther::new(own.own(), value);
        two.pair.xa = other(two.pair.xa, one.pair.xa.other() / ratio);
        two.pair.ya = other(two.pair.ya, one.pair.ya.other() / ratio);
        two.pair.xc = other(two.pair.xc, one.pair.xc.other() / volume);
        two.pair.yc = other(two.pair.yc, one.pair.yc.other() / volume);
        one.torque_on_other = -area * two.pair.yb.other();
        two.torque_on_other = -one.pair.yb.other() / area;
        [one, two]
    }

    #[test]
    fn val_forces_and_torques_on_spheres_of_unlike_radii_cancel() {
        for ratio in [0.6, 2.5] {
            let set = MobilitySet {
                loads: LoadSet::planar(3),
                torque: true,
            };
            let loads = reciprocal(set.loads, ratio);
            let gap = Gap::new(0.37).unwrap();
            let squirmers = squirmers();
            let external = External {
                repulsion: REPULSION,
                torque: Some(TORQUE),
            };
            let mobility = of_each(gap, ratio, &loads, set);
            let v = velocity_of_each(&mobility, 3, &squirmers, &HEADINGS, &external);
            let motion = |side: f64, k: usize| {
                let distance = gap.distance_at_ratio(ratio);
                let (apart, around) = (v.opening * gap.eps(), v.turning * distance);
                let u = [
                    v.mean_axial - 0.5 * side * apart,
                    v.mean_transverse - 0.5 * side * around,
                ];
                (u, v.spin[k])
            };
            let [one, two] = HEADINGS;
            let [of_one, of_two] = &loads;
            let by_one = exerted((of_one, 1.0), 1.0, motion(1.0, 0), &squirmers[0], &one);
            let by_two = exerted((of_two, ratio), -1.0, motion(-1.0, 1), &squirmers[1], &two);
            assert_balanced(by_one, by_two);
        }
    }

    #[test]
    fn equal_radii_have_the_coefficients_of_sums_and_differences() {
        let set = MobilitySet {
            loads: LoadSet::all(3).with_swirl(2),
            torque: true,
        };
        let gap = Gap::new(0.37).unwrap();
        let pair = made_up(set.loads, 2.7);
        let columns: Vec<f64> = (0..12).map(|k| (1.3 * f64::from(k)).cos()).collect();
        let swirl = SwirlLoads::from_columns(set.loads, &columns);
        let mut whole = solve(gap, &pair, set);
        solve_swirl_into(gap, (&pair, &swirl), set, &mut whole.swirl);
        let each = of_each(gap, 1.0, &[ActiveLoads::of_equal(pair, swirl); 2], set);
        // By the causes of squirmer 1 alone and of squirmer 2 alone; those of the second have signs in the differences.
        let [one, two] = each.by.each_ref().map(|by| by.named(set));
        for (((name, value), (_, of_one)), (_, of_two)) in
            whole.named(set).into_iter().zip(one).zip(two)
        {
            assert_relative_eq!(value, of_one, epsilon = 1e-13);
            let sign = if name.contains(" by f") {
                0.0
            } else if name
                .split(" by ")
                .nth(1)
                .is_some_and(|cause| cause.contains('-'))
            {
                -1.0
            } else {
                1.0
            };
            assert_relative_eq!(sign * value, of_two, epsilon = 1e-13);
        }
        assert_relative_eq!(each.mean_axial_by_repulsion, 0.0);
        // And so are velocities, with swirl: squirmer 1 alone spins the two by one coefficient, both by two.
        let squirmers = [[0.3, -1.2], [0.7, 0.4]].map(|c| squirmers()[0].with_swirl(&c).unwrap());
        let external = External {
            repulsion: REPULSION,
            torque: Some(TORQUE),
        };
        let turned = HEADINGS.map(|heading| 0.7 * heading.transverse);
        let by = (&whole.pair, &whole.modes[..3]);
        let mut v = pair_velocity(by, &squirmers, &HEADINGS, &external);
        let axial = add_swirl(&mut v, &whole.swirl[..2], &squirmers, (&HEADINGS, &turned));
        let mut w = velocity_of_each(&each, 3, &squirmers, &HEADINGS, &external);
        let axial_of_each = add_swirl_of_each(&mut w, &each, &squirmers, (&HEADINGS, &turned));
        let numbers = |v: PairVelocity<f64>, [a, b]: [f64; 2]| {
            let [one, two] = v.spin;
            [
                v.opening,
                v.mean_axial,
                v.mean_transverse,
                v.turning,
                one,
                two,
                a,
                b,
            ]
        };
        for (a, b) in numbers(v, axial).into_iter().zip(numbers(w, axial_of_each)) {
            assert_relative_eq!(a, b, epsilon = 1e-12);
        }
    }

    #[test]
    fn velocity_at_contact_keeps_its_digits() {
        // Rigid spheres in a straining flow of their own slip: the singular parts cancel in the mean velocity.
        let set = MobilitySet {
            loads: LoadSet::planar(2),
            torque: false,
        };
        let at = |eps: f64| {
            let gap = Gap::new(eps).unwrap();
            let mut loads = crate::singular::of_each(gap, 2.0, set.loads, 3.0);
            for of in &mut loads {
                of.pair += &ActiveLoads::isolated(set.loads).pair;
            }
            of_each(gap, 2.0, &loads, set)
        };
        // Both are carried along by the thrust of one against the drag on both, 6 (1 + 2).
        let axial = at(1e-250).by[0].modes[0].mean_axial;
        assert_relative_eq!(axial, 4.0 / 18.0, epsilon = 1e-12);
        let across = |eps: f64| at(eps).by[0].modes[0].across;
        // One over the logarithm is what is left to change, smoothly.
        let [a, b, c] = [1e-60, 1e-120, 1e-240].map(|eps| across(eps).mean_transverse);
        assert!(((a - b) / (b - c) - 2.0).abs() < 0.1, "{a} {b} {c}");
    }
}
