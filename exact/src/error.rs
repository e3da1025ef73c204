//! What the crate can refuse or fail at.

use scene::{LoadSet, MAX_MODES, RATIOS, SceneError};

/// Everything that this crate can refuse or fail at, with the offending numbers. Later versions may add variants.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExactError {
    /// A factor on the number of terms outside the allowed interval.
    #[error("factor {factor} on the number of terms is not allowed: it must lie in [0.25, 16]")]
    InvalidTermsFactor {
        /// The factor.
        factor: f64,
    },
    /// A radius ratio outside the allowed interval.
    #[error(
        "radius ratio {ratio} is not allowed: it must lie in [{}, {}]",
        RATIOS.start(),
        RATIOS.end()
    )]
    InvalidRatio {
        /// Radius of sphere 2 over that of sphere 1.
        ratio: f64,
    },
    /// The series would need more terms than is sensible; the near-contact form serves there.
    #[error("the series needs {terms} terms at gap {eps:e}: at most {allowed} are allowed")]
    TooManyTerms {
        /// The gap, in sphere radii.
        eps: f64,
        /// Terms that the series would need.
        terms: usize,
        /// Terms allowed.
        allowed: usize,
    },
    /// More squirming or swirl modes than [`scene::PairLoads`] holds.
    #[error("{modes} slip modes are too many: at most {allowed} are allowed")]
    TooManyModes {
        /// Modes asked for.
        modes: usize,
        /// Modes allowed.
        allowed: usize,
    },
    /// A gap that is not positive and finite was given to the series.
    #[error("gap {eps:e} is not allowed: the series needs a positive finite gap")]
    InvalidGap {
        /// The gap, in sphere radii.
        eps: f64,
    },
    /// A banded system lost its pivot: its unknown `row` cannot be determined.
    #[error("the banded system of {size} unknowns is singular at row {row}")]
    Singular {
        /// Row without a pivot.
        row: usize,
        /// Number of unknowns.
        size: usize,
    },
    /// The least squares for the near-contact constants has dependent columns.
    #[error("the near-contact fit over {gaps} gaps is singular")]
    SingularFit {
        /// Number of gaps fitted.
        gaps: usize,
    },
}

impl From<ExactError> for SceneError {
    fn from(error: ExactError) -> Self {
        match error {
            ExactError::TooManyModes { modes, allowed } => Self::TooManyModes { modes, allowed },
            other => Self::from_model("exact", other),
        }
    }
}

/// Refuses a set with more modes than loads hold.
pub fn check(set: LoadSet) -> Result<(), ExactError> {
    let modes = set.modes.max(set.swirl);
    if modes > MAX_MODES {
        return Err(ExactError::TooManyModes {
            modes,
            allowed: MAX_MODES,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::error::Error;

    #[test]
    fn a_scene_that_the_series_fail_in_names_their_error_as_its_cause() {
        let cause = ExactError::SingularFit { gaps: 3 };
        let error = SceneError::from(cause.clone());
        assert_eq!(error.to_string(), format!("exact: {cause}"));
        let source = error.source().and_then(<dyn Error>::downcast_ref);
        assert_eq!(source, Some(&cause));
    }
}
