//! Options of runs, checked.

use std::time::Duration;

use crate::numbers::written;
use crate::{CompareError, Method};

/// The tolerance of the integrator, if it is allowed.
///
/// # Errors
/// [`CompareError::Input`] unless it is from 1e-14 to 1e-2.
pub fn checked_tolerance(tolerance: f64) -> Result<f64, CompareError> {
    if !(1e-14..=1e-2).contains(&tolerance) {
        let allowed = "give a number from 1e-14 to 1e-2";
        let value = format!("{tolerance:?}");
        return Err(CompareError::input("--tol", value, allowed));
    }
    Ok(tolerance)
}

/// The distance of the centres at which angles are read, if it is allowed. All methods must have loads there.
///
/// # Errors
/// [`CompareError::Input`] for a distance that is not greater than 2, and for one beyond the range of a method.
pub fn checked_angles_at(angles_at: f64, methods: &[Method]) -> Result<f64, CompareError> {
    for method in methods {
        let farthest = 2.0 + method.largest_gap();
        if angles_at > farthest {
            let allowed = format!(
                "{method} has no loads at larger gaps: give a distance of the centres up to {}",
                written(farthest)
            );
            return Err(CompareError::input("--departure", angles_at, allowed));
        }
    }
    if angles_at.is_nan() || angles_at <= 2.0 {
        let allowed = "give a distance of the centres greater than 2 (radii), or inf";
        let value = format!("{angles_at:?}");
        return Err(CompareError::input("--departure", value, allowed));
    }
    Ok(angles_at)
}

/// The time limit, if it is allowed.
///
/// # Errors
/// [`CompareError::Input`] for what is no number of seconds, 0 or more.
pub fn checked_time_limit(seconds: Option<f64>) -> Result<Option<Duration>, CompareError> {
    let limit = seconds.map(|seconds| {
        let allowed = "give a number of seconds, 0 or more";
        Duration::try_from_secs_f64(seconds)
            .map_err(|_| CompareError::input("--time-limit", seconds, allowed))
    });
    limit.transpose()
}

#[cfg(test)]
mod tests;
