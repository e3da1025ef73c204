//! How a pair moves by each cause at one gap: what the equation of motion reads.
//!
//! A cause is a unit of slip of a mode, of repulsion or of torque; an effect is a part of the pair's velocity
//! ([`PairVelocity`]). All velocities are sums of causes times coefficients, so that nothing is left to be solved while a
//! pair moves. [`crate::balance`] finds the coefficients from the loads of a model; a model of mobilities gives them itself.
//!
//! With `d` from sphere 1 to sphere 2, `c_k = p_k . d_k`, `v_k` the part of `p_k` across `d`, for two equal spheres of radius
//! 1 and viscosity 1, the causes come as sums and differences over the two squirmers:
//!
//! ```text
//! along d    q_k = B_n P_n(c_k)           opening by q1 + q2,  mean axial velocity by q1 - q2
//! across d   s_k = B_n W_n(c_k) v_k       mean transverse velocity, counter spin by s1 + s2;  turning, mean spin by s1 - s2
//! swirl      r_k = C_n W_n(c_k) d x v_k   mean transverse velocity, counter spin by r1 - r2;  turning, mean spin by r1 + r2
//! torque     t_k = T_k x d                mean transverse velocity, counter spin by t1 - t2;  turning, mean spin by t1 + t2
//! ```
//!
//! A repulsive force drives the two apart; swirl `C_n P_n(c_k)` and torques about `d` spin them about `d`. Torques are per
//! `pi mu a^2`, the repulsive force per `pi mu a`. The sums and differences keep symmetric scenes symmetric to the last bit, and
//! a pair that is its own image reads half of the coefficients.

mod coefficients;
mod of_each;
mod velocity;

pub use coefficients::{Block, COEFFICIENTS, Coefficient};
pub(crate) use coefficients::{FarScale, Of};
pub use of_each::{MobilityOfEach, add_swirl_of_each, velocity_of_each};
pub(crate) use of_each::{Slip, add_swirl_by, velocity_by};
pub use velocity::{External, Heading, PairVelocity, Transverse, add_swirl, pair_velocity};
pub(crate) use velocity::{Image, symmetric_velocity};

use crate::LoadSet;
use crate::loads::MAX_MODES;

/// Motion across `d` by a cause across `d`. See the [module](self) for the sums and differences that they belong to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Across {
    /// Mean velocity of the two.
    pub mean_transverse: f64,
    /// Half the difference of the spins `omega_k x d`, `(w1 - w2)/2`.
    pub counter_spin: f64,
    /// `d(d)/dt`.
    pub turning: f64,
    /// Mean of the spins, `(w1 + w2)/2`.
    pub mean_spin: f64,
}

/// Motion by the slip of one squirming mode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModeMobility {
    /// `d(ln eps)/dt`, per `q1 + q2`.
    pub opening: f64,
    /// Mean velocity along `d`, per `q1 - q2`.
    pub mean_axial: f64,
    /// By slip across `d`, per `s1 + s2` and `s1 - s2`.
    pub across: Across,
}

/// Motion by the slip of one swirl mode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SwirlMobility {
    /// Spins about `d` by `C_n P_n(c_k)`: the mean per difference over the two, half the difference per sum.
    pub twist: Twist,
    /// By slip across `d`, per `r1 - r2` and `r1 + r2`.
    pub across: Across,
}

/// Spins about `d`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// Mean of the spins of the two.
    pub mean: f64,
    /// Half their difference.
    pub half_difference: f64,
}

/// The coefficients of a pair at one gap by other causes than slip, those of a [`MobilitySet`]; the others are not to be read. See the
/// [module](self) for definitions and signs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairMobility {
    /// `d(ln eps)/dt` per repulsive force.
    pub repulsion: f64,
    /// By torques across `d`, per `t1 - t2` and `t1 + t2`.
    pub torque: Across,
    /// By torques about `d`: the mean per sum, half the difference per difference.
    pub twist: Twist,
}

/// The coefficients of a pair by its swirl modes, the first at 0.
pub type SwirlMobilities = [SwirlMobility; MAX_MODES];

/// All coefficients, those of a [`MobilitySet`]; the others are not to be read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mobility {
    /// Those that belong to no mode.
    pub pair: PairMobility,
    /// By each squirming mode, the first at 0.
    pub modes: [ModeMobility; MAX_MODES],
    /// By each swirl mode.
    pub swirl: SwirlMobilities,
}

/// The coefficients that a caller will read: those by the slip whose loads are in a set, by repulsion, and perhaps by torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MobilitySet {
    /// The loads by whose balance the coefficients follow.
    pub loads: LoadSet,
    /// Whether torques across `d` are among the causes. Those about `d` are if the loads have the twist.
    pub torque: bool,
}

impl Across {
    /// Adds `weight` times another one.
    fn add(&mut self, weight: f64, other: &Self) {
        self.mean_transverse += weight * other.mean_transverse;
        self.counter_spin += weight * other.counter_spin;
        self.turning += weight * other.turning;
        self.mean_spin += weight * other.mean_spin;
    }
}

impl Mobility {
    /// Adds `weight` times the coefficients of `set` of another one.
    fn add(&mut self, weight: f64, other: &Self, set: MobilitySet) {
        let twist = |of: &mut Twist, other: &Twist| {
            of.mean += weight * other.mean;
            of.half_difference += weight * other.half_difference;
        };
        self.pair.repulsion += weight * other.pair.repulsion;
        self.pair.torque.add(weight, &other.pair.torque);
        twist(&mut self.pair.twist, &other.pair.twist);
        let modes = self.modes.iter_mut().zip(&other.modes);
        for (of, other) in modes.take(set.loads.modes) {
            of.opening += weight * other.opening;
            of.mean_axial += weight * other.mean_axial;
            of.across.add(weight, &other.across);
        }
        let swirl = self.swirl.iter_mut().zip(&other.swirl);
        for (of, other) in swirl.take(set.loads.swirl) {
            twist(&mut of.twist, &other.twist);
            of.across.add(weight, &other.across);
        }
    }
}

impl Twist {
    /// The spins of the two about `d` by causes that spin them alike and oppositely.
    #[inline]
    #[must_use]
    pub fn spins(&self, alike: f64, opposite: f64) -> [f64; 2] {
        let (mean, half) = (self.mean * alike, self.half_difference * opposite);
        [mean + half, mean - half]
    }
}
