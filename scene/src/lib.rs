//! What is in a scene of two squirmers, and how it moves.

mod error;
mod gap;
mod hydrodynamics;
pub mod loads;

pub use error::SceneError;
pub use gap::Gap;
pub use hydrodynamics::{GapRange, Hydrodynamics};
pub use loads::{MAX_MODES, ModeLoads, PairLoads, SelfOther};
