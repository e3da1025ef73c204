//! The tables of exact loads of equal spheres that runs and bound states read, and those that tell their errors.

use std::sync::Arc;

use exact::Exact;
use scene::{Hydrodynamics, LoadSet, SceneError, TableOptions, Tabulated};

use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, Model, ModelOptions};

/// Tolerance of the table that the numbers are by: it ends at the noise of the series, at 1e-10.
const TOLERANCE: f64 = 1e-11;

/// Terms of the series that tell what the usual number leaves out, over that number.
const MORE_TERMS: f64 = 1.5;

/// The loads that planar motion reads.
const READ: LoadSet = LoadSet::planar(2);

/// Tables of exact loads of equal spheres.
pub struct Tables {
    /// The table that the numbers are by.
    pub finer: Tabulated,
    /// The same of series with more terms, which tells the error of the loads.
    pub more_terms: Tabulated,
    /// The table of the commands, which tells the error of interpolation.
    pub usual: Model,
}

impl Tables {
    /// Builds the tables; the usual one is kept where `options` say.
    ///
    /// # Errors
    /// Those of the exact model and its tables.
    pub fn build(exact: &Exact, options: &ModelOptions) -> Result<Self, CompareError> {
        let more_terms = Exact::with_terms(MORE_TERMS).map_err(SceneError::from)?;
        let usual = ModelOptions {
            tabulated: READ,
            direct: false,
            ratios: vec![1.0],
            ..options.clone()
        };
        Ok(Self {
            finer: table(exact.clone())?,
            more_terms: table(more_terms)?,
            usual: Model::set_up(Method::Exact, &usual)?,
        })
    }
}

fn table(exact: Exact) -> Result<Tabulated, CompareError> {
    let options = TableOptions {
        set: READ,
        tolerance: TOLERANCE,
        smallest_gap: exact.range().smallest,
    };
    let progress = Progress::begin("fine table of exact loads", 0, Pieces::Gaps);
    let follow = |table| progress.follow(table);
    Ok(Tabulated::build(Arc::new(exact), options, &follow)?)
}
