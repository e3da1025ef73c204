//! The motion of a pair: from a scene and a hydrodynamic model to a trajectory and its outcome.

mod bound;
mod chart;
mod coordinates;
mod dispatch;
mod equations;
mod far_turn;
mod floor;
mod free_flight;
mod from_infinity;
mod moving;
mod outcome;
mod rates;
mod recorder;
mod result;
mod run;
mod steady;
mod swirling;
mod tangent;
mod unlike;
mod watch;

pub use bound::{BoundState, bound_states};
pub use far_turn::{far_drift, turned_to_infinity};
pub use from_infinity::from_infinity;
pub use outcome::Outcome;
pub use rates::{rates, rates_monomorphic};
pub use result::{Counters, Run, RunOptions, Sample};
pub use run::{run, run_monomorphic, run_observed, run_plan};
pub use tangent::{
    Perturbation, TangentRun, Variation, run_with_tangents, run_with_tangents_by_ratio,
};

#[cfg(test)]
mod tests;
