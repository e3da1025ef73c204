//! Pairs in general position, that no symmetry simplifies.

use exact::Exact;
use scene::nalgebra::{Unit, Vector3};
use scene::{Configuration, Gap, MovingPair, Plan, Pose, Scene, Squirmer};

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

/// Two squirmers that swim freely.
pub fn free(gap: f64, ratio: f64) -> MovingPair {
    let squirmers = [
        Squirmer::with_beta(1.0, 3.0).unwrap(),
        Squirmer::with_beta(0.7, -2.0)
            .unwrap()
            .with_radius(ratio)
            .unwrap(),
    ];
    let start = [
        Pose::planar(0.0, 0.0, 50.0),
        Pose::planar(1.0 + ratio + gap, 0.0, 160.0),
    ];
    let plan = Plan::new(&Scene::new(squirmers, start, None, None).unwrap()).unwrap();
    let model = Exact::of_ratio(ratio).unwrap();
    MovingPair::free(&plan, &model, plan.start()).unwrap()
}

/// The flow of a squirmer of radius 1 as if it swam alone with `2 B_1/3`, without its modes from the third on (Blake 1971).
pub fn lone_flow(pair: &MovingPair, k: usize, point: &Vector3<f64>) -> Vector3<f64> {
    let [b1, b2] = [pair.squirmers[k].mode(0), pair.squirmers[k].mode(1)];
    let p = pair.configuration.orientations[k];
    let x = point - pair.configuration.positions()[k];
    let r = x.norm();
    let (n, c) = (x / r, x.dot(&p) / r);
    let potential = (n * (3.0 * c) - p) * (b1 / 3.0 / r.powi(3));
    let radial = n * (b2 * (1.5 * c * c - 0.5) * (r.powi(-4) - r.powi(-2)));
    potential + radial + (n * c - p) * (b2 * c * r.powi(-4))
}
