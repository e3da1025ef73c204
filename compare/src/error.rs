//! What can go wrong in comparing, and which of it is the user's to mend.

use std::path::PathBuf;

use scene::SceneError;

/// Kinds of failures: who can mend them, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FailureKind {
    /// Bad input, or a place that can't be written to.
    Input,
    /// The computation failed, or broke a bound.
    Computation,
    /// The time limit stopped it; the same again goes on.
    Stopped,
    /// An interrupt stopped it; the same again goes on.
    Interrupted,
}

/// Everything that a command can refuse or fail at, each one line.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// A value on the command line that is not allowed.
    #[error("{what} '{value}' is not allowed: {allowed}")]
    Input {
        /// The option.
        what: &'static str,
        /// What was given.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// The output folder or a file in it cannot be written.
    #[error("cannot write '{path}': {source}")]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Another process writes into the output folder.
    #[error(
        "another run writes into '{path}': wait until it is done, or give another folder by --out"
    )]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// What an interrupted command has left would be lost.
    #[error(
        "'{path}' keeps {chunks} finished pieces of another sweep, interrupted: go on with its own command, give \
         another folder by --out, or throw it away by --fresh"
    )]
    OtherSweep {
        /// The file.
        path: PathBuf,
        /// Finished pieces in it.
        chunks: usize,
    },
    /// A share of a sweep that can't be merged with the others.
    #[error("'{path}': {reason}")]
    Share {
        /// Its folder or file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Runs without a result; everything else is written.
    #[error("{failed} of the runs failed")]
    RunsFailed {
        /// Runs that failed.
        failed: usize,
    },
    /// Runs were left out at the time limit.
    #[error("stopped by --time-limit: {skipped} of the runs or lines are left out")]
    Stopped {
        /// Runs, or lines of a map, that were left out.
        skipped: usize,
    },
    /// The command was interrupted in a sweep, whose finished pieces are kept.
    #[error(
        "interrupted: {left} of {chunks} {what} are left; the same command goes on from '{path}'"
    )]
    Interrupted {
        /// Pieces that are left.
        left: usize,
        /// Pieces in all.
        chunks: usize,
        /// What the pieces are.
        what: &'static str,
        /// The file that keeps those finished.
        path: PathBuf,
    },
    /// A scene file cannot be read.
    #[error("cannot read '{path}': {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Mistakes in a scene file, one a line.
    #[error("mistakes in '{path}' (line:column: key):\n{mistakes}")]
    SceneFile {
        /// The file.
        path: PathBuf,
        /// The mistakes.
        mistakes: crate::Mistakes,
    },
    /// A point of a family that is no scene.
    #[error("a point of the family is no scene (line:column: key):\n{0}")]
    FamilyPoint(crate::Mistakes),
    /// A summary could not be turned into text.
    #[error("summary cannot be written: {0}")]
    Json(#[from] serde_json::Error),
    /// Rows could not be turned into text.
    #[error("rows cannot be written: {0}")]
    Rows(#[from] csv::Error),
    /// A scene, a model or a table failed.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The boundary-element method refused its parameters.
    #[error(transparent)]
    Bem(#[from] bem::BemError),
    /// The embedded cases do not parse.
    #[error("embedded cases: {0}")]
    Cases(#[from] toml::de::Error),
    /// Hard cases that do not keep their bounds.
    #[error("{broken} of {bounds} bounds are broken")]
    BoundsBroken {
        /// Bounds broken.
        broken: usize,
        /// Bounds in all.
        bounds: usize,
    },
}

impl CompareError {
    /// A value that is not allowed.
    #[must_use]
    pub fn input(what: &'static str, value: impl ToString, allowed: impl Into<String>) -> Self {
        Self::Input {
            what,
            value: value.to_string(),
            allowed: allowed.into(),
        }
    }

    /// What kind of failure it is.
    #[must_use]
    pub fn kind(&self) -> FailureKind {
        match self {
            Self::Input { .. }
            | Self::Read { .. }
            | Self::SceneFile { .. }
            | Self::FamilyPoint(_)
            | Self::Write { .. }
            | Self::Busy { .. }
            | Self::OtherSweep { .. }
            | Self::Share { .. }
            | Self::Bem(_) => FailureKind::Input,
            Self::Stopped { .. } => FailureKind::Stopped,
            Self::Interrupted { .. } => FailureKind::Interrupted,
            Self::Scene(
                SceneError::Stepper { .. }
                | SceneError::TooManyPhases { .. }
                | SceneError::TooManyAdvances { .. }
                | SceneError::Model { .. },
            ) => FailureKind::Computation,
            Self::Scene(_) => FailureKind::Input,
            Self::Rows(_)
            | Self::Json(_)
            | Self::Cases(_)
            | Self::RunsFailed { .. }
            | Self::BoundsBroken { .. } => FailureKind::Computation,
        }
    }
}
