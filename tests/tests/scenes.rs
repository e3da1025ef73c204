//! Scene files, reduced states and contact: against the dedicated commands, the full motion and closed
//! forms.

#![allow(clippy::float_cmp, reason = "exactly equal is what is claimed")]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::PathBuf;

use approx::assert_relative_eq;
use compare::maps::{Pair, scatter_row};
use compare::{Approach, Case, Defaults, Method, Model, ModelOptions, SceneFile};
use lt::{Form, Lubrication};
use nalgebra::Vector3;
use scene::{
    Gap, GapRange, Gravity, Hydrodynamics, Isolated, LoadSet, ModelDescription, Orientation,
    Outcome, PairLoads, Plan, Pose, Repulsion, Run, RunOptions, Scene, SceneError, Squirmer, State,
    SwirlLoads, rates, run, run_plan,
};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../fixtures/scenes")
}

fn scene_file(name: &str) -> SceneFile {
    let text = std::fs::read_to_string(folder().join(format!("{name}.toml"))).unwrap();
    SceneFile::parse(&text).unwrap()
}

fn lubrication() -> Model {
    Model::set_up(Method::Lt, &ModelOptions::default()).unwrap()
}

fn ran(file: &SceneFile) -> Run {
    lubrication().run(&file.scene, &file.run).unwrap()
}

#[test]
fn every_scene_file_is_read_and_ends_in_a_named_outcome() {
    let mut count = 0;
    for entry in std::fs::read_dir(folder()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let file = scene_file(name.strip_suffix(".toml").unwrap());
        let run = ran(&file);
        assert_ne!(run.outcome, Outcome::Undecided, "{name}");
        count += 1;
    }
    assert_eq!(count, 35);
}

#[test]
fn encounters_from_files_are_those_of_their_commands_to_the_last_bit() {
    let defaults = Defaults::paper().unwrap();
    let mut cases = Vec::new();
    for approach in [Approach::HeadOn, Approach::Orthogonal] {
        let lists = defaults.encounters(approach);
        for &beta in &lists.beta {
            for &dx in &lists.dx {
                let name = match approach {
                    Approach::HeadOn => format!("fig6-head-on-dx{dx}"),
                    Approach::Orthogonal => format!("fig7-orthogonal-beta{beta}-dx{dx}"),
                };
                cases.push((name, approach, beta, dx, 0.0));
            }
        }
    }
    let offset = [
        ("fig5b-head-on-dx1-dz0.5", Approach::HeadOn, 5.0),
        (
            "fig5b-orthogonal-beta1-dx1-dz0.5",
            Approach::Orthogonal,
            1.0,
        ),
    ];
    cases.extend(offset.map(|(name, approach, beta)| (name.to_owned(), approach, beta, 1.0, 0.5)));
    for (name, approach, beta, dx, dz) in cases {
        let case = Case {
            approach,
            beta,
            dx,
            dz,
        };
        let file = scene_file(&name);
        assert_eq!(file.scene, case.scene().unwrap(), "{name}");
        let options = RunOptions {
            sample_interval: Some(0.05),
            ..RunOptions::default()
        };
        let command = lubrication().run(&case.scene().unwrap(), &options);
        assert_eq!(ran(&file), command.unwrap(), "{name}");
    }
}

#[test]
fn starts_of_the_maps_from_files_have_the_numbers_of_the_map() {
    for (name, beta, delta, sigma, g) in [
        ("fig2-neutral-ii", 0.0, 0.75, 1.0, 0.0),
        ("fig2-neutral-standoff", 0.0, 1.0, 1.0, 0.0),
        ("fig3-puller-scattered", 1.0, 0.5, 1.25, 0.0),
        ("fig3-puller-pairwise", 5.0, 0.5, 1.25, 0.0),
        ("fig4-pusher-scattered", -1.0, 0.5, 1.25, 0.0),
        ("fig4-pusher-mirror", -5.0, 0.75, 1.0, 0.0),
        ("fig4-pusher-anticlockwise", -5.0, 1.0, 0.75, 0.0),
        ("fig4-pusher-clockwise", -5.0, 1.0, 1.25, 0.0),
        ("fig8a-upward-puller", 1.0, 1.5, 0.6, 10.0),
        ("fig8b-upward-neutral", 0.0, 1.5, 0.6, 10.0),
        ("fig8c-splayed", -5.0, 0.5, 1.0, 50.0),
        ("fig8d-drifting-orbit", -5.0, 1.0, 0.7, 1.0),
        ("fig8e-downward", 2.0, 1.7, 1.0, 5.0),
        ("fig8f-u-turn", 2.0, 1.75, 1.05, 5.0),
    ] {
        let file = scene_file(name);
        let options = file.run;
        let row = scatter_row(
            &lubrication(),
            Pair { beta, g, dz: 0.0 },
            (delta, sigma),
            &options,
        );
        let run = ran(&file);
        assert_eq!(run.outcome.to_string(), row.outcome, "{name}");
        let [one, two] = run.deflections_rad().map(|angle| angle.to_degrees() + 0.0);
        let found = [one, two, run.min_gap, run.contact_time];
        let expected = [
            row.deflection1_deg,
            row.deflection2_deg,
            row.min_gap,
            row.tau,
        ];
        // The map's angles are products of pi, which may differ from degrees in the last bit.
        let same = file.scene == Pair { beta, g, dz: 0.0 }.scene(delta, sigma).unwrap();
        if same {
            assert_eq!(found, expected, "{name}");
        } else {
            for (a, b) in found.into_iter().zip(expected) {
                assert_relative_eq!(a, b, max_relative = 1e-6, epsilon = 1e-6);
            }
        }
    }
}

#[test]
fn bottom_heavy_pairs_from_files_are_those_of_their_command() {
    let panels = Defaults::paper().unwrap().bottom_heavy;
    let names: Vec<_> = (std::fs::read_dir(folder()).unwrap())
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert_eq!(panels.len(), 6);
    for panel in panels {
        let of_panel = format!("fig8{}", panel.panel);
        let name = names.iter().find(|name| name.starts_with(&of_panel));
        let file = scene_file(name.and_then(|name| name.strip_suffix(".toml")).unwrap());
        let command = lubrication().run(&panel.scene().unwrap(), &file.run);
        let (found, expected) = (ran(&file), command.unwrap());
        assert_eq!(found.outcome, expected.outcome, "{of_panel}");
        // Degrees and products of pi may differ in the last bit.
        assert_relative_eq!(found.min_gap, expected.min_gap, max_relative = 1e-6);
        for k in 0..2 {
            let [a, b] = [&found, &expected].map(|run| run.deflections_rad()[k]);
            assert_relative_eq!(a, b, max_relative = 1e-6, epsilon = 1e-6);
        }
    }
}

#[test]
fn scene_files_of_bound_states_end_in_them() {
    for (name, outcome) in [
        ("fig2-neutral-standoff", Outcome::Standoff),
        ("fig3-puller-pairwise", Outcome::Pairwise),
        ("fig4-pusher-anticlockwise", Outcome::Anticlockwise),
        ("fig4-pusher-clockwise", Outcome::Clockwise),
        ("fig8a-upward-puller", Outcome::Upward),
        ("fig8b-upward-neutral", Outcome::Upward),
        ("fig8c-splayed", Outcome::Upward),
        ("fig8e-downward", Outcome::Downward),
    ] {
        assert_eq!(ran(&scene_file(name)).outcome, outcome, "{name}");
    }
}

#[test]
fn val_neutral_pairs_from_files_turn_and_stay_as_the_paper_says() {
    let turned = |name: &str| {
        let run = ran(&scene_file(name));
        (run.deflections_rad()[0] / PI, run.contact_time)
    };
    let (delta, tau) = turned("fig2-neutral-iii");
    assert!(
        (delta + 0.60).abs() < 0.01 && (tau - 11.4).abs() < 0.2,
        "{delta} {tau}"
    );
    let (delta, tau) = turned("fig2-neutral-iv");
    assert!(
        (delta + 0.074).abs() < 0.001 && (tau - 5.0).abs() < 0.05,
        "{delta} {tau}"
    );
}

/// A pair on the x axis.
fn on_axis(eps: f64, angles: [f64; 2], squirmers: [Squirmer; 2]) -> Scene {
    let half = 1.0 + 0.5 * eps;
    let start = [(-half, angles[0]), (half, angles[1])].map(|(x, angle)| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Radians(angle),
    });
    Scene::new(squirmers, start, None, None).unwrap()
}

#[test]
fn val_without_repulsion_a_facing_pair_closes_doubly_exponentially() {
    // Near contact dL/dt = (4/3) k S L + (8/3) B1 for L = ln 1/eps, S = sum B_n, with k = 3 or 9/4.
    for (form, k) in [(Form::Corrected, 3.0), (Form::Published, 9.0 / 4.0)] {
        for modes in [vec![1.5, 3.0], vec![1.5], vec![0.9, 0.2, 0.4]] {
            let squirmer = Squirmer::new(&modes).unwrap();
            let scene = on_axis(1e-12, [0.0, PI], [squirmer; 2]);
            let run = run(&scene, &Lubrication::new(form), &RunOptions::default()).unwrap();
            assert_eq!(run.outcome, Outcome::Contact);
            assert_relative_eq!(run.min_gap, 1e-300, max_relative = 1e-12);
            let rate = 4.0 / 3.0 * k * modes.iter().sum::<f64>();
            let offset = 8.0 / 3.0 * modes[0] / rate;
            let start = -scene.gap().unwrap().ln();
            let expected = ((300.0 * 10f64.ln() + offset) / (start + offset)).ln() / rate;
            assert_relative_eq!(run.end_time, expected, max_relative = 1e-8);
        }
    }
}

/// Lubrication theory that answers from a gap on, as boundary elements do.
struct Resolving(Lubrication, f64);

impl Hydrodynamics for Resolving {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription::smooth(GapRange::from(self.1))
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.range().check(gap)?;
        self.0.interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.range().check(gap)?;
        self.0.interacting_loads_with_swirl(gap, set)
    }

    fn error_estimate(&self, gap: Gap, _: LoadSet) -> Result<Option<f64>, SceneError> {
        self.range().check(gap).map(|()| None)
    }

    fn fingerprint(&self) -> String {
        format!("lubrication theory from {}", self.1)
    }
}

#[test]
fn a_run_ends_where_its_model_ceases_to_resolve_the_gap() {
    let limit = 2.5e-4;
    let limited = Resolving(Lubrication::new(Form::Corrected), limit);
    // Without an end of its range it goes on.
    let endless = Resolving(Lubrication::new(Form::Corrected), 0.0);
    let neutral = Squirmer::with_beta(1.0, 1.0).unwrap();
    let swirling = neutral.with_swirl(&[0.0, 0.3]).unwrap();
    let facing = on_axis(0.5, [0.0, PI], [neutral; 2]);
    let reduced = Plan::new(&facing).unwrap();
    let swirling = on_axis(0.5, [0.02, PI - 0.01], [swirling, neutral]);
    for plan in [
        reduced.clone().without_symmetry(),
        reduced.clone().in_three_dimensions(),
        reduced,
        Plan::new(&on_axis(0.5, [0.01, PI + 0.01], [neutral; 2])).unwrap(),
        Plan::new(&swirling).unwrap(),
    ] {
        let run = run_plan(&plan, &limited, &RunOptions::default()).unwrap();
        assert_eq!(run.outcome, Outcome::Unresolved, "{}", plan.state());
        assert_relative_eq!(run.min_gap, limit, max_relative = 1e-12);
        assert_relative_eq!(run.end.gap.eps(), limit, max_relative = 1e-12);
        // Located: the same pair by the same loads is there at that time. The gap closes at a rate of 4 S L, about a hundred
        // times itself, so that what is left of 1e-8 a step in time is a hundred times that in the gap.
        let options = RunOptions {
            end_time: run.end_time,
            ..RunOptions::default()
        };
        let there = run_plan(&plan, &endless, &options).unwrap();
        println!("{}: gap then {:e}", plan.state(), there.end.gap.eps());
        assert_relative_eq!(there.end.gap.eps(), limit, max_relative = 1e-6);
        // And not by creeping up to it: steps shorten by no more than it takes to see the kink in the loads there.
        assert!(
            run.counters.steps <= there.counters.steps + 4,
            "{:?}",
            run.counters
        );
        assert!(
            run.counters.rejected <= there.counters.rejected + 16,
            "{:?}",
            run.counters
        );
    }
}

#[test]
fn a_gap_that_dips_below_the_range_within_a_step_is_found() {
    let puller = Squirmer::with_beta(1.0, 5.0).unwrap();
    let start = on_axis(0.5, [0.4, PI - 0.2], [puller; 2]);
    let scene = Scene::new(start.squirmers, start.start, Some(Repulsion::PAPER), None).unwrap();
    let form = Lubrication::new(Form::Corrected);
    let options = RunOptions {
        end_time: 20.0,
        ..RunOptions::default()
    };
    let run_from = |smallest: f64| run(&scene, &Resolving(form, smallest), &options).unwrap();
    let least = run_from(0.0).min_gap;
    // Just above and just below the smallest gap of the encounter.
    for (limit, ends) in [(least * (1.0 + 1e-6), true), (least * (1.0 - 1e-6), false)] {
        let run = run_from(limit);
        assert_eq!(
            run.outcome == Outcome::Unresolved,
            ends,
            "{limit:e} {}",
            run.outcome
        );
        let expected = if ends { limit } else { least };
        assert_relative_eq!(run.min_gap, expected, max_relative = 1e-7);
    }
}

#[test]
fn val_a_facing_pair_by_boundary_elements_ends_at_their_smallest_gap_when_the_exact_one_is_there() {
    let neutral = Squirmer::with_beta(1.0, 1.0).unwrap();
    let scene = on_axis(0.006, [0.0, PI], [neutral; 2]);
    let model = bem::Bem::new(1).unwrap();
    let options = RunOptions {
        tolerance: 1e-6,
        ..RunOptions::default()
    };
    let found = run(&scene, &model, &options).unwrap();
    assert_eq!(found.outcome, Outcome::Unresolved);
    let limit = model.range().smallest;
    assert_relative_eq!(found.min_gap, limit, max_relative = 1e-12);
    let options = RunOptions {
        end_time: found.end_time,
        ..options
    };
    let exact = run(&scene, &exact::Exact::new(), &options).unwrap();
    // Within 0.5 % of every load, the closing of ln(0.006/0.004) is off by as much of each of two loads.
    let within = 0.01 * (0.006_f64 / limit).ln();
    assert_relative_eq!(exact.end.gap.eps(), limit, max_relative = within);

    let below = on_axis(0.5 * limit, [0.0, PI], [neutral; 2]);
    let error = run(&below, &model, &options).unwrap_err().to_string();
    assert!(
        error.contains("is not resolved by mesh level 1: level 2 would do"),
        "{error}"
    );
}

#[test]
fn contact_ends_runs_on_every_state() {
    let model = Lubrication::new(Form::Corrected);
    let puller = Squirmer::with_beta(1.0, 2.0).unwrap();
    let scene = on_axis(0.1, [0.0, PI], [puller; 2]);
    let reduced = Plan::new(&scene).unwrap();
    assert_eq!(reduced.state(), State::Axisymmetric);
    let options = RunOptions {
        tolerance: 1e-11,
        ..RunOptions::default()
    };
    let time = |plan: &Plan| {
        let run = run_plan(plan, &model, &options).unwrap();
        assert_eq!(run.outcome, Outcome::Contact);
        run.end_time
    };
    let expected = time(&reduced);
    for plan in [
        reduced.clone().without_symmetry(),
        reduced.in_three_dimensions(),
    ] {
        assert_relative_eq!(time(&plan), expected, max_relative = 1e-8);
    }
}

#[test]
fn val_without_hydrodynamics_squirmers_fly_straight_until_they_touch() {
    let squirmer = Squirmer::with_beta(1.0, 5.0).unwrap();
    let facing = on_axis(1.0, [0.0, PI], [squirmer; 2]);
    let run_of = |scene: &Scene| run(scene, &Isolated, &RunOptions::default()).unwrap();
    let met = run_of(&facing);
    assert_eq!((met.outcome, met.min_gap), (Outcome::Contact, 0.0));
    assert_relative_eq!(met.end_time, 0.5, max_relative = 1e-14);
    assert_eq!(met.counters.loads, 0);
    // At right angles from (-3, 0) along x and (0, -3 - d) along y: nearest at the distance d/sqrt 2.
    let crossing = |d: f64| {
        let start =
            [([-3.0, 0.0], 0.0), ([0.0, -3.0 - d], FRAC_PI_2)].map(|([x, y], angle)| Pose {
                position: [x, y, 0.0].into(),
                orientation: Orientation::Radians(angle),
            });
        run_of(&Scene::new([squirmer; 2], start, None, None).unwrap())
    };
    let missed = crossing(3.0);
    assert_eq!(missed.outcome, Outcome::Scattered);
    assert_relative_eq!(
        missed.min_gap,
        3.0 / 2f64.sqrt() - 2.0,
        max_relative = 1e-13
    );
    // They touch when |(-3 + t, 3 + d - t)| = 2.
    let d: f64 = 1.0;
    let expected = 0.5 * ((6.0 + d) - (8.0 - d * d).sqrt());
    assert_relative_eq!(crossing(d).end_time, expected, max_relative = 1e-13);
}

#[test]
fn val_repulsion_alone_holds_lone_squirmers_where_it_balances_their_thrust() {
    // 6 V_s = F(eps) per pi mu a: eps = ln(1 + kappa1 kappa2/(6 pi V_s))/kappa2.
    let squirmer = Squirmer::with_beta(1.0, 0.0).unwrap();
    let plain = on_axis(1.0, [0.0, PI], [squirmer; 2]);
    let scene = Scene::new(plain.squirmers, plain.start, Some(Repulsion::PAPER), None).unwrap();
    let run = run(&scene, &Isolated, &RunOptions::default()).unwrap();
    assert_eq!(run.outcome, Outcome::Standoff);
    let expected = (1000.0 / (6.0 * PI)).ln_1p() / 100.0;
    assert_relative_eq!(run.end.gap.eps(), expected, max_relative = 1e-9);
}

/// Scenes of identical squirmers with a symmetry, and the state that it allows.
fn symmetric_scenes() -> Vec<(Scene, State)> {
    let mut scenes = Vec::new();
    let push = |scenes: &mut Vec<_>, angles, beta: f64, gravity: Option<Gravity>, state| {
        let squirmer = Squirmer::with_beta(1.0, beta).unwrap();
        let squirmer = squirmer.bottom_heavy(if gravity.is_some() { 10.0 } else { 0.0 });
        let plain = on_axis(0.9, angles, [squirmer.unwrap(); 2]);
        let repulsion = Some(Repulsion::PAPER);
        let scene = Scene::new(plain.squirmers, plain.start, repulsion, gravity).unwrap();
        scenes.push((scene, state));
    };
    for beta in [-5.0, 1.0, 5.0] {
        for angle in [0.3, 1.0, -0.7, 1.5] {
            let opposed = [angle, PI + angle];
            let mirrored = [angle, PI - angle];
            push(&mut scenes, opposed, beta, None, State::PointSymmetric);
            push(&mut scenes, mirrored, beta, None, State::MirrorSymmetric);
            push(
                &mut scenes,
                mirrored,
                beta,
                Some(Gravity::DOWN),
                State::MirrorSymmetric,
            );
        }
        push(&mut scenes, [0.0, PI], beta, None, State::Axisymmetric);
    }
    scenes
}

#[test]
fn reduced_and_full_motion_have_the_same_rates_to_rounding() {
    // Units in the last place of the largest rate.
    const ROUNDING: f64 = 16.0 * f64::EPSILON;
    let model = Lubrication::new(Form::Published);
    for (scene, state) in symmetric_scenes() {
        let reduced = Plan::new(&scene).unwrap();
        assert_eq!(reduced.state(), state);
        let full = reduced.clone().without_symmetry();
        let configuration = reduced.start();
        for eps in [1e-9, 1e-3, 0.1, 0.9] {
            let at = scene::Configuration {
                gap: Gap::new(eps).unwrap(),
                ..*configuration
            };
            let [a, b] = [&reduced, &full].map(|plan| rates(plan, &model, &at, 1).unwrap());
            let scale = b.ln_gap.abs().max(b.orientations[0].norm()).max(1.0);
            let close = |a: Vector3<f64>, b: Vector3<f64>| (a - b).norm() <= ROUNDING * scale;
            assert!(
                (a.ln_gap - b.ln_gap).abs() <= ROUNDING * scale,
                "{a:?} {b:?}"
            );
            assert!(
                close(a.midpoint, b.midpoint) && close(a.line, b.line),
                "{a:?} {b:?}"
            );
            for k in 0..2 {
                assert!(close(a.orientations[k], b.orientations[k]), "{a:?} {b:?}");
            }
        }
    }
}

#[test]
fn reduced_and_full_trajectories_agree() {
    // Over two time units at the tolerance 1e-12: long enough to collide, too short for an unstable
    // symmetric state to amplify rounding by more than a few hundred.
    let model = Lubrication::new(Form::Published);
    let options = RunOptions {
        tolerance: 1e-12,
        end_time: 2.0,
        ..RunOptions::default()
    };
    for (scene, state) in symmetric_scenes() {
        let plan = Plan::new(&scene).unwrap();
        let reduced = run_plan(&plan, &model, &options).unwrap();
        let full = run_plan(&plan.without_symmetry(), &model, &options).unwrap();
        assert_relative_eq!(reduced.end_time, full.end_time, epsilon = 1e-9);
        for k in 0..2 {
            let [a, b] = [&reduced, &full].map(|run| run.end.positions()[k]);
            assert_relative_eq!(a, b, epsilon = 2e-9);
            let [a, b] = [&reduced, &full].map(|run| run.end.angles_rad[k]);
            assert!((a - b).abs() < 2e-9, "{state}: {a} {b}");
        }
        assert_relative_eq!(reduced.min_gap, full.min_gap, max_relative = 1e-8);
    }
}

#[test]
fn reduced_motion_is_symmetric_to_the_last_bit_for_ever() {
    let model = Lubrication::new(Form::Published);
    let options = RunOptions {
        sample_interval: Some(0.5),
        ..RunOptions::default()
    };
    for (scene, state) in symmetric_scenes() {
        let run = run(&scene, &model, &options).unwrap();
        for sample in &run.samples {
            let c = &sample.configuration;
            let [p1, p2] = c.orientations;
            match state {
                State::PointSymmetric => {
                    assert_eq!((p1, c.midpoint), (-p2, Vector3::zeros()));
                }
                State::MirrorSymmetric => {
                    assert_eq!((p1.y, -p1.x), (p2.y, p2.x));
                    assert_eq!((c.line, c.midpoint.x), (Vector3::x(), 0.0));
                }
                _ => assert_eq!(c.midpoint, Vector3::zeros()),
            }
        }
        let [one, two] = run.deflections_rad();
        let expected = if state == State::MirrorSymmetric {
            -one
        } else {
            one
        };
        assert!(
            (expected - two).abs() <= 1e-13 * one.abs().max(1.0),
            "{one} {two}"
        );
    }
}

#[test]
fn a_pair_that_swims_downward_in_a_mirror_does_so_to_the_end() {
    let run = ran(&scene_file("fig8e-downward"));
    assert_eq!(run.outcome, Outcome::Downward);
    assert!(run.end.midpoint.y < -100.0);
}

#[test]
fn plans_ask_for_the_symmetry_classes_that_their_state_needs() {
    for (scene, state) in symmetric_scenes() {
        let needed = Plan::new(&scene).unwrap().needed_loads();
        let classes: Vec<_> = (needed.symmetry_classes().iter())
            .map(ToString::to_string)
            .collect();
        let expected: &[&str] = match state {
            State::Axisymmetric => &["axial mirrored"],
            State::PointSymmetric => &["axial mirrored", "transverse opposite"],
            _ => &["axial mirrored", "transverse mirrored"],
        };
        assert_eq!(classes, expected);
    }
}

/// The loads of a model with one combination put out of place.
struct Disturbed {
    by: f64,
    which: usize,
}

impl scene::Hydrodynamics for Disturbed {
    fn description(&self) -> scene::ModelDescription<'_> {
        scene::ModelDescription::smooth(Lubrication::new(Form::Corrected).range())
    }

    fn interacting_loads(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<scene::PairLoads, scene::SceneError> {
        let set = LoadSet::all(set.modes);
        let loads = Lubrication::new(Form::Corrected).interacting_loads(gap, set)?;
        let mut columns: Vec<_> = loads.columns().collect();
        columns[self.which] *= 1.0 + self.by;
        columns[self.which] += self.by;
        Ok(scene::PairLoads::from_columns(set, set, &columns))
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(scene::PairLoads, scene::SwirlLoads), scene::SceneError> {
        Ok((
            self.interacting_loads(gap, set)?,
            scene::SwirlLoads::isolated(set),
        ))
    }

    fn error_estimate(&self, _: Gap, _: LoadSet) -> Result<Option<f64>, scene::SceneError> {
        Ok(None)
    }

    fn fingerprint(&self) -> String {
        "disturbed".to_owned()
    }
}

#[test]
fn val_the_loads_that_a_plan_names_are_those_that_its_motion_feels() {
    // Each combination of the loads in turn is disturbed: the rates must change if the plan names it, and
    // must not to the last bit if it does not. Columns: sum and difference of XA, YA, YB, XC, YC, then of
    // XF, YF, YT of each mode.
    let kinds = [
        "XA", "YA", "YB", "XC", "YC", "XF_1", "YF_1", "YT_1", "XF_2", "YF_2", "YT_2",
    ];
    let mut scenes = symmetric_scenes();
    let crooked = on_axis(0.9, [0.4, 2.0], scenes[0].0.squirmers);
    scenes.push((crooked, State::Planar));
    for (scene, state) in scenes {
        let plan = Plan::new(&scene).unwrap();
        let rates_of = |by: f64, which: usize| {
            rates(&plan, &Disturbed { by, which }, plan.start(), 1).unwrap()
        };
        let plain = rates_of(0.0, 0);
        let names = plan.needed_loads().names();
        for (kind, name) in kinds.iter().enumerate() {
            let (letters, rest) = name.split_at(2);
            let [own, other] = if rest.is_empty() {
                let (axis, kind) = letters.split_at(1);
                [format!("{axis}11{kind}"), format!("{axis}12{kind}")]
            } else {
                [format!("{letters}1{rest}"), format!("{letters}2{rest}")]
            };
            let both = names.contains(&format!("{own}, {other}"));
            for (offset, sign) in ["+", "-"].into_iter().enumerate() {
                let needed = both || names.contains(&format!("{own} {sign} {other}"));
                let changed = rates_of(0.1, 2 * kind + offset) != plain;
                assert_eq!(changed, needed, "{state}: {own} {sign} {other}");
            }
        }
    }
}
