//! The section on numerically hard cases.

use crate::error::CommandError;
use crate::page::{Section, Table};
use compare::ModelOptions;
use compare::hard_cases::{Bench, all_rows};
use compare::output::{OutputFolder, csv_text};

pub(super) fn section(options: &ModelOptions, out: &OutputFolder) -> Result<Section, CommandError> {
    let rows = all_rows(&Bench::set_up(options)?);
    let csv = csv_text(&rows)?;
    out.write("hard-cases.csv", &csv)?;
    let broken = rows.iter().filter(|row| !row.holds).count();
    out.account().broken(broken, rows.len());
    let verdict = if broken == 0 {
        format!("All {} bounds hold.", rows.len())
    } else {
        format!("{broken} of {} bounds are broken.", rows.len())
    };
    Ok(Section {
        id: "hard-cases".to_owned(),
        title: "Hard cases".to_owned(),
        finding: verdict,
        prose: vec![
            "Contact, stiff forces, unstable states, long orbits and oscillations, broken symmetry, far separations, the worst panels, random gaps, and the ends of the machine's \
             numbers, files and processes: \
             each is measured and compared with a bound that follows from rounding, the tolerance or a \
             closed form."
                .to_owned(),
        ],
        figures: Vec::new(),
        tables: vec![Table::from_csv(
            "The measured quantity, its largest allowed value, and the reason for this bound.",
            "hard-cases.csv",
            &csv,
        )?],
    })
}
