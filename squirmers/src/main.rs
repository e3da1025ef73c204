//! The command `squirmers`: what a person sees of the comparisons. Arguments, files, pictures, tables and the page;
//! whatever is computed is computed by `compare` and the crates below it.

mod arguments;
mod cli;
mod commands;
mod error;
mod figures;
mod interrupt;
mod page;
mod pictures;
mod progress;
mod provenance;
mod report;
mod streams;
mod terminal;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run(std::env::args_os())
}
