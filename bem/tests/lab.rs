//! The laboratory-frame solve, alone and against the pair frame.

#![allow(clippy::unwrap_used, reason = "a test may panic, its helpers too")]

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
