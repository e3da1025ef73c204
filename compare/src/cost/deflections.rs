//! Error of the outgoing angles against the time of a trajectory, for several tolerances of the integrator.
//!
//! The reference trajectory uses a table of the exact series, as accurate as the rounding noise of the series allows,
//! and a much smaller tolerance. Each model also has a trajectory with this small tolerance. Its difference from the
//! reference is the model error. The difference of the measured trajectory from it is the integration error. For a
//! model that solves for every load, this trajectory uses a table of the model, which equals the model's loads to
//! [`BEM_TABLE_TOLERANCE`](crate::BEM_TABLE_TOLERANCE) or better.

use std::time::Instant;

use bem::Bem;
use exact::Exact;
use lt::{Form, Lubrication};
use scene::{Gap, Hydrodynamics, Outcome, Run, RunOptions, Scene, SceneError};

use super::tables::Tables;
use super::timing::timed;
use super::{CostOptions, CostRow, LOADS, Part, run_lubrication};
use crate::{Approach, Case, CompareError, Defaults, Method};

/// Tolerances of the integrator for models in closed form and with a table.
const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// Tolerances of the integrator for models that solve for every load: the series, and boundary elements.
const SERIES_TOLERANCES: &[f64] = &[1e-4, 1e-6];
const BEM_TOLERANCES: &[f64] = &[1e-4];

/// Tolerance of the integrator for the reference.
const REFEREE: f64 = 1e-13;

/// Runs a scene at a tolerance, through the loop by which the commands run the model.
type RunAt<'a> = Box<dyn Fn(&Scene, f64) -> Result<Run, SceneError> + 'a>;

/// A model to measure.
struct Entrant<'a> {
    name: String,
    /// Seconds to build its table; for a model without a table, seconds of one solve.
    set_up_seconds: f64,
    run: RunAt<'a>,
}

impl<'a> Entrant<'a> {
    fn lubrication(method: Method, model: &'a Lubrication) -> Self {
        Self {
            name: method.name().to_owned(),
            set_up_seconds: 0.0,
            run: Box::new(move |scene, tolerance| run_lubrication(scene, model, &at(tolerance))),
        }
    }

    fn new(name: impl Into<String>, set_up_seconds: f64, model: &'a dyn Hydrodynamics) -> Self {
        Self {
            name: name.into(),
            set_up_seconds,
            run: Box::new(move |scene, tolerance| scene::run(scene, model, &at(tolerance))),
        }
    }
}

fn at(tolerance: f64) -> RunOptions {
    RunOptions {
        tolerance,
        ..RunOptions::default()
    }
}

pub(super) fn measure(
    options: &CostOptions,
    tables: &Tables,
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    let forms = [Form::Published, Form::Corrected].map(Lubrication::new);
    let exact = tables.usual_exact();
    let mut entrants = vec![
        Entrant::lubrication(Method::Lt, &forms[0]),
        Entrant::lubrication(Method::LtCorrected, &forms[1]),
        Entrant::new("exact-table", exact.seconds, &exact.table),
    ];
    for built in tables.usual_bem() {
        entrants.push(Entrant::new(&*built.name, built.seconds, &built.table));
    }
    let cases = Defaults::paper_encounters()?;
    let mut references = Vec::with_capacity(cases.len());
    for case in &cases {
        let scene = case.scene()?;
        let reference = scene::run(&scene, tables.referee(), &at(REFEREE))?;
        let mut tightest = Vec::new();
        for entrant in &entrants {
            let tight = (entrant.run)(&scene, REFEREE);
            for tolerance in TOLERANCES {
                let (found, timing) = timed(|| (entrant.run)(&scene, tolerance));
                let mut row = row(&entrant.name, tolerance, case);
                row.set_up_seconds = entrant.set_up_seconds;
                row.repeats = timing.repeats;
                fill(&mut row, timing.seconds, &found, &tight, &reference);
                rows.push(row);
            }
            tightest.push((entrant.name.clone(), tight));
        }
        references.push(Reference {
            case: *case,
            scene,
            run: reference,
            tightest,
        });
    }
    // The typical case comes first, because the time limit may leave out the last cases.
    references.sort_by_key(|reference| !is_typical(&reference.case));
    direct(options, tables, &references, rows)
}

/// The trajectories with which those of a case are compared.
struct Reference {
    case: Case,
    scene: Scene,
    /// The reference trajectory.
    run: Run,
    /// For each model with a table, its name and its trajectory with the smallest tolerance.
    tightest: Vec<(String, Result<Run, SceneError>)>,
}

impl Reference {
    /// The trajectory with the smallest tolerance by the table of `model`.
    fn tightest(&self, model: &str) -> Result<Run, SceneError> {
        let name = format!("{model}-table");
        let found = self.tightest.iter().find(|(of, _)| *of == name);
        found.map_or(Err(UNKNOWN), |(_, run)| run.clone())
    }
}

/// The error in place of a trajectory that was not computed.
const UNKNOWN: SceneError = SceneError::NotFinite {
    what: "tight trajectory of a model without a table",
    value: f64::NAN,
};

/// A model that solves for every load.
struct Direct<'a> {
    entrant: Entrant<'a>,
    tolerances: &'static [f64],
    /// Whether it runs in every case, or only in the typical one.
    everywhere: bool,
}

/// Trajectories in which every load is solved for. The expected time is the time of one solve times the number of
/// loads that a tabulated trajectory reads. A trajectory that would exceed the time allowed for all of them is left
/// out, and its row has NaN.
fn direct(
    options: &CostOptions,
    tables: &Tables,
    references: &[Reference],
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    let exact = Exact::new();
    let levels = (tables.usual_bem())
        .map(|built| Bem::new(built.level))
        .collect::<Result<Vec<_>, _>>()?;
    let mut models = vec![Direct {
        entrant: Entrant::new("exact", seconds_of_solve(&exact)?, &exact),
        tolerances: SERIES_TOLERANCES,
        everywhere: true,
    }];
    for bem in &levels {
        let name = format!("bem-{}", bem.level());
        models.push(Direct {
            entrant: Entrant::new(name, seconds_of_solve(bem)?, bem),
            tolerances: BEM_TOLERANCES,
            everywhere: bem.level() == COARSE_LEVEL,
        });
    }
    let started = Instant::now();
    for reference in references {
        for Direct {
            entrant,
            tolerances,
            everywhere,
        } in &models
        {
            if !(*everywhere || is_typical(&reference.case)) {
                continue;
            }
            let tight = reference.tightest(&entrant.name);
            for &tolerance in *tolerances {
                let alike = scene::run(&reference.scene, tables.referee(), &at(tolerance))?;
                let expected = entrant.set_up_seconds * alike.counters.loads as f64;
                let mut row = row(&entrant.name, tolerance, &reference.case);
                row.set_up_seconds = 0.0;
                if started.elapsed().as_secs_f64() + expected <= options.direct_limit() {
                    let began = Instant::now();
                    let found = (entrant.run)(&reference.scene, tolerance);
                    let seconds = began.elapsed().as_secs_f64();
                    row.repeats = 1;
                    fill(&mut row, seconds, &found, &tight, &reference.run);
                }
                rows.push(row);
            }
        }
    }
    Ok(())
}

/// Level of the boundary elements that run every case without a table. Its loads are accurate to about 1e-3.
pub(super) const COARSE_LEVEL: usize = 1;

/// Seconds of one solve at a gap that is typical of collisions.
fn seconds_of_solve<M: Hydrodynamics>(model: &M) -> Result<f64, SceneError> {
    let gap = Gap::new(0.01)?;
    // The first solve also fits the limiting forms, once; this is not part of the measured time.
    model.loads(Gap::new(1e3)?, LOADS)?;
    model.loads(gap, LOADS)?;
    let started = Instant::now();
    model.loads(gap, LOADS)?;
    Ok(started.elapsed().as_secs_f64())
}

/// Whether this is the typical collision of Fig. 6, which is neither the closest one nor a near miss.
fn is_typical(case: &Case) -> bool {
    case.approach == Approach::HeadOn && (case.dx - 2.0).abs() < 0.5
}

fn row(model: &str, tolerance: f64, case: &Case) -> CostRow {
    let Case {
        approach, beta, dx, ..
    } = case;
    let name = format!("{approach} beta {beta} dx {dx}");
    CostRow::new(Part::Deflection, model, ("tolerance", tolerance), name)
}

/// Fills in errors, counters and time if the run has a result.
fn fill(
    row: &mut CostRow,
    seconds: f64,
    found: &Result<Run, SceneError>,
    tight: &Result<Run, SceneError>,
    reference: &Run,
) {
    let Ok(found) = found else { return };
    row.seconds = seconds;
    row.steps = found.counters.steps as f64;
    row.rejected = found.counters.rejected as f64;
    row.loads = found.counters.loads as f64;
    (row.error, row.error_rms) = difference(found, reference);
    if let Ok(tight) = tight {
        row.model_error = difference(tight, reference).0;
        row.integration_error = difference(found, tight).0;
    }
}

/// Largest and root-mean-square difference of the two outgoing angles, in degrees. NaN unless both pairs parted,
/// because a bound pair has no outgoing angles.
fn difference(found: &Run, reference: &Run) -> (f64, f64) {
    let parted = |run: &Run| run.outcome == Outcome::Scattered;
    if !(parted(found) && parted(reference)) {
        return (f64::NAN, f64::NAN);
    }
    let [a, b] = [0, 1].map(|k| {
        (found.deflections_rad()[k] - reference.deflections_rad()[k])
            .to_degrees()
            .abs()
    });
    (a.max(b), (0.5 * (a * a + b * b)).sqrt())
}
