//! What became of an encounter.

use std::fmt;

use super::coordinates::Configuration;

/// Outcome of an encounter, after the paper's Fig. 1(c).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// I: the squirmers parted.
    Scattered,
    /// II: bound and at rest, facing each other.
    Standoff,
    /// III: bound, swimming together along a line.
    Pairwise,
    /// IV: bound, orbiting anticlockwise.
    Anticlockwise,
    /// V: bound, orbiting clockwise.
    Clockwise,
    /// Neither parted nor settled when the run ended.
    Undecided,
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Scattered => "scattered",
            Self::Standoff => "standoff",
            Self::Pairwise => "pairwise",
            Self::Anticlockwise => "anticlockwise",
            Self::Clockwise => "clockwise",
            Self::Undecided => "undecided",
        })
    }
}

/// Turning of the line of centres over the last quarter of a run, in radians, from which on a
/// bound pair is said to orbit. Slower turning is the residue of an approach to a steady state.
const ORBIT_ANGLE: f64 = 0.5;

/// Speed of the midpoint, relative to the swimming speed, from which on a bound pair is said to
/// swim; a standoff's midpoint moves by rounding only.
const DRIFT_SPEED: f64 = 1e-3;

/// Change of `ln eps` over the last quarter of a run up to which a pair that does not orbit has
/// settled.
const SETTLED: f64 = 0.1;

/// Rate of turning, in radians, and speed, in `V_s`, up to which a steady pair is at rest: far above
/// rounding, far below any pair that moves.
const AT_REST: f64 = 1e-7;

/// Judges a pair in a steady state from two configurations, `duration` apart.
pub(crate) fn judge_steady(earlier: &Configuration, end: &Configuration, duration: f64) -> Outcome {
    let turning = (end.line_angle - earlier.line_angle) / duration;
    let speed = (end.midpoint - earlier.midpoint).norm() / duration;
    if turning > AT_REST {
        Outcome::Anticlockwise
    } else if turning < -AT_REST {
        Outcome::Clockwise
    } else if speed > AT_REST {
        Outcome::Pairwise
    } else {
        Outcome::Standoff
    }
}

/// Judges a pair that has not parted, from a configuration `earlier` and the one at the end,
/// `duration` apart.
pub(crate) fn judge_bound(
    earlier: &Configuration,
    end: &Configuration,
    duration: f64,
    speed: f64,
) -> Outcome {
    let turned = end.line_angle - earlier.line_angle;
    let drift = (end.midpoint - earlier.midpoint).norm();
    if end.gap.eps() > 1.0 {
        Outcome::Undecided
    } else if turned.abs() > ORBIT_ANGLE {
        if turned > 0.0 {
            Outcome::Anticlockwise
        } else {
            Outcome::Clockwise
        }
    } else if (end.gap.ln() - earlier.gap.ln()).abs() > SETTLED {
        Outcome::Undecided
    } else if drift > DRIFT_SPEED * speed * duration {
        Outcome::Pairwise
    } else {
        Outcome::Standoff
    }
}
