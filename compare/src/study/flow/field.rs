//! The flow on a grid, and its rows.

use rayon::prelude::*;
use scene::nalgebra::Vector3;
use scene::{Flow, FluidState, MovingPair, SceneError};
use serde::Serialize;

use super::{FlowFrame, FlowView, Window};
use crate::columns::columns;
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, stoppable};

columns! {
    /// A row for each point of the grid, those of the lowest line first. Within a sphere velocity, speed and pressure are `NaN`.
    #[derive(Clone, Copy, Debug, PartialEq, Serialize)]
    pub struct FlowRow {
        /// Time from the start of the run.
        #[unit = "a/V_s"]
        pub t: f64,
        /// Gap between the surfaces of the squirmers.
        #[unit = "a"]
        pub gap: f64,
        /// Hydrodynamic method.
        #[unit = "-"]
        pub method: Method,
        /// Whose velocity is subtracted from that of the fluid: `lab` nobody's, `1` or `2` that squirmer's, whose spin is not.
        #[unit = "-"]
        pub frame: &'static str,
        /// x of the point.
        #[unit = "a"]
        pub x: f64,
        /// y of the point.
        #[unit = "a"]
        pub y: f64,
        /// z of the point.
        #[unit = "a"]
        pub z: f64,
        /// Velocity of the fluid along x.
        #[unit = "V_s"]
        pub u_x: f64,
        /// Velocity of the fluid along y.
        #[unit = "V_s"]
        pub u_y: f64,
        /// Velocity of the fluid along z.
        #[unit = "V_s"]
        pub u_z: f64,
        /// Magnitude of the velocity.
        #[unit = "V_s"]
        pub speed: f64,
        /// Pressure, zero far away.
        #[unit = "mu V_s/a"]
        pub pressure: f64,
        /// Number of the squirmer that the point lies within, 0 in the fluid.
        #[unit = "-"]
        pub inside: usize,
    }
}

/// A point of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowPoint {
    /// Where it is, in the laboratory.
    pub place: Vector3<f64>,
    /// Velocity in the frame of the field, and pressure; NaN within a sphere.
    pub state: FluidState,
    /// Index of the squirmer that it lies within.
    pub inside: Option<usize>,
}

/// The flow about a pair on a square grid in a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct FlowField {
    /// The model.
    pub method: Method,
    /// Time from the start of the run.
    pub t: f64,
    /// The pair, in the laboratory frame.
    pub pair: MovingPair,
    /// Whose velocity is subtracted.
    pub frame: FlowFrame,
    /// Where the grid is.
    pub window: Window,
    /// Points along a side; each is the middle of a square cell of the window.
    pub side: usize,
    /// The points, by lines from the lowest upward, each from left to right.
    pub points: Vec<FlowPoint>,
    /// Estimate of the largest error of the velocity.
    pub error_estimate: f64,
}

/// The squirmer that a point lies within, and the flow there, which is NaN in a squirmer.
fn state_at(flow: &dyn Flow, place: &Vector3<f64>) -> (Option<usize>, FluidState) {
    let nowhere = FluidState {
        velocity: Vector3::repeat(f64::NAN),
        pressure: f64::NAN,
    };
    let inside = flow.pair().within(place);
    (inside, inside.map_or_else(|| flow.at(place), |_| nowhere))
}

/// Points between two reports of progress.
const PART: usize = 256;

/// Velocity, in the laboratory frame, and pressure at some points; NaN within a sphere. Every point is computed by itself, in parallel.
///
/// # Errors
/// [`CompareError::Scene`] if work was given up ([`crate::watch::give_up`]).
pub fn states(flow: &dyn Flow, points: &[Vector3<f64>]) -> Result<Vec<FluidState>, CompareError> {
    let progress = Progress::begin("flow", points.len().div_ceil(PART), Pieces::Alike);
    let of_part = |part: &[Vector3<f64>]| {
        stoppable::check()?;
        let found: Vec<_> = part.iter().map(|place| state_at(flow, place).1).collect();
        progress.advance();
        Ok(found)
    };
    let parts: Result<Vec<_>, SceneError> = points.par_chunks(PART).map(of_part).collect();
    Ok(parts?.concat())
}

impl FlowField {
    /// Samples a flow in parallel; every point is computed by itself, so that its bits depend on no other.
    pub(super) fn sample(
        method: Method,
        t: f64,
        flow: &dyn Flow,
        window: Window,
        view: &FlowView,
    ) -> Self {
        let side = view.grid;
        let pair = *flow.pair();
        let moving = view.frame.velocity(&pair);
        let share = |index: usize| (index as f64 + 0.5) / side as f64;
        let points = (0..side * side)
            .into_par_iter()
            .map(|index| {
                let at = window.at((share(index % side), share(index / side)));
                let place = window.section.point(at);
                let (inside, mut state) = state_at(flow, &place);
                state.velocity -= moving;
                FlowPoint {
                    place,
                    state,
                    inside,
                }
            })
            .collect();
        Self {
            method,
            t,
            pair,
            frame: view.frame,
            window,
            side,
            points,
            error_estimate: flow.error_estimate(),
        }
    }

    /// The largest speed at the points; 0 without a point in the fluid.
    #[must_use]
    pub fn largest_speed(&self) -> f64 {
        (self.points.iter())
            .map(|point| point.state.velocity.norm())
            .fold(0.0, f64::max)
    }

    /// The largest component of the velocity across the plane.
    #[must_use]
    pub fn largest_across(&self) -> f64 {
        let normal = self.window.section.normal();
        (self.points.iter())
            .map(|point| point.state.velocity.dot(&normal).abs())
            .fold(0.0, f64::max)
    }

    /// The rows of `flow.csv`.
    #[must_use]
    pub fn rows(&self) -> Vec<FlowRow> {
        let row = |point: &FlowPoint| {
            let FluidState { velocity, pressure } = point.state;
            FlowRow {
                t: self.t,
                gap: self.pair.configuration.gap.eps(),
                method: self.method,
                frame: self.frame.name(),
                x: point.place.x,
                y: point.place.y,
                z: point.place.z,
                u_x: velocity.x,
                u_y: velocity.y,
                u_z: velocity.z,
                speed: velocity.norm(),
                pressure,
                inside: point.inside.map_or(0, |k| k + 1),
            }
        };
        self.points.iter().map(row).collect()
    }
}
