//! What commands print and draw of sweeps, however many runs these have.

use crate::error::CommandError;
use crate::streams::say;
use compare::Approach;
use compare::kept_rows::{Drawn, MOST_RUNS};
use compare::output::OutputFolder;

/// How many combinations there are, if a sweep can hold so many.
pub(super) fn checked_count(beta: &[f64], dx: &[f64], dz: &[f64]) -> Result<usize, CommandError> {
    let count = (beta.len())
        .saturating_mul(dx.len())
        .saturating_mul(dz.len());
    if count > MOST_RUNS {
        let allowed =
            format!("a sweep holds at most {MOST_RUNS} combinations of --beta, --dx and --dz");
        return Err(CommandError::input("a sweep of", count, allowed));
    }
    Ok(count)
}

/// Takes away pictures of an earlier sweep which this one, having too many runs, does not replace.
pub(super) fn drop_undrawn(
    drawn: Drawn,
    approach: Approach,
    out: &OutputFolder,
) -> Result<(), CommandError> {
    let undrawn: &[&str] = match drawn {
        Drawn::Paths => &[],
        Drawn::Points => &["trajectories"],
        Drawn::Nothing => &["trajectories", "deflection"],
    };
    for name in undrawn {
        out.remove(&format!("{approach}-{name}.svg"))?;
    }
    Ok(())
}

/// Rows that are printed; the file has all.
pub(super) const PRINTED: usize = 1000;

/// Keeps a row that is to be printed.
pub(super) fn keep_first<R>(first: &mut Vec<R>, row: R) {
    if first.len() < PRINTED {
        first.push(row);
    }
}

/// Says that there are more than the rows printed.
pub(super) fn print_rest(rows: usize, name: impl std::fmt::Display) {
    if rows > PRINTED {
        say!("and {} more rows in {name}.csv", rows - PRINTED);
    }
}

/// Says which pictures there are not, and why.
pub(super) fn say_undrawn(drawn: Drawn, runs: usize) {
    match drawn {
        Drawn::Paths => {}
        Drawn::Points => say!("no picture of the trajectories: {runs} runs are too many for one"),
        Drawn::Nothing => say!("no pictures: {runs} runs are too many for one"),
    }
}
