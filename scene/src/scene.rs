//! A scene: two squirmers, where they start, and the effects that act on them.

use nalgebra::Vector3;

use crate::effects::unit;
use crate::squirmer::finite;
use crate::{Gap, Gravity, Repulsion, SceneError, Squirmer};

/// Largest distance of the centres along an axis, in radii: squares of it are still numbers.
const FARTHEST: f64 = 1e150;

/// A swimming direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// Angle in the x-y plane, anticlockwise from the x axis, in radians; it may wind.
    Angle(f64),
    /// Vector in three dimensions, of any length.
    Vector(Vector3<f64>),
}

impl Orientation {
    /// The unit vector `p`.
    ///
    /// # Errors
    /// [`SceneError::NotFinite`] or [`SceneError::NoDirection`].
    pub fn vector(&self) -> Result<Vector3<f64>, SceneError> {
        match *self {
            Self::Angle(angle) => {
                finite("orientation angle", angle)?;
                Ok(Vector3::new(angle.cos(), angle.sin(), 0.0))
            }
            Self::Vector(vector) => unit("orientation", vector),
        }
    }

    /// The angle in the x-y plane of the orientation's projection, in radians.
    #[must_use]
    pub fn angle(&self) -> f64 {
        match *self {
            Self::Angle(angle) => angle,
            Self::Vector(v) => v.y.atan2(v.x),
        }
    }
}

/// Where a squirmer starts and which way it points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Centre, in sphere radii.
    pub position: Vector3<f64>,
    /// Swimming direction.
    pub orientation: Orientation,
}

/// Two squirmers, where they start, and the effects that act besides hydrodynamics.
///
/// An effect that is `None` is not computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The squirmers.
    pub squirmers: [Squirmer; 2],
    /// Their initial poses.
    pub start: [Pose; 2],
    /// Repulsion at short range.
    pub repulsion: Option<Repulsion>,
    /// Gravity; it acts on squirmers with bottom-heaviness only.
    pub gravity: Option<Gravity>,
}

impl Scene {
    /// Two squirmers at their initial poses, with the given effects.
    ///
    /// # Errors
    /// [`SceneError`] if a number is not finite, an orientation has no direction or the spheres
    /// overlap or touch.
    pub fn new(
        squirmers: [Squirmer; 2],
        start: [Pose; 2],
        repulsion: Option<Repulsion>,
        gravity: Option<Gravity>,
    ) -> Result<Self, SceneError> {
        for pose in &start {
            for &coordinate in pose.position.iter() {
                finite("position", coordinate)?;
            }
            pose.orientation.vector()?;
        }
        let scene = Self {
            squirmers,
            start,
            repulsion,
            gravity,
        };
        scene.gap()?;
        Ok(scene)
    }

    /// The gap at the start.
    ///
    /// # Errors
    /// [`SceneError::InvalidGap`] if the spheres overlap or touch, [`SceneError::TooFar`] if squares of their distance
    /// cannot be formed.
    pub fn gap(&self) -> Result<Gap, SceneError> {
        let separation = self.start[1].position - self.start[0].position;
        if separation.amax() > FARTHEST {
            return Err(SceneError::TooFar {
                distance: separation.amax(),
                allowed: FARTHEST,
            });
        }
        Gap::new(separation.norm() - 2.0)
    }

    /// Number of squirming modes of the two.
    #[must_use]
    pub fn modes(&self) -> usize {
        let [one, two] = &self.squirmers;
        one.modes().len().max(two.modes().len())
    }
}
