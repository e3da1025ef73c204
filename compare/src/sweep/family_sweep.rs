//! A sweep of a family along some of its parameters, by several models.

use std::time::{Duration, Instant};

use scene::{LoadSet, Run, RunOptions};
use serde::{Deserialize, Serialize};

use super::manifest::SweepIdentity;
use super::{Computed, Done, Manifest, ManifestModel, Points, Row, Share, Sweep};
use crate::columns::{self, Columns as _, columns};
use crate::no_run::RunNumbers;
use crate::output::{OutputFolder, csv_lines};
use crate::{CompareError, Family, Method, Model, NoRun};

/// Name of the file of the rows, without its ending.
const NAME: &str = "sweep";

/// A sweep of a family. Models are the outer loop, then the axes in their order.
pub struct FamilySweep<'a> {
    /// The points.
    pub points: &'a Points,
    /// The models.
    pub models: &'a [Model],
    /// The loads that the motion reads at the points, see [`Points::reads`].
    pub loads: Option<LoadSet>,
    /// The share of the rows that this process runs.
    pub share: Share,
    /// Time after which no further piece begins.
    pub time_limit: Option<Duration>,
    /// The folder for the rows.
    pub out: &'a OutputFolder,
}

columns! {
    /// A row for each model and point of the sweep. The first columns are the parameters that are varied, by their
    /// names in the family's file. A run without a result has NaN.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub(crate) struct Tail {
        /// Name of the method.
        #[unit = "-"]
        method: Method,
        /// Deflection of squirmer 1: outgoing minus incoming angle in the x-y plane.
        #[unit = "deg"]
        deflection1_deg: f64,
        /// Deflection of squirmer 2: outgoing minus incoming angle in the x-y plane.
        #[unit = "deg"]
        deflection2_deg: f64,
        /// Smallest gap during the run.
        #[unit = "a"]
        min_gap: f64,
        /// Interaction time: the time that the pair spends at gaps up to one radius, of the smaller squirmer.
        #[unit = "a/V_s"]
        tau: f64,
        /// Outcome of the run.
        #[unit = "-"]
        outcome: String,
        /// Number of accepted steps of the integrator; 0 for a run without a result.
        #[unit = "-"]
        steps: u64,
    }
}

impl Tail {
    fn of(method: Method, run: &Result<Run, NoRun>) -> Self {
        let run = RunNumbers::of(run);
        Self {
            method,
            deflection1_deg: run.deflections_deg[0],
            deflection2_deg: run.deflections_deg[1],
            min_gap: run.min_gap,
            tau: run.tau,
            outcome: run.outcome,
            steps: run.steps,
        }
    }
}

/// A row of `sweep.csv`, field by field: the values of the parameters, then the result of the run.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct SweepRow(pub Vec<String>);

impl SweepRow {
    /// The field at `place`, counted from the end.
    fn behind(&self, place: usize) -> &str {
        let at = self.0.len().checked_sub(place);
        at.and_then(|at| self.0.get(at)).map_or("", String::as_str)
    }
}

impl Row for SweepRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.behind(2))
    }
}

impl FamilySweep<'_> {
    /// The names of the columns.
    #[must_use]
    pub fn header(&self) -> Vec<&str> {
        let names = self.points.axes().iter().map(|axis| axis.name.as_str());
        names.chain(columns::names(Tail::COLUMNS)).collect()
    }

    /// Runs the share, writes `sweep.csv` and passes each row to `each`, in order. Writes the manifest after all rows.
    ///
    /// # Errors
    /// The errors of [`Sweep::run`]; [`CompareError::Input`] for a share without a row.
    pub fn run(&self, each: &mut dyn FnMut(SweepRow)) -> Result<Done, CompareError> {
        let began = Instant::now();
        let all = self.models.len() * self.points.count();
        let units = self.share.units(all);
        if units.is_empty() {
            let allowed = format!("there are {all} rows: give at most {all} shares");
            return Err(CompareError::input("--partition", self.share, allowed));
        }
        let identity = self.identity();
        let size = Sweep::size_of(units.len());
        let sweep = Sweep {
            name: NAME,
            units: units.clone(),
            size,
            what: "parts of the sweep",
            key: identity.key(NAME, self.share, size)?,
            time_limit: self.time_limit,
            out: self.out,
        };
        let families: Vec<Family> = (self.models.iter())
            .map(|model| self.points.family().clone().under(model.as_in_files()))
            .collect();
        let header = csv_record(&self.header())?;
        let kept = sweep.run(|unit| self.compute(&families, unit))?;
        let done: Done = kept.write(&header, &|unit| self.skipped(unit), &mut |row| {
            each(row);
            Ok::<_, CompareError>(())
        })?;
        if done.is_complete() {
            let share = (self.share, all, done.failed);
            let models = (self.models, self.loads.unwrap_or(LoadSet::axial(0)));
            Manifest::write((self.out, NAME), identity, share, models, began)?;
        }
        Ok(done)
    }

    fn identity(&self) -> SweepIdentity {
        let run = self.points.choices();
        let tolerance = run.tolerance.map_or("the file's".to_owned(), |tolerance| {
            format!("{tolerance:?}")
        });
        SweepIdentity {
            version: format!("squirmers {}", env!("CARGO_PKG_VERSION")),
            family: self.points.family().text().to_owned(),
            axes: self.points.axes().to_vec(),
            models: ManifestModel::of(self.models),
            run: format!("tolerance {tolerance}, angles at {:?}", run.angles_at),
        }
    }

    fn compute(&self, families: &[Family], unit: usize) -> Result<Computed, CompareError> {
        let points = self.points.count();
        let (model, point) = (unit / points, unit % points);
        let values = self.points.values(point);
        let model = &self.models[model];
        let point = (families[unit / points].scene(&values)).map_err(CompareError::FamilyPoint);
        let file = (point.as_ref()).map_or_else(|_| RunOptions::default(), |point| point.run);
        let scene = point.map(|point| point.scene);
        let run = model.attempt(scene, &self.points.options(file));
        self.lines(model.method(), &values, &run)
    }

    fn skipped(&self, unit: usize) -> Result<Computed, CompareError> {
        let points = self.points.count();
        let values = self.points.values(unit % points);
        let method = self.models[unit / points].method();
        self.lines(method, &values, &Err(NoRun::Skipped))
    }

    /// The line of a run, and the reason of a failure.
    fn lines(
        &self,
        method: Method,
        values: &[(&str, f64)],
        run: &Result<Run, NoRun>,
    ) -> Result<Computed, CompareError> {
        let failure = match run {
            Err(NoRun::Failed(reason)) => {
                let at: Vec<String> = (values.iter())
                    .map(|(name, value)| format!("{name} = {value:?}"))
                    .collect();
                Some(format!("{method}, {}: {reason}", at.join(", ")))
            }
            _ => None,
        };
        let values: Vec<f64> = values.iter().map(|(_, value)| *value).collect();
        Ok(Computed {
            lines: csv_lines(&[(values, Tail::of(method, run))])?,
            failure,
        })
    }
}

/// Fields as one CSV line, without its end.
fn csv_record(fields: &[&str]) -> Result<String, CompareError> {
    let line = csv_lines(&[fields])?;
    Ok(line.trim_end_matches('\n').to_owned())
}

#[cfg(test)]
mod tests;
