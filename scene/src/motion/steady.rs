//! Steady bound states: where gap and orientations, seen along the line of centres, do not change.
//!
//! Without gravity the planar motion of gap and orientations is a system of its own,
//! `dr/dt = f(r)`, `r = (ln eps, angle 1, angle 2)`. Every bound state of the paper's Fig. 1(c) is a
//! fixed point of it: a standoff, swimming along a line, or, if the line of centres turns,
//! swimming on a circle. A pair that comes close to a fixed point from which nothing grows (no
//! eigenvalue of the Jacobian has a positive real part, by Routh and Hurwitz) stays: the rest of
//! the run is known in closed form.
//!
//! Eigenvalues of zero do occur. Under lubrication theory every pair swimming in parallel at the
//! cut `eps = 1`, where the loads have faded to those of lone squirmers, is a fixed point, and the
//! pullers that the paper calls trapped creep up to that line from within.

use nalgebra::{Matrix3, Vector3};

use crate::ode::System;

/// Rate of change of gap and orientations below which a fixed point is sought.
const NEARLY_STEADY: f64 = 1e-5;

/// The same where an eigenvalue is zero: along its direction Newton's method finds the fixed point
/// only to about this precision.
const NEARLY_STEADY_IF_MARGINAL: f64 = 1e-6;

/// Rate of change at a fixed point, as good as rounding allows.
const STEADY: f64 = 1e-11;

/// How far from the pair's state the fixed point may lie.
const NEARBY: f64 = 1e-3;

/// The same for a pair that is only held up by it.
const HELD_UP_NEARBY: f64 = 0.3;

/// Step of the central differences of the Jacobian, whose error goes as its square.
const DIFFERENCE: f64 = 1e-5;

/// Growth rate up to which a fixed point holds: above the error of the differences, and nothing
/// grows by more than a thousandth of itself within a run.
const GROWTH: f64 = 1e-6;

/// Decay rate from which on a fixed point attracts.
const DECAY: f64 = 1e-3;

const MAX_NEWTON_STEPS: usize = 8;

/// Rates of change above which attempts are not worth repeating.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attempts {
    below: f64,
}

impl Default for Attempts {
    fn default() -> Self {
        Self {
            below: NEARLY_STEADY,
        }
    }
}

/// Looks for a fixed point from which nothing grows near the state `y` whose derivative is `dy`, in the
/// variables `relative`; returns the state there and its derivative.
///
/// After an attempt that found none the next is made when the rate of change has fallen tenfold.
pub(crate) fn steady_state<S: System<N>, const N: usize>(
    system: &mut S,
    t: f64,
    (y, dy): (&[f64; N], &[f64; N]),
    relative: [usize; 3],
    attempts: &mut Attempts,
) -> Option<([f64; N], [f64; N])> {
    let rate = |dy: &[f64; N]| {
        relative
            .map(|i| dy[i].abs())
            .into_iter()
            .fold(0.0, f64::max)
    };
    if rate(dy) >= attempts.below {
        return None;
    }
    attempts.below = 0.1 * rate(dy);
    let growth = if rate(dy) < NEARLY_STEADY_IF_MARGINAL {
        GROWTH
    } else {
        -DECAY
    };
    let (y, dy, jacobian) = fixed_point(system, t, (y, dy), relative, NEARBY)?;
    holds(&jacobian, growth).then_some((y, dy))
}

/// Whether the state `y` is held up by a fixed point near it from which something grows: such a
/// pair is trapped for long, but not for ever.
pub(crate) fn is_held_up<S: System<N>, const N: usize>(
    system: &mut S,
    t: f64,
    (y, dy): (&[f64; N], &[f64; N]),
    relative: [usize; 3],
) -> bool {
    fixed_point(system, t, (y, dy), relative, HELD_UP_NEARBY)
        .is_some_and(|(_, _, jacobian)| !holds(&jacobian, GROWTH))
}

/// The fixed point within `nearby` of the state `y`, by Newton's method, with its derivative and its
/// Jacobian.
fn fixed_point<S: System<N>, const N: usize>(
    system: &mut S,
    t: f64,
    (y, dy): (&[f64; N], &[f64; N]),
    relative: [usize; 3],
    nearby: f64,
) -> Option<([f64; N], [f64; N], Matrix3<f64>)> {
    let start = *y;
    let (mut y, mut dy) = (*y, *dy);
    for _ in 0..MAX_NEWTON_STEPS {
        let jacobian = jacobian(system, t, &y, relative);
        if (relative.iter()).all(|&i| dy[i].abs() < STEADY) {
            return Some((y, dy, jacobian));
        }
        let step = jacobian
            .lu()
            .solve(&Vector3::from(relative.map(|i| dy[i])))?;
        for (k, i) in relative.into_iter().enumerate() {
            y[i] -= step[k];
        }
        let moved = relative.map(|i| (y[i] - start[i]).abs());
        if moved.into_iter().any(|m| m.is_nan() || m > nearby) {
            return None;
        }
        dy = system.rhs(t, &y);
    }
    None
}

/// `df/dr` by central differences.
fn jacobian<S: System<N>, const N: usize>(
    system: &mut S,
    t: f64,
    y: &[f64; N],
    relative: [usize; 3],
) -> Matrix3<f64> {
    let mut matrix = Matrix3::zeros();
    for (column, j) in relative.into_iter().enumerate() {
        let mut at = |offset: f64| {
            let mut y = *y;
            y[j] += offset;
            system.rhs(t, &y)
        };
        let (above, below) = (at(DIFFERENCE), at(-DIFFERENCE));
        for (row, i) in relative.into_iter().enumerate() {
            matrix[(row, column)] = (above[i] - below[i]) / (2.0 * DIFFERENCE);
        }
    }
    matrix
}

/// Whether all eigenvalues have real parts below `growth`: Routh and Hurwitz's criterion for the
/// characteristic polynomial `x^3 + a x^2 + b x + c` of the Jacobian less that.
fn holds(jacobian: &Matrix3<f64>, growth: f64) -> bool {
    let shifted = jacobian - Matrix3::identity() * growth;
    let a = -shifted.trace();
    let c = -shifted.determinant();
    let minor =
        |i: usize, j: usize| shifted[(i, i)] * shifted[(j, j)] - shifted[(i, j)] * shifted[(j, i)];
    let b = minor(0, 1) + minor(0, 2) + minor(1, 2);
    a > 0.0 && c > 0.0 && a * b > c
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(matrix: Matrix3<f64>, start: f64) -> bool {
        let mut system = move |_: f64, y: &[f64; 3]| {
            let r = Vector3::from(*y);
            let f = matrix * r + Vector3::repeat(r.norm_squared());
            [f.x, f.y, f.z]
        };
        let y = [start, -start, start];
        let dy = system.rhs(0.0, &y);
        steady_state(
            &mut system,
            0.0,
            (&y, &dy),
            [0, 1, 2],
            &mut Attempts::default(),
        )
        .is_some_and(|(y, _)| y.iter().all(|v| v.abs() < 1e-10))
    }

    #[test]
    fn a_pair_near_an_attracting_point_is_settled() {
        let spiral = Matrix3::new(-0.3, 2.0, 0.0, -2.0, -0.3, 0.0, 0.1, 0.0, -1.0);
        assert!(settled(spiral, 1e-7));
        assert!(!settled(spiral, 1e-2), "too far away to tell");
    }

    #[test]
    fn a_pair_near_a_saddle_or_an_unwinding_spiral_is_not() {
        let saddle = Matrix3::new(-1.0, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, -3.0);
        let spiral = Matrix3::new(1e-3, 1.0, 0.0, -1.0, 1e-3, 0.0, 0.0, 0.0, -1.0);
        assert!(!settled(saddle, 1e-7));
        assert!(!settled(spiral, 1e-7));
    }
}
