//! What is in a scene of two squirmers, and how it moves.
//!
//! Two equal spheres alone in a Stokes fluid: all hydrodynamics depends on one number, the
//! [`Gap`]. A hydrodynamic model ([`Hydrodynamics`]) is a function from the gap to the
//! [`PairLoads`]; the force balance ([`balance`]) and the motion ([`motion`]) are the same for all
//! of them. [`Tabulated`] makes any model, however dear, as cheap as a closed form.
//!
//! Units: radius 1, viscosity 1, swimming speed of order 1; definitions and signs of all loads are
//! in [`loads`]. A name that ends in `_rad` holds radians (or radians per unit of time), one that ends in `_deg` degrees.
//! Vectors are those of [`nalgebra`], which this crate hands on: `use scene::nalgebra::Vector3`.

pub mod active_loads;
pub mod balance;
mod chebyshev;
mod effects;
pub mod elementary;
mod error;
mod fluid;
mod frame;
mod gap;
mod hydrodynamics;
mod isolated;
mod legendre;
mod load_set;
pub mod loads;
#[cfg(test)]
mod made;
pub mod mobility;
pub mod motion;
pub mod ode;
mod plan;
mod ratio;
mod scene;
pub mod singular;
mod squirmer;
pub mod stress;
pub mod swirl;
mod tabulated;

/// The version of nalgebra whose vectors are in this crate's types.
pub use nalgebra;

pub use active_loads::{ActiveLoads, jeffrey_onishi};
pub use effects::{Gravity, Repulsion};
pub use error::{ModelFailure, SceneError};
pub use fluid::{Flow, Fluid, FluidState, MovingPair};
pub use frame::{Configuration, Rates};
pub use gap::Gap;
pub use hydrodynamics::{GapRange, Hydrodynamics, ModelDescription};
pub use isolated::Isolated;
pub use legendre::{Legendre, legendre};
pub use load_set::{LoadSet, Parities};
pub use loads::{MAX_MODES, ModeLoads, PairLoads, SelfOther};
pub use motion::{
    BoundState, Counters, Outcome, Perturbation, Run, RunOptions, Sample, TangentRun, Variation,
    bound_states, far_drift, from_infinity, rates, rates_monomorphic, run, run_monomorphic,
    run_observed, run_plan, run_with_tangents, run_with_tangents_by_ratio, turned_to_infinity,
};
pub use plan::{NeededLoads, Plan, PlanRow, State, SymmetryClass};
pub use ratio::{RATIOS, are_unlike, checked_ratio};
pub use scene::{Orientation, Pose, Scene};
pub use squirmer::Squirmer;
pub use swirl::{SwirlLoads, SwirlModeLoads};
pub use tabulated::{BuildProgress, FAR_GAP, TableLimit, TableOptions, TableSummary, Tabulated};
