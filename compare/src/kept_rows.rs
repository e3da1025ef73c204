//! Sweeps of encounters, of any size: rows go to a part file as they come and are the final file's when all are
//! done. Memory holds the runs that a picture shows, and no others.

use std::collections::BTreeMap;
use std::io::Write;
use std::sync::{Mutex, PoisonError};

use scene::{Hydrodynamics, RunOptions};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::encounter::{FAILED, SKIPPED};
use crate::maps::resume::Journal;
use crate::output::{OutputFolder, csv_lines, csv_text, rows_of};
use crate::sweep::{self, SweepOptions};
use crate::watch::notice;
use crate::{Case, CompareError, Encounter, EncounterRow, Model, NoRun, OffsetRow};

/// Most runs of a sweep.
pub const MOST_RUNS: usize = 4_000_000;

/// Paths up to which a panel shows trajectories, and runs up to which a picture does.
const MOST_PATHS: usize = 30;
const MOST_DRAWN: usize = 120;

/// Runs up to which a picture shows deflections.
const MOST_POINTS: usize = 2000;

/// Parts that a large sweep is kept in.
const PARTS: usize = 1000;

/// Reasons of failures that are printed.
const REASONS: usize = 20;

/// A row that says what became of a run.
pub trait Row: Serialize + DeserializeOwned {
    /// Outcome, `failed` or `skipped`.
    fn outcome(&self) -> &str;
}

impl Row for EncounterRow {
    fn outcome(&self) -> &str {
        &self.outcome
    }
}

impl Row for OffsetRow {
    fn outcome(&self) -> &str {
        &self.outcome
    }
}

/// A sweep, from its cases to its files.
pub struct KeptRows<'a> {
    /// Name of its file, without the ending.
    pub name: &'a str,
    /// The models.
    pub models: &'a [Model],
    /// Its cases, in order.
    pub cases: &'a [Case],
    /// How each run is made, and for how long.
    pub options: &'a SweepOptions,
    /// Where rows are kept.
    pub out: &'a OutputFolder,
}

/// Which pictures of a sweep are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// Trajectories and deflections.
    Paths,
    /// Deflections.
    Points,
    /// Neither.
    Nothing,
}

impl Drawn {
    /// What a command that has no trajectories to draw shows of so many runs.
    pub fn without_paths(runs: usize) -> Self {
        if runs > MOST_POINTS {
            Self::Nothing
        } else {
            Self::Points
        }
    }

    /// What can be told apart in a picture of so many runs, so many of them in a panel.
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

impl KeptRows<'_> {
    /// Which pictures of the encounters are drawn: panels are those of a model and a beta.
    pub fn drawn(&self) -> Drawn {
        let same = |a: &Case, b: &Case| a.beta.total_cmp(&b.beta).is_eq();
        let panel = self.cases.chunk_by(same).map(<[Case]>::len).max();
        Drawn::of(self.models.len() * self.cases.len(), panel.unwrap_or(0))
    }

    /// All that the rows depend on, in one line.
    fn key(&self, size: usize) -> String {
        let models: Vec<_> = (self.models.iter())
            .map(|model| format!("{} ({})", model.method(), model.fingerprint()))
            .collect();
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
        format!(
            "squirmers {} {}: {}; {} cases ({:08x}), {size} at a time; {run:?}",
            env!("CARGO_PKG_VERSION"),
            self.name,
            models.join(", "),
            self.cases.len(),
            cases.finalize(),
        )
        .replace('\n', " ")
    }

    /// Makes sure that [`Self::encounters`] loses no rows of another sweep.
    pub fn check_encounters(&self) -> Result<(), CompareError> {
        self.check(self.models.len() * self.cases.len())
    }

    /// Makes sure that [`Self::offsets`] loses no rows of another sweep.
    pub fn check_offsets(&self, dz: &[f64]) -> Result<(), CompareError> {
        self.check(self.models.len() * (self.cases.len() / (1 + dz.len())))
    }

    fn check(&self, units: usize) -> Result<(), CompareError> {
        Journal::check(self.out, self.name, &self.key(units_a_chunk(units)))
    }

    /// Every case by every method; `see` is handed each row in its order, and the encounters to draw are
    /// returned.
    pub fn encounters(
        &self,
        drawn: Drawn,
        see: &mut dyn FnMut(EncounterRow),
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
        let kept = Mutex::new(BTreeMap::new());
        let complete = self.rows(
            runs,
            &|number| {
                let encounter = run(number);
                let row = encounter.row();
                let failure = self.failure(&encounter);
                if drawn != Drawn::Nothing {
                    let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
                    kept.insert(number, encounter);
                }
                (vec![row], failure)
            },
            &|number| {
                let (model, case) = of(number);
                vec![sweep::skipped(model, case)]
            },
            &|encounters| vec![encounters[0].row()],
            see,
        )?;
        if drawn == Drawn::Nothing || !complete {
            return Ok(Vec::new());
        }
        let mut kept = kept.into_inner().unwrap_or_else(PoisonError::into_inner);
        // Of runs that an interrupted command has done, rows are kept and paths are not.
        Ok((0..runs)
            .map(|number| kept.remove(&number).unwrap_or_else(|| run(number)))
            .collect())
    }

    /// The change of the outgoing orientations of each case by each of the offsets `dz`.
    pub fn offsets(
        &self,
        dz: &[f64],
        see: &mut dyn FnMut(OffsetRow),
    ) -> Result<bool, CompareError> {
        let options = RunOptions {
            sample_interval: None,
            ..self.options.run
        };
        // The planar run of a case is the reference of all its offsets.
        let group = 1 + dz.len();
        let cases = self.cases.len() / group;
        let of = |number: usize| {
            let (model, case) = (number / cases, number % cases);
            let cases = &self.cases[case * group..(case + 1) * group];
            (&self.models[model], cases)
        };
        let rows = |encounters: &[Encounter]| -> Vec<OffsetRow> {
            (encounters[1..].iter())
                .map(|offset| sweep::offset_row(&encounters[0], offset))
                .collect()
        };
        self.rows(
            self.models.len() * cases,
            &|number| {
                let (model, cases) = of(number);
                let encounters: Vec<_> = (cases.iter())
                    .map(|case| sweep::encounter(model, case, &options))
                    .collect();
                let failure = encounters.iter().find_map(|e| self.failure(e));
                (rows(&encounters), failure)
            },
            &|number| {
                let (model, cases) = of(number);
                let skipped = |case| sweep::skipped(model, case);
                cases.iter().map(skipped).collect()
            },
            &rows,
            see,
        )
    }

    fn failure(&self, encounter: &Encounter) -> Option<String> {
        match &encounter.run {
            Err(NoRun::Failed(_)) => encounter.failure(),
            _ => None,
        }
    }

    /// Rows of `units` units, each computed by `compute` together with the reason if it failed; where the time
    /// limit comes first, they are `rows_of_skipped` of the encounters that `skipped` makes up. Returns whether all
    /// are done.
    fn rows<R: Row>(
        &self,
        units: usize,
        compute: &(dyn Fn(usize) -> (Vec<R>, Option<String>) + Sync),
        skipped: &dyn Fn(usize) -> Vec<Encounter>,
        rows_of_skipped: &dyn Fn(&[Encounter]) -> Vec<R>,
        see: &mut dyn FnMut(R),
    ) -> Result<bool, CompareError> {
        let size = units_a_chunk(units);
        let chunks = units.div_ceil(size);
        let of = |chunk: usize| chunk * size..((chunk + 1) * size).min(units);
        let journal = Journal::open(self.out, self.name, &self.key(size))?;
        let reasons = Mutex::new(BTreeMap::new());
        let what = if size == 1 {
            "encounters"
        } else {
            "parts of the sweep"
        };
        let left = journal.run(chunks, what, self.options.time_limit, |chunk| {
            let mut rows = Vec::new();
            for unit in of(chunk) {
                let (more, failure) = compute(unit);
                rows.extend(more);
                if let Some(reason) = failure {
                    let mut reasons = reasons.lock().unwrap_or_else(PoisonError::into_inner);
                    reasons.insert(unit, reason);
                    if reasons.len() > REASONS {
                        reasons.pop_last();
                    }
                }
            }
            csv_lines(&rows)
        })?;
        let file = format!("{}.csv", self.name);
        let mut counts = Counts::default();
        let lines = |chunk: usize| -> Result<Vec<R>, CompareError> {
            match journal.lines(chunk)? {
                Some(lines) => rows_of(&lines),
                None => Ok(of(chunk)
                    .flat_map(|unit| rows_of_skipped(&skipped(unit)))
                    .collect()),
            }
        };
        let mut fill = |to: &mut dyn Write| -> Result<(), CompareError> {
            let failed = |source| self.out.failed(&file, source);
            for chunk in 0..chunks {
                let rows = lines(chunk)?;
                let text = if chunk == 0 {
                    csv_text(&rows)
                } else {
                    csv_lines(&rows)
                };
                to.write_all(text?.as_bytes()).map_err(failed)?;
                for row in rows {
                    counts.add(&row);
                    see(row);
                }
            }
            Ok(())
        };
        if left > 0 && self.holds_more(&file, &journal, chunks)? {
            fill(&mut std::io::sink())?;
            notice!("'{file}' holds more of a sweep already and stays as it is");
        } else {
            self.out.write_by(&file, fill)?;
        }
        let left_out = (0..chunks)
            .filter(|&chunk| !journal.has(chunk))
            .flat_map(of);
        let reasons_skipped = left_out.flat_map(skipped).filter_map(|e| e.failure());
        for reason in reasons_skipped.take(REASONS) {
            notice!("{reason}");
        }
        self.tell(&counts, reasons);
        if left == 0 {
            journal.close()?;
        }
        Ok(left == 0)
    }

    /// Whether the file `name` is there already, and is not an unfinished one with no more finished rows than the
    /// journal has.
    fn holds_more(
        &self,
        name: &str,
        journal: &Journal,
        chunks: usize,
    ) -> Result<bool, CompareError> {
        let Ok(mut reader) = csv::Reader::from_path(self.out.path().join(name)) else {
            return Ok(false);
        };
        let mut finished = 0;
        for chunk in 0..chunks {
            finished += (journal.lines(chunk)?).map_or(0, |lines| lines.lines().count());
        }
        let (mut done, mut skipped) = (0, 0);
        for record in reader.records() {
            match record {
                Ok(record) if record.iter().any(|field| field == SKIPPED) => skipped += 1,
                Ok(_) => done += 1,
                Err(_) => {}
            }
        }
        Ok(done > finished || (skipped == 0 && done > 0))
    }

    /// Says what has no result, on standard error and in the account.
    fn tell(&self, counts: &Counts, reasons: Mutex<BTreeMap<usize, String>>) {
        let reasons = reasons.into_inner().unwrap_or_else(PoisonError::into_inner);
        for reason in reasons.values() {
            notice!("{reason}");
        }
        if counts.failed > reasons.len() {
            notice!("{} of {} rows failed", counts.failed, counts.rows);
        }
        if counts.skipped > 0 {
            notice!(
                "{} of {} rows are left; the same command goes on from {}.csv.part",
                counts.skipped,
                counts.rows,
                self.name
            );
        }
        self.out.account().failed(counts.failed);
        self.out.account().skipped(counts.skipped);
    }
}

/// Units that are kept together in a sweep of so many.
fn units_a_chunk(units: usize) -> usize {
    (units / PARTS).max(1)
}

#[derive(Default)]
struct Counts {
    rows: usize,
    failed: usize,
    skipped: usize,
}

impl Counts {
    fn add(&mut self, row: &impl Row) {
        self.rows += 1;
        self.failed += usize::from(row.outcome() == FAILED);
        self.skipped += usize::from(row.outcome() == SKIPPED);
    }
}
