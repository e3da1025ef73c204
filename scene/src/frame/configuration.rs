//! Where the two squirmers are and which way they point, in the laboratory frame.

use nalgebra::Vector3;
use std::f64::consts::TAU;

use crate::{Gap, Scene, SceneError};

/// A state in the laboratory frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Configuration {
    /// Radii of the two.
    pub radii: [f64; 2],
    /// Gap between the surfaces.
    pub gap: Gap,
    /// Midpoint of the two centres, in sphere radii.
    pub midpoint: Vector3<f64>,
    /// Unit vector from the first centre to the second.
    pub line: Vector3<f64>,
    /// Unit orientations.
    pub orientations: [Vector3<f64>; 2],
    /// Angle of `line`'s projection on the x-y plane, in radians; it winds.
    pub line_angle_rad: f64,
    /// Angles of the orientations' projections on the x-y plane, in radians; they wind.
    pub angles_rad: [f64; 2],
}

impl Configuration {
    /// Distance of the centres.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.radii[0] + self.radii[1] + self.gap.eps()
    }

    /// The smaller radius: gaps up to it count as close.
    pub(crate) fn smaller_radius(&self) -> f64 {
        let [one, two] = self.radii;
        one.min(two)
    }

    /// The two centres, in radii of the first squirmer.
    #[must_use]
    pub fn positions(&self) -> [Vector3<f64>; 2] {
        let half = self.line * (0.5 * self.distance());
        [self.midpoint - half, self.midpoint + half]
    }
}

/// `angle` plus the multiple of 2 pi that brings it nearest to `previous`.
pub(crate) fn unwind(angle: f64, previous: f64) -> f64 {
    angle + TAU * ((previous - angle) / TAU).round()
}

/// Unit vector at an angle in the x-y plane.
pub(crate) fn direction(angle: f64) -> Vector3<f64> {
    let (sin, cos) = angle.sin_cos();
    Vector3::new(cos, sin, 0.0)
}

/// Unit vector a quarter turn on.
pub(crate) fn across(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(-v.y, v.x, 0.0)
}

/// Rates of change of a [`Configuration`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Velocity of the midpoint.
    pub midpoint: Vector3<f64>,
    /// Rate of change of the unit vector from the first centre to the second.
    pub line: Vector3<f64>,
    /// `d(ln eps)/dt`.
    pub ln_gap: f64,
    /// Rates of change of the orientations.
    pub orientations: [Vector3<f64>; 2],
}

/// The configuration in which a scene starts.
pub(crate) fn start(scene: &Scene) -> Result<Configuration, SceneError> {
    let [one, two] = &scene.start;
    let separation = two.position - one.position;
    let line = separation / separation.norm();
    Ok(Configuration {
        radii: [0, 1].map(|k| scene.squirmers[k].radius()),
        gap: scene.gap()?,
        midpoint: (one.position + two.position) * 0.5,
        line,
        orientations: [one.orientation.vector()?, two.orientation.vector()?],
        line_angle_rad: line.y.atan2(line.x),
        angles_rad: [one.orientation.angle_rad(), two.orientation.angle_rad()],
    })
}
