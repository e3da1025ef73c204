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

use nalgebra::{Matrix3, Matrix4x3, Vector3};

use crate::ode::System;

/// Rate of change of gap and orientations below which a fixed point is sought, at most and over the
/// tolerance of the trajectory: what is then left to first order is counted, to second order not.
const NEARLY_STEADY: (f64, f64) = (1e-4, 1e3);

/// The same where an eigenvalue is zero: along its direction Newton's method finds the fixed point
/// only to about this precision.
const NEARLY_STEADY_IF_MARGINAL: (f64, f64) = (1e-6, 1e2);

/// Rate of change at a fixed point, as good as rounding allows.
const STEADY: f64 = 1e-11;

/// How far from the pair's state the fixed point may lie.
const NEARBY: f64 = 1e-3;

/// Step of the central differences of the Jacobian, whose error goes as its square.
const DIFFERENCE: f64 = 1e-5;

/// Growth rate up to which a fixed point holds: above the error of the differences, and nothing
/// grows by more than a thousandth of itself within a run.
const GROWTH: f64 = 1e-6;

/// Decay rate from which on a fixed point attracts.
const DECAY: f64 = 1e-3;

/// From a state that is nearly steady no step is long.
const FROM_NEARBY: Newton = Newton {
    nearby: NEARBY,
    longest: NEARBY,
    most_steps: 8,
};

/// When to look for a fixed point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attempts {
    /// Rate of change above which an attempt is not worth making, or repeating.
    below: f64,
    /// Rate of change below which a marginal fixed point is taken.
    marginal: f64,
}

impl Attempts {
    /// For a trajectory integrated to `tolerance`.
    pub(crate) fn new(tolerance: f64) -> Self {
        let limit = |(most, times): (f64, f64)| (times * tolerance).min(most);
        Self {
            below: limit(NEARLY_STEADY),
            marginal: limit(NEARLY_STEADY_IF_MARGINAL),
        }
    }
}

/// The variables that are a system of their own, and the one that they drive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relative {
    /// Indices of `ln eps` and the orientations, three at most.
    pub variables: &'static [usize],
    /// Index of the variable whose rate of change depends on them: the angle of the line of centres, or
    /// the position along a line that the pair keeps to.
    pub driven: usize,
}

/// Looks for a fixed point from which nothing grows near the state `y` whose derivative is `dy`;
/// returns the state there and its derivative. The driven variable is put ahead by what it still
/// gains while the rest decays, to first order.
///
/// After an attempt that found none the next is made when the rate of change has fallen tenfold.
pub(crate) fn steady_state<S: System<N> + ?Sized, const N: usize>(
    system: &mut S,
    t: f64,
    (y, dy): (&[f64; N], &[f64; N]),
    relative: Relative,
    attempts: &mut Attempts,
) -> Option<([f64; N], [f64; N])> {
    let of = relative.variables;
    let rate = |dy: &[f64; N]| of.iter().map(|&i| dy[i].abs()).fold(0.0, f64::max);
    if rate(dy) >= attempts.below {
        return None;
    }
    attempts.below = 0.1 * rate(dy);
    let marginal = rate(dy) < attempts.marginal;
    let start = *y;
    let (mut y, dy, gradients) = fixed_point(system, t, (y, dy), relative, FROM_NEARBY)?;
    let jacobian = gradients.fixed_rows::<3>(0).into_owned();
    if holds(&jacobian, -DECAY) {
        // What decays as exp(J t) from its start adds up to -J^-1 of the start.
        let away = relative.vector(|i| start[i] - y[i]);
        y[relative.driven] -= (gradients.row(3) * jacobian.lu().solve(&away)?)[0];
        return Some((y, dy));
    }
    (marginal && holds(&jacobian, GROWTH)).then_some((y, dy))
}

/// How Newton's method goes about it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Newton {
    /// How far from the start the fixed point may lie.
    pub nearby: f64,
    /// Longest step; a longer one is cut to this length.
    pub longest: f64,
    /// Steps after which it gives up.
    pub most_steps: usize,
}

/// A fixed point with the derivative of the state and the gradients there.
pub(super) type FixedPoint<const N: usize> = ([f64; N], [f64; N], Matrix4x3<f64>);

/// The fixed point near the state `y`, by Newton's method.
pub(super) fn fixed_point<S: System<N> + ?Sized, const N: usize>(
    system: &mut S,
    t: f64,
    (y, dy): (&[f64; N], &[f64; N]),
    relative: Relative,
    newton: Newton,
) -> Option<FixedPoint<N>> {
    let of = relative.variables;
    let start = *y;
    let (mut y, mut dy) = (*y, *dy);
    for _ in 0..newton.most_steps {
        let gradients = gradients(system, t, &y, relative);
        if of.iter().all(|&i| dy[i].abs() < STEADY) {
            return Some((y, dy, gradients));
        }
        let jacobian = gradients.fixed_rows::<3>(0).into_owned();
        let step = jacobian.lu().solve(&relative.vector(|i| dy[i]))?;
        let cut = (newton.longest / step.amax()).min(1.0);
        for (k, &i) in of.iter().enumerate() {
            y[i] -= cut * step[k];
        }
        let mut moved = of.iter().map(|&i| (y[i] - start[i]).abs());
        if moved.any(|m| m.is_nan() || m > newton.nearby) {
            return None;
        }
        dy = system.called(t, &y);
    }
    None
}

/// Gradients of the rates of the relative variables (the Jacobian, in the first three rows) and of
/// the rate of the driven variable (in the last), by central differences.
fn gradients<S: System<N> + ?Sized, const N: usize>(
    system: &mut S,
    t: f64,
    y: &[f64; N],
    relative: Relative,
) -> Matrix4x3<f64> {
    // Variables that are not there decay by themselves: they change nothing for the others.
    let mut matrix = Matrix4x3::zeros();
    for missing in relative.variables.len()..3 {
        matrix[(missing, missing)] = -1.0;
    }
    for (column, &j) in relative.variables.iter().enumerate() {
        let mut at = |offset: f64| {
            let mut y = *y;
            y[j] += offset;
            system.called(t, &y)
        };
        let (above, below) = (at(DIFFERENCE), at(-DIFFERENCE));
        let rows = relative.variables.iter().enumerate();
        for (row, &i) in rows.chain([(3, &relative.driven)]) {
            matrix[(row, column)] = (above[i] - below[i]) / (2.0 * DIFFERENCE);
        }
    }
    matrix
}

impl Relative {
    /// The values of the variables; zero for those that are not there.
    fn vector(&self, value: impl Fn(usize) -> f64) -> Vector3<f64> {
        let mut vector = Vector3::zeros();
        for (slot, &i) in vector.iter_mut().zip(self.variables) {
            *slot = value(i);
        }
        vector
    }
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

    /// A system with a fixed point at zero and a fourth variable that turns at the rate `1 + r_0`.
    fn settled(matrix: Matrix3<f64>, start: f64) -> Option<[f64; 4]> {
        let mut system = move |_: f64, y: &[f64; 4]| {
            let r = Vector3::new(y[0], y[1], y[2]);
            let f = matrix * r + Vector3::repeat(r.norm_squared());
            [f.x, f.y, f.z, 1.0 + r.x]
        };
        let y = [start, -start, start, 0.0];
        let dy = system.called(0.0, &y);
        let relative = Relative {
            variables: &[0, 1, 2],
            driven: 3,
        };
        let mut attempts = Attempts::new(1e-8);
        let (y, _) = steady_state(&mut system, 0.0, (&y, &dy), relative, &mut attempts)?;
        Some(y)
    }

    #[test]
    fn a_pair_near_an_attracting_point_is_settled() {
        let spiral = Matrix3::new(-0.3, 2.0, 0.0, -2.0, -0.3, 0.0, 0.1, 0.0, -1.0);
        let [x, y, z, _] = settled(spiral, 1e-7).unwrap();
        assert!([x, y, z].iter().all(|v| v.abs() < 1e-10));
        assert_eq!(settled(spiral, 1e-2), None, "too far away to tell");
    }

    #[test]
    fn a_pair_near_a_saddle_or_an_unwinding_spiral_is_not() {
        let saddle = Matrix3::new(-1.0, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, -3.0);
        let spiral = Matrix3::new(1e-3, 1.0, 0.0, -1.0, 1e-3, 0.0, 0.0, 0.0, -1.0);
        assert_eq!(settled(saddle, 1e-7), None);
        assert_eq!(settled(spiral, 1e-7), None);
    }

    #[test]
    fn what_the_pair_still_turns_while_it_decays_is_counted() {
        // r_0 = exp(-t/2) 1e-6 turns the line of centres by 2e-6 more than the steady rate.
        let decay = Matrix3::from_diagonal(&Vector3::new(-0.5, -1.0, -2.0));
        let turned = settled(decay, 1e-6).unwrap()[3];
        assert!((turned - 2e-6).abs() < 1e-10, "{turned:e}");
    }
}
