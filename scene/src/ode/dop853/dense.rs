//! Dense output: the solution anywhere within a step, for three more evaluations of the system (sec. II.6).

use super::Step;
use super::step::{finite, weighted};
use crate::ode::tableau::{
    DENSE_3, DENSE_4, DENSE_5, DENSE_6, STAGE_13, STAGE_14, STAGE_15, Stage,
};
use crate::ode::{OdeError, System};

impl<const N: usize> Step<N> {
    /// The 7th-order interpolant over this step, for three more evaluations of the system.
    ///
    /// # Errors
    /// [`OdeError::NotFinite`] if one of them is not finite.
    pub fn dense<S: System<N> + ?Sized>(&self, system: &mut S) -> Result<Dense<N>, OdeError> {
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
    pub(in crate::ode) t0: f64,
    pub(in crate::ode) t1: f64,
    pub(in crate::ode) y0: [f64; N],
    pub(in crate::ode) y1: [f64; N],
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

/// Derivative at one stage of the dense output of the step `h` from `(t, y)`.
#[inline(always)]
fn derivative<S: System<N> + ?Sized, const N: usize, const M: usize>(
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
