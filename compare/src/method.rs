//! The ways in which loads are computed, by the names of the command line.

use std::fmt;

use bem::{Bem, BemError};
use scene::Gap;

/// A hydrodynamic method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Method {
    /// Lubrication theory as published.
    Lt,
    /// Lubrication theory with the axial squirming force corrected.
    LtCorrected,
    /// Bispherical series, to about ten digits: the referee.
    Exact,
    /// Boundary elements.
    Bem,
    /// No hydrodynamic interaction: in scene files only.
    Isolated,
}

impl Method {
    /// The methods that can be compared: those of the command line.
    pub const ALL: [Self; 4] = [Self::Lt, Self::LtCorrected, Self::Exact, Self::Bem];

    /// The methods that a command runs when none are named.
    pub const DEFAULT: [Self; 3] = [Self::Lt, Self::Exact, Self::Bem];

    /// Name on the command line and in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lt => "lt",
            Self::LtCorrected => "lt-corrected",
            Self::Exact => "exact",
            Self::Bem => "bem",
            Self::Isolated => "none",
        }
    }

    /// Refuses a gap for which the model has no answer: boundary elements of the refinement level `mesh` end at a
    /// smallest one.
    ///
    /// # Errors
    /// [`BemError::GapUnresolved`] with the level that would do; [`BemError::Level`] if there is no such level.
    pub fn check_gap(self, mesh: usize, gap: Gap) -> Result<(), BemError> {
        match self {
            Self::Bem => Bem::new(mesh)?.check(gap),
            Self::Lt | Self::LtCorrected | Self::Exact | Self::Isolated => Ok(()),
        }
    }

    /// Name in pictures.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Lt => "Lubrication theory",
            Self::LtCorrected => "Lubrication theory, corrected",
            Self::Exact => "Exact hydrodynamics",
            Self::Bem => "Boundary elements",
            Self::Isolated => "No hydrodynamic interaction",
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
