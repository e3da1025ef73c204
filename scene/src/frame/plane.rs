//! The plane of a motion that is planar, but not in a plane of constant z.
//!
//! Line of centres, orientations and gravity that have one common normal keep it, without swirl: the
//! motion is then run in the frame of that plane, on the coordinates of a plane of constant z, and seen in
//! the scene's own frame by whoever asks. The plane's x axis is horizontal (along the scene's x-y plane) and its
//! y axis upward, so that an angle in the plane and the angle of its projection on the x-y plane are in the
//! same quarter turn and have the same sense: the winding of one is that of the other.

use nalgebra::{Matrix3, Vector3};

use super::configuration::{Configuration, Rates, direction, unwind};
use crate::{Gravity, Scene};

/// A plane with its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane {
    /// The pair's midpoint at the start.
    origin: Vector3<f64>,
    /// The frame's axes as columns: horizontal, upward, normal.
    axes: Matrix3<f64>,
    /// Angle of the horizontal axis in the scene's x-y plane, in radians.
    node: f64,
    /// Up to which cosine two unit vectors of the scene are perpendicular.
    rounding: f64,
}

impl Plane {
    /// The plane in which the motion of a scene without swirl stays, if its line of centres, orientations and
    /// `gravity` lie in one to the rounding of their numbers.
    pub fn of(scene: &Scene, start: &Configuration, gravity: Option<Gravity>) -> Option<Self> {
        // Unit vectors are rounded to a bit or two, the line of centres as the positions are.
        let [one, two] = scene.start.map(|pose| pose.position.norm());
        let rounding = 4.0 * f64::EPSILON * (1.0 + (one + two) / start.distance());
        let line = start.line;
        let [first, second] = start.orientations;
        let gravity = gravity.map_or(line, |gravity| gravity.direction());
        let others = [first, second, gravity];
        let furthest = (others.iter())
            .map(|v| across(v, &line))
            .fold(
                Vector3::zeros(),
                |a, b| if b.norm() > a.norm() { b } else { a },
            );
        let beside = if furthest.norm() > rounding {
            furthest
        } else {
            // All are along one line, and any plane through it will do: one with a horizontal axis across.
            let level = Vector3::new(-line.y, line.x, 0.0);
            if level.norm() > rounding {
                level
            } else {
                Vector3::x()
            }
        };
        // Once more: what is left along the line of a short vector counts.
        let normal = line.cross(&across(&beside.normalize(), &line).normalize());
        (others.iter().all(|v| v.dot(&normal).abs() <= rounding))
            .then(|| Self::with_normal(normal, start.midpoint, rounding))
    }

    fn with_normal(normal: Vector3<f64>, origin: Vector3<f64>, rounding: f64) -> Self {
        let (normal, horizontal) = if normal.z.abs() <= rounding {
            // Upright: looked at so that the horizontal axis points along x, or else along y.
            let horizontal = Vector3::new(-normal.y, normal.x, 0.0).normalize();
            let along_x = horizontal.x.abs() > rounding;
            let sense = if along_x { horizontal.x } else { horizontal.y };
            let horizontal = horizontal * sense.signum();
            (horizontal.cross(&Vector3::z()), horizontal)
        } else {
            let normal = normal * normal.z.signum();
            let horizontal = Vector3::new(-normal.y, normal.x, 0.0);
            match horizontal.norm() {
                level if level <= rounding => (Vector3::z(), Vector3::x()),
                level => (normal, horizontal / level),
            }
        };
        Self {
            origin,
            axes: Matrix3::from_columns(&[horizontal, normal.cross(&horizontal), normal]),
            node: horizontal.y.atan2(horizontal.x),
            rounding,
        }
    }

    /// Unit normal; it does not point downward.
    pub fn normal(&self) -> Vector3<f64> {
        self.axes.column(2).into()
    }

    /// Up to which cosine two unit vectors of the scene are perpendicular, and up to which angle, in radians,
    /// two of its directions are the same.
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// A configuration of the scene as it is seen in the plane.
    pub fn within(&self, c: &Configuration) -> Configuration {
        let angle = |v: &Vector3<f64>, projected: f64| {
            let v = self.axes.tr_mul(v);
            unwind(v.y.atan2(v.x), projected - self.node)
        };
        let line_angle_rad = angle(&c.line, c.line_angle_rad);
        let angles = [0, 1].map(|k| angle(&c.orientations[k], c.angles_rad[k]));
        Configuration {
            radii: c.radii,
            gap: c.gap,
            midpoint: self.axes.tr_mul(&(c.midpoint - self.origin)),
            line: direction(line_angle_rad),
            orientations: angles.map(direction),
            line_angle_rad,
            angles_rad: angles,
        }
    }

    /// A configuration in the plane as it is seen in the scene.
    pub fn outside(&self, c: &Configuration) -> Configuration {
        let angle = |v: &Vector3<f64>, within: f64| unwind(v.y.atan2(v.x), within + self.node);
        let line = self.axes * c.line;
        let orientations = c.orientations.map(|p| self.axes * p);
        Configuration {
            radii: c.radii,
            gap: c.gap,
            midpoint: self.origin + self.axes * c.midpoint,
            line,
            orientations,
            line_angle_rad: angle(&line, c.line_angle_rad),
            angles_rad: [0, 1].map(|k| angle(&orientations[k], c.angles_rad[k])),
        }
    }

    /// Rates in the plane as they are seen in the scene.
    pub fn rates_outside(&self, rates: &Rates) -> Rates {
        Rates {
            midpoint: self.axes * rates.midpoint,
            line: self.axes * rates.line,
            ln_gap: rates.ln_gap,
            orientations: rates.orientations.map(|rate| self.axes * rate),
        }
    }

    /// Gravity as it is seen in the plane.
    pub fn gravity_within(&self, gravity: Gravity) -> Gravity {
        gravity.seen(|down| {
            let down = self.axes.tr_mul(&down);
            Vector3::new(down.x, down.y, 0.0)
        })
    }
}

/// The part of `v` across the unit vector `line`.
fn across(v: &Vector3<f64>, line: &Vector3<f64>) -> Vector3<f64> {
    v - line * v.dot(line)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gap;
    use nalgebra::Rotation3;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn frame(normal: [f64; 3]) -> Plane {
        let normal = Vector3::from(normal).normalize();
        Plane::with_normal(normal, Vector3::new(1.0, -2.0, 0.5), 8.0 * f64::EPSILON)
    }

    const NORMALS: [[f64; 3]; 8] = [
        [0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.3, -0.4, 0.0],
        [0.3, -0.4, -1e-17],
        [0.3, 0.4, -1.2],
        [1e-9, -2e-9, 1.0],
        [-0.6, 0.7, 1e-9],
    ];

    #[test]
    fn a_frame_has_a_horizontal_and_an_upward_axis() {
        for normal in NORMALS {
            let plane = frame(normal);
            let one = plane.axes.tr_mul(&plane.axes);
            assert!((one - Matrix3::identity()).amax() < 4.0 * f64::EPSILON);
            assert!((plane.axes.determinant() - 1.0).abs() < 4.0 * f64::EPSILON);
            assert!(plane.axes[(2, 0)].abs() <= 0.0, "{plane:?}");
            assert!(
                plane.axes[(2, 1)] >= 0.0 && plane.normal().z >= 0.0,
                "{plane:?}"
            );
        }
        // The x-z plane has the scene's own axes, exactly.
        let upright = frame([0.0, 1.0, 0.0]);
        let axes = [Vector3::x(), Vector3::z(), -Vector3::y()];
        assert_eq!(upright.axes, Matrix3::from_columns(&axes));
    }

    #[test]
    fn what_is_seen_in_a_plane_is_seen_again_in_the_scene_and_winds_alike() {
        for normal in NORMALS {
            let plane = frame(normal);
            for i in -40..=40 {
                let winding = 0.37 * f64::from(i);
                let angles = [winding - 0.4, 2.0 * PI - winding];
                let inside = Configuration {
                    radii: [1.0; 2],
                    gap: Gap::from_ln(-2.0),
                    midpoint: Vector3::new(0.3, -0.7, 0.0),
                    line: direction(winding),
                    orientations: angles.map(direction),
                    line_angle_rad: winding,
                    angles_rad: angles,
                };
                let outside = plane.outside(&inside);
                let again = plane.within(&outside);
                let close = |a: f64, b: f64| (a - b).abs() < 1e-14 * (1.0 + b.abs());
                assert!((again.midpoint - inside.midpoint).norm() < 1e-15);
                assert!(close(again.line_angle_rad, winding), "{normal:?} {i}");
                assert!(
                    close(again.angles_rad[0], angles[0]) && close(again.angles_rad[1], angles[1])
                );
                // A projection is never ahead of or behind what it is the projection of by a quarter turn.
                let ahead = outside.line_angle_rad - plane.node - winding;
                assert!(ahead.abs() < FRAC_PI_2 + 1e-12, "{normal:?} {i}");
            }
        }
    }

    #[test]
    fn rates_are_those_of_what_is_seen() {
        let plane = frame([0.3, 0.4, -1.2]);
        let turn = Rotation3::from_matrix_unchecked(plane.axes);
        let rates = Rates {
            midpoint: Vector3::new(0.1, 0.2, 0.0),
            line: Vector3::new(-0.3, 0.1, 0.0),
            ln_gap: -0.7,
            orientations: [Vector3::x(), Vector3::y()],
        };
        let outside = plane.rates_outside(&rates);
        assert!((turn.inverse() * outside.midpoint - rates.midpoint).norm() < 1e-15);
        assert!((turn.inverse() * outside.line - rates.line).norm() < 1e-15);
        assert!(outside.orientations[0].dot(&plane.normal()).abs() < 1e-15);
    }
}
