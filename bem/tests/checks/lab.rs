//! The laboratory-frame solve, alone and against the pair frame.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use bem::{Bem, BemError, Body, Lab, Motion};
use nalgebra::{UnitQuaternion, Vector3};
use scene::{Gap, Hydrodynamics, LoadSet};

const STILL: Motion = Motion {
    velocity: Vector3::new(0.0, 0.0, 0.0),
    angular_velocity: Vector3::new(0.0, 0.0, 0.0),
};

#[test]
fn a_lone_sphere_has_stokes_drag_and_torque() {
    let lab = Lab::new(2, &[Body::rigid(Vector3::new(3.0, -1.0, 2.0))]).unwrap();
    let motion = Motion {
        velocity: Vector3::new(0.3, -0.5, 0.8),
        angular_velocity: Vector3::new(-0.2, 0.9, 0.4),
    };
    let load = lab.loads(&[motion]).unwrap()[0];
    assert_relative_eq!(
        load.force,
        -6.0 * PI * motion.velocity,
        epsilon = 6.0 * PI * 1e-5
    );
    assert_relative_eq!(
        load.torque,
        -8.0 * PI * motion.angular_velocity,
        epsilon = 8.0 * PI * 1e-3
    );
}

#[test]
fn a_lone_squirmer_swims_at_two_thirds_of_its_first_mode() {
    let p = Vector3::new(1.0, 2.0, -2.0) / 3.0;
    let body = Body::squirmer(Vector3::zeros(), p, &[1.5, 4.0, -1.0]);
    let motion = Lab::new(2, &[body]).unwrap().free_motions().unwrap()[0];
    assert_relative_eq!(motion.velocity, p, epsilon = 1e-3);
    assert_relative_eq!(motion.angular_velocity, Vector3::zeros(), epsilon = 1e-4);
}

#[test]
fn a_force_moves_a_sphere_along_it() {
    let mut body = Body::rigid(Vector3::zeros());
    body.force = Vector3::new(0.0, 6.0 * PI, 0.0);
    let motion = Lab::new(2, &[body]).unwrap().free_motions().unwrap()[0];
    assert_relative_eq!(motion.velocity, Vector3::y(), epsilon = 1e-4);
}

/// The flow of a force falls as `F (I + x x/|x|^2)/(8 pi |x|)`.
#[test]
fn val_a_pulled_sphere_drags_another_one_along_from_30_to_1e5_radii_away() {
    let pulled = Body {
        force: 6.0 * PI * Vector3::y(),
        ..Body::rigid(Vector3::zeros())
    };
    for distance in [30.0, 300.0, 2e3, 1e4, 1e5] {
        let beside = Vector3::new(0.6, 0.8, 0.0);
        let bodies = [pulled.clone(), Body::rigid(beside * distance)];
        let motions = Lab::new(1, &bodies).unwrap().free_motions().unwrap();
        let expected = 0.75 * (Vector3::y() + beside * beside.y) / distance;
        assert_relative_eq!(
            motions[1].velocity,
            expected,
            epsilon = (1e-3 + 2.0 / (distance * distance)) / distance
        );
        assert_relative_eq!(motions[0].velocity, Vector3::y(), epsilon = 2e-3);
    }
}

/// Loads by unit motions of sphere 1 beside a still sphere 2, along z.
fn sphere_1_moves(lab: &Lab, motion: Motion) -> [bem::Load; 2] {
    let loads = lab.loads(&[motion, STILL]).unwrap();
    [loads[0], loads[1]]
}

#[test]
fn the_split_systems_solve_the_same_equations_as_the_full_one() {
    let eps = 0.3;
    let pair = Bem::new(1)
        .unwrap()
        .loads(Gap::new(eps).unwrap(), LoadSet::all(0))
        .unwrap();
    let bodies = [0.0, 2.0 + eps].map(|z| Body::rigid(Vector3::new(0.0, 0.0, z)));
    let lab = Lab::new(1, &bodies).unwrap();
    let moves = |velocity: Vector3<f64>, angular_velocity: Vector3<f64>| {
        sphere_1_moves(
            &lab,
            Motion {
                velocity,
                angular_velocity,
            },
        )
    };
    let tolerance = 1e-6;
    let zero = Vector3::zeros();
    let axial = moves(Vector3::z(), zero);
    for (scalar, load) in [pair.xa.own(), pair.xa.other()].iter().zip(&axial) {
        assert_relative_eq!(load.force.z, -6.0 * PI * scalar, max_relative = tolerance);
    }
    let across = moves(Vector3::x(), zero);
    for (scalar, load) in [pair.ya.own(), pair.ya.other()].iter().zip(&across) {
        assert_relative_eq!(load.force.x, -6.0 * PI * scalar, max_relative = tolerance);
    }
    // Rotation along d x t = z x x = y.
    let turn = moves(zero, Vector3::y());
    for (k, load) in turn.iter().enumerate() {
        let (b, c) = if k == 0 {
            (pair.yb.own(), pair.yc.own())
        } else {
            (pair.yb.other(), pair.yc.other())
        };
        assert_relative_eq!(load.force.x, 4.0 * PI * b, max_relative = tolerance);
        assert_relative_eq!(load.torque.y, -8.0 * PI * c, max_relative = tolerance);
    }
    let twist = moves(zero, Vector3::z());
    for (scalar, load) in [pair.xc.own(), pair.xc.other()].iter().zip(&twist) {
        assert_relative_eq!(load.torque.z, -8.0 * PI * scalar, max_relative = tolerance);
    }
}

#[test]
fn slip_solved_for_in_the_laboratory_agrees_with_the_angular_factors_of_the_pair_frame() {
    let (eps, mode) = (0.5, 2);
    let loads = Bem::new(2)
        .unwrap()
        .loads(Gap::new(eps).unwrap(), LoadSet::all(mode))
        .unwrap();
    // A pair along a skew line, with the mesh of sphere 1 turned about it.
    let turn = UnitQuaternion::from_euler_angles(0.4, 1.0, -0.7);
    let (d, t) = (turn * Vector3::z(), turn * Vector3::x());
    let angle = 0.8f64;
    let p = d * angle.cos() + t * angle.sin();
    let mut first = Body::squirmer(Vector3::new(0.1, 0.2, 0.3), p, &[0.7, -1.3]);
    first.mesh_rotation = UnitQuaternion::from_scaled_axis(d * 0.5);
    let second = Body::rigid(first.position + d * (2.0 + eps));
    let lab = Lab::new(2, &[first.clone(), second]).unwrap();
    let found = lab.loads(&[STILL, STILL]).unwrap();
    let (c, s) = (angle.cos(), angle.sin());
    let factors = [(c, s), (1.5 * c * c - 0.5, c * s)];
    for (k, load) in found.iter().enumerate() {
        let (mut axial, mut transverse, mut torque) = (0.0, 0.0, 0.0);
        for ((b, (along, across)), mode) in first.modes.iter().zip(factors).zip(loads.modes()) {
            let of = |s: scene::SelfOther| PI * b * if k == 0 { s.own() } else { s.other() };
            axial += along * of(mode.xf);
            transverse += across * of(mode.yf);
            torque += across * of(mode.yt);
        }
        let tolerance = 4.0 * PI * 2e-3;
        assert_relative_eq!(load.force, d * axial + t * transverse, epsilon = tolerance);
        assert_relative_eq!(load.torque, d.cross(&t) * torque, epsilon = tolerance);
    }
}

#[test]
fn overlapping_spheres_are_refused() {
    let bodies = [0.0, 1.9].map(|x| Body::rigid(Vector3::new(x, 0.0, 0.0)));
    assert!(matches!(
        Lab::new(1, &bodies),
        Err(BemError::Overlap {
            first: 0,
            second: 1,
            ..
        })
    ));
}

/// Two still spheres along a skew line at the gap `eps`, their meshes turned away from one another by `angle`.
fn turned_away(eps: f64, angle: f64) -> ([Body; 2], UnitQuaternion<f64>) {
    let turn = UnitQuaternion::from_euler_angles(0.4, 1.0, -0.7);
    let (d, t, c) = (
        turn * Vector3::z(),
        turn * Vector3::x(),
        turn * Vector3::y(),
    );
    let mut bodies = [0.0, 2.0 + eps].map(|s| Body::rigid(d * s));
    bodies[0].mesh_rotation = UnitQuaternion::from_scaled_axis((t * 0.8 + c * 0.6) * angle);
    bodies[1].mesh_rotation = UnitQuaternion::from_scaled_axis(t * angle);
    (bodies, turn)
}

/// The largest error of the loads by rigid motions, relative to the larger of the load and 1.
fn worst_rigid_load(lab: &Lab, eps: f64, turn: UnitQuaternion<f64>) -> f64 {
    let truth = exact::Exact::new()
        .loads(Gap::new(eps).unwrap(), LoadSet::all(0))
        .unwrap();
    let [t, c, d] = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| turn * axis);
    let zero = Vector3::zeros();
    let moved = |velocity, angular_velocity| {
        sphere_1_moves(
            lab,
            Motion {
                velocity,
                angular_velocity,
            },
        )
    };
    let (along, across) = (moved(d, zero), moved(t, zero));
    let (turning, twist) = (moved(zero, c), moved(zero, d));
    let mut worst: f64 = 0.0;
    for k in 0..2 {
        let of = |s: scene::SelfOther| if k == 0 { s.own() } else { s.other() };
        for (found, truth) in [
            (along[k].force.dot(&d) / (-6.0 * PI), of(truth.xa)),
            (across[k].force.dot(&t) / (-6.0 * PI), of(truth.ya)),
            (turning[k].force.dot(&t) / (4.0 * PI), of(truth.yb)),
            (turning[k].torque.dot(&c) / (-8.0 * PI), of(truth.yc)),
            (twist[k].torque.dot(&d) / (-8.0 * PI), of(truth.xc)),
        ] {
            worst = worst.max((found - truth).abs() / truth.abs().max(1.0));
        }
    }
    worst
}

#[test]
fn val_the_smallest_gap_accepted_anywhere_on_a_mesh_is_resolved_to_a_hundredth() {
    for angle in [0.0, 0.05, 0.3, 2.0] {
        let mut eps = 1e-5;
        let (lab, turn) = loop {
            let (bodies, turn) = turned_away(eps, angle);
            match Lab::new(1, &bodies) {
                Ok(lab) => break (lab, turn),
                Err(BemError::GapUnresolved { resolved, .. }) => {
                    assert!(resolved > eps, "{resolved} at {eps}");
                    eps = resolved * 1.0001;
                }
                Err(error) => panic!("{error}"),
            }
        };
        let error = worst_rigid_load(&lab, eps, turn);
        assert!(error < 0.01, "{error:e} at gap {eps}, angle {angle}");
    }
}

#[test]
fn a_gap_that_the_meshes_do_not_resolve_is_an_error_not_a_load() {
    for eps in [1e-3, 1e-4, 1e-5] {
        let bodies = [0.0, 2.0 + eps].map(|z| Body::rigid(Vector3::z() * z));
        let refused = Lab::new(1, &bodies).unwrap_err();
        assert!(
            matches!(
                refused,
                BemError::GapUnresolved {
                    spheres: Some((0, 1)),
                    level: 1,
                    resolved: 0.004,
                    ..
                }
            ),
            "{refused}"
        );
    }
}

#[test]
fn in_units_that_are_half_as_long_the_smallest_resolved_gap_is_twice_as_large() {
    // Unlike spheres, of which the second one is met far from its pole.
    let resolved = |unit: f64| {
        let sphere = |at: [f64; 3], radius: f64| {
            Body::rigid(Vector3::from(at) * unit).with_radius(radius * unit)
        };
        let bodies = [
            sphere([-1.51, 0.0, 0.0], 0.5),
            sphere([0.0; 3], 1.0),
            sphere([0.0, 1.72, 0.0], 0.7),
        ];
        match Lab::new(1, &bodies).unwrap_err() {
            BemError::GapUnresolved {
                spheres: Some((1, 2)),
                resolved,
                ..
            } => resolved,
            error => panic!("{error}"),
        }
    };
    assert_relative_eq!(resolved(2.0), 2.0 * resolved(1.0), max_relative = 1e-9);
}

#[test]
fn a_gap_to_the_second_nearest_neighbour_is_looked_at_too() {
    // Sphere 1 turns its mesh to sphere 0, and sphere 2 has no nearer neighbour than sphere 1.
    let at = |eps: f64| {
        [
            Body::rigid(Vector3::new(-2.01, 0.0, 0.0)),
            Body::rigid(Vector3::zeros()),
            Body::rigid(Vector3::new(0.0, 2.0 + eps, 0.0)),
        ]
    };
    let refused = Lab::new(1, &at(0.02)).unwrap_err();
    let BemError::GapUnresolved {
        spheres,
        eps,
        resolved,
        needed,
        ..
    } = refused
    else {
        panic!("{refused}");
    };
    assert_eq!((spheres, needed), (Some((1, 2)), None));
    assert_relative_eq!(eps, 0.02, max_relative = 1e-10);
    assert!(resolved > 0.1 && resolved < 0.4, "{resolved}");
    let told = refused.to_string();
    assert!(
        told.contains("between spheres 1 and 2") && told.contains("resolves gaps from"),
        "{told}"
    );
    // What the error names as resolved is accepted, and a little less is not.
    assert!(Lab::new(1, &at(1.001 * resolved)).is_ok());
    assert!(Lab::new(1, &at(0.99 * resolved)).is_err());
}
