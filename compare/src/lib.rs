//! Compares hydrodynamic models of two squirmers on the paper's encounters.
//!
//! One collision by two models:
//!
//! ```
#![doc = include_str!("../examples/one_collision.rs")]
//! ```

mod account;
pub mod bottom_heavy;
mod case;
pub mod cli;
mod comparison;
pub mod cost;
mod defaults;
pub mod effects;
mod encounter;
mod error;
pub mod figures;
mod full_report;
pub mod hard_cases;
mod interrupt;
mod kept_rows;
mod load_errors;
pub mod maps;
mod method;
mod model;
mod numbers;
mod output;
mod pictures;
mod progress;
mod provenance;
pub mod report;
pub mod scene_file;
pub mod scene_run;
mod streams;
pub mod sweep;

pub use case::{Approach, Case};
pub use comparison::{ComparisonRow, comparison};
pub use defaults::{Defaults, EncounterDefaults, OffsetDefaults};
pub use encounter::{Encounter, EncounterRow, NoRun, OffsetRow};
pub use error::CompareError;
pub use load_errors::{LoadErrorRow, load_errors};
pub use method::Method;
pub use model::{BEM_TABLE_TOLERANCE, EXACT_TABLE_TOLERANCE, Model, ModelOptions};
pub use numbers::{Numbers, parse_numbers};
pub use output::{OutputFolder, csv_text};
pub use scene_file::{Mistake, Mistakes, SceneFile};
