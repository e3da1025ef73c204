//! Bottom-heavy squirmers under gravity (the paper's Fig. 8a-f): their trajectories, and how far down a bound pair
//! swims compared with two lone squirmers.

use rayon::prelude::*;
use scene::{Configuration, Run, RunOptions, Sample, Scene, SceneError};
use serde::{Deserialize, Serialize};

use crate::columns::columns;
use crate::maps::Pair;
use crate::sweep::SweepOptions;
use crate::watch::{Pieces, Progress};
use crate::{Method, Model, NoRun};

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
    /// [`SceneError`] for numbers that are not finite.
    pub fn scene(&self) -> Result<Scene, SceneError> {
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
        pub method: &'static str,
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
    pub method: &'static str,
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
                method: self.method.name(),
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
        let run = self.run.as_ref().ok();
        PanelRow {
            panel,
            method: self.method.name(),
            beta,
            g,
            delta,
            sigma,
            outcome: match &self.run {
                Ok(run) => run.outcome.to_string(),
                Err(none) => none.outcome().to_owned(),
            },
            min_gap: run.map_or(f64::NAN, |run| run.min_gap),
            depth_ratio: run.map_or(f64::NAN, |run| depth_ratio(run, g)),
        }
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
                (panel.scene())
                    .and_then(|scene| model.run(&scene, &run_options))
                    .map_err(|error| NoRun::Failed(error.to_string()))
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
