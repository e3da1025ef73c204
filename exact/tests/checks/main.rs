//! What the referee must hold, in one program: its tests run side by side.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod common;
mod convergence;
mod deflections;
mod extended_precision;
mod flow;
mod lamb_collocation;
mod limits;
mod pair;
mod published;
mod published_stresslets;
mod stresses;
mod swirl;
mod unlike_limits;
mod unlike_published;
mod unlike_tables;
mod velocities;
