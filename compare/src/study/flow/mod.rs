//! The flow about a pair at an instant of its run, on a grid in the plane of motion.
//!
//! [`FlowStudy`] finds the instant and the flow, [`FlowField`] holds the flow on a grid, [`SurfaceField`] that on a sphere.

mod field;
mod frames;
mod instant;
mod section;
mod surface;
#[cfg(test)]
mod tests;

use std::fmt;

use scene::nalgebra::Vector3;
use scene::{Flow, Fluid, MovingPair, Plan, Run, RunOptions, Sample};

pub use field::{FlowField, FlowPoint, FlowRow, states};
pub use frames::{PART, each_frame, frame_name};
pub use instant::Instant;
pub use section::{Section, Window};
pub use surface::{SurfaceField, fastest};

use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, Model, ModelOptions, SceneFile};

/// Whose velocity is subtracted from that of the fluid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FlowFrame {
    /// Nothing is subtracted: the fluid is at rest far away.
    #[default]
    Lab,
    /// The velocity of the squirmer of this index, 0 or 1; its spin is not.
    Squirmer(usize),
}

impl FlowFrame {
    /// All frames.
    pub const ALL: [Self; 3] = [Self::Lab, Self::Squirmer(0), Self::Squirmer(1)];

    /// The frame with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|frame| frame.name() == name)
    }

    /// Name on the command line and in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lab => "lab",
            Self::Squirmer(0) => "1",
            Self::Squirmer(_) => "2",
        }
    }

    /// The velocity that is subtracted.
    #[must_use]
    pub fn velocity(self, pair: &MovingPair) -> Vector3<f64> {
        match self {
            Self::Lab => Vector3::zeros(),
            Self::Squirmer(k) => pair.velocities[k],
        }
    }
}

impl fmt::Display for FlowFrame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Grid and frame of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowView {
    /// Points along either side of the window.
    pub grid: usize,
    /// Whose velocity is subtracted.
    pub frame: FlowFrame,
    /// Half width of the window, in radii; `None` shows both spheres and a margin.
    pub half_width: Option<f64>,
}

/// Allowed numbers of points along a side.
pub const GRIDS: (usize, usize) = (2, 2000);

/// Largest half width of a window, in radii.
pub const WIDEST: f64 = 1e6;

impl FlowView {
    /// Points along a side by default: as many as a picture has pixels, fewer for boundary elements, which take longer, and for a film.
    #[must_use]
    pub fn default_grid(method: Method, is_film: bool) -> usize {
        if is_film || method == Method::Bem {
            120
        } else {
            400
        }
    }

    /// Refuses what no picture can have.
    ///
    /// # Errors
    /// [`CompareError::Input`].
    pub fn check(&self) -> Result<(), CompareError> {
        let (least, most) = GRIDS;
        if !(least..=most).contains(&self.grid) {
            let allowed = format!("give a number of points from {least} to {most}");
            return Err(CompareError::input("--grid", self.grid, allowed));
        }
        match self.half_width {
            Some(half) if !(half > 0.0 && half <= WIDEST) => {
                let allowed =
                    format!("give a half width in radii, greater than 0, at most {WIDEST}");
                Err(CompareError::input("--window", half, allowed))
            }
            _ => Ok(()),
        }
    }
}

/// A scene and a model that knows its flow.
pub struct FlowStudy {
    method: Method,
    fluid: Box<dyn Fluid>,
    model: Model,
    plan: Plan,
    run: RunOptions,
}

impl FlowStudy {
    /// Sets up the model of a scene file.
    ///
    /// # Errors
    /// [`CompareError::Input`] if the model knows no flow; others as [`Model::set_up`] and [`Plan::new`].
    pub fn new(file: &SceneFile, options: ModelOptions) -> Result<Self, CompareError> {
        let plan = Plan::new(&file.scene)?;
        let options = file.model_options(&plan, options);
        let fluid = file.method.fluid(&options, file.scene.ratio())?;
        let model = Model::set_up(file.method, &options)?;
        Ok(Self::of(model, fluid, plan, file.run))
    }

    /// Of a model that is set up to run a plan, as `run` says, and the same model as one that knows the flow.
    #[must_use]
    pub fn of(model: Model, fluid: Box<dyn Fluid>, plan: Plan, run: RunOptions) -> Self {
        Self {
            method: model.method(),
            fluid,
            model,
            plan,
            run,
        }
    }

    /// The model of the flow.
    #[must_use]
    pub fn into_fluid(self) -> Box<dyn Fluid> {
        self.fluid
    }

    /// The method.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// Fingerprint of the model.
    #[must_use]
    pub fn fingerprint(&self) -> String {
        self.fluid.fingerprint()
    }

    /// The whole run with its samples.
    fn samples(&self, options: &RunOptions) -> Result<(Run, Vec<Sample>), CompareError> {
        let progress = Progress::begin("run", options.end_time.ceil() as usize, Pieces::Time);
        let mut samples = Vec::new();
        let run = self
            .model
            .run_observed(&self.plan, options, &mut |sample| {
                progress.reach(sample.t as usize);
                samples.push(*sample);
            })?;
        Ok((run, samples))
    }

    /// The pair as it moves at each of some instants.
    ///
    /// # Errors
    /// As [`MovingPair::free`].
    pub fn pairs(&self, at: &[Sample]) -> Result<Vec<MovingPair>, CompareError> {
        let progress = Progress::begin("velocities", at.len(), Pieces::Alike);
        // A table of the run may lack loads, such as those that turn a squirmer about its axis.
        let pair = |sample: &Sample| {
            let pair = MovingPair::free(&self.plan, self.fluid.as_ref(), &sample.configuration)?;
            progress.advance();
            Ok(pair)
        };
        at.iter().map(pair).collect()
    }

    /// The flow about a pair.
    ///
    /// # Errors
    /// As [`Fluid::flow`].
    pub fn flow(&self, pair: &MovingPair) -> Result<Box<dyn Flow>, CompareError> {
        Ok(self.fluid.flow(pair)?)
    }

    /// The flow on a grid in the plane of motion.
    #[must_use]
    pub fn field(&self, t: f64, flow: &dyn Flow, window: Window, view: &FlowView) -> FlowField {
        FlowField::sample(self.method, t, flow, window, view)
    }

    /// The windows on pairs: all of one size, each about its pair.
    #[must_use]
    pub fn windows(&self, at: &[Sample], half_width: Option<f64>) -> Vec<Window> {
        let sections: Vec<_> = (at.iter())
            .map(|sample| Section::of(&self.plan, &sample.configuration))
            .collect();
        let needed = || {
            let each = sections.iter().zip(at);
            each.map(|(section, sample)| section.half_width(&sample.configuration))
                .fold(0.0, f64::max)
        };
        let half_width = half_width.unwrap_or_else(needed);
        (sections.into_iter().zip(at))
            .map(|(section, sample)| Window::about(section, &sample.configuration, half_width))
            .collect()
    }
}
