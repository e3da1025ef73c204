//! Time as a function of size: unknowns of boundary elements, trajectories and threads of sweeps.

use std::time::Duration;

use bem::Bem;
use rayon::prelude::*;
use scene::{Gap, RunOptions, Scene};

use super::tables::Tables;
use super::timing::timed_within;
use super::{CostOptions, CostRow, LOADS, Part};
use crate::{Approach, Case, CompareError};

/// Gap at which boundary elements are solved, in radii.
const GAP: f64 = 0.1;

/// Unknowns on both spheres together, before symmetry is used: three per vertex.
const UNKNOWNS_A_NODE: usize = 6;

/// Offsets of the paths in a sweep, in radii. All pairs collide.
const OFFSETS: (f64, f64) = (0.5, 3.0);

/// Time for the repeats of a sweep. It is long, so that both cores are free in at least one repeat.
const SWEEP_BUDGET: Duration = Duration::from_millis(800);

/// Names of the parts of a solve in the rows of [`boundary_elements`].
pub(super) const BEM_PARTS: [&str; 3] = ["bem-assembly", "bem-factorisation", "bem-substitution"];

/// Times of assembly, factorisation and substitution for several numbers of unknowns.
pub(super) fn boundary_elements(
    options: &CostOptions,
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    let gap = Gap::new(GAP)?;
    for level in 1..=options.highest_level() {
        let model = Bem::new(level)?;
        let repeats = if level > 3 { 1 } else { 3 };
        let mut least = [f64::INFINITY; BEM_PARTS.len()];
        let (mut unknowns, mut solves) = (0, 0);
        for _ in 0..repeats {
            let solution = model.solve(gap, LOADS)?;
            let spent = solution.seconds;
            let parts = [spent.assembly, spent.factorisation, spent.substitution];
            for (least, seconds) in least.iter_mut().zip(parts) {
                *least = least.min(seconds);
            }
            unknowns = UNKNOWNS_A_NODE * solution.nodes;
            solves = solution.solves;
        }
        for (what, seconds) in BEM_PARTS.into_iter().zip(least) {
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

/// Model of the rows of [`sweeps`].
pub(super) const SWEEP: &str = "exact-table-sweep";

/// Sweeps of collisions with the exact table, by one thread and by two threads.
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
                    let found = scene::run(scene, model, &RunOptions::default());
                    found.map_or(0, |run| run.counters.loads)
                });
                runs.sum()
            };
            let (loads, timing) = pool.install(|| timed_within(SWEEP_BUDGET, sweep));
            let plural = if threads == 1 { "thread" } else { "threads" };
            rows.push(CostRow {
                seconds: timing.seconds,
                repeats: timing.repeats,
                loads: loads as f64,
                ..CostRow::new(
                    Part::Scaling,
                    SWEEP,
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
            fig_6(OFFSETS.0 + share * (OFFSETS.1 - OFFSETS.0)).scene()
        })
        .collect()
}

pub(super) fn fig_6(dx: f64) -> Case {
    Case {
        approach: Approach::HeadOn,
        beta: 5.0,
        dx,
        dz: 0.0,
    }
}
