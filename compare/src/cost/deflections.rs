//! Error of the outgoing angles against the time of a trajectory, with the stepper's tolerance as
//! the knob.
//!
//! The referee is the exact series read from a table at their own noise, with a much tighter stepper.
//! A model's trajectory with that stepper tells the two parts of its error: how far the tight
//! trajectory is from the referee's is the model's, how far the loose one is from the tight one the
//! integration's. Where every load is solved for, the tight trajectory is that of the same model's
//! table, which is its loads to [`BEM_TABLE_TOLERANCE`](crate::BEM_TABLE_TOLERANCE) or better.

use std::time::Instant;

use bem::Bem;
use exact::Exact;
use lt::{Form, Lubrication};
use scene::{Gap, Hydrodynamics, Outcome, Run, RunOptions, Scene, SceneError};

use super::tables::Tables;
use super::timing::timed;
use super::{CostOptions, CostRow, LOADS, Part, run_any, run_lubrication};
use crate::{Approach, Case, CompareError, Defaults, Method};

/// Tolerances of the stepper.
const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// The same where every load is solved for by the series, and by boundary elements.
const SERIES_TOLERANCES: &[f64] = &[1e-4, 1e-6];
const BEM_TOLERANCES: &[f64] = &[1e-4];

/// The referee's tolerance of the stepper.
const REFEREE: f64 = 1e-13;

/// A scene run at a tolerance, through the loop by which the commands run the model.
type RunAt<'a> = Box<dyn Fn(&Scene, f64) -> Result<Run, SceneError> + 'a>;

/// A model to be measured.
struct Entrant<'a> {
    name: String,
    /// Seconds of building its table; of one solve, for a model without a table.
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
            run: Box::new(move |scene, tolerance| run_any(scene, model, &at(tolerance))),
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
    let cases = cases()?;
    let mut references = Vec::with_capacity(cases.len());
    for case in &cases {
        let scene = case.scene()?;
        let reference = run_any(&scene, tables.referee(), &at(REFEREE))?;
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
    // The typical case first: time may be up before the last.
    references.sort_by_key(|reference| !is_typical(&reference.case));
    direct(options, tables, &references, rows)
}

/// What the trajectories of a case are measured against.
struct Reference {
    case: Case,
    scene: Scene,
    /// The referee's.
    run: Run,
    /// The tightest of each model with a table, by its name.
    tightest: Vec<(String, Result<Run, SceneError>)>,
}

impl Reference {
    /// The tightest trajectory of the table of `model`.
    fn tightest(&self, model: &str) -> Result<Run, SceneError> {
        let name = format!("{model}-table");
        let found = self.tightest.iter().find(|(of, _)| *of == name);
        found.map_or(Err(UNKNOWN), |(_, run)| run.clone())
    }
}

/// What stands for a trajectory that was not computed.
const UNKNOWN: SceneError = SceneError::NotFinite {
    what: "tight trajectory of a model without a table",
    value: f64::NAN,
};

/// A model whose every load is solved for.
struct Direct<'a> {
    entrant: Entrant<'a>,
    tolerances: &'static [f64],
    /// Whether it runs in every case, or in the typical one alone.
    everywhere: bool,
}

/// Trajectories in which every load is solved for. One that may be expected, by the time of a solve
/// and the loads that a tabulated trajectory takes, to end after the time allowed for all is left
/// out, with NaN.
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
                let alike = run_any(&reference.scene, tables.referee(), &at(tolerance))?;
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

/// Refinement level of the boundary elements that solve every case without a table; its loads are
/// good to about 1e-3.
pub(super) const COARSE_LEVEL: usize = 1;

/// Seconds of one solve where collisions go.
fn seconds_of_solve<M: Hydrodynamics>(model: &M) -> Result<f64, SceneError> {
    let gap = Gap::new(0.01)?;
    // Limiting forms are fitted once, when first needed: trial steps may go far.
    model.loads(Gap::new(1e3)?, LOADS)?;
    model.loads(gap, LOADS)?;
    let started = Instant::now();
    model.loads(gap, LOADS)?;
    Ok(started.elapsed().as_secs_f64())
}

/// The collision of Fig. 6 that is neither the closest nor a near miss.
fn is_typical(case: &Case) -> bool {
    case.approach == Approach::HeadOn && (case.dx - 2.0).abs() < 0.5
}

/// All encounters of Figs 6 and 7.
fn cases() -> Result<Vec<Case>, CompareError> {
    let defaults = Defaults::paper()?;
    let mut cases = Vec::new();
    for approach in [Approach::HeadOn, Approach::Orthogonal] {
        let lists = defaults.encounters(approach);
        for &beta in &lists.beta {
            cases.extend(lists.dx.iter().map(|&dx| Case {
                approach,
                beta,
                dx,
                dz: 0.0,
            }));
        }
    }
    Ok(cases)
}

fn row(model: &str, tolerance: f64, case: &Case) -> CostRow {
    let Case {
        approach, beta, dx, ..
    } = case;
    let name = format!("{approach} beta {beta} dx {dx}");
    CostRow::new(Part::Deflection, model, ("tolerance", tolerance), name)
}

/// Fills in errors, counters and time, unless the run failed.
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

/// Largest and root-mean-square difference of the two outgoing angles, in degrees; NaN unless both
/// pairs parted, since a bound pair has none.
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
