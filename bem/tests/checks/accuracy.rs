//! Loads against `exact`: the figures that the documentation states.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

use bem::pair::PairSolution;
use bem::{Bem, Estimates};
use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet, PairLoads, SwirlLoads};

/// Modes 1 and 2, squirming and swirl.
const SET: LoadSet = LoadSet::all(2).with_swirl(2);

static EXACT: LazyLock<Exact> = LazyLock::new(Exact::new);

fn gap(eps: f64) -> Gap {
    Gap::new(eps).unwrap()
}

/// The loads of a level with their estimates, solved once for all tests.
fn solved(level: usize, eps: f64) -> (PairSolution, Estimates) {
    type Cell = Arc<OnceLock<(PairSolution, Estimates)>>;
    static SOLVED: LazyLock<Mutex<HashMap<(usize, u64), Cell>>> = LazyLock::new(Mutex::default);
    let cell = {
        let mut solved = SOLVED.lock().unwrap();
        Arc::clone(solved.entry((level, eps.to_bits())).or_default())
    };
    *cell.get_or_init(|| {
        let model = Bem::new(level).unwrap();
        model.solve_with_estimates(gap(eps), SET).unwrap()
    })
}

/// The largest error of a load of squirming or rigid motion.
fn error(level: usize, eps: f64) -> f64 {
    let truth = EXACT.loads_with_swirl(gap(eps), SET).unwrap();
    solved(level, eps).0.loads.worst_error(&truth.0).1
}

#[test]
fn val_the_default_level_has_every_load_to_its_stated_figure_with_1500_nodes() {
    for (eps, bound) in [(1.0, 1e-4), (0.1, 1e-4), (0.01, 1e-4), (0.001, 1e-3)] {
        let error = error(Bem::DEFAULT_LEVEL, eps);
        assert!(error < bound, "{error:e} at gap {eps}");
        let nodes = solved(Bem::DEFAULT_LEVEL, eps).0.nodes;
        assert!(nodes <= 1500, "{nodes} at gap {eps}");
    }
}

#[test]
fn val_each_level_is_closer_than_the_one_before() {
    for eps in [1.0, 0.1, 0.02] {
        let errors = [1, 2, 3, 4].map(|level| error(level, eps));
        assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?} at gap {eps}");
        assert!(errors[3] < errors[0] / 20.0, "{errors:?} at gap {eps}");
    }
}

#[test]
fn val_a_finer_level_is_closer_at_the_gap_0_001_too() {
    let [coarse, fine] = [2, 3].map(|level| error(level, 0.001));
    assert!(fine < coarse / 3.0, "{fine:e} after {coarse:e}");
}

#[test]
fn val_the_smallest_gap_of_each_level_is_resolved_to_half_a_percent() {
    for level in 1..=3 {
        let model = Bem::new(level).unwrap();
        let smallest = gap(model.range().smallest);
        let loads = model.loads(smallest, LoadSet::all(2)).unwrap();
        let truth = EXACT.loads(smallest, LoadSet::all(2)).unwrap();
        let (_, error) = loads.worst_error(&truth);
        assert!(error < 5e-3, "{error:e} at level {level}");
    }
}

/// The largest error over its own estimate, over every load.
fn worst_over_estimate(level: usize, eps: f64) -> (String, f64) {
    let (found, estimates) = solved(level, eps);
    let truth = EXACT.loads_with_swirl(gap(eps), SET).unwrap();
    let named = |loads: &PairLoads, swirl: &SwirlLoads| {
        let mut rows = loads.named();
        rows.extend(swirl.named());
        rows
    };
    let errors = named(&found.loads, &found.swirl)
        .into_iter()
        .zip(named(&truth.0, &truth.1));
    let estimates = named(&estimates.loads, &estimates.swirl);
    let ratios = errors.zip(estimates).map(|(((name, value), truth), own)| {
        let (truth, estimate) = (truth.1, own.1);
        (name, (value - truth).abs() / estimate)
    });
    ratios.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
}

#[test]
fn val_every_load_is_within_its_own_estimate() {
    const APART: [f64; 5] = [0.004, 0.006, 0.02, 0.1, 1.0];
    let of_levels = [
        (1, &APART[..]),
        (2, &APART),
        (3, &[0.001, 0.0015]),
        (4, &[0.1]),
    ];
    let mut over = Vec::new();
    for (level, gaps) in of_levels {
        for &eps in gaps {
            let (name, ratio) = worst_over_estimate(level, eps);
            if ratio > 1.0 {
                over.push(format!("{name} at {eps}, level {level}: {ratio}"));
            }
        }
    }
    assert!(over.is_empty(), "{over:?}");
}

#[test]
fn val_the_error_is_below_three_times_its_estimate_at_random_gaps() {
    // Golden-ratio sequence in ln(eps), from 0.004 to 4.
    for k in 0..15_u8 {
        let share = (f64::from(k) * 0.618_033_988_75).fract();
        let at = Gap::from_ln(0.004f64.ln() + share * 1000f64.ln());
        let model = Bem::new(1 + usize::from(k) % 3).unwrap();
        let (loads, estimate) = model.solve_with_estimate(at, LoadSet::all(2)).unwrap();
        let truth = EXACT.loads(at, LoadSet::all(2)).unwrap();
        let (name, error) = loads.loads.worst_error(&truth);
        println!("{:e} {k}: {:.2}", at.eps(), error / estimate);
        assert!(
            error <= 3.0 * estimate,
            "{name} at {:e}: {error:e} against {estimate:e}",
            at.eps()
        );
    }
}
