//! `squirmers cost`: writes the measured rows, draws them, and prints a summary.

use std::time::Instant;

use bem::Bem;
use clap::Args;
use scene::{Gap, LoadSet};

use crate::arguments::GeneralArguments;
use crate::error::CommandError;
use crate::figures::{deflections_work_precision, loads_work_precision};
use crate::streams::{print_line, write_out};
use crate::terminal::print_rows;
use compare::cost::{
    self, CostOptions, CostRow, Finding, Part, Recommendation, findings, parse_target, recommend,
};
use compare::numbers::{rounded, size, written};
use compare::output::csv_text;
use compare::watch::{Pieces, Progress};

use crate::provenance;

/// Default target: error of the outgoing angles, in degrees.
const TARGET: &str = "0.1deg";

/// Gap at which the boundary elements are profiled, in radii.
const PROFILED_GAP: f64 = 0.01;

#[derive(Debug, Args)]
pub(crate) struct CostArguments {
    /// Target: the error of the outgoing angles, in degrees
    #[arg(long, value_name = "ANGLE", default_value = TARGET, allow_hyphen_values = true)]
    target: String,
    /// Also print the times of the parts of a trajectory
    #[arg(long)]
    profile: bool,
    /// Measure fewer levels, sizes and cases: takes about a minute
    #[arg(long)]
    quick: bool,
}

pub(super) fn run(
    arguments: &CostArguments,
    general: &GeneralArguments,
    typed: &[String],
) -> Result<(), CommandError> {
    let target = parse_target(&arguments.target)?;
    let out = general.output()?;
    let started = Instant::now();
    let options = CostOptions {
        quick: arguments.quick,
    };
    let progress = Progress::begin("parts of the cost", cost::STAGES, Pieces::Unlike);
    let rows = cost::measure(&options, &|| progress.advance())?;
    drop(progress);
    let csv = csv_text(&rows)?;
    out.write("cost.csv", &csv)?;
    // The pictures show the rows of the file, and nothing else.
    let rows = cost::read(&csv)?;
    out.write("cost-loads.svg", &loads_work_precision(&rows)?)?;
    out.write("cost-deflections.svg", &deflections_work_precision(&rows)?)?;
    let recommended = recommend(&rows, target);
    out.write("cost-target.csv", &csv_text(&recommended)?)?;
    print_recommendations(&recommended);
    let found = findings(&rows);
    out.write("cost-findings.csv", &csv_text(&found)?)?;
    print_line!("");
    print_findings(&found);
    let mut lines = Vec::new();
    if arguments.profile {
        lines.extend(profile_lines(&rows));
        lines.extend(bem_profile_lines()?);
    }
    let made = provenance::of(typed, started.elapsed().as_secs_f64());
    lines.extend([
        made.command,
        format!(
            "{}, {}, threads: {}",
            made.version, made.machine, made.threads
        ),
        format!("{}, {}", made.date, made.total_time),
    ]);
    let text = lines.join("\n") + "\n";
    out.write("cost.txt", &text)?;
    write_out(format_args!("\n{text}"));
    Ok(())
}

fn print_recommendations(recommended: &[Recommendation]) {
    let header = [
        "case",
        "cheapest",
        "tolerance",
        "error [deg]",
        "seconds",
        "set-up [s]",
        "cheapest for one",
    ];
    print_rows(
        &header,
        recommended.iter().map(|row| {
            vec![
                row.case.clone(),
                row.model.clone(),
                written(row.tolerance),
                size(row.error_deg),
                size(row.seconds),
                size(row.set_up_seconds),
                row.model_for_one.clone(),
            ]
        }),
    );
}

fn print_findings(findings: &[Finding]) {
    let header = ["finding", "of", "value", "unit"];
    print_rows(
        &header,
        findings.iter().map(|found| {
            let value = match found.value.abs() {
                v if !(1e-2..1e4).contains(&v) => size(found.value),
                _ => rounded(found.value, 2),
            };
            let unit = found.unit.to_owned();
            vec![found.finding.clone(), found.of.clone(), value, unit]
        }),
    );
}

/// Times of the parts of a boundary-element solve at a small gap, at the default level.
fn bem_profile_lines() -> Result<Vec<String>, CommandError> {
    let bem = Bem::new(Bem::DEFAULT_LEVEL)?;
    let solution = bem.solve(Gap::new(PROFILED_GAP)?, LoadSet::all(2))?;
    let of = format!("bem level {}, gap {PROFILED_GAP}", bem.level());
    let work = solution.work;
    let kinds = [
        ("far", work.far),
        ("near", work.near),
        ("touching", work.touching),
    ];
    let mut lines: Vec<_> = (kinds.into_iter())
        .map(|(kind, share)| {
            let (pairs, seconds) = (share.pairs, share.seconds);
            format!("{of}: {kind} panels {pairs} integrals, {seconds:.2e} s over all threads")
        })
        .collect();
    let spent = solution.seconds;
    lines.push(format!("{of}: assembly {:.2e} s", spent.assembly));
    lines.push(format!(
        "{of}: factorisation and substitution {:.2e} s, over all threads {:.2e} s and {:.2e} s",
        spent.solve, spent.factorisation, spent.substitution
    ));
    Ok(lines)
}

fn profile_lines(rows: &[CostRow]) -> Vec<String> {
    (rows.iter())
        .filter(|row| row.part == Part::Profile)
        .map(|row| {
            let CostRow {
                model,
                knob,
                gap_or_case,
                seconds,
                ..
            } = row;
            format!("{model}, {gap_or_case}: {knob} {seconds:.2e} s")
        })
        .collect()
}
