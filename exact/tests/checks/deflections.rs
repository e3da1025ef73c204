//! A deflection is a limit: what two squirmers still turn by after they have parted.

use std::sync::{Arc, OnceLock};

use scene::{
    LoadSet, Orientation, Outcome, Plan, Pose, Repulsion, Run, RunOptions, Scene, SceneError,
    Squirmer, TableOptions, Tabulated, run_plan,
};

use crate::common::EQUAL;

fn table() -> &'static Tabulated {
    static TABLE: OnceLock<Tabulated> = OnceLock::new();
    TABLE.get_or_init(|| {
        let options = TableOptions {
            set: LoadSet::all(2),
            tolerance: 1e-9,
            smallest_gap: 1e-7,
        };
        Tabulated::build(Arc::new(EQUAL.clone()), options, &|_| ()).unwrap()
    })
}

/// Positions and headings in degrees of two equal squirmers with the paper's repulsion.
fn scene(beta: f64, positions: [[f64; 3]; 2], headings_deg: [f64; 2]) -> Scene {
    let squirmer = Squirmer::with_beta(1.0, beta).unwrap();
    let pose = |k: usize| Pose {
        position: positions[k].into(),
        orientation: Orientation::from_degrees(headings_deg[k]),
    };
    Scene::new(
        [squirmer; 2],
        [pose(0), pose(1)],
        Some(Repulsion::PAPER),
        None,
    )
    .unwrap()
}

/// Opposed approach, the paper's Fig. 6.
fn opposed(beta: f64, dx: f64) -> Scene {
    let start = [[-0.5 * dx, 5.0, 0.0], [0.5 * dx, -5.0, 0.0]];
    scene(beta, start, [-90.0, 90.0])
}

/// Approach at right angles, the paper's Fig. 7.
fn right_angles(beta: f64, dx: f64) -> Scene {
    scene(beta, [[0.0, 10.0, 0.0], [10.0 - dx, 0.0, 0.0]], [0.0, 90.0])
}

fn run_to(scene: &Scene, angles_at: f64, tolerance: f64) -> Run {
    let options = RunOptions {
        angles_at,
        tolerance,
        ..RunOptions::default()
    };
    run_plan(&Plan::new(scene).unwrap(), table(), &options).unwrap()
}

fn degrees(run: &Run) -> [f64; 2] {
    run.deflections_rad().map(f64::to_degrees)
}

fn paper_cases() -> Vec<Scene> {
    let opposed = [1.0, 2.0, 3.0, 5.0, 10.0].map(|dx| opposed(5.0, dx));
    let crossed = [-1.0, 1.0, 5.0]
        .into_iter()
        .flat_map(|beta| [1.0, 2.0, 3.0, 5.0].map(|dx| right_angles(beta, dx)));
    opposed.into_iter().chain(crossed).collect()
}

#[test]
fn val_two_ways_to_infinity_agree_to_a_millionth_of_a_degree() {
    for scene in paper_cases() {
        let by_tail = run_to(&scene, f64::INFINITY, 1e-12);
        // So far out that what is left, 1e-10 of the turn at 12, is below what is asked.
        let by_flight = run_to(&scene, 1e6, 1e-12);
        assert!(by_tail.truncation_rad.to_degrees() < 1e-7);
        for (a, b) in degrees(&by_tail).into_iter().zip(degrees(&by_flight)) {
            assert!((a - b).abs() < 1e-6, "{a} against {b}: {:?}", scene.start);
        }
        let loose = run_to(&scene, f64::INFINITY, 1e-8);
        for (a, b) in degrees(&by_tail).into_iter().zip(degrees(&loose)) {
            assert!((a - b).abs() < 1e-5, "{a} against {b} by loose steps");
        }
    }
}

#[test]
fn val_deflections_at_infinity_are_those_of_runs_to_ever_larger_distances() {
    // By an independent reading of runs cut further and further out.
    for (scene, expected) in [
        (opposed(5.0, 1.0), [-11.698, -11.698]),
        (opposed(5.0, 1.3), [-8.853, -8.853]),
        (right_angles(1.0, 1.5), [12.588, 7.084]),
    ] {
        let found = degrees(&run_to(&scene, f64::INFINITY, 1e-10));
        for (a, b) in found.into_iter().zip(expected) {
            assert!((a - b).abs() < 5.1e-4, "{found:?} against {expected:?}");
        }
    }
}

#[test]
fn val_what_a_cut_run_misses_is_what_it_says() {
    for scene in paper_cases() {
        let limit = degrees(&run_to(&scene, f64::INFINITY, 1e-10));
        for at in [12.0, 24.0, 100.0] {
            let run = run_to(&scene, at, 1e-10);
            let missed = [0, 1].map(|k| (degrees(&run)[k] - limit[k]).abs());
            let (missed, said) = (missed[0].max(missed[1]), run.truncation_rad.to_degrees());
            // The next order is smaller by one power of the distance at least.
            let allowed = 12.0 / at;
            assert!(
                (missed - said).abs() < allowed * said,
                "{missed} against {said} at {at}"
            );
        }
    }
}

#[test]
fn pairs_that_never_come_within_the_departure_distance_part_when_they_recede() {
    for dx in [12.0, 13.0, 40.0] {
        let run = run_to(&opposed(1.0, dx), f64::INFINITY, 1e-8);
        assert_eq!(run.outcome, Outcome::Scattered, "dx {dx}");
        assert!(run.truncation_rad < 1e-8 && run.end_time < 10.0);
        assert!((run.min_gap - (dx - 2.0)).abs() < 0.1);
    }
}

#[test]
fn starts_at_the_departure_distance_and_next_to_it_end_alike() {
    let ulp = 12.0 * f64::EPSILON;
    for headings in [
        [0.0, 180.0],
        [180.0, 0.0],
        [90.0, -90.0],
        [20.0, 150.0],
        [45.0, 60.0],
    ] {
        let at = |r: f64| {
            let scene = scene(1.0, [[0.0; 3], [r, 0.3, 0.0]], headings);
            let run = run_to(&scene, f64::INFINITY, 1e-10);
            (run.outcome, degrees(&run))
        };
        let exactly = (144.0_f64 - 0.09).sqrt();
        let (outcome, angles) = at(exactly);
        for off in [ulp, -ulp, 1e-12, -1e-12] {
            let (next, turned) = at(exactly + off);
            assert_eq!(next, outcome, "{headings:?}, {off:e} off");
            for (a, b) in angles.into_iter().zip(turned) {
                let same = (a - b).abs() < 1e-6;
                assert!(
                    same || outcome == Outcome::Standoff,
                    "{headings:?}: {a} against {b}"
                );
            }
        }
    }
}

#[test]
fn a_pair_that_parts_almost_in_parallel_says_how_far_its_angles_are_from_their_limit() {
    // The slower they part the more the far field turns them.
    let splayed = |half_deg: f64| {
        let start = [[-7.0, 0.0, 0.0], [7.0, 0.0, 0.0]];
        scene(1.0, start, [90.0 + half_deg, 90.0 - half_deg])
    };
    let turn = |half_deg: f64| {
        let run = run_to(&splayed(half_deg), f64::INFINITY, 1e-10);
        assert_eq!(run.outcome, Outcome::Scattered);
        assert!(
            run.truncation_rad < 1e-7,
            "{half_deg}: {}",
            run.truncation_rad
        );
        run.deflections_rad()[0].abs()
    };
    assert!(turn(10.0) > turn(40.0));
    let cut = run_to(&splayed(10.0), 14.0, 1e-10);
    assert!(cut.truncation_rad > 0.5 * turn(10.0));
}

#[test]
fn distances_at_which_nothing_can_be_read_are_refused() {
    for angles_at in [2.0, -1.0, f64::NAN] {
        let options = RunOptions {
            angles_at,
            ..RunOptions::default()
        };
        let plan = Plan::new(&opposed(1.0, 1.0)).unwrap();
        let error = run_plan(&plan, &scene::Isolated::EQUAL, &options).unwrap_err();
        assert!(matches!(error, SceneError::NotApart { .. }), "{error}");
    }
}

#[test]
fn val_the_limit_is_the_same_in_three_dimensions() {
    for scene in [
        opposed(5.0, 1.0),
        right_angles(1.0, 1.0),
        right_angles(5.0, 2.0),
    ] {
        let options = RunOptions {
            tolerance: 1e-12,
            ..RunOptions::default()
        };
        let plan = Plan::new(&scene).unwrap().in_three_dimensions();
        let spatial = degrees(&run_plan(&plan, table(), &options).unwrap());
        let planar = degrees(&run_to(&scene, f64::INFINITY, 1e-12));
        for (a, b) in spatial.into_iter().zip(planar) {
            assert!((a - b).abs() < 1e-5, "{a} against {b}");
        }
    }
}
