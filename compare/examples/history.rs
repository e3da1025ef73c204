//! Measures how accurate the models of this workspace are in this version and what they cost, and prints it as rows of `fixtures/history.csv`:
//! `cargo run --release -p squirmers-compare --example history -- INSTRUCTIONS [HISTORY]`.
//!
//! INSTRUCTIONS is the table which `cargo bench -p squirmers-compare --bench instructions` prints. With HISTORY it fails if a measurement lies outside its band about
//! the row that is kept there of this version.

use std::process::ExitCode;

use compare::effects::read_instructions;
use compare::judge::{history_rows, instruction_rows, outside_bands, read_history};

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let mut files = std::env::args().skip(1);
    let instructions = files.next().ok_or("the table of instructions is missing")?;
    let mut rows = history_rows()?;
    let counts = read_instructions(&std::fs::read_to_string(instructions)?)?;
    rows.extend(instruction_rows(&counts));
    print!("{}", compare::csv_text(&rows)?);
    let Some(history) = files.next() else {
        return Ok(ExitCode::SUCCESS);
    };
    let outside = outside_bands(&rows, &read_history(&std::fs::read_to_string(history)?)?);
    for line in &outside {
        eprintln!("{line}");
    }
    Ok(match outside.is_empty() {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    })
}
