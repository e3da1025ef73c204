//! Stresslets and rates of work at some gaps, each with an error estimate.

use rayon::prelude::*;
use scene::Gap;
use serde::Serialize;

use super::for_comparison;
use crate::columns::columns;
use crate::numbers::size;
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, ModelOptions};

columns! {
    /// A row for each method, ratio of the radii, gap and number. The numbers are pure; `docs/FLUID.md` defines their names: stresslets by
    /// motion (`XG`, `YG`, `YH`) and by slip (`XS`, `YS`, `ZS`), rates of work of slip (`XP`, `YP`, `ZP`). Where radii are unlike, names have the
    /// number of the loaded sphere and that of the active one.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct StressRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Radius of sphere 2 over that of sphere 1.
        #[unit = "-"]
        pub ratio: f64,
        /// Gap between the surfaces of the spheres.
        #[unit = "a"]
        pub gap: f64,
        /// Name of the number.
        #[unit = "-"]
        pub name: String,
        /// The number.
        #[unit = "-"]
        pub value: f64,
        /// Estimate of its error, divided by the number or by 1, whichever is larger: the difference by exact hydrodynamics from series of 1.5 times the
        /// terms, by boundary elements from the
        /// mesh one level coarser (finer, where that does not resolve the gap), and at least rounding.
        #[unit = "-"]
        pub error_estimate: String,
    }
}

/// Stresslets and rates of work by each method at each gap, for each ratio of radii in `options`, by the squirming modes 1 to `modes.0` and the
/// swirl modes 1 to `modes.1`.
///
/// # Errors
/// [`CompareError`] for a method that has none, a gap outside the range of a model, or a solve that fails.
pub fn stress_rows(
    methods: &[Method],
    gaps: &[Gap],
    modes: (usize, usize),
    options: &ModelOptions,
) -> Result<Vec<StressRow>, CompareError> {
    let mut rows = Vec::new();
    for &method in methods {
        for &ratio in &options.ratios {
            let model = method.fluid(options, ratio)?;
            let progress = Progress::begin("gaps", gaps.len(), Pieces::Alike);
            let at = |gap: &Gap| {
                let (squirming, swirl) = modes;
                let named = model.stresses(*gap, squirming, swirl)?.named(ratio);
                let other = for_comparison(method, options, ratio, *gap)?;
                let others = (other.as_ref())
                    .map(|other| other.stresses(*gap, squirming, swirl))
                    .transpose()?
                    .map(|of| of.named(ratio));
                progress.advance();
                let row = |(place, (name, value)): (usize, (String, f64))| {
                    let other = others.as_ref().and_then(|of| of.get(place));
                    let error = other.map(|(_, other)| {
                        let error = (value - other).abs() / value.abs().max(1.0);
                        size(error.max(f64::EPSILON))
                    });
                    StressRow {
                        method,
                        ratio,
                        gap: gap.eps(),
                        name,
                        value,
                        error_estimate: error.unwrap_or("none".to_owned()),
                    }
                };
                Ok::<_, CompareError>(named.into_iter().enumerate().map(row).collect::<Vec<_>>())
            };
            let of_gaps = (gaps.par_iter().map(at)).collect::<Result<Vec<_>, _>>()?;
            rows.extend(of_gaps.into_iter().flatten());
        }
    }
    Ok(rows)
}
