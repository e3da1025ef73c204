//! What the workspace tests share: published tables, a tolerant comparison of CSV text, cases.

mod close_csv;
mod published;

pub use close_csv::{CloseCsv, TOLERANCE, close};
pub use published::{ResistanceRow, two_sphere_resistance};
