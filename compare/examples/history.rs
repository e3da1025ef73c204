//! Prints the rows of `fixtures/history.csv` for this version: how accurate the models of this workspace are, and what they cost.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    print!("{}", compare::csv_text(&compare::judge::history_rows()?)?);
    Ok(())
}
