//! Loads against `exact`: the figures that the documentation states.

#![allow(clippy::unwrap_used, reason = "a test may panic, its helpers too")]

use bem::Bem;
use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet};

fn gap(eps: f64) -> Gap {
    Gap::new(eps).unwrap()
}

#[test]
fn val_the_default_level_has_every_load_to_its_stated_figure_with_1500_nodes() {
    let (model, exact) = (Bem::new(Bem::DEFAULT_LEVEL).unwrap(), Exact::new());
    for (eps, bound) in [(1.0, 1e-4), (0.1, 1e-4), (0.01, 1e-4), (0.001, 1e-3)] {
        let solution = model.solve(gap(eps), LoadSet::all(2)).unwrap();
        let truth = exact.loads(gap(eps), LoadSet::all(2)).unwrap();
        let (_, error) = solution.loads.worst_error(&truth);
        assert!(error < bound, "{error:e} at gap {eps}");
        assert!(solution.nodes <= 1500, "{} at gap {eps}", solution.nodes);
    }
}

#[test]
fn val_each_level_is_closer_than_the_one_before() {
    let exact = Exact::new();
    for eps in [1.0, 0.1, 0.01, 0.004] {
        let truth = exact.loads(gap(eps), LoadSet::all(2)).unwrap();
        let errors = [1, 2, 3, 4].map(|level| {
            let loads = Bem::new(level)
                .unwrap()
                .loads(gap(eps), LoadSet::all(2))
                .unwrap();
            loads.worst_error(&truth).1
        });
        assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?} at gap {eps}");
        assert!(errors[3] < errors[0] / 20.0, "{errors:?} at gap {eps}");
    }
}

#[test]
fn val_the_smallest_gap_of_each_level_is_resolved_to_half_a_percent() {
    let exact = Exact::new();
    for level in 1..=3 {
        let model = Bem::new(level).unwrap();
        let smallest = gap(model.range().smallest);
        let loads = model.loads(smallest, LoadSet::all(2)).unwrap();
        let truth = exact.loads(smallest, LoadSet::all(2)).unwrap();
        let (_, error) = loads.worst_error(&truth);
        assert!(error < 5e-3, "{error:e} at level {level}");
    }
}

#[test]
fn val_the_error_is_below_three_times_its_estimate_at_random_gaps() {
    let exact = Exact::new();
    let mut held = 0;
    let count = 40;
    for k in 0..count {
        // Golden-ratio sequence in ln(eps), from 0.004 to 4.
        let share = (f64::from(k) * 0.618_033_988_75).fract();
        let at = Gap::from_ln(0.004f64.ln() + share * 1000f64.ln());
        let model = Bem::new(1 + k as usize % 3).unwrap();
        let loads = model.loads(at, LoadSet::all(2)).unwrap();
        let (_, error) = loads.worst_error(&exact.loads(at, LoadSet::all(2)).unwrap());
        held +=
            u32::from(error <= 3.0 * model.error_estimate(at, LoadSet::all(2)).unwrap().unwrap());
    }
    assert!(held >= 38, "{held} of {count}");
}
