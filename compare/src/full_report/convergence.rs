//! The section on the boundary elements' meshes: error against the exact loads, level by level.

use bem::Bem;
use exact::Exact;
use scene::{Gap, Hydrodynamics, PairLoads};
use serde::Serialize;

use super::LOADS;
use crate::CompareError;
use crate::output::{OutputFolder, csv_text};
use crate::report::{Section, Table};

/// Gaps of the table, in radii.
const GAPS: [f64; 4] = [1.0, 0.1, 0.01, 0.001];

/// Highest level of the table: the next one takes longer than all of these together.
const HIGHEST: usize = 4;

/// One line of `mesh-errors.csv`.
#[derive(Clone, Debug, Serialize)]
struct MeshRow {
    gap: f64,
    level: usize,
    /// Nodes a sphere.
    nodes: usize,
    /// Worst over the loads, relative to the larger of the load and 1, of thrusts and 4.
    worst_error: f64,
    load: String,
    /// Power of the node spacing with which the error fell from the level before.
    order: f64,
    seconds: f64,
}

pub(super) fn section(out: &OutputFolder) -> Result<Section, CompareError> {
    let mut rows: Vec<MeshRow> = Vec::new();
    for eps in GAPS {
        let gap = Gap::new(eps)?;
        let truth = Exact::new().loads(gap, LOADS)?;
        for level in Bem::LEVELS.0..=HIGHEST {
            let bem = Bem::new(level)?;
            // A level that does not resolve the gap refuses it.
            if bem.check(gap).is_ok() {
                let before = rows.last().filter(|row| row.gap.total_cmp(&eps).is_eq());
                let row = row(&bem, gap, &truth, before)?;
                rows.push(row);
            }
        }
    }
    let csv = csv_text(&rows)?;
    out.write("mesh-errors.csv", &csv)?;
    let prose = format!(
        "Boundary elements against the exact loads, level by level; the default is level {}. A level \
         that does not resolve a gap refuses it.",
        Bem::DEFAULT_LEVEL
    );
    Ok(Section {
        id: "meshes".to_owned(),
        title: "How the boundary elements converge".to_owned(),
        finding: finding(&rows),
        prose: vec![prose],
        figures: Vec::new(),
        tables: vec![Table::from_csv(
            "Worst error over the 22 loads of modes 1 and 2, nodes a sphere, observed order in the \
             node spacing, and time for all loads at one gap.",
            "mesh-errors.csv",
            &csv,
        )?],
    })
}

/// What the default level reaches, and with how many nodes.
fn finding(rows: &[MeshRow]) -> String {
    let of_default: Vec<&MeshRow> = (rows.iter())
        .filter(|row| row.level == Bem::DEFAULT_LEVEL)
        .collect();
    let parts: Vec<String> = (of_default.iter())
        .map(|row| format!("{:.0e} at gap {}", row.worst_error, row.gap).replace('-', "\u{2212}"))
        .collect();
    let nodes = of_default.iter().map(|row| row.nodes).max().unwrap_or(0);
    format!(
        "Boundary elements of the default level, {}, have up to {nodes} nodes a sphere; their worst load is off by {}.",
        Bem::DEFAULT_LEVEL,
        parts.join(", ")
    )
}

fn row(
    bem: &Bem,
    gap: Gap,
    truth: &PairLoads,
    before: Option<&MeshRow>,
) -> Result<MeshRow, CompareError> {
    let solution = bem.solve(gap, LOADS)?;
    let (load, worst_error) = solution.loads.worst_error(truth);
    let order = before.map_or(f64::NAN, |before| {
        let finer = solution.nodes as f64 / before.nodes as f64;
        2.0 * (before.worst_error / worst_error).ln() / finer.ln()
    });
    Ok(MeshRow {
        gap: gap.eps(),
        level: bem.level(),
        nodes: solution.nodes,
        worst_error,
        load,
        order,
        seconds: solution.seconds.assembly + solution.seconds.solve,
    })
}
