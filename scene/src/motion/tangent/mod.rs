//! The linearised motion beside a run: how the end of a run changes with its start and with the numbers of its scene, to first order.
//!
//! A run in three dimensions says of which phases it consists. Each is integrated again together with its linearisation (`linearised.rs`), contacts under
//! the run's model and flights without interaction; where one gives way to the next at the cut of a model, the time at which that happens
//! changes too, and with it the state (saltation).

mod linearised;
mod off_plane;
mod path;
mod perturbation;
mod response;
mod run;
mod velocity;

pub(in crate::motion) use off_plane::off_plane;
pub use perturbation::{Perturbation, Variation};
pub use run::{TangentRun, run_with_tangents, run_with_tangents_by_ratio};

#[cfg(test)]
mod tests;
