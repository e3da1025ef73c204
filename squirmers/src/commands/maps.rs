//! `squirmers scatter`, `fates` and `trust`: maps over the plane of initial directions.

use clap::{Arg, Args};

use super::shared::{list, model_options, set_up, sweep_options};
use crate::arguments::{GeneralArguments, ModelArguments, RunArguments, methods_help};
use crate::error::CommandError;
use crate::pictures::{self, Picture};
use crate::streams::print_line;
use crate::terminal::print_rows;
use compare::numbers::{Numbers, parse_numbers, parse_whole, rounded, written};
use compare::output::{OutputFolder, csv_text};
use compare::study::maps::{self, BoundExample, FateRow, Grid, Maps, Pair, TrustShares};
use compare::sweep::SweepOptions;
use compare::{Method, Model};

/// The default methods of maps.
pub(crate) const METHODS: [Method; 2] = [Method::Lt, Method::Exact];

/// Arguments of the commands that map the plane of initial directions.
#[derive(Debug, Args)]
pub(crate) struct MapArguments {
    /// Squirmer parameters B2/B1 [default: the paper's]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    pub beta: Option<Numbers>,
    /// Bottom-heavinesses G_bh, with gravity along -y [default: 0]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    pub g: Option<Numbers>,
    /// Points a side, evenly spaced from 0.01 to 1.99 in Delta and Sigma. An even number avoids the singular lines
    /// Delta = 1 and Sigma = 1
    #[arg(
        long,
        value_name = "N",
        default_value_t = 100,
        value_parser = parse_whole,
        allow_hyphen_values = true
    )]
    pub grid: usize,
    #[command(flatten)]
    pub models: ModelArguments,
    #[command(flatten)]
    pub runs: RunArguments,
}

/// The argument `--method` of a map.
pub(crate) fn methods(arg: Arg) -> Arg {
    arg.help(methods_help("lt,exact"))
}

/// The argument `--tol` of a map.
pub(crate) fn tolerance(arg: Arg) -> Arg {
    arg.default_value("1e-7")
}

/// The argument `--time-limit` of a map.
pub(crate) fn time_limit(arg: Arg) -> Arg {
    arg.help(
        "Begin no further line of a map after this time; the same command continues later (exit status 75)",
    )
}

/// Arguments of `trust`.
#[derive(Debug, Args)]
pub(crate) struct TrustArguments {
    #[command(flatten)]
    map: MapArguments,
    /// Offsets out of the plane, in radii: squirmer 1 starts at z = dz/2, squirmer 2 at z = -dz/2
    /// [default: 0]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    dz: Option<Numbers>,
}

/// The checked arguments of a command that maps.
pub(super) struct Checked {
    pub(super) models: Vec<Model>,
    pub(super) pairs: Vec<Pair>,
    grid: Grid,
    sweep: SweepOptions,
    pub(super) out: OutputFolder,
}

impl Checked {
    /// The maps with the file name `name`. With `exact`, the models are compared with the exact one.
    pub(super) fn maps<'a>(&'a self, name: &'static str, exact: Option<&'a Model>) -> Maps<'a> {
        Maps {
            name,
            models: self.models.iter().collect(),
            exact,
            pairs: self.pairs.clone(),
            grid: self.grid,
            options: self.sweep,
            out: &self.out,
        }
    }
}

fn checked(
    arguments: &MapArguments,
    beta: &[f64],
    dz: &Option<Numbers>,
    general: &GeneralArguments,
) -> Result<Checked, CommandError> {
    let g = list(&arguments.g, &[0.0]);
    let dz = list(dz, &[0.0]);
    let mut pairs = Vec::new();
    for beta in list(&arguments.beta, beta) {
        for &g in &g {
            pairs.extend(dz.iter().map(|&dz| Pair { beta, g, dz }));
        }
    }
    checked_maps(
        (&arguments.models, &arguments.runs),
        arguments.grid,
        pairs,
        general,
    )
}

/// The maps of these pairs.
pub(super) fn checked_maps(
    (models, runs): (&ModelArguments, &RunArguments),
    grid: usize,
    pairs: Vec<Pair>,
    general: &GeneralArguments,
) -> Result<Checked, CommandError> {
    let (methods, options) = model_options(models, &METHODS, general)?;
    let sweep = sweep_options(runs, &methods)?;
    let grid = Grid::new(grid)?;
    let out = general.output()?;
    let options = options.for_scenes(maps::unsymmetric_starts(&pairs))?;
    Ok(Checked {
        models: set_up(&methods, &options)?,
        pairs,
        grid,
        sweep,
        out,
    })
}

/// Squirmer parameters of the paper's Figs 2-4.
pub(crate) const SCATTER_BETA: [f64; 5] = [0.0, 1.0, 5.0, -1.0, -5.0];

pub(super) fn scatter(
    arguments: &MapArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let run = checked(arguments, &SCATTER_BETA, &None, general)?;
    let mut shares = Vec::new();
    run.maps("scatter", None)
        .scatter(&mut |model, pair, rows| {
            shares.push(maps::fates_of(model, pair, &rows));
            write_pictures(pictures::of_scatter(&rows)?, &run.out)
        })?;
    if !shares.is_empty() {
        print_fates(&shares);
    }
    Ok(run.out.account().verdict()?)
}

pub(super) fn fates(
    arguments: &MapArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let beta: Vec<f64> = (-10..=10).map(f64::from).collect();
    let run = checked(arguments, &beta, &None, general)?;
    let Some(rows) = run.maps("fates", None).fates()? else {
        return Ok(run.out.account().verdict()?);
    };
    run.out.write("fates.csv", &csv_text(&rows)?)?;
    write_pictures(pictures::of_fates(&rows)?, &run.out)?;
    print_fates(&rows);
    Ok(run.out.account().verdict()?)
}

pub(super) fn trust(
    arguments: &TrustArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let mut run = checked(&arguments.map, &SCATTER_BETA, &arguments.dz, general)?;
    let exact = run.models.iter().position(|m| m.method() == Method::Exact);
    let exact = exact.map(|place| run.models.remove(place));
    if run.models.is_empty() {
        let allowed = "also name a method to compare with it, such as lt,exact";
        return Err(CommandError::input("--method", "exact", allowed));
    }
    let all: Vec<&Model> = run.models.iter().chain(&exact).collect();
    let mut betas: Vec<f64> = run.pairs.iter().map(|pair| pair.beta).collect();
    betas.dedup();
    let (mut shares, mut examples) = (Vec::new(), Vec::new());
    let mut states = Vec::new();
    let maps = run.maps("trust", exact.as_ref());
    let complete = maps.trust(true, &mut |_, pair, rows| {
        if shares.is_empty() {
            states = maps::bound_rows(&all, &betas)?;
        }
        shares.extend(maps::trust_shares(&rows));
        if pair.g == 0.0 && pair.dz == 0.0 {
            examples.extend(maps::bound_examples(&rows, &states));
        }
        write_pictures(pictures::of_trust(&rows)?, &run.out)
    })?;
    if !complete {
        return Ok(run.out.account().verdict()?);
    }
    write_pictures(pictures::of_trust_against_offset(&shares)?, &run.out)?;
    print_trust(&shares);
    run.out.write("bound-states.csv", &csv_text(&states)?)?;
    run.out.write("trust-examples.csv", &csv_text(&examples)?)?;
    print_line!("");
    print_examples(&examples);
    Ok(run.out.account().verdict()?)
}

/// Prints the bound states that one model has and the other does not have. Growth rates are only in the file, because
/// the table would be too wide.
fn print_examples(examples: &[BoundExample]) {
    let header = [
        "method",
        "beta",
        "outcome",
        "exact",
        "%",
        "Delta",
        "Sigma",
        "in other model",
        "gap [a]",
    ];
    let line = |row: &BoundExample| {
        vec![
            row.method.to_string(),
            written(row.beta),
            row.outcome_lt.clone(),
            row.outcome_exact.clone(),
            percent(row.share),
            rounded(row.delta, 3),
            rounded(row.sigma, 3),
            row.state.to_owned(),
            rounded(row.gap, 3),
        ]
    };
    print_rows(&header, examples.iter().map(line));
}

fn write_pictures(pictures: Vec<Picture>, out: &OutputFolder) -> Result<(), CommandError> {
    for picture in pictures {
        out.write(&picture.file_name, &picture.svg)?;
    }
    Ok(())
}

pub(super) fn percent(share: f64) -> String {
    format!("{:.2}", 100.0 * share)
}

/// Shares of the outcomes that occur, in per cent.
fn print_fates(rows: &[FateRow]) {
    let occur: Vec<_> = (FateRow::SHARES.into_iter())
        .filter(|(_, share)| rows.iter().any(|row| share(row) > 0.0))
        .collect();
    let header = ["%", "beta", "g"].into_iter();
    let header: Vec<_> = header.chain(occur.iter().map(|(name, _)| *name)).collect();
    let line = |row: &FateRow| {
        let place = [row.method.to_string(), written(row.beta), written(row.g)];
        let shares = occur.iter().map(|(_, share)| percent(share(row)));
        place.into_iter().chain(shares).collect()
    };
    print_rows(&header, rows.iter().map(line));
}

fn print_trust(shares: &[TrustShares]) {
    let mut header = vec!["%", "beta", "g", "dz"];
    header.extend(maps::TRUST_CLASSES);
    let line = |row: &TrustShares| {
        let numbers = [row.beta, row.g, row.dz].map(written);
        let mut line = vec![row.method.to_string()];
        line.extend(numbers);
        line.extend(row.in_order().map(percent));
        line
    };
    print_rows(&header, shares.iter().map(line));
}
