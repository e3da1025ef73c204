//! The section on the boundary elements' meshes: errors against the exact loads for each level.

use crate::error::CommandError;
use crate::page::{Section, Table};
use bem::Bem;
use compare::output::{OutputFolder, csv_text};
use compare::{MeshErrorRow, mesh_errors};

pub(super) fn section(out: &OutputFolder) -> Result<Section, CommandError> {
    let rows = mesh_errors()?;
    let csv = csv_text(&rows)?;
    out.write("mesh-errors.csv", &csv)?;
    let prose = format!(
        "Errors of boundary elements against the exact loads, for each level of the mesh. The default is level {}. \
         Gaps that a level does not resolve are left out.",
        Bem::DEFAULT_LEVEL
    );
    Ok(Section {
        id: "meshes".to_owned(),
        title: "How the boundary elements converge".to_owned(),
        finding: finding(&rows),
        prose: vec![prose],
        figures: Vec::new(),
        tables: vec![Table::from_csv(
            "Largest error of the 22 loads of modes 1 and 2, nodes on a sphere, observed order in the \
             node spacing, and time for all loads at one gap.",
            "mesh-errors.csv",
            &csv,
        )?],
    })
}

/// The errors of the default level, and its number of nodes.
fn finding(rows: &[MeshErrorRow]) -> String {
    let of_default: Vec<&MeshErrorRow> = (rows.iter())
        .filter(|row| row.level == Bem::DEFAULT_LEVEL)
        .collect();
    let parts: Vec<String> = (of_default.iter())
        .map(|row| format!("{:.0e} at gap {}", row.worst_error, row.gap).replace('-', "\u{2212}"))
        .collect();
    let nodes = of_default.iter().map(|row| row.nodes).max().unwrap_or(0);
    format!(
        "Boundary elements of the default level {} have up to {nodes} nodes on a sphere. The largest error of a load is {}.",
        Bem::DEFAULT_LEVEL,
        parts.join(", ")
    )
}
