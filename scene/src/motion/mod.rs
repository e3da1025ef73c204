//! The motion of a pair: from a scene and a hydrodynamic model to a trajectory and its outcome.

mod bound;
mod coordinates;
mod equations;
mod free_flight;
mod outcome;
mod run;
mod steady;
mod swirling;

pub use bound::{BoundState, bound_states};
pub use coordinates::Configuration;
pub use outcome::Outcome;
pub use run::{Counters, Run, RunOptions, Sample, run};
