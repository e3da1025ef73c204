//! The section on what accuracy costs in time. It shows the rows that `squirmers cost` wrote into the folder of the
//! report, or else those of a quick measurement.

use super::findings;
use crate::error::CommandError;
use crate::figures::{deflections_work_precision, loads_work_precision};
use crate::page::{Figure, Section, Table};
use compare::cost::{self, CostOptions};
use compare::output::{OutputFolder, csv_text};
use compare::watch::{Pieces, Progress};

/// Target of the table: error of the outgoing angles, in degrees.
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
                "The time limit was reached before this was measured. The same command continues from here."
                    .to_owned(),
            );
            return Ok(section);
        }
        None => ("cost-quick.csv", measured()?),
    };
    let rows = cost::read(&csv)?;
    section.prose.push(
        "Error against the exact answer as a function of wall-clock time. Times are the smallest of several \
         repeats after a warm-up."
            .to_owned(),
    );
    section.prose.push(if name == "cost.csv" {
        let said = out.read("cost.txt").unwrap_or_default();
        let lines: Vec<&str> = said.lines().collect();
        format!("From a separate measurement: {}.", lines.join("; "))
    } else {
        out.write(name, &csv)?;
        "These are quick measurements with few levels and cases. For all levels and cases, run `squirmers cost` with the \
         same --out on a machine that does nothing else, then repeat this command."
            .to_owned()
    });
    let found = cost::findings(&rows);
    section.finding = findings::of_cost(&found);
    section.figures = vec![
        Figure {
            svg: loads_work_precision(&rows)?,
            caption:
                "Largest error of the loads of modes 1 and 2 at four gaps, as a function of the time of one \
                 evaluation."
                    .to_owned(),
        },
        Figure {
            svg: deflections_work_precision(&rows)?,
            caption:
                "Error of the outgoing angles as a function of the time of a trajectory, for several tolerances of the \
                 integrator. The time to build tables is not included."
                    .to_owned(),
        },
    ];
    let caption = format!(
        "The cheapest method and tolerance with an error of at most {TARGET_DEG} degrees, first without the set-up of \
         tables, then for a single trajectory with its set-up. The linked file has every measured row."
    );
    let recommended = cost::recommend(&rows, TARGET_DEG);
    section.tables.push(Table::from_rows(
        "Results of the measurements.",
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
