//! `squirmers collisions` and `kinetics`: collisions in three dimensions, and what they do to a dilute suspension.

use clap::{Arg, Args, ValueEnum};

use super::maps::METHODS;
use super::shared::{list, model_options, set_up, sweep_options};
use crate::arguments::{GeneralArguments, ModelArguments, RunArguments, methods_help};
use crate::error::CommandError;
use crate::pictures;
use crate::streams::print_line;
use crate::terminal::print_rows;
use compare::Method;
use compare::numbers::{Numbers, parse_number, parse_numbers, parse_whole, rounded, written};
use compare::output::csv_text;
use compare::study::kinetics::{
    CONTACT, CollisionRow, CollisionSweep, KineticsRatioRow, KineticsRow, KineticsSweep, Sampling,
    Starts, ratios,
};
use compare::sweep::Share;

/// Squirmer parameters of a map.
const MAP_BETA: [f64; 3] = [-5.0, 0.0, 5.0];

/// Methods of collision integrals.
pub(crate) const KINETICS: [Method; 3] = [Method::Lt, Method::LtCorrected, Method::Exact];

/// The argument `--method` of collision integrals.
pub(crate) fn methods(arg: Arg) -> Arg {
    arg.help(methods_help("lt,lt-corrected,exact"))
}

/// The argument `--tol` of collision integrals.
pub(crate) fn tolerance(arg: Arg) -> Arg {
    arg.default_value("1e-6")
}

/// Where the pairs of a map begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum By {
    /// From infinity, by impact parameter
    Impact,
    /// At the gap 1, closing in, by the angles to the line of centres
    Contact,
}

#[derive(Debug, Args)]
pub(crate) struct CollisionArguments {
    /// Squirmer parameters B2/B1 [default: -5,0,5]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    beta: Option<Numbers>,
    /// Where pairs begin
    #[arg(long, value_name = "START", default_value = "impact")]
    by: By,
    /// Largest impact parameter of the straight incoming paths, in radii [default: 3, those that reach the gap 1]
    #[arg(long, value_name = "B", value_parser = parse_number, allow_hyphen_values = true)]
    impact: Option<f64>,
    /// Incoming pairs, the same ones for every method and beta
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = parse_whole, allow_hyphen_values = true)]
    count: usize,
    /// Run only share m of n; 'squirmers merge' merges the shares
    #[arg(long, value_name = "m/n")]
    partition: Option<Share>,
    #[command(flatten)]
    models: ModelArguments,
    #[command(flatten)]
    runs: RunArguments,
}

#[derive(Debug, Args)]
pub(crate) struct KineticsArguments {
    /// Squirmer parameters B2/B1 [default: -5:5:1]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    beta: Option<Numbers>,
    /// Largest impact parameters of an encounter, in radii [default: 3, the paths that reach the gap 1]
    #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
    impact: Option<Numbers>,
    /// Encounters of a replication, and of each ring between two impact parameters
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = parse_whole, allow_hyphen_values = true)]
    count: usize,
    /// Independent replications, from which errors follow
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = parse_whole, allow_hyphen_values = true)]
    replications: usize,
    #[command(flatten)]
    models: ModelArguments,
    #[command(flatten)]
    runs: RunArguments,
}

/// Refuses squirmer parameters that are not finite.
fn checked_beta(beta: Vec<f64>) -> Result<Vec<f64>, CommandError> {
    match beta.iter().find(|beta| !beta.is_finite()) {
        Some(wrong) => {
            let allowed = "give finite numbers";
            Err(CommandError::input("--beta", format!("{wrong:?}"), allowed))
        }
        None => Ok(beta),
    }
}

pub(super) fn collisions(
    arguments: &CollisionArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(&arguments.models, &METHODS, general)?;
    let runs = sweep_options(&arguments.runs, &methods)?;
    let beta = checked_beta(list(&arguments.beta, &MAP_BETA))?;
    let starts = match (arguments.by, arguments.impact) {
        (By::Impact, b) => Starts::Impact(b.unwrap_or(CONTACT)),
        (By::Contact, None) => Starts::Contact,
        (By::Contact, Some(b)) => {
            let allowed = "pairs at the gap 1 have all impact parameters up to 3: leave this option out, or give --by impact";
            return Err(CommandError::input("--impact", written(b), allowed));
        }
    };
    let out = general.output()?;
    let sweep = |models| CollisionSweep {
        models,
        betas: &beta,
        starts,
        count: arguments.count,
        share: arguments.partition.unwrap_or(Share::ALL),
        run: runs.run,
        time_limit: runs.time_limit,
        out: &out,
    };
    sweep(&[]).checked_options()?;
    let models = set_up(&methods, &options)?;
    let mut told = Tally::default();
    let done = sweep(&models).run(&mut |row| told.add(&row))?;
    told.print();
    print_line!(
        "{} rows in {}",
        done.rows,
        general.out.join("collisions.csv").display()
    );
    Ok(out.account().verdict()?)
}

/// Counts of a map, for each method and beta in their order.
#[derive(Default)]
struct Tally(Vec<Counts>);

struct Counts {
    method: Method,
    beta: f64,
    rows: usize,
    parted: usize,
    tau: f64,
    turn: f64,
    largest: f64,
}

impl Tally {
    fn add(&mut self, row: &CollisionRow) {
        let same = |of: &Counts| of.method == row.method && of.beta.total_cmp(&row.beta).is_eq();
        if !self.0.last().is_some_and(same) {
            self.0.push(Counts {
                method: row.method,
                beta: row.beta,
                rows: 0,
                parted: 0,
                tau: 0.0,
                turn: 0.0,
                largest: 0.0,
            });
        }
        let Some(of) = self.0.last_mut() else { return };
        of.rows += 1;
        if row.turn1_deg.is_finite() {
            of.parted += 1;
            of.tau += row.tau;
            of.turn += 0.5 * (row.turn1_deg + row.turn2_deg);
            of.largest = of.largest.max(row.turn1_deg).max(row.turn2_deg);
        }
    }

    fn print(&self) {
        let header = [
            "method",
            "beta",
            "collisions",
            "parted [%]",
            "mean turn [deg]",
            "largest [deg]",
            "mean tau [a/V_s]",
        ];
        print_rows(
            &header,
            self.0.iter().map(|of| {
                let parted = of.parted as f64;
                vec![
                    of.method.to_string(),
                    written(of.beta),
                    of.rows.to_string(),
                    rounded(100.0 * parted / of.rows as f64, 2),
                    rounded(of.turn / parted, 3),
                    rounded(of.largest, 2),
                    rounded(of.tau / parted, 4),
                ]
            }),
        );
    }
}

pub(super) fn kinetics(
    arguments: &KineticsArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(&arguments.models, &KINETICS, general)?;
    let runs = sweep_options(&arguments.runs, &methods)?;
    let default: Vec<f64> = (-5..=5).map(f64::from).collect();
    let beta = checked_beta(list(&arguments.beta, &default))?;
    let impacts = list(&arguments.impact, &[CONTACT]);
    let sampling = Sampling::new(&impacts, arguments.count, arguments.replications)?;
    let out = general.output()?;
    let models = set_up(&methods, &options)?;
    let sweep = KineticsSweep {
        models: &models,
        betas: &beta,
        sampling: &sampling,
        options: runs,
        out: &out,
    };
    let Some(estimates) = sweep.run()? else {
        return Ok(out.account().verdict()?);
    };
    let rows: Vec<KineticsRow> = estimates.iter().map(|of| of.row()).collect();
    out.write("kinetics.csv", &csv_text(&rows)?)?;
    let against = ratios(&estimates);
    out.write("kinetics-ratios.csv", &csv_text(&against)?)?;
    if let Some(picture) = pictures::of_kinetics(&rows)? {
        out.write(&picture.file_name, &picture.svg)?;
    }
    print_coefficients(&rows);
    if !against.is_empty() {
        print_line!("");
        print_against(&against);
    }
    Ok(out.account().verdict()?)
}

/// A number with three decimals, without the size of what is zero but for rounding.
fn small(value: f64) -> String {
    rounded(if value.abs() < 1e-5 { 0.0 } else { value }, 3)
}

fn print_coefficients(rows: &[KineticsRow]) {
    let header = [
        "method", "beta", "b [a]", "part [%]", "tau", "D_R/n", "error", "n D_T", "D/n", "align",
        "growth/n", "error",
    ];
    print_rows(
        &header,
        rows.iter().map(|row| {
            vec![
                row.method.to_string(),
                written(row.beta),
                written(row.impact),
                rounded(100.0 * row.parting, 1),
                rounded(row.tau, 2),
                rounded(row.rotation, 3),
                rounded(row.rotation_error, 3),
                rounded(row.translation, 3),
                rounded(row.displacement, 2),
                small(row.alignment),
                small(row.growth),
                rounded(row.growth_error, 3),
            ]
        }),
    );
}

/// A line for each method, beta and impact parameter: the ratio of each coefficient to the exact one.
fn print_against(rows: &[KineticsRatioRow]) {
    let same = |a: &KineticsRatioRow, b: &KineticsRatioRow| {
        a.method == b.method
            && a.beta.total_cmp(&b.beta).is_eq()
            && a.impact.total_cmp(&b.impact).is_eq()
    };
    let names: Vec<&str> = (rows.chunk_by(same).next())
        .map(|of| of.iter().map(|row| row.quantity.as_str()).collect())
        .unwrap_or_default();
    let header: Vec<&str> = ["over exact", "beta", "b [a]"]
        .into_iter()
        .chain(names)
        .collect();
    print_rows(
        &header,
        rows.chunk_by(same).map(|of| {
            let place = [
                of[0].method.to_string(),
                written(of[0].beta),
                written(of[0].impact),
            ];
            let ratios = of.iter().map(|row| rounded(row.ratio, 2));
            place.into_iter().chain(ratios).collect()
        }),
    );
}
