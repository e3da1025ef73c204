//! Starts on the cut of lubrication theory, one unit in the last place off it, and a little further off.
//!
//! Beyond the cut nothing acts. A pair that does not close in parts at once, without any turn; one that closes in
//! does what its neighbours just inside do.

#![allow(clippy::float_cmp, reason = "exactly equal is what is claimed")]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use lt::{Form, Lubrication};
use scene::{
    Gravity, Isolated, Outcome, Plan, Pose, Repulsion, Run, RunOptions, Scene, Squirmer, run,
    run_plan,
};

/// Distance of the centres at the cut.
const CUT: f64 = 3.0;

#[derive(Clone, Copy, Debug)]
struct Pair {
    speeds: [f64; 2],
    beta: f64,
    headings_deg: [f64; 2],
}

impl Pair {
    fn scene(&self, distance: f64) -> Scene {
        let squirmer = |k: usize| {
            if self.speeds[k] > 0.0 {
                Squirmer::with_beta(self.speeds[k], self.beta).unwrap()
            } else {
                Squirmer::new(&[]).unwrap()
            }
        };
        let [one, two] = self.headings_deg;
        let start = [
            Pose::planar(0.0, 0.0, one),
            Pose::planar(distance, 0.0, two),
        ];
        let squirmers = [squirmer(0), squirmer(1)];
        Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap()
    }

    fn run(&self, distance: f64) -> Run {
        let model = Lubrication::new(Form::Published);
        run(&self.scene(distance), &model, &RunOptions::default())
            .unwrap_or_else(|error| panic!("{self:?} at {distance}: {error}"))
    }

    /// Velocity of the second relative to the first, without the rounding of the headings.
    fn relative_velocity(&self) -> [f64; 2] {
        let of = |angle: fn(f64) -> f64, k: usize| {
            self.speeds[k] * (angle(self.headings_deg[k].to_radians()) * 1e12).round() * 1e-12
        };
        [f64::cos, f64::sin].map(|angle| of(angle, 1) - of(angle, 0))
    }
}

fn pair(speeds: [f64; 2], beta: f64, headings_deg: [f64; 2]) -> Pair {
    Pair {
        speeds,
        beta,
        headings_deg,
    }
}

fn pairs() -> Vec<Pair> {
    let headings = [0.0, 90.0, 180.0, -90.0, 37.0, 123.0, -71.0, 90.0 + 360.0];
    let speeds = [[1.0, 1.0], [1.0, 0.0], [0.0, 0.7], [0.4, 1.0], [0.0, 0.0]];
    let mut pairs = Vec::new();
    for speeds in speeds {
        for one in headings {
            for two in headings {
                for beta in [0.0, 1.0, -5.0] {
                    pairs.push(pair(speeds, beta, [one, two]));
                }
            }
        }
    }
    pairs
}

#[test]
fn two_squirmers_that_swim_apart_sideways_from_the_cut_do_not_turn() {
    for pair in [
        pair([1.0, 1.0], 0.0, [90.0, -90.0]),
        pair([1.0, 1.0], 1.0, [90.0, -90.0]),
        pair([1.0, 0.0], 0.0, [90.0, 0.0]),
    ] {
        let run = pair.run(CUT);
        assert_eq!(run.outcome, Outcome::Scattered);
        assert_eq!(run.deflections_rad(), [0.0, 0.0]);
    }
}

#[test]
fn starts_at_the_cut_and_next_to_it_end_as_the_motion_enters() {
    let ulp = f64::EPSILON * CUT;
    let mut closing = 0;
    for pair in pairs() {
        let [v_x, v_y] = pair.relative_velocity();
        let at_rest = v_x.abs() + v_y.abs() < 1e-9;
        let inside = (v_x < -1e-9).then(|| pair.run(CUT - 1e-10));
        closing += usize::from(inside.is_some());
        for off in [0.0, ulp, -ulp, 1e-12, -1e-12] {
            let run = pair.run(CUT + off);
            let what = format!("{pair:?}, {off:e} off: {run:?}");
            match &inside {
                // Along the line of centres: standoffs, and spheres pushed ahead, which rounding ends sooner or later.
                Some(inside) if inside.outcome != Outcome::Scattered && v_y.abs() < 1e-9 => {}
                Some(inside) => {
                    assert_eq!(run.outcome, inside.outcome, "{what}");
                    for (a, b) in run
                        .deflections_rad()
                        .into_iter()
                        .zip(inside.deflections_rad())
                    {
                        assert!((a - b).abs() < 1e-6, "{what}: {a} against {b}");
                    }
                }
                // Equal velocities: the separatrix between meeting and parting. Inside, what is there grows or decays.
                None if at_rest && off < 0.0 => {}
                None if at_rest => {
                    let stays = [Outcome::Undecided, Outcome::Standoff, Outcome::Pairwise];
                    assert!(stays.contains(&run.outcome), "{what}");
                    assert!(
                        run.deflections_rad().iter().all(|d| d.abs() < 1e-9),
                        "{what}"
                    );
                }
                None => {
                    assert_eq!(run.outcome, Outcome::Scattered, "{what}");
                    assert!(
                        run.deflections_rad().iter().all(|d| d.abs() < 1e-9),
                        "{what}"
                    );
                }
            }
        }
    }
    assert!(closing > 200, "{closing}");
}

#[test]
fn starts_at_the_cut_in_three_dimensions_end_as_in_the_plane() {
    for pair in pairs().into_iter().step_by(7) {
        let model = Lubrication::new(Form::Published);
        let plan = Plan::new(&pair.scene(CUT)).unwrap().in_three_dimensions();
        let spatial = run_plan(&plan, &model, &RunOptions::default()).unwrap();
        let planar = pair.run(CUT);
        if planar.outcome != Outcome::Scattered {
            // Standoffs and pairs that push each other along are unstable: rounding ends them in three dimensions.
            continue;
        }
        assert_eq!(spatial.outcome, planar.outcome, "{pair:?}");
        for (a, b) in spatial
            .deflections_rad()
            .into_iter()
            .zip(planar.deflections_rad())
        {
            assert!((a - b).abs() < 1e-6, "{pair:?}: {a} against {b}");
        }
    }
}

#[test]
fn two_passive_spheres_rest_whatever_the_model() {
    let pair = pair([0.0, 0.0], 0.0, [0.0, 90.0]);
    let passive = |distance: f64| Scene {
        repulsion: None,
        ..pair.scene(distance)
    };
    let options = RunOptions::default();
    for (distance, outcome) in [(2.5, Outcome::Standoff), (4.0, Outcome::Undecided)] {
        let by_none = run(&passive(distance), &Isolated::EQUAL, &options).unwrap();
        let model = Lubrication::new(Form::Published);
        let by_lubrication = run(&passive(distance), &model, &options).unwrap();
        assert_eq!([by_none.outcome, by_lubrication.outcome], [outcome; 2]);
    }
}

#[test]
fn a_pair_that_swims_in_parallel_beyond_the_cut_never_parts() {
    let pair = pair([1.0, 1.0], 5.0, [90.0, 90.0]);
    let run = pair.run(5.0);
    assert_eq!(run.outcome, Outcome::Undecided);
    assert_eq!(run.deflections_rad(), [0.0, 0.0]);
    assert!((run.end_time - 200.0).abs() < 1e-12);
}

#[test]
fn a_pair_that_is_still_on_its_way_at_the_end_has_not_parted() {
    let pair = pair([1.0, 1.0], 1.0, [0.0, 180.0]);
    assert_eq!(pair.run(1000.0).outcome, Outcome::Undecided);
}

/// A map of starts of strongly bottom-heavy pairs: many are righted just when they part, and then swim upward side by
/// side, at the cut, with speeds apart that are all but nothing.
#[test]
fn every_start_of_a_strongly_bottom_heavy_pair_has_a_result() {
    let model = Lubrication::new(Form::Published);
    let options = RunOptions {
        tolerance: 1e-7,
        ..RunOptions::default()
    };
    // Among them are two that took a million advances of a free flight.
    let points: Vec<f64> = (0..20).map(|i| 0.01 + 1.98 / 19.0 * f64::from(i)).collect();
    for g in [20.0, 40.0] {
        let squirmer = Squirmer::with_beta(1.0, -5.0).and_then(|s| s.bottom_heavy(g));
        let squirmer = squirmer.unwrap();
        for (delta, sigma) in (points.iter()).flat_map(|d| points.iter().map(move |s| (d, s))) {
            let pose = |side: f64| Pose::planar(1.5 * side, 0.0, 90.0 * (sigma + side * delta));
            let start = [pose(-1.0), pose(1.0)];
            let gravity = Some(Gravity::DOWN);
            let scene = Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), gravity).unwrap();
            let run = run(&scene, &model, &options);
            let run = run.unwrap_or_else(|error| panic!("G {g}, {delta}, {sigma}: {error}"));
            assert_eq!(run.outcome, Outcome::Upward, "G {g}, {delta}, {sigma}");
        }
    }
}
