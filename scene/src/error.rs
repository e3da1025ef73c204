//! What can be wrong with a scene, and what can fail in computing it.

use std::error::Error;
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use crate::LoadSet;
use crate::ode::OdeError;

/// Everything that this crate can refuse or fail at, with the offending numbers. Later versions may add variants.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
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
    /// A radius that no model answers for.
    #[error(
        "radius {radius:?} is not allowed: {smallest:?} to {largest:?} times that of the first squirmer"
    )]
    Radius {
        /// The radius.
        radius: f64,
        /// Smallest allowed.
        smallest: f64,
        /// Largest allowed.
        largest: f64,
    },
    /// A first squirmer whose radius is not the unit of length.
    #[error("radius {radius:?} of the first squirmer is not allowed: it is the unit of length, 1")]
    FirstRadius {
        /// The radius.
        radius: f64,
    },
    /// A model of a pair of other radii than the scene's.
    #[error("a model for radii in the ratio {model:?} cannot answer for the ratio {asked:?}")]
    OtherRatio {
        /// Radius of sphere 2 over that of sphere 1 that the model is for.
        model: f64,
        /// The ratio asked for.
        asked: f64,
    },
    /// A change of the radii where only models of one ratio are at hand.
    #[error("how the motion changes with the radii is not known from a model of one ratio of them")]
    NoRatios,
    /// Centres so far apart that squares of their distance are no numbers.
    #[error("centres {distance:?} radii apart are not allowed: at most {allowed:?}")]
    TooFar {
        /// Distance along an axis, in sphere radii.
        distance: f64,
        /// Largest allowed.
        allowed: f64,
    },
    /// A distance of the centres at which the spheres would overlap or touch.
    #[error(
        "{what} {distance:?} is not allowed: it must be greater than 2 (radii, of the larger squirmer)"
    )]
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
    #[error("trajectory: {source}")]
    Stepper {
        /// What the stepper reports.
        source: OdeError,
    },
    /// Contacts and free flights alternate without end.
    #[error("trajectory: no end to contacts and flights at t = {t}")]
    TooManyPhases {
        /// Contacts and flights so far.
        phases: usize,
        /// Time reached, in units of `a/V_s`.
        t: f64,
    },
    /// A free flight so far that rounding of the positions is as large as the distance of the centres.
    #[error(
        "a free flight to {reach:e} radii from the origin leaves no digits of the distance of the centres, about {distance:e}: let it be shorter"
    )]
    LostDistance {
        /// Distance of the farther squirmer from the origin, in sphere radii.
        reach: f64,
        /// Distance of the centres that rounding leaves, in sphere radii.
        distance: f64,
    },
    /// A free flight under gravity whose end is not found.
    #[error("trajectory: {advances} advances of a free flight end {t} after its start")]
    TooManyAdvances {
        /// Advances towards the next contact.
        advances: usize,
        /// Time since the start of the flight, in units of `a/V_s`.
        t: f64,
    },
    /// A model failed for a reason of its own: [`SceneError::from_model`].
    #[error("{model}: {source}")]
    Model {
        /// The model's name.
        model: &'static str,
        /// The model's own error.
        source: ModelFailure,
    },
}

impl SceneError {
    /// The error `cause` of a hydrodynamic model with the name `model`, which is kept whole:
    /// [`Error::source`] hands it back.
    pub fn from_model(model: &'static str, cause: impl Error + Send + Sync + 'static) -> Self {
        Self::Model {
            model,
            source: ModelFailure::new(cause),
        }
    }
}

/// An error of any type that a hydrodynamic model reports. Two of them are equal if they print alike.
#[derive(Clone, Debug)]
pub struct ModelFailure(Arc<dyn Error + Send + Sync>);

impl ModelFailure {
    /// Keeps `cause` whole.
    pub fn new(cause: impl Error + Send + Sync + 'static) -> Self {
        Self(Arc::new(cause))
    }
}

impl Deref for ModelFailure {
    type Target = dyn Error + Send + Sync;

    fn deref(&self) -> &Self::Target {
        self.0.as_ref()
    }
}

impl fmt::Display for ModelFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl PartialEq for ModelFailure {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_string() == other.0.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Isolated, Pose, Repulsion, RunOptions, Scene, Squirmer, run};

    #[test]
    fn a_failed_trajectory_names_the_error_of_the_stepper_as_its_cause() {
        let squirmers = [Squirmer::with_beta(1.0, 0.0).unwrap(); 2];
        let start = [Pose::planar(-1.5, 0.0, 0.0), Pose::planar(1.5, 0.0, 180.0)];
        let scene = Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap();
        let options = RunOptions {
            max_steps: 2,
            ..RunOptions::default()
        };
        let error = run(&scene, &Isolated::EQUAL, &options).unwrap_err();
        let source = error.source().and_then(<dyn Error>::downcast_ref);
        let Some(cause @ OdeError::TooManySteps { steps: 2, .. }) = source else {
            panic!("{error:?}");
        };
        assert_eq!(error.to_string(), format!("trajectory: {cause}"));
    }

    #[test]
    fn the_error_of_a_model_is_kept_whole_as_the_cause() {
        let cause = SceneError::InvalidGap { eps: -1.0 };
        let error = SceneError::from_model("mine", cause.clone());
        assert_eq!(error.to_string(), format!("mine: {cause}"));
        let source = error.source().and_then(<dyn Error>::downcast_ref);
        assert_eq!(source, Some(&cause));
        assert_eq!(error, SceneError::from_model("mine", cause));
        let other = SceneError::InvalidGap { eps: -2.0 };
        assert_ne!(error, SceneError::from_model("mine", other));
    }
}
