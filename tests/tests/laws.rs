//! Laws of Stokes flow about one sphere and about two, by boundary elements in the laboratory frame.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::PI;

use approx::assert_relative_eq;
use bem::{Bem, Body, Lab, Motion};
use nalgebra::{UnitQuaternion, Vector3};
use scene::balance;
use scene::mobility::{External, Heading, MobilitySet, pair_velocity};
use scene::{Gap, Hydrodynamics, LoadSet, PairLoads, Squirmer};

/// Level of the meshes here: coarse, since laws hold to the error of any mesh.
const LEVEL: usize = 2;

/// Error of a lone sphere's drag at this level, relative.
const MESH_ERROR: f64 = 2e-3;

fn at_rest() -> Motion {
    Motion {
        velocity: Vector3::zeros(),
        angular_velocity: Vector3::zeros(),
    }
}

#[test]
fn val_drag_on_a_sphere_is_six_pi() {
    let lab = Lab::new(LEVEL, &[Body::rigid(Vector3::zeros())]).unwrap();
    let velocity = Vector3::new(0.3, -0.7, 1.1);
    let motion = Motion {
        velocity,
        ..at_rest()
    };
    let load = lab.loads(&[motion]).unwrap()[0];
    assert_relative_eq!(
        load.force,
        velocity * (-6.0 * PI),
        max_relative = MESH_ERROR
    );
}

#[test]
fn val_torque_on_a_turning_sphere_is_eight_pi() {
    let lab = Lab::new(LEVEL, &[Body::rigid(Vector3::zeros())]).unwrap();
    let angular_velocity = Vector3::new(-0.4, 0.2, 0.9);
    let motion = Motion {
        angular_velocity,
        ..at_rest()
    };
    let load = lab.loads(&[motion]).unwrap()[0];
    let expected = angular_velocity * (-8.0 * PI);
    assert_relative_eq!(load.torque, expected, max_relative = MESH_ERROR);
}

#[test]
fn val_a_lone_squirmer_swims_at_two_thirds_of_its_first_mode() {
    let p = Vector3::new(1.0, 2.0, -2.0) / 3.0;
    let body = Body::squirmer(Vector3::zeros(), p, &[0.9, 2.0, -1.0]);
    let motion = Lab::new(LEVEL, &[body]).unwrap().free_motions().unwrap()[0];
    assert_relative_eq!(motion.velocity, p * 0.6, epsilon = MESH_ERROR);
    assert_relative_eq!(
        motion.angular_velocity,
        Vector3::zeros(),
        epsilon = MESH_ERROR
    );
}

/// The resistance matrix of two spheres, loads by unit motions: 12 columns of 12 loads.
fn resistance(lab: &Lab) -> Vec<Vec<f64>> {
    (0..12)
        .map(|column| {
            let mut motions = [at_rest(); 2];
            let motion = &mut motions[column / 6];
            if column % 6 < 3 {
                motion.velocity[column % 3] = 1.0;
            } else {
                motion.angular_velocity[column % 3] = 1.0;
            }
            let loads = lab.loads(&motions).unwrap();
            (loads.iter())
                .flat_map(|load| {
                    load.force
                        .iter()
                        .chain(load.torque.iter())
                        .copied()
                        .collect::<Vec<_>>()
                })
                .collect()
        })
        .collect()
}

fn crooked_pair() -> [Body; 2] {
    let separation = Vector3::new(1.1, -1.7, 1.3);
    let [a, b] = [
        Vector3::new(0.2, 0.1, -0.4),
        Vector3::new(0.2, 0.1, -0.4) + separation,
    ];
    [
        Body::squirmer(a, Vector3::new(0.6, 0.8, 0.0), &[1.5, 3.0]),
        Body::squirmer(b, Vector3::new(0.0, -0.6, 0.8), &[1.5, -1.5]),
    ]
}

#[test]
fn resistance_is_reciprocal() {
    let rigid = crooked_pair().map(|body| Body::rigid(body.position));
    let matrix = resistance(&Lab::new(LEVEL, &rigid).unwrap());
    for (i, row) in matrix.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            assert!(
                (value - matrix[j][i]).abs() < 6.0 * PI * MESH_ERROR,
                "load {j} by motion {i}: {value} against {}",
                matrix[j][i]
            );
        }
    }
}

/// Velocities of the crooked pair from the loads in the pair frame.
fn pair_frame_motion(loads: &PairLoads, bodies: &[Body; 2]) -> [Vector3<f64>; 2] {
    let separation = bodies[1].position - bodies[0].position;
    let distance = separation.norm();
    let d = separation / distance;
    let heading = |k: usize, towards: Vector3<f64>| {
        let p = bodies[k].orientation.into_inner();
        Heading {
            cosine: p.dot(&towards),
            transverse: p - d * p.dot(&d),
        }
    };
    let squirmers = [0, 1].map(|k| Squirmer::new(&bodies[k].modes).unwrap());
    let gap = Gap::new(distance - 2.0).unwrap();
    let external = External {
        repulsion: 0.0,
        torque: None,
    };
    let headings = [heading(0, d), heading(1, -d)];
    let set = MobilitySet {
        loads: loads.set(),
        torque: false,
    };
    let mobility = balance::solve(gap, loads, set);
    let v = pair_velocity(
        (&mobility.pair, &mobility.modes[..set.loads.modes]),
        &squirmers,
        &headings,
        &external,
    );
    let mean = d * v.mean_axial + v.mean_transverse;
    let half = (d * (v.opening * gap.eps()) + v.turning * distance) * 0.5;
    [mean - half, mean + half]
}

#[test]
fn val_laboratory_frame_and_pair_frame_agree_whatever_the_mesh_rotation() {
    let bodies = crooked_pair();
    let gap = Gap::new((bodies[1].position - bodies[0].position).norm() - 2.0).unwrap();
    let loads = Bem::new(LEVEL)
        .unwrap()
        .loads(gap, LoadSet::all(2))
        .unwrap();
    let expected = pair_frame_motion(&loads, &bodies);
    for angle in [0.0, 1.0] {
        let turned = bodies.clone().map(|body| Body {
            mesh_rotation: UnitQuaternion::from_euler_angles(angle, -2.0 * angle, 0.3),
            ..body
        });
        let motions = Lab::new(LEVEL, &turned).unwrap().free_motions().unwrap();
        for k in 0..2 {
            assert_relative_eq!(motions[k].velocity, expected[k], epsilon = 5.0 * MESH_ERROR);
        }
    }
}

#[test]
fn a_rotated_pair_moves_rotated() {
    let rotation = UnitQuaternion::from_euler_angles(0.3, 1.2, -0.8);
    let bodies = crooked_pair();
    let rotated = bodies.clone().map(|body| Body {
        position: rotation * body.position,
        orientation: rotation * body.orientation,
        ..body
    });
    let plain = Lab::new(LEVEL, &bodies).unwrap().free_motions().unwrap();
    let turned = Lab::new(LEVEL, &rotated).unwrap().free_motions().unwrap();
    for k in 0..2 {
        assert_relative_eq!(
            turned[k].velocity,
            rotation * plain[k].velocity,
            epsilon = 2.0 * MESH_ERROR
        );
    }
}

#[test]
fn val_two_spheres_far_apart_do_not_interact() {
    let loads = Bem::new(LEVEL)
        .unwrap()
        .loads(Gap::new(1e7).unwrap(), LoadSet::all(2))
        .unwrap();
    for (column, isolated) in loads
        .named()
        .iter()
        .zip(PairLoads::isolated(LoadSet::all(2)).named())
    {
        assert!(
            (column.1 - isolated.1).abs() < 4.0 * MESH_ERROR,
            "{column:?}"
        );
    }
}

#[test]
fn spheres_moving_as_one_rigid_body_squeeze_nothing() {
    // Drag on two touching spheres along their axis is 0.6451 of two lone ones (Stimson & Jeffery
    // 1926): finite, though each scalar diverges.
    let bem = Bem::new(LEVEL).unwrap();
    let sum = |eps: f64| {
        bem.loads(Gap::new(eps).unwrap(), LoadSet::all(1))
            .unwrap()
            .xa
            .sum
    };
    assert_relative_eq!(sum(0.01), 0.645_14, epsilon = 5.0 * MESH_ERROR);
}
