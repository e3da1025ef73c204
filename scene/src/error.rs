//! What can be wrong with a scene, and what can fail in computing it.

/// Everything that this crate can refuse or fail at, with the offending numbers.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// A gap that is not a positive finite number: the spheres overlap or touch.
    #[error("gap {eps} is not allowed: the gap between the spheres must be positive and finite")]
    InvalidGap {
        /// The gap, in sphere radii.
        eps: f64,
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
    /// More squirming modes than the model holds.
    #[error("{modes} squirming modes are too many: at most {allowed} are allowed")]
    TooManyModes {
        /// Modes asked for.
        modes: usize,
        /// Modes allowed.
        allowed: usize,
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
