//! One step: its stages, the state at its end and its estimated error.

use super::Stepper;
use crate::ode::System;
use crate::ode::tableau::{ERROR_3, ERROR_5, ROWS, STEP, Weights};

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
    pub(super) k: [[f64; N]; 12],
}

impl<const N: usize> Step<N> {
    /// A step of no length from where the stepper is.
    #[inline]
    pub(super) fn from(stepper: &Stepper<N>) -> Self {
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
    pub(super) fn attempt<S: System<N> + ?Sized>(
        &mut self,
        system: &mut S,
        tol: f64,
    ) -> (Option<f64>, usize) {
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
    pub(super) fn error(&self, h: f64, tol: f64) -> f64 {
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
}

/// `sum_j w_j k_j`; the weights are constants, so that the loops unroll.
#[inline(always)]
pub(super) fn weighted<const N: usize, const M: usize>(
    weights: &Weights<M>,
    k: &[[f64; N]],
) -> [f64; N] {
    let mut sum = [0.0; N];
    for &(j, weight) in weights {
        for i in 0..N {
            sum[i] += weight * k[j][i];
        }
    }
    sum
}

/// Whether all components are finite, without branches.
#[inline]
pub(super) fn finite<const N: usize>(v: &[f64; N]) -> bool {
    v.iter().fold(true, |all, v| all & v.is_finite())
}
