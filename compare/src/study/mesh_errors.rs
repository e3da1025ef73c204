//! Errors of the boundary elements' loads against the exact loads, for each level of the mesh.

use bem::Bem;
use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet, PairLoads};
use serde::Serialize;

use crate::CompareError;
use crate::columns::columns;

/// Loads of the paper's squirmers.
const LOADS: LoadSet = LoadSet::all(2);

/// Gaps, in radii.
const GAPS: [f64; 4] = [1.0, 0.1, 0.01, 0.001];

/// Highest level. The next level would take longer than all of these levels together.
const HIGHEST: usize = 4;

columns! {
    /// A row for each gap and level of the mesh. A level that does not resolve the gap has no row.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct MeshErrorRow {
        /// Gap between the surfaces of the squirmers.
        #[unit = "a"]
        pub gap: f64,
        /// Level of the mesh; higher levels are finer.
        #[unit = "-"]
        pub level: usize,
        /// Number of nodes on a sphere.
        #[unit = "-"]
        pub nodes: usize,
        /// Largest error of a load, divided by the load or by 1 (thrusts: by 4), whichever is larger.
        #[unit = "-"]
        pub worst_error: f64,
        /// Name of the load with the largest error.
        #[unit = "-"]
        pub load: String,
        /// Observed order of convergence: the power of the node spacing with which the error fell from the level
        /// before. NaN for the first level of a gap.
        #[unit = "-"]
        pub order: f64,
        /// Time to compute all loads at this gap.
        #[unit = "s"]
        pub seconds: f64,
    }
}

/// The errors at each gap and level. A level that does not resolve a gap is left out.
///
/// # Errors
/// [`CompareError`] if a solve fails.
pub fn mesh_errors() -> Result<Vec<MeshErrorRow>, CompareError> {
    let mut rows: Vec<MeshErrorRow> = Vec::new();
    for eps in GAPS {
        let gap = Gap::new(eps)?;
        let truth = Exact::new().loads(gap, LOADS)?;
        for level in Bem::LEVELS.0..=HIGHEST {
            let bem = Bem::new(level)?;
            if bem.check(gap).is_ok() {
                let before = rows.last().filter(|row| row.gap.total_cmp(&eps).is_eq());
                let row = row(&bem, gap, &truth, before)?;
                rows.push(row);
            }
        }
    }
    Ok(rows)
}

fn row(
    bem: &Bem,
    gap: Gap,
    truth: &PairLoads,
    before: Option<&MeshErrorRow>,
) -> Result<MeshErrorRow, CompareError> {
    let solution = bem.solve(gap, LOADS)?;
    let (load, worst_error) = solution.loads.worst_error(truth);
    let order = before.map_or(f64::NAN, |before| {
        let finer = solution.nodes as f64 / before.nodes as f64;
        2.0 * (before.worst_error / worst_error).ln() / finer.ln()
    });
    Ok(MeshErrorRow {
        gap: gap.eps(),
        level: bem.level(),
        nodes: solution.nodes,
        worst_error,
        load,
        order,
        seconds: solution.seconds.assembly + solution.seconds.solve,
    })
}
