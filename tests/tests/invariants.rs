//! Symmetries and limits that every model and every motion must obey.

#![allow(clippy::float_cmp, reason = "exactly equal is what is claimed")]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::{FRAC_PI_2, PI};

use approx::assert_relative_eq;
use lt::{Form, Lubrication};
use nalgebra::{Rotation3, Vector3};
use scene::{
    Gap, Gravity, Hydrodynamics, LoadSet, Orientation, Plan, Pose, Repulsion, Run, RunOptions,
    Scene, Squirmer, run, run_plan,
};

const FORMS: [Form; 2] = [Form::Published, Form::Corrected];

fn tight() -> RunOptions {
    RunOptions {
        tolerance: 1e-12,
        ..RunOptions::default()
    }
}

fn vector_pose(position: [f64; 3], direction: [f64; 3]) -> Pose {
    Pose {
        position: position.into(),
        orientation: Orientation::Vector(direction.into()),
    }
}

/// A collision with nothing symmetric about it.
fn crooked_scene() -> Scene {
    let squirmers = [
        Squirmer::with_beta(1.0, 3.0).unwrap(),
        Squirmer::with_beta(0.8, -2.0).unwrap(),
    ];
    let start = [
        vector_pose([-1.4, 0.2, 0.1], [1.0, 0.3, 0.1]),
        vector_pose([1.5, 0.0, -0.3], [-0.9, 0.2, 0.4]),
    ];
    Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap()
}

fn lubricated(scene: &Scene, options: &RunOptions) -> Run {
    run(scene, &Lubrication::new(Form::Published), options).unwrap()
}

/// The same in three dimensions, whether the scene calls for them or not.
fn lubricated_in_space(scene: &Scene, options: &RunOptions) -> Run {
    let plan = Plan::new(scene).unwrap().in_three_dimensions();
    run_plan(&plan, &Lubrication::new(Form::Published), options).unwrap()
}

/// The scene with positions and orientations mapped by `map`.
fn mapped(scene: &Scene, map: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Scene {
    let start = scene.start.map(|pose| Pose {
        position: map(pose.position),
        orientation: Orientation::Vector(map(pose.orientation.vector().unwrap())),
    });
    Scene::new(scene.squirmers, start, scene.repulsion, scene.gravity).unwrap()
}

#[test]
fn spheres_moving_as_one_rigid_body_feel_no_lubrication() {
    for form in FORMS {
        let model = Lubrication::new(form);
        let at = |eps: f64| {
            model
                .loads(Gap::new(eps).unwrap(), LoadSet::all(1))
                .unwrap()
        };
        let (near, nearer) = (at(1e-9), at(1e-12));
        // Translation along and across the line of centres.
        assert_relative_eq!(near.xa.sum, nearer.xa.sum, max_relative = 1e-14);
        assert_relative_eq!(near.ya.sum, nearer.ya.sum, max_relative = 1e-14);
        assert_relative_eq!(near.yb.sum, nearer.yb.sum, epsilon = 1e-14);
        // Rotation of the pair about its midpoint: U = -+ (r/2) w, both spheres spin with w.
        let force = |l: &scene::PairLoads| -6.0 * l.ya.difference * 2.0 - 8.0 * l.yb.difference;
        let torque = |l: &scene::PairLoads| 4.0 * l.yb.difference * 2.0 + 16.0 * l.yc.sum;
        assert_relative_eq!(force(&near), force(&nearer), epsilon = 1e-12);
        assert_relative_eq!(torque(&near), torque(&nearer), epsilon = 1e-12);
    }
}

#[test]
fn a_lone_squirmer_swims_at_two_thirds_of_its_first_mode() {
    for form in FORMS {
        let squirmer = Squirmer::new(&[0.9, 2.0, -1.0]).unwrap();
        let start = [
            vector_pose([0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            vector_pose([50.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ];
        let scene = Scene::new([squirmer; 2], start, None, None).unwrap();
        let options = RunOptions {
            sample_interval: Some(1.0),
            ..tight()
        };
        let run = run(&scene, &Lubrication::new(form), &options).unwrap();
        let moved = run.end.positions()[0] - scene.start[0].position;
        assert_relative_eq!(moved.y, 2.0 / 3.0 * 0.9 * run.end_time, epsilon = 1e-12);
    }
}

#[test]
fn a_rotated_scene_has_a_rotated_outcome() {
    let scene = crooked_scene();
    let rotation = Rotation3::from_euler_angles(0.7, -1.1, 2.3);
    let plain = lubricated(&scene, &tight());
    let rotated = lubricated(&mapped(&scene, |v| rotation * v), &tight());
    for k in 0..2 {
        let expected = rotation * plain.end.orientations[k];
        assert_relative_eq!(rotated.end.orientations[k], expected, epsilon = 1e-9);
    }
    assert_relative_eq!(rotated.min_gap, plain.min_gap, max_relative = 1e-9);
}

#[test]
fn a_mirrored_scene_has_a_mirrored_outcome() {
    let scene = crooked_scene();
    let mirror = |v: Vector3<f64>| Vector3::new(v.x, -v.y, v.z);
    let plain = lubricated(&scene, &tight());
    let mirrored = lubricated(&mapped(&scene, mirror), &tight());
    for k in 0..2 {
        let expected = mirror(plain.end.orientations[k]);
        assert_relative_eq!(mirrored.end.orientations[k], expected, epsilon = 1e-9);
    }
    assert_relative_eq!(
        mirrored.deflections_rad()[0],
        -plain.deflections_rad()[0],
        epsilon = 1e-9
    );
}

#[test]
fn exchanged_squirmers_have_exchanged_outcomes() {
    let scene = crooked_scene();
    let [s1, s2] = scene.squirmers;
    let [p1, p2] = scene.start;
    let exchanged = Scene::new([s2, s1], [p2, p1], scene.repulsion, None).unwrap();
    let (plain, exchanged) = (
        lubricated(&scene, &tight()),
        lubricated(&exchanged, &tight()),
    );
    for k in 0..2 {
        assert_relative_eq!(
            exchanged.end.orientations[k],
            plain.end.orientations[1 - k],
            epsilon = 1e-9
        );
    }
}

#[test]
fn planar_and_spatial_motion_agree() {
    let squirmers = [Squirmer::with_beta(1.0, 5.0).unwrap(); 2];
    let angles = [0.4, PI - 0.1];
    let position = [[-1.5, 0.0], [1.5, 0.0]];
    let planar = [0, 1].map(|k| Pose {
        position: [position[k][0], position[k][1], 0.0].into(),
        orientation: Orientation::Radians(angles[k]),
    });
    // The same scene with its plane stood upright.
    let upright = [0, 1].map(|k| {
        vector_pose(
            [position[k][0], 0.0, position[k][1]],
            [angles[k].cos(), 0.0, angles[k].sin()],
        )
    });
    let scene = |start| Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap();
    let flat = lubricated(&scene(planar), &tight());
    let stood = lubricated_in_space(&scene(upright), &tight());
    for k in 0..2 {
        let [a, b] = [flat.end.orientations[k], stood.end.orientations[k]];
        assert_relative_eq!(Vector3::new(a.x, 0.0, a.y), b, epsilon = 1e-9);
    }
    assert_relative_eq!(flat.end_time, stood.end_time, max_relative = 1e-9);
}

#[test]
fn planar_and_spatial_motion_agree_under_gravity() {
    let squirmer = |g| {
        let plain = Squirmer::with_beta(1.0, -5.0).unwrap();
        plain.bottom_heavy(g).unwrap()
    };
    let options = RunOptions {
        end_time: 8.0,
        ..tight()
    };
    let pose = |x: f64, y: f64, z: f64, p: [f64; 3]| vector_pose([x, y, z], p);
    let planar = [
        pose(-1.5, 0.0, 0.0, [0.9, 0.3, 0.0]),
        pose(1.5, 0.0, 0.0, [-0.8, 0.5, 0.0]),
    ];
    let upright = planar.map(|p| {
        let (x, v) = (p.position, p.orientation.vector().unwrap());
        pose(x.x, x.z, x.y, [v.x, v.z, v.y])
    });
    let scene = |start, gravity| {
        let squirmers = [squirmer(2.0), squirmer(4.0)];
        Scene::new(squirmers, start, Some(Repulsion::PAPER), Some(gravity)).unwrap()
    };
    let flat = lubricated(&scene(planar, Gravity::DOWN), &options);
    let down = Gravity::new(Vector3::new(0.0, 0.0, -1.0)).unwrap();
    let stood = lubricated_in_space(&scene(upright, down), &options);
    for k in 0..2 {
        let [a, b] = [flat.end.positions()[k], stood.end.positions()[k]];
        assert_relative_eq!(Vector3::new(a.x, a.z, a.y), b, epsilon = 1e-8);
    }
}

#[test]
fn a_facing_pair_keeps_its_axis_to_the_last_bit() {
    let squirmers = [Squirmer::with_beta(1.0, 5.0).unwrap(); 2];
    let start = [(-1.5, 0.0), (1.5, PI)].map(|(x, angle)| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Radians(angle),
    });
    let scene = Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap();
    let run = lubricated(&scene, &RunOptions::default());
    assert_eq!(run.outcome, scene::Outcome::Standoff);
    assert_eq!(run.deflections_rad(), [0.0, 0.0]);
    assert_eq!(run.end.midpoint, Vector3::zeros());
}

#[test]
fn a_settled_pair_ends_where_integration_to_the_end_takes_it() {
    // Stood upright and in three dimensions, the same scene is integrated all the way. Pullers creep up
    // to the cut for ever, which is where a fixed point is known least well.
    let options = RunOptions {
        tolerance: 1e-10,
        ..RunOptions::default()
    };
    for (beta, delta, sigma) in [(5.0, 0.5, 1.3), (-5.0, 1.0, 0.7), (-5.0, 1.0, 1.25)] {
        let squirmers = [Squirmer::with_beta(1.0, beta).unwrap(); 2];
        let angles = [sigma - delta, sigma + delta].map(|angle| FRAC_PI_2 * angle);
        let flat = [(-1.5, angles[0]), (1.5, angles[1])].map(|(x, angle)| Pose {
            position: [x, 0.0, 0.0].into(),
            orientation: Orientation::Radians(angle),
        });
        let upright = [(-1.5, angles[0]), (1.5, angles[1])]
            .map(|(x, angle)| vector_pose([x, 0.0, 0.0], [angle.cos(), 0.0, angle.sin()]));
        let scene = |start| Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap();
        let settled = lubricated(&scene(flat), &options);
        let integrated = lubricated_in_space(&scene(upright), &options);
        let upright_of = |v: Vector3<f64>| Vector3::new(v.x, 0.0, v.y);
        assert!(
            settled.settled.is_some_and(|t| t < 190.0),
            "{:?}",
            settled.settled
        );
        assert!(settled.counters.loads < integrated.counters.loads);
        for k in 0..2 {
            let [a, b] = [&settled, &integrated].map(|run| run.end.orientations[k]);
            assert_relative_eq!(upright_of(a), b, epsilon = 1e-5);
            let [a, b] = [&settled, &integrated].map(|run| run.end.positions()[k]);
            // The same angle over a path of up to 200 radii.
            assert_relative_eq!(upright_of(a), b, epsilon = 2e-3);
        }
    }
}

#[test]
fn deflections_wind() {
    // Strong pushers caught in an orbit turn through many full circles.
    let squirmers = [Squirmer::with_beta(1.0, -5.0).unwrap(); 2];
    let (delta, sigma) = (1.0, 0.7);
    let start = [(-1.5, sigma - delta), (1.5, sigma + delta)].map(|(x, angle)| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Radians(FRAC_PI_2 * angle),
    });
    let scene = Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap();
    let run = lubricated(&scene, &RunOptions::default());
    assert_eq!(run.outcome, scene::Outcome::Anticlockwise);
    assert!(run.deflections_rad()[0] > 4.0 * PI);
}
