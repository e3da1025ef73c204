//! `squirmers stress`: stresslets, power and efficiency by gap, along a run, and over the paper's encounters.

use std::path::{Path, PathBuf};

use clap::{Arg, Args};
use scene::{Gap, RunOptions};

use super::loads::checked_gaps;
use super::many::print_numbers;
use super::scene::read;
use super::shared::{checked_ratios, highest, model_options};
use crate::arguments::{GeneralArguments, ModelArguments};
use crate::error::CommandError;
use crate::figures;
use crate::pictures;
use crate::streams::print_error;
use crate::terminal::print_rows;
use compare::numbers::{Numbers, parse_numbers, parse_whole, rounded, size, written};
use compare::output::{OutputFolder, csv_text};
use compare::study::stress::{
    METHODS, StressEncounterRow, StressSummary, check_method, stress_encounters, stress_rows,
    stress_run,
};
use compare::{Defaults, Method, ModelOptions, SceneFile};

#[derive(Debug, Args)]
pub(crate) struct StressArguments {
    /// Scene file: along its run (docs/SCENES.md lists its keys) [default: the paper's encounters]
    #[arg(value_name = "SCENE.toml", conflicts_with = "gap")]
    file: Option<PathBuf>,
    /// The paper's encounters (Figs 6 and 7), as without a scene file
    #[arg(long, conflicts_with_all = ["file", "gap"])]
    paper: bool,
    /// By gap: gaps between the surfaces, in radii of sphere 1, each greater than 0
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    gap: Option<Numbers>,
    /// Highest squirming mode, by gap [default: 2]
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_hyphen_values = true, requires = "gap")]
    modes: Option<usize>,
    /// Highest swirl mode, by gap [default: 0, none]
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_hyphen_values = true, requires = "gap")]
    swirl: Option<usize>,
    /// By gap: radii of sphere 2 over that of sphere 1, from 0.01 to 100 [default: 1]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true, requires = "gap")]
    ratio: Option<Numbers>,
    #[command(flatten)]
    models: ModelArguments,
}

/// The help of `--method`.
pub(super) fn methods(argument: Arg) -> Arg {
    let names = METHODS.map(Method::name).join(",");
    argument.help(format!(
        "Methods that have stresslets: exact, bem [default: {names}]"
    ))
}

pub(super) fn run(
    arguments: &StressArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(&arguments.models, &METHODS, general)?;
    for method in &methods {
        check_method(*method)?;
    }
    match (&arguments.gap, &arguments.file) {
        (Some(gaps), _) => by_gap(&gaps.0, arguments, (&methods, options), general),
        (None, Some(path)) => along_a_run(path, arguments, (&methods, &options), general),
        (None, None) => encounters(&methods, &options, general),
    }
}

fn by_gap(
    gaps: &[f64],
    arguments: &StressArguments,
    (methods, options): (&[Method], ModelOptions),
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let modes = (
        highest("--modes", arguments.modes.unwrap_or(2))?,
        highest("--swirl", arguments.swirl.unwrap_or(0))?,
    );
    let ratios = (arguments.ratio.as_ref()).map_or(vec![1.0], |ratios| ratios.0.clone());
    let options = ModelOptions {
        ratios: checked_ratios(ratios)?,
        ..options
    };
    let gaps: Vec<Gap> = checked_gaps(gaps, methods, &options)?;
    let out = OutputFolder::open_beside_others(&general.out)?;
    let rows = stress_rows(methods, &gaps, modes, &options)?;
    out.write("stress.csv", &csv_text(&rows)?)?;
    for picture in pictures::of_stress(&rows)? {
        out.write(&picture.file_name, &picture.svg)?;
    }
    let numbers = rows.iter().map(|row| {
        let (name, error) = (row.name.as_str(), row.error_estimate.as_str());
        (row.method, row.ratio, row.gap, name, row.value, error)
    });
    print_numbers("name", "stress", numbers);
    Ok(())
}

fn along_a_run(
    path: &Path,
    arguments: &StressArguments,
    (methods, options): (&[Method], &ModelOptions),
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let file = read(path)?;
    let file = SceneFile {
        mesh: arguments.models.mesh.unwrap_or(file.mesh),
        direct: arguments.models.direct || file.direct,
        ..file
    };
    let out = general.output()?;
    let runs = (methods.iter())
        .map(|&method| Ok(stress_run(&file, method, options)?))
        .collect::<Result<Vec<_>, CommandError>>()?;
    let rows: Vec<_> = runs
        .iter()
        .flat_map(|run| run.rows.iter().copied())
        .collect();
    out.write("stress-run.csv", &csv_text(&rows)?)?;
    out.write("stress-run.svg", &figures::stress_run(&rows)?)?;
    print_summaries(&runs.iter().map(|run| &run.summary).collect::<Vec<_>>());
    Ok(())
}

/// A line for each quantity, a column for each method.
fn print_summaries(runs: &[&StressSummary]) {
    type Told = (&'static str, fn(&StressSummary) -> String);
    let lines: [Told; 16] = [
        ("outcome", |of| of.outcome.clone()),
        ("end time [a/V_s]", |of| rounded(of.duration, 4)),
        ("smallest gap [a]", |of| rounded(of.min_gap, 6)),
        ("largest stresslet / lone", |of| rounded(of.growth, 4)),
        ("mean excess xx [mu a^2 V_s]", |of| {
            rounded(of.mean_excess[0], 5)
        }),
        ("mean excess xy", |of| rounded(of.mean_excess[1], 5)),
        ("mean excess xz", |of| rounded(of.mean_excess[2], 5)),
        ("mean excess yy", |of| rounded(of.mean_excess[3], 5)),
        ("mean excess yz", |of| rounded(of.mean_excess[4], 5)),
        ("work of slip [mu a^2 V_s]", |of| rounded(of.slip_work, 4)),
        ("beyond two lone squirmers", |of| rounded(of.excess_work, 4)),
        ("work of repulsion and gravity", |of| {
            rounded(of.external_work, 4)
        }),
        ("efficiency", |of| rounded(of.efficiency, 6)),
        ("of two lone squirmers", |of| rounded(of.lone_efficiency, 6)),
        ("largest error of the budget", |of| size(of.budget)),
        ("gaps solved for", |of| of.evaluations.to_string()),
    ];
    let header: Vec<_> = std::iter::once("")
        .chain(runs.iter().map(|of| of.method.name()))
        .collect();
    print_rows(
        &header,
        lines.into_iter().map(|(name, of)| {
            let values = runs.iter().map(|run| of(run));
            std::iter::once(name.to_owned()).chain(values).collect()
        }),
    );
}

fn encounters(
    methods: &[Method],
    options: &ModelOptions,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let cases = Defaults::paper_encounters()?;
    let out = general.output()?;
    let (rows, failures) = stress_encounters(methods, &cases, &RunOptions::default(), options)?;
    out.write("stress-encounters.csv", &csv_text(&rows)?)?;
    print_encounters(&rows);
    for failure in &failures {
        print_error!("{failure}");
    }
    out.account().failed(failures.len());
    Ok(out.account().verdict()?)
}

fn print_encounters(rows: &[StressEncounterRow]) {
    let header = [
        "method",
        "case",
        "beta",
        "dx",
        "min gap [a]",
        "excess [mu a^3]",
        "mean [mu a^2 V_s]",
        "growth",
        "efficiency",
        "lone",
        "budget",
    ];
    print_rows(
        &header,
        rows.iter().map(|row| {
            vec![
                row.method.to_string(),
                row.case.clone(),
                written(row.beta),
                written(row.dx),
                rounded(row.min_gap, 4),
                rounded(row.excess(), 3),
                rounded(row.mean(), 3),
                rounded(row.growth, 2),
                rounded(row.efficiency, 4),
                rounded(row.lone_efficiency, 4),
                size(row.budget),
            ]
        }),
    );
}
