//! `squirmers growth`: how offsets out of the plane grow, over the plane of initial directions, and bound states in three dimensions.

use clap::Args;

use super::maps::{SCATTER_BETA, checked_maps, percent};
use super::shared::list;
use crate::arguments::{GeneralArguments, ModelArguments, RunArguments};
use crate::error::CommandError;
use crate::figures::GrowthMap;
use crate::pictures;
use crate::streams::print_line;
use crate::terminal::print_rows;
use compare::numbers::{Numbers, parse_number, parse_numbers, parse_whole, rounded, written};
use compare::output::csv_text;
use compare::study::maps::{BoundRow, GrowthShares, Pair, bound_rows, growth_shares};

/// Offset out of the plane for which the shares are given, in radii.
pub(crate) const OFFSET: f64 = 0.1;

#[derive(Debug, Args)]
pub(crate) struct GrowthArguments {
    /// Squirmer parameters B2/B1 [default: the paper's]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    beta: Option<Numbers>,
    /// Points a side, evenly spaced from 0.01 to 1.99 in Delta and Sigma
    #[arg(
        long,
        value_name = "N",
        default_value_t = 40,
        value_parser = parse_whole,
        allow_hyphen_values = true
    )]
    grid: usize,
    /// Offset out of the plane for the shares, in radii: squirmer 1 starts at z = dz/2, squirmer 2 at z = -dz/2
    #[arg(long, value_name = "DZ", default_value_t = OFFSET, value_parser = parse_number, allow_hyphen_values = true)]
    offset: f64,
    #[command(flatten)]
    models: ModelArguments,
    #[command(flatten)]
    runs: RunArguments,
}

pub(super) fn run(
    arguments: &GrowthArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let offset = arguments.offset;
    if !(offset.is_finite() && offset > 0.0) {
        let allowed = "give a number of radii greater than 0";
        return Err(CommandError::input(
            "--offset",
            format!("{offset:?}"),
            allowed,
        ));
    }
    let betas = list(&arguments.beta, &SCATTER_BETA);
    let in_plane = |&beta: &f64| Pair {
        beta,
        g: 0.0,
        dz: 0.0,
    };
    let pairs = betas.iter().map(in_plane).collect();
    let given = (&arguments.models, &arguments.runs);
    let run = checked_maps(given, arguments.grid, pairs, general)?;
    let (mut shares, mut drawn) = (Vec::new(), Vec::new());
    let complete =
        (run.maps("growth", None)).growth::<CommandError>(&mut |model, pair, rows| {
            shares.push(growth_shares(model, pair, &rows, offset));
            drawn.push(GrowthMap::new(&rows, offset)?);
            Ok(())
        })?;
    if !complete {
        return Ok(run.out.account().verdict()?);
    }
    run.out.write("growth-shares.csv", &csv_text(&shares)?)?;
    if let Some(picture) = pictures::of_growth(&drawn, offset)? {
        run.out.write(&picture.file_name, &picture.svg)?;
    }
    let models: Vec<_> = run.models.iter().collect();
    let states = bound_rows(&models, &betas)?;
    run.out.write("bound-states.csv", &csv_text(&states)?)?;
    print_shares(&shares);
    print_line!("");
    print_states(&states);
    Ok(run.out.account().verdict()?)
}

/// Shares in per cent. Growth is in radians per radius, the exponent in `V_s/a`.
fn print_shares(shares: &[GrowthShares]) {
    let header = [
        "method",
        "beta",
        "parts %",
        "fiction %",
        "stays %",
        "fiction %",
        "undef %",
        "median",
        "largest",
        "exponent",
    ];
    let line = |row: &GrowthShares| {
        vec![
            row.method.to_string(),
            written(row.beta),
            percent(row.parting),
            percent(row.parting_fiction),
            percent(row.staying),
            percent(row.staying_fiction),
            percent(row.undefined),
            rounded(row.median_growth, 3),
            rounded(row.largest_growth, 3),
            rounded(row.largest_exponent, 3),
        ]
    };
    print_rows(&header, shares.iter().map(line));
}

/// Bound states with their largest growth rates in and out of the plane, in `V_s/a`.
fn print_states(states: &[BoundRow]) {
    let header = [
        "method",
        "beta",
        "bound state",
        "gap [a]",
        "in plane",
        "off plane",
        "stable in plane",
        "in space",
    ];
    let line = |row: &BoundRow| {
        vec![
            row.method.to_string(),
            written(row.beta),
            row.outcome.clone(),
            rounded(row.gap, 3),
            rounded(row.growth, 3),
            rounded(row.growth_off_plane, 3),
            row.stable_in_plane.to_owned(),
            row.stable_in_space.to_owned(),
        ]
    };
    print_rows(&header, states.iter().map(line));
}
