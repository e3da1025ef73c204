//! What became of an encounter.

use std::fmt;

use crate::frame::Configuration;
use crate::{Gravity, Squirmer};

/// Outcome of an encounter, after the paper's Fig. 1(c), and under gravity after its Fig. 8.
///
/// It goes by the motion up to the end of the run, which is where the pair parts, touches or settles, or where
/// its time is up. Gaps are in sphere radii.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// I: the squirmers parted. They recede from each other beyond the distance at which a run ends, or fly straight
    /// and recede where nothing acts between them. Under gravity: they are apart (gap above 1) at the end of the
    /// run, and gravity has not righted both.
    Scattered,
    /// II: bound and at rest: at a gap up to 1 neither the pair nor its line of centres moves.
    Standoff,
    /// III: bound, swimming together along a line at a gap up to 1.
    Pairwise,
    /// IV: bound, the line of centres turning anticlockwise for ever.
    Anticlockwise,
    /// V: bound, the line of centres turning clockwise for ever.
    Clockwise,
    /// Neither parted nor settled when the run ended: still approaching, side by side at a gap above 1, or delayed
    /// for long by a state that the pair will leave.
    Undecided,
    /// Under gravity: gravity turns both squirmers, and both point within 60 degrees of upward at the end, parted or
    /// side by side; or a bound pair that rises.
    Upward,
    /// Under gravity: bound, the gap opening and closing again and again, or the line of centres swinging
    /// to and fro.
    Oscillating,
    /// Under gravity: bound, the pair swimming downward at the end.
    Downward,
    /// The spheres touch: nothing keeps them apart. The run ends there.
    Contact,
    /// The gap closed to the smallest that the model resolves: what becomes of the pair it cannot tell. The run
    /// ends there.
    Unresolved,
}

impl Outcome {
    /// All outcomes.
    pub const ALL: [Self; 11] = [
        Self::Scattered,
        Self::Standoff,
        Self::Pairwise,
        Self::Anticlockwise,
        Self::Clockwise,
        Self::Undecided,
        Self::Upward,
        Self::Oscillating,
        Self::Downward,
        Self::Contact,
        Self::Unresolved,
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
            Self::Contact => "contact",
            Self::Unresolved => "unresolved",
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
    let turning = (end.line_angle_rad - earlier.line_angle_rad) / duration;
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
    let turned = end.line_angle_rad - earlier.line_angle_rad;
    let drift = (end.midpoint - earlier.midpoint).norm();
    if end.gap.eps() > end.smaller_radius() {
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

/// Gap up to which a pair under gravity counts as bound: its members may leave contact (`eps > 1`)
/// for a moment and be turned back.
const BOUND_GAP: f64 = 1.5;

/// Angle, in radians, by which the line of centres has to go back before it is said to have reversed.
const REVERSAL: f64 = ORBIT_ANGLE;

/// Turning of the line of centres since its last reversal, in radians, from which on a pair under gravity
/// is said to orbit: a whole turn, for a pair that rights itself turns by less.
const DRIFTING_ORBIT_ANGLE: f64 = std::f64::consts::TAU;

/// Turning of the line of centres over the last quarter of a run, in radians, up to which a pair under
/// gravity keeps its direction. One that turns further is on its way to something else: a dive may be the
/// lower end of a slow swing.
const STILL: f64 = 0.1;

/// Cosine between an orientation and the upward direction from which on a squirmer points upward. Bound
/// squirmers that swim up are splayed or inclined to each other.
const UPWARD: f64 = 0.5;

/// Minima of the gap over the last quarter of a run, and swings of the line of centres since the pair was
/// bound, from which on it oscillates.
const OSCILLATIONS: usize = 2;

/// How the line of centres has turned since a pair under gravity was bound. Orbits take up to a third
/// of a run for one turn, and pairs that swing to and fro longer than that for one swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LineHistory {
    /// Where the line was when it last reversed, or at first.
    from: f64,
    /// How far it has come since.
    reach: f64,
    /// Swings that ended in a reversal, and the longest of them, in radians.
    swings: usize,
    longest: f64,
}

impl LineHistory {
    /// A history that begins at an angle of the line.
    fn new(angle: f64) -> Self {
        Self {
            from: angle,
            reach: angle,
            swings: 0,
            longest: 0.0,
        }
    }

    /// Takes in a further configuration; a pair that is not bound has no history.
    pub(crate) fn follow(history: Option<Self>, now: &Configuration) -> Option<Self> {
        if now.gap.eps() > BOUND_GAP * now.smaller_radius() {
            return None;
        }
        let mut history = history.unwrap_or(Self::new(now.line_angle_rad));
        history.take(now.line_angle_rad);
        Some(history)
    }

    fn take(&mut self, angle: f64) {
        if (angle - self.reach) * self.turned() >= 0.0 {
            self.reach = angle;
        } else if (angle - self.reach).abs() > REVERSAL {
            let swing = self.turned().abs();
            if swing > REVERSAL {
                self.swings += 1;
                self.longest = self.longest.max(swing);
            }
            self.from = self.reach;
            self.reach = angle;
        }
    }

    /// Angle turned through since the last reversal.
    fn turned(&self) -> f64 {
        self.reach - self.from
    }

    /// Whether the line goes round and round, not to and fro.
    fn orbits(&self) -> bool {
        self.turned().abs() > self.longest.max(DRIFTING_ORBIT_ANGLE)
    }
}

/// Gravity as it rights a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Righting {
    /// The gravity that acts.
    pub gravity: Gravity,
    /// Whether it turns both squirmers upward: both swim and are bottom-heavy.
    pub both: bool,
}

impl Righting {
    /// The gravity that acts on two squirmers.
    pub(crate) fn new(gravity: Gravity, squirmers: &[Squirmer; 2]) -> Self {
        Self {
            gravity,
            both: squirmers.iter().all(|s| s.gravity_torque() > 0.0),
        }
    }

    /// Whether it has turned both squirmers upward.
    pub(crate) fn has_righted(&self, end: &Configuration) -> bool {
        let up = |p: &nalgebra::Vector3<f64>| -p.dot(&self.gravity.direction());
        self.both && end.orientations.iter().all(|p| up(p) > UPWARD)
    }
}

/// Judges a pair under gravity from a configuration `earlier` and the one at the end, `duration` apart,
/// what the gap did in between, and how the line of centres has turned since the pair was bound.
pub(crate) fn judge_under_gravity(
    (earlier, end): (&Configuration, &Configuration),
    duration: f64,
    speed: f64,
    gap: &GapHistory,
    line: Option<&LineHistory>,
    righting: &Righting,
) -> Outcome {
    let Some(line) = line.filter(|_| gap.most <= (BOUND_GAP * end.smaller_radius()).ln()) else {
        return if righting.has_righted(end) {
            Outcome::Upward
        } else if end.gap.eps() > end.smaller_radius() {
            Outcome::Scattered
        } else {
            Outcome::Undecided
        };
    };
    let turned = (end.line_angle_rad - earlier.line_angle_rad).abs();
    let gap_oscillates = gap.minima >= OSCILLATIONS && gap.most - gap.least > SETTLED;
    if turned > ORBIT_ANGLE && line.orbits() {
        return if line.turned() > 0.0 {
            Outcome::Anticlockwise
        } else {
            Outcome::Clockwise
        };
    }
    if gap_oscillates || (turned > STILL && line.swings >= OSCILLATIONS) {
        return Outcome::Oscillating;
    }
    if turned > STILL && end.gap.eps() <= end.smaller_radius() {
        return Outcome::Undecided;
    }
    let down = righting.gravity.direction();
    let sinking = (end.midpoint - earlier.midpoint).dot(&down);
    let least = DRIFT_SPEED * speed * duration;
    let both = |up: f64| (end.orientations.iter()).all(|p| up * p.dot(&down) < 0.0);
    if both(-1.0) && sinking > least {
        Outcome::Downward
    } else if righting.has_righted(end) || (both(1.0) && -sinking > least) {
        Outcome::Upward
    } else {
        judge_bound(earlier, end, duration, speed)
    }
}

#[cfg(test)]
mod tests;
