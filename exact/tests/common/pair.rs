//! Pairs in general position, that no symmetry simplifies.

use scene::nalgebra::{Unit, Vector3};
use scene::{Configuration, Gap, MovingPair, Squirmer};

/// A pair with every kind of motion and slip, which is not free of forces.
pub fn pair(gap: f64, ratio: f64) -> MovingPair {
    let squirmer = |modes: &[f64], swirl: &[f64], radius: f64| {
        let of = Squirmer::new(modes).unwrap().with_swirl(swirl).unwrap();
        of.with_radius(radius).unwrap()
    };
    let towards = |x: f64, y: f64, z: f64| *Unit::new_normalize(Vector3::new(x, y, z));
    MovingPair {
        squirmers: [
            squirmer(&[1.5, -2.0, 0.7, 0.4], &[0.3, 0.8, -0.5], 1.0),
            squirmer(&[0.9, 1.1, -0.6, 0.2], &[0.1, -0.4, 0.9], ratio),
        ],
        configuration: Configuration {
            radii: [1.0, ratio],
            gap: Gap::new(gap).unwrap(),
            midpoint: Vector3::new(0.2, -0.1, 0.4),
            line: towards(0.36, 0.48, -0.8),
            orientations: [towards(0.6, 0.1, 0.8), towards(-0.48, 0.64, 0.6)],
            line_angle_rad: 0.0,
            angles_rad: [0.0; 2],
        },
        velocities: [Vector3::new(0.1, -0.5, 0.3), Vector3::new(0.7, 0.2, -0.4)],
        angular_velocities: [Vector3::new(-0.2, 0.6, 0.1), Vector3::new(0.3, 0.5, 0.9)],
        forces: Default::default(),
        torques: Default::default(),
    }
}
