//! What can be wrong with a scene, and what can fail in computing it.

use crate::LoadSet;

/// Everything that this crate can refuse or fail at, with the offending numbers.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// A gap that is not a positive finite number: the spheres overlap or touch.
    #[error("gap {eps:?} is not allowed: the gap between the spheres must be positive and finite")]
    InvalidGap {
        /// The gap, in sphere radii.
        eps: f64,
    },
    /// A number that must be finite and is not.
    #[error("{what} {value:?} is not allowed: it must be a finite number")]
    NotFinite {
        /// What the number is.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// A number that must be positive and is not.
    #[error("{what} {value:?} is not allowed: it must be positive")]
    NotPositive {
        /// What the number is.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// Centres so far apart that squares of their distance are no numbers.
    #[error("centres {distance:?} radii apart are not allowed: at most {allowed:?}")]
    TooFar {
        /// Distance along an axis, in sphere radii.
        distance: f64,
        /// Largest allowed.
        allowed: f64,
    },
    /// A distance of the centres at which the spheres would overlap or touch.
    #[error("{what} {distance:?} is not allowed: it must be greater than 2 (radii)")]
    NotApart {
        /// What the distance is.
        what: &'static str,
        /// The distance, in sphere radii.
        distance: f64,
    },
    /// A vector that must have a direction and has none.
    #[error("{what} {vector:?} is not allowed: the vector must be finite and not zero")]
    NoDirection {
        /// What the vector is.
        what: &'static str,
        /// The vector.
        vector: [f64; 3],
    },
    /// A gap outside the range of a hydrodynamic model.
    #[error("gap {eps:e} is outside the model's range {smallest:e} to {largest:e}")]
    GapOutsideRange {
        /// The gap, in sphere radii.
        eps: f64,
        /// Smallest gap allowed.
        smallest: f64,
        /// Largest gap allowed.
        largest: f64,
    },
    /// More squirming or swirl modes than loads hold.
    #[error("{modes} slip modes are too many: at most {allowed} are allowed")]
    TooManyModes {
        /// Modes asked for.
        modes: usize,
        /// Modes allowed.
        allowed: usize,
    },
    /// Loads that a table does not hold.
    #[error("a table of {held} was asked for {asked}")]
    LoadsNotHeld {
        /// The loads asked for.
        asked: LoadSet,
        /// The loads held.
        held: LoadSet,
    },
    /// A sample interval that calls for too many samples.
    #[error("{samples:e} samples are too many: at most {allowed:e} are allowed")]
    TooManySamples {
        /// Samples asked for.
        samples: f64,
        /// Samples allowed.
        allowed: f64,
    },
    /// The integration of a trajectory failed.
    #[error("trajectory: {reason}")]
    Stepper {
        /// The stepper's reason, one line.
        reason: String,
    },
    /// A model failed for a reason of its own.
    #[error("{model}: {reason}")]
    Model {
        /// The model's name.
        model: &'static str,
        /// Its reason, one line.
        reason: String,
    },
}
