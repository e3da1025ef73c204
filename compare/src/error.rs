//! The errors of this crate, and which of them the user can correct.

use std::path::PathBuf;

use scene::SceneError;

use crate::submission::shown;

/// Longest value in a message, in bytes.
const LONGEST: usize = 300;

/// Kinds of failures: who can correct them, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FailureKind {
    /// Bad input, or a place that can't be written to.
    Input,
    /// The computation failed, or broke a bound.
    Computation,
    /// The time limit stopped the command. The same command continues it.
    Stopped,
    /// An interrupt stopped the command. The same command continues it.
    Interrupted,
}

/// Everything that can make a command fail, with its message.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// A value on the command line that is not allowed.
    #[error("{what} '{value}' is not allowed: {allowed}")]
    Input {
        /// The option.
        what: &'static str,
        /// The value that was given.
        value: String,
        /// The values that are allowed.
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
    /// The command would delete the results of an interrupted command.
    #[error(
        "'{path}' keeps {pieces} finished pieces of another sweep, which was interrupted: repeat the command of that \
         sweep, give another folder by --out, or delete the file by --fresh"
    )]
    OtherSweep {
        /// The file.
        path: PathBuf,
        /// Number of finished pieces in the file.
        pieces: usize,
    },
    /// A share of a sweep that can't be merged with the others.
    #[error("'{path}': {reason}")]
    Share {
        /// The folder or file of the share.
        path: PathBuf,
        /// The reason why it cannot be merged.
        reason: String,
    },
    /// Some runs failed. All other results are written.
    #[error("{failed} of the runs failed")]
    RunsFailed {
        /// Number of failed runs.
        failed: usize,
    },
    /// Runs were left out at the time limit.
    #[error("stopped by --time-limit: {skipped} of the runs or lines are left out")]
    Stopped {
        /// Number of runs, or of lines of a map, that were left out.
        skipped: usize,
    },
    /// The command was interrupted in a sweep, whose finished pieces are kept.
    #[error(
        "interrupted: {left} of {pieces} {what} are left; the same command continues from '{path}'"
    )]
    Interrupted {
        /// Number of pieces that are not finished.
        left: usize,
        /// Number of all pieces.
        pieces: usize,
        /// Name of the pieces.
        what: &'static str,
        /// The file that keeps the finished pieces.
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
    /// Mistakes in a scene file, one per line.
    #[error("mistakes in '{path}' (line:column: key):\n{mistakes}")]
    SceneFile {
        /// The file.
        path: PathBuf,
        /// The mistakes.
        mistakes: crate::Mistakes,
    },
    /// A point of a family whose scene is not valid.
    #[error("a point of the family is not a valid scene (line:column: key):\n{0}")]
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
    /// Some hard cases break their bounds.
    #[error("{broken} of {bounds} bounds are broken")]
    BoundsBroken {
        /// Number of broken bounds.
        broken: usize,
        /// Number of all bounds.
        bounds: usize,
    },
}

impl CompareError {
    /// A value that is not allowed. Of a long one the message has the beginning.
    #[must_use]
    pub fn input(what: &'static str, value: impl ToString, allowed: impl Into<String>) -> Self {
        Self::Input {
            what,
            value: shown(&value.to_string(), LONGEST),
            allowed: allowed.into(),
        }
    }

    /// The message without a heading; of several mistakes in a scene the first one.
    #[must_use]
    pub fn in_one_line(&self) -> String {
        let message = match self {
            Self::FamilyPoint(mistakes) => mistakes.to_string(),
            error => error.to_string(),
        };
        message.lines().next().unwrap_or_default().to_owned()
    }

    /// The kind of this failure.
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
