//! The velocities that a mesh's lone squirmers lack.
//!
//! A squirmer that is held still exerts by each mode a force and a torque; free of both, it moves at the velocity U and the
//! spin w at which drag balances them,
//!
//! ```text
//! XF = 6 XA U,   (YF, YT) = (6 YA U - 4 YB w, -4 YB U + 8 YC w),   XTC = 8 XC w.
//! ```
//!
//! On a mesh they are a little off those of the closed form. The rigid motion that is missing, added to the slip of the mode,
//! makes up for it, and leaves the squirmer free of force and torque on that mesh: else the flow far away would be that of a force,
//! which falls as `1/r` and turns the other one by more than the stresslet does.

use scene::{MAX_MODES, PairLoads, SelfOther, SwirlLoads};

/// Missing velocity and spin of a mode, for the two combinations of the spheres that are solved for apart.
type Motion = [SelfOther; 2];

/// Missing motions of a lone squirmer, mode by mode, per strength of the mode: along the line of centres, and across it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Missing {
    along: [SelfOther; MAX_MODES],
    across: [Motion; MAX_MODES],
    swirl_along: [SelfOther; MAX_MODES],
    swirl_across: [Motion; MAX_MODES],
}

impl Missing {
    /// Of a mesh on which two spheres infinitely far apart have these loads.
    pub fn of(loads: &PairLoads, swirl: &SwirlLoads) -> Self {
        let isolated = PairLoads::isolated(loads.set());
        let lone = SwirlLoads::isolated(loads.set());
        let mut missing = Self::default();
        for (n, (found, truth)) in loads.modes().iter().zip(isolated.modes()).enumerate() {
            missing.along[n] = less(
                quotient(truth.xf, isolated.xa, 6.0),
                quotient(found.xf, loads.xa, 6.0),
            );
            missing.across[n] = less_motion(
                free(&isolated, truth.yf, truth.yt),
                free(loads, found.yf, found.yt),
            );
        }
        for (n, (found, truth)) in swirl.modes().iter().zip(lone.modes()).enumerate() {
            missing.swirl_along[n] = less(
                quotient(truth.xtc, isolated.xc, 8.0),
                quotient(found.xtc, loads.xc, 8.0),
            );
            // Force along d x t and torque along t, which is -d x (d x t).
            missing.swirl_across[n] = less_motion(
                free(&isolated, truth.yfc, times(truth.ytc, -1.0)),
                free(loads, found.yfc, times(found.ytc, -1.0)),
            );
        }
        missing
    }

    /// Adds the loads of the missing motions to those of the slip.
    ///
    /// `crossed` is the torque by translation, as the force by spin is YB; see [`crossed`].
    pub fn add_to(&self, loads: &mut PairLoads, swirl: &mut SwirlLoads, crossed: SelfOther) {
        let rigid = *loads;
        let drag = |motion| drag(&rigid, crossed, motion);
        for (n, mode) in loads.modes_mut().iter_mut().enumerate() {
            mode.xf += times(product(rigid.xa, self.along[n]), 6.0);
            let [force, torque] = drag(self.across[n]);
            mode.yf += force;
            mode.yt += torque;
        }
        for (n, mode) in swirl.modes_mut().iter_mut().enumerate() {
            mode.xtc += times(product(rigid.xc, self.swirl_along[n]), 8.0);
            let [force, torque] = drag(self.swirl_across[n]);
            mode.yfc += force;
            mode.ytc += times(torque, -1.0);
        }
    }
}

/// The motion across the line of centres at which drag balances a force and a torque. The spins of sums go with
/// the velocities of differences.
fn free(rigid: &PairLoads, force: SelfOther, torque: SelfOther) -> Motion {
    let solve = |ya: f64, yb: f64, yc: f64, force: f64, torque: f64| {
        let inverse = 1.0 / (48.0 * ya * yc - 16.0 * yb * yb);
        [
            (8.0 * yc * force + 4.0 * yb * torque) * inverse,
            (4.0 * yb * force + 6.0 * ya * torque) * inverse,
        ]
    };
    let (ya, yb, yc) = (rigid.ya, rigid.yb, rigid.yc);
    let [u, w_crossed] = solve(ya.sum, yb.sum, yc.difference, force.sum, torque.difference);
    let [v, w] = solve(
        ya.difference,
        yb.difference,
        yc.sum,
        force.difference,
        torque.sum,
    );
    [
        SelfOther {
            sum: u,
            difference: v,
        },
        SelfOther {
            sum: w,
            difference: w_crossed,
        },
    ]
}

/// The torque by translation of equal spheres, `YB` of the sphere itself and `-YB` of the other one.
pub(crate) fn crossed(loads: &PairLoads) -> SelfOther {
    SelfOther {
        sum: loads.yb.difference,
        difference: loads.yb.sum,
    }
}

/// The force and the torque that drag balances at a motion across the line of centres.
fn drag(rigid: &PairLoads, crossed: SelfOther, [u, w]: Motion) -> [SelfOther; 2] {
    let (ya, yb, yc) = (rigid.ya, rigid.yb, rigid.yc);
    [
        SelfOther {
            sum: 6.0 * ya.sum * u.sum - 4.0 * yb.sum * w.difference,
            difference: 6.0 * ya.difference * u.difference - 4.0 * yb.difference * w.sum,
        },
        SelfOther {
            sum: 8.0 * yc.sum * w.sum - 4.0 * crossed.sum * u.difference,
            difference: 8.0 * yc.difference * w.difference - 4.0 * crossed.difference * u.sum,
        },
    ]
}

fn product(a: SelfOther, b: SelfOther) -> SelfOther {
    SelfOther {
        sum: a.sum * b.sum,
        difference: a.difference * b.difference,
    }
}

fn quotient(a: SelfOther, b: SelfOther, factor: f64) -> SelfOther {
    SelfOther {
        sum: a.sum / (factor * b.sum),
        difference: a.difference / (factor * b.difference),
    }
}

fn times(a: SelfOther, factor: f64) -> SelfOther {
    SelfOther {
        sum: a.sum * factor,
        difference: a.difference * factor,
    }
}

fn less(a: SelfOther, b: SelfOther) -> SelfOther {
    SelfOther {
        sum: a.sum - b.sum,
        difference: a.difference - b.difference,
    }
}

fn less_motion([u, w]: Motion, [v, x]: Motion) -> Motion {
    [less(u, v), less(w, x)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use scene::LoadSet;

    #[test]
    fn lone_squirmers_with_the_missing_motions_move_as_they_should() {
        let set = LoadSet::all(2).with_swirl(2);
        let (isolated, lone) = (PairLoads::isolated(set), SwirlLoads::isolated(set));
        let off = |a: f64| SelfOther::new(a, 0.0);
        let (mut loads, mut swirl) = (isolated, lone);
        loads.xa += off(1e-3);
        loads.yb += off(-3e-3);
        loads.yc += off(2e-3);
        loads.modes_mut()[0].xf += off(4e-3);
        loads.modes_mut()[1].yf += off(5e-3);
        loads.modes_mut()[1].yt += off(-6e-3);
        swirl.modes_mut()[1].yfc += off(7e-3);
        swirl.modes_mut()[1].ytc += off(8e-3);
        let missing = Missing::of(&loads, &swirl);
        let crossed = crossed(&loads);
        missing.add_to(&mut loads, &mut swirl, crossed);
        let one = quotient(loads.mode(0).xf, loads.xa, 6.0);
        assert_relative_eq!(one.own(), 2.0 / 3.0, epsilon = 1e-14);
        let second = loads.mode(1);
        let turned = swirl.modes()[1];
        for [u, w] in [
            free(&loads, second.yf, second.yt),
            free(&loads, turned.yfc, times(turned.ytc, -1.0)),
        ] {
            for zero in [u.sum, u.difference, w.sum, w.difference] {
                assert_relative_eq!(zero, 0.0, epsilon = 1e-16);
            }
        }
    }
}
