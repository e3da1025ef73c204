//! Laws over random scenes; `PROPTEST_CASES` sets the number of scenes of each law.

#![allow(clippy::float_cmp, reason = "exactly equal is what is claimed")]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::{PI, TAU};

use lt::{Form, Lubrication};
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use scene::{
    Configuration, Gap, Gravity, Orientation, Plan, Pose, Rates, Repulsion, Run, RunOptions, Scene,
    Squirmer, State, rates, run, run_plan,
};

const MODEL: fn() -> Lubrication = || Lubrication::new(Form::Corrected);

/// Short enough that no pair amplifies rounding or truncation beyond the bounds of these tests.
const TIME: f64 = 1.0;

/// Bound on positions, orientations and `ln eps` after [`TIME`] at the tolerance 1e-11: what truncation
/// leaves, times the growth of a difference by the fastest collisions.
const CLOSE: f64 = 1e-6;

fn options() -> RunOptions {
    RunOptions {
        tolerance: 1e-11,
        end_time: TIME,
        ..RunOptions::default()
    }
}

fn config() -> Config {
    Config {
        // Unless the environment says otherwise.
        cases: std::env::var("PROPTEST_CASES").map_or(48, |cases| cases.parse().unwrap()),
        // Of many scenes many are left out: pairs that touch, or part, at the end of the run.
        max_global_rejects: 1 << 20,
        failure_persistence: None,
        ..Config::default()
    }
}

fn squirmer() -> impl Strategy<Value = Squirmer> {
    // Half of them with swirl, of which C_1 alone does nothing.
    let swirl = prop_oneof![Just(Vec::new()), prop::collection::vec(-1.0..1.0, 1..4)];
    (prop::collection::vec(-3.0..3.0, 0..4), swirl, 0.0..20.0).prop_map(|(modes, swirl, g)| {
        let plain = Squirmer::new(&modes).unwrap();
        plain.with_swirl(&swirl).unwrap().bottom_heavy(g).unwrap()
    })
}

fn direction() -> impl Strategy<Value = Vector3<f64>> {
    (-0.999..0.999, 0.0..TAU).prop_map(|(z, azimuth): (f64, f64)| {
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * azimuth.cos(), across * azimuth.sin(), z)
    })
}

fn repulsion() -> impl Strategy<Value = Option<Repulsion>> {
    prop::option::of((1.0..20.0, 50.0..200.0))
        .prop_map(|kappas| kappas.map(|(one, two)| Repulsion::new(one, two).unwrap()))
}

/// Any scene, in contact under lubrication theory, flat or in space.
fn any_scene() -> impl Strategy<Value = Scene> {
    let heading = || (direction(), 0.0..TAU);
    let gravity = prop::option::of(direction());
    (
        [squirmer(), squirmer()],
        direction(),
        0.02..0.9,
        [heading(), heading()],
        repulsion(),
        gravity,
        any::<bool>(),
    )
        .prop_map(
            |(squirmers, line, eps, headings, repulsion, gravity, flat)| {
                let level = |v: Vector3<f64>| Vector3::new(v.x, v.y, if flat { 0.0 } else { v.z });
                let half: Vector3<f64> = level(line).normalize() * (1.0 + 0.5 * eps);
                let start = [0, 1].map(|k| Pose {
                    position: if k == 0 { -half } else { half },
                    orientation: if flat {
                        Orientation::Radians(headings[k].1)
                    } else {
                        Orientation::Vector(headings[k].0)
                    },
                });
                let gravity = gravity.map(|g| Gravity::new(level(g)).unwrap());
                Scene::new(squirmers, start, repulsion, gravity).unwrap()
            },
        )
}

/// The scene with positions, orientations and gravity mapped.
fn mapped(scene: &Scene, map: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Scene {
    let start = scene.start.map(|pose| Pose {
        position: map(pose.position),
        orientation: Orientation::Vector(map(pose.orientation.vector().unwrap())),
    });
    let gravity = (scene.gravity).map(|g| Gravity::new(map(g.direction())).unwrap());
    Scene::new(scene.squirmers, start, scene.repulsion, gravity).unwrap()
}

fn ran(scene: &Scene) -> Run {
    run(scene, &MODEL(), &options()).unwrap()
}

/// Largest difference of what two runs end at, the second mapped.
fn apart(a: &Run, b: &Run, map: impl Fn(Vector3<f64>) -> Vector3<f64>) -> f64 {
    let [x, y] = [a, b].map(|run| run.end.positions());
    let mut most = (a.end_time - b.end_time).abs();
    for k in 0..2 {
        most = most.max((map(x[k]) - y[k]).norm());
        most = most.max((map(a.end.orientations[k]) - b.end.orientations[k]).norm());
    }
    most
}

/// Whether a pair comes so close to the ends of its run, or of contact, that rounding decides which.
fn on_the_edge(run: &Run) -> bool {
    run.end_time < TIME
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn rotated_mirrored_and_exchanged_scenes_have_such_trajectories(
        scene in any_scene(),
        axis in direction(),
        angle in 0.0..TAU,
    ) {
        let plain = ran(&scene);
        prop_assume!(!on_the_edge(&plain));
        let rotation = Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle);
        let turn = |v: Vector3<f64>| rotation * v;
        prop_assert!(apart(&plain, &ran(&mapped(&scene, turn)), turn) < CLOSE);
        let mirror = |v: Vector3<f64>| v - axis * (2.0 * v.dot(&axis));
        // Swirl turns the other way in a mirror.
        let mut mirrored = mapped(&scene, mirror);
        mirrored.squirmers = scene.squirmers.map(|squirmer| {
            let swirl: Vec<_> = squirmer.swirl().iter().map(|c| -c).collect();
            squirmer.with_swirl(&swirl).unwrap()
        });
        prop_assert!(apart(&plain, &ran(&mirrored), mirror) < CLOSE);
        let [one, two] = scene.squirmers;
        let [first, second] = scene.start;
        let exchanged =
            Scene::new([two, one], [second, first], scene.repulsion, scene.gravity).unwrap();
        let exchanged = ran(&exchanged);
        for k in 0..2 {
            let there = plain.end.positions()[k] - exchanged.end.positions()[1 - k];
            prop_assert!(there.norm() < CLOSE);
            let turned = plain.end.orientations[k] - exchanged.end.orientations[1 - k];
            prop_assert!(turned.norm() < CLOSE);
        }
    }

    #[test]
    fn a_passive_pair_without_repulsion_never_moves(
        scene in any_scene(),
        heaviness in 0.0..100.0,
    ) {
        let passive = Squirmer::new(&[0.0, 0.0]).unwrap().bottom_heavy(heaviness).unwrap();
        let still = Scene::new([passive; 2], scene.start, None, scene.gravity).unwrap();
        let run = ran(&still);
        // The lines of centres are kept as angles: sine and cosine round.
        let [end, start] = [&run.end, &run.start].map(Configuration::positions);
        for k in 0..2 {
            prop_assert!((end[k] - start[k]).norm() < 4.0 * f64::EPSILON);
        }
        // An angle of up to a turn from the line of centres, and back.
        let rounding = 4.0 * TAU * f64::EPSILON;
        prop_assert!((run.end.orientations[0] - run.start.orientations[0]).norm() < rounding);
        // The gap is kept as its logarithm.
        let change = run.min_gap / run.start.gap.eps() - 1.0;
        prop_assert!(change.abs() < 16.0 * f64::EPSILON);
    }

    #[test]
    fn an_effect_of_strength_zero_is_an_effect_that_is_off(scene in any_scene()) {
        // Gravity that turns nobody, and modes that are zero.
        let light = scene.squirmers.map(|s| s.bottom_heavy(0.0).unwrap());
        let padded = light.map(|s| {
            let mut modes = s.modes().to_vec();
            modes.extend([0.0, 0.0]);
            let mut swirl = s.swirl().to_vec();
            swirl.extend([0.0, 0.0]);
            Squirmer::new(&modes).and_then(|padded| padded.with_swirl(&swirl)).unwrap()
        });
        let without = Scene::new(light, scene.start, scene.repulsion, None).unwrap();
        let with = Scene::new(padded, scene.start, scene.repulsion, scene.gravity).unwrap();
        prop_assert_eq!(ran(&without), ran(&with));
    }

    #[test]
    fn effects_of_tiny_strength_tend_to_none(scene in any_scene(), down in direction()) {
        let light = scene.squirmers.map(|s| s.bottom_heavy(0.0).unwrap());
        let flat = Plan::new(&scene).unwrap().state() != State::Spatial;
        let down = if flat { Vector3::new(down.x, down.y, 0.0) } else { down };
        let gravity = Some(Gravity::new(down).unwrap());
        let none = Scene::new(light, scene.start, None, None).unwrap();
        let plain = ran(&none);
        // At contact itself the limit is singular: any repulsion keeps the spheres apart.
        prop_assume!(!on_the_edge(&plain) && plain.min_gap > 1e-3);
        let with = |strength: f64| {
            let heavy = light.map(|s| s.bottom_heavy(strength).unwrap());
            let tiny = Repulsion::new(strength, 100.0).unwrap();
            let run = ran(&Scene::new(heavy, scene.start, Some(tiny), gravity).unwrap());
            apart(&plain, &run, |v| v)
        };
        // Linear in the strength, down to what truncation leaves.
        prop_assert!(with(1e-9) < CLOSE + 1e-5);
        prop_assert!(with(1e-13) < CLOSE);
    }

    #[test]
    fn slip_of_tiny_strength_tends_to_none(scene in any_scene()) {
        let plain = scene.squirmers.map(|s| s.with_swirl(&[]).unwrap());
        let none = Scene::new(plain, scene.start, scene.repulsion, scene.gravity).unwrap();
        let none = ran(&none);
        prop_assume!(!on_the_edge(&none) && none.min_gap > 1e-3);
        let with = |strength: f64| {
            // Swirl, which makes a planar scene spatial, and two more squirming modes.
            let squirmers = scene.squirmers.map(|s| {
                let mut modes = s.modes().to_vec();
                modes.extend([strength, -strength]);
                let slip = Squirmer::new(&modes).unwrap();
                let heavy = slip.bottom_heavy(s.bottom_heaviness()).unwrap();
                heavy.with_swirl(&[strength, -strength, strength]).unwrap()
            });
            let with = Scene::new(squirmers, scene.start, scene.repulsion, scene.gravity).unwrap();
            apart(&none, &ran(&with), |v| v)
        };
        prop_assert!(with(1e-9) < CLOSE + 1e-5);
        prop_assert!(with(1e-13) < CLOSE);
    }

    #[test]
    fn no_effect_of_a_plan_can_be_left_out(scene in any_scene(), seeds in prop::array::uniform6(0.0..1.0)) {
        let plan = Plan::new(&scene).unwrap();
        // Near contact, where repulsion is felt.
        let [_, a, b, c, d, e] = seeds;
        let at = reachable(&plan, [0.0, a, b, c, d, e]);
        let of = |plan: &Plan| rates(plan, &MODEL(), &at, 1).unwrap();
        let whole = of(&plan);
        if plan.repulsion().is_some() {
            prop_assert_ne!(of(&plan.clone().without_repulsion()), whole);
        }
        if plan.gravity().is_some() {
            prop_assert_ne!(of(&plan.clone().without_gravity()), whole);
        }
        if plan.swirl() > 0 {
            prop_assert_ne!(of(&plan.clone().without_swirl()), whole);
        }
        for k in 0..2 {
            if !scene.squirmers[k].modes().is_empty() {
                prop_assert_ne!(of(&plan.clone().without_squirming(k)), whole);
            }
        }
        if plan.state() == State::Spatial {
            // In no plane would nothing be lost.
            let start = plan.start();
            let gravity = plan.gravity().map(|g| g.direction());
            let vectors = [start.line, start.orientations[0], start.orientations[1]];
            let spread: Matrix3<f64> = (vectors.into_iter().chain(gravity))
                .map(|v| v * v.transpose())
                .sum();
            let out_of_plane = spread.symmetric_eigenvalues().min();
            prop_assert!(plan.swirl() > 0 || out_of_plane > 1e-14, "{out_of_plane:e}");
        }
    }

    #[test]
    fn what_a_plan_leaves_out_would_change_nothing(scene in any_scene(), seeds in prop::array::uniform6(0.0..1.0)) {
        let light = scene.squirmers.map(|s| s.bottom_heavy(0.0).unwrap());
        let idle = Scene::new(light, scene.start, scene.repulsion, scene.gravity).unwrap();
        for scene in [scene, idle] {
            let plan = Plan::new(&scene).unwrap();
            let at = reachable(&plan, seeds);
            let of = |plan: Plan| rates(&plan, &MODEL(), &at, 1).unwrap();
            let whole = of(plan.clone());
            let more = [
                plan.clone().without_symmetry(),
                plan.clone().with_idle_gravity(),
                plan.clone().in_three_dimensions(),
            ];
            for more in more {
                prop_assert!(difference(&whole, &of(more)) < 1e-12 * size(&whole));
            }
        }
    }
}

/// A configuration that the scene of a plan can reach, as far as its state can tell.
fn reachable(plan: &Plan, [eps, a, b, c, d, e]: [f64; 6]) -> Configuration {
    let start = *plan.start();
    let gap = Gap::new(0.01 + 0.8 * eps).unwrap();
    let in_plane = |angle: f64| Vector3::new(angle.cos(), angle.sin(), 0.0);
    match plan.state() {
        State::Planar => {
            let [line_angle_rad, one, two] = [a, b, c].map(|seed| TAU * seed);
            Configuration {
                gap,
                line: in_plane(line_angle_rad),
                orientations: [in_plane(one), in_plane(two)],
                line_angle_rad,
                angles_rad: [one, two],
                ..start
            }
        }
        State::Spatial => {
            let on_sphere = |z: f64, azimuth: f64| {
                let z = 1.8 * z - 0.9;
                in_plane(TAU * azimuth) * (1.0 - z * z).sqrt() + Vector3::z() * z
            };
            Configuration {
                gap,
                line: on_sphere(a, b),
                orientations: [on_sphere(c, d), on_sphere(e, a)],
                ..start
            }
        }
        // Symmetric starts do not come up at random; tests of their own cover them.
        _ => Configuration { gap, ..start },
    }
}

fn parts(rates: &Rates) -> [Vector3<f64>; 4] {
    let [one, two] = rates.orientations;
    [rates.midpoint, rates.line, one, two]
}

fn size(rates: &Rates) -> f64 {
    (parts(rates).iter().map(Vector3::norm)).fold(rates.ln_gap.abs().max(1.0), f64::max)
}

fn difference(a: &Rates, b: &Rates) -> f64 {
    (parts(a).iter().zip(parts(b)))
        .map(|(a, b)| (a - b).norm())
        .fold((a.ln_gap - b.ln_gap).abs(), f64::max)
}

#[test]
fn symmetric_plans_leave_nothing_out_either() {
    let plain = Squirmer::with_beta(1.0, 4.0).unwrap();
    let swirling = plain.with_swirl(&[0.3, 0.8]).unwrap();
    for angles in [[0.4, PI + 0.4], [0.4, PI - 0.4], [0.0, PI]] {
        let start = [(-1.01, angles[0]), (1.01, angles[1])].map(|(x, angle)| Pose {
            position: [x, 0.0, 0.0].into(),
            orientation: Orientation::Radians(angle),
        });
        // Swirl leaves nothing but a pair on one axis as it is.
        let squirmer = if angles[0] == 0.0 { swirling } else { plain };
        let scene = Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), None).unwrap();
        let plan = Plan::new(&scene).unwrap();
        assert!(plan.state().numbers() < 6 && plan.swirl() == 0);
        let of = |plan: &Plan| rates(plan, &MODEL(), plan.start(), 1).unwrap();
        let whole = of(&plan);
        for more in [
            plan.clone().without_symmetry(),
            plan.clone().in_three_dimensions(),
        ] {
            assert!(difference(&whole, &of(&more)) < 1e-14 * size(&whole));
        }
        assert_ne!(of(&plan.clone().without_repulsion()), whole);
    }
}

#[test]
fn planned_and_full_runs_of_random_scenes_agree() {
    let mut runner = TestRunner::new(config());
    runner
        .run(&any_scene(), |scene| {
            let plan = Plan::new(&scene).unwrap();
            let planned = run_plan(&plan, &MODEL(), &options()).unwrap();
            if on_the_edge(&planned) {
                return Ok(());
            }
            let spatial = plan.in_three_dimensions();
            let spatial = run_plan(&spatial, &MODEL(), &options()).unwrap();
            prop_assert!(apart(&planned, &spatial, |v| v) < CLOSE);
            Ok(())
        })
        .unwrap();
}
