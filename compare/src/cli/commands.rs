//! The commands, from checked arguments to files.

use std::time::Duration;

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, Table, Width, presets};
use scene::{LoadSet, MAX_MODES, RunOptions};

use super::args::{Arguments, Command, EncounterArguments, ModelArguments, RunArguments};
use super::many::{PRINTED, checked_count, drop_undrawn, keep_first, print_rest, say_undrawn};
use super::maps;
use crate::kept_rows::{Drawn, KeptRows};
use crate::numbers::{Numbers, rounded, written};
use crate::scene_file::SAMPLE_INTERVAL;
use crate::streams::say;
use crate::sweep::SweepOptions;
use crate::{
    Approach, Case, CompareError, Defaults, Encounter, EncounterRow, Method, Model, ModelOptions,
    NoRun,
};
use crate::{full_report, pictures, sweep};

pub(super) fn run(arguments: &Arguments, typed: &[String]) -> Result<(), CompareError> {
    match &arguments.command {
        Command::Loads {
            gap,
            modes,
            swirl,
            models,
        } => {
            let set = LoadSet::all(highest("--modes", *modes)?);
            let set = set.with_swirl(highest("--swirl", *swirl)?);
            super::loads::run(gap, set, models, arguments)
        }
        Command::HeadOn(encounters) => encounter(Approach::HeadOn, encounters, arguments),
        Command::Orthogonal(encounters) => encounter(Approach::Orthogonal, encounters, arguments),
        Command::Offset { dz, models, runs } => offset(dz.as_ref(), models, runs, arguments),
        Command::Cost(cost) => super::cost::run(cost, arguments, typed),
        Command::Scatter(map) => maps::scatter(map, arguments),
        Command::Fates(map) => maps::fates(map, arguments),
        Command::BottomHeavy { models, runs } => super::bottom_heavy::run(models, runs, arguments),
        Command::HardCases => super::hard_cases::run(arguments),
        Command::Trust(map) => maps::trust(map, arguments),
        Command::Run(run) => super::scene::run(run, arguments),
        Command::Explain(explain) => super::scene::explain(explain, arguments),
        Command::Report { models, runs } => {
            let (methods, options) = model_options(models, &Method::DEFAULT, arguments)?;
            let sweep = sweep_options(runs)?;
            let out = arguments.output()?;
            let path = full_report::write(&methods, &options, &sweep, &out, typed)?;
            say!("{}", path.display());
            out.account().verdict()
        }
    }
}

/// Checks the methods, `default` if none are named, and what they need.
pub(super) fn model_options(
    arguments: &ModelArguments,
    default: &[Method],
    general: &Arguments,
) -> Result<(Vec<Method>, ModelOptions), CompareError> {
    let methods = (arguments.method.as_ref()).map_or(default.to_vec(), |m| m.0.clone());
    let mut options = ModelOptions {
        direct: arguments.direct,
        ..ModelOptions::default()
    };
    if let Some(cache) = &general.cache {
        options.cache = Some(cache.clone());
    }
    if let Some(mesh) = arguments.mesh {
        if !methods.contains(&Method::Bem) {
            let allowed = "no boundary elements run: leave it out, or name bem with --method";
            return Err(CompareError::input("--mesh", mesh, allowed));
        }
        options.mesh = mesh;
    }
    Ok((methods, options))
}

pub(super) fn set_up(
    methods: &[Method],
    options: &ModelOptions,
) -> Result<Vec<Model>, CompareError> {
    (methods.iter())
        .map(|&method| Model::set_up(method, options))
        .collect()
}

pub(super) fn sweep_options(runs: &RunArguments) -> Result<SweepOptions, CompareError> {
    let (tolerance, angles_at) = (runs.tol, runs.departure);
    if !(1e-14..=1e-2).contains(&tolerance) {
        let allowed = "give a number from 1e-14 to 1e-2";
        return Err(CompareError::input(
            "--tol",
            format!("{tolerance:?}"),
            allowed,
        ));
    }
    if angles_at.is_nan() || angles_at <= 2.0 {
        let allowed = "give a distance of the centres greater than 2 (radii), or inf";
        return Err(CompareError::input(
            "--departure",
            format!("{angles_at:?}"),
            allowed,
        ));
    }
    let time_limit = match runs.time_limit {
        None => None,
        Some(seconds) => Some(Duration::try_from_secs_f64(seconds).map_err(|_| {
            CompareError::input(
                "--time-limit",
                seconds,
                "give a number of seconds, 0 or more",
            )
        })?),
    };
    Ok(SweepOptions {
        run: RunOptions {
            tolerance,
            angles_at,
            sample_interval: Some(SAMPLE_INTERVAL),
            ..RunOptions::default()
        },
        time_limit,
    })
}

/// A highest slip mode, if loads can hold so many.
fn highest(what: &'static str, modes: usize) -> Result<usize, CompareError> {
    if modes > MAX_MODES {
        let allowed = format!("modes go from 0 (none) to {MAX_MODES}");
        return Err(CompareError::input(what, modes, allowed));
    }
    Ok(modes)
}

fn encounter(
    approach: Approach,
    arguments: &EncounterArguments,
    general: &Arguments,
) -> Result<(), CompareError> {
    let (methods, options) = model_options(&arguments.models, &Method::DEFAULT, general)?;
    let sweep = sweep_options(&arguments.runs)?;
    let defaults = Defaults::paper()?;
    let defaults = defaults.encounters(approach);
    let list = |given: &Option<Numbers>, default: &[f64]| {
        given
            .as_ref()
            .map_or(default.to_vec(), |list| list.0.clone())
    };
    let cases = cases(
        approach,
        &list(&arguments.beta, &defaults.beta),
        &list(&arguments.dx, &defaults.dx),
        &list(&arguments.dz, &defaults.dz),
    )?;
    let out = general.output()?;
    let options = options.for_scenes(cases.iter().map(Case::scene))?;
    let models = set_up(&methods, &options)?;
    let runs = models.len() * cases.len();
    let kept = KeptRows {
        name: &approach.to_string(),
        models: &models,
        cases: &cases,
        options: &sweep,
        out: &out,
    };
    let (mut first, drawn) = (Vec::new(), kept.drawn());
    let encounters = kept.encounters(drawn, &mut |row| keep_first(&mut first, row))?;
    for picture in pictures::of_encounters(approach, &encounters, drawn)? {
        out.write(&picture.file_name, &picture.svg)?;
    }
    if !out.account().stopped() {
        drop_undrawn(drawn, approach, &out)?;
    }
    print_encounters(&first);
    print_rest(runs, approach);
    say_undrawn(drawn, runs);
    out.account().verdict()
}

/// All combinations, with the spheres checked not to overlap at the start.
pub(crate) fn cases(
    approach: Approach,
    beta: &[f64],
    dx: &[f64],
    dz: &[f64],
) -> Result<Vec<Case>, CompareError> {
    let count = checked_count(beta, dx, dz)?;
    let mut cases = Vec::with_capacity(count);
    for &beta in beta {
        for &dx in dx {
            for &dz in dz {
                let case = Case {
                    approach,
                    beta,
                    dx,
                    dz,
                };
                case.scene().map_err(|error| {
                    let value = format!("{dx:?} with --dz {dz:?} and --beta {beta:?}");
                    CompareError::input("--dx", value, error.to_string())
                })?;
                cases.push(case);
            }
        }
    }
    Ok(cases)
}

fn offset(
    dz: Option<&Numbers>,
    models: &ModelArguments,
    runs: &RunArguments,
    general: &Arguments,
) -> Result<(), CompareError> {
    let (methods, options) = model_options(models, &Method::DEFAULT, general)?;
    let sweep = sweep_options(runs)?;
    let defaults = Defaults::paper()?.offset;
    let dz = dz.map_or(defaults.dz.clone(), |dz| dz.0.clone());
    let out = general.output()?;
    let all = sweep::with_offsets(&defaults.cases(), &dz);
    let options = options.for_scenes(all.iter().map(Case::scene))?;
    let models = set_up(&methods, &options)?;
    let runs = models.len() * all.len();
    let kept = KeptRows {
        name: "offset",
        models: &models,
        cases: &all,
        options: &sweep,
        out: &out,
    };
    let mut rows = Vec::new();
    let drawn = Drawn::without_paths(runs);
    let complete = kept.offsets(&dz, &mut |row| {
        if drawn != Drawn::Nothing || rows.len() < PRINTED {
            rows.push(row);
        }
    })?;
    if complete
        && drawn != Drawn::Nothing
        && let Some(picture) = pictures::of_offsets(&rows)?
    {
        out.write(&picture.file_name, &picture.svg)?;
    }
    print_rows(
        &[
            "case",
            "method",
            "beta",
            "dx",
            "dz",
            "change 1 [deg]",
            "change 2 [deg]",
            "min gap [a]",
            "outcome",
        ],
        rows.iter().take(PRINTED).map(|row| {
            vec![
                row.case.clone(),
                row.method.to_owned(),
                written(row.beta),
                written(row.dx),
                written(row.dz),
                rounded(row.change1_deg, 5),
                rounded(row.change2_deg, 5),
                rounded(row.min_gap, 5),
                row.outcome.clone(),
            ]
        }),
    );
    print_rest(runs - runs / (1 + dz.len()), "offset");
    if drawn == Drawn::Nothing {
        say_undrawn(drawn, runs);
    }
    out.account().verdict()
}

fn print_encounters(rows: &[EncounterRow]) {
    let header = [
        "method",
        "beta",
        "dx",
        "dz",
        "turn 1 [deg]",
        "turn 2 [deg]",
        "min gap [a]",
        "tau [a/V_s]",
        "outcome",
    ];
    print_rows(
        &header,
        rows.iter().map(|row| {
            vec![
                row.method.to_owned(),
                written(row.beta),
                written(row.dx),
                written(row.dz),
                rounded(row.deflection1_deg, 4),
                rounded(row.deflection2_deg, 4),
                rounded(row.min_gap, 5),
                rounded(row.tau, 3),
                row.outcome.clone(),
            ]
        }),
    );
}

/// One line about a run without a result.
pub(crate) fn failure(encounter: &Encounter, reason: &NoRun) -> String {
    let Case {
        approach,
        beta,
        dx,
        dz,
    } = encounter.case;
    format!(
        "{approach}, {}, beta {}, dx {}, dz {}: {reason}",
        encounter.method,
        written(beta),
        written(dx),
        written(dz)
    )
}

/// Characters in a line of a terminal.
const TERMINAL: u16 = 80;

/// A table of words, which wrap before it is wider than a terminal.
pub(super) fn words(rows: impl Iterator<Item = Vec<String>>) -> Table {
    let mut table = Table::new();
    table
        .load_preset(presets::NOTHING)
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(TERMINAL);
    table.add_rows(rows);
    for column in table.column_iter_mut() {
        column.set_padding((0, 1));
    }
    table
}

pub(super) fn print_rows(header: &[&str], rows: impl Iterator<Item = Vec<String>>) {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING).set_header(header);
    // Headers wrap before a table is wider than a terminal; what is in it stays whole.
    table
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(TERMINAL);
    let rows: Vec<_> = rows.collect();
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<_> = (0..header.len()).map(width).collect();
    table.add_rows(rows);
    for (column, width) in table.column_iter_mut().zip(widths) {
        column.set_cell_alignment(CellAlignment::Right);
        column.set_padding((0, 1));
        let whole = Width::Fixed(u16::try_from(width + 1).unwrap_or(TERMINAL));
        column.set_constraint(ColumnConstraint::LowerBoundary(whole));
    }
    say!("{table}");
}
