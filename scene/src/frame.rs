//! Where the two squirmers are: in the laboratory frame, and in the plane that a motion keeps to.

mod configuration;
mod plane;

pub use configuration::{Configuration, Rates};
pub(crate) use configuration::{across, direction, start, unwind};
pub(crate) use plane::Plane;
