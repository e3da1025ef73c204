//! Limits on what commands print and draw of sweeps with many runs.

use crate::error::CommandError;
use crate::streams::print_line;
use crate::terminal::print_rows;
use compare::numbers::{rounded, written};
use compare::output::OutputFolder;
use compare::study::encounters::{Drawn, MOST_RUNS};
use compare::{Approach, Method};

/// The number of combinations, if a sweep can have so many.
pub(super) fn checked_count(beta: &[f64], dx: &[f64], dz: &[f64]) -> Result<usize, CommandError> {
    let count = (beta.len())
        .saturating_mul(dx.len())
        .saturating_mul(dz.len());
    if count > MOST_RUNS {
        let allowed = format!("a sweep has at most {MOST_RUNS} combinations of its lists");
        return Err(CommandError::input("a sweep of", count, allowed));
    }
    Ok(count)
}

/// Deletes the pictures of an earlier sweep that this sweep does not replace because it has too many runs.
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

/// Largest number of rows that are printed; the file has all rows.
pub(super) const PRINTED: usize = 1000;

/// Keeps a row for printing, unless there are enough.
pub(super) fn keep_first<R>(first: &mut Vec<R>, row: R) {
    if first.len() < PRINTED {
        first.push(row);
    }
}

/// A number at a gap: method, ratio of the radii, gap, name, value and error estimate.
pub(super) type NumberAtGap<'a> = (Method, f64, f64, &'a str, f64, &'a str);

/// Prints the rows of `name.csv`, whose numbers are each a `kind`.
pub(super) fn print_numbers<'a>(
    kind: &str,
    name: &str,
    rows: impl ExactSizeIterator<Item = NumberAtGap<'a>>,
) {
    let count = rows.len();
    print_rows(
        &["method", "ratio", "gap", kind, "value", "error estimate"],
        rows.take(PRINTED)
            .map(|(method, ratio, gap, name, value, error_estimate)| {
                vec![
                    method.to_string(),
                    written(ratio),
                    written(gap),
                    name.to_owned(),
                    rounded(value, 9),
                    error_estimate.to_owned(),
                ]
            }),
    );
    print_rest(count, name);
}

/// Reports the number of rows that are not printed.
pub(super) fn print_rest(rows: usize, name: impl std::fmt::Display) {
    if rows > PRINTED {
        print_line!("and {} more rows in {name}.csv", rows - PRINTED);
    }
}

/// Reports which pictures are not drawn, and why.
pub(super) fn print_undrawn(drawn: Drawn, runs: usize) {
    match drawn {
        Drawn::Paths => {}
        Drawn::Points => {
            print_line!("no picture of the trajectories: {runs} runs are too many for one")
        }
        Drawn::Nothing => print_line!("no pictures: {runs} runs are too many for one"),
    }
}
