//! `squirmers sweep` and `squirmers merge`: sweeps of families along their parameters, on one machine or several.

use std::path::PathBuf;

use clap::{Arg, Args};
use compare::numbers::{Numbers, parse_number, parse_numbers, rounded, written};
use compare::sweep::{self, FamilySweep, Points, RunChoices, Share, SweepRow, checked_tolerance};
use compare::{CompareError, Family, ModelOptions};

use super::many::{keep_first, print_rest};
use super::maps::METHODS;
use super::shared::{checked_limits, model_options, set_up};
use crate::arguments::{GeneralArguments, LimitArguments, ModelArguments, methods_help};
use crate::error::CommandError;
use crate::streams::{print_error, print_line};
use crate::terminal::print_rows;

#[derive(Debug, Args)]
pub(crate) struct SweepArguments {
    /// Scene file with parameters (docs/SCENES.md), or one of the paper's: opposed, right-angles, incoming-angles
    #[arg(value_name = "FAMILY")]
    family: String,
    /// A parameter and its values. Repeat the option for more parameters; the last one varies fastest
    #[arg(long, value_name = "NAME=LIST", value_parser = parse_vary, allow_hyphen_values = true)]
    vary: Vec<(String, Numbers)>,
    /// Run only share m of n; 'squirmers merge' merges the shares
    #[arg(long, value_name = "m/n")]
    partition: Option<Share>,
    /// Tolerance of the integrator [default: the family's]
    #[arg(long, value_name = "TOL", value_parser = parse_number, allow_hyphen_values = true)]
    tol: Option<f64>,
    #[command(flatten)]
    models: ModelArguments,
    #[command(flatten)]
    limits: LimitArguments,
}

#[derive(Debug, Args)]
pub(crate) struct MergeArguments {
    /// Folders of the shares, in any order
    #[arg(value_name = "DIR", required = true)]
    shares: Vec<PathBuf>,
}

/// The argument `--method` of a sweep.
pub(crate) fn methods(arg: Arg) -> Arg {
    arg.help(methods_help("the family's, or else lt,exact"))
}

/// The argument `--time-limit` of a sweep.
pub(crate) fn time_limit(arg: Arg) -> Arg {
    arg.help(
        "Begin no further part of the sweep after this time; the same command continues later (exit status 75)",
    )
}

pub(super) fn parse_vary(text: &str) -> Result<(String, Numbers), String> {
    let (name, list) = (text.split_once('='))
        .ok_or_else(|| format!("'{text}' has no values: give NAME=LIST, such as dx=0:3:0.5"))?;
    Ok((name.trim().to_owned(), parse_numbers(list)?))
}

/// The family: one of the paper's by its name, or else from a file.
pub(super) fn family(named: &str) -> Result<Family, CommandError> {
    if let Some(family) = Family::named(named) {
        return Ok(family.clone());
    }
    let path = PathBuf::from(named);
    let text = super::scene::text(&path)?;
    let parsed = Family::parse(&text);
    Ok(parsed.map_err(|mistakes| CompareError::SceneFile { path, mistakes })?)
}

pub(super) fn run(
    arguments: &SweepArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (mut methods, mut options) = model_options(&arguments.models, &METHODS, general)?;
    let (angles_at, time_limit) = checked_limits(&arguments.limits, &methods)?;
    let tolerance = arguments.tol.map(checked_tolerance).transpose()?;
    let family = family(&arguments.family)?;
    if let (None, Some(own)) = (&arguments.models.method, family.hydrodynamics()) {
        methods = vec![own.method];
        options = ModelOptions {
            mesh: own.mesh,
            direct: own.direct || options.direct,
            ..options
        };
    }
    let choices = RunChoices {
        tolerance,
        angles_at,
    };
    let points = Points::new(family, &arguments.vary, choices)?;
    let out = general.output()?;
    let reads = points.reads()?;
    let loads = reads.loads;
    let options = options.for_reads(reads);
    let models = set_up(&methods, &options)?;
    let sweep = FamilySweep {
        points: &points,
        models: &models,
        loads,
        share: arguments.partition.unwrap_or(Share::ALL),
        time_limit,
        out: &out,
    };
    let mut first = Vec::new();
    let done = sweep.run(&mut |row| keep_first(&mut first, row))?;
    print_rows(
        &sweep.header(),
        first.iter().map(|row| printed(row, points.axes().len())),
    );
    print_rest(done.rows, "sweep");
    Ok(out.account().verdict()?)
}

/// A row for the printed table; the first `parameters` fields are values of parameters.
fn printed(row: &SweepRow, parameters: usize) -> Vec<String> {
    let field = |(place, text): (usize, &String)| match text.parse::<f64>() {
        Ok(value) if place < parameters => written(value),
        Ok(value) if text.contains(['.', 'N']) => rounded(value, 4),
        _ => text.clone(),
    };
    row.0.iter().enumerate().map(field).collect()
}

pub(super) fn merge(
    arguments: &MergeArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let out = general.output()?;
    let merged = sweep::merge(&arguments.shares, &out)?;
    if merged.arithmetic.len() > 1 {
        print_error!(
            "the shares come from {} kinds of arithmetic: last digits may differ from those of one machine \
             (sweep.json names them)",
            merged.arithmetic.len()
        );
    }
    print_line!(
        "{} rows of {} shares in {}",
        merged.rows,
        merged.shares,
        general.out.join(&merged.file).display()
    );
    Ok(())
}
