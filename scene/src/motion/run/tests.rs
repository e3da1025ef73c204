//! Runs end where they were told to, or say why they cannot.

use crate::made::Cut;
use crate::motion::tests::{MODEL, TIGHT, pose, squirmer};
use crate::{Gravity, Isolated, Plan, RunOptions, Scene, SceneError, Squirmer, run_plan};

#[test]
fn no_run_ends_after_its_end() {
    // A short contact, then a flight to the end, under gravity.
    let heavy = |beta: f64| squirmer(beta).bottom_heavy(0.5).unwrap();
    let start = [
        pose([0.0, 0.0, 0.0], [-0.8, 0.6, 0.0]),
        pose([2.8, 0.0, 0.0], [0.6, 0.8, 0.0]),
    ];
    let scene = Scene::new([heavy(0.5), heavy(-1.0)], start, None, Some(Gravity::DOWN)).unwrap();
    let plan = Plan::new(&scene).unwrap();
    let cut = Cut {
        made: MODEL,
        at: 1.0,
    };
    let mut flights = 0;
    for k in 0..200 {
        let end_time = 0.2 + 0.023 * f64::from(k);
        let options = RunOptions {
            tolerance: 1e-4,
            end_time,
            sample_interval: None,
            ..TIGHT
        };
        let run = run_plan(&plan, &cut, &options).unwrap();
        assert!(run.end_time <= end_time, "{} > {end_time}", run.end_time);
        assert!(run.contact_time <= run.end_time, "{end_time}: {run:?}");
        flights += run.counters.flights;
    }
    assert!(flights >= 200, "{flights}");
}

#[test]
fn no_pair_is_in_contact_for_longer_than_its_run() {
    // So slow that a few long steps lead to the end.
    let slow = Squirmer::with_beta(1e-4, 1.0).unwrap();
    let start = [
        pose([0.0; 3], [0.7, 0.1, 0.0]),
        pose([2.2, 0.3, 0.1], [0.6, 0.2, 0.7]),
    ];
    let scene = Scene::new([slow; 2], start, None, None).unwrap();
    let plan = Plan::new(&scene).unwrap();
    for k in 0..300 {
        let options = RunOptions {
            tolerance: 1e-4,
            end_time: 20.0 + 0.0371 * f64::from(k),
            sample_interval: None,
            ..TIGHT
        };
        let run = run_plan(&plan, &MODEL, &options).unwrap();
        assert!(run.contact_time <= run.end_time, "{run:?}");
    }
}

#[test]
fn a_flight_so_far_that_positions_lose_the_distance_is_refused() {
    let up = [0.6, 0.8, 0.0];
    let beside = |x: f64| [pose([0.0; 3], up), pose([x, 0.0, 0.0], up)];
    let facing = [
        pose([0.0; 3], [1.0, 0.0, 0.0]),
        pose([1e25, 1.5, 0.0], [-1.0, 0.0, 0.0]),
    ];
    let heavy = squirmer(1.0).bottom_heavy(3.0).unwrap();
    let fast = Squirmer::with_beta(1e36, 1.0).unwrap();
    for (what, of, start, gravity, end_time) in [
        ("long", heavy, beside(4.0), Some(Gravity::DOWN), 1e20),
        (
            "fast",
            fast.bottom_heavy(3.0).unwrap(),
            beside(4.0),
            Some(Gravity::DOWN),
            10.0,
        ),
        ("from afar", squirmer(1.0), facing, None, 1e26),
    ] {
        let scene = Scene::new([of; 2], start, None, gravity).unwrap();
        let plan = Plan::new(&scene).unwrap();
        let options = RunOptions {
            end_time,
            sample_interval: None,
            ..TIGHT
        };
        let error = run_plan(&plan, &Isolated::EQUAL, &options).unwrap_err();
        assert!(
            matches!(error, SceneError::LostDistance { .. }),
            "{what}: {error}"
        );
    }
    // As far, and as far apart: six digits are enough.
    let apart = [pose([0.0; 3], up), pose([1e25, 0.0, 0.0], [0.8, 0.6, 0.0])];
    let scene = Scene::new([squirmer(1.0); 2], apart, None, None).unwrap();
    let options = RunOptions {
        sample_interval: None,
        ..TIGHT
    };
    let run = run_plan(&Plan::new(&scene).unwrap(), &Isolated::EQUAL, &options).unwrap();
    assert!((run.min_gap / 1e25 - 1.0).abs() < 1e-9, "{}", run.min_gap);
}
