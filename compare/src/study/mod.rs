//! Studies: questions about the models. Each file answers one question with rows.

pub mod cargo;
mod comparison;
pub mod encounters;
pub mod flow;
pub mod kinetics;
mod load_errors;
mod loads;
pub mod maps;
mod mesh_errors;
pub mod offset;
pub mod panels;
pub mod ratios;
pub mod sensitivity;
mod slopes;
pub mod stress;

pub use comparison::{ComparisonRow, comparison};
pub use load_errors::{LoadErrorRow, load_errors};
pub use loads::{LoadRow, load_rows};
pub use mesh_errors::{MeshErrorRow, mesh_errors};
pub use slopes::{SlopeRow, contact_slopes};
