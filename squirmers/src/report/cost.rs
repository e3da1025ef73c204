//! The section on what accuracy costs in time: from the rows that `squirmers cost` has left in the folder of the
//! report, or else from a quick measurement.

use super::findings;
use crate::error::CommandError;
use crate::figures::{deflections_work_precision, loads_work_precision};
use crate::page::{Figure, Section, Table};
use compare::cost::{self, CostOptions};
use compare::output::{OutputFolder, csv_text};
use compare::watch::{Pieces, Progress};

/// Error of the outgoing angles that the table aims at, in degrees.
const TARGET_DEG: f64 = 0.1;

pub(super) fn section(out: &OutputFolder) -> Result<Section, CommandError> {
    let mut section = Section {
        id: "work-precision".to_owned(),
        title: "What accuracy costs in time".to_owned(),
        ..Section::default()
    };
    let (name, csv) = match out.read("cost.csv") {
        Some(csv) => ("cost.csv", csv),
        None if out.account().stopped() => {
            section.prose.push(
                "The time limit was reached before it was measured: the same command goes on from here."
                    .to_owned(),
            );
            return Ok(section);
        }
        None => ("cost-quick.csv", measured()?),
    };
    let rows = cost::read(&csv)?;
    section.prose.push(
        "Error against the exact answer over wall-clock time, the minimum of repeated runs after a \
         warm-up."
            .to_owned(),
    );
    section.prose.push(if name == "cost.csv" {
        let said = out.read("cost.txt").unwrap_or_default();
        let lines: Vec<&str> = said.lines().collect();
        format!("Measured apart: {}.", lines.join("; "))
    } else {
        out.write(name, &csv)?;
        "Measured with this page, few levels and cases of each method: run `squirmers cost` with the same --out, on \
         a machine that does nothing else, then this again, for all of them."
            .to_owned()
    });
    let found = cost::findings(&rows);
    section.finding = findings::of_cost(&found);
    section.figures = vec![
        Figure {
            svg: loads_work_precision(&rows)?,
            caption:
                "Worst error over the loads of modes 1 and 2 at four gaps, over the time of one \
                      evaluation."
                    .to_owned(),
        },
        Figure {
            svg: deflections_work_precision(&rows)?,
            caption:
                "Error of the outgoing angles over the time of a trajectory, with the tolerance \
                      of its steps as the knob; the time to build tables is not counted here."
                    .to_owned(),
        },
    ];
    let caption = format!(
        "Cheapest method and tolerance that reach {TARGET_DEG} degrees, counting a table's set-up not \
         at all, and for one trajectory alone; the linked file has every row measured."
    );
    let recommended = cost::recommend(&rows, TARGET_DEG);
    section.tables.push(Table::from_rows(
        "What the measurements come to.",
        "cost-findings.csv",
        &found,
    )?);
    section.tables.push(Table {
        csv,
        ..Table::from_rows(&caption, name, &recommended)?
    });
    Ok(section)
}

/// The rows of a quick measurement.
fn measured() -> Result<String, CommandError> {
    let progress = Progress::begin("parts of the cost", cost::STAGES, Pieces::Unlike);
    let rows = cost::measure(&CostOptions { quick: true }, &|| progress.advance())?;
    Ok(csv_text(&rows)?)
}
