//! What accuracy costs in time: measured error and time for every method and setting.
//!
//! This follows the work-precision diagrams of SciMLBenchmarks. A time is the smallest of several repeats after a
//! warm-up. Rows hold the maximum norm and the root mean square of the error. The reference is the exact series with
//! more terms and a tighter tolerance. A failure gives a row of NaN.

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
use scene::{LoadSet, Plan, Run, RunOptions, Scene, SceneError};

use crate::CompareError;

pub use findings::{COLLISION, DIRECT, RIGHT_HAND_SIDES};
pub use findings::{Finding, findings};
pub use recommend::parse_target;
pub use recommend::{Recommendation, recommend};
pub use row::{CostRow, Part, read};

use tables::Tables;

/// How much to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostOptions {
    /// Fewer levels, cases and repeats: one minute instead of ten.
    pub quick: bool,
}

impl CostOptions {
    /// Highest level of boundary elements whose loads are measured.
    fn highest_level(&self) -> usize {
        if self.quick { 2 } else { 5 }
    }

    /// Levels of boundary elements that are tabulated.
    fn table_levels(&self) -> &'static [usize] {
        if self.quick { &[1] } else { &[1, 2, 3] }
    }

    /// Largest time in seconds of all runs without a table together. Runs that would take longer are left out.
    fn direct_limit(&self) -> f64 {
        if self.quick { 10.0 } else { 300.0 }
    }
}

/// Number of parts of [`measure`].
pub const STAGES: usize = 5;

/// Measures everything, and calls `done` after each of the [`STAGES`].
///
/// # Errors
/// [`CompareError`] if the reference or the paper's cases fail. A measurement that fails gives a row of NaN.
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

/// Runs a scene by lubrication theory, through its own compiled loop.
fn run_lubrication(
    scene: &Scene,
    model: &Lubrication,
    options: &RunOptions,
) -> Result<Run, SceneError> {
    model.run(&Plan::new(scene)?, options, &mut |_| {})
}

/// Loads that the paper's cases read.
const LOADS: LoadSet = LoadSet::all(2);
