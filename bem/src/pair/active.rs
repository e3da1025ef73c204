//! Loads by the active one of two unlike spheres, from the responses of both to rigid motions of either.
//!
//! Translations have the velocity 1, rotations the velocity 1 at the equator, so that a sphere of radius `a_k` spins at `1/a_k`. With
//! `a_k` of the active sphere for the unit of length, forces on it are those of its density `g_k`, and so are its torques; forces on the other one
//! are `q = a_l/a_k` times those of `g_l`, torques `q²` times. By the reciprocal theorem what slip of the active sphere exerts on the other one is
//! found on the active sphere itself, from the other one's motions: forces as they are, torques q times, since that spins at `1/a_l`.

use std::f64::consts::PI;

use scene::{ActiveLoads, LoadSet, PairLoads, SelfOther, SwirlLoads};

use super::parity::Motion;
use super::response::Response;

/// For either sphere that moves and each of its rigid motions, what it does to either sphere.
pub type Responses = [Vec<[Response; 2]>; 2];

/// The sphere `k` as the one that moves or squirms.
pub struct Active<'a> {
    /// For each kind of motion, in the order of [`Motion::ALL`], if it was solved for.
    pub found: [Option<&'a Responses>; 3],
    /// 0 or 1.
    pub k: usize,
    /// Radius of the other sphere over its own.
    pub q: f64,
}

/// One number of a response.
type Part = fn(&Response) -> f64;

/// A translation, or the rotation that follows it.
#[derive(Clone, Copy)]
enum Rigid {
    Moves,
    Turns,
}

impl Active<'_> {
    /// What the rigid motion of the sphere `moved` does to the sphere `to`.
    fn response(&self, motion: Motion, rigid: Rigid, moved: usize, to: usize) -> Option<&Response> {
        let found = self.found[motion as usize]?;
        let column = match (motion, rigid) {
            (Motion::Transverse, Rigid::Turns) => 1,
            _ => 0,
        };
        Some(&found[moved][column][to])
    }

    /// Loads on both spheres by a rigid motion of this one; see [`scaled`].
    fn by_motion(
        &self,
        before: SelfOther,
        (motion, rigid): (Motion, Rigid),
        part: Part,
        units: (f64, f64),
    ) -> SelfOther {
        let on = |to| self.response(motion, rigid, self.k, to).map(part);
        scaled(before, [on(self.k), on(1 - self.k)], units)
    }

    /// The same by slip of this one, by the reciprocal theorem from what rigid motions of either do to it.
    fn by_reciprocity(
        &self,
        before: SelfOther,
        (motion, rigid): (Motion, Rigid),
        part: impl Fn(&Response) -> f64,
        units: (f64, f64),
    ) -> SelfOther {
        let on = |moved| self.response(motion, rigid, moved, self.k).map(&part);
        scaled(before, [on(self.k), on(1 - self.k)], units)
    }

    /// The loads of a set; those that were not solved for are left as those of lone spheres.
    pub fn loads(&self, set: LoadSet) -> ActiveLoads {
        use Motion::{Axial, Transverse, Twist};
        use Rigid::{Moves, Turns};
        let force: Part = |r| r.force;
        let torque: Part = |r| r.torque;
        let q = self.q;
        // In the mirrored frame z of forces and x, y of torques change sign.
        let mut loads = PairLoads::isolated(set);
        let (forces, torques) = (-6.0 * PI, -8.0 * PI);
        loads.xa = self.by_motion(loads.xa, (Axial, Moves), force, (forces, -q));
        loads.ya = self.by_motion(loads.ya, (Transverse, Moves), force, (forces, q));
        loads.yb = self.by_motion(loads.yb, (Transverse, Turns), force, (4.0 * PI, q));
        loads.yc = self.by_motion(loads.yc, (Transverse, Turns), torque, (torques, -q * q));
        loads.xc = self.by_motion(loads.xc, (Twist, Turns), torque, (torques, q * q));
        // By the reciprocal theorem the force on this one by spin of the other one, as `-YB` is of equal spheres.
        let crossed = (Transverse, Turns);
        let crossed = self.by_reciprocity(SelfOther::default(), crossed, force, (4.0 * PI, -q));
        for (n, mode) in loads.modes_mut().iter_mut().enumerate() {
            let slip = |r: &Response| r.slip[n];
            mode.xf = self.by_reciprocity(mode.xf, (Axial, Moves), slip, (PI, -1.0));
            mode.yf = self.by_reciprocity(mode.yf, (Transverse, Moves), slip, (PI, 1.0));
            mode.yt = self.by_reciprocity(mode.yt, (Transverse, Turns), slip, (PI, -q));
        }
        let mut by_swirl = SwirlLoads::zero(set);
        for (n, mode) in by_swirl.modes_mut().iter_mut().enumerate() {
            let swirl = |r: &Response| r.swirl[n];
            mode.xtc = self.by_reciprocity(mode.xtc, (Twist, Turns), swirl, (PI, q));
            mode.yfc = self.by_reciprocity(mode.yfc, (Transverse, Moves), swirl, (PI, 1.0));
            // Along p_t, which is -y.
            mode.ytc = self.by_reciprocity(mode.ytc, (Transverse, Turns), swirl, (-PI, -q));
        }
        ActiveLoads {
            pair: loads,
            torque_on_other: crossed.other(),
            swirl: by_swirl,
        }
    }
}

/// A load per `unit`, on the other sphere times `scale`: the sign of its mirrored frame and powers of q. `before` if it was not solved for.
fn scaled(before: SelfOther, found: [Option<f64>; 2], (unit, scale): (f64, f64)) -> SelfOther {
    match found {
        [Some(own), Some(other)] => SelfOther::new(own / unit, scale * other / unit),
        _ => before,
    }
}
