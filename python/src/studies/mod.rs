//! Studies: many runs, whose rows become tables.

pub(crate) mod bound_states;
pub(crate) mod kinetics;
pub(crate) mod maps;
pub(crate) mod sensitivity;
pub(crate) mod sweep;

use std::path::PathBuf;
use std::time::Duration;

use ::scene::{LoadSet, RunOptions};
use compare::columns::{Column, FILES};
use compare::scene_file::SAMPLE_INTERVAL;
use compare::sweep::{SweepOptions, checked_angles_at, checked_time_limit, checked_tolerance};
use compare::{CompareError, Method, Model as Ready, Numbers as List, OutputFolder, Reads};
use pyo3::prelude::*;

use crate::array::Numbers;
use crate::error::{input, raised};
use crate::model::{Model, Setter};

/// Axes by their names, as Python gives them.
type Axes<'py> = Vec<(String, Numbers<'py>)>;

/// The columns that a file of the library has, without those of the parameters of a family.
fn columns_of(file: &str) -> &'static [Column] {
    let of = FILES.iter().find(|of| of.name == file);
    of.map_or(&[], |of| of.columns)
}

/// Numbers of one argument, each of which is there once.
fn list(what: &'static str, given: &Numbers<'_>) -> PyResult<Vec<f64>> {
    let List(numbers) =
        List::new(given.list(what)?).map_err(|reason| input(what, "list", reason))?;
    Ok(numbers)
}

/// A whole number that is not negative.
fn whole(what: &'static str, given: i64) -> PyResult<usize> {
    usize::try_from(given).map_err(|_| input(what, given, "give a whole number, 0 or more"))
}

/// The axes of a sweep.
fn axes(given: &Axes<'_>) -> PyResult<Vec<(String, List)>> {
    let axis = |(name, values): &(String, Numbers<'_>)| {
        let values = List::new(values.list("axes")?).map_err(|why| input("axes", name, why))?;
        Ok((name.clone(), values))
    };
    given.iter().map(axis).collect()
}

/// Models whose names tell their rows apart, to be set up where that may take long.
struct Setters(Vec<(Method, Setter)>);

impl Setters {
    fn of(models: &[Bound<'_, Model>]) -> PyResult<Self> {
        if models.is_empty() {
            return Err(input("models", "none", "give one model at least"));
        }
        let mut all: Vec<(Method, Setter)> = Vec::with_capacity(models.len());
        for model in models {
            let model = model.get();
            let name = model.method().name();
            if all.iter().any(|(method, _)| method.name() == name) {
                let allowed = "two models have this name, and rows name theirs: give one of them, or another name";
                return Err(input("models", name, allowed));
            }
            all.push((model.method(), model.setter()));
        }
        Ok(Self(all))
    }

    fn methods(&self) -> Vec<Method> {
        self.0.iter().map(|(method, _)| *method).collect()
    }

    /// The models, each set up for what is read.
    fn set_up(&self, read: &Reads) -> Result<Vec<Ready>, CompareError> {
        (self.0.iter())
            .map(|(_, setter)| setter.set_up(read))
            .collect()
    }
}

/// All loads of two equal squirmers by the modes 1 and 2.
fn usual() -> Reads {
    Reads {
        loads: Some(LoadSet::all(2)),
        ratios: vec![1.0],
    }
}

/// Where results are written: a folder that keeps them, or else one that is deleted at the end.
struct Place {
    out: Option<PathBuf>,
    fresh: bool,
}

impl Place {
    fn open(&self) -> Result<OutputFolder, CompareError> {
        let folder = match &self.out {
            Some(path) => OutputFolder::open(path)?,
            None => OutputFolder::temporary()?,
        };
        Ok(folder.fresh(self.fresh))
    }

    /// A time limit, which needs a folder that keeps what is finished.
    fn time_limit(&self, seconds: Option<f64>) -> PyResult<Option<Duration>> {
        match (seconds, &self.out) {
            (Some(seconds), None) => {
                let allowed = "give out too: the folder that keeps what is finished";
                Err(input("time_limit", format!("{seconds:?}"), allowed))
            }
            _ => checked_time_limit(seconds).map_err(raised),
        }
    }
}

/// The text of a file that was written.
fn written(out: &OutputFolder, file: &str) -> Result<String, CompareError> {
    let path = out.path().join(file);
    std::fs::read_to_string(&path).map_err(|source| CompareError::Read { path, source })
}

/// Options of the runs of a study.
fn options(
    methods: &[Method],
    (tolerance, angles_at): (f64, f64),
    time_limit: Option<Duration>,
) -> PyResult<SweepOptions> {
    Ok(SweepOptions {
        run: RunOptions {
            tolerance: checked_tolerance(tolerance).map_err(raised)?,
            angles_at: checked_angles_at(angles_at, methods).map_err(raised)?,
            sample_interval: Some(SAMPLE_INTERVAL),
            ..RunOptions::default()
        },
        time_limit,
    })
}
