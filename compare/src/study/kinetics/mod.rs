//! Collisions in three dimensions, and what they do to a dilute suspension.

mod collider;
mod incoming;
mod integrals;
mod map;
mod points;
mod rows;
mod sweep;
#[cfg(test)]
mod tests;

pub use collider::{Begins, Collider, Outgoing};
pub use incoming::{CONTACT, Contact, Impact, Incoming};
pub use integrals::{
    Coefficients, Kernel, MEAN_SPEED, Means, Quantity, Sums, mean_and_error, rate,
};
pub use map::{CollisionRow, CollisionSweep, Starts};
pub use points::{MOST as MOST_POINTS, point};
pub use rows::{Estimate, KineticsRatioRow, KineticsRow, ratios};
pub use sweep::{KineticsSweep, Sampling};
