//! Shares of outcomes over the incoming angles by exact loads.

use rayon::prelude::*;
use scene::RunOptions;

use crate::study::maps::{FateRow, Grid, Pair, ScatterRow, fates_of, scatter_row};
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Model};

/// Points a side of the grid of incoming angles, from 0.01 to 1.99 in `Delta` and `Sigma`.
pub const SHARES_GRID: usize = 100;

/// The shares for squirmers with each of `betas`, without gravity, by the model `exact`.
///
/// # Errors
/// Never: the grid is one that is allowed.
pub fn shares(exact: &Model, betas: &[f64]) -> Result<Vec<FateRow>, CompareError> {
    let sides = Grid::new(SHARES_GRID)?.values();
    let progress = Progress::begin(
        "lines of shares.csv",
        betas.len() * sides.len(),
        Pieces::Unlike,
    );
    let options = RunOptions::default();
    let of = |&beta: &f64| {
        let pair = Pair {
            beta,
            g: 0.0,
            dz: 0.0,
        };
        let line = |&sigma: &f64| -> Vec<ScatterRow> {
            let points = sides.iter().map(|&delta| (delta, sigma));
            let rows = points.map(|point| scatter_row(exact, pair, point, &options));
            let rows = rows.collect();
            progress.advance();
            rows
        };
        let rows: Vec<ScatterRow> = sides.par_iter().flat_map_iter(line).collect();
        fates_of(exact, pair, &rows)
    };
    Ok(betas.iter().map(of).collect())
}
