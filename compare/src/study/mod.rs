//! Studies: questions about the models. Each file answers one question with rows.

mod comparison;
mod load_errors;
mod loads;
mod mesh_errors;

pub use comparison::{ComparisonRow, comparison};
pub use load_errors::{LoadErrorRow, load_errors};
pub use loads::{LoadRow, load_rows};
pub use mesh_errors::{MeshErrorRow, mesh_errors};
