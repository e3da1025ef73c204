//! Compares hydrodynamic models of two squirmers: the paper's encounters, maps and sweeps.
//!
//! One collision by two models:
//!
//! ```
#![doc = include_str!("../examples/one_collision.rs")]
//! ```

pub mod account;
pub mod bottom_heavy;
mod case;
pub mod cost;
mod defaults;
pub mod effects;
pub mod encounter;
mod error;
pub mod hard_cases;
pub mod kept_rows;
mod loads_file;
pub mod maps;
mod method;
mod model;
pub mod numbers;
pub mod output;
pub mod scene_file;
pub mod scene_run;
pub mod study;
pub mod sweep;
pub mod watch;

pub use case::{Approach, Case};
pub use defaults::{Defaults, EncounterDefaults, OffsetDefaults};
pub use encounter::{Encounter, EncounterRow, NoRun, OffsetRow};
pub use error::{CompareError, FailureKind};
pub use loads_file::{LoadsFile, LoadsFileError};
pub use method::Method;
pub use model::{BEM_TABLE_TOLERANCE, EXACT_TABLE_TOLERANCE, Model, ModelOptions};
pub use numbers::{Numbers, parse_numbers};
pub use output::{OutputFolder, csv_text};
pub use scene_file::{Family, FamilyScene, Mistake, Mistakes, SceneFile};
pub use study::{ComparisonRow, LoadErrorRow, MeshErrorRow, comparison, load_errors, mesh_errors};
