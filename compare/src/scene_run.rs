//! Runs one scene and writes its rows and a summary.
//!
//! Rows are written to `run.csv.partial`, one whole line at a time. The file is renamed to `run.csv` when the run has
//! ended. A run that was stopped therefore leaves its rows in `run.csv.partial`.

use std::fs::File;
use std::io::{BufWriter, Write};

use scene::{Configuration, Plan, Run, RunOptions, Sample};
use serde::Serialize;

use crate::columns::columns;
use crate::output::OutputFolder;
use crate::watch::{Leaving, Pieces, Progress};
use crate::{CompareError, Method, Model};

/// Name of the file of the trajectory.
const FILE: &str = "run.csv";

columns! {
    /// A row for each sample of the trajectory. Orientations are unit vectors.
    #[derive(Clone, Copy, Debug, PartialEq, Serialize)]
    pub struct SampleRow {
        /// Time from the start.
        #[unit = "a/V_s"]
        pub t: f64,
        /// x of the centre of squirmer 1.
        #[unit = "a"]
        pub x1: f64,
        /// y of the centre of squirmer 1.
        #[unit = "a"]
        pub y1: f64,
        /// z of the centre of squirmer 1.
        #[unit = "a"]
        pub z1: f64,
        /// x of the centre of squirmer 2.
        #[unit = "a"]
        pub x2: f64,
        /// y of the centre of squirmer 2.
        #[unit = "a"]
        pub y2: f64,
        /// z of the centre of squirmer 2.
        #[unit = "a"]
        pub z2: f64,
        /// x of the orientation of squirmer 1.
        #[unit = "-"]
        pub px1: f64,
        /// y of the orientation of squirmer 1.
        #[unit = "-"]
        pub py1: f64,
        /// z of the orientation of squirmer 1.
        #[unit = "-"]
        pub pz1: f64,
        /// x of the orientation of squirmer 2.
        #[unit = "-"]
        pub px2: f64,
        /// y of the orientation of squirmer 2.
        #[unit = "-"]
        pub py2: f64,
        /// z of the orientation of squirmer 2.
        #[unit = "-"]
        pub pz2: f64,
        /// Angle from the x axis to the projection of the orientation of squirmer 1 on the x-y plane, without jumps of 360
        /// degrees.
        #[unit = "deg"]
        pub angle1_deg: f64,
        /// Angle from the x axis to the projection of the orientation of squirmer 2 on the x-y plane, without jumps of 360
        /// degrees.
        #[unit = "deg"]
        pub angle2_deg: f64,
        /// Gap between the surfaces of the squirmers.
        #[unit = "a"]
        pub gap: f64,
    }
}

impl From<&Sample> for SampleRow {
    fn from(sample: &Sample) -> Self {
        let Configuration {
            gap,
            orientations: [p1, p2],
            angles_rad: [angle1, angle2],
            ..
        } = sample.configuration;
        let [c1, c2] = sample.configuration.positions();
        Self {
            t: sample.t,
            x1: c1.x,
            y1: c1.y,
            z1: c1.z,
            x2: c2.x,
            y2: c2.y,
            z2: c2.z,
            px1: p1.x,
            py1: p1.y,
            pz1: p1.z,
            px2: p2.x,
            py2: p2.y,
            pz2: p2.z,
            angle1_deg: angle1.to_degrees(),
            angle2_deg: angle2.to_degrees(),
            gap: gap.eps(),
        }
    }
}

/// Summary of a run, for people and for programs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Outcome.
    pub outcome: String,
    /// Time at the end, in `a/V_s`.
    pub end_time: f64,
    /// Smallest gap, in radii.
    pub min_gap: f64,
    /// Interaction time (the time at gaps up to the smaller radius), in `a/V_s`.
    pub contact_time: f64,
    /// Deflection of the first squirmer, in degrees.
    pub deflection1_deg: f64,
    /// Deflection of the second squirmer, in degrees.
    pub deflection2_deg: f64,
    /// Estimated difference of the deflections from their limit at infinity, in degrees; 0 if the run needs no such
    /// limit.
    pub truncation_deg: f64,
    /// Time at which the pair reached a steady state; `None` if it reached none.
    pub settled: Option<f64>,
    /// Name of the hydrodynamic method.
    pub method: &'static str,
    /// Name of the kind of coordinates.
    pub state: &'static str,
    /// Number of variables of the motion.
    pub numbers: usize,
    /// Accepted steps of the integrator.
    pub steps: u64,
    /// Rejected steps of the integrator.
    pub rejected: u64,
    /// Number of times that the model computed its loads.
    pub loads: u64,
    /// Number of free flights.
    pub flights: u64,
    /// Wall-clock time of the run, in seconds.
    pub seconds: f64,
}

impl Summary {
    /// The summary of a run that took `seconds`.
    #[must_use]
    pub fn new(run: &Run, plan: &Plan, method: Method, seconds: f64) -> Self {
        let [deflection1, deflection2] = run.deflections_rad().map(f64::to_degrees);
        Self {
            outcome: run.outcome.to_string(),
            end_time: run.end_time,
            min_gap: run.min_gap,
            contact_time: run.contact_time,
            deflection1_deg: deflection1,
            deflection2_deg: deflection2,
            truncation_deg: run.truncation_rad.to_degrees(),
            settled: run.settled,
            method: method.name(),
            state: plan.state().name(),
            numbers: plan.state().numbers(),
            steps: run.counters.steps,
            rejected: run.counters.rejected,
            loads: run.counters.loads,
            flights: run.counters.flights,
            seconds,
        }
    }

    /// The summary as one JSON object on one line.
    ///
    /// # Errors
    /// [`CompareError::Json`].
    pub fn json(&self) -> Result<String, CompareError> {
        Ok(serde_json::to_string(self)?)
    }
}

/// Files of a finished run, and the ending that the files of an earlier run get meanwhile.
const FILES: [&str; 3] = [FILE, "run.json", "run.svg"];
const EARLIER: &str = ".earlier";

/// Renames the files of an earlier run. If this run fails, nobody takes them for its results.
fn set_aside(out: &OutputFolder) -> Result<(), CompareError> {
    for file in FILES {
        if out.holds(file) {
            let to = out.path().join(format!("{file}{EARLIER}"));
            let renamed = std::fs::rename(out.path().join(file), to);
            renamed.map_err(|source| out.failed(file, source))?;
        }
    }
    Ok(())
}

/// The renamed files of an earlier run that still exist.
pub fn earlier(out: &OutputFolder) -> Vec<String> {
    let names = FILES.iter().map(|file| format!("{file}{EARLIER}"));
    names.filter(|name| out.holds(name)).collect()
}

/// Deletes the files of an earlier run, after all files of this run are written.
pub fn forget_earlier(out: &OutputFolder) -> Result<(), CompareError> {
    for name in earlier(out) {
        let removed = std::fs::remove_file(out.path().join(&name));
        removed.map_err(|source| out.failed(&name, source))?;
    }
    Ok(())
}

/// Runs a plan, writes each sample to `run.csv` in `out` as soon as it is computed, and returns all samples.
///
/// # Errors
/// [`CompareError`] if the run fails or a file cannot be written. Then the finished rows stay in `run.csv.partial`,
/// and the names of the files of an earlier run end with `.earlier`.
pub fn stream(
    model: &Model,
    plan: &Plan,
    options: &RunOptions,
    out: &OutputFolder,
) -> Result<(Run, Vec<SampleRow>), CompareError> {
    let partial = out.path().join(format!("{FILE}.partial"));
    let failed = |source: std::io::Error| CompareError::Write {
        path: partial.clone(),
        source,
    };
    set_aside(out)?;
    let mut writer =
        csv::Writer::from_writer(BufWriter::new(File::create(&partial).map_err(failed)?));
    let mut rows = Vec::new();
    let mut written = Ok(());
    let _leaving = Leaving::of(format!("finished rows are in '{}'", partial.display()));
    let progress = Progress::begin("run", options.end_time.ceil() as usize, Pieces::Time);
    let run = model.run_observed(plan, options, &mut |sample| {
        progress.reach(sample.t as usize);
        let row = SampleRow::from(sample);
        rows.push(row);
        if written.is_ok() {
            written = writer.serialize(row).and_then(|()| Ok(writer.flush()?));
        }
    })?;
    written.map_err(|error: csv::Error| match error.into_kind() {
        csv::ErrorKind::Io(source) => failed(source),
        other => failed(std::io::Error::other(format!("{other:?}"))),
    })?;
    let file = writer
        .into_inner()
        .map_err(|error| failed(error.into_error()))?;
    let mut file = file
        .into_inner()
        .map_err(|error| failed(error.into_error()))?;
    file.flush().map_err(failed)?;
    std::fs::rename(&partial, out.path().join(FILE)).map_err(failed)?;
    Ok((run, rows))
}
