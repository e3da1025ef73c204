//! Pairs that are not alike, with and without swirl: other slip modes, strengths, or none at all.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
#![allow(clippy::float_cmp, reason = "exactly equal is what is claimed")]

use approx::assert_relative_eq;
use bem::{Bem, Body, Lab, Motion};
use exact::Exact;
use lt::{Form, Lubrication};
use nalgebra::{Unit, Vector3};
use scene::mobility::{External, Heading, MobilitySet, add_swirl, pair_velocity};
use scene::{
    Gap, Hydrodynamics, LoadSet, Orientation, Pose, Repulsion, Run, RunOptions, Scene, Squirmer,
    run,
};

/// A squirmer at a place.
struct Placed {
    position: Vector3<f64>,
    p: Vector3<f64>,
    squirmer: Squirmer,
}

fn placed(position: [f64; 3], p: [f64; 3], modes: &[f64], swirl: &[f64]) -> Placed {
    Placed {
        position: position.into(),
        p: Vector3::from(p).normalize(),
        squirmer: Squirmer::new(modes).unwrap().with_swirl(swirl).unwrap(),
    }
}

/// Velocities and angular velocities of a free pair from its loads and the balance in the pair frame.
fn pair_frame_motions(model: &impl Hydrodynamics, pair: &[Placed; 2]) -> [Motion; 2] {
    let separation = pair[1].position - pair[0].position;
    let distance = separation.norm();
    let d = separation / distance;
    let gap = Gap::new(distance - 2.0).unwrap();
    let squirmers = [pair[0].squirmer, pair[1].squirmer];
    let highest = |of: fn(&Squirmer) -> &[f64]| squirmers.iter().map(|s| of(s).len()).max();
    let set = LoadSet::all(highest(Squirmer::modes).unwrap_or(0))
        .with_swirl(highest(Squirmer::swirl).unwrap_or(0));
    let set = MobilitySet {
        loads: set,
        torque: false,
    };
    let mobility = model.mobility(gap, set).unwrap();
    let headings = [(0, 1.0), (1, -1.0)].map(|(k, sign): (usize, f64)| {
        let p = pair[k].p;
        Heading {
            cosine: sign * p.dot(&d),
            transverse: p - d * p.dot(&d),
        }
    });
    let turned = [0, 1].map(|k| d.cross(&headings[k].transverse));
    let external = External {
        repulsion: 0.0,
        torque: None,
    };
    let mut v = pair_velocity(
        (&mobility.pair, &mobility.modes[..set.loads.modes]),
        &squirmers,
        &headings,
        &external,
    );
    let axial = add_swirl(&mut v, &mobility.swirl, &squirmers, (&headings, &turned));
    let mean = d * v.mean_axial + v.mean_transverse;
    let half = (d * (v.opening * gap.eps()) + v.turning * distance) * 0.5;
    [(0, -1.0), (1, 1.0)].map(|(k, side): (usize, f64)| Motion {
        velocity: mean + half * side,
        angular_velocity: d.cross(&v.spin[k]) + d * axial[k],
    })
}

/// The same solved for in the laboratory frame, slip and all.
fn laboratory_motions(level: usize, pair: &[Placed; 2]) -> Vec<Motion> {
    let bodies = [0, 1].map(|k| Body {
        orientation: Unit::new_normalize(pair[k].p),
        swirl: pair[k].squirmer.swirl().to_vec(),
        ..Body::squirmer(pair[k].position, pair[k].p, pair[k].squirmer.modes())
    });
    Lab::new(level, &bodies).unwrap().free_motions().unwrap()
}

fn assert_same_motions(found: &[Motion; 2], truth: &[Motion], tolerance: f64) {
    for (a, b) in found.iter().zip(truth) {
        assert_relative_eq!(a.velocity, b.velocity, epsilon = tolerance);
        assert_relative_eq!(a.angular_velocity, b.angular_velocity, epsilon = tolerance);
    }
}

/// Motions by the exact series and by boundary elements in the frame of the pair, against boundary elements
/// in the laboratory frame.
fn assert_moves_as_in_the_laboratory(pair: &[Placed; 2]) {
    let truth = laboratory_motions(3, pair);
    assert_same_motions(&pair_frame_motions(&Exact::new(), pair), &truth, 2e-4);
    assert_same_motions(
        &pair_frame_motions(&Bem::new(3).unwrap(), pair),
        &truth,
        3e-3,
    );
}

#[test]
fn val_unlike_squirmers_move_as_the_laboratory_frame_says() {
    let one = placed(
        [0.2, 0.1, -0.4],
        [0.6, 0.8, 0.0],
        &[1.5, 3.0, -0.7, 0.0, 0.5],
        &[],
    );
    let two = placed([1.3, -1.6, 0.9], [0.0, -0.6, 0.8], &[0.6, -1.5], &[]);
    let pair = [one, two];
    assert_moves_as_in_the_laboratory(&pair);
}

#[test]
fn val_squirmers_with_swirl_move_as_the_laboratory_frame_says() {
    let one = placed(
        [0.2, 0.1, -0.4],
        [0.6, 0.8, 0.0],
        &[1.5, 3.0],
        &[0.5, 2.0, -1.0],
    );
    let two = placed([1.3, -1.6, 0.9], [0.0, -0.6, 0.8], &[0.6], &[-1.0, 1.5]);
    let pair = [one, two];
    assert_moves_as_in_the_laboratory(&pair);
}

#[test]
fn val_a_passive_sphere_beside_a_squirmer_moves_as_laboratory_frame_says() {
    let one = placed([0.0, 0.0, 0.0], [0.3, 0.8, 0.5], &[1.5, -4.5], &[0.0, 3.0]);
    let two = placed([2.3, 0.0, 0.0], [0.0, 0.0, 1.0], &[], &[]);
    let pair = [one, two];
    let truth = laboratory_motions(3, &pair);
    assert_same_motions(&pair_frame_motions(&Exact::new(), &pair), &truth, 2e-4);
}

#[test]
fn val_a_passive_sphere_far_away_moves_in_the_flow_of_a_lone_squirmer_by_faxens_law() {
    // Lone squirmer (Blake 1971): source dipole B_1/3 r^-3 (3 c n - p); stresslet and quadrupole
    // B_2 [(r^-4 - r^-2) P_2 n + r^-4 c (c n - p)]; swirl C_2 r^-3 c p x n. With Faxen's
    // a^2/6 of the stresslet's Laplacian; the reflection from the passive sphere is of order r^-5 at
    // the squirmer, r^-8 back at the sphere.
    let (b1, b2, c2) = (1.5, 6.0, 2.5);
    for r in [10.0, 30.0] {
        let n = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        let one = placed([0.0; 3], [0.3, 0.8, 0.5], &[b1, b2], &[0.4, c2]);
        let p = one.p;
        let two = placed((n * r).into(), [0.0, 0.0, 1.0], &[], &[]);
        let [squirmer, sphere] = pair_frame_motions(&Exact::new(), &[one, two]);
        let c = p.dot(&n);
        let second = 1.5 * c * c - 0.5;
        let velocity = (n * (3.0 * c) - p) * (b1 / 3.0 * r.powi(-3))
            + n * (-b2 * second / (r * r))
            + (n * second + (n * c - p) * c) * (2.0 * b2 * r.powi(-4))
            + p.cross(&n) * (c2 * c * r.powi(-3));
        let spin = p.cross(&n) * (-1.5 * b2 * c * r.powi(-3))
            + (n * (5.0 * c * c - 1.0) - p * (2.0 * c)) * (0.5 * c2 * r.powi(-4));
        let noise = 1e-12;
        assert!((sphere.velocity - velocity).norm() < 100.0 * r.powi(-8) + noise);
        assert!((sphere.angular_velocity - spin).norm() < 100.0 * r.powi(-9) + noise);
        assert!((squirmer.velocity - p * (2.0 * b1 / 3.0)).norm() < 100.0 * r.powi(-5));
        assert!((squirmer.angular_velocity + p * 0.4).norm() < 100.0 * r.powi(-6));
    }
}

#[test]
fn val_a_squirmer_cancels_its_first_swirl_mode_by_spinning_back_and_nothing_else_moves() {
    let one = placed([0.0; 3], [0.3, 0.8, 0.5], &[], &[0.7]);
    let two = placed([1.1, -1.7, 0.6], [0.0, 0.0, 1.0], &[], &[]);
    let p = one.p;
    let pair = [one, two];
    for (found, tolerance) in [
        (pair_frame_motions(&Exact::new(), &pair), 1e-12),
        (
            pair_frame_motions(&Lubrication::new(Form::Published), &pair),
            1e-14,
        ),
        (pair_frame_motions(&Bem::new(2).unwrap(), &pair), 1e-5),
    ] {
        let [swirler, sphere] = found;
        assert_relative_eq!(swirler.angular_velocity, p * -0.7, epsilon = tolerance);
        for zero in [swirler.velocity, sphere.velocity, sphere.angular_velocity] {
            assert!(zero.norm() < tolerance, "{zero:e}");
        }
    }
}

#[test]
fn val_the_first_instant_of_a_run_is_the_motion_that_the_balance_gives() {
    let scene = collision([&[0.4, 2.0], &[-0.3, 0.0, 3.0]]);
    let pair = [0, 1].map(|k| Placed {
        position: scene.start[k].position,
        p: scene.start[k].orientation.vector().unwrap(),
        squirmer: scene.squirmers[k],
    });
    let free = Scene {
        repulsion: None,
        ..scene
    };
    let time = 1e-6;
    let options = RunOptions {
        end_time: time,
        tolerance: 1e-13,
        ..RunOptions::default()
    };
    let model = Exact::new();
    let end = run(&free, &model, &options).unwrap().end;
    let motions = pair_frame_motions(&model, &pair);
    for (k, motion) in motions.iter().enumerate() {
        let moved = (end.positions()[k] - pair[k].position) / time;
        let turned = (end.orientations[k] - pair[k].p) / time;
        assert_relative_eq!(moved, motion.velocity, epsilon = 2e-5);
        let turning = motion.angular_velocity.cross(&pair[k].p);
        assert_relative_eq!(turned, turning, epsilon = 2e-5);
        assert!(turning.z.abs() > 5e-4, "out of the plane: {turning}");
    }
}

fn scene(start: [Pose; 2], swirl: [&[f64]; 2]) -> Scene {
    let squirmers = [(0, 3.0), (1, -2.0)].map(|(k, beta)| {
        let plain = Squirmer::with_beta(1.0, beta).unwrap();
        plain.with_swirl(swirl[k]).unwrap()
    });
    Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap()
}

fn pose(position: [f64; 3], orientation: Orientation) -> Pose {
    Pose {
        position: position.into(),
        orientation,
    }
}

fn collision(swirl: [&[f64]; 2]) -> Scene {
    let start = [
        pose([-1.4, 0.2, 0.0], Orientation::Radians(0.3)),
        pose([1.5, 0.0, 0.0], Orientation::Radians(2.9)),
    ];
    scene(start, swirl)
}

fn lubricated(scene: &Scene) -> Run {
    run(
        scene,
        &Lubrication::new(Form::Published),
        &RunOptions::default(),
    )
    .unwrap()
}

#[test]
fn reversed_swirl_mirrors_the_trajectory_to_the_last_bit() {
    let one = lubricated(&collision([&[0.0, 2.0], &[0.3, -1.0, 0.5]]));
    let other = lubricated(&collision([&[0.0, -2.0], &[-0.3, 1.0, -0.5]]));
    let out_of_plane = one.end.orientations[0].z.abs();
    assert!(
        out_of_plane > 1e-2,
        "swirl pushes out of the plane: {out_of_plane}"
    );
    let mirrored = |v: Vector3<f64>| Vector3::new(v.x, v.y, -v.z);
    assert_eq!(one.end.midpoint, mirrored(other.end.midpoint));
    for k in 0..2 {
        let images = other.end.orientations.map(mirrored);
        assert_eq!(one.end.orientations[k], images[k]);
    }
    assert_eq!(one.counters, other.counters);
}

#[test]
fn the_first_swirl_mode_changes_no_trajectory() {
    let without = lubricated(&collision([&[], &[]]));
    assert_eq!(lubricated(&collision([&[2.0], &[-0.7]])), without);
}

#[test]
fn a_head_on_pair_keeps_its_axis_and_its_gaps_whatever_the_swirl() {
    let facing = |orientations: [Orientation; 2], swirl| {
        let [one, two] = orientations;
        let start = [pose([-1.4, 0.0, 0.0], one), pose([1.4, 0.0, 0.0], two)];
        lubricated(&scene(start, swirl))
    };
    let vectors = [Vector3::x(), -Vector3::x()].map(Orientation::Vector);
    let with = facing(vectors, [&[0.5, 2.0], &[0.0, 1.0, -3.0]]);
    // In contact from the start, angles from the direction to the other one are zero, exactly: the planar
    // motion keeps its axis too.
    let angles = [0.0, std::f64::consts::PI].map(Orientation::Radians);
    let without = facing(angles, [&[], &[]]);
    assert_eq!(with.end.orientations, [Vector3::x(), -Vector3::x()]);
    assert_eq!((with.end.midpoint.y, with.end.midpoint.z), (0.0, 0.0));
    assert_relative_eq!(with.min_gap, without.min_gap, max_relative = 1e-6);
    assert_relative_eq!(with.end.midpoint.x, without.end.midpoint.x, epsilon = 1e-5);
}
