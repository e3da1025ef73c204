//! `squirmers head-on`, `orthogonal` and `offset`: the paper's encounters, with and without an offset out of the plane.

use compare::numbers::{Numbers, rounded, written};
use compare::study::encounters::{Drawn, EncounterSweep};
use compare::{Approach, Case, Defaults, EncounterRow, Method};

use super::many::{PRINTED, checked_count, drop_undrawn, keep_first, print_rest, print_undrawn};
use super::shared::{list, model_options, set_up, sweep_options};
use crate::arguments::{EncounterArguments, GeneralArguments, ModelArguments, RunArguments};
use crate::error::CommandError;
use crate::pictures;
use crate::terminal::print_rows;

pub(super) fn encounters(
    approach: Approach,
    arguments: &EncounterArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(&arguments.models, &Method::DEFAULT, general)?;
    let sweep = sweep_options(&arguments.runs, &methods)?;
    let defaults = Defaults::paper()?;
    let defaults = defaults.encounters(approach);
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
    let kept = EncounterSweep {
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
    print_undrawn(drawn, runs);
    Ok(out.account().verdict()?)
}

/// All combinations. Checks that the spheres do not overlap at the start.
pub(crate) fn cases(
    approach: Approach,
    beta: &[f64],
    dx: &[f64],
    dz: &[f64],
) -> Result<Vec<Case>, CommandError> {
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
                    CommandError::input("--dx", value, error.in_one_line())
                })?;
                cases.push(case);
            }
        }
    }
    Ok(cases)
}

pub(super) fn offset(
    dz: Option<&Numbers>,
    models: &ModelArguments,
    runs: &RunArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(models, &Method::DEFAULT, general)?;
    let sweep = sweep_options(runs, &methods)?;
    let defaults = Defaults::paper()?.offset;
    let dz = dz.map_or(defaults.dz.clone(), |dz| dz.0.clone());
    let out = general.output()?;
    let all = compare::with_offsets(&defaults.cases(), &dz);
    let options = options.for_scenes(all.iter().map(Case::scene))?;
    let models = set_up(&methods, &options)?;
    let runs = models.len() * all.len();
    let kept = EncounterSweep {
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
                row.method.to_string(),
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
        print_undrawn(drawn, runs);
    }
    Ok(out.account().verdict()?)
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
                row.method.to_string(),
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
