//! The command `squirmers`: its arguments, files, pictures, tables and web page. The crate `compare` and the crates
//! below it do all computations.

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
mod vtk;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run(std::env::args_os())
}
