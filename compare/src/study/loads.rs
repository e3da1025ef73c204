//! The loads of a pair at some gaps, each with an error estimate.

use bem::Bem;
use scene::{Gap, LoadSet};
use serde::Serialize;

use crate::columns::columns;
use crate::numbers::size;
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, Model, ModelOptions};

columns! {
    /// A row for each method, gap and load. `scene::loads` defines the loads; they are pure numbers, for viscosity 1
    /// and radius 1.
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
    }
}

/// Name, value and error estimate of a load.
type Estimated = (String, f64, Option<f64>);

/// The loads of a method at a gap.
type Estimator = Box<dyn Fn(Gap) -> Result<Vec<Estimated>, CompareError>>;

/// The loads of `set` by each method at each gap, solved for at each.
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
        let at = estimator(method, set, &options)?;
        let progress = Progress::begin("gaps", gaps.len(), Pieces::Alike);
        for &gap in gaps {
            rows.extend(at(gap)?.into_iter().map(|(name, value, error)| LoadRow {
                method,
                gap: gap.eps(),
                name,
                value,
                error_estimate: error.map_or("none".to_owned(), size),
            }));
            progress.advance();
        }
    }
    Ok(rows)
}

/// The source of the loads of a method. Boundary elements estimate the error of each load.
fn estimator(
    method: Method,
    set: LoadSet,
    options: &ModelOptions,
) -> Result<Estimator, CompareError> {
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
