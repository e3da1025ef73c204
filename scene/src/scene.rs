//! A scene: two squirmers, where they start, and the effects that act on them.

use nalgebra::Vector3;

use crate::effects::unit;
use crate::squirmer::finite;
use crate::{Gap, Gravity, LoadSet, Repulsion, SceneError, Squirmer};

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

    fn is_planar(&self) -> bool {
        match self {
            Self::Angle(_) => true,
            Self::Vector(v) => v.z == 0.0,
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
    /// [`SceneError::InvalidGap`] if the spheres overlap or touch.
    pub fn gap(&self) -> Result<Gap, SceneError> {
        Gap::new((self.start[1].position - self.start[0].position).norm() - 2.0)
    }

    /// The loads that the motion of the scene reads.
    #[must_use]
    pub fn load_set(&self) -> LoadSet {
        let [one, two] = &self.squirmers;
        LoadSet {
            modes: one.modes().len().max(two.modes().len()),
            transverse: true,
            // Without a torque about the line of centres nothing but slip across it turns a squirmer.
            twist: (!self.is_planar() && self.acting_gravity().is_some())
                || self.acting_swirl() > 0,
            swirl: self.acting_swirl(),
        }
    }

    /// Gravity, if there is any and a squirmer that it turns.
    #[must_use]
    pub fn acting_gravity(&self) -> Option<Gravity> {
        let turns = self.squirmers.iter().any(|s| s.gravity_torque() != 0.0);
        self.gravity.filter(|_| turns)
    }

    /// Highest swirl mode, 0 if swirl has no effect: `C_1` alone turns a squirmer about its own axis,
    /// which changes nothing, whatever is around it.
    #[must_use]
    pub fn acting_swirl(&self) -> usize {
        let [one, two] = &self.squirmers;
        let highest = one.swirl().len().max(two.swirl().len());
        if highest > 1 { highest } else { 0 }
    }

    /// Whether the motion stays in a plane of constant z, by symmetry.
    #[must_use]
    pub fn is_planar(&self) -> bool {
        let [one, two] = &self.start;
        #[expect(clippy::float_cmp, reason = "planar means exactly planar")]
        let level = one.position.z == two.position.z;
        level
            && self.acting_swirl() == 0
            && self.start.iter().all(|pose| pose.orientation.is_planar())
            && self
                .acting_gravity()
                .is_none_or(|gravity| gravity.direction().z == 0.0)
    }
}
