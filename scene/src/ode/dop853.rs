//! Dormand-Prince 8(5,3): `y1 = y0 + h sum_i b_i k_i`, `k_i = f(t0 + c_i h, y0 + h sum_j a_ij k_j)`.
//!
//! Source: E. Hairer, S. P. Norsett & G. Wanner, *Solving Ordinary Differential Equations I*, 2nd
//! ed., Springer 1993: method sec. II.5, dense output sec. II.6, first step sec. II.4. Step-size
//! control is that of the authors' code DOP853 with its default constants.

use super::tableau::{
    DENSE_3, DENSE_4, DENSE_5, DENSE_6, ERROR_3, ERROR_5, STAGE_1, STAGE_2, STAGE_3, STAGE_4,
    STAGE_5, STAGE_6, STAGE_7, STAGE_8, STAGE_9, STAGE_10, STAGE_11, STAGE_13, STAGE_14, STAGE_15,
    STEP, Stage, Weights,
};
use super::{OdeError, System};

/// Fraction of the step that the error estimate would allow.
const SAFETY: f64 = 0.9;
/// Largest reduction of a step by the error estimate.
const SHRINK: f64 = 1.0 / 3.0;
/// Largest growth of a step.
const GROW: f64 = 6.0;
/// Reduction of a step in which the system was not finite.
const RETREAT: f64 = 0.2;
/// A step is stretched to the end if it would miss it by less than this factor.
const STRETCH: f64 = 1.01;
/// Steps tried before giving up, unless set otherwise.
const MAX_STEPS: usize = 100_000;

/// Integration in progress: time, state, derivative and the length of the next step.
#[derive(Clone, Debug)]
pub struct Stepper<const N: usize> {
    t: f64,
    y: [f64; N],
    dy: [f64; N],
    h: f64,
    tol: f64,
    max_steps: usize,
    accepted: usize,
    rejected: usize,
    evaluations: usize,
}

impl<const N: usize> Stepper<N> {
    /// Starts at `(t, y)` towards `t_end`, which serves to choose the first step only.
    ///
    /// The error of a step is kept below `tol (1 + |y_i|)`, root mean square over the components.
    ///
    /// # Errors
    /// [`OdeError::InvalidTolerance`] unless `tol` is positive and finite;
    /// [`OdeError::NotFinite`] if the state or its derivative is not.
    pub fn new<S: System<N>>(
        system: &mut S,
        t: f64,
        y: [f64; N],
        tol: f64,
        t_end: f64,
    ) -> Result<Self, OdeError> {
        if !(tol > 0.0 && tol.is_finite()) {
            return Err(OdeError::InvalidTolerance { tol });
        }
        let mut stepper = Self {
            t,
            y,
            dy: [0.0; N],
            h: 0.0,
            tol,
            max_steps: MAX_STEPS,
            accepted: 0,
            rejected: 0,
            evaluations: 0,
        };
        stepper.restart_at(system, t, y)?;
        stepper.h = stepper.first_step(system, t_end);
        Ok(stepper)
    }

    /// Allows `max_steps` steps, accepted and rejected together, instead of 100 000.
    #[must_use]
    pub fn with_max_steps(self, max_steps: usize) -> Self {
        Self { max_steps, ..self }
    }

    /// Goes on from `(t, y)`, after an event or a projection changed the state; the length of the
    /// next step and the counters are kept.
    ///
    /// # Errors
    /// [`OdeError::NotFinite`] if the state or its derivative is not; the stepper then stays where
    /// it was.
    pub fn restart_at<S: System<N>>(
        &mut self,
        system: &mut S,
        t: f64,
        y: [f64; N],
    ) -> Result<(), OdeError> {
        if !(t.is_finite() && finite(&y)) {
            return Err(OdeError::NotFinite { t });
        }
        self.evaluations += 1;
        let dy = system.rhs(t, &y);
        if !finite(&dy) {
            return Err(OdeError::NotFinite { t });
        }
        (self.t, self.y, self.dy) = (t, y, dy);
        Ok(())
    }

    /// Takes one step towards `t_end` and never past it: shorter ones are tried until the error
    /// estimate is within the tolerance. The last step ends at `t_end` exactly.
    ///
    /// # Errors
    /// [`OdeError::EmptyInterval`] if `t_end` is the present time or NaN,
    /// [`OdeError::StepTooSmall`] and [`OdeError::TooManySteps`] if no step is found. The stepper
    /// then stays where it was.
    pub fn step<S: System<N>>(&mut self, system: &mut S, t_end: f64) -> Result<Step<N>, OdeError> {
        let (t, left) = (self.t, t_end - self.t);
        if left.is_nan() || left.abs() <= 0.0 {
            return Err(OdeError::EmptyInterval { t, t_end });
        }
        let mut step = Step::from(self);
        let mut largest_factor = GROW;
        loop {
            let last = STRETCH * self.h >= left.abs();
            if !last && self.h <= smallest_step(t) {
                return Err(OdeError::StepTooSmall { t, h: self.h });
            }
            let steps = self.accepted + self.rejected;
            if steps >= self.max_steps {
                return Err(OdeError::TooManySteps { t, steps });
            }
            step.t1 = if last {
                t_end
            } else {
                t + self.h.copysign(left)
            };
            let length = (step.t1 - t).abs();

            let (error, evaluations) = step.attempt(system, self.tol);
            self.evaluations += evaluations;
            let Some(error) = error else {
                self.rejected += 1;
                self.h = RETREAT * length;
                largest_factor = 1.0;
                continue;
            };
            let factor = (SAFETY / eighth_root(error)).clamp(SHRINK, largest_factor);
            if error > 1.0 {
                self.rejected += 1;
                self.h = factor * length;
                largest_factor = 1.0;
                continue;
            }
            self.accepted += 1;
            // A step cut short by the end says nothing against the length that was proposed.
            self.h = if last {
                self.h.max(factor * length)
            } else {
                factor * length
            };
            (self.t, self.y, self.dy) = (step.t1, step.y1, step.dy1);
            return Ok(step);
        }
    }

    /// First step from the sizes of the state and of its first two derivatives, sec. II.4.
    fn first_step<S: System<N>>(&mut self, system: &mut S, t_end: f64) -> f64 {
        let left = t_end - self.t;
        let scaled = |v: &[f64; N]| {
            (v.iter().zip(&self.y))
                .map(|(v, y)| (v / (self.tol * (1.0 + y.abs()))).powi(2))
                .sum::<f64>()
        };
        let (size, rate) = (scaled(&self.y), scaled(&self.dy));
        let h0 = if size <= 1e-10 || rate <= 1e-10 {
            1e-6
        } else {
            0.01 * (size / rate).sqrt()
        };
        let h0 = h0.min(left.abs()).max(smallest_step(self.t));
        let signed = h0.copysign(left);
        let euler = std::array::from_fn(|i| self.y[i] + signed * self.dy[i]);
        let ahead = system.rhs(self.t + signed, &euler);
        let change = std::array::from_fn(|i| ahead[i] - self.dy[i]);
        let steepest = (scaled(&change).sqrt() / h0).max(rate.sqrt());
        self.evaluations += 1;
        let h1 = if !finite(&ahead) {
            h0
        } else if steepest <= 1e-15 {
            (1e-3 * h0).max(1e-6)
        } else {
            eighth_root(0.01 / steepest)
        };
        h1.min(100.0 * h0)
            .min(left.abs())
            .max(2.0 * smallest_step(self.t))
    }

    /// Time reached.
    #[inline]
    #[must_use]
    pub fn t(&self) -> f64 {
        self.t
    }

    /// State reached.
    #[inline]
    #[must_use]
    pub fn y(&self) -> &[f64; N] {
        &self.y
    }

    /// Derivative of the state reached.
    #[inline]
    #[must_use]
    pub fn dy(&self) -> &[f64; N] {
        &self.dy
    }

    /// Length of the step to be tried next, positive.
    #[inline]
    #[must_use]
    pub fn h(&self) -> f64 {
        self.h
    }

    /// Steps accepted so far.
    #[inline]
    #[must_use]
    pub fn accepted(&self) -> usize {
        self.accepted
    }

    /// Steps rejected so far.
    #[inline]
    #[must_use]
    pub fn rejected(&self) -> usize {
        self.rejected
    }

    /// Evaluations of the right-hand side so far, without the three of each dense output.
    #[inline]
    #[must_use]
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }
}

/// One accepted step, from its start `0` to its end `1`.
#[derive(Clone, Debug)]
pub struct Step<const N: usize> {
    /// Time at the start.
    pub t0: f64,
    /// State at the start.
    pub y0: [f64; N],
    /// Derivative at the start.
    pub dy0: [f64; N],
    /// Time at the end.
    pub t1: f64,
    /// State at the end.
    pub y1: [f64; N],
    /// Derivative at the end.
    pub dy1: [f64; N],
    /// Derivatives at the stages 0 to 11.
    k: [[f64; N]; 12],
}

impl<const N: usize> Step<N> {
    /// A step of no length from where the stepper is.
    #[inline]
    fn from(stepper: &Stepper<N>) -> Self {
        let Stepper { t, y, dy, .. } = *stepper;
        let mut k = [[0.0; N]; 12];
        k[0] = dy;
        Self {
            t0: t,
            y0: y,
            dy0: dy,
            t1: t,
            y1: y,
            dy1: dy,
            k,
        }
    }

    /// Makes the step to `t1`: its estimated error in units of the tolerance, none if the system
    /// was not finite on the way, and the evaluations spent.
    #[inline]
    fn attempt<S: System<N>>(&mut self, system: &mut S, tol: f64) -> (Option<f64>, usize) {
        let h = self.t1 - self.t0;
        let mut spent = 0;
        let mut finite_so_far = true;
        macro_rules! stages {
            ($($index:literal: $stage:ident),*) => {$(
                if finite_so_far {
                    self.k[$index] = derivative(system, self.t0, &self.y0, h, &self.k, &$stage);
                    finite_so_far = finite(&self.k[$index]);
                    spent += 1;
                }
            )*};
        }
        stages!(1: STAGE_1, 2: STAGE_2, 3: STAGE_3, 4: STAGE_4, 5: STAGE_5, 6: STAGE_6);
        stages!(7: STAGE_7, 8: STAGE_8, 9: STAGE_9, 10: STAGE_10, 11: STAGE_11);
        if !finite_so_far {
            return (None, spent);
        }
        let slope = weighted(&STEP, &self.k);
        self.y1 = std::array::from_fn(|i| self.y0[i] + h * slope[i]);
        let error = self.error(h, tol);
        if !(error.is_finite() && finite(&self.y1)) {
            return (None, spent);
        }
        if error > 1.0 {
            return (Some(error), spent);
        }
        self.dy1 = system.rhs(self.t1, &self.y1);
        (finite(&self.dy1).then_some(error), spent + 1)
    }

    /// `|h| e5^2 / sqrt(N (e5^2 + 0.01 e3^2))` with the scaled 5th- and 3rd-order estimates.
    #[inline]
    fn error(&self, h: f64, tol: f64) -> f64 {
        let (e5, e3) = (weighted(&ERROR_5, &self.k), weighted(&ERROR_3, &self.k));
        let (mut square5, mut square3) = (0.0, 0.0);
        for i in 0..N {
            let unit = 1.0 / (tol * (1.0 + self.y0[i].abs().max(self.y1[i].abs())));
            square5 += (e5[i] * unit).powi(2);
            square3 += (e3[i] * unit).powi(2);
        }
        let both = square5 + 0.01 * square3;
        if both <= 0.0 {
            return 0.0;
        }
        h.abs() * square5 / (both * N as f64).sqrt()
    }

    /// The 7th-order interpolant over this step, for three more evaluations of the system.
    ///
    /// # Errors
    /// [`OdeError::NotFinite`] if one of them is not finite.
    pub fn dense<S: System<N>>(&self, system: &mut S) -> Result<Dense<N>, OdeError> {
        let h = self.t1 - self.t0;
        let mut k = [[0.0; N]; 16];
        k[..12].copy_from_slice(&self.k);
        k[12] = self.dy1;
        k[13] = derivative(system, self.t0, &self.y0, h, &k, &STAGE_13);
        k[14] = derivative(system, self.t0, &self.y0, h, &k, &STAGE_14);
        k[15] = derivative(system, self.t0, &self.y0, h, &k, &STAGE_15);
        if !k[13..].iter().all(finite) {
            return Err(OdeError::NotFinite { t: self.t0 });
        }
        let rise: [f64; N] = std::array::from_fn(|i| self.y1[i] - self.y0[i]);
        let scaled = |slope: [f64; N]| slope.map(|v| h * v);
        Ok(Dense {
            t0: self.t0,
            t1: self.t1,
            y0: self.y0,
            y1: self.y1,
            coefficients: [
                rise,
                std::array::from_fn(|i| h * self.dy0[i] - rise[i]),
                std::array::from_fn(|i| 2.0 * rise[i] - h * (self.dy1[i] + self.dy0[i])),
                scaled(weighted(&DENSE_3, &k)),
                scaled(weighted(&DENSE_4, &k)),
                scaled(weighted(&DENSE_5, &k)),
                scaled(weighted(&DENSE_6, &k)),
            ],
        })
    }
}

/// The solution over one step: with `x = (t - t0)/(t1 - t0)`,
/// `y0 + x (c0 + (1 - x) (c1 + x (c2 + (1 - x) (c3 + ...))))`.
#[derive(Clone, Debug)]
pub struct Dense<const N: usize> {
    pub(super) t0: f64,
    pub(super) t1: f64,
    pub(super) y0: [f64; N],
    pub(super) y1: [f64; N],
    coefficients: [[f64; N]; 7],
}

impl<const N: usize> Dense<N> {
    /// State at time `t` within the step; outside it the polynomial is continued.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; N] {
        let x = (t - self.t0) / (self.t1 - self.t0);
        let mut y = [0.0; N];
        for (order, coefficient) in self.coefficients.iter().enumerate().rev() {
            let factor = if order % 2 == 0 { x } else { 1.0 - x };
            y = std::array::from_fn(|i| (y[i] + coefficient[i]) * factor);
        }
        std::array::from_fn(|i| self.y0[i] + y[i])
    }
}

/// `sum_j w_j k_j`; the weights are constants, so that the loops unroll.
#[inline(always)]
fn weighted<const N: usize, const M: usize>(weights: &Weights<M>, k: &[[f64; N]]) -> [f64; N] {
    let mut sum = [0.0; N];
    for &(j, weight) in weights {
        for i in 0..N {
            sum[i] += weight * k[j][i];
        }
    }
    sum
}

/// Derivative at one stage of the step `h` from `(t, y)`.
#[inline(always)]
fn derivative<S: System<N>, const N: usize, const M: usize>(
    system: &mut S,
    t: f64,
    y: &[f64; N],
    h: f64,
    k: &[[f64; N]],
    stage: &Stage<M>,
) -> [f64; N] {
    let slope = weighted(&stage.a, k);
    system.rhs(
        t + stage.c * h,
        &std::array::from_fn(|i| y[i] + h * slope[i]),
    )
}

/// Whether all components are finite, without branches.
#[inline]
fn finite<const N: usize>(v: &[f64; N]) -> bool {
    v.iter().fold(true, |all, v| all & v.is_finite())
}

/// `x^(1/8)` by square roots, which are the same bits on every machine where `powf` is not.
#[inline]
fn eighth_root(x: f64) -> f64 {
    x.sqrt().sqrt().sqrt()
}

/// Steps up to this length are lost in the rounding of `t`.
#[inline]
fn smallest_step(t: f64) -> f64 {
    (10.0 * f64::EPSILON * t.abs()).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Kepler orbit of eccentricity 0.1 with unit semi-major axis: period `2 pi`.
    fn kepler(_: f64, y: &[f64; 4]) -> [f64; 4] {
        let cube = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
        [y[2], y[3], -y[0] / cube, -y[1] / cube]
    }
    const PERIHELION: [f64; 4] = [0.9, 0.0, 0.0, 1.105_541_596_785_133_2];
    const PERIOD: f64 = std::f64::consts::TAU;

    fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
        (a.iter().zip(b)).fold(0.0, |d, (a, b)| d.max((a - b).abs()))
    }

    fn integrate<S: System<N>, const N: usize>(
        system: &mut S,
        (t, t_end): (f64, f64),
        y: [f64; N],
        tol: f64,
    ) -> Stepper<N> {
        let mut stepper = Stepper::new(system, t, y, tol, t_end).unwrap();
        while (t_end - stepper.t()).abs() > 0.0 {
            stepper.step(system, t_end).unwrap();
        }
        stepper
    }

    /// One step of given length, whatever its error.
    pub(in crate::ode) fn fixed<S: System<N>, const N: usize>(
        system: &mut S,
        t0: f64,
        y0: [f64; N],
        h: f64,
    ) -> Step<N> {
        let mut stepper = Stepper::new(system, t0, y0, 1e30, t0 + h).unwrap();
        stepper.h = h;
        stepper.step(system, t0 + h).unwrap()
    }

    /// Largest errors in equal steps, so many a Kepler period: after one period, and of the dense
    /// output within the first step, against much tighter solutions.
    fn kepler_errors(steps: u32) -> (f64, f64) {
        let h = PERIOD / f64::from(steps);
        let mut y = PERIHELION;
        for _ in 0..steps {
            y = fixed(&mut kepler, 0.0, y, h).y1;
        }
        let first = fixed(&mut kepler, 0.0, PERIHELION, h);
        let dense = first.dense(&mut kepler).unwrap();
        let inside = (1..10).map(|i| {
            let t = h * f64::from(i) / 10.0;
            let exact = integrate(&mut kepler, (0.0, t), PERIHELION, 1e-16);
            distance(&dense.at(t), exact.y())
        });
        (distance(&y, &PERIHELION), inside.fold(0.0, f64::max))
    }

    #[test]
    fn a_kepler_orbit_converges_with_order_8() {
        let orders: Vec<f64> = [24, 28, 32]
            .map(|n| (kepler_errors(n).0 / kepler_errors(2 * n).0).log2())
            .to_vec();
        assert!(orders.iter().all(|p| (7.7..8.3).contains(p)), "{orders:?}");
    }

    #[test]
    fn the_dense_output_has_order_7() {
        // One step: the local error of a method of order 7 falls as h^8.
        let orders: Vec<f64> = [16, 24, 32]
            .map(|n| (kepler_errors(n).1 / kepler_errors(2 * n).1).log2())
            .to_vec();
        assert!(orders.iter().all(|p| (7.7..8.3).contains(p)), "{orders:?}");
    }

    #[test]
    fn the_dense_output_meets_the_ends_and_their_slopes() {
        let step = fixed(&mut kepler, 0.5, PERIHELION, 0.1);
        let dense = step.dense(&mut kepler).unwrap();
        assert!(distance(&dense.at(step.t0), &step.y0) <= 0.0);
        assert!(distance(&dense.at(step.t1), &step.y1) < 1e-15);
        let d = 1e-6;
        for (t, dy) in [(step.t0, step.dy0), (step.t1, step.dy1)] {
            let (after, before) = (dense.at(t + d), dense.at(t - d));
            let slope = std::array::from_fn(|i| (after[i] - before[i]) / (2.0 * d));
            assert!(distance(&slope, &dy) < 1e-9);
        }
    }

    #[test]
    fn the_tableau_meets_the_quadrature_conditions() {
        macro_rules! rows_sum_to_time {
            ($($stage:ident),*) => {$(
                let sum: f64 = $stage.a.iter().map(|&(_, weight)| weight).sum();
                approx::assert_abs_diff_eq!(sum, $stage.c, epsilon = 2e-14);
            )*};
        }
        rows_sum_to_time!(
            STAGE_1, STAGE_2, STAGE_3, STAGE_4, STAGE_5, STAGE_6, STAGE_7, STAGE_8
        );
        rows_sum_to_time!(STAGE_9, STAGE_10, STAGE_11, STAGE_13, STAGE_14, STAGE_15);
        for power in 0..8 {
            // dy/dt = (p + 1) t^p is integrated exactly.
            let mut monomial = |t: f64, _: &[f64; 1]| [f64::from(power + 1) * t.powi(power)];
            let step = fixed(&mut monomial, 0.0, [0.0], 1.0);
            approx::assert_abs_diff_eq!(step.y1[0], 1.0, epsilon = 2e-15);
            if power < 7 {
                let dense = step.dense(&mut monomial).unwrap();
                let exact = 0.3f64.powi(power + 1);
                approx::assert_abs_diff_eq!(dense.at(0.3)[0], exact, epsilon = 2e-14);
            }
        }
    }

    /// SciPy 1.17.1, `DOP853` with `first_step=0.4` from `(0.5, 1)` at `t = 0`.
    #[test]
    fn one_step_of_a_driven_pendulum_agrees_with_scipy() {
        let mut pendulum = |t: f64, y: &[f64; 2]| [y[1], t.cos() - y[0].sin()];
        let step = fixed(&mut pendulum, 0.0, [0.5, 1.0], 0.4);
        let expected = [0.931_458_011_940_626_6, 1.130_305_429_435_399_1];
        assert!(distance(&step.y1, &expected) < 5e-16);
        let inside = step.dense(&mut pendulum).unwrap().at(0.13);
        let expected = [0.634_066_638_797_950_7, 1.059_930_503_122_819];
        assert!(distance(&inside, &expected) < 5e-16);
        let error = step.error(0.4, 1e-3);
        approx::assert_relative_eq!(error, 1.847_681_825_181_316e-6, max_relative = 1e-9);
    }

    /// Restricted three-body problem, Hairer, Norsett & Wanner (II.0.1), mass ratio of the Moon.
    fn arenstorf(_: f64, y: &[f64; 4]) -> [f64; 4] {
        let (moon, earth) = (0.012_277_471, 1.0 - 0.012_277_471);
        let to_earth = ((y[0] + moon).powi(2) + y[1].powi(2)).powf(1.5);
        let to_moon = ((y[0] - earth).powi(2) + y[1].powi(2)).powf(1.5);
        [
            y[2],
            y[3],
            y[0] + 2.0 * y[3] - earth * (y[0] + moon) / to_earth - moon * (y[0] - earth) / to_moon,
            y[1] - 2.0 * y[2] - earth * y[1] / to_earth - moon * y[1] / to_moon,
        ]
    }
    const ARENSTORF: [f64; 4] = [0.994, 0.0, 0.0, -2.001_585_106_379_082_5];

    /// Period 17.0652165601579625588917206249, Hairer, Norsett & Wanner (II.0.2).
    #[test]
    fn the_arenstorf_orbit_returns_after_its_published_period() {
        let period = 17.065_216_560_157_964;
        let orbit = integrate(&mut arenstorf, (0.0, period), ARENSTORF, 1e-13);
        let back = distance(orbit.y(), &ARENSTORF);
        assert!(back < 1e-7, "{back:e} {orbit:?}");
        let moon_side = (orbit.y()[0] - ARENSTORF[0]).abs() + orbit.y()[1].abs();
        assert!(moon_side < 1e-9, "{moon_side:e}");
    }

    /// SciPy 1.17.1, `solve_ivp` with `DOP853`, `rtol = atol = 1e-13`.
    #[test]
    fn the_arenstorf_orbit_agrees_with_scipy_before_its_return() {
        let orbit = integrate(&mut arenstorf, (0.0, 8.0), ARENSTORF, 1e-13);
        let expected = [
            -1.174_553_507_277_498_6,
            -0.275_945_077_013_635_2,
            -0.253_170_749_968_332_4,
            0.447_376_747_860_520_95,
        ];
        assert!(distance(orbit.y(), &expected) < 1e-9);
    }

    #[test]
    fn the_error_is_proportional_to_the_tolerance() {
        for exponent in 4..=13 {
            let tol = 10f64.powi(-exponent);
            let orbit = integrate(&mut kepler, (0.0, 3.0 * PERIOD), PERIHELION, tol);
            let ratio = distance(orbit.y(), &PERIHELION) / tol;
            assert!((10.0..100.0).contains(&ratio), "{ratio} at {tol:e}");
        }
    }

    #[test]
    fn integration_there_and_back_returns() {
        let there = integrate(&mut kepler, (0.0, 5.0), PERIHELION, 1e-13);
        let back = integrate(&mut kepler, (5.0, 0.0), *there.y(), 1e-13);
        assert!(distance(back.y(), &PERIHELION) < 1e-11);
    }

    #[test]
    fn the_end_is_hit_exactly_and_never_passed() {
        let (mut latest, t_end) = (0.0f64, 0.1 + 0.2 + 3.0);
        let mut decay = |t: f64, y: &[f64; 1]| {
            latest = latest.max(t);
            [-y[0]]
        };
        let end = integrate(&mut decay, (0.0, t_end), [1.0], 1e-10);
        assert_eq!(end.t().to_bits(), t_end.to_bits());
        assert!(latest <= t_end);
        approx::assert_relative_eq!(end.y()[0], (-t_end).exp(), max_relative = 1e-9);
    }

    #[test]
    fn an_end_closer_than_the_resolution_of_time_is_reached() {
        let mut decay = |_: f64, y: &[f64; 1]| [-y[0]];
        let mut stepper = Stepper::new(&mut decay, 1.0, [1.0], 1e-10, 2.0).unwrap();
        let h = stepper.h();
        let next = 1.0f64.next_up();
        stepper.step(&mut decay, next).unwrap();
        assert_eq!(stepper.t().to_bits(), next.to_bits());
        assert!(
            stepper.h() >= h,
            "a step cut short must not shorten the next"
        );
    }

    #[test]
    fn a_step_at_the_end_is_an_error() {
        let mut decay = |_: f64, y: &[f64; 1]| [-y[0]];
        let mut stepper = Stepper::new(&mut decay, 1.0, [1.0], 1e-10, 2.0).unwrap();
        let nothing = OdeError::EmptyInterval { t: 1.0, t_end: 1.0 };
        assert_eq!(stepper.step(&mut decay, 1.0).unwrap_err(), nothing);
        assert!(stepper.step(&mut decay, f64::NAN).is_err());
    }

    #[test]
    fn a_system_that_is_nan_ahead_is_approached_by_shorter_steps() {
        // y = (1 - t)^2 has y' = -2 sqrt y, NaN for y < 0: a long step falls off the domain.
        let mut root = |_: f64, y: &[f64; 1]| [-2.0 * y[0].sqrt()];
        let mut stepper = Stepper::new(&mut root, 0.0, [1.0], 1e-8, 0.99).unwrap();
        stepper.h = 100.0;
        while stepper.t() < 0.99 {
            stepper.h = stepper.h.max(0.5);
            stepper.step(&mut root, 0.99).unwrap();
        }
        assert!(stepper.rejected() > 0);
        approx::assert_abs_diff_eq!(stepper.y()[0], 1e-4, epsilon = 1e-7);
    }

    #[test]
    fn a_step_into_nan_is_cut_to_a_fifth() {
        let mut wall = |t: f64, _: &[f64; 1]| [if t > 0.3 { f64::NAN } else { 1.0 }];
        let mut stepper = Stepper::new(&mut wall, 0.0, [0.0], 1e-8, 10.0).unwrap();
        stepper.h = 1.0;
        let step = stepper.step(&mut wall, 10.0).unwrap();
        approx::assert_abs_diff_eq!(step.t1, 0.2, epsilon = 1e-15);
        approx::assert_abs_diff_eq!(stepper.h(), 0.2, epsilon = 1e-15);
        assert_eq!((stepper.accepted(), stepper.rejected()), (1, 1));
    }

    #[test]
    fn a_wall_of_nan_makes_the_step_too_small() {
        let mut wall = |t: f64, _: &[f64; 1]| [if t > 1.0 { f64::NAN } else { 1.0 }];
        let mut stepper = Stepper::new(&mut wall, 0.0, [0.0], 1e-8, 2.0).unwrap();
        let error = loop {
            if let Err(error) = stepper.step(&mut wall, 2.0) {
                break error;
            }
        };
        assert!(
            matches!(error, OdeError::StepTooSmall { t, h } if (1.0 - t).abs() < 1e-12 && h < 1e-14),
            "{error}"
        );
        assert!(stepper.y()[0].is_finite());
    }

    #[test]
    fn a_start_that_is_not_finite_and_a_bad_tolerance_are_refused() {
        let mut decay = |_: f64, y: &[f64; 1]| [-y[0]];
        for (y, tol) in [(f64::NAN, 1e-8), (1.0, 0.0), (1.0, f64::NAN)] {
            assert!(Stepper::new(&mut decay, 0.0, [y], tol, 1.0).is_err());
        }
    }

    #[test]
    fn too_many_steps_are_an_error() {
        let mut stepper = Stepper::new(&mut kepler, 0.0, PERIHELION, 1e-12, 100.0)
            .unwrap()
            .with_max_steps(3);
        for _ in 0..3 - stepper.rejected() {
            stepper.step(&mut kepler, 100.0).unwrap();
        }
        let error = stepper.step(&mut kepler, 100.0).unwrap_err();
        assert!(
            matches!(error, OdeError::TooManySteps { steps: 3, .. }),
            "{error}"
        );
    }

    #[test]
    fn counters_count() {
        let mut calls = 0;
        let mut counted = |t: f64, y: &[f64; 4]| {
            calls += 1;
            arenstorf(t, y)
        };
        let orbit = integrate(&mut counted, (0.0, 17.0), ARENSTORF, 1e-7);
        assert_eq!(calls, orbit.evaluations());
        assert!(orbit.rejected() > 0);
        // Two to start, twelve a step, eleven a rejection.
        let expected = 2 + 12 * orbit.accepted() + 11 * orbit.rejected();
        assert_eq!(orbit.evaluations(), expected);
    }

    #[test]
    fn the_dense_output_costs_three_evaluations() {
        let mut calls = 0;
        let mut counted = |t: f64, y: &[f64; 4]| {
            calls += 1;
            kepler(t, y)
        };
        let step = fixed(&mut kepler, 0.0, PERIHELION, 0.1);
        step.dense(&mut counted).unwrap();
        assert_eq!(calls, 3);
    }

    #[test]
    fn a_restart_replaces_the_derivative_and_keeps_the_step() {
        let mut stepper = Stepper::new(&mut kepler, 0.0, PERIHELION, 1e-10, 1.0).unwrap();
        stepper.step(&mut kepler, 1.0).unwrap();
        let h = stepper.h();
        let turned = [1.0, 0.5, 0.0, -1.0];
        stepper.restart_at(&mut kepler, 0.25, turned).unwrap();
        assert_eq!(stepper.h().to_bits(), h.to_bits());
        assert_eq!((stepper.t(), *stepper.y()), (0.25, turned));
        assert!(distance(stepper.dy(), &kepler(0.25, &turned)) <= 0.0);
        let nowhere = stepper.restart_at(&mut kepler, 0.5, [0.0; 4]);
        assert_eq!(nowhere, Err(OdeError::NotFinite { t: 0.5 }));
        assert_eq!((stepper.t(), *stepper.y()), (0.25, turned));
    }

    #[test]
    fn the_same_run_gives_the_same_bits() {
        let run = || integrate(&mut arenstorf, (0.0, 17.0), ARENSTORF, 1e-9);
        let (one, two) = (run(), run());
        assert_eq!(one.y().map(f64::to_bits), two.y().map(f64::to_bits));
        assert_eq!(one.h().to_bits(), two.h().to_bits());
        assert_eq!(one.evaluations(), two.evaluations());
    }

    #[test]
    fn a_state_at_rest_takes_growing_steps() {
        let mut rest = |_: f64, _: &[f64; 2]| [0.0; 2];
        let end = integrate(&mut rest, (0.0, 1e6), [1.0, 0.0], 1e-9);
        assert!(end.accepted() < 30);
        assert!(distance(end.y(), &[1.0, 0.0]) <= 0.0);
    }

    /// `cargo test --release -p scene -- --ignored --nocapture step_overhead`
    #[test]
    #[ignore = "a measurement"]
    fn step_overhead() {
        /// Not inlined, as a system of interest would not be.
        #[inline(never)]
        fn rotor(_: f64, y: &[f64; 6]) -> [f64; 6] {
            [y[1], -y[0], y[3], -y[2], y[5], -y[4]]
        }
        let start = [0.0, 1.0, 1.0, 0.0, 0.6, 0.8];
        let mut stepper = Stepper::new(&mut rotor, 0.0, start, 1e-9, 1e9)
            .unwrap()
            .with_max_steps(usize::MAX);
        let time = |name: &str, run: &mut dyn FnMut() -> f64| {
            let best = (0..20).map(|_| {
                let begin = std::time::Instant::now();
                let sum: f64 = (0..10_000).map(|_| run()).sum();
                std::hint::black_box(sum);
                begin.elapsed().as_secs_f64() * 1e5
            });
            println!("{name}: {:.0} ns", best.fold(f64::INFINITY, f64::min));
        };
        time("step", &mut || stepper.step(&mut rotor, 1e9).unwrap().y1[0]);
        let step = stepper.step(&mut rotor, 1e9).unwrap();
        time("dense", &mut || {
            step.dense(&mut rotor).unwrap().at(step.t1)[0]
        });
        let dense = step.dense(&mut rotor).unwrap();
        let middle = 0.5 * (step.t0 + step.t1);
        time("dense at", &mut || {
            dense.at(std::hint::black_box(middle))[0]
        });
        let never = |_: f64, y: &[f64; 6]| y[0] + 2.0;
        time("first_crossing, none", &mut || {
            super::super::first_crossing(&dense, never, super::super::Direction::Either, 0.0)
                .unwrap_or(0.0)
        });
    }
}
