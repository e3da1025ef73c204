//! The section on the fluid: what encounters do to its stress and to the cost of swimming, and how stresslets grow near contact.

use scene::{Gap, RunOptions};

use super::findings::{listed, number};
use super::{flows, written};
use crate::error::CommandError;
use crate::page::{Section, Table};
use crate::pictures;
use compare::numbers::{rounded, size};
use compare::output::{OutputFolder, csv_text};
use compare::study::stress::{
    Growth, METHODS, StressEncounterRow, StressRow, contact_laws, stress_encounters, stress_rows,
};
use compare::{Defaults, Method, ModelOptions};

/// Gaps of the picture: the largest, and how many to each tenth of it and in all.
const LARGEST_GAP: f64 = 1.0;
const PER_DECADE: u32 = 4;
const GAPS: u32 = 17;

/// Squirming and swirl modes.
const MODES: (usize, usize) = (2, 0);

/// The section by those of `methods` that have stresslets, and the messages of runs without a result; none without such a method.
pub(super) fn section(
    methods: &[Method],
    options: &ModelOptions,
    out: &OutputFolder,
) -> Result<Option<(Section, Vec<String>)>, CommandError> {
    let methods: Vec<_> = (METHODS.into_iter())
        .filter(|method| methods.contains(method))
        .collect();
    if methods.is_empty() {
        return Ok(None);
    }
    let cases = Defaults::paper_encounters()?;
    let (rows, failures) = stress_encounters(&methods, &cases, &RunOptions::default(), options)?;
    out.account().failed(failures.len());
    let csv = csv_text(&rows)?;
    out.write("stress-encounters.csv", &csv)?;
    let gaps = (0..GAPS)
        .map(|k| Gap::new(LARGEST_GAP * 10_f64.powf(-f64::from(k) / f64::from(PER_DECADE))))
        .collect::<Result<Vec<_>, _>>()?;
    // A mesh does not resolve the smallest gaps.
    let resolving: Vec<_> = (methods.iter().copied())
        .filter(|method| {
            let checked = |gap: &Gap| method.check_gap(options.mesh, 1.0, *gap).is_ok();
            gaps.iter().all(checked)
        })
        .collect();
    let by_gap = stress_rows(&resolving, &gaps, MODES, options)?;
    let by_gap_csv = csv_text(&by_gap)?;
    out.write("stress.csv", &by_gap_csv)?;
    let mut figures = flows::figures(methods[0], options, out)?;
    figures.extend(written(pictures::of_stress(&by_gap)?, out)?);
    let section = Section {
        id: "fluid".to_owned(),
        title: "The fluid: flow, stress and power".to_owned(),
        finding: finding(&of(&rows, methods[0])),
        prose: vec![
            "A squirmer adds its stresslet to the stress of a suspension. The excess is the stresslet of the pair less that of two lone \
             squirmers with the orientations of the same instant; docs/FLUID.md has the definitions."
                .to_owned(),
            laws(&by_gap, methods[0]),
            budget(&rows, &methods),
        ],
        figures,
        tables: vec![Table::from_csv(
            "Integral of the excess stresslet over each collision, its average over the interaction time, growth of a squirmer's stresslet, work \
             of slip beyond that of two lone squirmers, Lighthill's efficiency of the pair during the interaction time, and how well \
             dissipation and work agree.",
            "stress-encounters.csv",
            &csv,
        )?],
    };
    Ok(Some((section, failures)))
}

/// The encounter that stresses the fluid most, and the one that hampers swimming most.
fn finding(rows: &[StressEncounterRow]) -> String {
    let most = |of: fn(&StressEncounterRow) -> f64| {
        let known = rows.iter().filter(move |row| of(row).is_finite());
        known.max_by(|a, b| of(a).total_cmp(&of(b)))
    };
    let mut sentences = Vec::new();
    if let Some(row) = most(|row| row.growth) {
        sentences.push(format!(
            "In an encounter a squirmer's stresslet grows to up to {} times that of a lone one ({}).",
            rounded(row.growth, 1),
            place(row)
        ));
    }
    if let Some(row) = most(|row| row.lone_efficiency / row.efficiency) {
        sentences.push(format!(
            "While two squirmers are near each other, the efficiency of their swimming falls to as little as {} of that of lone ones ({}).",
            rounded(row.efficiency / row.lone_efficiency, 2),
            place(row)
        ));
    }
    sentences.join(" ")
}

fn place(row: &StressEncounterRow) -> String {
    let (beta, dx) = (number(row.beta), number(row.dx));
    format!(
        "{}, β = {beta}, δx = {dx}, {}",
        row.case,
        row.method.in_sentence()
    )
}

/// Which numbers grow as the gap closes, and how.
fn laws(rows: &[StressRow], method: Method) -> String {
    let laws = contact_laws(rows, method, 1.0);
    let of = |growth: Growth| -> Vec<String> {
        let those = laws.iter().filter(|law| law.growth == growth);
        those.map(|law| law.name.clone()).collect()
    };
    let parts: Vec<String> = [
        (Growth::Inverse, "grow as 1/ε"),
        (Growth::Logarithm, "grow as ln(1/ε)"),
        (Growth::Bounded, "stay bounded"),
    ]
    .into_iter()
    .map(|(growth, how)| (of(growth), how))
    .filter(|(names, _)| !names.is_empty())
    .map(|(names, how)| format!("{} {how}", listed(&names)))
    .collect();
    if parts.is_empty() {
        String::new()
    } else {
        format!("As the gap closes, {}.", parts.join("; "))
    }
}

/// The rows of a method.
fn of(rows: &[StressEncounterRow], method: Method) -> Vec<StressEncounterRow> {
    let mine = rows.iter().filter(|row| row.method == method);
    mine.cloned().collect()
}

/// How well dissipation and work agree by each method.
fn budget(rows: &[StressEncounterRow], methods: &[Method]) -> String {
    let within = |method: &Method| {
        let budgets = of(rows, *method).into_iter().map(|row| row.budget);
        let worst = budgets.fold(f64::NAN, f64::max);
        format!("within {} by {}", size(worst), method.in_sentence())
    };
    format!(
        "What slip and repulsion do on the fluid is what it dissipates, in every encounter: {}.",
        listed(&methods.iter().map(within).collect::<Vec<_>>())
    )
}
