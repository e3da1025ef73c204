//! Reads the command line, runs the command and sets the exit status.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind;

use compare::submission::end_processes;
use compare::{CompareError, watch};

use crate::arguments::GeneralArguments;
use crate::commands::{self, Command};
use crate::error::CommandError;
use crate::interrupt;
use crate::progress::OnStandardError;
use crate::streams::{print_error, refused, write_out};

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
    #[command(flatten)]
    pub general: GeneralArguments,
}

/// Runs the command line `arguments` (the program's name first).
///
/// Exit status 0 on success, 1 if a run failed or a bound is broken, 2 for bad input or a bad output place, 75 if
/// the time limit stopped the command, 130 if it was interrupted. Every failure prints one line on standard error. No process that answers as a
/// model outlives it.
pub fn run<I, T>(arguments: I) -> ExitCode
where
    I: IntoIterator<Item = T>,
    T: Into<OsString> + Clone,
{
    let arguments = without_help_on_help(arguments.into_iter().map(Into::into).collect());
    // Reading the arguments starts processes already.
    interrupt::listen();
    let status = run_command(&arguments);
    end_processes();
    status
}

fn run_command(arguments: &[OsString]) -> ExitCode {
    let parsed = match Arguments::try_parse_from(arguments) {
        Ok(parsed) => parsed,
        Err(error) => return refuse(&error),
    };
    watch::install(Box::new(OnStandardError));
    let typed: Vec<_> = (arguments.iter().skip(1))
        .map(|argument| argument.to_string_lossy().into_owned())
        .collect();
    let done = set_threads(parsed.general.threads)
        .and_then(|()| check_cache(&parsed.general))
        .and_then(|()| commands::run(&parsed.command, &parsed.general, &typed));
    ended(done.and_then(|()| refused()))
}

/// Drops `--help` after the command `help`, which accepts no options and prints the help anyway.
fn without_help_on_help(mut arguments: Vec<OsString>) -> Vec<OsString> {
    if arguments.get(1).is_some_and(|command| command == "help") {
        arguments.retain(|argument| argument != "--help" && argument != "-h");
    }
    arguments
}

fn ended(done: Result<(), CommandError>) -> ExitCode {
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            match error {
                // The user requested the interrupt, so the message does not say "error".
                CommandError::Compare(CompareError::Interrupted { .. }) => print_error!("{error}"),
                _ => print_error!("error: {error}"),
            }
            ExitCode::from(error.exit_status())
        }
    }
}

/// Help and version go to standard output. Anything else is bad input and is reported in one line.
fn refuse(error: &clap::Error) -> ExitCode {
    if matches!(
        error.kind(),
        ErrorKind::DisplayHelp
            | ErrorKind::DisplayVersion
            | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand
    ) {
        write_out(format_args!("{error}"));
        return ended(refused());
    }
    let text = error.to_string();
    let lines: Vec<_> = (text.lines().map(str::trim))
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more"))
        .filter(|line| !line.is_empty())
        .collect();
    print_error!("{} (see --help)", lines.join(" "));
    ExitCode::from(2)
}

/// Refuses a file in place of the cache folder, because tables could not be kept in it.
fn check_cache(arguments: &GeneralArguments) -> Result<(), CommandError> {
    match &arguments.cache {
        Some(path) if path.exists() && !path.is_dir() => {
            let allowed = "it is not a folder: give a folder, or leave this option out";
            Err(CommandError::input("--cache", path.display(), allowed))
        }
        _ => Ok(()),
    }
}

fn set_threads(threads: Option<usize>) -> Result<(), CommandError> {
    /// Largest number of threads: more threads than any machine has cores are a typing mistake.
    const MOST: usize = 4096;
    let Some(threads) = threads else {
        return Ok(());
    };
    if threads == 0 || threads > MOST {
        let allowed = format!("give a number from 1 to {MOST}");
        return Err(CommandError::input("--threads", threads, allowed));
    }
    (rayon::ThreadPoolBuilder::new().num_threads(threads))
        .build_global()
        .map_err(|error| CommandError::input("--threads", threads, error.to_string()))
}
