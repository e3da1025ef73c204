//! The paper's encounters with opposed velocities and at right angles.

use std::fmt;

use scene::Scene;

use crate::CompareError;
use crate::scene_file::paper_scene;

/// How two squirmers approach each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Approach {
    /// Opposed velocities (Fig. 6).
    HeadOn,
    /// Velocities at right angles (Fig. 7).
    Orthogonal,
}

impl Approach {
    /// Name of its family in `fixtures/families`.
    #[must_use]
    pub const fn family(self) -> &'static str {
        match self {
            Self::HeadOn => "opposed",
            Self::Orthogonal => "right-angles",
        }
    }
}

impl fmt::Display for Approach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::HeadOn => "head-on",
            Self::Orthogonal => "orthogonal",
        })
    }
}

/// One encounter of two equal squirmers without gravity, with the paper's repulsion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// The directions of approach.
    pub approach: Approach,
    /// Squirmer parameter `beta = B_2/B_1` of both squirmers.
    pub beta: f64,
    /// Offset of their paths, in radii.
    pub dx: f64,
    /// Offset out of the plane, in radii: squirmer 1 starts at `z = dz/2`, squirmer 2 at `z = -dz/2`.
    pub dz: f64,
}

impl Case {
    /// The scene of this encounter, from the family of its approach.
    ///
    /// # Errors
    /// [`CompareError::FamilyPoint`] for numbers that are not finite, and for spheres that overlap.
    pub fn scene(&self) -> Result<Scene, CompareError> {
        let values = [("beta", self.beta), ("dx", self.dx), ("dz", self.dz)];
        paper_scene(self.approach.family(), &values)
    }
}
