//! Pictures as SVG: one file a figure, all on the same `canvas` and in the same `style`.
//!
//! A new figure is a function from rows to SVG text beside these, and a section of the page.

mod canvas;
mod deflection;
mod fates;
mod heat;
mod load_errors;
mod map;
mod offset;
mod panels;
mod scene_run;
mod style;
#[cfg(test)]
mod tests;
mod trajectories;
mod trust;
mod work_precision;

use std::fmt::Display;

use thiserror::Error;

use crate::{Approach, Method};

pub use deflection::deflection;
pub use fates::fates;
pub use load_errors::load_errors;
pub use map::scatter;
pub use offset::offset;
pub use panels::{ARROW_INTERVAL, panels};
pub use scene_run::scene_run;
pub use trajectories::{TICK_INTERVAL, trajectories};
pub use trust::{trust, trust_against_offset};
pub use work_precision::{deflections_work_precision, loads_work_precision};

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FigureError {
    /// Nothing to draw.
    #[error("nothing to draw: {what}")]
    Empty {
        /// What is missing.
        what: &'static str,
    },
    /// Two approaches in one picture.
    #[error("one picture shows one approach, not both {first} and {other}")]
    MixedApproaches {
        /// The approach of the first encounter.
        first: Approach,
        /// Another one.
        other: Approach,
    },
    /// The plotting library refused.
    #[error("cannot draw: {reason}")]
    Drawing {
        /// What it said.
        reason: String,
    },
}

impl FigureError {
    fn drawing(error: impl Display) -> Self {
        Self::Drawing {
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

/// Whether two numbers of a case are the same number.
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

/// A number without trailing zeros and with a true minus sign.
fn number(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6 + 0.0;
    rounded.to_string().replace('-', "\u{2212}")
}

/// `Head-on approach`, `Orthogonal approach`.
fn approach_title(approach: Approach) -> &'static str {
    match approach {
        Approach::HeadOn => "Head-on approach",
        Approach::Orthogonal => "Orthogonal approach",
    }
}

/// `10⁻³` for -3; nothing between whole powers.
fn power_of_ten(exponent: f64) -> String {
    if (exponent - exponent.round()).abs() > 1e-6 {
        return String::new();
    }
    let plain = number(exponent.round());
    let raised = plain.chars().map(|c| match c {
        '\u{2212}' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' | '4'..='9' => char::from_u32('⁰' as u32 + c as u32 - '0' as u32).unwrap_or(c),
        other => other,
    });
    "10".chars().chain(raised).collect()
}
