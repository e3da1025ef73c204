//! No memory is allocated inside a trajectory's step loop: what a run allocates, if anything, does not
//! depend on how many steps it takes.
//!
//! A file of its own, because the counting allocator serves the whole process.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::alloc::System;
use std::sync::Arc;

use compare::{Approach, Case};
use exact::Exact;
use lt::{Form, Lubrication};
use scene::{Hydrodynamics, LoadSet, Plan, Run, RunOptions, TableOptions, Tabulated, run_plan};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static COUNTING: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Runs a plan by some model.
type RunPlan<'m> = dyn Fn(&Plan, &RunOptions) -> Run + 'm;

/// Allocations and steps of a collision of Fig. 6, in the plane or out of it.
fn allocations(run: &RunPlan<'_>, tolerance: f64, dz: f64) -> (usize, u64) {
    let case = Case {
        approach: Approach::HeadOn,
        beta: 5.0,
        dx: 1.0,
        dz,
    };
    let scene = case.scene().unwrap();
    let options = RunOptions {
        tolerance,
        ..RunOptions::default()
    };
    let plan = Plan::new(&scene).unwrap();
    let region = Region::new(COUNTING);
    let found = run(&plan, &options);
    let change = region.change();
    (
        change.allocations + change.reallocations,
        found.counters.steps,
    )
}

fn allocates_nothing(name: &str, run: &RunPlan<'_>) {
    for dz in [0.0, 0.3] {
        for tolerance in [1e-4, 1e-8, 1e-12] {
            let (found, steps) = allocations(run, tolerance, dz);
            assert_eq!(found, 0, "{name}, dz {dz}, {steps} steps at {tolerance:e}");
        }
    }
}

// One test, because what runs beside it would be counted too.
#[test]
fn trajectories_allocate_nothing() {
    let lubrication = Lubrication::new(Form::Published);
    allocates_nothing("lubrication", &|plan, options| {
        lubrication.run(plan, options, &mut |_| {}).unwrap()
    });
    let options = TableOptions {
        set: LoadSet::all(2),
        tolerance: 1e-6,
        smallest_gap: Exact::new().range().smallest,
    };
    let table = Tabulated::build(Arc::new(Exact::new()), options, &|_| ()).unwrap();
    // The counter sees what there is to see.
    let region = Region::new(COUNTING);
    let copy = std::hint::black_box(vec![1.0; 10]);
    assert_eq!(region.change().allocations, 1, "{copy:?}");
    allocates_nothing("table", &|plan, options| {
        run_plan(plan, &table, options).unwrap()
    });
}
