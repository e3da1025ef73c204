//! How to run a scene, and what comes of it.

use super::outcome::Outcome;
use crate::SceneError;
use crate::frame::Configuration;

/// Most samples of a run.
const MOST_SAMPLES: f64 = 1e7;

/// How to run a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunOptions {
    /// Tolerance of the stepper per step, absolute and relative, in radii and radians.
    pub tolerance: f64,
    /// Time at which a run ends at the latest, in units of `a/V_s`.
    pub end_time: f64,
    /// Distance of the centres, in radii of the larger squirmer, at which a receding pair has parted, where the model has
    /// no cut and gravity does not act.
    pub departure_distance: f64,
    /// Distance of the centres, in radii of the larger squirmer, at which the angles of a pair are read that has parted without gravity: infinity,
    /// or wherever it has parted if that is further out. The outcome and the end of the run do not depend on it.
    pub angles_at: f64,
    /// Time between recorded samples; none are recorded without it.
    pub sample_interval: Option<f64>,
    /// Steps, accepted and rejected, after which a run is given up; also the most contacts and flights.
    pub max_steps: usize,
}

impl Default for RunOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            end_time: 200.0,
            departure_distance: 12.0,
            angles_at: f64::INFINITY,
            sample_interval: None,
            max_steps: 1_000_000,
        }
    }
}

impl RunOptions {
    /// Refuses options with which no run can begin or end.
    pub(super) fn check(&self) -> Result<(), SceneError> {
        let interval = self.sample_interval.unwrap_or(self.end_time);
        for (what, value) in [
            ("tolerance", self.tolerance),
            ("end time", self.end_time),
            ("sample interval", interval),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SceneError::NotPositive { what, value });
            }
        }
        for (what, distance) in [
            ("departure distance", self.departure_distance),
            ("distance at which angles are read", self.angles_at),
        ] {
            if distance.is_nan() || distance <= 2.0 {
                return Err(SceneError::NotApart { what, distance });
            }
        }
        let samples = self.end_time / interval;
        if samples > MOST_SAMPLES {
            return Err(SceneError::TooManySamples {
                samples,
                allowed: MOST_SAMPLES,
            });
        }
        Ok(())
    }
}

/// A configuration on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time, in units of `a/V_s`.
    pub t: f64,
    /// The pair at that time.
    pub configuration: Configuration,
}

/// What a run cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Loads asked of the model, one for each right-hand side.
    pub loads: u64,
    /// Free flights jumped over in closed form.
    pub flights: u64,
}

/// A run from start to end.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The start.
    pub start: Configuration,
    /// The end.
    pub end: Configuration,
    /// Where the angles are read: far out, turned by all that is still to come, if the pair parted without gravity under a
    /// model without a cut ([`RunOptions::angles_at`]); the end otherwise.
    pub outgoing: Configuration,
    /// Estimate of how far the directions in [`Self::outgoing`] are from their limit at infinity, in radians; infinite if
    /// the pair does not recede for good. Zero where nothing is cut off.
    pub truncation_rad: f64,
    /// Time at the end.
    pub end_time: f64,
    /// Smallest gap on the way, in radii of the first squirmer.
    pub min_gap: f64,
    /// Time spent at gaps up to the smaller radius: the paper's duration of the interaction, tau.
    pub contact_time: f64,
    /// What became of the pair.
    pub outcome: Outcome,
    /// Time from which on the pair was in a steady bound state, and the rest known in closed form.
    pub settled: Option<f64>,
    /// Largest departure from unit length of the vectors that were integrated: line of centres and
    /// orientations in three dimensions, which are read as directions. Angles have none.
    pub unit_drift: f64,
    /// What it cost.
    pub counters: Counters,
    /// Samples at multiples of the sample interval, with start, end and changes of phase.
    pub samples: Vec<Sample>,
}

impl Run {
    /// Outgoing minus incoming angle of each squirmer's orientation, projected on the x-y plane,
    /// in radians, anticlockwise positive; it winds. Outgoing is as `t` goes to infinity if the pair parts without
    /// gravity, otherwise at the end of the run. A run that ends in contact, or where its model ceases to resolve the gap, has no
    /// outgoing angle: NaN.
    #[must_use]
    pub fn deflections_rad(&self) -> [f64; 2] {
        if self.has_outgoing_angles() {
            [0, 1].map(|k| self.outgoing.angles_rad[k] - self.start.angles_rad[k])
        } else {
            [f64::NAN; 2]
        }
    }

    /// Whether the run ends with directions that mean something: not in contact, and not where its model ceases to
    /// resolve the gap.
    #[must_use]
    pub fn has_outgoing_angles(&self) -> bool {
        !matches!(self.outcome, Outcome::Contact | Outcome::Unresolved)
    }
}
