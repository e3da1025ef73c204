//! Compares hydrodynamic models of two squirmers: the paper's encounters, maps and sweeps.
//!
//! One collision by two models:
//!
//! ```
#![doc = include_str!("../examples/one_collision.rs")]
//! ```

pub mod account;
mod case;
pub mod columns;
pub mod cost;
mod defaults;
pub mod effects;
mod error;
pub mod hard_cases;
pub mod judge;
#[cfg(test)]
mod made;
mod method;
mod model;
mod model_options;
mod no_run;
pub mod numbers;
pub mod output;
pub mod reference;
pub mod scene_file;
pub mod scene_run;
mod stoppable;
pub mod study;
pub mod submission;
pub mod sweep;
pub mod watch;

pub use case::{Approach, Case};
pub use defaults::{Defaults, EncounterDefaults, OffsetDefaults};
pub use error::{CompareError, FailureKind};

pub use method::Method;
pub use model::{BEM_TABLE_TOLERANCE, EXACT_TABLE_TOLERANCE, Model};
pub use model_options::{ModelOptions, Reads};
pub use no_run::{FAILED, NoRun, SKIPPED};
pub use numbers::{Numbers, parse_numbers};
pub use output::{OutputFolder, csv_text};
pub use scene_file::{Family, FamilyScene, Mistake, Mistakes, SceneFile};
pub use study::encounters::{Encounter, EncounterRow, encounters};
pub use study::offset::{OffsetRow, offsets, with_offsets};
pub use study::{
    ComparisonRow, LoadErrorRow, LoadRow, MeshErrorRow, SlopeRow, comparison, contact_slopes,
    load_errors, load_rows, mesh_errors,
};
