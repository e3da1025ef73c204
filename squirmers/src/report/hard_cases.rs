//! The section on numerically hard cases.

use crate::error::CommandError;
use crate::page::{Section, Table};
use compare::hard_cases::{self, Bench, GROUPS};
use compare::output::{OutputFolder, csv_text};
use compare::{Method, ModelOptions};

pub(super) fn section(
    methods: &[Method],
    options: &ModelOptions,
    out: &OutputFolder,
) -> Result<Section, CommandError> {
    let mut section = Section {
        id: "hard-cases".to_owned(),
        title: "Hard cases".to_owned(),
        ..Section::default()
    };
    if !methods.contains(&Method::Exact) {
        section.prose.push(LEFT_OUT.to_owned());
        return Ok(section);
    }
    let groups: Vec<_> = GROUPS.iter().collect();
    let mut rows = Vec::new();
    hard_cases::run(&Bench::set_up(options)?, &groups, &mut |_, of_group| {
        rows.extend(of_group);
    });
    let csv = csv_text(&rows)?;
    out.write("hard-cases.csv", &csv)?;
    let broken = out.account().bounds(rows.iter().map(|row| row.holds));
    section.finding = match broken {
        0 => format!("All {} bounds hold.", rows.len()),
        broken => format!("{broken} of {} bounds are broken.", rows.len()),
    };
    section.prose.push(PROSE.to_owned());
    section.tables.push(Table::from_csv(
        "The measured quantity, its largest allowed value, and the reason for this bound.",
        "hard-cases.csv",
        &csv,
    )?);
    Ok(section)
}

const PROSE: &str = "Contact, stiff forces, unstable states, long orbits and oscillations, broken symmetry, large \
    distances, the worst panels, random gaps, starts where runs change or end, tangents from contact, very unlike \
    radii, hostile submissions, and numbers at the ends of the machine's range. Each value is measured and compared \
    with a bound. The bound follows from rounding, from the tolerance or from a closed form.";

const LEFT_OUT: &str = "Left out: the hard cases are about all methods, and --method does not name exact. \
    `squirmers hard-cases` runs them.";
