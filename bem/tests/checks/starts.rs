//! Starts on the surfaces where runs change or end under models without a cut, one unit in the last place off them, and a
//! little further off: the departure distance, the gap 1, the smallest gap of a model, the seams of its meshes.
//!
//! What is a limit from both sides has to be reached from all of these starts. On the smallest gap the motion enters from one side: a pair that closes in is
//! unresolved at once, one that opens or rests is resolved.
//!
//! Separatrices among such starts: passive spheres at rest, which stay where they are; and at the smallest gap a pair that
//! neither closes nor opens at first but for rounding, which decides whether it is unresolved at once.

use std::sync::{Arc, OnceLock};

use bem::Bem;
use exact::Exact;
use scene::{
    Hydrodynamics, LoadSet, Outcome, Plan, Pose, Repulsion, Run, RunOptions, Scene, SceneError,
    Squirmer, TableOptions, Tabulated, rates, run_plan,
};

/// Tables are as good as their models here: starts next to each other are compared under the same one.
fn table(model: impl Hydrodynamics + 'static) -> Tabulated {
    let options = TableOptions {
        set: LoadSet::planar(2),
        tolerance: 1e-4,
        smallest_gap: 1e-7,
    };
    Tabulated::build(Arc::new(model), options, &|_| ()).unwrap()
}

fn exact() -> &'static Tabulated {
    static TABLE: OnceLock<Tabulated> = OnceLock::new();
    TABLE.get_or_init(|| table(Exact::new()))
}

fn by_mesh() -> &'static Tabulated {
    static TABLE: OnceLock<Tabulated> = OnceLock::new();
    TABLE.get_or_init(|| table(Bem::new(1).unwrap()))
}

/// Two squirmers of speed 1 at the distance `r` along x; passive spheres without `beta`.
#[derive(Clone, Copy, Debug)]
struct Pair {
    beta: [Option<f64>; 2],
    headings_deg: [f64; 2],
    repulsion: Option<Repulsion>,
}

impl Pair {
    fn scene(&self, r: f64) -> Scene {
        let squirmer = |k: usize| match self.beta[k] {
            Some(beta) => Squirmer::with_beta(1.0, beta).unwrap(),
            None => Squirmer::new(&[]).unwrap(),
        };
        let [one, two] = self.headings_deg;
        let start = [Pose::planar(0.0, 0.0, one), Pose::planar(r, 0.0, two)];
        Scene::new([squirmer(0), squirmer(1)], start, self.repulsion, None).unwrap()
    }

    fn run<H: Hydrodynamics>(&self, model: &H, r: f64) -> Result<Run, SceneError> {
        let options = RunOptions {
            tolerance: 1e-9,
            end_time: 100.0,
            ..RunOptions::default()
        };
        run_plan(&Plan::new(&self.scene(r)).unwrap(), model, &options)
    }

    /// Rate at which the gap opens at the start.
    fn opening<H: Hydrodynamics>(&self, model: &H, r: f64) -> f64 {
        let plan = Plan::new(&self.scene(r)).unwrap();
        let rates = rates(&plan, model, plan.start(), 1).unwrap();
        rates.ln_gap * plan.start().gap.eps()
    }
}

/// Pairs drawn at random, the same in every run.
fn pairs(count: usize) -> Vec<Pair> {
    let mut state = 20_u64;
    let mut random = move || {
        // Knuth's MMIX generator; the upper bits.
        state =
            (state.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut pair = || Pair {
        beta: [(); 2].map(|()| {
            let beta = 10.0 * random() - 5.0;
            (random() < 0.8).then_some(beta)
        }),
        headings_deg: [(); 2].map(|()| 360.0 * random()),
        repulsion: (random() < 0.8).then_some(Repulsion::PAPER),
    };
    (0..count).map(|_| pair()).collect()
}

/// How far two runs are from each other that should be the same.
fn apart(a: &Run, b: &Run) -> f64 {
    let deflections = a.deflections_rad().into_iter().zip(b.deflections_rad());
    deflections.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Starts at the distance `r`, next to it and a little off against starts on either side; how many pairs scattered.
fn check_limit<H: Hydrodynamics>(model: &H, r: f64, count: usize) -> usize {
    let ulp = r.next_up() - r;
    let mut scattered = 0;
    for pair in pairs(count) {
        let run = |off: f64| pair.run(model, r + off).unwrap();
        let limits = [run(-1e-9), run(1e-9)];
        for off in [0.0, ulp, -ulp, 1e-12, -1e-12] {
            let run = run(off);
            for limit in &limits {
                let what = format!("{pair:?}, {off:e} off {r}");
                assert_eq!(run.outcome, limit.outcome, "{what}");
                if limit.outcome == Outcome::Scattered {
                    let apart = apart(&run, limit);
                    assert!(apart < 1e-6, "{what}: {apart:e}");
                }
            }
        }
        scattered += usize::from(limits[0].outcome == Outcome::Scattered);
    }
    scattered
}

#[test]
fn starts_at_the_departure_distance_end_as_those_on_either_side() {
    assert!(check_limit(exact(), 12.0, 10) > 0);
    assert!(check_limit(by_mesh(), 12.0, 10) > 0);
}

#[test]
fn squirmers_side_by_side_at_the_departure_distance_end_as_those_on_either_side() {
    // Their distance changes by the far field alone.
    for beta in [0.0, 1.0, -1.0, 5.0] {
        let pair = Pair {
            beta: [Some(beta); 2],
            headings_deg: [90.0; 2],
            repulsion: None,
        };
        let outcome = |off: f64| pair.run(exact(), 12.0 + off).unwrap().outcome;
        let ulp = 12.0_f64.next_up() - 12.0;
        let all = [-1e-9, -1e-12, -ulp, 0.0, ulp, 1e-12, 1e-9].map(outcome);
        println!("{beta}: {all:?}");
        assert!(all.iter().all(|o| *o == all[0]), "{beta}: {all:?}");
    }
}

#[test]
fn starts_at_the_gap_1_end_as_those_on_either_side() {
    assert!(check_limit(exact(), 3.0, 10) > 0);
    assert!(check_limit(by_mesh(), 3.0, 10) > 0);
}

#[test]
fn starts_at_the_seams_of_the_meshes_end_as_those_on_either_side() {
    for seam in by_mesh().description().seams {
        assert!(check_limit(by_mesh(), 2.0 + seam, 4) > 0);
    }
}

/// Smallest gap of the table of boundary elements, as a distance of the centres.
fn floor() -> f64 {
    2.0 + by_mesh().range().smallest
}

#[test]
fn starts_at_the_smallest_gap_of_a_model_end_as_the_motion_enters() {
    let (model, r) = (by_mesh(), floor());
    let ulp = r.next_up() - r;
    let (mut closing, mut opening) = (0, 0);
    for mut pair in pairs(30) {
        // At this gap repulsion parts most pairs.
        if opening > closing {
            pair.repulsion = None;
        }
        let speed = pair.opening(model, r);
        let limit = pair.run(model, r + 1e-9).unwrap();
        for off in [0.0, ulp, -ulp, 1e-12] {
            let run = pair.run(model, r + off).unwrap();
            let what = format!("{pair:?}, {off:e} off, {run:?}");
            assert_eq!(run.outcome, limit.outcome, "{what}");
            if speed < 0.0 {
                assert_eq!(run.outcome, Outcome::Unresolved, "{what}");
                assert!(run.end_time < 1e-6, "{what}");
            }
            if limit.outcome == Outcome::Scattered {
                assert!(apart(&run, &limit) < 1e-6, "{what}");
            }
        }
        closing += usize::from(speed < 0.0);
        opening += usize::from(speed > 0.0 && limit.outcome == Outcome::Scattered);
        // Nothing is known of a pair that begins below.
        assert!(pair.run(model, r - 1e-12).is_err());
    }
    assert!(closing > 5 && opening > 5, "{closing} {opening}");
}

#[test]
fn pairs_that_neither_close_nor_open_at_the_smallest_gap_go_by_what_they_do_next() {
    let (model, r) = (by_mesh(), floor());
    let ulp = r.next_up() - r;
    let (mut stay, mut leave) = (0, 0);
    for pair in pairs(60).into_iter().filter(|p| p.repulsion.is_none()) {
        let turned = |degrees: f64| {
            let mut turned = pair;
            turned.headings_deg[1] = degrees;
            (turned, turned.opening(model, r))
        };
        // A heading at which the gap is at rest: from it on it opens, or closes, as the headings and the line turn.
        for start in [0.0, 90.0, 180.0, 270.0] {
            let (mut low, mut high) = (turned(start), turned(start + 90.0));
            if low.1 * high.1 >= 0.0 {
                continue;
            }
            for _ in 0..60 {
                let middle = turned(0.5 * (low.0.headings_deg[1] + high.0.headings_deg[1]));
                if middle.1 * low.1 > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let (pair, speed) = if low.1 > high.1 { low } else { high };
            assert!((0.0..1e-12).contains(&speed), "{pair:?}: {speed:e}");
            let limit = pair.run(model, r + 1e-9).unwrap();
            for off in [0.0, ulp, -ulp, 1e-12] {
                let run = pair.run(model, r + off).unwrap();
                let what = format!("{pair:?}, {off:e} off, {run:?}");
                // A speed of some 1e-17 is zero but for rounding; where that closes the pair is unresolved.
                if off <= 0.0 && pair.opening(model, r + off) < 0.0 {
                    assert_eq!(run.outcome, Outcome::Unresolved, "{what}");
                    continue;
                }
                assert_eq!(run.outcome, limit.outcome, "{what}");
                if limit.outcome == Outcome::Scattered {
                    assert!(apart(&run, &limit) < 1e-6, "{what}");
                }
            }
            stay += usize::from(limit.outcome == Outcome::Unresolved);
            leave += usize::from(limit.outcome == Outcome::Scattered);
        }
    }
    assert!(stay > 2 && leave > 2, "{stay} {leave}");
}

#[test]
fn passive_spheres_rest_at_the_smallest_gap_and_at_the_departure_distance_too() {
    let pair = Pair {
        beta: [None; 2],
        headings_deg: [0.0, 90.0],
        repulsion: None,
    };
    for (r, outcome) in [(floor(), Outcome::Standoff), (12.0, Outcome::Undecided)] {
        for off in [0.0, r.next_up() - r, r - r.next_up(), 1e-12, 1e-9] {
            let run = pair.run(by_mesh(), r + off).unwrap();
            assert_eq!(run.outcome, outcome, "{off:e} off {r}");
            assert!(run.end_time > 99.0);
        }
    }
}

#[test]
fn starts_as_close_as_two_positions_can_be_end_as_those_a_little_further_apart() {
    let closest = 2.0_f64.next_up();
    for pair in pairs(12) {
        let limit = pair.run(exact(), 2.0 + 1e-11).unwrap();
        let run = pair.run(exact(), closest).unwrap();
        assert_eq!(run.outcome, limit.outcome, "{pair:?}");
    }
}
