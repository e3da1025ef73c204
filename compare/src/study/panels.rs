//! Bottom-heavy squirmers under gravity (the paper's Fig. 8a-f): their trajectories, and how far down a bound pair
//! swims compared with two lone squirmers.

use rayon::prelude::*;
use scene::{Configuration, Run, RunOptions, Sample, Scene};
use serde::{Deserialize, Serialize};

use crate::columns::columns;
use crate::no_run::RunNumbers;
use crate::output::{OutputFolder, csv_text};
use crate::study::maps::Pair;
use crate::sweep::SweepOptions;
use crate::watch::{Pieces, Progress, notice};
use crate::{CompareError, Method, Model, NoRun};

/// Time between the rows of a trajectory, in `a/V_s`.
const SAMPLE_INTERVAL: f64 = 0.2;

/// One panel: a pair and its initial directions.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PanelCase {
    /// Letter of the panel.
    pub panel: String,
    /// Squirmer parameter of both squirmers.
    pub beta: f64,
    /// Bottom-heaviness of both squirmers.
    pub g: f64,
    /// Difference of the initial angles, `(phi2 - phi1)/pi`.
    pub delta: f64,
    /// Sum of the initial angles, `(phi2 + phi1)/pi`.
    pub sigma: f64,
    /// End of the time that the panel shows, in `a/V_s`.
    pub until: f64,
}

impl PanelCase {
    /// The scene of this panel.
    ///
    /// # Errors
    /// [`CompareError::FamilyPoint`] for numbers that are not finite.
    pub fn scene(&self) -> Result<Scene, CompareError> {
        let Self { beta, g, .. } = *self;
        Pair { beta, g, dz: 0.0 }.scene(self.delta, self.sigma)
    }
}

/// One panel by one method.
#[derive(Clone, Debug)]
pub struct PanelRun {
    /// The panel.
    pub case: PanelCase,
    /// The method.
    pub method: Method,
    /// The whole run with its samples, or the reason why there is no run.
    pub run: Result<Run, NoRun>,
}

columns! {
    /// A row for each sample of a trajectory.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct TrajectoryRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Letter of the panel: the start of the trajectory.
        #[unit = "-"]
        pub panel: String,
        /// Time from the start.
        #[unit = "a/V_s"]
        pub t: f64,
        /// x of the centre of squirmer 1.
        #[unit = "a"]
        pub x1: f64,
        /// y of the centre of squirmer 1.
        #[unit = "a"]
        pub y1: f64,
        /// x of the centre of squirmer 2.
        #[unit = "a"]
        pub x2: f64,
        /// y of the centre of squirmer 2.
        #[unit = "a"]
        pub y2: f64,
        /// Angle from the x axis to the orientation of squirmer 1, without jumps of 360 degrees.
        #[unit = "deg"]
        pub angle1_deg: f64,
        /// Angle from the x axis to the orientation of squirmer 2, without jumps of 360 degrees.
        #[unit = "deg"]
        pub angle2_deg: f64,
        /// Gap between the surfaces of the squirmers.
        #[unit = "a"]
        pub gap: f64,
    }
}

/// One line of the summary: the state of a panel's pair at the end of the run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PanelRow {
    /// Letter of the panel.
    pub panel: String,
    /// Name of the method.
    pub method: Method,
    /// Squirmer parameter.
    pub beta: f64,
    /// Bottom-heaviness.
    pub g: f64,
    /// Difference of the initial angles, divided by pi.
    pub delta: f64,
    /// Sum of the initial angles, divided by pi.
    pub sigma: f64,
    /// Outcome at the end of the run, `failed` or `skipped`.
    pub outcome: String,
    /// Smallest gap, in radii.
    pub min_gap: f64,
    /// Depth of the pair compared with two lone squirmers, see [`depth_ratio`]; NaN if lone squirmers do not sink.
    pub depth_ratio: f64,
}

impl PanelRun {
    /// The samples that the panel shows.
    pub fn shown(&self) -> impl Iterator<Item = &Sample> {
        let samples = self.run.as_ref().map_or(&[][..], |run| &run.samples);
        samples.iter().filter(|s| s.t <= self.case.until)
    }

    /// The rows of the trajectory that the panel shows.
    pub fn trajectory(&self) -> impl Iterator<Item = TrajectoryRow> {
        self.shown().map(|Sample { t, configuration }| {
            let [one, two] = configuration.positions();
            let [angle1_deg, angle2_deg] = configuration.angles_rad.map(f64::to_degrees);
            TrajectoryRow {
                method: self.method,
                panel: self.case.panel.clone(),
                t: *t,
                x1: one.x,
                y1: one.y,
                x2: two.x,
                y2: two.y,
                angle1_deg,
                angle2_deg,
                gap: configuration.gap.eps(),
            }
        })
    }

    /// A message about a run without a result.
    #[must_use]
    pub fn failure(&self) -> Option<String> {
        let reason = self.run.as_ref().err()?;
        Some(format!(
            "panel {}, {}: {reason}",
            self.case.panel, self.method
        ))
    }

    /// The line of the summary.
    #[must_use]
    pub fn summary(&self) -> PanelRow {
        let PanelCase {
            panel,
            beta,
            g,
            delta,
            sigma,
            ..
        } = self.case.clone();
        let RunNumbers {
            outcome, min_gap, ..
        } = RunNumbers::of(&self.run);
        let depth_ratio = (self.run.as_ref()).map_or(f64::NAN, |run| depth_ratio(run, g));
        PanelRow {
            panel,
            method: self.method,
            beta,
            g,
            delta,
            sigma,
            outcome,
            min_gap,
            depth_ratio,
        }
    }
}

/// The runs of some panels, and the text of the file of their trajectories.
pub struct Panels {
    /// Every panel by every method. Methods are the outer loop.
    pub runs: Vec<PanelRun>,
    /// The trajectories as CSV.
    pub csv: String,
}

impl Panels {
    /// Runs every panel by every method, writes the trajectories to `NAME.csv`, reports the runs without a result and
    /// counts them in the account of the folder.
    ///
    /// # Errors
    /// [`CompareError::Write`].
    pub fn run(
        name: &str,
        models: &[&Model],
        panels: &[PanelCase],
        options: &SweepOptions,
        out: &OutputFolder,
    ) -> Result<Self, CompareError> {
        let runs = panel_runs(models, panels, options);
        out.account().enter(runs.iter().map(|run| &run.run));
        for failure in runs.iter().filter_map(PanelRun::failure) {
            notice!("{failure}");
        }
        let rows: Vec<_> = runs.iter().flat_map(PanelRun::trajectory).collect();
        let csv = csv_text(&rows)?;
        out.write_unless_less(&format!("{name}.csv"), &csv)?;
        Ok(Self { runs, csv })
    }
}

/// Runs every panel by every method. Methods are the outer loop.
#[must_use]
pub fn panel_runs(
    models: &[&Model],
    panels: &[PanelCase],
    options: &SweepOptions,
) -> Vec<PanelRun> {
    let started = std::time::Instant::now();
    let run_options = RunOptions {
        sample_interval: Some(SAMPLE_INTERVAL),
        ..options.run
    };
    let pairs: Vec<_> = (models.iter())
        .flat_map(|model| panels.iter().map(move |panel| (model, panel)))
        .collect();
    let progress = Progress::begin("panels", pairs.len(), Pieces::Alike);
    (pairs.into_par_iter())
        .map(|(model, panel)| {
            let late = (options.time_limit).is_some_and(|limit| started.elapsed() >= limit);
            let run = if late {
                Err(NoRun::Skipped)
            } else {
                model.attempt(panel.scene(), &run_options)
            };
            progress.advance();
            PanelRun {
                case: panel.clone(),
                method: model.method(),
                run,
            }
        })
        .collect()
}

/// Ratio of two sums of depths: the greatest depths of the two squirmers of a run below their starting points, from
/// the samples, divided by those of two lone squirmers with the bottom-heaviness `g`. NaN if neither lone squirmer
/// sinks.
///
/// A lone squirmer at the angle `theta` to the upward direction turns at the rate `-k sin(theta)`, `k = G/(8 pi)`,
/// and rises with the speed `cos(theta)`. From `theta > pi/2` it sinks by `-ln(sin theta)/k` before it rises.
#[must_use]
pub fn depth_ratio(run: &Run, g: f64) -> f64 {
    let rate = g / (8.0 * std::f64::consts::PI);
    let depth = |k: usize| {
        let height = |c: &Configuration| c.positions()[k].y;
        let lowest = (run.samples.iter())
            .map(|s| height(&s.configuration))
            .fold(f64::INFINITY, f64::min);
        height(&run.start) - lowest
    };
    let alone = |k: usize| {
        let p = run.start.orientations[k];
        if p.y < 0.0 {
            -p.x.abs().ln() / rate
        } else {
            0.0
        }
    };
    let alone = alone(0) + alone(1);
    if alone > 0.0 {
        (depth(0) + depth(1)) / alone
    } else {
        f64::NAN
    }
}
