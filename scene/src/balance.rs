//! Force and torque balance of a pair of free squirmers, in closed form.
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
//! All of it is inlined whatever its size: so the compiler sees which effects are absent, and leaves nothing
//! of them.
//!
//! No pivoting is needed, and a symmetric scene stays symmetric to the last bit. The equations
//! follow from the definitions in [`crate::loads`] with `d -> -d` for sphere 2.

use std::ops::{Add, Mul, Sub};

use crate::{Gap, PairLoads, SelfOther, Squirmer, SwirlLoads, legendre};

/// A quantity perpendicular to `d`: a number in planar motion, a vector in three dimensions.
pub trait Transverse:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
}

impl Transverse for f64 {}

impl Transverse for nalgebra::Vector3<f64> {}

/// A squirmer's orientation in the pair frame.
#[derive(Clone, Copy, Debug)]
pub struct Heading<T> {
    /// `p . d_k`, where `d_k` points from this squirmer to the other one.
    pub cosine: f64,
    /// The part of `p` perpendicular to `d`, in axes common to both squirmers.
    pub transverse: T,
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

/// Squirming loads on the two spheres, as sums and differences (1 + 2 and 1 - 2).
struct Squirming<T> {
    axial: SelfOther,
    force_sum: T,
    force_difference: T,
    torque_sum: T,
    torque_difference: T,
}

#[inline(always)]
fn squirming<T: Transverse>(
    loads: &PairLoads,
    squirmers: &[Squirmer; 2],
    headings: &[Heading<T>; 2],
) -> Squirming<T> {
    let mut axial = SelfOther::default();
    let mut force = [0.0; 4];
    let [one, two] = headings;
    let orders = legendre(one.cosine).zip(legendre(two.cosine));
    // Per unit transverse heading of squirmer 1 and 2: [F+, F-, T+, T-], each a pair.
    let mut second = [0.0; 4];
    for (n, (of_one, of_two)) in (0..loads.set().modes).zip(orders) {
        let mode = loads.mode(n);
        let [b1, b2] = [squirmers[0].mode(n), squirmers[1].mode(n)];
        let (q1, q2) = (b1 * of_one.p, b2 * of_two.p);
        axial.sum += (q1 - q2) * mode.xf.sum;
        axial.difference += (q1 + q2) * mode.xf.difference;
        for (coefficients, strength) in [(&mut force, b1 * of_one.w), (&mut second, b2 * of_two.w)]
        {
            coefficients[0] += strength * mode.yf.sum;
            coefficients[1] += strength * mode.yf.difference;
            coefficients[2] += strength * mode.yt.sum;
            coefficients[3] += strength * mode.yt.difference;
        }
    }
    let [v1, v2] = [one.transverse, two.transverse];
    Squirming {
        axial,
        force_sum: v1 * force[0] + v2 * second[0],
        force_difference: v1 * force[1] - v2 * second[1],
        torque_sum: v1 * force[2] - v2 * second[2],
        torque_difference: v1 * force[3] + v2 * second[3],
    }
}

/// Solution `(U, w)` of `[6a, -4b; -4b, 8c] (U, w) = (force, torque)`.
#[inline(always)]
fn solve_transverse<T: Transverse>(a: f64, b: f64, c: f64, force: T, torque: T) -> (T, T) {
    let inverse = 1.0 / (48.0 * a * c - 16.0 * b * b);
    (
        (force * (8.0 * c) + torque * (4.0 * b)) * inverse,
        (force * (4.0 * b) + torque * (6.0 * a)) * inverse,
    )
}

/// Velocities of the force- and torque-free pair (but for `external`) at `gap` with the given
/// `loads`; `headings` in the pair frame.
///
/// ```
/// use scene::{Gap, LoadSet, PairLoads, Squirmer, balance::{External, Heading, pair_velocity}};
/// // Far apart, a squirmer that points at the other one swims at V_s = 2 B_1/3.
/// let squirmers = [Squirmer::with_beta(1.0, 5.0)?, Squirmer::new(&[])?];
/// let ahead = Heading { cosine: 1.0, transverse: 0.0 };
/// let external = External { repulsion: 0.0, torque: None };
/// let far = Gap::new(1e6)?;
/// let v = pair_velocity(far, &PairLoads::isolated(LoadSet::all(2)), &squirmers, &[ahead, ahead], &external);
/// assert!((v.mean_axial - 0.5).abs() < 1e-15);
/// assert!((v.opening * far.eps() + 1.0).abs() < 1e-15);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[inline(always)]
pub fn pair_velocity<T: Transverse>(
    gap: Gap,
    loads: &PairLoads,
    squirmers: &[Squirmer; 2],
    headings: &[Heading<T>; 2],
    external: &External<T>,
) -> PairVelocity<T> {
    balanced(gap, loads, &squirming(loads, squirmers, headings), external)
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
/// the first. What cancels between the two is not formed: one transverse block of the balance is left, and
/// half of the loads.
#[inline(always)]
pub(crate) fn symmetric_velocity(
    image: Image,
    gap: Gap,
    loads: &PairLoads,
    squirmer: &Squirmer,
    heading: &Heading<f64>,
    external: &External<f64>,
) -> PairVelocity<f64> {
    let opposed = image == Image::Point;
    // Of translations across the line, and of torques and spins, whose parity is the other one.
    let across = |s: SelfOther| if opposed { s.difference } else { s.sum };
    let crossed = |s: SelfOther| if opposed { s.sum } else { s.difference };
    let (mut axial, mut force, mut torque) = (0.0, 0.0, 0.0);
    for (n, order) in (0..loads.set().modes).zip(legendre(heading.cosine)) {
        let (mode, b) = (loads.mode(n), squirmer.mode(n));
        axial += 2.0 * (b * order.p) * mode.xf.difference;
        let strength = b * order.w;
        force += strength * across(mode.yf);
        torque += strength * crossed(mode.yt);
    }
    let both = 2.0 * heading.transverse;
    let torque = match external.torque {
        Some([t1, t2]) if opposed => both * torque + (t1 + t2),
        Some([t1, t2]) => both * torque + (t1 - t2),
        None => both * torque,
    };
    let (speed, spin) = solve_transverse(
        across(loads.ya),
        across(loads.yb),
        crossed(loads.yc),
        both * force,
        torque,
    );
    let spin = 0.5 * spin;
    let (turning, mean_transverse) = if opposed {
        (turning(gap, speed), 0.0)
    } else {
        (0.0, 0.5 * speed)
    };
    PairVelocity {
        opening: opening(gap, loads, axial, external.repulsion),
        mean_axial: 0.0,
        mean_transverse,
        turning,
        spin: [spin, if opposed { spin } else { -spin }],
    }
}

/// `d(ln eps)/dt` by the difference of the axial slip forces.
#[inline(always)]
fn opening(gap: Gap, loads: &PairLoads, slip_difference: f64, repulsion: f64) -> f64 {
    // Near contact X11A - X12A goes as 1/(2 eps), so this product is of order one.
    // The quotient does not wait for the force.
    (slip_difference - 2.0 * repulsion) * (-1.0 / (6.0 * (loads.xa.difference * gap.eps())))
}

/// Rate at which the line of centres turns, by the difference of the velocities across it.
#[inline(always)]
fn turning<T: Transverse>(gap: Gap, difference: T) -> T {
    difference * (-1.0 / gap.distance())
}

/// [`pair_velocity`] with swirl; `turned` are the transverse headings turned by a quarter, `d x v`.
#[inline]
pub fn pair_velocity_with_swirl<T: Transverse>(
    gap: Gap,
    (loads, swirl): (&PairLoads, &SwirlLoads),
    squirmers: &[Squirmer; 2],
    (headings, turned): (&[Heading<T>; 2], &[T; 2]),
    external: &External<T>,
) -> PairVelocity<T> {
    let mut slip = squirming(loads, squirmers, headings);
    // Per unit transverse heading of each squirmer: [F+, F-, T+, T-].
    let mut of = [[0.0; 4]; 2];
    for (k, coefficients) in of.iter_mut().enumerate() {
        let orders = legendre(headings[k].cosine);
        let modes = squirmers[k].swirl().iter().zip(swirl.modes());
        for ((c, mode), order) in modes.zip(orders) {
            let strength = c * order.w;
            coefficients[0] += strength * mode.yfc.sum;
            coefficients[1] += strength * mode.yfc.difference;
            coefficients[2] += strength * mode.ytc.sum;
            coefficients[3] += strength * mode.ytc.difference;
        }
    }
    // Torques along `t` are `-d x t` in the form `T x d`.
    let ([v1, v2], [along, second]) = (*turned, of);
    slip.force_sum = slip.force_sum + v1 * along[0] - v2 * second[0];
    slip.force_difference = slip.force_difference + v1 * along[1] + v2 * second[1];
    slip.torque_sum = slip.torque_sum - v1 * along[2] - v2 * second[2];
    slip.torque_difference = slip.torque_difference - v1 * along[3] + v2 * second[3];
    balanced(gap, loads, &slip, external)
}

/// Spin of each squirmer about `d` by the axial torques of swirl.
#[inline]
#[must_use]
pub fn axial_spin_by_swirl<T>(
    (loads, swirl): (&PairLoads, &SwirlLoads),
    squirmers: &[Squirmer; 2],
    headings: &[Heading<T>; 2],
) -> [f64; 2] {
    let of = |k: usize| {
        squirmers[k]
            .swirl()
            .iter()
            .zip(legendre(headings[k].cosine))
    };
    let mut torque = SelfOther::default();
    for (mode, (c, order)) in swirl.modes().iter().zip(of(0)) {
        torque.sum += c * order.p * mode.xtc.sum;
        torque.difference += c * order.p * mode.xtc.difference;
    }
    for (mode, (c, order)) in swirl.modes().iter().zip(of(1)) {
        torque.sum -= c * order.p * mode.xtc.sum;
        torque.difference += c * order.p * mode.xtc.difference;
    }
    axial_spins(loads, torque)
}

/// Spins about `d` by torques about it, per `pi mu a^2`, as sum and difference over the spheres.
#[inline]
pub(crate) fn axial_spins(loads: &PairLoads, torque: SelfOther) -> [f64; 2] {
    let sum = torque.sum / (8.0 * loads.xc.sum);
    let difference = torque.difference / (8.0 * loads.xc.difference);
    [0.5 * (sum + difference), 0.5 * (sum - difference)]
}

#[inline(always)]
fn balanced<T: Transverse>(
    gap: Gap,
    loads: &PairLoads,
    slip: &Squirming<T>,
    external: &External<T>,
) -> PairVelocity<T> {
    // Nothing is added where there is none: the compiler sees which it is.
    let (torque_sum, torque_difference) = match external.torque {
        Some([t1, t2]) => (
            slip.torque_sum + (t1 + t2),
            slip.torque_difference + (t1 - t2),
        ),
        None => (slip.torque_sum, slip.torque_difference),
    };
    let (sum, spin_difference) = solve_transverse(
        loads.ya.sum,
        loads.yb.sum,
        loads.yc.difference,
        slip.force_sum,
        torque_difference,
    );
    let (difference, spin_sum) = solve_transverse(
        loads.ya.difference,
        loads.yb.difference,
        loads.yc.sum,
        slip.force_difference,
        torque_sum,
    );
    PairVelocity {
        opening: opening(gap, loads, slip.axial.difference, external.repulsion),
        mean_axial: slip.axial.sum / (12.0 * loads.xa.sum),
        mean_transverse: sum * 0.5,
        turning: turning(gap, difference),
        spin: [
            (spin_sum + spin_difference) * 0.5,
            (spin_sum - spin_difference) * 0.5,
        ],
    }
}
