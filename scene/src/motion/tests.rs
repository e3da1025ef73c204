//! Motions of a made-up model with the true singular parts: what symmetry leaves out is not missed, and what turns a scene turns its motion.

use std::f64::consts::FRAC_PI_3;

use nalgebra::{Rotation3, Vector3};

use crate::made::{Made, Unlike};
use crate::{
    Configuration, Gravity, Hydrodynamics, Orientation, Plan, Pose, Repulsion, Run, RunOptions,
    Scene, Squirmer, State, run_plan,
};

pub(super) const MODEL: Made = Made {
    seam: None,
    noise: 0.0,
};

pub(super) const TIGHT: RunOptions = RunOptions {
    tolerance: 1e-11,
    end_time: 3.0,
    departure_distance: 1e3,
    angles_at: f64::INFINITY,
    sample_interval: Some(0.5),
    max_steps: 1_000_000,
};

pub(super) fn squirmer(beta: f64) -> Squirmer {
    Squirmer::with_beta(1.0, beta).unwrap()
}

pub(super) fn pose(position: [f64; 3], orientation: [f64; 3]) -> Pose {
    Pose {
        position: position.into(),
        orientation: Orientation::Vector(orientation.into()),
    }
}

/// Scenes of each state that a symmetry leaves, in the plane `z = 0.3`, with the effects that it allows.
fn scenes() -> Vec<(State, Scene)> {
    let repulsion = Some(Repulsion::new(2.0, 20.0).unwrap());
    let scene = |of: [Squirmer; 2], start: [Pose; 2], gravity: Option<[f64; 3]>| {
        let gravity = gravity.map(|down| Gravity::new(down.into()).unwrap());
        Scene::new(of, start, repulsion, gravity).unwrap()
    };
    let heavy = |beta: f64| squirmer(beta).bottom_heavy(3.0).unwrap();
    let beside =
        |one: [f64; 3], two: [f64; 3]| [pose([-1.2, 0.1, 0.3], one), pose([1.2, 0.1, 0.3], two)];
    vec![
        (
            State::Axisymmetric,
            scene(
                [squirmer(2.0); 2],
                beside([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]),
                None,
            ),
        ),
        (
            State::Axisymmetric,
            scene(
                [squirmer(2.0), squirmer(-1.0)],
                beside([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
                None,
            ),
        ),
        (
            State::MirrorSymmetric,
            scene(
                [squirmer(2.0); 2],
                beside([0.6, 0.8, 0.0], [-0.6, 0.8, 0.0]),
                None,
            ),
        ),
        (
            State::MirrorSymmetric,
            scene(
                [heavy(1.0); 2],
                beside([0.6, 0.8, 0.0], [-0.6, 0.8, 0.0]),
                Some([0.0, -1.0, 0.0]),
            ),
        ),
        (
            State::PointSymmetric,
            scene(
                [squirmer(2.0); 2],
                beside([0.6, 0.8, 0.0], [-0.6, -0.8, 0.0]),
                None,
            ),
        ),
        (
            State::Planar,
            scene(
                [squirmer(2.0), squirmer(-1.0)],
                beside([0.6, 0.8, 0.0], [-0.8, 0.6, 0.0]),
                None,
            ),
        ),
        (
            State::Planar,
            scene(
                [heavy(2.0), squirmer(-1.0)],
                beside([0.6, 0.8, 0.0], [-0.8, 0.6, 0.0]),
                Some([0.6, -0.8, 0.0]),
            ),
        ),
    ]
}

fn of(plan: &Plan, model: &dyn Hydrodynamics) -> Run {
    run_plan(plan, model, &TIGHT).unwrap()
}

fn vectors(of: &Configuration) -> [Vector3<f64>; 4] {
    let ([a, b], [p, q]) = (of.positions(), of.orientations);
    [a, b, p, q]
}

#[track_caller]
fn assert_close(a: &Configuration, b: &Configuration, bound: f64, what: &str) {
    for (i, (a, b)) in vectors(a).into_iter().zip(vectors(b)).enumerate() {
        let off = (a - b).norm();
        assert!(
            off < bound,
            "{what}, vector {i}: {a} against {b}, off by {off:e}"
        );
    }
}

#[test]
fn states_that_a_symmetry_leaves_out_of_the_motion_do_not_change_it() {
    for (state, scene) in scenes() {
        let plan = Plan::new(&scene).unwrap();
        assert_eq!(plan.state(), state);
        let found = of(&plan, &MODEL);
        assert!(
            found.samples.len() > 4,
            "{state:?}: {}",
            found.samples.len()
        );
        for other in [plan.clone().without_symmetry(), plan.in_three_dimensions()] {
            let expected = of(&other, &MODEL);
            let what = format!("{state:?} against {:?}", other.state());
            assert_close(&found.end, &expected.end, 1e-7, &what);
            assert_close(&found.outgoing, &expected.outgoing, 1e-7, &what);
            assert_eq!(found.samples.len(), expected.samples.len(), "{what}");
            for (a, b) in found.samples.iter().zip(&expected.samples) {
                assert!((a.t - b.t).abs() < 1e-9);
                assert_close(&a.configuration, &b.configuration, 1e-7, &what);
            }
            assert!(
                (found.min_gap / expected.min_gap - 1.0).abs() < 1e-6,
                "{what}"
            );
            assert!(
                (found.contact_time - expected.contact_time).abs() < 1e-6,
                "{what}"
            );
        }
    }
}

#[test]
fn a_scene_in_any_plane_moves_as_the_one_that_was_turned_there() {
    let turn = Rotation3::from_euler_angles(0.4, 1.1, -FRAC_PI_3);
    let moved = Vector3::new(3.0, -2.0, 1.0);
    let turned = |of: Configuration| Configuration {
        midpoint: turn * of.midpoint + moved,
        line: turn * of.line,
        orientations: of.orientations.map(|p| turn * p),
        ..of
    };
    for (state, level) in scenes() {
        let start = level.start.map(|of| Pose {
            position: turn * of.position + moved,
            orientation: Orientation::Vector(turn * of.orientation.vector().unwrap()),
        });
        let gravity = (level.gravity).map(|g| Gravity::new(turn * g.direction()).unwrap());
        let scene = Scene::new(level.squirmers, start, level.repulsion, gravity).unwrap();
        let (level, tilted) = [&level, &scene].map(|of| Plan::new(of).unwrap()).into();
        // Rounding may hide a symmetry; what it leaves out is not missed.
        let (expected, found) = (of(&level, &MODEL), of(&tilted, &MODEL));
        let what = format!("{state:?}");
        // The start is the scene's own, to the last bit.
        assert_eq!(found.start, *tilted.start(), "{what}");
        assert_eq!(found.samples[0].configuration, *tilted.start(), "{what}");
        assert_close(&found.end, &turned(expected.end), 1e-8, &what);
        assert_close(&found.outgoing, &turned(expected.outgoing), 1e-8, &what);
        let whole = of(&tilted.clone().without_symmetry(), &MODEL);
        assert_close(&whole.end, &turned(expected.end), 1e-7, &what);
        for (a, b) in found.samples.iter().zip(&expected.samples) {
            assert!(
                (a.t - b.t).abs() < 1e-9
                    && (a.configuration.gap.eps() / b.configuration.gap.eps() - 1.0).abs() < 1e-8
            );
            assert_close(&a.configuration, &turned(b.configuration), 1e-8, &what);
        }
    }
}

#[test]
fn swirl_about_the_line_of_centres_runs_only_if_it_is_asked_for() {
    let spinning = squirmer(2.0).with_swirl(&[0.4, 0.9]).unwrap();
    let start = [
        pose([-1.2, 0.1, 0.3], [1.0, 0.0, 0.0]),
        pose([1.2, 0.1, 0.3], [-1.0, 0.0, 0.0]),
    ];
    let plan = Plan::new(&Scene::new([spinning; 2], start, None, None).unwrap()).unwrap();
    assert_eq!((plan.state(), plan.swirl()), (State::Axisymmetric, 0));
    let whole = plan.clone().without_symmetry();
    assert_eq!(whole.swirl(), 2);
    assert_eq!(plan.clone().with_idle_gravity().swirl(), 2);
    let (found, expected) = (of(&plan, &MODEL), of(&whole, &MODEL));
    assert_close(&found.end, &expected.end, 1e-7, "spinning");
}

#[test]
fn a_pair_of_unlike_radii_moves_the_same_whoever_is_named_first() {
    let ratio = 0.6;
    let large = squirmer(1.0).with_swirl(&[0.0, 0.7]).unwrap();
    let small = |unit: f64| {
        squirmer(-2.0)
            .with_swirl(&[0.0, -0.4])
            .unwrap()
            .with_radius(unit)
            .unwrap()
    };
    let start = [
        pose([0.0, 0.1, 0.0], [1.0, 0.3, 0.1]),
        pose([1.9, 0.0, 0.2], [-1.0, 0.2, 0.4]),
    ];
    let one = Scene::new([large, small(ratio)], start, None, None).unwrap();
    // In radii of the smaller one.
    let scaled = [1, 0].map(|k| Pose {
        position: start[k].position / ratio,
        ..start[k]
    });
    let two = Scene::new(
        [small(1.0), large.with_radius(1.0 / ratio).unwrap()],
        scaled,
        None,
        None,
    )
    .unwrap();
    let plans = [one, two].map(|scene| Plan::new(&scene).unwrap());
    assert_eq!(plans[0].swirl(), 2);
    let end = |k: usize, model: Unlike| {
        let options = RunOptions {
            end_time: if k == 0 { 2.0 } else { 2.0 / ratio },
            ..TIGHT
        };
        run_plan(&plans[k], &model, &options).unwrap().end
    };
    let (first, second) = (end(0, Unlike(ratio)), end(1, Unlike(1.0 / ratio)));
    println!("{first:?} {second:?}");
    for k in [0, 1] {
        let off = first.positions()[k] - second.positions()[1 - k] * ratio;
        assert!(off.norm() < 1e-7, "position {k}: {off}");
        let off = first.orientations[k] - second.orientations[1 - k];
        assert!(off.norm() < 1e-7, "orientation {k}: {off}");
    }
}

#[test]
fn what_a_plan_leaves_out_is_as_if_the_scene_had_it_not() {
    let of_modes = |beta: f64, swirl: f64| {
        let of = squirmer(beta).with_swirl(&[0.0, swirl]).unwrap();
        of.bottom_heavy(3.0).unwrap()
    };
    let scene = Scene::new(
        [of_modes(2.0, 0.6), of_modes(-1.0, -0.9)],
        [
            pose([-1.2, 0.0, 0.1], [1.0, 0.4, 0.2]),
            pose([1.2, 0.1, 0.0], [-1.0, 0.3, -0.5]),
        ],
        Some(Repulsion::new(2.0, 20.0).unwrap()),
        Some(Gravity::new([0.3, -1.0, 0.1].into()).unwrap()),
    )
    .unwrap();
    let plan = Plan::new(&scene).unwrap();
    assert_eq!((plan.state(), plan.swirl()), (State::Spatial, 2));
    let whole = of(&plan, &MODEL);
    let plain = |k: usize| Squirmer::new(scene.squirmers[k].modes()).unwrap();
    let heavy = [plain(0), plain(1)].map(|of| of.bottom_heavy(3.0).unwrap());
    let weightless = [0, 1].map(|k| plain(k).with_swirl(scene.squirmers[k].swirl()).unwrap());
    let passive = Squirmer::new(&[]).unwrap();
    let squirmers = |of: [Squirmer; 2]| Scene {
        squirmers: of,
        ..scene.clone()
    };
    let cases = [
        (
            "repulsion",
            plan.clone().without_repulsion(),
            Scene {
                repulsion: None,
                ..scene.clone()
            },
        ),
        (
            "gravity",
            plan.clone().without_gravity(),
            squirmers(weightless),
        ),
        ("swirl", plan.clone().without_swirl(), squirmers(heavy)),
        (
            "squirming",
            plan.clone().without_gravity().without_squirming(1),
            squirmers([weightless[0], passive]),
        ),
    ];
    for (what, left_out, without) in cases {
        let (found, expected) = (
            of(&left_out, &MODEL),
            of(&Plan::new(&without).unwrap(), &MODEL),
        );
        assert_close(&found.end, &expected.end, 1e-8, what);
        let off = (found.end.positions()[0] - whole.end.positions()[0]).norm();
        assert!(off > 1e-4, "{what} acts: {off:e}");
        assert_eq!(left_out.state(), State::Spatial, "{what}");
    }
}

#[test]
fn gravity_that_turns_nothing_runs_only_if_it_is_asked_for() {
    let gravity = Gravity::new([0.3, -1.0, 0.5].into()).unwrap();
    for (_, level) in scenes() {
        let scene = Scene {
            gravity: Some(gravity),
            squirmers: level.squirmers.map(|of| Squirmer::new(of.modes()).unwrap()),
            ..level
        };
        let plan = Plan::new(&scene).unwrap();
        assert_eq!(plan.gravity(), None);
        let idle = plan.clone().with_idle_gravity();
        assert_eq!(idle.gravity(), Some(gravity));
        assert!(matches!(idle.state(), State::Planar | State::Spatial));
        let spatial = [&plan, &idle].map(|of| of.clone().in_three_dimensions());
        // Its torque would turn a squirmer about the line of centres.
        assert_eq!(
            spatial.each_ref().map(|of| of.load_set().twist),
            [false, true]
        );
        assert_close(
            &of(&plan, &MODEL).end,
            &of(&spatial[1], &MODEL).end,
            1e-7,
            "in space",
        );
        assert_close(&of(&plan, &MODEL).end, &of(&idle, &MODEL).end, 1e-7, "idle");
    }
}
