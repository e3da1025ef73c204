//! The arguments of the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use crate::commands::cost::CostArguments;
use crate::commands::hard_cases::HardCaseArguments;
use crate::commands::maps::{self, MapArguments, TrustArguments};
use crate::commands::sweep::{self, MergeArguments, SweepArguments};
use crate::commands::{bottom_heavy, scene};
use crate::error::CommandError;
use compare::Method;
use compare::numbers::{Numbers, parse_number, parse_numbers, parse_whole};
use compare::output::OutputFolder;

/// Two squirming spheres in a Stokes fluid: lubrication theory against full hydrodynamics.
///
/// Lengths are in sphere radii a, times in a/V_s, angles in degrees. Lists are numbers with commas,
/// ranges a:b:step and logarithmic ranges a:b:log:count. Each command writes DIR/COMMAND.csv and its pictures.
#[derive(Debug, Parser)]
#[command(
    name = "squirmers",
    version,
    arg_required_else_help = true,
    subcommand_required = true,
    after_help = "Example:\n  squirmers report --out out      every comparison, as one web page\n\n\
        Exit status: 0 done; 1 a run failed or a bound is broken; 2 bad input or output place;\n\
        75 stopped by --time-limit, and the same command continues; 130 interrupted.\n\n\
        Interrupts (Ctrl-C): maps and sweeps finish and keep their current pieces, and the same\n\
        command continues with the rest; a second interrupt ends the command at once."
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
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

impl Arguments {
    /// Opens the folder for results and locks it against other commands.
    pub(super) fn output(&self) -> Result<OutputFolder, CommandError> {
        Ok(OutputFolder::open(&self.out)?.fresh(self.fresh))
    }
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Loads of the pair at given gaps: resistance scalars, and loads of squirming and swirl modes
    #[command(
        after_help = "Example:\n  squirmers loads --gap 1,0.1,0.01 --method lt,bem --direct\n  \
                            squirmers loads --gap 0.1 --modes 3 --swirl 2 --method exact --direct"
    )]
    Loads {
        /// Gaps eps = |x2-x1|/a - 2, each greater than 0
        #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
        gap: Numbers,
        /// Highest squirming mode
        #[arg(long, value_name = "N", default_value_t = 2, value_parser = parse_whole, allow_hyphen_values = true)]
        modes: usize,
        /// Highest swirl mode; 0 for none
        #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse_whole, allow_hyphen_values = true)]
        swirl: usize,
        #[command(flatten)]
        models: ModelArguments,
    },
    /// Opposed approach (Fig. 6): from (-dx/2, 5) downwards and (dx/2, -5) upwards
    #[command(after_help = "Example:\n  squirmers head-on --beta 5 --dx 1,2,3,5,10 --method lt")]
    HeadOn(EncounterArguments),
    /// Approach at right angles (Fig. 7): from (0, 10) along x and (10 - dx, 0) along y
    #[command(after_help = "Example:\n  squirmers orthogonal --beta -1,1,5 --dx 1,2,3,5")]
    Orthogonal(EncounterArguments),
    /// Change of the outgoing angles by an offset out of the plane (Fig. 5b)
    #[command(after_help = "Example:\n  squirmers offset --dz 0:0.5:0.1 --method lt,bem")]
    Offset {
        /// Offsets: squirmer 1 starts at z = dz/2, squirmer 2 at z = -dz/2 [default: the paper's]
        #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
        dz: Option<Numbers>,
        #[command(flatten)]
        models: ModelArguments,
        #[command(flatten)]
        runs: RunArguments,
    },
    /// What accuracy costs in time: loads, deflections, scaling, and the cheapest method for a target
    #[command(after_help = "Example:\n  squirmers cost --target 0.1deg --quick")]
    Cost(CostArguments),
    /// Maps over the incoming angles (Figs 2-4): deflections, interaction time tau, outcome
    #[command(after_help = "Example:\n  squirmers scatter --beta 5 --grid 100 --g 0")]
    #[command(mut_arg("method", maps::methods), mut_arg("tol", maps::tolerance))]
    #[command(mut_arg("time_limit", maps::time_limit))]
    Scatter(MapArguments),
    /// Share of each outcome as a function of beta (Fig. 5a) and bottom-heaviness (Fig. 8g)
    #[command(after_help = "Example:\n  squirmers fates --beta -10:10:1 --g 0 --method lt")]
    #[command(mut_arg("method", maps::methods), mut_arg("tol", maps::tolerance))]
    #[command(mut_arg("time_limit", maps::time_limit))]
    Fates(MapArguments),
    /// Bottom-heavy squirmers under gravity (Fig. 8a-f): trajectories of the six panels
    #[command(after_help = "Example:\n  squirmers bottom-heavy --method lt,exact,bem")]
    #[command(
        mut_arg("method", maps::methods),
        mut_arg("time_limit", bottom_heavy::time_limit)
    )]
    BottomHeavy {
        #[command(flatten)]
        models: ModelArguments,
        #[command(flatten)]
        runs: RunArguments,
    },
    /// Map of the incoming angles where lubrication theory and exact hydrodynamics disagree
    #[command(after_help = "Example:\n  squirmers trust --beta 5 --grid 100")]
    #[command(mut_arg("method", maps::methods), mut_arg("tol", maps::tolerance))]
    #[command(mut_arg("time_limit", maps::time_limit))]
    Trust(TrustArguments),
    /// One scene from its file: trajectory, picture, summary
    #[command(
        after_help = "Example:\n  squirmers run fixtures/scenes/fig6-head-on-dx1.toml --out out"
    )]
    Run(scene::RunArguments),
    /// What is computed for a scene and what is not, the reasons, and the cost
    #[command(after_help = "Example:\n  squirmers explain fixtures/scenes/fig8e-downward.toml")]
    Explain(scene::ExplainArguments),
    /// Numerically hard cases, each compared with a bound; exit status 1 if a bound is broken
    #[command(after_help = "Example:\n  squirmers hard-cases --only contact,long-runs")]
    HardCases(HardCaseArguments),
    /// Sweep of a family of scenes along any of its parameters: one row for each scene and model
    #[command(
        after_help = "Example:\n  squirmers sweep opposed --vary beta=-5,0,5 --vary dx=0.5:3:0.5 --method lt,exact\n  \
                            squirmers sweep mine.toml --vary kappa=1:100:log:9 --partition 2/7 --out share-2"
    )]
    #[command(
        mut_arg("method", sweep::methods),
        mut_arg("time_limit", sweep::time_limit)
    )]
    Sweep(SweepArguments),
    /// Merge the shares of a sweep into the file of the whole sweep
    #[command(after_help = "Example:\n  squirmers merge share-1 share-2 share-3 --out whole")]
    Merge(MergeArguments),
    /// All comparisons for the paper's cases, in one self-contained index.html
    #[command(after_help = "Example:\n  squirmers report --out out && xdg-open out/index.html")]
    Report {
        #[command(flatten)]
        models: ModelArguments,
        #[command(flatten)]
        runs: RunArguments,
    },
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

#[derive(Debug, Args)]
pub(crate) struct ModelArguments {
    /// Methods: lt (as published), lt-corrected, exact, bem [default: lt,exact,bem]
    #[arg(long, value_name = "LIST", value_parser = parse_methods)]
    pub method: Option<Methods>,
    /// Level of the mesh of boundary elements
    #[arg(long, value_name = "N", value_parser = parse_level, allow_hyphen_values = true)]
    pub mesh: Option<usize>,
    /// Solve for every load instead of reading it from a table
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
    for name in text.split(',') {
        let method = Method::ALL.into_iter().find(|m| m.name() == name.trim());
        let method = method.ok_or_else(|| {
            let known: Vec<_> = Method::ALL.iter().map(|m| m.name()).collect();
            format!("'{name}' is not a method: use {}", known.join(", "))
        })?;
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
