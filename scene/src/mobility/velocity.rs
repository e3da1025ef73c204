//! From causes and coefficients to the velocity of a pair.

use std::ops::{Add, Mul, Sub};

use nalgebra::Vector3;

use super::{Across, ModeMobility, PairMobility, SwirlMobility};
use crate::{Squirmer, legendre};

/// A quantity perpendicular to `d`: a number in planar motion, a vector in three dimensions.
pub trait Transverse:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
}

impl Transverse for f64 {}

impl Transverse for Vector3<f64> {}

/// A squirmer's orientation in the pair frame.
#[derive(Clone, Copy, Debug)]
pub struct Heading<T> {
    /// `p . d_k`, where `d_k` points from this squirmer to the other one.
    pub cosine: f64,
    /// The part of `p` perpendicular to `d`, in axes common to both squirmers.
    pub transverse: T,
}

impl Heading<Vector3<f64>> {
    /// Of both squirmers, by the unit vector from the first centre to the second and their unit orientations.
    #[inline]
    #[must_use]
    pub fn of_both(line: &Vector3<f64>, orientations: [Vector3<f64>; 2]) -> [Self; 2] {
        let [along, against] = orientations.map(|p| {
            let cosine = p.dot(line);
            Self {
                cosine,
                transverse: p - line * cosine,
            }
        });
        [
            along,
            Self {
                cosine: -against.cosine,
                ..against
            },
        ]
    }

    /// The transverse heading turned by a quarter about the line of centres, `d x v`.
    #[inline]
    #[must_use]
    pub fn turned(&self, line: &Vector3<f64>) -> Vector3<f64> {
        line.cross(&self.transverse)
    }
}

/// Loads of other than hydrodynamic origin.
#[derive(Clone, Copy, Debug)]
pub struct External<T> {
    /// Repulsive force that drives the two apart, per `pi mu a`.
    pub repulsion: f64,
    /// Torques as `T x d`, per `pi mu a^2`.
    pub torque: Option<[T; 2]>,
}

/// How a pair moves at one instant. Velocities are in units of length over time with `a = 1`.
#[derive(Clone, Copy, Debug)]
pub struct PairVelocity<T> {
    /// `d(ln eps)/dt`.
    pub opening: f64,
    /// Mean velocity of the two along `d`.
    pub mean_axial: f64,
    /// Mean velocity of the two across `d`.
    pub mean_transverse: T,
    /// `d(d)/dt`, the rate at which the line of centres turns.
    pub turning: T,
    /// `omega_k x d` of each squirmer.
    pub spin: [T; 2],
}

/// Motion across `d`, summed over the causes.
#[derive(Clone, Copy)]
struct Motion<T> {
    mean_transverse: T,
    counter_spin: T,
    turning: T,
    mean_spin: T,
}

impl<T: Transverse> Motion<T> {
    /// By a cause, as the combinations over the two that move them alike and oppositely.
    #[inline(always)]
    fn by(coefficients: &Across, alike: T, opposite: T) -> Self {
        Self {
            mean_transverse: alike * coefficients.mean_transverse,
            counter_spin: alike * coefficients.counter_spin,
            turning: opposite * coefficients.turning,
            mean_spin: opposite * coefficients.mean_spin,
        }
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self {
            mean_transverse: self.mean_transverse + other.mean_transverse,
            counter_spin: self.counter_spin + other.counter_spin,
            turning: self.turning + other.turning,
            mean_spin: self.mean_spin + other.mean_spin,
        }
    }

    #[inline(always)]
    fn spin(&self) -> [T; 2] {
        [
            self.mean_spin + self.counter_spin,
            self.mean_spin - self.counter_spin,
        ]
    }
}

/// Velocities of a pair of squirmers, which are free but for `external`, by the coefficients of the squirming modes from the first
/// on; `headings` in the pair frame.
///
/// ```
/// use scene::{Gap, Hydrodynamics, Isolated, LoadSet, Squirmer};
/// use scene::mobility::{External, Heading, MobilitySet, pair_velocity};
/// // Far apart, a squirmer that points at the other one swims at V_s = 2 B_1/3.
/// let squirmers = [Squirmer::with_beta(1.0, 5.0)?, Squirmer::new(&[])?];
/// let ahead = Heading { cosine: 1.0, transverse: 0.0 };
/// let external = External { repulsion: 0.0, torque: None };
/// let far = Gap::new(1e6)?;
/// let set = MobilitySet { loads: LoadSet::planar(2), torque: false };
/// let mobility = Isolated::EQUAL.mobility(far, set)?;
/// let by = (&mobility.pair, &mobility.modes[..2]);
/// let v = pair_velocity(by, &squirmers, &[ahead, ahead], &external);
/// assert!((v.mean_axial - 0.5).abs() < 1e-15);
/// assert!((v.opening * far.eps() + 1.0).abs() < 1e-15);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[inline(always)]
pub fn pair_velocity<T: Transverse>(
    (pair, modes): (&PairMobility, &[ModeMobility]),
    squirmers: &[Squirmer; 2],
    headings: &[Heading<T>; 2],
    external: &External<T>,
) -> PairVelocity<T> {
    let [one, two] = headings;
    // Nothing is added where there is nothing: the compiler sees which effects are absent.
    let mut opening = pair.repulsion * external.repulsion;
    let mut mean_axial = 0.0;
    let mut across: Option<Motion<T>> =
        (external.torque).map(|[t1, t2]| Motion::by(&pair.torque, t1 - t2, t1 + t2));
    let orders = legendre(one.cosine).zip(legendre(two.cosine));
    for ((n, mode), (of_one, of_two)) in modes.iter().enumerate().zip(orders) {
        let [b1, b2] = [squirmers[0].mode(n), squirmers[1].mode(n)];
        let (q1, q2) = (b1 * of_one.p, b2 * of_two.p);
        opening += (q1 + q2) * mode.opening;
        mean_axial += (q1 - q2) * mode.mean_axial;
        let (s1, s2) = (
            one.transverse * (b1 * of_one.w),
            two.transverse * (b2 * of_two.w),
        );
        let by_slip = Motion::by(&mode.across, s1 + s2, s1 - s2);
        across = Some(across.map_or(by_slip, |across| across.and(by_slip)));
    }
    let across = across.unwrap_or_else(|| {
        let nothing = one.transverse * 0.0;
        Motion::by(&Across::default(), nothing, nothing)
    });
    PairVelocity {
        opening,
        mean_axial,
        mean_transverse: across.mean_transverse,
        turning: across.turning,
        spin: across.spin(),
    }
}

/// How one squirmer of a planar pair is the image of the other, which is identical but for this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Image {
    /// Turned by pi about the midpoint: opposite transverse headings.
    Point,
    /// In the mirror between the two: the same headings.
    Mirror,
}

/// [`pair_velocity`] of a pair that is its own image, with the same bits; `heading` and `squirmer` are those of
/// the first. What cancels between the two is not formed.
#[inline(always)]
pub(crate) fn symmetric_velocity(
    image: Image,
    (pair, modes): (&PairMobility, &[ModeMobility]),
    squirmer: &Squirmer,
    heading: &Heading<f64>,
    external: &External<f64>,
) -> PairVelocity<f64> {
    let opposed = image == Image::Point;
    let part = |across: &Across| {
        if opposed {
            [across.turning, across.mean_spin]
        } else {
            [across.mean_transverse, across.counter_spin]
        }
    };
    let mut opening = pair.repulsion * external.repulsion;
    let torque = |[t1, t2]: [f64; 2]| {
        let both = if opposed { t1 + t2 } else { t1 - t2 };
        part(&pair.torque).map(|by_torque| both * by_torque)
    };
    let mut across: Option<[f64; 2]> = external.torque.map(torque);
    for ((n, mode), order) in modes.iter().enumerate().zip(legendre(heading.cosine)) {
        let b = squirmer.mode(n);
        opening += 2.0 * (b * order.p) * mode.opening;
        let both = 2.0 * (heading.transverse * (b * order.w));
        let by_slip = part(&mode.across).map(|by_slip| both * by_slip);
        across = Some(across.map_or(by_slip, |[a, b]| [a + by_slip[0], b + by_slip[1]]));
    }
    let [speed, spin] = across.unwrap_or_default();
    PairVelocity {
        opening,
        mean_axial: 0.0,
        mean_transverse: if opposed { 0.0 } else { speed },
        turning: if opposed { speed } else { 0.0 },
        spin: [spin, if opposed { spin } else { -spin }],
    }
}

/// Adds the motion across `d` by swirl, and returns the spin of each squirmer about `d` by it; `turned` are the transverse headings
/// turned by a quarter, `d x v`.
#[inline]
pub fn add_swirl<T: Transverse>(
    velocity: &mut PairVelocity<T>,
    mobility: &[SwirlMobility],
    squirmers: &[Squirmer; 2],
    (headings, turned): (&[Heading<T>; 2], &[T; 2]),
) -> [f64; 2] {
    let [one, two] = [squirmers[0].swirl(), squirmers[1].swirl()];
    let strength = |of: &[f64], n: usize| of.get(n).copied().unwrap_or(0.0);
    let orders = legendre(headings[0].cosine).zip(legendre(headings[1].cosine));
    let modes = mobility.iter().enumerate().take(one.len().max(two.len()));
    let mut axial = [0.0; 2];
    for ((n, of_mode), (of_one, of_two)) in modes.zip(orders) {
        let (c1, c2) = (strength(one, n), strength(two, n));
        let (r1, r2) = (turned[0] * (c1 * of_one.w), turned[1] * (c2 * of_two.w));
        let across = Motion::by(&of_mode.across, r1 - r2, r1 + r2);
        velocity.mean_transverse = velocity.mean_transverse + across.mean_transverse;
        velocity.turning = velocity.turning + across.turning;
        let (q1, q2) = (c1 * of_one.p, c2 * of_two.p);
        let about = of_mode.twist.spins(q1 - q2, q1 + q2);
        for (k, spin) in across.spin().into_iter().enumerate() {
            velocity.spin[k] = velocity.spin[k] + spin;
            axial[k] += about[k];
        }
    }
    axial
}

#[cfg(test)]
mod tests {
    use super::super::Twist;
    use super::*;

    fn across(of: f64) -> Across {
        Across {
            mean_transverse: 0.3 + of,
            counter_spin: -0.7 * of,
            turning: 1.1 - of,
            mean_spin: 0.2 + 0.4 * of,
        }
    }

    #[test]
    fn pairs_that_are_their_own_image_move_as_any_pair_to_the_last_bit() {
        let squirmer = Squirmer::new(&[1.5, -2.3, 0.8]).unwrap();
        let pair = PairMobility {
            repulsion: 0.66,
            torque: across(0.9),
            twist: Twist::default(),
        };
        let modes = [0.1, 0.37, -1.3].map(|of| ModeMobility {
            opening: -2.0 + of,
            mean_axial: 0.3 * of,
            across: across(of),
        });
        for (image, side) in [(Image::Point, -1.0), (Image::Mirror, 1.0)] {
            for angle in [0.4_f64, 1.9, -2.6] {
                let (transverse, cosine) = angle.sin_cos();
                let one = Heading { cosine, transverse };
                let two = Heading {
                    transverse: side * transverse,
                    ..one
                };
                for torque in [None, Some([0.8, -side * 0.8])] {
                    let external = External {
                        repulsion: 0.31,
                        torque,
                    };
                    let by = (&pair, &modes[..]);
                    let whole = pair_velocity(by, &[squirmer; 2], &[one, two], &external);
                    let half = symmetric_velocity(image, by, &squirmer, &one, &external);
                    let numbers = |v: PairVelocity<f64>| {
                        let [w1, w2] = v.spin;
                        [
                            v.opening,
                            v.mean_axial,
                            v.mean_transverse,
                            v.turning,
                            w1,
                            w2,
                        ]
                    };
                    // A zero may have either sign.
                    let bits = |v| numbers(v).map(|number| (number + 0.0).to_bits());
                    assert_eq!(bits(whole), bits(half), "{image:?} {angle}");
                }
            }
        }
    }
}
