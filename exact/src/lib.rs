//! The referee: loads of two squirming spheres to about ten digits, for every gap.
//!
//! Bispherical coordinates turn Stokes flow about two spheres into recurrences between neighbouring
//! degrees: [`Exact`] solves them as banded systems, so that the thousands of terms that close
//! spheres need cost milliseconds. Near contact and far apart the series' own limiting forms take
//! over. Equal spheres have two systems, one for each parity of the mirror between them; unlike ones
//! ([`Exact::of_ratio`], radius ratios from 0.01 to 100) have one for both.
//!
//! Units, signs and names of the loads are those of [`scene::loads`].

mod axial;
mod banded;
mod error;
mod far_field;
mod field;
mod fit;
mod fluid;
mod geometry;
mod kinds;
mod model;
mod near_contact;
mod series;
mod stencil;
mod surface;
mod system;
mod transverse;
mod twist;
mod unlike;

#[cfg(test)]
mod reciprocal_theorem;

pub use error::ExactError;
pub use far_field::SERIES_TO;
pub use model::Exact;
pub use near_contact::SERIES_FROM;
