//! Two equal spheres in the pair frame: sphere 1 at the origin, sphere 2 at `(2 + eps) z`.
//!
//! The mirrors x and y and the swap (sphere 2 is sphere 1 mirrored in the plane between them) split
//! the dense system into eight by parity. Six carry load, three kinds of motion times two swaps:
//!
//! | | x | y | loads |
//! |---|---|---|---|
//! | [`Motion::Axial`] | + | + | XA, XF |
//! | [`Motion::Transverse`] | - | + | YA, YB, YC, YF, YT, YFC, YTC |
//! | [`Motion::Twist`] | - | - | XC, XTC |
//!
//! Only vertices of sphere 1 with `x >= 0`, `y >= 0` are unknowns, so each system has about an eighth
//! of the full one's unknowns, and takes 1/512 of its factorisation. Classes that a set of
//! loads does not call for are not assembled.

mod assembly;
mod loads;
mod parity;

pub use loads::{Condition, PairSolution, Seconds, conditions, solve};
pub use parity::{Motion, Parity, Swap};
