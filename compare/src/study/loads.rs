//! The loads of a pair at some gaps, each with an error estimate.

use bem::Bem;
use scene::{ActiveLoads, Gap, LoadSet, are_unlike};
use serde::Serialize;

use crate::columns::columns;
use crate::numbers::size;
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, Model, ModelOptions};

columns! {
    /// A row for each method, ratio of the radii, gap and load. `scene::loads` defines the loads; they are pure numbers, for
    /// viscosity 1 and radius 1. Where radii are unlike, names have the number of the loaded sphere and that of the sphere that moves or
    /// squirms, whose radius is 1: `X21A` is the load on sphere 2 by sphere 1, `Y21B` the torque on it by
    /// a translation and `Y21B_force` the force by a spin. Equal spheres have those of sphere 1 alone.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct LoadRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Gap between the surfaces of the squirmers.
        #[unit = "a"]
        pub gap: f64,
        /// Name of the load.
        #[unit = "-"]
        pub name: String,
        /// The load.
        #[unit = "-"]
        pub value: f64,
        /// The model's own estimate of its error, divided by the load or by 1, whichever is larger. `none` for a closed
        /// form, which has no estimate.
        #[unit = "-"]
        pub error_estimate: String,
        /// Radius of sphere 2 over that of sphere 1.
        #[unit = "-"]
        pub ratio: f64,
    }
}

/// Name, value and error estimate of a load.
type Estimated = (String, f64, Option<f64>);

/// The loads of a method at a gap.
type Estimator = Box<dyn Fn(Gap) -> Result<Vec<Estimated>, CompareError>>;

/// The loads of `set` by each method at each gap, solved for at each, for each ratio of radii in `options`.
///
/// # Errors
/// [`CompareError`] if a model cannot be set up, a gap is below its range, or a solve fails.
pub fn load_rows(
    methods: &[Method],
    gaps: &[Gap],
    set: LoadSet,
    options: &ModelOptions,
) -> Result<Vec<LoadRow>, CompareError> {
    let options = ModelOptions {
        tabulated: set,
        direct: true,
        ..options.clone()
    };
    let mut rows = Vec::new();
    for &method in methods {
        if let Method::Other(other) = method {
            other.hydrodynamics().foresee(gaps)?;
        }
        for &ratio in &options.ratios {
            let at = estimator(method, ratio, set, &options)?;
            let progress = Progress::begin("gaps", gaps.len(), Pieces::Alike);
            for &gap in gaps {
                rows.extend(at(gap)?.into_iter().map(|(name, value, error)| LoadRow {
                    method,
                    gap: gap.eps(),
                    name,
                    value,
                    error_estimate: error.map_or("none".to_owned(), size),
                    ratio,
                }));
                progress.advance();
            }
        }
    }
    Ok(rows)
}

/// The source of the loads of a method. Boundary elements estimate the error of each load.
fn estimator(
    method: Method,
    ratio: f64,
    set: LoadSet,
    options: &ModelOptions,
) -> Result<Estimator, CompareError> {
    let options = &ModelOptions {
        ratios: vec![ratio],
        ..options.clone()
    };
    if are_unlike(ratio) {
        return estimator_of_each(method, ratio, set, options);
    }
    if method == Method::Bem {
        let bem = Bem::new(options.mesh)?;
        return Ok(Box::new(move |gap| {
            let (solution, estimates) = bem.solve_with_estimates(gap, set)?;
            let values = (solution.loads.named().into_iter()).chain(solution.swirl.named());
            let errors = (estimates.loads.named().into_iter()).chain(estimates.swirl.named());
            Ok(values
                .zip(errors)
                .map(|((name, value), (_, error))| {
                    (name, value, Some(error / value.abs().max(1.0)))
                })
                .collect())
        }));
    }
    let model = Model::set_up(method, options)?;
    Ok(Box::new(move |gap| {
        let (loads, swirl) = model.loads_with_swirl(gap, set)?;
        let error = model.error_estimate(gap, set)?;
        let named = loads.named().into_iter().chain(swirl.named());
        Ok(named.map(|(name, value)| (name, value, error)).collect())
    }))
}

/// The same of unlike radii, by either sphere.
fn estimator_of_each(
    method: Method,
    ratio: f64,
    set: LoadSet,
    options: &ModelOptions,
) -> Result<Estimator, CompareError> {
    let named = |loads: &[ActiveLoads; 2]| -> Vec<(String, f64)> {
        let of_each = loads.iter().zip([1, 2]);
        of_each.flat_map(|(of, active)| of.named(active)).collect()
    };
    if method == Method::Bem {
        let bem = Bem::of_ratio(options.mesh, ratio)?;
        return Ok(Box::new(move |gap| {
            let (solution, estimates) = bem.solve_each_with_estimates(gap, set)?;
            let errors = estimates.map(|of| ActiveLoads {
                pair: of.loads,
                torque_on_other: of.torque_on_other,
                swirl: of.swirl,
            });
            let both = named(&solution.loads).into_iter().zip(named(&errors));
            let row = |((name, value), (_, error)): ((String, f64), (String, f64))| {
                (name, value, Some(error / value.abs().max(1.0)))
            };
            Ok(both.map(row).collect())
        }));
    }
    let model = Model::set_up(method, options)?;
    Ok(Box::new(move |gap| {
        let loads = model.loads_of_each(gap, set)?;
        let error = model.error_estimate(gap, set)?;
        let rows = named(&loads).into_iter();
        Ok(rows.map(|(name, value)| (name, value, error)).collect())
    }))
}
