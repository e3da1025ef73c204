//! Boundary elements against Townsend's table of resistance scalars.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use bem::Bem;
use scene::{Gap, Hydrodynamics, LoadSet};
use tests::{ResistanceRow, two_sphere_resistance};

/// Errors of the ten scalars in a row, relative to the larger of the scalar and 0.1 (so that
/// 0.5 % means 5e-4 at least).
fn errors(bem: &Bem, row: &ResistanceRow) -> Vec<(&'static str, f64)> {
    let loads = bem
        .loads(Gap::new(row.eps()).unwrap(), LoadSet::all(0))
        .unwrap()
        .named();
    (row.scalars().iter().zip(loads))
        .map(|((name, expected), (found_name, found))| {
            assert_eq!(*name, found_name);
            (*name, (found - expected).abs() / expected.abs().max(0.1))
        })
        .collect()
}

#[test]
fn val_every_scalar_is_within_half_a_percent_of_the_table() {
    let bem = Bem::new(Bem::DEFAULT_LEVEL).unwrap();
    for row in two_sphere_resistance() {
        for (name, error) in errors(&bem, &row) {
            assert!(
                error < 5e-3,
                "{name} at r/a = {}: {error:.1e}",
                row.r_over_a
            );
        }
    }
}

#[test]
fn val_the_next_finer_mesh_is_closer() {
    /// The table's nine digits, relative to 0.1: below this, closer cannot be told.
    const DIGITS: f64 = 1e-7;
    let levels = [Bem::DEFAULT_LEVEL, Bem::DEFAULT_LEVEL + 1];
    let [coarse, fine] = levels.map(|level| Bem::new(level).unwrap());
    for row in two_sphere_resistance() {
        let pairs = errors(&coarse, &row).into_iter().zip(errors(&fine, &row));
        for ((name, before), (_, after)) in pairs {
            // A level halves the area of the panels; order 2 in their size halves the error.
            let order = 2.0 * (before / after).log2();
            println!(
                "r/a {} {name} {before:.1e} -> {after:.1e} order {order:.1}",
                row.r_over_a
            );
            assert!(
                after < before.max(DIGITS),
                "{name} at r/a = {}",
                row.r_over_a
            );
        }
    }
}
