//! What boundary elements must hold, in one program: its tests run side by side.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod accuracy;
mod far_field;
mod flow;
mod lab;
mod moving;
mod pair;
mod quadrature;
mod slip_modes;
mod starts;
mod stresses;
mod symmetry;
mod unlike;
mod unlike_lab;
