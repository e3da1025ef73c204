//! The arguments that several commands share.

use std::path::PathBuf;

use clap::Args;

use crate::error::CommandError;
use compare::numbers::{Numbers, parse_number, parse_numbers, parse_whole};
use compare::output::OutputFolder;
use compare::submission::{ANSWER_LIMIT, Submitted};
use compare::{CompareError, Method, ModelOptions};

/// What every command takes.
#[derive(Debug, Args)]
pub(crate) struct GeneralArguments {
    /// Folder for results
    #[arg(long, global = true, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Delete the results of an interrupted sweep in the folder instead of continuing the sweep
    #[arg(long, global = true)]
    pub fresh: bool,
    /// Threads to use [default: all]
    #[arg(long, global = true, value_name = "N", value_parser = parse_whole, allow_hyphen_values = true)]
    pub threads: Option<usize>,
    /// Folder that keeps tables for the next run [default: the user's cache folder]
    #[arg(long, global = true, value_name = "DIR")]
    pub cache: Option<PathBuf>,
}

impl GeneralArguments {
    /// The options of models, with the cache that the user names, if any.
    pub(crate) fn model_options(&self) -> ModelOptions {
        let options = ModelOptions::default();
        match &self.cache {
            Some(_) => ModelOptions {
                cache: self.cache.clone(),
                ..options
            },
            None => options,
        }
    }

    /// Opens the folder for results and locks it against other commands.
    pub(crate) fn output(&self) -> Result<OutputFolder, CommandError> {
        Ok(OutputFolder::open(&self.out)?.fresh(self.fresh))
    }
}

#[derive(Debug, Args)]
pub(crate) struct EncounterArguments {
    /// Squirmer parameters B2/B1 [default: the paper's]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    pub beta: Option<Numbers>,
    /// Offsets of the paths [default: the paper's]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    pub dx: Option<Numbers>,
    /// Offsets out of the plane: squirmer 1 starts at z = dz/2, squirmer 2 at z = -dz/2 [default: 0]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    pub dz: Option<Numbers>,
    #[command(flatten)]
    pub models: ModelArguments,
    #[command(flatten)]
    pub runs: RunArguments,
}

/// The help of `--method` with these defaults.
pub(crate) fn methods_help(default: &str) -> String {
    format!(
        "Methods: lt (as published), lt-corrected, exact, bem, NAME=FILE for a model whose answers are in a file, and \
         NAME=exec:COMMAND for a process that answers (docs/JUDGE.md) [default: {default}]"
    )
}

#[derive(Debug, Args)]
pub(crate) struct ModelArguments {
    #[arg(long, value_name = "LIST", value_parser = parse_methods, help = methods_help("lt,exact,bem"))]
    pub method: Option<Methods>,
    /// Level of the mesh of boundary elements
    #[arg(long, value_name = "N", value_parser = parse_level, allow_hyphen_values = true)]
    pub mesh: Option<usize>,
    /// Solve at every gap instead of reading from a table
    #[arg(long)]
    pub direct: bool,
}

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// Tolerance of the integrator
    #[arg(
        long,
        value_name = "TOL",
        default_value = "1e-8",
        value_parser = parse_number,
        allow_hyphen_values = true
    )]
    pub tol: f64,
    #[command(flatten)]
    pub limits: LimitArguments,
}

#[derive(Debug, Args)]
pub(crate) struct LimitArguments {
    /// Distance of the centres, in radii, at which outgoing angles are read: 12 as in the paper, or inf for the limit.
    /// If the pair parts further out, its angles are read there
    #[arg(
        long,
        value_name = "R|inf",
        default_value = "inf",
        value_parser = parse_number,
        allow_hyphen_values = true
    )]
    pub departure: f64,
    /// Begin no further run after this time. Runs that are left out are reported, and the same command continues
    /// (exit status 75)
    #[arg(long, value_name = "SECONDS", value_parser = parse_number, allow_hyphen_values = true)]
    pub time_limit: Option<f64>,
}

/// A list of methods: not empty, and without repeats.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Methods(pub Vec<Method>);

fn parse_level(text: &str) -> Result<usize, String> {
    let (lowest, highest) = bem::Bem::LEVELS;
    (text.trim().parse().ok())
        .filter(|level| (lowest..=highest).contains(level))
        .ok_or_else(|| format!("'{text}' is not a level: levels go from {lowest} to {highest}"))
}

fn parse_methods(text: &str) -> Result<Methods, String> {
    let mut methods = Vec::new();
    for item in text.split(',') {
        let method = match item.split_once('=') {
            Some((name, source)) => from_outside(name.trim(), source.trim())?,
            None => Method::named(item.trim()).ok_or_else(|| {
                let known: Vec<_> = Method::ALL.iter().map(|m| m.name()).collect();
                let known = known.join(", ");
                format!("'{item}' is not a method: use {known}, NAME=FILE for a model whose answers are in a file, or NAME=exec:COMMAND for a process")
            })?,
        };
        if methods.contains(&method) {
            return Err(format!(
                "'{}' is in the list twice: once is enough",
                method.name()
            ));
        }
        methods.push(method);
    }
    Ok(Methods(methods))
}

/// The model whose loads are in a file, or that a process answers for.
fn from_outside(name: &str, source: &str) -> Result<Method, String> {
    let submitted = Submitted::open(source, ANSWER_LIMIT).map_err(|error| error.to_string())?;
    submitted.register(name).map_err(|error| match error {
        CompareError::Input { value, allowed, .. } => {
            format!("'{value}' is not allowed: {allowed}")
        }
        other => other.to_string(),
    })
}
