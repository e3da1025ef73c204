//! From loads to mobilities: the force and torque balance of a pair of free spheres, in closed form.
//!
//! In sums and differences over the two spheres the resistance problem falls apart into one
//! equation for each axial motion and a 2 x 2 system for each transverse parity. With the common
//! axis `d` from sphere 1 to sphere 2, transverse forces `F`, transverse torques as `T x d` and
//! spins as `w = omega x d`, all per `pi mu a` (torques per `pi mu a^2`):
//!
//! ```text
//! 6 (X11A +- X12A) (U1 +- U2) = F1 +- F2                                       (axial)
//! [  6 (Y11A +- Y12A)  -4 (Y11B +- Y12B) ] [ U1 +- U2 ]   [ F1 +- F2 ]
//! [ -4 (Y11B +- Y12B)   8 (Y11C -+ Y12C) ] [ w1 -+ w2 ] = [ T1 -+ T2 ]         (transverse)
//! ```
//!
//! The coefficients of [`crate::mobility`] are its solutions for one cause after the other. All of it is inlined whatever its
//! size, so that the compiler sees which of them are read.
//!
//! No pivoting is needed. The equations
//! follow from the definitions in [`crate::loads`] with `d -> -d` for sphere 2.

mod of_each;

pub use of_each::of_each;

use crate::mobility::{
    Across, Mobility, MobilitySet, ModeMobility, PairMobility, SwirlMobility, Twist,
};
use crate::{Gap, ModeLoads, PairLoads, Parities, SelfOther, SwirlLoads};

/// The inverse of `[6a, -4b; -4b, 8c]`: `[U by F, U by T = w by F, w by T]`.
#[inline(always)]
fn inverse(a: f64, b: f64, c: f64) -> [f64; 3] {
    let inverse = 1.0 / (48.0 * a * c - 16.0 * b * b);
    [8.0 * c * inverse, 4.0 * b * inverse, 6.0 * a * inverse]
}

/// The transverse part of the balance, solved for a unit force and a unit torque on the pair.
#[derive(Clone, Copy)]
struct Transverse {
    /// Half of the motion `U1 + U2`, `w1 - w2`: means and half differences.
    alike: [f64; 3],
    /// Of the motion `U1 - U2`, `w1 + w2`: turning, and half of the spin.
    turning: [f64; 2],
    mean_spin: [f64; 2],
}

impl Transverse {
    #[inline(always)]
    fn new(gap: Gap, [_, ya, yb, _, yc]: [SelfOther; 5], set: MobilitySet) -> Self {
        let Parities {
            sum: even,
            difference: odd,
        } = set.loads.transverse;
        let half = |solved: [f64; 3]| solved.map(|of| 0.5 * of);
        let alike = if even {
            half(inverse(ya.sum, yb.sum, yc.difference))
        } else {
            [0.0; 3]
        };
        if !odd {
            return Self {
                alike,
                turning: [0.0; 2],
                mean_spin: [0.0; 2],
            };
        }
        let [by_force, crossed, by_torque] = inverse(ya.difference, yb.difference, yc.sum);
        // d(d)/dt is the difference of the velocities, of 2 from 1, over the distance.
        let rate = -1.0 / gap.distance();
        Self {
            alike,
            turning: [by_force * rate, crossed * rate],
            mean_spin: [0.5 * crossed, 0.5 * by_torque],
        }
    }

    /// By forces and torques: `F1 + F2` and `T1 - T2` of a cause that moves the two alike, `F1 - F2` and `T1 + T2` of one that moves them
    /// oppositely.
    #[inline(always)]
    fn by(&self, alike: [f64; 2], opposite: [f64; 2]) -> Across {
        let [by_force, crossed, by_torque] = self.alike;
        Across {
            mean_transverse: by_force * alike[0] + crossed * alike[1],
            counter_spin: crossed * alike[0] + by_torque * alike[1],
            turning: self.turning[0] * opposite[0] + self.turning[1] * opposite[1],
            mean_spin: self.mean_spin[0] * opposite[0] + self.mean_spin[1] * opposite[1],
        }
    }
}

/// The coefficients of `set`, but for those by swirl, by the balance of `loads`, which must hold those of the set.
///
/// ```
/// use scene::{Gap, LoadSet, PairLoads, balance, mobility::MobilitySet};
/// // A lone sphere moves by a force at F/(6 pi mu a): two that are driven apart by 1/(3 pi mu a).
/// let set = MobilitySet { loads: LoadSet::all(1), torque: true };
/// let mobility = balance::solve(Gap::new(1e6)?, &PairLoads::isolated(set.loads), set);
/// assert!((mobility.pair.repulsion * 1e6 - 1.0 / 3.0).abs() < 1e-15);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[inline]
#[must_use]
pub fn solve(gap: Gap, loads: &PairLoads, set: MobilitySet) -> Mobility {
    let mut mobility = Mobility::default();
    let Mobility { pair, modes, .. } = &mut mobility;
    solve_into(gap, loads, set, (pair, modes));
    mobility
}

/// [`solve`], to be filled in, with room for the modes of the set.
#[inline(always)]
pub fn solve_into(
    gap: Gap,
    loads: &PairLoads,
    set: MobilitySet,
    into: (&mut PairMobility, &mut [ModeMobility]),
) {
    let rigid = [loads.xa, loads.ya, loads.yb, loads.xc, loads.yc];
    solve_parts(gap, (rigid, |n| loads.mode(n)), set, into);
}

/// The same from the resistance scalars `[xa, ya, yb, xc, yc]` and the loads by each squirming mode, counted from 0: for a closed form, whose
/// loads need not be put together first.
#[inline(always)]
pub fn solve_parts(
    gap: Gap,
    (rigid, mode_loads): ([SelfOther; 5], impl Fn(usize) -> ModeLoads),
    set: MobilitySet,
    (pair, modes): (&mut PairMobility, &mut [ModeMobility]),
) {
    let [xa, _, _, xc, _] = rigid;
    let Parities {
        sum: drifts,
        difference: opens,
    } = set.loads.axial;
    // Near contact X11A - X12A goes as 1/(2 eps), so this product is of order one.
    let opening = if opens {
        -1.0 / (6.0 * (xa.difference * gap.eps()))
    } else {
        0.0
    };
    let mean_axial = if drifts { 1.0 / (12.0 * xa.sum) } else { 0.0 };
    pair.repulsion = -2.0 * opening;
    let transverse = Transverse::new(gap, rigid, set);
    for (n, of_mode) in modes.iter_mut().enumerate().take(set.loads.modes) {
        let mode = mode_loads(n);
        *of_mode = ModeMobility {
            opening: mode.xf.difference * opening,
            mean_axial: mode.xf.sum * mean_axial,
            across: transverse.by(
                [mode.yf.sum, mode.yt.difference],
                [mode.yf.difference, mode.yt.sum],
            ),
        };
    }
    if set.torque {
        pair.torque = transverse.by([0.0, 1.0], [0.0, 1.0]);
    }
    if set.loads.twist {
        pair.twist = Twist {
            mean: 1.0 / (16.0 * xc.sum),
            half_difference: 1.0 / (16.0 * xc.difference),
        };
    }
}

/// Fills in the coefficients by the swirl modes of `set`. Of the loads those of rigid motion are read, with rotation about `d`.
#[inline]
pub fn solve_swirl_into(
    gap: Gap,
    (loads, swirl): (&PairLoads, &SwirlLoads),
    set: MobilitySet,
    mobility: &mut [SwirlMobility],
) {
    let rigid = [loads.xa, loads.ya, loads.yb, loads.xc, loads.yc];
    let transverse = Transverse::new(gap, rigid, set);
    let twist = [loads.xc.sum, loads.xc.difference].map(|drag| 1.0 / (16.0 * drag));
    for (of_mode, mode) in mobility.iter_mut().zip(swirl.modes()) {
        *of_mode = SwirlMobility {
            twist: Twist {
                mean: mode.xtc.sum * twist[0],
                half_difference: mode.xtc.difference * twist[1],
            },
            // Forces are along d x t; torques along t are -d x t in the form T x d.
            across: transverse.by(
                [mode.yfc.sum, -mode.ytc.difference],
                [mode.yfc.difference, -mode.ytc.sum],
            ),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mobility::{External, Heading, pair_velocity};
    use crate::{ActiveLoads, LoadSet, Squirmer, legendre};
    use approx::assert_relative_eq;

    /// Loads that no fluid has, all different.
    pub(super) fn made_up(set: LoadSet, seed: f64) -> PairLoads {
        let columns: Vec<f64> = (0..set.column_count())
            .map(|k| 1.0 + 0.3 * (seed * k as f64).sin() + if k < 10 { 2.0 } else { 0.0 })
            .collect();
        let mut loads = PairLoads::from_columns(set, set, &columns);
        loads.yb = SelfOther::new(-0.4, 0.1);
        loads
    }

    /// Forces along x and y and torque along z on both spheres, per `pi mu`, by the definitions in [`crate::loads`] and
    /// [`ActiveLoads`] for one sphere that moves or squirms, with the direction to the other one along `side` x.
    pub(super) fn exerted(
        (loads, a): (&ActiveLoads, f64),
        side: f64,
        ([ux, uy], spin): ([f64; 2], f64),
        squirmer: &Squirmer,
        heading: &Heading<f64>,
    ) -> [[f64; 3]; 2] {
        let (along, about) = (side * ux, side * spin * a);
        let pair = &loads.pair;
        let of = |own: bool| {
            let pick = |s: SelfOther| if own { s.own() } else { s.other() };
            let by_translation = if own {
                pair.yb.own()
            } else {
                loads.torque_on_other
            };
            let mut fd = -6.0 * pick(pair.xa) * along;
            let mut ft = -6.0 * pick(pair.ya) * uy + 4.0 * pick(pair.yb) * about;
            let mut t = 4.0 * by_translation * uy - 8.0 * pick(pair.yc) * about;
            for ((n, order), mode) in legendre(heading.cosine).enumerate().zip(pair.modes()) {
                let b = squirmer.mode(n);
                let across = b * order.w * heading.transverse;
                fd += b * order.p * pick(mode.xf);
                ft += across * pick(mode.yf);
                t += across * pick(mode.yt);
            }
            [side * fd * a, ft * a, side * t * a * a]
        };
        [of(true), of(false)]
    }

    pub(super) const HEADINGS: [Heading<f64>; 2] = [
        Heading {
            cosine: 0.6,
            transverse: 0.8,
        },
        Heading {
            cosine: -0.28,
            transverse: 0.96,
        },
    ];
    pub(super) const REPULSION: f64 = 0.9;
    pub(super) const TORQUE: [f64; 2] = [0.31, -1.7];

    pub(super) fn squirmers() -> [Squirmer; 2] {
        [[1.5, -2.0, 0.7], [0.4, 3.0, -1.1]].map(|b| Squirmer::new(&b).unwrap())
    }

    /// That what `by_one` and `by_two` exert on both spheres cancels repulsion and torques.
    pub(super) fn assert_balanced(by_one: [[f64; 3]; 2], by_two: [[f64; 3]; 2]) {
        let added = [[-REPULSION, 0.0, TORQUE[0]], [REPULSION, 0.0, TORQUE[1]]];
        for i in 0..3 {
            assert_relative_eq!(by_one[0][i] + by_two[1][i], -added[0][i], epsilon = 1e-12);
            assert_relative_eq!(by_one[1][i] + by_two[0][i], -added[1][i], epsilon = 1e-12);
        }
    }

    #[test]
    fn val_forces_and_torques_on_each_sphere_cancel() {
        let loads = made_up(LoadSet::planar(3), 2.7);
        let squirmers = squirmers();
        let set = MobilitySet {
            loads: loads.set(),
            torque: true,
        };
        let gap = Gap::new(0.37).unwrap();
        let Mobility { pair, modes, .. } = solve(gap, &loads, set);
        let external = External {
            repulsion: REPULSION,
            torque: Some(TORQUE),
        };
        let v = pair_velocity((&pair, &modes[..3]), &squirmers, &HEADINGS, &external);
        let motion = |side: f64, k: usize| {
            let (apart, around) = (v.opening * gap.eps(), v.turning * gap.distance());
            let u = [
                v.mean_axial - 0.5 * side * apart,
                v.mean_transverse - 0.5 * side * around,
            ];
            (u, v.spin[k])
        };
        let [one, two] = HEADINGS;
        let loads = (
            &ActiveLoads::of_equal(loads, SwirlLoads::zero(set.loads)),
            1.0,
        );
        let by_one = exerted(loads, 1.0, motion(1.0, 0), &squirmers[0], &one);
        let by_two = exerted(loads, -1.0, motion(-1.0, 1), &squirmers[1], &two);
        assert_balanced(by_one, by_two);
    }
}
