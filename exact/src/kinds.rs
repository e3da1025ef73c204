//! The kinds of sets that limiting forms are fitted for, once each.

use std::sync::OnceLock;

use scene::{LoadSet, MAX_MODES};

use crate::ExactError;

/// Limiting forms are fitted for sets with and without transverse loads and swirl.
pub const KINDS: usize = 4;

/// Which of the limiting forms serves for a set.
pub fn kind(set: LoadSet) -> usize {
    usize::from(set.transverse.any()) + 2 * usize::from(set.swirl > 0)
}

/// All loads of the kind of a set.
pub fn whole(set: LoadSet) -> LoadSet {
    LoadSet {
        swirl: if set.swirl > 0 { MAX_MODES } else { 0 },
        twist: true,
        ..if set.transverse.any() {
            LoadSet::planar(MAX_MODES)
        } else {
            LoadSet::axial(MAX_MODES)
        }
    }
}

/// Not `get_or_init` with the fit inside: a fit runs on the threads of the pool, one of which may
/// come back here for the same form and would wait for itself. Two fits at once do no harm.
pub fn get_or_fit<T>(
    cell: &OnceLock<T>,
    fit: impl Fn() -> Result<T, ExactError>,
) -> Result<&T, ExactError> {
    match cell.get() {
        Some(form) => Ok(form),
        None => {
            let form = fit()?;
            Ok(cell.get_or_init(|| form))
        }
    }
}
