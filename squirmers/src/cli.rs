//! The command `squirmers`: arguments in, files and a short table out.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind;

use compare::{CompareError, watch};

use crate::arguments::Arguments;
use crate::commands;
use crate::error::CommandError;
use crate::interrupt;
use crate::progress::OnStandardError;
use crate::streams::{complain, refused, write_out};

/// Runs the command line `arguments` (the program's name first).
///
/// Exit status 0 on success, 1 if a run failed or a bound is broken, 2 for bad input or a bad output place, 75 if
/// the time limit stopped the command, 130 if it was interrupted; each prints one line on standard error.
pub fn run<I, T>(arguments: I) -> ExitCode
where
    I: IntoIterator<Item = T>,
    T: Into<OsString> + Clone,
{
    let arguments = without_help_on_help(arguments.into_iter().map(Into::into).collect());
    let parsed = match Arguments::try_parse_from(&arguments) {
        Ok(parsed) => parsed,
        Err(error) => return refuse(&error),
    };
    interrupt::listen();
    watch::install(Box::new(OnStandardError));
    let typed: Vec<_> = (arguments.iter().skip(1))
        .map(|argument| argument.to_string_lossy().into_owned())
        .collect();
    let done = set_threads(parsed.threads)
        .and_then(|()| check_cache(&parsed))
        .and_then(|()| commands::run(&parsed, &typed));
    ended(done.and_then(|()| refused()))
}

/// The command `help` knows no options; `--help` beside it asks for what it prints anyway.
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
                // What was asked for is no mistake.
                CommandError::Compare(CompareError::Interrupted { .. }) => complain!("{error}"),
                _ => complain!("error: {error}"),
            }
            ExitCode::from(error.exit_status())
        }
    }
}

/// Help and version go to standard output; anything else is bad input, told in one line.
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
    complain!("{} (see --help)", lines.join(" "));
    ExitCode::from(2)
}

/// A file in the place of the cache would keep nothing.
fn check_cache(arguments: &Arguments) -> Result<(), CommandError> {
    match &arguments.cache {
        Some(path) if path.exists() && !path.is_dir() => {
            let allowed = "it is no folder: name one, or leave it out";
            Err(CommandError::input("--cache", path.display(), allowed))
        }
        _ => Ok(()),
    }
}

fn set_threads(threads: Option<usize>) -> Result<(), CommandError> {
    /// More threads than any machine has cores are a slip of the finger.
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
