//! The tables that are measured, with the time to build each.

use std::sync::Arc;

use std::time::Instant;

use bem::Bem;
use exact::Exact;
use scene::{Hydrodynamics, TableOptions, Tabulated};

use super::{CostOptions, LOADS};
use crate::model::AnyModel;
use crate::watch::{Pieces, Progress};
use crate::{BEM_TABLE_TOLERANCE, CompareError, EXACT_TABLE_TOLERANCE};

/// Smallest gap of the tables that only this measurement reads, in radii. Repulsion keeps the paper's pairs at larger
/// gaps. At much smaller gaps the noise of the series is above the tolerance of the reference, whose table would never
/// be finished.
const SMALLEST_GAP: f64 = 5e-4;

/// Tolerances of the exact tables; the last one is that of the reference.
const EXACT_TOLERANCES: [f64; 4] = [1e-3, 1e-6, EXACT_TABLE_TOLERANCE, 1e-10];

/// Tolerances of the tables of boundary elements at the lowest level. Other levels have only the last tolerance.
const BEM_TOLERANCES: [f64; 3] = [1e-2, 1e-4, BEM_TABLE_TOLERANCE];

/// A table, and the time to build it.
pub(super) struct Built {
    /// Name of the table in the rows.
    pub(super) name: String,
    /// Level of the boundary elements; 0 for the series.
    pub(super) level: usize,
    pub(super) table: Tabulated,
    pub(super) tolerance: f64,
    pub(super) seconds: f64,
}

/// All tables that are measured.
pub(super) struct Tables {
    /// Tables of the exact series, sorted by falling tolerance.
    pub(super) exact: Vec<Built>,
    /// Tables of boundary elements, sorted by level and falling tolerance.
    pub(super) bem: Vec<Built>,
}

impl Tables {
    pub(super) fn build(options: &CostOptions) -> Result<Self, CompareError> {
        let exact = EXACT_TOLERANCES.map(|tolerance| {
            // At the commands' tolerance this is the commands' table, at all gaps.
            let usual = tolerance.total_cmp(&EXACT_TABLE_TOLERANCE).is_eq();
            let exact = Exact::new();
            let from = if usual {
                exact.range().smallest
            } else {
                SMALLEST_GAP
            };
            build(Arc::new(exact), 0, tolerance, from)
        });
        let mut bem = Vec::new();
        for (number, &level) in options.table_levels().iter().enumerate() {
            let from = if number == 0 && !options.quick {
                0
            } else {
                BEM_TOLERANCES.len() - 1
            };
            for &tolerance in &BEM_TOLERANCES[from..] {
                bem.push(build(
                    Arc::new(Bem::new(level)?),
                    level,
                    tolerance,
                    SMALLEST_GAP,
                )?);
            }
        }
        Ok(Self {
            exact: exact.into_iter().collect::<Result<_, _>>()?,
            bem,
        })
    }

    /// The exact table that the commands use.
    pub(super) fn usual_exact(&self) -> &Built {
        &self.exact[EXACT_TOLERANCES.len() - 2]
    }

    /// The reference table: it replaces the exact series when errors of deflections are measured.
    pub(super) fn referee(&self) -> &Tabulated {
        &self.exact[EXACT_TOLERANCES.len() - 1].table
    }

    /// The table with the smallest tolerance for each level of boundary elements.
    pub(super) fn usual_bem(&self) -> impl Iterator<Item = &Built> {
        (self.bem.iter()).filter(|built| built.tolerance <= BEM_TABLE_TOLERANCE)
    }
}

fn build(
    model: AnyModel,
    level: usize,
    tolerance: f64,
    smallest_gap: f64,
) -> Result<Built, CompareError> {
    let started = Instant::now();
    let options = TableOptions {
        set: LOADS,
        tolerance,
        smallest_gap,
    };
    let progress = Progress::begin("a table to measure", 0, Pieces::Gaps);
    let table = Tabulated::build(model, options, &|table| progress.follow(table))?;
    drop(progress);
    let name = match level {
        0 => "exact-table".to_owned(),
        level => format!("bem-{level}-table"),
    };
    Ok(Built {
        name,
        level,
        table,
        tolerance,
        seconds: started.elapsed().as_secs_f64(),
    })
}
