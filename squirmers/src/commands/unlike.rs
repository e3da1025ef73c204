//! `squirmers ratios` and `cargo`: squirmers of unlike radii, and a swimmer that moves a passive sphere.

use clap::Args;

use super::many::{PRINTED, checked_count, keep_first, print_rest};
use super::shared::{checked_ratios, list, model_options, set_up, sweep_options};
use crate::arguments::{GeneralArguments, ModelArguments, RunArguments};
use crate::error::CommandError;
use crate::pictures;
use crate::terminal::print_rows;
use compare::numbers::{Numbers, parse_numbers, parse_whole, rounded, written};
use compare::output::csv_text;
use compare::study::cargo::{Cargo, CargoRow, CargoSweep};
use compare::study::maps::Grid;
use compare::study::ratios::{RatioRow, Ratios, UnlikePair};
use compare::{Method, Model};

/// Ratios of the radii that are run by default.
pub(crate) const RATIOS: [f64; 5] = [0.2, 0.5, 1.0, 2.0, 5.0];

/// Squirmer parameters of the pairs of [`RATIOS`].
pub(crate) const BETA: [f64; 3] = [5.0, -5.0, 1.0];

/// Points a side of the grid of incoming angles.
pub(crate) const GRID: usize = 40;

#[derive(Debug, Args)]
pub(crate) struct RatioArguments {
    /// Radii of the second squirmer over that of the first, from 0.01 to 100 [default: 0.2,0.5,1,2,5]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    ratio: Option<Numbers>,
    /// Squirmer parameters B2/B1 of the first squirmer [default: 5,-5,1]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    beta: Option<Numbers>,
    /// Squirmer parameters B2/B1 of the second squirmer [default: that of the first]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    beta2: Option<Numbers>,
    /// Points a side, evenly spaced from 0.01 to 1.99 in Delta and Sigma
    #[arg(
        long,
        value_name = "N",
        default_value_t = GRID,
        value_parser = parse_whole,
        allow_hyphen_values = true
    )]
    grid: usize,
    #[command(flatten)]
    models: ModelArguments,
    #[command(flatten)]
    runs: RunArguments,
}

pub(super) fn ratios(
    arguments: &RatioArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(&arguments.models, &super::maps::METHODS, general)?;
    let options_of_runs = sweep_options(&arguments.runs, &methods)?;
    let grid = Grid::new(arguments.grid)?;
    let ratios = checked_ratios(list(&arguments.ratio, &RATIOS))?;
    let mut pairs = Vec::new();
    for beta1 in list(&arguments.beta, &BETA) {
        for beta2 in list(&arguments.beta2, &[beta1]) {
            let of = |ratio| UnlikePair {
                beta: [beta1, beta2],
                ratio,
            };
            pairs.extend(ratios.iter().copied().map(of));
        }
    }
    let options = Ratios::options_of(&pairs, options)?;
    let refused = || {
        let named: Vec<_> = methods.iter().map(|method| method.name()).collect();
        let allowed = "name exact and the methods to compare with it, such as lt,exact";
        CommandError::input("--method", named.join(","), allowed)
    };
    if methods.len() < 2 || !methods.contains(&Method::Exact) {
        return Err(refused());
    }
    let out = general.output()?;
    let models = set_up(&methods, &options)?;
    let is_exact = |model: &&Model| model.method() == Method::Exact;
    let maps = Ratios {
        judged: models.iter().filter(|model| !is_exact(model)).collect(),
        exact: models.iter().find(is_exact).ok_or_else(refused)?,
        pairs: &pairs,
        grid,
        options: options_of_runs,
        out: &out,
    };
    let Some(rows) = maps.rows()? else {
        return Ok(out.account().verdict()?);
    };
    out.write("ratios.csv", &csv_text(&rows)?)?;
    for picture in pictures::of_ratios(&rows)? {
        out.write(&picture.file_name, &picture.svg)?;
    }
    print_ratios(&rows);
    Ok(out.account().verdict()?)
}

fn print_ratios(rows: &[RatioRow]) {
    let header = [
        "%", "beta", "beta2", "ratio", "bound", "exact", "<= 5", "<= 15", "<= 45", "> 45", "other",
    ];
    let percent = |share: f64| format!("{:.2}", 100.0 * share);
    print_rows(
        &header,
        rows.iter().map(|row| {
            let bound = |exact: bool| {
                let [_, standoff, pairwise, orbiting, _] = row.outcomes(exact);
                standoff + pairwise + orbiting
            };
            let shares = [
                bound(false),
                bound(true),
                row.within_5_deg,
                row.within_15_deg,
                row.within_45_deg,
                row.beyond_45_deg,
                row.other_outcome,
            ];
            let numbers = [row.beta1, row.beta2, row.ratio].map(written);
            let mut line = vec![row.method.to_string()];
            line.extend(numbers);
            line.extend(shares.map(percent));
            line
        }),
    );
}

/// Offsets of the path, in radii of the swimmer, that are run by default; beyond contact they grow with the cargo.
pub(crate) const OFFSETS: [f64; 12] =
    [0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0];

/// Squirmer parameters of the swimmer.
pub(crate) const SWIMMERS: [f64; 3] = [0.0, 5.0, -5.0];

/// Distance of the centres at start and end, in radii of the larger sphere.
pub(crate) const FAR: f64 = 60.0;

#[derive(Debug, Args)]
pub(crate) struct CargoArguments {
    /// Squirmer parameters B2/B1 of the swimmer [default: 0,5,-5]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    beta: Option<Numbers>,
    /// Radii of the cargo over that of the swimmer, from 0.01 to 100 [default: 0.2,0.5,1,2,5]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    ratio: Option<Numbers>,
    /// Offsets of the swimmer's path from the centre of the cargo, in radii of the swimmer [default: twelve from 0.1 to 7]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    b: Option<Numbers>,
    /// Distance of the centres at start and end, in radii of the larger sphere
    #[arg(long, value_name = "R", default_value_t = FAR)]
    far: f64,
    #[command(flatten)]
    models: ModelArguments,
    #[command(flatten)]
    runs: RunArguments,
}

/// All swimmers with all cargoes at all offsets.
pub(crate) fn cargoes(beta: &[f64], ratio: &[f64], b: &[f64], far: f64) -> Vec<Cargo> {
    let mut all = Vec::new();
    for &beta in beta {
        for &ratio in ratio {
            all.extend(b.iter().map(|&b| Cargo {
                beta,
                ratio,
                b,
                far,
            }));
        }
    }
    all
}

pub(super) fn cargo(
    arguments: &CargoArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(&arguments.models, &Method::DEFAULT, general)?;
    let sweep = sweep_options(&arguments.runs, &methods)?;
    let beta = list(&arguments.beta, &SWIMMERS);
    let ratio = checked_ratios(list(&arguments.ratio, &RATIOS))?;
    let b = list(&arguments.b, &OFFSETS);
    checked_count(&beta, &ratio, &b)?;
    let cargoes = cargoes(&beta, &ratio, &b, arguments.far);
    for cargo in &cargoes {
        cargo.scene().map_err(|error| {
            let value = format!(
                "{:?} with --ratio {:?} and --far {:?}",
                cargo.b, cargo.ratio, cargo.far
            );
            CommandError::input("--b", value, error.in_one_line())
        })?;
    }
    let out = general.output()?;
    let options = options.for_scenes(cargoes.iter().map(Cargo::scene))?;
    let models = set_up(&methods, &options)?;
    let runs = models.len() * cargoes.len();
    let sweep = CargoSweep {
        models: &models,
        cargoes: &cargoes,
        options: sweep,
        out: &out,
    };
    let (mut first, mut drawn) = (Vec::new(), Vec::new());
    let complete = sweep.run(&mut |row| {
        if runs <= MOST_DRAWN {
            drawn.push(row.clone());
        }
        keep_first(&mut first, row);
    })?;
    if complete {
        for picture in pictures::of_cargo(&drawn)? {
            out.write(&picture.file_name, &picture.svg)?;
        }
    }
    print_cargo(&first);
    print_rest(runs, "cargo");
    if runs > MOST_DRAWN {
        crate::streams::print_line!("no picture: it shows at most {MOST_DRAWN} runs");
    }
    Ok(out.account().verdict()?)
}

/// Largest number of runs in pictures.
const MOST_DRAWN: usize = 5000;

fn print_cargo(rows: &[CargoRow]) {
    let header = [
        "method",
        "beta",
        "ratio",
        "b",
        "along [a]",
        "across [a]",
        "min gap [a]",
        "tau [a/V_s]",
        "outcome",
    ];
    print_rows(
        &header,
        rows.iter().take(PRINTED).map(|row| {
            vec![
                row.method.to_string(),
                written(row.beta),
                written(row.ratio),
                written(row.b),
                rounded(row.along, 4),
                rounded(row.across, 4),
                rounded(row.min_gap, 5),
                rounded(row.tau, 3),
                row.outcome.clone(),
            ]
        }),
    );
}
