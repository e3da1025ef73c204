//! A pair that moves in every way.

use nalgebra::Vector3;
use scene::{Configuration, Gap, MovingPair, Squirmer};

/// Two spheres somewhere, with no symmetry.
pub fn configuration(ratio: f64, gap: f64) -> Configuration {
    Configuration {
        radii: [1.0, ratio],
        gap: Gap::new(gap).unwrap(),
        midpoint: Vector3::new(0.2, 0.1, -0.4),
        line: Vector3::new(0.36, 0.48, -0.8),
        orientations: [Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.48, 0.64, 0.6)],
        line_angle_rad: 0.0,
        angles_rad: [0.0; 2],
    }
}

/// Squirmers there that move and slip in every way.
pub fn pair(ratio: f64, gap: f64) -> MovingPair {
    let squirmer = |modes: &[f64], swirl: &[f64], radius: f64| {
        let of = Squirmer::new(modes).unwrap().with_swirl(swirl).unwrap();
        of.with_radius(radius).unwrap()
    };
    MovingPair {
        squirmers: [
            squirmer(&[1.5, -2.0, 0.7], &[0.3, 0.8], 1.0),
            squirmer(&[0.9, 1.1], &[0.1, -0.4], ratio),
        ],
        configuration: configuration(ratio, gap),
        velocities: [Vector3::new(0.1, -0.5, 0.3), Vector3::new(0.7, 0.2, -0.4)],
        angular_velocities: [Vector3::new(-0.2, 0.6, 0.1), Vector3::new(0.3, 0.5, 0.9)],
        forces: Default::default(),
        torques: Default::default(),
    }
}
