//! The hydrodynamic models, by their names on the command line.

use std::fmt;

use bem::{Bem, BemError};
use scene::Gap;

/// A hydrodynamic model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Method {
    /// Lubrication theory as published.
    Lt,
    /// Lubrication theory with the corrected coefficient (3) of the axial squirming force.
    LtCorrected,
    /// Bispherical series, accurate to about ten digits: the reference.
    Exact,
    /// Boundary elements.
    Bem,
    /// No hydrodynamic interaction. Only scene files can name it.
    Isolated,
}

impl Method {
    /// The methods that the command line accepts.
    pub const ALL: [Self; 4] = [Self::Lt, Self::LtCorrected, Self::Exact, Self::Bem];

    /// The methods that a command runs by default.
    pub const DEFAULT: [Self; 3] = [Self::Lt, Self::Exact, Self::Bem];

    /// The method with this name on the command line and in tables, if it can be compared.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }

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

    /// Refuses a gap that is below the model's range. Boundary elements of level `mesh` have a smallest gap.
    ///
    /// # Errors
    /// [`BemError::GapUnresolved`] with the level that resolves the gap; [`BemError::Level`] if `mesh` is not a level.
    pub fn check_gap(self, mesh: usize, gap: Gap) -> Result<(), BemError> {
        match self {
            Self::Bem => Bem::new(mesh)?.check(gap),
            Self::Lt | Self::LtCorrected | Self::Exact | Self::Isolated => Ok(()),
        }
    }

    /// Name of the model in pictures.
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
