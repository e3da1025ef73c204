//! The command for numerically hard cases.

use comfy_table::{Table, presets};

use super::args::Arguments;
use crate::hard_cases::{Bench, GROUPS, Group, HardCaseRow, all_rows};
use crate::numbers::size;
use crate::output::csv_text;
use crate::streams::say;
use crate::{CompareError, ModelOptions};

pub(super) fn run(general: &Arguments) -> Result<(), CompareError> {
    let mut options = ModelOptions::default();
    if let Some(cache) = &general.cache {
        options.cache = Some(cache.clone());
    }
    let out = general.output()?;
    let bench = Bench::set_up(&options)?;
    let rows = all_rows(&bench);
    for group in &GROUPS {
        let of_group = rows.iter().filter(|row| row.case == group.name);
        print(group, of_group);
    }
    out.write("hard-cases.csv", &csv_text(&rows)?)?;
    let broken = rows.iter().filter(|row| !row.holds).count();
    out.account().broken(broken, rows.len());
    out.account().verdict()?;
    say!("all {} bounds hold", rows.len());
    Ok(())
}

fn print<'a>(group: &Group, rows: impl Iterator<Item = &'a HardCaseRow>) {
    say!("{}: {}", group.name, group.hazard);
    let mut table = Table::new();
    table.load_preset(presets::NOTHING);
    table.set_header(["method", "measure", "bound", "value", "holds"]);
    table.add_rows(rows.map(|row| {
        [
            row.method.to_owned(),
            row.measure.clone(),
            size(row.bound),
            size(row.value),
            if row.holds { "yes" } else { "NO" }.to_owned(),
        ]
    }));
    say!("{table}\n");
}
