//! What became of an encounter.

use std::fmt;

use super::coordinates::Configuration;
use crate::Gravity;

/// Outcome of an encounter, after the paper's Fig. 1(c), and under gravity after its Fig. 8.
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
    /// Neither parted nor settled when the run ended: on the way, or held up for long by a state
    /// that it will leave.
    Undecided,
    /// Under gravity: both point upward at the end, parted or side by side.
    Upward,
    /// Under gravity: bound, the gap opening and closing again and again.
    Oscillating,
    /// Under gravity: bound, the pair swimming downward at the end.
    Downward,
}

impl Outcome {
    /// All outcomes.
    pub const ALL: [Self; 9] = [
        Self::Scattered,
        Self::Standoff,
        Self::Pairwise,
        Self::Anticlockwise,
        Self::Clockwise,
        Self::Undecided,
        Self::Upward,
        Self::Oscillating,
        Self::Downward,
    ];
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
            Self::Upward => "upward",
            Self::Oscillating => "oscillating",
            Self::Downward => "downward",
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
pub(crate) const AT_REST: f64 = 1e-7;

/// Judges a pair in a steady state from two configurations, `duration` apart.
pub(crate) fn judge_steady(earlier: &Configuration, end: &Configuration, duration: f64) -> Outcome {
    let turning = (end.line_angle - earlier.line_angle) / duration;
    let speed = (end.midpoint - earlier.midpoint).norm() / duration;
    judge_rates(turning, speed)
}

/// Judges a steady pair from the rate at which its line of centres turns, anticlockwise, and the speed of
/// its midpoint.
pub(crate) fn judge_rates(turning: f64, speed: f64) -> Outcome {
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

/// What the gap did over the last quarter of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GapHistory {
    /// Smallest `ln eps`.
    pub least: f64,
    /// Largest `ln eps`.
    pub most: f64,
    /// How often the gap went from closing to opening.
    pub minima: usize,
}

impl GapHistory {
    /// A history that begins at a gap.
    pub(crate) fn from(ln_gap: f64) -> Self {
        Self {
            least: ln_gap,
            most: ln_gap,
            minima: 0,
        }
    }

    /// Takes in a further gap.
    pub(crate) fn take(&mut self, ln_gap: f64) {
        self.least = self.least.min(ln_gap);
        self.most = self.most.max(ln_gap);
    }
}

/// Turning of the line of centres over the last quarter of a run, in radians, from which on a pair
/// under gravity is said to orbit: a whole turn, for a pair that rights itself turns by less.
const DRIFTING_ORBIT_ANGLE: f64 = std::f64::consts::TAU;

/// Gap up to which a pair under gravity counts as bound: its members may leave contact (`eps > 1`)
/// for a moment and be turned back.
const BOUND_GAP: f64 = 1.5;

/// Cosine between an orientation and the upward direction from which on a squirmer points upward. Bound
/// squirmers that swim up are splayed or inclined to each other.
const UPWARD: f64 = 0.5;

/// Minima of the gap over the last quarter of a run from which on it oscillates.
const OSCILLATIONS: usize = 2;

/// Judges a pair under gravity from a configuration `earlier` and the one at the end, `duration` apart,
/// and what the gap did in between.
pub(crate) fn judge_under_gravity(
    earlier: &Configuration,
    end: &Configuration,
    duration: f64,
    speed: f64,
    gap: &GapHistory,
    gravity: Gravity,
) -> Outcome {
    let down = gravity.direction();
    let bound = gap.most <= BOUND_GAP.ln();
    let turned = end.line_angle - earlier.line_angle;
    if bound && turned.abs() > DRIFTING_ORBIT_ANGLE {
        return if turned > 0.0 {
            Outcome::Anticlockwise
        } else {
            Outcome::Clockwise
        };
    }
    let oscillates = gap.minima >= OSCILLATIONS && gap.most - gap.least > SETTLED;
    if bound && oscillates {
        return Outcome::Oscillating;
    }
    let sinking = (end.midpoint - earlier.midpoint).dot(&down);
    if bound && sinking > DRIFT_SPEED * speed * duration {
        Outcome::Downward
    } else if points_upward(end, gravity) {
        Outcome::Upward
    } else if bound {
        judge_bound(earlier, end, duration, speed)
    } else if end.gap.eps() > 1.0 {
        Outcome::Scattered
    } else {
        Outcome::Undecided
    }
}

/// Whether both squirmers point upward.
pub(crate) fn points_upward(end: &Configuration, gravity: Gravity) -> bool {
    (end.orientations.iter()).all(|p| -p.dot(&gravity.direction()) > UPWARD)
}
