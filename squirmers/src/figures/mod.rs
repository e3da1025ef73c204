//! Pictures as SVG. Each figure has a file here; all use the same `canvas` and `style`.
//!
//! A new figure is a function from rows to SVG text, and a section of the page.
//!
//! A panel without data shows "no data". A picture without any runs, kept paths or measurements is
//! [`FigureError::Empty`].

mod canvas;
mod cargo;
mod deflection;
#[cfg(test)]
mod empty_tests;
mod fates;
mod flow;
mod growth;
mod heat;
mod judge;
mod kinetics;
mod load_errors;
mod map;
mod number;
mod offset;
mod panels;
mod range;
mod ratios;
mod scene_run;
mod sensitivity;
mod streamlines;
mod stress;
mod style;
#[cfg(test)]
mod tests;
mod trajectories;
mod trust;
mod work_precision;

use std::fmt::Display;

use thiserror::Error;

use compare::{Approach, Method};

use number::number;

pub use cargo::cargo;
pub use deflection::deflection;
pub use fates::fates;
pub use flow::flow;
pub use growth::{GrowthMap, growth};
pub use judge::{judged_errors, score_against_time, trusted_gaps};
pub use kinetics::kinetics;
pub use load_errors::load_errors;
pub use map::scatter;
pub use offset::offset;
pub use panels::panels;
pub use ratios::ratios;
pub use scene_run::scene_run;
pub use sensitivity::sensitivity;
pub use stress::{stress_by_gap, stress_run};
pub use trajectories::trajectories;
pub use trust::{trust, trust_against_offset};
pub use work_precision::{deflections_work_precision, loads_work_precision};

/// The reason why there is no picture.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FigureError {
    /// Nothing to draw.
    #[error("nothing to draw: {what}")]
    Empty {
        /// What is missing.
        what: &'static str,
    },
    /// The runs belong to two approaches.
    #[error("one picture shows one approach, not both {first} and {other}")]
    MixedApproaches {
        /// The approach of the first encounter.
        first: Approach,
        /// Another approach.
        other: Approach,
    },
    /// The pixels of a map could not be written.
    #[error("cannot encode the map: {reason}")]
    Encoding {
        /// The encoder's message.
        reason: String,
    },
}

impl FigureError {
    fn encoding(error: impl Display) -> Self {
        Self::Encoding {
            reason: error.to_string(),
        }
    }
}

/// The distinct values in ascending order.
fn distinct(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().map(|v| v + 0.0).collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| a.total_cmp(b).is_eq());
    values
}

/// Whether two parameters are equal.
fn same(a: f64, b: f64) -> bool {
    (a + 0.0).total_cmp(&(b + 0.0)).is_eq()
}

/// The distinct methods in the order of the command line.
fn methods(all: impl IntoIterator<Item = Method>) -> Vec<Method> {
    let mut methods: Vec<Method> = all.into_iter().collect();
    methods.sort();
    methods.dedup();
    methods
}

/// Title of an approach in pictures.
fn approach_title(approach: Approach) -> &'static str {
    match approach {
        Approach::HeadOn => "Opposed approach",
        Approach::Orthogonal => "Approach at right angles",
    }
}
