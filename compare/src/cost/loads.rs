//! Error of the loads at a gap, or of the mobilities in a table, against the time of one evaluation.

use bem::Bem;
use exact::Exact;
use lt::{Form, Lubrication};
use scene::balance;
use scene::mobility::{Mobility, MobilitySet};
use scene::{Gap, Hydrodynamics, PairLoads, SceneError};

use super::tables::{Built, Tables};
use super::timing::timed;
use super::{CostOptions, CostRow, LOADS, Part};
use crate::{CompareError, Method};

/// Gaps at which loads are compared with the reference, in radii.
const GAPS: [f64; 4] = [1.0, 0.1, 0.01, 0.001];

/// Factors by which the number of terms of the series is multiplied.
const TERMS: [f64; 5] = [0.25, 0.35, 0.5, 0.7, 1.0];

/// The factor of the number of terms for the reference.
pub(super) const REFEREE_TERMS: f64 = 1.5;

pub(super) fn measure(
    options: &CostOptions,
    tables: &Tables,
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    let referee = Exact::with_terms(REFEREE_TERMS).map_err(SceneError::from)?;
    let levels = (1..=options.highest_level())
        .map(Bem::new)
        .collect::<Result<Vec<_>, _>>()?;
    for eps in GAPS {
        let gap = Gap::new(eps)?;
        let loads = (referee.series_loads(gap, LOADS)).map_err(SceneError::from)?;
        let mobility = balance::solve(gap, &loads, READ);
        let at = At {
            gap,
            loads: loads.named(),
            mobilities: mobility.named(READ),
        };
        for (method, form) in [
            (Method::Lt, Form::Published),
            (Method::LtCorrected, Form::Corrected),
        ] {
            let model = Lubrication::new(form);
            rows.push(at.row(method.name(), ("none", f64::NAN), || {
                model.loads(gap, LOADS)
            }));
        }
        for factor in TERMS {
            let model = Exact::with_terms(factor).map_err(SceneError::from)?;
            rows.push(at.row("exact", ("terms factor", factor), || {
                Ok(model.series_loads(gap, LOADS)?)
            }));
        }
        for built in tables.exact.iter().chain(&tables.bem) {
            rows.push(at.table_row(built));
        }
        for model in &levels {
            let knob = ("level", model.level() as f64);
            let before = model.solves();
            let mut row = at.row("bem", knob, || model.loads(gap, LOADS));
            // `timed` adds a warm-up call, unless the call is so slow that it runs only once.
            let warm_up = if row.repeats > 1 { 1 } else { 0 };
            row.solves = (model.solves() - before) as f64 / (row.repeats + warm_up) as f64;
            rows.push(row);
        }
    }
    Ok(())
}

/// Loads or mobilities with their names.
type Named = Vec<(String, f64)>;

/// All mobilities that follow from the loads.
const READ: MobilitySet = MobilitySet {
    loads: LOADS,
    torque: true,
};

/// A gap with the reference.
struct At {
    gap: Gap,
    loads: Named,
    mobilities: Named,
}

impl At {
    fn row(
        &self,
        model: &str,
        knob: (&str, f64),
        loads: impl Fn() -> Result<PairLoads, SceneError>,
    ) -> CostRow {
        self.timed_row(model, knob, loads, |loads| {
            errors(&loads.named(), &self.loads)
        })
    }

    /// Tables hold mobilities instead of loads.
    fn table_row(&self, built: &Built) -> CostRow {
        // The gap comes from its logarithm, as in a trajectory.
        let ln_gap = self.gap.ln();
        let knob = ("table tolerance", built.tolerance);
        let mobility = || (built.table).mobility(Gap::from_ln(std::hint::black_box(ln_gap)), READ);
        let errors = |mobility: &Mobility| errors(&mobility.named(READ), &self.mobilities);
        let mut row = self.timed_row(&built.name, knob, mobility, errors);
        row.set_up_seconds = built.seconds;
        row.loads = built.table.summary().evaluations as f64;
        row
    }

    /// The time of one evaluation, and its largest and root-mean-square error.
    fn timed_row<T>(
        &self,
        model: &str,
        knob: (&str, f64),
        evaluation: impl Fn() -> Result<T, SceneError>,
        errors: impl Fn(&T) -> (f64, f64),
    ) -> CostRow {
        let mut row = CostRow::new(Part::Loads, model, knob, self.gap.eps().to_string());
        let (found, timing) = timed(evaluation);
        if let Ok(found) = found {
            (row.error, row.error_rms) = errors(&found);
            row.seconds = timing.seconds;
            row.repeats = timing.repeats;
        }
        row
    }
}

/// Largest and root-mean-square error, relative to the larger of the reference and 1.
fn errors(found: &[(String, f64)], reference: &[(String, f64)]) -> (f64, f64) {
    let errors: Vec<f64> = (found.iter().zip(reference))
        .map(|((_, found), (_, expected))| (found - expected).abs() / expected.abs().max(1.0))
        .collect();
    let squares: f64 = errors.iter().map(|e| e * e).sum();
    let largest = errors.iter().copied().fold(0.0, f64::max);
    (largest, (squares / errors.len() as f64).sqrt())
}
