//! Sweeps of encounters, of any size. Each row goes to a part file as soon as it is computed; the final file is
//! written when all rows are computed. Memory holds only the runs that a picture shows.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use scene::RunOptions;

use crate::columns::{self, Columns};
use crate::output::{OutputFolder, csv_lines};
use crate::sweep::{self, Computed, Done, Row, Sweep, SweepOptions};
use crate::{Case, CompareError, Encounter, EncounterRow, Model, OffsetRow};

/// Largest number of runs of a sweep.
pub const MOST_RUNS: usize = 4_000_000;

/// Largest number of paths in a panel of trajectories, and largest number of runs in a picture of trajectories.
const MOST_PATHS: usize = 30;
const MOST_DRAWN: usize = 120;

/// Largest number of runs in a picture of deflections.
const MOST_POINTS: usize = 2000;

impl Row for EncounterRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
    }
}

impl Row for OffsetRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
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
    fn sweep(&self, units: usize) -> Sweep<'_> {
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

    /// Checks that [`Self::offsets`] would not delete rows of another sweep.
    ///
    /// # Errors
    /// As [`Sweep::check`].
    pub fn check_offsets(&self, dz: &[f64]) -> Result<(), CompareError> {
        let cases = self.cases.len() / (1 + dz.len());
        self.sweep(self.models.len() * cases).check()
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
            sweep::encounter(model, case, &options)
        };
        let skipped = |run: usize| {
            let (model, case) = of(run);
            sweep::skipped(model, case)
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

    /// Computes how much each offset `dz` changes the outgoing orientations of each case. Returns whether all are done.
    ///
    /// # Errors
    /// As [`Self::encounters`].
    pub fn offsets(
        &self,
        dz: &[f64],
        each: &mut dyn FnMut(OffsetRow),
    ) -> Result<bool, CompareError> {
        let options = RunOptions {
            sample_interval: None,
            ..self.options.run
        };
        // All offsets of a case are compared with its planar run.
        let group = 1 + dz.len();
        let cases = self.cases.len() / group;
        let of = |number: usize| {
            let (model, case) = (number / cases, number % cases);
            let cases = &self.cases[case * group..(case + 1) * group];
            (&self.models[model], cases)
        };
        let skipped = |number: usize| -> Vec<Encounter> {
            let (model, cases) = of(number);
            (cases.iter())
                .map(|case| sweep::skipped(model, case))
                .collect()
        };
        let rows = |encounters: &[Encounter]| -> Vec<OffsetRow> {
            (encounters[1..].iter())
                .map(|offset| sweep::offset_row(&encounters[0], offset))
                .collect()
        };
        let computed = |encounters: &[Encounter]| -> Result<Computed, CompareError> {
            Ok(Computed {
                lines: csv_lines(&rows(encounters))?,
                failure: encounters.iter().find_map(Encounter::failure),
            })
        };
        let done = self.write(
            self.models.len() * cases,
            |number| {
                let (model, cases) = of(number);
                let encounters: Vec<_> = (cases.iter())
                    .map(|case| sweep::encounter(model, case, &options))
                    .collect();
                computed(&encounters)
            },
            &|number| computed(&skipped(number)),
            each,
        )?;
        Ok(done.is_complete())
    }

    /// Computes and writes `units` units.
    fn write<R: Row + Columns>(
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
