//! What accuracy costs in time: error against time for every method and knob, as measured rows.
//!
//! After the work-precision diagrams of SciMLBenchmarks: times are the smallest of repeats after a
//! warm-up, every norm of the error is kept, the referee is a tighter solve of the exact series, and
//! what failed is a row of NaN.

mod deflections;
mod findings;
mod loads;
mod profile;
mod recommend;
mod row;
mod scaling;
mod tables;
mod timing;

use lt::Lubrication;
use scene::{Hydrodynamics, LoadSet, Plan, Run, RunOptions, Scene, SceneError};

use crate::CompareError;

pub use findings::{COLLISION, DIRECT, RIGHT_HAND_SIDES};
pub use findings::{Finding, findings};
pub use recommend::parse_target;
pub use recommend::{Recommendation, recommend};
pub use row::{CostRow, Part, read};

use tables::Tables;

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostOptions {
    /// Fewer levels, cases and repeats: within a minute instead of ten.
    pub quick: bool,
}

impl CostOptions {
    /// Highest refinement level of the boundary elements whose loads are solved for.
    fn highest_level(&self) -> usize {
        if self.quick { 2 } else { 5 }
    }

    /// Refinement levels of the boundary elements that are tabulated.
    fn table_levels(&self) -> &'static [usize] {
        if self.quick { &[1] } else { &[1, 2, 3] }
    }

    /// Seconds that all runs without a table may take together; what would take longer is left out.
    fn direct_limit(&self) -> f64 {
        if self.quick { 10.0 } else { 300.0 }
    }
}

/// Parts that [`measure`] tells of.
pub const STAGES: usize = 5;

/// Measures everything; `done` is called after each of the [`STAGES`].
///
/// # Errors
/// [`CompareError`] if the referee or the paper's cases fail; a failure of what is measured is a row
/// of NaN.
pub fn measure(options: &CostOptions, done: &dyn Fn()) -> Result<Vec<CostRow>, CompareError> {
    let mut rows = Vec::new();
    let tables = Tables::build(options)?;
    done();
    loads::measure(options, &tables, &mut rows)?;
    done();
    scaling::boundary_elements(options, &mut rows)?;
    done();
    deflections::measure(options, &tables, &mut rows)?;
    done();
    profile::right_hand_sides(&tables, &mut rows)?;
    profile::velocities(&tables, &mut rows)?;
    scaling::sweeps(options, &tables, &mut rows)?;
    done();
    Ok(rows)
}

/// A scene by lubrication theory, through its own compiled loop.
fn run_lubrication(
    scene: &Scene,
    model: &Lubrication,
    options: &RunOptions,
) -> Result<Run, SceneError> {
    model.run(&Plan::new(scene)?, options, &mut |_| {})
}

/// A scene by any other model, through the loop that all others share.
fn run_any(
    scene: &Scene,
    model: &dyn Hydrodynamics,
    options: &RunOptions,
) -> Result<Run, SceneError> {
    scene::run_any(&Plan::new(scene)?, model, options, &mut |_| {})
}

/// Loads of the paper's cases.
const LOADS: LoadSet = LoadSet::all(2);
