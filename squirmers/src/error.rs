//! What a command can fail at, and its exit status.

use compare::{CompareError, FailureKind};
use scene::SceneError;

use crate::figures::FigureError;
use crate::interrupt;

/// Exit status of a command that the time limit stopped: that for failures which go away when one tries again.
const STOPPED: u8 = 75;

/// Everything that a command can refuse or fail at, each one line.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CommandError {
    /// What it computes or writes failed.
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

    /// Exit status of the command: 2 for bad input or a bad output place, 75 where the time limit stopped it, 130
    /// where an interrupt did, 1 for a failure of the computation.
    pub(crate) fn exit_status(&self) -> u8 {
        let Self::Compare(error) = self else {
            return 1;
        };
        match error.kind() {
            FailureKind::Input => 2,
            FailureKind::Computation => 1,
            FailureKind::Stopped => STOPPED,
            FailureKind::Interrupted => interrupt::STATUS,
        }
    }
}
