//! Motion in a plane other than that of x and y: the same as there, turned.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::{PI, TAU};

use compare::{Approach, Case};
use lt::{Form, Lubrication};
use nalgebra::{Rotation3, Unit, Vector3};
use proptest::prelude::*;
use scene::{
    Configuration, Gravity, Orientation, Outcome, Plan, Pose, Repulsion, Run, RunOptions, Scene,
    Squirmer, State, rates, run, run_plan,
};

const MODEL: fn() -> Lubrication = || Lubrication::new(Form::Corrected);

const TOLERANCE: f64 = 1e-11;

fn until(end_time: f64) -> RunOptions {
    RunOptions {
        tolerance: TOLERANCE,
        end_time,
        ..RunOptions::default()
    }
}

fn turned(scene: &Scene, turn: &Rotation3<f64>) -> Scene {
    let start = scene.start.map(|pose| Pose {
        position: turn * pose.position,
        orientation: Orientation::Vector(turn * pose.orientation.vector().unwrap()),
    });
    let gravity = (scene.gravity).map(|g| Gravity::new(turn * g.direction()).unwrap());
    Scene::new(scene.squirmers, start, scene.repulsion, gravity).unwrap()
}

/// x to x, y to z.
fn upright() -> Rotation3<f64> {
    let columns = [Vector3::x(), Vector3::z(), -Vector3::y()];
    Rotation3::from_matrix_unchecked(nalgebra::Matrix3::from_columns(&columns))
}

fn oblique() -> Rotation3<f64> {
    Rotation3::new(Vector3::new(0.7, -1.1, 0.4))
}

/// Largest distance of centres and orientations, of the first turned.
fn apart(a: &Configuration, b: &Configuration, turn: &Rotation3<f64>) -> f64 {
    let centres = a.positions().into_iter().zip(b.positions());
    let orientations = a.orientations.into_iter().zip(b.orientations);
    (centres.chain(orientations))
        .map(|(a, b)| (turn * a - b).norm())
        .fold(0.0, f64::max)
}

fn case(approach: Approach, beta: f64, dx: f64, dz: f64) -> Scene {
    let case = Case {
        approach,
        beta,
        dx,
        dz,
    };
    case.scene().unwrap()
}

/// A pair near contact.
fn pair(angles: [f64; 2], squirmers: [Squirmer; 2], gravity: Option<Gravity>) -> Scene {
    let start = [(-1.2, angles[0]), (1.2, angles[1])].map(|(x, angle)| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Radians(angle),
    });
    Scene::new(squirmers, start, Some(Repulsion::PAPER), gravity).unwrap()
}

fn with_beta(beta: f64) -> Squirmer {
    Squirmer::with_beta(1.0, beta).unwrap()
}

#[test]
fn val_an_encounter_in_another_plane_is_the_encounter_in_the_x_y_plane_turned() {
    let heavy = with_beta(2.0).bottom_heavy(5.0).unwrap();
    let scenes = [
        case(Approach::HeadOn, 5.0, 2.0, 0.0),
        case(Approach::Orthogonal, -1.0, 2.0, 0.0),
        pair([0.5, PI - 0.5], [with_beta(1.0); 2], None),
        pair([0.5, 2.0], [with_beta(1.0), with_beta(-2.0)], None),
        pair([0.5, 2.0], [heavy; 2], Some(Gravity::DOWN)),
        pair([1.0, PI - 1.0], [heavy; 2], Some(Gravity::DOWN)),
    ];
    for (i, level) in scenes.iter().enumerate() {
        let plan = Plan::new(level).unwrap();
        let there = run(level, &MODEL(), &until(40.0)).unwrap();
        for turn in [upright(), oblique()] {
            let scene = turned(level, &turn);
            let turned = Plan::new(&scene).unwrap();
            assert_eq!(turned.state(), plan.state());
            assert!(plan.is_level() && !turned.is_level());
            assert_eq!(turned.load_set(), plan.load_set());
            let here = run(&scene, &MODEL(), &until(40.0)).unwrap();
            // The starts are the same to rounding, and what comes of it is told by a run that starts elsewhere by 1e-9.
            let mut aside = level.clone();
            aside.start[1].position.y += 1e-9;
            let aside = run(&aside, &MODEL(), &until(40.0)).unwrap();
            let answer = 1.0 + apart(&there.end, &aside.end, &Rotation3::identity()) / 1e-9;
            let steps = (there.counters.steps + here.counters.steps) as f64;
            let allowed = answer * (32.0 * f64::EPSILON + steps * TOLERANCE);
            let off = apart(&there.end, &here.end, &turn);
            println!("{i} {}: off {off:.1e}, allowed {allowed:.1e}", plan.state());
            assert!(off <= allowed, "{i}: {off:e} {allowed:e}");
            assert_eq!(here.start, *turned.start());
        }
    }
}

#[test]
fn val_opposed_paths_offset_both_ways_meet_as_those_offset_by_the_hypotenuse() {
    // Paths along y that are 0.6 apart along x and 0.8 along z are 1 apart.
    let level = run(
        &case(Approach::HeadOn, 5.0, 1.0, 0.0),
        &MODEL(),
        &until(200.0),
    )
    .unwrap();
    let scene = case(Approach::HeadOn, 5.0, 0.6, 0.8);
    let plan = Plan::new(&scene).unwrap();
    assert_eq!(plan.state(), State::PointSymmetric);
    let tilted = run_plan(&plan, &MODEL(), &until(200.0)).unwrap();
    assert_eq!(tilted.outcome, Outcome::Scattered);
    assert_eq!(tilted.counters.steps, level.counters.steps);
    let close = |a: f64, b: f64| (a - b).abs() < 1e-8;
    assert!(close(tilted.min_gap / level.min_gap, 1.0) && close(tilted.end_time, level.end_time));
    for k in 0..2 {
        let between = |run: &Run| {
            let (a, b) = (run.start.orientations[k], run.end.orientations[k]);
            a.cross(&b).norm().atan2(a.dot(&b))
        };
        assert!(close(between(&tilted), between(&level)));
        // Along the paths alike; across them shared out between x and z.
        let [a, b] = [&level, &tilted].map(|run| run.end.orientations[k]);
        assert!(
            close(b.y, a.y) && close(b.x, 0.6 * a.x) && close(b.z, -0.8 * a.x),
            "{a} {b}"
        );
        // What is reported is the angle of the projection on the x-y plane.
        let projected = b.y.atan2(b.x) - tilted.start.orientations[k].y.atan2(0.0);
        let turns = (tilted.deflections_rad()[k] - projected) / TAU;
        assert!(close(turns, turns.round()), "{turns}");
    }
}

#[test]
fn val_a_motion_in_a_tilted_plane_is_that_in_three_dimensions_windings_included() {
    let orbiting = pair([0.9, 0.9 + PI + 0.3], [with_beta(-5.0); 2], None);
    for turn in [upright(), oblique(), upright().inverse()] {
        let plan = Plan::new(&turned(&orbiting, &turn)).unwrap();
        assert_eq!(plan.state(), State::Planar);
        let options = RunOptions {
            sample_interval: Some(0.25),
            ..until(60.0)
        };
        let flat = run_plan(&plan, &MODEL(), &options).unwrap();
        let spatial = run_plan(&plan.in_three_dimensions(), &MODEL(), &options).unwrap();
        assert_eq!(flat.samples[0].configuration, flat.start);
        assert_eq!(flat.unit_drift.to_bits(), 0);
        // While both run alike.
        let pairs = flat.samples.iter().zip(&spatial.samples);
        for (a, b) in pairs.take_while(|(a, b)| (a.t - b.t).abs() <= 0.0) {
            let off = apart(&a.configuration, &b.configuration, &Rotation3::identity());
            assert!(off < 1e-6, "{off:e} at {}", a.t);
            // A projection of what is upright jumps: it is compared where it is not.
            let level = |v: &Vector3<f64>| v.z.abs() < 0.99;
            for k in 0..2 {
                let [a, b] = [&a.configuration, &b.configuration];
                if level(&a.orientations[k]) {
                    let turns = (a.angles_rad[k] - b.angles_rad[k]) / TAU;
                    assert!((turns - turns.round()).abs() < 1e-5);
                }
            }
        }
    }
}

#[test]
fn the_sense_of_an_orbit_is_that_of_its_projection() {
    let orbiting = pair([0.9, 0.9 + PI], [with_beta(-5.0); 2], None);
    let level = run(&orbiting, &MODEL(), &until(200.0)).unwrap();
    let senses = [Outcome::Anticlockwise, Outcome::Clockwise];
    assert!(senses.contains(&level.outcome), "{}", level.outcome);
    let tilt = |angle: f64| Rotation3::from_axis_angle(&Vector3::x_axis(), angle);
    for (angle, same) in [(1.0, true), (1.5, true), (1.7, false), (3.0, false)] {
        let scene = turned(&orbiting, &tilt(angle));
        let run = run(&scene, &MODEL(), &until(200.0)).unwrap();
        assert_eq!(run.outcome == level.outcome, same, "{angle}");
        assert!(senses.contains(&run.outcome));
        // The projection goes round as often as the pair does, one way or the other.
        let sense = if same { 1.0 } else { -1.0 };
        let turned = run.end.line_angle_rad - run.start.line_angle_rad;
        let expected = level.end.line_angle_rad - level.start.line_angle_rad;
        assert!(
            expected.abs() > TAU && (turned - sense * expected).abs() < PI,
            "{turned} {expected}"
        );
    }
}

#[test]
fn a_plan_names_the_plane() {
    let reason = |scene: &Scene| {
        let rows = Plan::new(scene).unwrap().rows(&MODEL());
        let row = rows.into_iter().find(|row| row.effect == "third dimension");
        row.map(|row| (row.runs, row.reason)).unwrap()
    };
    let level = pair([0.5, 2.0], [with_beta(1.0); 2], None);
    let (runs, why) = reason(&turned(&level, &upright()));
    assert!(
        !runs && why.contains("normal (0.000, -1.000, 0.000)"),
        "{why}"
    );
    let crossing = case(Approach::Orthogonal, 1.0, 1.0, 0.5);
    assert!(reason(&crossing).0);
}

fn direction() -> impl Strategy<Value = Vector3<f64>> {
    (-0.999..0.999, 0.0..TAU).prop_map(|(z, azimuth): (f64, f64)| {
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * azimuth.cos(), across * azimuth.sin(), z)
    })
}

proptest! {
    #[test]
    fn every_planar_scene_is_planar_however_it_is_turned_and_moves_as_in_three_dimensions(
        angles in [0.0..TAU, 0.0..TAU],
        modes in [prop::collection::vec(-3.0..3.0, 1..4), prop::collection::vec(-3.0..3.0, 1..4)],
        down in prop::option::of(0.0..TAU),
        at in prop::array::uniform3(-20.0..20.0),
        line in 0.0..TAU,
        eps in 0.02..0.9,
        axis in direction(),
        angle in 0.0..TAU,
    ) {
        let squirmers = modes.map(|modes| Squirmer::new(&modes).unwrap().bottom_heavy(5.0).unwrap());
        let half = Vector3::new(f64::cos(line), f64::sin(line), 0.0) * (1.0 + 0.5 * eps);
        let at = Vector3::from(at);
        let start = [0, 1].map(|k| Pose {
            position: if k == 0 { at - half } else { at + half },
            orientation: Orientation::Radians(angles[k]),
        });
        let gravity = down.map(|down| Gravity::new([f64::cos(down), f64::sin(down), 0.0].into()).unwrap());
        let level = Scene::new(squirmers, start, Some(Repulsion::PAPER), gravity).unwrap();
        let turn = Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle);
        let plan = Plan::new(&turned(&level, &turn)).unwrap();
        prop_assert_ne!(plan.state(), State::Spatial);
        let rates = |plan: &Plan| rates(plan, &MODEL(), plan.start(), 1).unwrap();
        let (flat, spatial) = (rates(&plan), rates(&plan.clone().in_three_dimensions()));
        let size = 1.0 + spatial.ln_gap.abs() + spatial.orientations[0].norm() + spatial.orientations[1].norm();
        // Rounding of the positions, which are up to 40 from the origin, in gap and line of centres.
        let allowed = 1e-12 * size / eps;
        prop_assert!((flat.ln_gap - spatial.ln_gap).abs() < allowed);
        prop_assert!((flat.midpoint - spatial.midpoint).norm() < allowed);
        prop_assert!((flat.line - spatial.line).norm() < allowed);
        for k in 0..2 {
            prop_assert!((flat.orientations[k] - spatial.orientations[k]).norm() < allowed);
        }
        // Out of the plane by more than rounding it is not.
        let mut nudged = plan.scene().clone();
        nudged.start[0].orientation = Orientation::Vector(
            nudged.start[0].orientation.vector().unwrap() + turn * Vector3::z() * 1e-9,
        );
        let across = f64::sin(angles[1] - line).abs();
        if across > 1e-3 {
            prop_assert_eq!(Plan::new(&nudged).unwrap().state(), State::Spatial);
        }
    }
}
