//! Dormand-Prince 8(5,3): `y1 = y0 + h sum_i b_i k_i`, `k_i = f(t0 + c_i h, y0 + h sum_j a_ij k_j)`.
//!
//! Source: E. Hairer, S. P. Norsett & G. Wanner, *Solving Ordinary Differential Equations I*, 2nd
//! ed., Springer 1993: method sec. II.5, dense output sec. II.6, first step sec. II.4. Step-size
//! control is that of the authors' code DOP853 with its default constants.

mod dense;
mod step;

pub use dense::Dense;
pub use step::Step;

use self::step::finite;
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
    pub fn new<S: System<N> + ?Sized>(
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
    pub fn restart_at<S: System<N> + ?Sized>(
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
    pub fn step<S: System<N> + ?Sized>(
        &mut self,
        system: &mut S,
        t_end: f64,
    ) -> Result<Step<N>, OdeError> {
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
    fn first_step<S: System<N> + ?Sized>(&mut self, system: &mut S, t_end: f64) -> f64 {
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
