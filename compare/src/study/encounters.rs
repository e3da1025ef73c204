//! Encounters at opposed velocities and at right angles (the paper's Figs 6 and 7): one row of numbers per run, and its
//! trajectory. A sweep of them has any size: memory holds only the runs that a picture shows.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use rayon::prelude::*;
use scene::{Outcome, Run, RunOptions};
use serde::{Deserialize, Serialize};

use crate::columns::{self, Columns, columns};
use crate::no_run::{NoRun, RunNumbers};
use crate::numbers::written;
use crate::output::{OutputFolder, csv_lines};
use crate::sweep::{self, Computed, Done, Row, Sweep, SweepOptions};
use crate::watch::{Pieces, Progress};
use crate::{Case, CompareError, Method, Model};

/// Largest number of runs of a sweep.
pub const MOST_RUNS: usize = 4_000_000;

/// Largest number of paths in a panel of trajectories, and largest number of runs in a picture of trajectories.
const MOST_PATHS: usize = 30;
const MOST_DRAWN: usize = 120;

/// Largest number of runs in a picture of deflections.
const MOST_POINTS: usize = 2000;

/// One encounter by one method: its run, or the reason why it has none.
#[derive(Clone, Debug)]
pub struct Encounter {
    /// The case.
    pub case: Case,
    /// The method.
    pub method: Method,
    /// The run with its samples, or the reason why there is no run.
    pub run: Result<Run, NoRun>,
    /// Wall-clock time of the run in seconds, without the time to build tables.
    pub seconds: f64,
}

columns! {
    /// A row for each encounter and method. A run without a result has NaN.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct EncounterRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Offset of the two paths in the plane; for opposed paths the distance between them.
        #[unit = "a"]
        pub dx: f64,
        /// Offset out of the plane: squirmer 1 starts at `z = dz/2`, squirmer 2 at `z = -dz/2`.
        #[unit = "a"]
        pub dz: f64,
        /// Deflection of squirmer 1: outgoing minus incoming angle in the x-y plane.
        #[unit = "deg"]
        pub deflection1_deg: f64,
        /// Deflection of squirmer 2: outgoing minus incoming angle in the x-y plane.
        #[unit = "deg"]
        pub deflection2_deg: f64,
        /// Smallest gap during the run.
        #[unit = "a"]
        pub min_gap: f64,
        /// Interaction time: the time that the pair spends at gaps up to one radius, of the smaller squirmer.
        #[unit = "a/V_s"]
        pub tau: f64,
        /// Outcome of the run.
        #[unit = "-"]
        pub outcome: String,
        /// Number of accepted steps of the integrator; 0 for a run without a result.
        #[unit = "-"]
        pub steps: u64,
        /// Number of times that the model computed its loads; 0 for a run without a result.
        #[unit = "-"]
        pub loads: u64,
        /// Time of the run, without the time to build tables.
        #[unit = "s"]
        pub seconds: f64,
        /// Estimated difference of the deflections from their limit at infinite distance; 0 if the run needs no such limit.
        #[unit = "deg"]
        pub truncation_deg: f64,
    }
}

impl Row for EncounterRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
    }
}

impl Encounter {
    /// The row of this encounter.
    #[must_use]
    pub fn row(&self) -> EncounterRow {
        let Case { beta, dx, dz, .. } = self.case;
        let run = RunNumbers::of(&self.run);
        EncounterRow {
            method: self.method,
            beta,
            dx,
            dz,
            deflection1_deg: run.deflections_deg[0],
            deflection2_deg: run.deflections_deg[1],
            min_gap: run.min_gap,
            tau: run.tau,
            outcome: run.outcome,
            steps: run.steps,
            loads: run.loads,
            seconds: self.seconds,
            truncation_deg: run.truncation_deg,
        }
    }

    /// Name of the outcome, `failed` or `skipped`.
    #[must_use]
    pub fn outcome(&self) -> String {
        RunNumbers::of(&self.run).outcome
    }

    /// A message about an encounter without a result.
    #[must_use]
    pub fn failure(&self) -> Option<String> {
        let reason = self.run.as_ref().err()?;
        let Case {
            approach,
            beta,
            dx,
            dz,
        } = self.case;
        Some(format!(
            "{approach}, {}, beta {}, dx {}, dz {}: {reason}",
            self.method,
            written(beta),
            written(dx),
            written(dz)
        ))
    }

    /// Whether the pair parted. Only then are its outgoing angles meaningful.
    #[must_use]
    pub fn scattered(&self) -> bool {
        (self.run.as_ref()).is_ok_and(|run| run.outcome == Outcome::Scattered)
    }
}

/// Runs every case by every method. Methods are the outer loop.
#[must_use]
pub fn encounters(models: &[Model], cases: &[Case], options: &SweepOptions) -> Vec<Encounter> {
    let started = Instant::now();
    let progress = Progress::begin("encounters", models.len() * cases.len(), Pieces::Alike);
    let pairs: Vec<_> = (models.iter())
        .flat_map(|model| cases.iter().map(move |case| (model, case)))
        .collect();
    pairs
        .into_par_iter()
        .map(|(model, case)| {
            let late = (options.time_limit).is_some_and(|limit| started.elapsed() >= limit);
            let encounter = if late {
                skipped(model, case)
            } else {
                encounter(model, case, &options.run)
            };
            progress.advance();
            encounter
        })
        .collect()
}

pub(super) fn skipped(model: &Model, case: &Case) -> Encounter {
    Encounter {
        case: *case,
        method: model.method(),
        run: Err(NoRun::Skipped),
        seconds: 0.0,
    }
}

pub(super) fn encounter(model: &Model, case: &Case, options: &RunOptions) -> Encounter {
    let started = Instant::now();
    let run = model.attempt(case.scene(), options);
    Encounter {
        case: *case,
        method: model.method(),
        run,
        seconds: started.elapsed().as_secs_f64(),
    }
}

/// A sweep of encounters: its cases and models, and where its rows are written.
pub struct EncounterSweep<'a> {
    /// Name of the file of its rows, without the ending.
    pub name: &'a str,
    /// The models.
    pub models: &'a [Model],
    /// Its cases, in order.
    pub cases: &'a [Case],
    /// Options of each run, and the time limit.
    pub options: &'a SweepOptions,
    /// The folder for the rows.
    pub out: &'a OutputFolder,
}

/// The pictures of a sweep that are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// Trajectories and deflections.
    Paths,
    /// Deflections.
    Points,
    /// No pictures.
    Nothing,
}

impl Drawn {
    /// The pictures of so many runs, for a command that draws no trajectories.
    pub fn without_paths(runs: usize) -> Self {
        if runs > MOST_POINTS {
            Self::Nothing
        } else {
            Self::Points
        }
    }

    /// The pictures in which a reader can distinguish so many runs, with so many of them in a panel.
    fn of(runs: usize, panel: usize) -> Self {
        if runs > MOST_POINTS {
            Self::Nothing
        } else if panel > MOST_PATHS || runs > MOST_DRAWN {
            Self::Points
        } else {
            Self::Paths
        }
    }
}

impl EncounterSweep<'_> {
    /// The pictures of the encounters that are drawn. Each panel shows one model and one beta.
    pub fn drawn(&self) -> Drawn {
        let same = |a: &Case, b: &Case| a.beta.total_cmp(&b.beta).is_eq();
        let panel = self.cases.chunk_by(same).map(<[Case]>::len).max();
        Drawn::of(self.models.len() * self.cases.len(), panel.unwrap_or(0))
    }

    /// Everything that the rows depend on, in one line.
    fn key(&self, size: usize) -> String {
        let mut cases = crc32fast::Hasher::new();
        for case in self.cases {
            for number in [case.beta, case.dx, case.dz] {
                cases.update(&number.to_le_bytes());
            }
        }
        let run = RunOptions {
            sample_interval: None,
            ..self.options.run
        };
        let (count, checksum) = (self.cases.len(), cases.finalize());
        let rest = format!("{count} cases ({checksum:08x}), {size} at a time");
        sweep::key(self.name, self.models, &run, &rest)
    }

    /// The sweep of `units` units.
    pub(super) fn sweep(&self, units: usize) -> Sweep<'_> {
        let size = Sweep::size_of(units);
        Sweep {
            name: self.name,
            units: 0..units,
            size,
            what: if size == 1 {
                "encounters"
            } else {
                "parts of the sweep"
            },
            key: self.key(size),
            time_limit: self.options.time_limit,
            out: self.out,
        }
    }

    /// Checks that [`Self::encounters`] would not delete rows of another sweep.
    ///
    /// # Errors
    /// As [`Sweep::check`].
    pub fn check_encounters(&self) -> Result<(), CompareError> {
        self.sweep(self.models.len() * self.cases.len()).check()
    }

    /// Runs every case by every method. Passes each row to `each`, in order, and returns the encounters to draw.
    ///
    /// # Errors
    /// As [`Sweep::run`] and [`Kept::write`](crate::sweep::Kept::write).
    pub fn encounters(
        &self,
        drawn: Drawn,
        each: &mut dyn FnMut(EncounterRow),
    ) -> Result<Vec<Encounter>, CompareError> {
        let options = RunOptions {
            sample_interval: (self.options.run.sample_interval).filter(|_| drawn == Drawn::Paths),
            ..self.options.run
        };
        let runs = self.models.len() * self.cases.len();
        let of = |run: usize| {
            let (model, case) = (run / self.cases.len(), run % self.cases.len());
            (&self.models[model], &self.cases[case])
        };
        let run = |run: usize| {
            let (model, case) = of(run);
            encounter(model, case, &options)
        };
        let skipped = |run: usize| {
            let (model, case) = of(run);
            skipped(model, case)
        };
        let computed = |encounter: &Encounter| -> Result<Computed, CompareError> {
            Ok(Computed {
                lines: csv_lines(&[encounter.row()])?,
                failure: encounter.failure(),
            })
        };
        let drawn_runs = Mutex::new(BTreeMap::new());
        let done = self.write(
            runs,
            |number| {
                let encounter = run(number);
                let computed = computed(&encounter);
                if drawn != Drawn::Nothing {
                    let mut kept = drawn_runs.lock().unwrap_or_else(PoisonError::into_inner);
                    kept.insert(number, encounter);
                }
                computed
            },
            &|number| computed(&skipped(number)),
            each,
        )?;
        if drawn == Drawn::Nothing || !done.is_complete() {
            return Ok(Vec::new());
        }
        let mut kept = (drawn_runs.into_inner()).unwrap_or_else(PoisonError::into_inner);
        // An interrupted command keeps the rows of its runs, but not their paths: these runs are repeated.
        Ok((0..runs)
            .map(|number| kept.remove(&number).unwrap_or_else(|| run(number)))
            .collect())
    }

    /// Computes and writes `units` units.
    pub(super) fn write<R: Row + Columns>(
        &self,
        units: usize,
        compute: impl Fn(usize) -> Result<Computed, CompareError> + Sync,
        skipped: &dyn Fn(usize) -> Result<Computed, CompareError>,
        each: &mut dyn FnMut(R),
    ) -> Result<Done, CompareError> {
        let (sweep, header) = (self.sweep(units), columns::header::<R>());
        sweep.run(compute)?.write(&header, skipped, &mut |row| {
            each(row);
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests;
