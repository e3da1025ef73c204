//! A scene: two squirmers, where they start, and the effects that act on them.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;

use crate::effects::unit;
use crate::squirmer::{finite, touching};
use crate::{Gap, Gravity, Repulsion, SceneError, Squirmer};

/// Largest distance of the centres along an axis, in radii: squares of it are still numbers.
const FARTHEST: f64 = 1e150;

/// A swimming direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// Angle in the x-y plane, anticlockwise from the x axis, in radians; it may wind.
    /// [`Orientation::from_degrees`] makes it of degrees.
    Radians(f64),
    /// Vector in three dimensions, of any length.
    Vector(Vector3<f64>),
}

impl Orientation {
    /// The direction in the x-y plane at an angle in degrees, anticlockwise from the x axis; it may wind.
    ///
    /// Quarter turns are exact: 90 degrees are the floating-point number `FRAC_PI_2`, 180 degrees are `PI`.
    #[must_use]
    pub fn from_degrees(degrees: f64) -> Self {
        Self::Radians(degrees / 90.0 * FRAC_PI_2)
    }

    /// The unit vector `p`.
    ///
    /// # Errors
    /// [`SceneError::NotFinite`] or [`SceneError::NoDirection`].
    pub fn vector(&self) -> Result<Vector3<f64>, SceneError> {
        match *self {
            Self::Radians(angle) => {
                finite("orientation angle", angle)?;
                Ok(Vector3::new(angle.cos(), angle.sin(), 0.0))
            }
            Self::Vector(vector) => unit("orientation", vector),
        }
    }

    /// The angle in the x-y plane of the orientation's projection, in radians.
    #[must_use]
    pub fn angle_rad(&self) -> f64 {
        match *self {
            Self::Radians(angle) => angle,
            Self::Vector(v) => v.y.atan2(v.x),
        }
    }
}

/// Where a squirmer starts and which way it points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Centre, in radii of the first squirmer.
    pub position: Vector3<f64>,
    /// Swimming direction.
    pub orientation: Orientation,
}

impl Pose {
    /// A squirmer in the plane `z = 0`: its centre at `(x, y)`, in sphere radii, its swimming direction at an angle in
    /// `degrees`, anticlockwise from the x axis. Quarter turns are exact ([`Orientation::from_degrees`]).
    ///
    /// A number that is not finite is refused by [`Scene::new`].
    ///
    /// ```
    /// use scene::{Pose, Scene, Squirmer};
    /// let pullers = [Squirmer::with_beta(1.0, 5.0)?; 2];
    /// // On opposed paths: the first swims down, the second up.
    /// let start = [Pose::planar(-0.5, 5.0, -90.0), Pose::planar(0.5, -5.0, 90.0)];
    /// let scene = Scene::new(pullers, start, None, None)?;
    /// assert!((scene.gap()?.eps() - 8.05).abs() < 1e-2);
    /// # Ok::<(), scene::SceneError>(())
    /// ```
    #[must_use]
    pub fn planar(x: f64, y: f64, degrees: f64) -> Self {
        Self {
            position: Vector3::new(x, y, 0.0),
            orientation: Orientation::from_degrees(degrees),
        }
    }
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
    /// [`SceneError`] if a number is not finite, an orientation has no direction, the spheres
    /// overlap or touch, or the radius of the first is not 1.
    pub fn new(
        squirmers: [Squirmer; 2],
        start: [Pose; 2],
        repulsion: Option<Repulsion>,
        gravity: Option<Gravity>,
    ) -> Result<Self, SceneError> {
        squirmers[0].check_first()?;
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
        Gap::new(separation.norm() - touching(&self.squirmers))
    }

    /// Radius of the second squirmer over that of the first.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.squirmers[1].radius() / self.squirmers[0].radius()
    }

    /// Number of squirming modes of the two.
    #[must_use]
    pub fn modes(&self) -> usize {
        let [one, two] = &self.squirmers;
        one.modes().len().max(two.modes().len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    #[test]
    fn quarter_turns_in_degrees_are_exact_in_radians() {
        for quarters in -9..=9 {
            let pose = Pose::planar(0.0, 0.0, 90.0 * f64::from(quarters));
            let expected = Orientation::Radians(f64::from(quarters) * FRAC_PI_2);
            assert_eq!(pose.orientation, expected, "{quarters} quarter turns");
        }
        assert_eq!(Orientation::from_degrees(180.0), Orientation::Radians(PI));
    }

    #[test]
    fn a_planar_pose_points_anticlockwise_from_x_and_lies_at_z_0() {
        let pose = Pose::planar(1.5, -2.0, 30.0);
        assert_eq!(pose.position, Vector3::new(1.5, -2.0, 0.0));
        let expected = Vector3::new(0.75_f64.sqrt(), 0.5, 0.0);
        assert_relative_eq!(
            pose.orientation.vector().unwrap(),
            expected,
            epsilon = 1e-15
        );
        assert_relative_eq!(pose.orientation.angle_rad(), PI / 6.0, epsilon = 1e-15);
    }

    #[test]
    fn a_scene_refuses_a_planar_pose_that_is_not_finite() {
        let squirmers = [Squirmer::with_beta(1.0, 0.0).unwrap(); 2];
        for bad in [f64::NAN, f64::INFINITY] {
            for pose in [Pose::planar(bad, 0.0, 0.0), Pose::planar(0.0, 0.0, bad)] {
                let start = [pose, Pose::planar(5.0, 0.0, 0.0)];
                let refused = Scene::new(squirmers, start, None, None);
                assert!(
                    matches!(refused, Err(SceneError::NotFinite { .. })),
                    "{pose:?}"
                );
            }
        }
    }
}
