//! Two spheres in the pair frame: sphere 1 at the origin, sphere 2 on the side of `+z`.
//!
//! Of equal spheres the mirrors x and y and the swap (sphere 2 is sphere 1 mirrored in the plane between them) split
//! the dense system into eight by parity. Six carry load, three kinds of motion times two swaps:
//!
//! | | x | y | loads |
//! |---|---|---|---|
//! | [`Motion::Axial`] | + | + | XA, XF |
//! | [`Motion::Transverse`] | - | + | YA, YB, YC, YF, YT, YFC, YTC |
//! | [`Motion::Twist`] | - | - | XC, XTC |
//!
//! The two more are [`Motion::Sideways`], transverse motions a quarter turn on: any velocity of the surfaces has a part in each of the eight.
//!
//! Only vertices of sphere 1 with `x >= 0`, `y >= 0` are unknowns, so each system has about an eighth
//! of the full one's unknowns, and takes 1/512 of its factorisation. Classes that a set of
//! loads does not call for are not assembled.
//!
//! Spheres of unlike radii have the mirrors x and y alone: three systems, each with the unknowns of both spheres.

mod active;
mod assembly;
mod condition;
mod equal;
mod parity;
mod response;
mod side;
mod solution;
mod systems;
mod unlike;

pub use condition::Condition;
pub use equal::{conditions, solve};
pub use parity::{Motion, Parity, Swap};
pub use solution::{EachSolution, PairSolution, Seconds};
pub(crate) use systems::{Densities, Systems, Velocities};
pub use unlike::{UnlikeMeshes, conditions_unlike, solve_unlike};
