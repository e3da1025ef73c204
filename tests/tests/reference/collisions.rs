//! Deflections, bound states and shares against runs by boundary elements, and by exact loads without a table.

use compare::study::maps::{Grid, Pair, fates_of, scatter_row};
use compare::{Approach, Case, Method, Model, ModelOptions};
use exact::Exact;
use rayon::prelude::*;
use scene::{LoadSet, Outcome, Repulsion, RunOptions, Squirmer, bound_states, run};

use super::*;

/// Boundary elements with a table, which share no code with the exact series.
static BEM: LazyLock<Model> = LazyLock::new(|| {
    let options = ModelOptions {
        cache: None,
        tabulated: LoadSet::planar(2),
        ..ModelOptions::default()
    };
    Model::set_up(Method::Bem, &options).unwrap()
});

fn case(row: &HashMap<String, String>) -> Case {
    Case {
        approach: match row["approach"].as_str() {
            "head-on" => Approach::HeadOn,
            _ => Approach::Orthogonal,
        },
        beta: number(row, "beta"),
        dx: number(row, "dx"),
        dz: 0.0,
    }
}

#[test]
fn val_deflections_are_those_of_boundary_elements() {
    let rows = rows_of("deflections.csv");
    assert_eq!(rows.len(), 17);
    for row in rows {
        let case = case(&row);
        let run = run(&case.scene().unwrap(), &**BEM, &RunOptions::default()).unwrap();
        let found = run.deflections_rad().map(f64::to_degrees);
        for (column, found) in ["deflection1_deg", "deflection2_deg"].iter().zip(found) {
            let off = (number(&row, column) - found).abs();
            assert!(off < 0.011, "{row:?}: {found}");
        }
        assert!(
            (number(&row, "min_gap") / run.min_gap - 1.0).abs() < 2e-3,
            "{row:?}"
        );
        assert!(
            (number(&row, "tau") - run.contact_time).abs() < 2e-3,
            "{row:?}"
        );
        assert_eq!(row["outcome"], run.outcome.to_string());
    }
}

#[test]
fn val_deflections_are_within_their_errors_of_runs_without_a_table() {
    let exact = Exact::new();
    let options = RunOptions {
        tolerance: 1e-11,
        ..RunOptions::default()
    };
    let mut compared = 0;
    for row in rows_of("deflections.csv") {
        let parts = ["model", "interpolation", "integration", "truncation"];
        let sum: f64 = parts
            .iter()
            .map(|part| number(&row, &format!("{part}_deg")))
            .sum();
        let error = number(&row, "error_deg");
        // The rest is rounding: half a unit of the last digit, which is below ten times the sum.
        assert!(sum < 1.1 * error && error < 6.0 * sum, "{row:?}");
        // One of each approach that takes a second.
        if number(&row, "dx") < 2.0 && number(&row, "beta") > 1.0 && row["approach"] == "head-on"
            || number(&row, "dx") > 4.0 && number(&row, "beta") < 0.0
        {
            let case = case(&row);
            let run = run(&case.scene().unwrap(), &exact, &options).unwrap();
            let found = run.deflections_rad().map(f64::to_degrees);
            for (column, found) in ["deflection1_deg", "deflection2_deg"].iter().zip(found) {
                let off = (number(&row, column) - found).abs();
                assert!(off < error, "{row:?}: {found}");
            }
            compared += 1;
        }
    }
    assert_eq!(compared, 2);
}

#[test]
fn val_bound_states_are_those_of_boundary_elements() {
    let rows = rows_of("bound-states.csv");
    for beta in [0.0, 1.0, 5.0, -1.0, -5.0] {
        let squirmer = Squirmer::with_beta(1.0, beta).unwrap();
        let states = bound_states(&**BEM, &squirmer, Repulsion::PAPER).unwrap();
        let of_beta = |row: &&HashMap<String, String>| (number(row, "beta") - beta).abs() < 1e-12;
        for row in rows.iter().filter(of_beta) {
            // The closest of its kind.
            let apart = |state: &scene::BoundState| {
                let turned = |column: &str, angle: f64| {
                    let off = (number(row, column) - angle.to_degrees()).rem_euclid(360.0);
                    off.min(360.0 - off)
                };
                let [one, two] = state.angles_rad;
                let angles = turned("angle1_deg", one).max(turned("angle2_deg", two));
                let gap = (state.gap.eps() / number(row, "gap") - 1.0).abs();
                let speed = (state.speed - number(row, "speed")).abs();
                let turning = (state.turning_rate_rad - number(row, "turning")).abs();
                let growth = (state.growth() - number(row, "growth")).abs();
                (
                    gap + angles.to_radians(),
                    [gap, angles, speed, turning, growth],
                )
            };
            let (_, [gap, angles, speed, turning, growth]) = (states.iter())
                .filter(|state| state.outcome.to_string() == row["outcome"])
                .map(apart)
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .unwrap();
            println!(
                "{beta} {}: {gap:.1e} {angles:.1e} {speed:.1e} {turning:.1e} {growth:.1e}",
                row["outcome"]
            );
            if row["one_of_a_line"] == "true" {
                continue;
            }
            assert!(gap < 5e-3 && angles < 0.1, "{row:?}: {gap:e} {angles:e}");
            assert!(speed < 1e-3 && turning < 1e-3 && growth < 0.01, "{row:?}");
        }
    }
}

#[test]
fn val_bound_pairs_are_as_many_as_by_boundary_elements() {
    // Built before the threads of the pool are asked for it: it is built by them.
    let bem: &Model = &BEM;
    let sides = Grid::new(20).unwrap().values();
    let points: Vec<_> = (sides.iter())
        .flat_map(|&sigma| sides.iter().map(move |&delta| (delta, sigma)))
        .collect();
    for row in rows_of("shares.csv") {
        let shares: f64 = (Outcome::ALL.iter())
            .filter_map(|outcome| row.get(&outcome.to_string()))
            .map(|share| share.parse::<f64>().unwrap())
            .sum();
        assert!(
            (shares + number(&row, "failed") - 1.0).abs() < 1e-12,
            "{row:?}"
        );
        let beta = number(&row, "beta");
        if beta.abs() < 4.0 {
            continue;
        }
        let pair = Pair {
            beta,
            g: 0.0,
            dz: 0.0,
        };
        let options = RunOptions::default();
        let found: Vec<_> = (points.par_iter())
            .map(|&point| scatter_row(bem, pair, point, &options))
            .collect();
        let found = fates_of(bem, pair, &found);
        let bound = ["standoff", "pairwise", "anticlockwise", "clockwise"];
        let bound: f64 = bound.iter().map(|column| number(&row, column)).sum();
        println!("{beta}: {bound} {}", found.bound());
        // A grid of 20 x 20 leaves about one line of it.
        assert!((bound - found.bound()).abs() < 0.03, "{row:?}: {found:?}");
    }
}
