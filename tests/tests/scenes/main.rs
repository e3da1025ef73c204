//! Scene files, reduced states and contact: against the dedicated commands, the full motion and closed
//! forms.

#![allow(clippy::float_cmp, reason = "exactly equal is what is claimed")]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod ends;
mod symmetry;

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::PathBuf;

use approx::assert_relative_eq;
use compare::study::maps::{Pair, scatter_row};
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

#[test]
fn val_without_hydrodynamics_squirmers_fly_straight_until_they_touch() {
    let squirmer = Squirmer::with_beta(1.0, 5.0).unwrap();
    let facing = on_axis(1.0, [0.0, PI], [squirmer; 2]);
    let run_of = |scene: &Scene| run(scene, &Isolated::EQUAL, &RunOptions::default()).unwrap();
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
    let run = run(&scene, &Isolated::EQUAL, &RunOptions::default()).unwrap();
    assert_eq!(run.outcome, Outcome::Standoff);
    let expected = (1000.0 / (6.0 * PI)).ln_1p() / 100.0;
    assert_relative_eq!(run.end.gap.eps(), expected, max_relative = 1e-9);
}
