//! The paper's encounters as scenes.

use std::f64::consts::FRAC_PI_2;
use std::fmt;

use scene::{Orientation, Pose, Repulsion, Scene, SceneError, Squirmer};

/// How two squirmers approach each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Approach {
    /// Opposed velocities (Fig. 6): squirmer 1 starts at `(-dx/2, 5)` downwards, squirmer 2 at `(dx/2, -5)` upwards.
    HeadOn,
    /// Velocities at right angles (Fig. 7): squirmer 1 starts at `(0, 10)` along x, squirmer 2 at `(10 - dx, 0)`
    /// along y.
    Orthogonal,
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
    /// The scene of this encounter.
    ///
    /// # Errors
    /// [`SceneError`] for numbers that are not finite, and for spheres that overlap.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        let squirmer = Squirmer::with_beta(1.0, self.beta)?;
        let pose = |x: f64, y: f64, z: f64, angle: f64| Pose {
            position: [x, y, z].into(),
            orientation: Orientation::Radians(angle),
        };
        let (half, up) = (0.5 * self.dx, 0.5 * self.dz);
        let start = match self.approach {
            Approach::HeadOn => [
                pose(-half, 5.0, up, -FRAC_PI_2),
                pose(half, -5.0, -up, FRAC_PI_2),
            ],
            Approach::Orthogonal => [
                pose(0.0, 10.0, up, 0.0),
                pose(10.0 - self.dx, 0.0, -up, FRAC_PI_2),
            ],
        };
        Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), None)
    }
}
