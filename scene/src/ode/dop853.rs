//! Dormand-Prince 8(5,3): `y1 = y0 + h sum_i b_i k_i`, `k_i = f(t0 + c_i h, y0 + h sum_j a_ij k_j)`.
//!
//! Source: E. Hairer, S. P. Norsett & G. Wanner, *Solving Ordinary Differential Equations I*, 2nd
//! ed., Springer 1993: method sec. II.5, dense output sec. II.6, first step sec. II.4. Step-size
//! control is that of the authors' code DOP853 with its default constants.

use super::tableau::{
    DENSE_3, DENSE_4, DENSE_5, DENSE_6, ERROR_3, ERROR_5, ROWS, STAGE_13, STAGE_14, STAGE_15, STEP,
    Stage, Weights,
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
        let dy = system.called(t, &y);
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
        let ahead = system.called(self.t + signed, &euler);
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
        // The last derivative is what a stage waits for: it comes in where all else is ready, and through
        // registers. So there is one place that calls the system, with the system inside the loop.
        let mut last = self.k[0];
        let mut spent = 0;
        for row in &ROWS {
            let mut slope = [0.0; N];
            for (k, weight) in self.k.iter().zip(&row.a).take(spent) {
                for i in 0..N {
                    slope[i] += weight * k[i];
                }
            }
            let reach = h * row.a[spent];
            let y = std::array::from_fn(|i| (self.y0[i] + h * slope[i]) + reach * last[i]);
            last = system.rhs(self.t0 + row.c * h, &y);
            spent += 1;
            self.k[spent] = last;
            if !finite(&last) {
                return (None, spent);
            }
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
        self.dy1 = system.called(self.t1, &self.y1);
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

/// Derivative at one stage of the dense output of the step `h` from `(t, y)`.
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
    let y = std::array::from_fn(|i| y[i] + h * slope[i]);
    system.called(t + stage.c * h, &y)
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
pub(super) mod tests;
