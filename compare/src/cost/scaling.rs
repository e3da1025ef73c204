//! Time against size: unknowns of boundary elements, trajectories and threads of sweeps; and where
//! the time of a trajectory goes.

use std::hint::black_box;

use bem::Bem;
use lt::{Form, Lubrication};
use rayon::prelude::*;
use scene::balance::{External, Heading, pair_velocity};
use scene::{Gap, Hydrodynamics, Repulsion, RunOptions, Scene, Squirmer, run};

use super::tables::Tables;
use super::timing::timed;
use super::{CostOptions, CostRow, MODES, Part};
use crate::{Approach, Case, CompareError, Method};

/// Gap at which boundary elements are solved.
const GAP: f64 = 0.1;

/// Unknowns on both spheres together before symmetry is used: three a vertex.
const UNKNOWNS_A_NODE: usize = 6;

/// Offsets of the paths in a sweep, in radii: all collide.
const OFFSETS: (f64, f64) = (0.5, 3.0);

/// Time against unknowns of assembly and of factorisation with back-substitution.
pub(super) fn boundary_elements(
    options: &CostOptions,
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    let gap = Gap::new(GAP)?;
    for level in 1..=options.highest_level() {
        let model = Bem::new(level)?;
        let repeats = if level > 3 { 1 } else { 3 };
        let (mut assembly, mut solve) = (f64::INFINITY, f64::INFINITY);
        let (mut unknowns, mut solves) = (0, 0);
        for _ in 0..repeats {
            let solution = model.solve(gap, MODES)?;
            assembly = assembly.min(solution.seconds.assembly);
            solve = solve.min(solution.seconds.solve);
            unknowns = UNKNOWNS_A_NODE * solution.nodes;
            solves = solution.solves;
        }
        for (what, seconds) in [("bem-assembly", assembly), ("bem-factorisation", solve)] {
            let knob = ("unknowns", unknowns as f64);
            rows.push(CostRow {
                seconds,
                repeats,
                solves: solves as f64,
                ..CostRow::new(Part::Scaling, what, knob, GAP.to_string())
            });
        }
    }
    Ok(())
}

/// Exponent of the power law through the times of `model` against its knob, by least squares of the
/// logarithms; NaN for fewer than two points.
#[must_use]
pub fn exponent(rows: &[CostRow], model: &str) -> f64 {
    let points: Vec<_> = (rows.iter())
        .filter(|row| row.part == Part::Scaling && row.model == model)
        .map(|row| (row.value.ln(), row.seconds.ln()))
        .collect();
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let variance: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    covariance / variance
}

/// Trajectories after which a table has paid for itself: its set-up over what a trajectory saves,
/// for the models with a table, by the median over the cases at the tolerance 1e-8 and the time of
/// one solve at the gap 0.01.
#[must_use]
pub fn break_even(rows: &[CostRow]) -> Vec<(String, f64)> {
    let mut models: Vec<&str> = (rows.iter())
        .filter(|row| row.part == Part::Deflection && row.model.ends_with("-table"))
        .map(|row| row.model.as_str())
        .collect();
    models.dedup();
    models.sort_unstable();
    models.dedup();
    let of = |model: &str| {
        let mine: Vec<&CostRow> = (rows.iter())
            .filter(|r| r.part == Part::Deflection && r.model == model)
            .filter(|r| (r.value.log10() + 8.0).abs() < 0.1 && r.seconds.is_finite())
            .collect();
        let middle = |of: fn(&CostRow) -> f64| {
            let mut values: Vec<f64> = mine.iter().map(|row| of(row)).collect();
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
        };
        let direct = middle(|row| row.loads) * seconds_of_solve(rows, model);
        middle(|row| row.set_up_seconds) / (direct - middle(|row| row.seconds))
    };
    (models.into_iter())
        .map(|model| (model.to_owned(), of(model)))
        .collect()
}

/// Seconds of one solve at the gap 0.01 by the model behind the table `model`.
fn seconds_of_solve(rows: &[CostRow], model: &str) -> f64 {
    let behind = model.trim_end_matches("-table");
    let (name, value) = match behind.strip_prefix("bem-") {
        Some(level) => ("bem", level.parse().unwrap_or(f64::NAN)),
        None => (behind, 1.0),
    };
    (rows.iter())
        .filter(|r| r.part == Part::Loads && r.model == name && r.gap_or_case == "0.01")
        .find(|r| (r.value - value).abs() < 1e-9)
        .map_or(f64::NAN, |row| row.seconds)
}

/// Sweeps of collisions by the exact table, by one thread and by two.
pub(super) fn sweeps(
    options: &CostOptions,
    tables: &Tables,
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    let sizes: &[usize] = if options.quick {
        &[100, 1000]
    } else {
        &[100, 1000, 10_000]
    };
    let model = &tables.usual_exact().table;
    for &size in sizes {
        let scenes = scenes(size)?;
        for threads in [1, 2] {
            let pool = (rayon::ThreadPoolBuilder::new().num_threads(threads))
                .build()
                .map_err(|error| CompareError::input("threads", threads, error.to_string()))?;
            let sweep = || -> u64 {
                let runs = scenes.par_iter().map(|scene| {
                    let found = run(scene, model, &RunOptions::default());
                    found.map_or(0, |run| run.counters.loads)
                });
                runs.sum()
            };
            let (loads, timing) = pool.install(|| timed(sweep));
            let plural = if threads == 1 { "thread" } else { "threads" };
            rows.push(CostRow {
                seconds: timing.seconds,
                repeats: timing.repeats,
                loads: loads as f64,
                ..CostRow::new(
                    Part::Scaling,
                    "exact-table-sweep",
                    ("trajectories", size as f64),
                    format!("{threads} {plural}"),
                )
            });
        }
    }
    Ok(())
}

fn scenes(size: usize) -> Result<Vec<Scene>, CompareError> {
    (0..size)
        .map(|i| {
            let share = (i as f64 + 0.5) / size as f64;
            Ok(fig_6(OFFSETS.0 + share * (OFFSETS.1 - OFFSETS.0)).scene()?)
        })
        .collect()
}

fn fig_6(dx: f64) -> Case {
    Case {
        approach: Approach::HeadOn,
        beta: 5.0,
        dx,
        dz: 0.0,
    }
}

/// Where a trajectory's time goes: the loads alone, with the force balance and its sines, and a
/// whole collision per right-hand side.
pub(super) fn right_hand_sides(
    tables: &Tables,
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    profile(Method::Lt.name(), &Lubrication::new(Form::Published), rows)?;
    profile("exact-table", &tables.usual_exact().table, rows)?;
    for built in tables.usual_bem() {
        let name = format!("bem-{}-table", built.table.model().level());
        profile(&name, &built.table, rows)?;
    }
    Ok(())
}

/// Logarithms of gaps of a collision.
const LN_GAPS: [f64; 8] = [-5.3, -0.2, -3.1, -4.6, -1.7, -0.9, -2.4, -3.9];

fn profile<M: Hydrodynamics>(
    name: &str,
    model: &M,
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    let squirmers = [Squirmer::with_beta(1.0, 5.0)?; 2];
    let loads = || {
        for ln_gap in LN_GAPS {
            let gap = Gap::from_ln(black_box(ln_gap));
            let _ = black_box(&model.interacting_loads(gap, MODES));
        }
    };
    let velocities = || {
        for ln_gap in LN_GAPS {
            let gap = Gap::from_ln(black_box(ln_gap));
            let Ok(loads) = &model.interacting_loads(gap, MODES) else {
                continue;
            };
            let headings = [ln_gap, 1.0 - ln_gap].map(|angle| {
                let (transverse, cosine) = angle.sin_cos();
                Heading { cosine, transverse }
            });
            let external = External {
                repulsion: Repulsion::PAPER.force(gap),
                torque: [0.0; 2],
            };
            black_box(pair_velocity(gap, loads, &squirmers, &headings, &external));
        }
    };
    let mut push = |knob: &str, case: &str, seconds: f64, repeats: u64| {
        rows.push(CostRow {
            seconds,
            repeats,
            ..CostRow::new(Part::Profile, name, (knob, f64::NAN), case)
        });
    };
    let each = LN_GAPS.len() as f64;
    let (_, timing) = timed(loads);
    push("loads", "collision", timing.seconds / each, timing.repeats);
    let (_, timing) = timed(velocities);
    let per_velocity = timing.seconds / each;
    push("velocity", "collision", per_velocity, timing.repeats);
    let scene = fig_6(1.0).scene()?;
    let (found, timing) = timed(|| run(&scene, model, &RunOptions::default()));
    let loads = found?.counters.loads as f64;
    let case = "head-on beta 5 dx 1";
    push("trajectory", case, timing.seconds, timing.repeats);
    let per_right_hand_side = timing.seconds / loads;
    push(
        "right-hand side with its share of the step",
        case,
        per_right_hand_side,
        timing.repeats,
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponent_of_a_power_law_is_found() {
        let rows: Vec<_> = [1e2, 1e3, 1e4]
            .map(|n: f64| CostRow {
                seconds: 3e-9 * n.powf(2.5),
                ..CostRow::new(Part::Scaling, "made", ("unknowns", n), "0.1")
            })
            .into();
        approx::assert_relative_eq!(exponent(&rows, "made"), 2.5, max_relative = 1e-12);
        assert!(exponent(&rows, "absent").is_nan());
    }
}
