//! Errors of the loads of each method against the exact loads, for gaps from 1e-3 to 100 radii.

use rayon::prelude::*;
use scene::{Gap, LoadSet, SceneError};
use serde::Serialize;

use crate::columns::columns;
use crate::{Method, Model};

columns! {
    /// A row for each method, gap and load. `scene::loads` defines the loads; they are pure numbers, for viscosity 1
    /// and radius 1.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct LoadErrorRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Gap between the surfaces of the squirmers.
        #[unit = "a"]
        pub gap: f64,
        /// Name of the load.
        #[unit = "-"]
        pub name: String,
        /// The load by this method.
        #[unit = "-"]
        pub value: f64,
        /// The load by exact hydrodynamics.
        #[unit = "-"]
        pub exact: f64,
        /// Absolute difference of the two, divided by the exact load or by 1, whichever is larger.
        #[unit = "-"]
        pub error: f64,
    }
}

/// Gaps from 1e-3 to 100 radii, twelve per decade.
fn gaps() -> impl Iterator<Item = f64> {
    (0..=60).map(|i| 10f64.powf(f64::from(i) / 12.0 - 3.0))
}

/// The errors of `models` against `exact` for the loads of `set`, sorted by method.
///
/// Gaps outside a model's range are left out.
///
/// # Errors
/// The errors of the models.
pub fn load_errors(
    models: &[&Model],
    exact: &Model,
    set: LoadSet,
) -> Result<Vec<LoadErrorRow>, SceneError> {
    let gaps: Vec<_> = gaps().collect();
    let pairs: Vec<_> = (models.iter().filter(|m| m.method() != Method::Exact))
        .flat_map(|model| gaps.iter().map(move |&eps| (*model, eps)))
        .collect();
    let rows = pairs
        .into_par_iter()
        .map(|(model, eps)| {
            let gap = Gap::new(eps)?;
            if model.range().check(gap).is_err() {
                return Ok(Vec::new());
            }
            let found = model.loads(gap, set)?.named();
            let truth = exact.loads(gap, set)?.named();
            let row = |((name, value), (_, exact)): ((String, f64), (String, f64))| LoadErrorRow {
                method: model.method(),
                gap: eps,
                name,
                value,
                exact,
                error: (value - exact).abs() / exact.abs().max(1.0),
            };
            Ok(found.into_iter().zip(truth).map(row).collect())
        })
        .collect::<Result<Vec<Vec<_>>, SceneError>>()?;
    Ok(rows.concat())
}

#[cfg(test)]
mod tests;
