//! Sweeps: many runs in a fixed order, computed in parallel, kept on disk as they finish, shared among machines.

mod family_sweep;
mod journal;
mod limits;
mod manifest;
mod merge;
mod pieces;
mod points;
mod share;

use std::time::Duration;

use scene::RunOptions;

pub(crate) use family_sweep::Tail as SweepTail;
pub use family_sweep::{FamilySweep, SweepRow};
pub use limits::{checked_angles_at, checked_time_limit, checked_tolerance};
pub use manifest::{Arithmetic, Axis, Manifest, ManifestModel, SweepIdentity};
pub use merge::{Merged, merge};
pub(crate) use pieces::key;
pub use pieces::{Computed, Done, Kept, Row, Sweep};
pub use points::{Points, RunChoices};
pub use share::Share;

/// Options of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct SweepOptions {
    /// Options of each run.
    pub run: RunOptions,
    /// Time after which no further run begins. Runs that are left out are reported as skipped.
    pub time_limit: Option<Duration>,
}
