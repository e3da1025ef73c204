//! Runs a scene from start to end.
//!
//! A model with a cut (lubrication theory) is run as an alternation of free flights, jumped over
//! in closed form, and contacts, integrated; the crossing of the cut is located both ways. A model
//! without a cut is one integration. Departure, the crossing of `eps = 1` and the smallest gap are
//! located, not stepped over.

mod flight;
mod follow;
mod outgoing;

use self::flight::Flown;
pub(super) use self::outgoing::MOST_DOUBLINGS;
use self::outgoing::Outgoing;
use super::dispatch::{Task, dispatch};
use super::equations::{Dynamics, Effect, PairMotion};
use super::floor::Floor;
use super::moving::Moving;
use super::outcome::{Outcome, Righting, judge_steady};
use super::recorder::Recorder;
use super::result::{Counters, Run, RunOptions, Sample};
use super::steady::{Attempts, steady_state};
use super::watch::Watch;
use crate::frame::Configuration;
use crate::ode::{OdeError, Step, Stepper};
use crate::{Gap, Gravity, Hydrodynamics, Plan, Repulsion, Scene, SceneError};

/// Gap up to which the paper counts the time of an interaction, in radii of the smaller squirmer.
const CONTACT_GAP: f64 = 1.0;

/// Alternations of flight and contact after which a run is given up.
const MAX_PHASES: usize = 100_000;

/// Runs `scene` under the hydrodynamics of `model`.
///
/// # Errors
/// [`SceneError`] if the spheres overlap at the start, the model cannot give the loads at a gap
/// that the pair reaches, the stepper fails, or an option is not allowed.
pub fn run(
    scene: &Scene,
    model: &dyn Hydrodynamics,
    options: &RunOptions,
) -> Result<Run, SceneError> {
    run_plan(&Plan::new(scene)?, model, options)
}

/// Runs a plan under the hydrodynamics of `model`.
///
/// # Errors
/// As [`run`].
pub fn run_plan(
    plan: &Plan,
    model: &dyn Hydrodynamics,
    options: &RunOptions,
) -> Result<Run, SceneError> {
    let mut samples = Vec::new();
    let run = run_observed(plan, model, options, &mut |sample| samples.push(*sample))?;
    Ok(Run { samples, ..run })
}

/// Runs a plan and hands over its samples as they come; the result holds none.
///
/// # Errors
/// As [`run`].
pub fn run_observed(
    plan: &Plan,
    model: &dyn Hydrodynamics,
    options: &RunOptions,
    observe: &mut dyn FnMut(&Sample),
) -> Result<Run, SceneError> {
    run_monomorphic(plan, model, options, observe)
}

/// As [`run_observed`], with a loop that is compiled for this type of model. It pays for closed forms alone, and takes long to
/// compile: call it in one place.
///
/// # Errors
/// As [`run`].
pub fn run_monomorphic<H: Hydrodynamics + ?Sized>(
    plan: &Plan,
    model: &H,
    options: &RunOptions,
    observe: &mut dyn FnMut(&Sample),
) -> Result<Run, SceneError> {
    options.check()?;
    plan.check_ratio(model)?;
    let Some(plane) = plan.plane() else {
        let phases = None;
        return dispatch(
            plan,
            model,
            Observed {
                options,
                observe,
                phases,
            },
        );
    };
    let outside = |t: f64, within: &Configuration| {
        // The start is the scene's own, to the last bit.
        if t > 0.0 {
            plane.outside(within)
        } else {
            *plan.start()
        }
    };
    let mut observe_outside = |sample: &Sample| {
        let configuration = outside(sample.t, &sample.configuration);
        observe(&Sample {
            configuration,
            ..*sample
        });
    };
    let (observe, phases): (&mut dyn FnMut(&Sample), _) = (&mut observe_outside, None);
    let run = dispatch(
        plan,
        model,
        Observed {
            options,
            observe,
            phases,
        },
    )?;
    Ok(Run {
        start: *plan.start(),
        end: outside(run.end_time, &run.end),
        outgoing: outside(run.end_time, &run.outgoing),
        ..run
    })
}

/// A part of a run under one equation of motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Phase {
    /// When it begins.
    pub t: f64,
    /// The pair then.
    pub start: Configuration,
    /// Whether the two fly freely, beyond a cut.
    pub is_free: bool,
}

/// Runs a plan in three dimensions, and says of which phases the run consists.
///
/// # Errors
/// As [`run`].
pub(super) fn run_phases(
    plan: &Plan,
    model: &dyn Hydrodynamics,
    options: &RunOptions,
) -> Result<(Run, Vec<Phase>), SceneError> {
    options.check()?;
    plan.check_ratio(model)?;
    let (mut phases, observe) = (Vec::new(), &mut |_: &Sample| {});
    let task = Observed {
        options,
        observe,
        phases: Some(&mut phases),
    };
    let run = dispatch(plan, model, task)?;
    Ok((run, phases))
}

/// The task of running a plan.
struct Observed<'a, 'b> {
    options: &'a RunOptions,
    observe: &'a mut (dyn FnMut(&Sample) + 'b),
    /// Where its phases are entered, if they are asked for.
    phases: Option<&'a mut Vec<Phase>>,
}

impl Task for Observed<'_, '_> {
    type Output = Result<Run, SceneError>;

    fn perform<H, C, R, G, const N: usize>(
        self,
        plan: &Plan,
        motion: PairMotion<'_, H, C, R, G>,
    ) -> Self::Output
    where
        H: Hydrodynamics + ?Sized,
        C: Dynamics<N>,
        R: Effect<Repulsion>,
        G: Effect<Gravity>,
    {
        let mut motion = PairMotion {
            held_below_range: true,
            ..motion
        };
        let model = ModelEnds {
            floor: Floor::of(motion.model),
            cutoff: motion.model.cutoff(),
            free_flight_beyond: plan.free_flight_beyond(motion.model),
        };
        Runner::new(plan, &mut motion, model, self).run()
    }
}

/// Why an integrated phase ended.
enum PhaseEnd {
    /// The pair receded through the gap at which it parts (the cut, or the departure distance).
    Parted,
    /// The gap is the smallest there is: the spheres touch, or the model answers for no smaller one.
    Closed(Outcome),
    /// The pair settled in a steady state, carried on to the end time.
    Steady(Outcome),
    /// Time is up.
    Time,
}

/// Where a model ends.
struct ModelEnds {
    floor: Floor,
    cutoff: Option<f64>,
    free_flight_beyond: Option<f64>,
}

struct Runner<'a, 'b, const N: usize> {
    options: &'a RunOptions,
    motion: &'a mut dyn Moving<N>,
    /// Index of `ln eps` in the state.
    ln_gap: usize,
    model: ModelEnds,
    recorder: Recorder<'a, 'b>,
    phases: Option<&'a mut Vec<Phase>>,
    watch: Watch,
    start: Configuration,
    t: f64,
    now: Configuration,
    /// `ln eps` at the gap up to which the time of an interaction counts.
    ln_contact: f64,
    min_gap: f64,
    contact_time: f64,
    counters: Counters,
    settled: Option<f64>,
    unit_drift: f64,
}

impl<'a, 'b, const N: usize> Runner<'a, 'b, N> {
    fn new(
        plan: &Plan,
        motion: &'a mut dyn Moving<N>,
        model: ModelEnds,
        task: Observed<'a, 'b>,
    ) -> Self {
        let start = motion.chart().restored(plan.start_in_frame());
        let righting = (motion.gravity()).map(|g| Righting::new(g, motion.squirmers()));
        let ln_contact = (CONTACT_GAP * start.smaller_radius()).ln();
        Self {
            options: task.options,
            recorder: Recorder::new(task.options.sample_interval, task.observe),
            phases: task.phases,
            watch: Watch::new(righting, task.options.end_time),
            ln_gap: motion.chart().ln_gap(),
            motion,
            model,
            start,
            t: 0.0,
            now: start,
            ln_contact,
            min_gap: start.gap.eps(),
            contact_time: 0.0,
            counters: Counters::default(),
            settled: None,
            unit_drift: 0.0,
        }
    }

    fn run(mut self) -> Result<Run, SceneError> {
        // A start beyond the range is left to the right-hand side.
        if self.start.gap < self.model.floor.gap {
            self.motion.check_gap(self.start.gap)?;
        }
        self.recorder.record(0.0, self.now);
        let outcome = match self.model.free_flight_beyond {
            Some(cutoff) => self.run_with_cutoff(cutoff)?,
            None => self.run_without_cutoff()?,
        };
        self.recorder.record(self.t, self.now);
        // Beyond a cut, and under gravity, there is no far field to wait for.
        let cut = self.model.cutoff.is_some();
        let goes_on = outcome == Outcome::Scattered && !cut && self.motion.gravity().is_none();
        let outgoing = if goes_on {
            self.fly_out()?
        } else {
            Outgoing::at_end(self.now)
        };
        self.counters.loads = self.motion.loads();
        Ok(Run {
            start: self.start,
            end: self.now,
            outgoing: outgoing.configuration,
            truncation_rad: outgoing.truncation_rad,
            end_time: self.t,
            min_gap: self.min_gap,
            contact_time: self.contact_time,
            outcome,
            settled: self.settled,
            unit_drift: self.unit_drift,
            counters: self.counters,
            samples: Vec::new(),
        })
    }

    /// Counts time in contact, which rounding of the sum brings to no more than the time so far.
    fn add_contact(&mut self, from: f64, to: f64) {
        self.contact_time = (self.contact_time + (to - from).max(0.0)).min(to);
    }

    fn run_without_cutoff(&mut self) -> Result<Outcome, SceneError> {
        // Under gravity squirmers turn and may meet again: only time ends such a run.
        let departure = match self.motion.gravity() {
            Some(_) => None,
            None => Some(self.gap_at(self.options.departure_distance * self.larger_radius())?),
        };
        match self.integrate(departure)? {
            PhaseEnd::Parted => Ok(Outcome::Scattered),
            PhaseEnd::Closed(outcome) | PhaseEnd::Steady(outcome) => Ok(outcome),
            PhaseEnd::Time => Ok(self.judge_bound()),
        }
    }

    fn run_with_cutoff(&mut self, cutoff: f64) -> Result<Outcome, SceneError> {
        let cut = Gap::from_ln(cutoff.ln());
        let mut free = self.now.gap.eps() >= cutoff;
        let most = MAX_PHASES.min(self.options.max_steps);
        for _ in 0..most {
            if free {
                match self.fly(cut)? {
                    Flown::Contact if cut.eps() <= 0.0 => return Ok(Outcome::Contact),
                    Flown::Contact => free = false,
                    Flown::Parted => return Ok(Outcome::Scattered),
                    Flown::Time => return Ok(self.judge_bound()),
                }
            } else {
                match self.integrate(Some(cut))? {
                    PhaseEnd::Parted => free = true,
                    PhaseEnd::Closed(outcome) | PhaseEnd::Steady(outcome) => return Ok(outcome),
                    PhaseEnd::Time => return Ok(self.judge_bound()),
                }
            }
            self.recorder.record(self.t, self.now);
        }
        Err(SceneError::TooManyPhases {
            phases: most,
            t: self.t,
        })
    }

    /// Enters a phase that begins now.
    fn begin_phase(&mut self, is_free: bool) {
        let (t, start) = (self.t, self.now);
        if let Some(phases) = &mut self.phases {
            phases.push(Phase { t, start, is_free });
        }
    }

    fn judge_bound(&self) -> Outcome {
        let speeds = self
            .motion
            .squirmers()
            .iter()
            .map(|s| s.swimming_speed().abs());
        self.watch
            .judge_bound(self.t, &self.now, speeds.fold(0.0, f64::max))
    }

    /// Integrates until the pair recedes through `parting`, or to the end time.
    fn integrate(&mut self, parting: Option<Gap>) -> Result<PhaseEnd, SceneError> {
        let end_time = self.options.end_time;
        if self.t >= end_time {
            return Ok(PhaseEnd::Time);
        }
        self.begin_phase(false);
        let (y, mut stepper) = self.stepper(end_time)?;
        let tolerance = self.options.tolerance;
        let beyond = |ln_gap: f64| parting.is_some_and(|parting| ln_gap >= parting.ln());
        if beyond(y[self.ln_gap]) && stepper.dy()[self.ln_gap] > 0.0 {
            return Ok(PhaseEnd::Parted);
        }
        if y[self.ln_gap] <= self.model.floor.gap.ln() && stepper.dy()[self.ln_gap] < 0.0 {
            return Ok(PhaseEnd::Closed(self.model.floor.outcome));
        }
        let mut attempts = Attempts::new(tolerance);
        let end = loop {
            let step = self.motion.step(&mut stepper, end_time);
            let step = step.map_err(|error| self.failure(error))?;
            // What a trial step was refused for is no cause of what comes later.
            self.motion.take_failure();
            let ended = self.follow(&step, parting);
            if let Some(end) = ended.map_err(|error| self.failure(error))? {
                break end;
            }
            if self.t >= end_time {
                break PhaseEnd::Time;
            }
            if let Some(outcome) = self.settle(&step, &mut attempts) {
                break PhaseEnd::Steady(outcome);
            }
        };
        self.count(&stepper);
        Ok(end)
    }

    /// A stepper from the present configuration to `end_time`, with the state of that configuration and the steps
    /// that are left.
    fn stepper(&mut self, end_time: f64) -> Result<([f64; N], Stepper<N>), SceneError> {
        let y = self.motion.chart().encode(&self.now);
        let tolerance = self.options.tolerance;
        let stepper = Stepper::new(self.motion, self.t, y, tolerance, end_time);
        let taken = (self.counters.steps + self.counters.rejected) as usize;
        let left = self.options.max_steps.saturating_sub(taken);
        let stepper = stepper.map_err(|error| self.failure(error))?;
        Ok((y, stepper.with_max_steps(left)))
    }

    /// Enters the steps that were taken.
    fn count(&mut self, stepper: &Stepper<N>) {
        self.counters.steps += stepper.accepted() as u64;
        self.counters.rejected += stepper.rejected() as u64;
    }

    /// If a step ends at a steady state that holds, carries the pair on to the end time.
    fn settle(&mut self, step: &Step<N>, attempts: &mut Attempts) -> Option<Outcome> {
        let relative = self.motion.chart().relative();
        let relative = relative.filter(|_| self.motion.gravity().is_none())?;
        if step.y1[self.ln_gap] > self.ln_contact {
            return None;
        }
        let last = (&step.y1, &step.dy1);
        let (y, dy) = steady_state(self.motion, self.t, last, relative, attempts)?;
        if y[self.ln_gap] < self.model.floor.gap.ln() {
            return None;
        }
        let (from, left) = (self.t, self.options.end_time - self.t);
        let chart = self.motion.chart();
        let earlier = chart.decode(&y, &self.now);
        let end = chart.decode(&chart.carried_on(&y, &dy, left)?, &earlier);
        self.recorder.record_between(self.options.end_time, |t| {
            let carried = chart.carried_on(&y, &dy, t - from).unwrap_or(y);
            chart.decode(&carried, &earlier)
        });
        self.min_gap = self.min_gap.min(end.gap.eps());
        self.add_contact(from, self.options.end_time);
        self.settled = Some(from);
        self.now = end;
        self.t = self.options.end_time;
        Some(judge_steady(&earlier, &end, left))
    }

    /// Radius of the larger squirmer.
    fn larger_radius(&self) -> f64 {
        let [one, two] = self.start.radii;
        one.max(two)
    }

    /// The gap at a distance of the centres.
    fn gap_at(&self, distance: f64) -> Result<Gap, SceneError> {
        let [one, two] = self.start.radii;
        Gap::new(distance - (one + two))
    }

    /// The stepper's error, or the model's that caused it.
    fn failure(&mut self, error: OdeError) -> SceneError {
        let failure = self.motion.take_failure();
        failure.unwrap_or(SceneError::Stepper { source: error })
    }
}

#[cfg(test)]
mod tests;
