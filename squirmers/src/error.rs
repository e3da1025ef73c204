//! The errors of a command, and its exit status.

use compare::{CompareError, FailureKind};
use scene::SceneError;

use crate::figures::FigureError;

/// Exit status of a command that the time limit stopped. This is the usual status (EX_TEMPFAIL) of a failure that
/// ends after the command is repeated.
const STOPPED: u8 = 75;

/// Exit status of a command that was interrupted.
pub(crate) const INTERRUPTED: u8 = 130;

/// Everything that can make a command fail, with its message.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CommandError {
    /// A computation or the writing of its results failed.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// A picture could not be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// A table of the page could not be made.
    #[error("table cannot be made: {0}")]
    Table(#[from] csv::Error),
}

impl From<SceneError> for CommandError {
    fn from(error: SceneError) -> Self {
        Self::Compare(error.into())
    }
}

impl From<bem::BemError> for CommandError {
    fn from(error: bem::BemError) -> Self {
        Self::Compare(error.into())
    }
}

impl CommandError {
    /// A value on the command line that is not allowed.
    pub(crate) fn input(
        what: &'static str,
        value: impl ToString,
        allowed: impl Into<String>,
    ) -> Self {
        CompareError::input(what, value, allowed).into()
    }

    /// Exit status of the command: 2 for bad input or a bad output place, 75 if the time limit stopped the command, 130
    /// if an interrupt stopped it, 1 if the computation failed.
    pub(crate) fn exit_status(&self) -> u8 {
        let Self::Compare(error) = self else {
            return 1;
        };
        match error.kind() {
            FailureKind::Input => 2,
            FailureKind::Computation => 1,
            FailureKind::Stopped => STOPPED,
            FailureKind::Interrupted => INTERRUPTED,
        }
    }
}
