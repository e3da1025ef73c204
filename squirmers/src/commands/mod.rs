//! The commands: from arguments to files.

pub(crate) mod bottom_heavy;
mod cost;
pub(crate) mod encounters;
mod flow;
pub(crate) mod growth;
mod hard_cases;
mod judge;
pub(crate) mod kinetics;
mod loads;
mod many;
pub(crate) mod maps;
mod reference;
mod scene;
mod sensitivity;
mod shared;
mod stress;
mod sweep;
pub(crate) mod unlike;

use ::scene::LoadSet;
use clap::Subcommand;
use compare::numbers::{Numbers, parse_numbers, parse_whole};
use compare::{Approach, Method};

use crate::arguments::{EncounterArguments, GeneralArguments, ModelArguments, RunArguments};
use crate::error::CommandError;
use crate::report;
use crate::streams::print_line;
use cost::CostArguments;
use flow::FlowArguments;
use growth::GrowthArguments;
use hard_cases::HardCaseArguments;
use judge::JudgeArguments;
use kinetics::{CollisionArguments, KineticsArguments};
use maps::{MapArguments, TrustArguments};
use sensitivity::SensitivityArguments;
use shared::{highest, model_options, sweep_options};
use stress::StressArguments;
use sweep::{MergeArguments, SweepArguments};
use unlike::{CargoArguments, RatioArguments};

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Loads of the pair at given gaps: resistance scalars, and loads of squirming and swirl modes
    #[command(
        after_help = "Example:\n  squirmers loads --gap 1,0.1,0.01 --method lt,bem --direct\n  \
                            squirmers loads --gap 0.1 --modes 3 --swirl 2 --method exact --direct\n  \
                            squirmers loads --gap 0.1 --ratio 0.5,2 --method exact"
    )]
    Loads {
        /// Gaps between the surfaces, in radii of sphere 1, each greater than 0
        #[arg(long, value_name = "LIST", value_parser = parse_numbers, allow_hyphen_values = true)]
        gap: Numbers,
        /// Highest squirming mode
        #[arg(long, value_name = "N", default_value_t = 2, value_parser = parse_whole, allow_hyphen_values = true)]
        modes: usize,
        /// Highest swirl mode; 0 for none
        #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse_whole, allow_hyphen_values = true)]
        swirl: usize,
        /// Radii of sphere 2 over that of sphere 1, from 0.01 to 100; the gap is in radii of sphere 1
        #[arg(long, value_name = "LIST", default_value = "1", value_parser = parse_numbers, allow_hyphen_values = true)]
        ratio: Numbers,
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
    /// Growth of an offset out of the plane over the incoming angles: where motion in the plane is a fiction
    #[command(
        after_help = "Example:\n  squirmers growth --beta 1,5 --grid 40 --method lt,exact --offset 0.1"
    )]
    #[command(mut_arg("method", maps::methods), mut_arg("tol", maps::tolerance))]
    #[command(mut_arg("time_limit", maps::time_limit))]
    Growth(GrowthArguments),
    /// Squirmers of unlike radii: outcomes over the incoming angles, and trust in lubrication theory
    #[command(
        after_help = "Example:\n  squirmers ratios --ratio 0.2,1,5 --beta 5 --beta2 -5,5 --grid 40"
    )]
    #[command(mut_arg("method", maps::methods), mut_arg("tol", maps::tolerance))]
    #[command(mut_arg("time_limit", maps::time_limit))]
    Ratios(RatioArguments),
    /// How far a swimmer that passes a passive sphere of any radius moves it
    #[command(
        after_help = "Example:\n  squirmers cargo --beta 0 --ratio 0.5,2 --b 0.1:4:0.3 --method lt,exact"
    )]
    Cargo(CargoArguments),
    /// One scene from its file: trajectory, picture, summary
    #[command(
        after_help = "Example:\n  squirmers run fixtures/scenes/fig6-head-on-dx1.toml --out out"
    )]
    Run(scene::RunArguments),
    /// The flow about the pair of a scene file, at an instant or as a film: picture, rows, files for ParaView
    #[command(
        after_help = "Example:\n  squirmers flow fixtures/scenes/fig7-orthogonal-beta1-dx1.toml --method exact\n  \
                            squirmers flow fixtures/scenes/fig6-head-on-dx1.toml --method exact --every 0.5 --frame 1"
    )]
    #[command(mut_arg("method", flow::methods))]
    Flow(FlowArguments),
    /// Stresslets, power and efficiency: over the paper's encounters, along the run of a scene file, or by gap
    #[command(
        after_help = "Example:\n  squirmers stress                          the paper's encounters\n  \
                            squirmers stress fixtures/scenes/fig6-head-on-dx1.toml\n  \
                            squirmers stress --gap 1,0.1,0.01 --modes 3 --ratio 0.5,1"
    )]
    #[command(mut_arg("method", stress::methods))]
    Stress(StressArguments),
    /// What is computed for a scene and what is not, the reasons, and the cost
    #[command(after_help = "Example:\n  squirmers explain fixtures/scenes/fig8e-downward.toml")]
    Explain(scene::ExplainArguments),
    /// Numerically hard cases, each compared with a bound; exit status 1 if a bound is broken
    #[command(after_help = "Example:\n  squirmers hard-cases --only contact,long-runs")]
    HardCases(HardCaseArguments),
    /// Judge anybody's models against exact hydrodynamics: errors, laws, collisions, and a verdict in words
    #[command(
        after_help = "Example:\n  squirmers judge theirs=theirs.csv\n  squirmers judge 'theirs=exec:python3 docs/judge_example.py' --json"
    )]
    Judge(JudgeArguments),
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
    /// How sensitive collisions are: derivatives of the outgoing headings, and how far a squirmer can be offset out of the plane
    #[command(
        after_help = "Without FAMILY: the paper's encounters (Figs 6 and 7).\n\nExample:\n  squirmers sensitivity --method lt,exact\n  \
                            squirmers sensitivity right-angles --vary beta=-5:5:1 --vary dx=1,2"
    )]
    #[command(mut_arg("time_limit", sweep::time_limit))]
    Sensitivity(SensitivityArguments),
    /// Merge the shares of a sweep into the file of the whole sweep
    #[command(after_help = "Example:\n  squirmers merge share-1 share-2 share-3 --out whole")]
    Merge(MergeArguments),
    /// Collisions in three dimensions: turns of both headings, interaction time tau, outcome of each of many pairs
    #[command(
        after_help = "Example:\n  squirmers collisions --beta 5 --count 10000 --method exact\n  \
                            squirmers collisions --by contact --beta -5,5 --partition 2/7 --out share-2"
    )]
    #[command(
        mut_arg("method", maps::methods),
        mut_arg("tol", maps::tolerance),
        mut_arg("time_limit", sweep::time_limit)
    )]
    Collisions(CollisionArguments),
    /// Collision integrals of a dilute suspension: diffusivities, alignment, growth of polar order
    #[command(
        after_help = "Example:\n  squirmers kinetics --beta -5,0,5 --method lt,exact\n  \
                            squirmers kinetics --beta 1 --impact 3,4,6,9 --count 1024"
    )]
    #[command(
        mut_arg("method", kinetics::methods),
        mut_arg("tol", kinetics::tolerance),
        mut_arg("time_limit", sweep::time_limit)
    )]
    Kinetics(KineticsArguments),
    /// A package of exact reference numbers, with their errors, to be cited and compared with
    #[command(
        after_help = "The folder must be new, empty, or that of an earlier package.\n\nExample:\n  squirmers reference --out squirmers-reference"
    )]
    Reference,
    /// All comparisons for the paper's cases, in one self-contained index.html
    #[command(after_help = "Example:\n  squirmers report --out out && xdg-open out/index.html")]
    Report {
        #[command(flatten)]
        models: ModelArguments,
        #[command(flatten)]
        runs: RunArguments,
    },
}

/// Runs a command; `typed` is the command line, for the page and the notes on costs.
pub(crate) fn run(
    command: &Command,
    general: &GeneralArguments,
    typed: &[String],
) -> Result<(), CommandError> {
    match command {
        Command::Loads {
            gap,
            modes,
            swirl,
            ratio,
            models,
        } => {
            let set = LoadSet::all(highest("--modes", *modes)?);
            let set = set.with_swirl(highest("--swirl", *swirl)?);
            loads::run(gap, ratio, set, models, general)
        }
        Command::HeadOn(given) => encounters::encounters(Approach::HeadOn, given, general),
        Command::Orthogonal(given) => encounters::encounters(Approach::Orthogonal, given, general),
        Command::Offset { dz, models, runs } => {
            encounters::offset(dz.as_ref(), models, runs, general)
        }
        Command::Cost(cost) => cost::run(cost, general, typed),
        Command::Scatter(map) => maps::scatter(map, general),
        Command::Fates(map) => maps::fates(map, general),
        Command::BottomHeavy { models, runs } => bottom_heavy::run(models, runs, general),
        Command::HardCases(cases) => hard_cases::run(cases, general),
        Command::Judge(given) => judge::run(given, general, typed),
        Command::Trust(map) => maps::trust(map, general),
        Command::Growth(given) => growth::run(given, general),
        Command::Ratios(given) => unlike::ratios(given, general),
        Command::Cargo(given) => unlike::cargo(given, general),
        Command::Run(run) => scene::run(run, general),
        Command::Flow(given) => flow::run(given, general),
        Command::Stress(given) => stress::run(given, general),
        Command::Explain(explain) => scene::explain(explain, general),
        Command::Collisions(given) => kinetics::collisions(given, general),
        Command::Kinetics(given) => kinetics::kinetics(given, general),
        Command::Sweep(given) => sweep::run(given, general),
        Command::Sensitivity(given) => sensitivity::run(given, general),
        Command::Merge(given) => sweep::merge(given, general),
        Command::Reference => reference::run(general),
        Command::Report { models, runs } => {
            let (methods, options) = model_options(models, &Method::DEFAULT, general)?;
            let sweep = sweep_options(runs, &methods)?;
            let out = general.output()?;
            let path = report::write(&methods, &options, &sweep, &out, typed)?;
            print_line!("{}", path.display());
            Ok(out.account().verdict()?)
        }
    }
}
