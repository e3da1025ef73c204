//! Two spheres of unlike radii: one system for both, where equal spheres have two parities.

mod across;
mod columns;
mod geometry;
mod limits;
mod lone;
mod lorentz;
mod model;
mod multipole;
mod residual;
mod rounding;
mod series;
mod system;
mod tail;
mod twist;

pub use geometry::Pair;
pub use limits::{Limit, Terms};
pub use lone::put_into_axial_equations;
pub use lorentz::row_slopes;
pub use model::Unlike;
pub use system::{NOMINAL, PairSeries, PairSystem};
