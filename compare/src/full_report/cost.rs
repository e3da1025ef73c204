//! The section on what accuracy costs in time, from the rows that `squirmers cost` left in the
//! folder of the report: measured apart, since a measurement wants the machine to itself.

use crate::CompareError;
use crate::cost;
use crate::figures::{deflections_work_precision, loads_work_precision};
use crate::output::OutputFolder;
use crate::report::{Figure, Section, Table};

/// Error of the outgoing angles that the table aims at, in degrees.
const TARGET_DEG: f64 = 0.1;

pub(super) fn section(out: &OutputFolder) -> Result<Section, CompareError> {
    let mut section = Section {
        id: "work-precision".to_owned(),
        title: "What accuracy costs in time".to_owned(),
        ..Section::default()
    };
    let Some(csv) = out.read("cost.csv") else {
        section.prose.push(
            "Not measured yet: run `squirmers cost` with the same --out, on a machine that does \
             nothing else, then `squirmers report` again."
                .to_owned(),
        );
        return Ok(section);
    };
    let rows = cost::read(&csv)?;
    section.prose.push(
        "Error against the exact answer over wall-clock time, the minimum of repeated runs after a \
         warm-up."
            .to_owned(),
    );
    let said = out.read("cost.txt").unwrap_or_default();
    let measured: Vec<&str> = said.lines().collect();
    section
        .prose
        .push(format!("Measured apart: {}.", measured.join("; ")));
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
        &cost::findings(&rows),
    )?);
    section.tables.push(Table {
        csv,
        ..Table::from_rows(&caption, "cost.csv", &recommended)?
    });
    Ok(section)
}
