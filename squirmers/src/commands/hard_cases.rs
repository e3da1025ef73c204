//! `squirmers hard-cases`: numerically hard cases, each compared with a bound.

use comfy_table::Table;

use crate::arguments::Arguments;
use crate::error::CommandError;
use crate::streams::say;
use crate::terminal::words;
use compare::ModelOptions;
use compare::hard_cases::{Bench, GROUPS, Group, HardCaseRow, all_rows};
use compare::numbers::size;
use compare::output::csv_text;

pub(super) fn run(general: &Arguments) -> Result<(), CommandError> {
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
    say!(
        "{}",
        words([vec![format!("{}: {}", group.name, group.hazard)]].into_iter())
    );
    say!("{}\n", table(rows));
}

fn table<'a>(rows: impl Iterator<Item = &'a HardCaseRow>) -> Table {
    let header = ["method", "measure", "bound", "value", "holds"].map(str::to_owned);
    let rows = rows.map(|row| {
        vec![
            row.method.to_owned(),
            row.measure.clone(),
            size(row.bound),
            size(row.value),
            if row.holds { "yes" } else { "NO" }.to_owned(),
        ]
    });
    words([header.to_vec()].into_iter().chain(rows))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_measures_wrap_and_numbers_stay_whole() {
        let row = HardCaseRow {
            case: "separatrix",
            hazard: "the tolerance decides the outcome",
            method: "lt-corrected",
            measure: "beta 5, Sigma 0.5: shift in Delta of the line between scattered and bound, tolerance 1e-8"
                .to_owned(),
            bound: 1.5e-8,
            bound_from: "",
            value: -2.5e-11,
            holds: true,
        };
        let text = table([row].iter()).to_string();
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{text}"
        );
        for whole in ["lt-corrected", "1.5e-8", "-2.5e-11", "yes"] {
            assert!(text.contains(whole), "{text}");
        }
    }
}
