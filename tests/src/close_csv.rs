//! A comparison of CSV snapshots that accepts rounding noise and rejects a real change.

use insta::internals::SnapshotContents;
use insta::{Comparator, Snapshot};

/// Difference of two numbers, relative to the larger of them and 1, up to which they are taken as
/// the same. The snapshots print nine significant digits, whose last may change with the machine's
/// rounding (1e-8 relative at most); a change of 1e-6 is a change of the result.
pub const TOLERANCE: f64 = 1e-7;

/// Compares CSV text cell by cell: numbers within [`TOLERANCE`], NaN equal to NaN, all else
/// literally.
#[derive(Clone, Copy, Debug)]
pub struct CloseCsv;

impl Comparator for CloseCsv {
    fn matches(&self, reference: &Snapshot, test: &Snapshot) -> bool {
        match (text(reference.contents()), text(test.contents())) {
            (Some(reference), Some(test)) => close(&reference, &test),
            _ => false,
        }
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(*self)
    }
}

fn text(contents: &SnapshotContents) -> Option<String> {
    match contents {
        SnapshotContents::Text(text) => Some(text.to_string()),
        SnapshotContents::Binary(_) => None,
    }
}

/// Whether two CSV texts agree.
#[must_use]
pub fn close(reference: &str, test: &str) -> bool {
    let lines = |text: &str| text.trim().lines().map(str::to_owned).collect::<Vec<_>>();
    let (reference, test) = (lines(reference), lines(test));
    reference.len() == test.len() && reference.iter().zip(&test).all(|(a, b)| close_lines(a, b))
}

fn close_lines(a: &str, b: &str) -> bool {
    let (a, b): (Vec<_>, Vec<_>) = (a.split(',').collect(), b.split(',').collect());
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| close_cells(a, b))
}

fn close_cells(a: &str, b: &str) -> bool {
    match (a.trim().parse::<f64>(), b.trim().parse::<f64>()) {
        (Ok(a), Ok(b)) if a.is_nan() || b.is_nan() => a.is_nan() && b.is_nan(),
        (Ok(a), Ok(b)) => (a - b).abs() <= TOLERANCE * a.abs().max(b.abs()).max(1.0),
        _ => a == b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REFERENCE: &str = "method,dx,deflection\nlt,1,-1.97074030e1\nlt,2,NaN\n";

    #[test]
    fn a_change_of_the_last_digit_passes() {
        assert!(close(REFERENCE, &REFERENCE.replace("4030e1", "4031e1")));
    }

    #[test]
    fn a_change_of_one_in_a_million_fails() {
        let changed = -1.970_740_30e1 * (1.0 + 1e-6);
        let changed = REFERENCE.replace("-1.97074030e1", &format!("{changed:.8e}"));
        assert!(!close(REFERENCE, &changed));
    }

    #[test]
    fn another_word_a_missing_row_or_a_lost_number_fails() {
        assert!(!close(REFERENCE, &REFERENCE.replace("lt,1", "bem,1")));
        assert!(!close(
            REFERENCE,
            "method,dx,deflection\nlt,1,-1.97074030e1\n"
        ));
        assert!(!close(REFERENCE, &REFERENCE.replace("NaN", "0.0")));
    }
}
