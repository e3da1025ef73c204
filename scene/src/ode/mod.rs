//! Ordinary differential equations `dy/dt = f(t, y)` on small stack arrays: an explicit adaptive
//! stepper of order 8, its dense output, and the location of events.
//!
//! A step is taken by [`Stepper::step`]; what happens inside it is asked of its [`Dense`] output,
//! which costs three more evaluations of `f` and only when asked for. Time may run either way.
//!
//! ```
//! use scene::ode::{Direction, OdeError, Stepper, first_crossing};
//! // When does y = cos t first reach zero?
//! let mut cosine = |_: f64, y: &[f64; 2]| [y[1], -y[0]];
//! let mut stepper = Stepper::new(&mut cosine, 0.0, [1.0, 0.0], 1e-12, 10.0)?;
//! let zero = loop {
//!     let step = stepper.step(&mut cosine, 10.0)?;
//!     let dense = step.dense(&mut cosine)?;
//!     if let Some(t) = first_crossing(&dense, |_, y| y[0], Direction::Falling, 0.0) {
//!         break t;
//!     }
//! };
//! assert!((zero - std::f64::consts::FRAC_PI_2).abs() < 1e-11);
//! # Ok::<(), OdeError>(())
//! ```

mod dop853;
mod event;
mod tableau;

pub use dop853::{Dense, Step, Stepper};
pub use event::{Direction, first_crossing, first_minimum};

/// A system of `N` first-order equations.
///
/// Every `FnMut(f64, &[f64; N]) -> [f64; N]` is one.
pub trait System<const N: usize> {
    /// `dy/dt` at time `t` and state `y`; NaN where `y` is outside the system's domain, which makes
    /// the stepper try again with a shorter step.
    fn rhs(&mut self, t: f64, y: &[f64; N]) -> [f64; N];

    /// [`Self::rhs`] as a call: one compiled copy for everybody but the loop over the stages of a step, which has it
    /// inside.
    #[inline(never)]
    fn called(&mut self, t: f64, y: &[f64; N]) -> [f64; N] {
        self.rhs(t, y)
    }
}

impl<const N: usize, F: FnMut(f64, &[f64; N]) -> [f64; N]> System<N> for F {
    #[inline]
    fn rhs(&mut self, t: f64, y: &[f64; N]) -> [f64; N] {
        self(t, y)
    }
}

/// Why an integration cannot start or go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OdeError {
    /// A tolerance that is not a positive finite number.
    #[error("tolerance {tol:e} is not allowed: it must be positive and finite")]
    InvalidTolerance {
        /// The tolerance.
        tol: f64,
    },
    /// A step was asked for where no time is left, or the end is NaN.
    #[error("no step leads from t = {t} to t = {t_end}")]
    EmptyInterval {
        /// Time reached.
        t: f64,
        /// End asked for.
        t_end: f64,
    },
    /// State or derivative are not finite where no shorter step can help.
    #[error("state or derivative at t = {t} are not finite")]
    NotFinite {
        /// Time of the state.
        t: f64,
    },
    /// The tolerance, or a system that is not finite ahead, needs a step below the resolution of
    /// `t`.
    #[error("step {h:e} at t = {t} is too small")]
    StepTooSmall {
        /// Time reached.
        t: f64,
        /// Length of the step.
        h: f64,
    },
    /// More steps, accepted and rejected, than allowed.
    #[error("{steps} steps end at t = {t}: no more are allowed")]
    TooManySteps {
        /// Time reached.
        t: f64,
        /// Steps tried.
        steps: usize,
    },
}
