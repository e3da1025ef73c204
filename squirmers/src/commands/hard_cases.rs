//! `squirmers hard-cases`: numerically hard cases, printed group by group as they come.

use clap::Args;
use comfy_table::Table;

use crate::arguments::GeneralArguments;
use crate::error::CommandError;
use crate::progress;
use crate::streams::print_line;
use crate::terminal::words;
use compare::hard_cases::{self, Bench, GROUPS, Group, HardCaseRow};
use compare::numbers::size;
use compare::output::csv_text;

#[derive(Debug, Args)]
pub(crate) struct HardCaseArguments {
    /// Groups to run, such as contact or long-runs [default: all]
    #[arg(long, value_name = "LIST", value_parser = parse_groups)]
    only: Option<Groups>,
}

/// Groups in the order of [`GROUPS`], none twice.
#[derive(Clone, Debug)]
struct Groups(Vec<&'static Group>);

/// A group's name as it is typed: with dashes, because a list on the command line has no spaces.
fn typed(group: &Group) -> String {
    group.name.replace(' ', "-")
}

fn parse_groups(text: &str) -> Result<Groups, String> {
    let mut chosen = [false; GROUPS.len()];
    for name in text.split(',').map(str::trim) {
        let place = GROUPS.iter().position(|group| typed(group) == name);
        let place = place.ok_or_else(|| {
            let known: Vec<_> = GROUPS.iter().map(typed).collect();
            format!("'{name}' is not a group: use {}", known.join(", "))
        })?;
        if std::mem::replace(&mut chosen[place], true) {
            return Err(format!("'{name}' is in the list twice: once is enough"));
        }
    }
    let groups = GROUPS.iter().zip(chosen);
    Ok(Groups(
        groups
            .filter_map(|(group, chosen)| chosen.then_some(group))
            .collect(),
    ))
}

pub(super) fn run(
    arguments: &HardCaseArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let groups = match &arguments.only {
        Some(groups) => groups.0.clone(),
        None => GROUPS.iter().collect(),
    };
    let out = general.output()?;
    let bench = Bench::set_up(&general.model_options())?;
    let mut rows = Vec::new();
    hard_cases::run(&bench, &groups, &mut |group, of_group| {
        progress::aside(|| print(group, &of_group));
        rows.extend(of_group);
    });
    out.write("hard-cases.csv", &csv_text(&rows)?)?;
    out.account().bounds(rows.iter().map(|row| row.holds));
    out.account().verdict()?;
    print_line!("all {} bounds hold", rows.len());
    Ok(())
}

fn print(group: &Group, rows: &[HardCaseRow]) {
    let heading = vec![format!("{}: {}", group.name, group.hazard)];
    print_line!("{}", words([heading].into_iter()));
    print_line!("{}\n", table(rows));
}

fn table(rows: &[HardCaseRow]) -> Table {
    let header = ["method", "measure", "bound", "value", "holds"].map(str::to_owned);
    let rows = rows.iter().map(|row| {
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
        let text = table(&[row]).to_string();
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{text}"
        );
        for whole in ["lt-corrected", "1.5e-8", "-2.5e-11", "yes"] {
            assert!(text.contains(whole), "{text}");
        }
    }

    #[test]
    fn groups_come_in_their_fixed_order_however_they_are_typed() {
        let groups = parse_groups("far, no-repulsion").unwrap().0;
        let names: Vec<_> = groups.iter().map(|group| group.name).collect();
        assert_eq!(names, ["no repulsion", "far"]);
        for (list, named) in [
            (
                "contact,files",
                "'files' is not a group: use contact, no-repulsion,",
            ),
            ("far,far", "'far' is in the list twice"),
            ("", "'' is not a group"),
        ] {
            let refused = parse_groups(list).unwrap_err();
            assert!(refused.contains(named), "{refused}");
        }
    }
}
