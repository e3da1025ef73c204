//! Runs a scene from start to end.
//!
//! A model with a cut (lubrication theory) is run as an alternation of free flights, jumped over
//! in closed form, and contacts, integrated; the crossing of the cut is located both ways. A model
//! without a cut is one integration. Departure, the crossing of `eps = 1` and the smallest gap are
//! located, not stepped over.

use super::configuration::Configuration;
use super::coordinates::Coordinates;
use super::dispatch::{Task, dispatch};
use super::equations::{Effect, PairMotion};
use super::free_flight::PairFlight;
use super::outcome::{GapHistory, LineHistory, Outcome, judge_bound, judge_steady};
use super::outcome::{judge_under_gravity, points_upward};
use super::result::{Counters, Run, RunOptions, Sample};
use super::steady::{Attempts, steady_state};
use crate::ode::{Dense, Direction, OdeError, Step, Stepper, first_crossing, first_minimum};
use crate::{Gap, Gravity, Hydrodynamics, Plan, Repulsion, Scene, SceneError};

/// Gap up to which the paper counts the time of an interaction.
const CONTACT_GAP: f64 = 1.0;

/// Share of a run after which the pair is watched to tell in which way it is bound.
const WATCHED_FROM: f64 = 0.75;

/// Alternations of flight and contact after which a run is given up.
const MAX_PHASES: usize = 100_000;

/// Gap at which spheres that nothing keeps apart are in contact. Without repulsion lubrication theory
/// closes it as `exp(-exp(t))`: they never touch, but come this close in a finite time.
const TOUCHING_GAP: f64 = 1e-300;

/// The gap at which a run ends that nothing opens again.
#[derive(Clone, Copy, Debug)]
struct Floor {
    gap: Gap,
    outcome: Outcome,
}

impl Floor {
    fn of<H: Hydrodynamics + ?Sized>(model: &H) -> Self {
        let smallest = model.range().smallest;
        if smallest > TOUCHING_GAP {
            Self {
                gap: Gap::from_ln(smallest.ln()),
                outcome: Outcome::Unresolved,
            }
        } else {
            Self {
                gap: Gap::from_ln(TOUCHING_GAP.ln()),
                outcome: Outcome::Contact,
            }
        }
    }
}

/// Runs `scene` under the hydrodynamics of `model`.
///
/// # Errors
/// [`SceneError`] if the spheres overlap at the start, the model cannot give the loads at a gap
/// that the pair reaches, the stepper fails, or an option is not allowed.
pub fn run<H: Hydrodynamics + ?Sized>(
    scene: &Scene,
    model: &H,
    options: &RunOptions,
) -> Result<Run, SceneError> {
    run_plan(&Plan::new(scene)?, model, options)
}

/// Runs a plan under the hydrodynamics of `model`.
///
/// # Errors
/// As [`run`].
pub fn run_plan<H: Hydrodynamics + ?Sized>(
    plan: &Plan,
    model: &H,
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
pub fn run_observed<H: Hydrodynamics + ?Sized>(
    plan: &Plan,
    model: &H,
    options: &RunOptions,
    observe: &mut dyn FnMut(&Sample),
) -> Result<Run, SceneError> {
    options.check()?;
    let Some(plane) = plan.plane() else {
        return dispatch(plan, model, Observed { options, observe });
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
    let observe = &mut observe_outside;
    let run = dispatch(plan, model, Observed { options, observe })?;
    Ok(Run {
        start: *plan.start(),
        end: outside(run.end_time, &run.end),
        ..run
    })
}

/// The task of running a plan.
struct Observed<'a, 'b> {
    options: &'a RunOptions,
    observe: &'a mut (dyn FnMut(&Sample) + 'b),
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
        C: Coordinates<N>,
        R: Effect<Repulsion>,
        G: Effect<Gravity>,
    {
        Runner::new(plan, motion, self).run()
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

struct Runner<'a, 'b, H: ?Sized, C, R, G, const N: usize> {
    plan: &'a Plan,
    options: &'a RunOptions,
    motion: PairMotion<'a, H, C, R, G>,
    observe: &'a mut (dyn FnMut(&Sample) + 'b),
    floor: Floor,
    start: Configuration,
    t: f64,
    now: Configuration,
    min_gap: f64,
    contact_time: f64,
    counters: Counters,
    /// Time of the last sample.
    observed: Option<f64>,
    /// Samples taken so far at multiples of the interval.
    sampled: u64,
    /// The first configuration in the watched part of the run, and the gaps since.
    watched: Option<(Sample, GapHistory)>,
    /// Under gravity: how the line of centres has turned since the pair was bound.
    line: Option<LineHistory>,
    settled: Option<f64>,
    unit_drift: f64,
}

impl<'a, 'b, H, C, R, G, const N: usize> Runner<'a, 'b, H, C, R, G, N>
where
    H: Hydrodynamics + ?Sized,
    C: Coordinates<N>,
    R: Effect<Repulsion>,
    G: Effect<Gravity>,
{
    fn new(plan: &'a Plan, mut motion: PairMotion<'a, H, C, R, G>, task: Observed<'a, 'b>) -> Self {
        motion.held_below_range = true;
        let start = motion.coordinates.restored(plan.start_in_frame());
        Self {
            plan,
            options: task.options,
            floor: Floor::of(motion.model),
            motion,
            observe: task.observe,
            start,
            t: 0.0,
            now: start,
            min_gap: start.gap.eps(),
            contact_time: 0.0,
            counters: Counters::default(),
            observed: None,
            sampled: 0,
            watched: None,
            line: None,
            settled: None,
            unit_drift: 0.0,
        }
    }

    fn run(mut self) -> Result<Run, SceneError> {
        self.check_start()?;
        self.record_start();
        let outcome = match self.plan.free_flight_beyond(self.motion.model) {
            Some(cutoff) => self.run_with_cutoff(cutoff)?,
            None => self.run_without_cutoff()?,
        };
        self.record(self.t, self.now);
        self.counters.loads = self.motion.loads;
        Ok(Run {
            start: self.start,
            end: self.now,
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

    /// Refuses a start below the range of the model, in the model's own words where it has some.
    fn check_start(&self) -> Result<(), SceneError> {
        let (model, gap) = (self.motion.model, self.start.gap);
        if gap.eps() >= model.range().smallest {
            return Ok(());
        }
        model.range().check(gap).or_else(|error| {
            model.interacting_loads(gap, self.motion.set)?;
            Err(error)
        })
    }

    fn run_without_cutoff(&mut self) -> Result<Outcome, SceneError> {
        // Under gravity squirmers turn and may meet again: only time ends such a run.
        let departure = match self.motion.gravity.get() {
            Some(_) => None,
            None => Some(Gap::new(self.options.departure_distance - 2.0)?),
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
        for _ in 0..MAX_PHASES.min(self.options.max_steps) {
            if free {
                match self.fly(cut)? {
                    Flown::Contact if cut.eps() <= 0.0 => return Ok(Outcome::Contact),
                    Flown::Contact => free = false,
                    Flown::Parted => return Ok(Outcome::Scattered),
                    Flown::Time => return Ok(self.judge_free()),
                }
            } else {
                match self.integrate(Some(cut))? {
                    PhaseEnd::Parted => free = true,
                    PhaseEnd::Closed(outcome) | PhaseEnd::Steady(outcome) => return Ok(outcome),
                    PhaseEnd::Time => return Ok(self.judge_bound()),
                }
            }
            self.record(self.t, self.now);
        }
        Err(SceneError::Stepper {
            reason: format!("no end to contacts and flights at t = {}", self.t),
        })
    }

    /// Straight flight parts for good; under gravity time may be up before the next contact.
    fn judge_free(&self) -> Outcome {
        match (self.motion.gravity.get(), &self.watched) {
            (Some(_), Some(_)) => self.judge_bound(),
            (Some(gravity), None) if points_upward(&self.now, gravity) => Outcome::Upward,
            _ => Outcome::Scattered,
        }
    }

    fn judge_bound(&self) -> Outcome {
        let Some((watched, gaps)) = &self.watched else {
            return Outcome::Undecided;
        };
        let speed = (self.plan.scene().squirmers.iter())
            .map(|s| s.swimming_speed().abs())
            .fold(0.0, f64::max);
        let (earlier, duration) = (&watched.configuration, self.t - watched.t);
        match self.motion.gravity.get() {
            Some(gravity) => {
                let ends = (earlier, &self.now);
                judge_under_gravity(ends, duration, speed, gaps, self.line.as_ref(), gravity)
            }
            None => judge_bound(earlier, &self.now, duration, speed),
        }
    }

    /// Flies freely to the next contact at the gap `cut`, or to the end.
    fn fly(&mut self, cut: Gap) -> Result<Flown, SceneError> {
        self.counters.flights += 1;
        let squirmers = &self.motion.squirmers;
        let flight = PairFlight::new(squirmers, self.motion.gravity.get(), self.now);
        let coordinates = self.motion.coordinates;
        let flown = |t: f64| coordinates.restored(flight.at(t));
        let left = self.options.end_time - self.t;
        let contact = flight.contact(cut.distance(), left, self.options.max_steps)?;
        let nearest = flight.closest_approach(contact.unwrap_or(left));
        self.min_gap = self.min_gap.min(flight.distance(nearest).0 - 2.0);
        // A straight pair that misses has parted when it begins to recede.
        let parted = contact.is_none() && flight.is_straight() && nearest < left;
        let duration = contact.unwrap_or(if parted { nearest } else { left });
        let end = self.t + duration;
        let from = self.t;
        self.record_between(end, |t| flown(t - from));
        if !flight.is_straight() {
            self.watch_flight(&flight, duration);
        }
        if contact != Some(0.0) {
            self.now = flown(duration);
        }
        self.t = end;
        self.watch();
        Ok(if contact.is_some() {
            self.now.gap = cut;
            self.min_gap = self.min_gap.min(cut.eps());
            Flown::Contact
        } else if parted {
            Flown::Parted
        } else {
            Flown::Time
        })
    }

    /// Integrates until the pair recedes through `parting`, or to the end time.
    fn integrate(&mut self, parting: Option<Gap>) -> Result<PhaseEnd, SceneError> {
        let end_time = self.options.end_time;
        if self.t >= end_time {
            return Ok(PhaseEnd::Time);
        }
        let y = self.motion.coordinates.encode(&self.now);
        let tolerance = self.options.tolerance;
        let stepper = Stepper::new(&mut self.motion, self.t, y, tolerance, end_time);
        let taken = (self.counters.steps + self.counters.rejected) as usize;
        let mut stepper = stepper
            .map_err(|error| self.failure(error))?
            .with_max_steps(self.options.max_steps.saturating_sub(taken));
        let beyond = |ln_gap: f64| parting.is_some_and(|parting| ln_gap >= parting.ln());
        if beyond(y[C::LN_GAP]) && stepper.dy()[C::LN_GAP] >= 0.0 {
            return Ok(PhaseEnd::Parted);
        }
        if y[C::LN_GAP] <= self.floor.gap.ln() && stepper.dy()[C::LN_GAP] < 0.0 {
            return Ok(PhaseEnd::Closed(self.floor.outcome));
        }
        let mut attempts = Attempts::new(tolerance);
        let end = loop {
            let step = stepper.step(&mut self.motion, end_time);
            let step = step.map_err(|error| self.failure(error))?;
            // What a trial step was refused for is no cause of what comes later.
            self.motion.failure = None;
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
        self.counters.steps += stepper.accepted() as u64;
        self.counters.rejected += stepper.rejected() as u64;
        Ok(end)
    }

    /// Keeps what the end of a run is judged by.
    fn watch(&mut self) {
        self.watch_at(self.t, self.now);
    }

    /// Whether configurations on the way are kept.
    fn is_watching(&self) -> bool {
        self.motion.gravity.get().is_some() || self.t >= WATCHED_FROM * self.options.end_time
    }

    fn watch_at(&mut self, t: f64, configuration: Configuration) {
        if self.motion.gravity.get().is_some() {
            self.line = LineHistory::follow(self.line, &configuration);
        }
        let ln_gap = configuration.gap.ln();
        match &mut self.watched {
            Some((_, gaps)) => gaps.take(ln_gap),
            None if t >= WATCHED_FROM * self.options.end_time => {
                let sample = Sample { t, configuration };
                self.watched = Some((sample, GapHistory::from(ln_gap)));
            }
            None => {}
        }
    }

    /// The same on the way of a flight of the given duration, which may go far out and come back.
    fn watch_flight(&mut self, flight: &PairFlight, duration: f64) {
        /// Instants at which a flight is looked at.
        const LOOKS: u32 = 32;
        for look in 1..LOOKS {
            let flown = duration * f64::from(look) / f64::from(LOOKS);
            self.watch_at(self.t + flown, flight.at(flown));
        }
    }

    /// If a step ends at a steady state that holds, carries the pair on to the end time.
    fn settle(&mut self, step: &Step<N>, attempts: &mut Attempts) -> Option<Outcome> {
        let relative = C::RELATIVE.filter(|_| self.motion.gravity.get().is_none())?;
        if step.y1[C::LN_GAP] > CONTACT_GAP.ln() {
            return None;
        }
        let last = (&step.y1, &step.dy1);
        let (y, dy) = steady_state(&mut self.motion, self.t, last, relative, attempts)?;
        if y[C::LN_GAP] < self.floor.gap.ln() {
            return None;
        }
        let (from, left) = (self.t, self.options.end_time - self.t);
        let coordinates = self.motion.coordinates;
        let earlier = coordinates.decode(&y, &self.now);
        let end = coordinates.decode(&coordinates.carried_on(&y, &dy, left)?, &earlier);
        self.record_between(self.options.end_time, |t| {
            let carried = coordinates.carried_on(&y, &dy, t - from).unwrap_or(y);
            coordinates.decode(&carried, &earlier)
        });
        self.min_gap = self.min_gap.min(end.gap.eps());
        self.contact_time += left;
        self.settled = Some(from);
        self.now = end;
        self.t = self.options.end_time;
        Some(judge_steady(&earlier, &end, left))
    }

    /// Takes in one step: up to the parting or touching if that lies in it, and then says so.
    fn follow(
        &mut self,
        step: &Step<N>,
        parting: Option<Gap>,
    ) -> Result<Option<PhaseEnd>, OdeError> {
        let of = C::LN_GAP;
        let turns = step.dy0[of] < 0.0 && step.dy1[of] >= 0.0;
        let crosses = |level: f64| (step.y0[of] <= level) != (step.y1[of] <= level);
        let contact = CONTACT_GAP.ln();
        let parts = parting.is_some_and(|gap| step.y1[of] >= gap.ln());
        let samples = (self.options.sample_interval)
            .is_some_and(|interval| self.next_sample(interval) <= step.t1);
        let floor = self.floor;
        let closes = step.y1[of] <= floor.gap.ln();
        let dense = if turns || crosses(contact) || parts || closes || samples {
            Some(step.dense(&mut self.motion)?)
        } else {
            None
        };
        // Below the range of a model nothing is known: neither may a gap dip there and open again within the step.
        let closes = closes
            || (turns && floor.outcome == Outcome::Unresolved)
                && dense.as_ref().is_some_and(|dense| {
                    first_minimum(dense, |_, y| y[of])
                        .is_some_and(|t| dense.at(t)[of] < floor.gap.ln())
                });
        let event = match parting {
            Some(gap) if parts => Some((gap, Direction::Rising, PhaseEnd::Parted)),
            _ if closes => Some((
                floor.gap,
                Direction::Falling,
                PhaseEnd::Closed(floor.outcome),
            )),
            _ => None,
        };
        let ends_at = match (&dense, &event) {
            (Some(dense), Some((gap, direction, _))) => {
                first_crossing(dense, |_, y| y[of] - gap.ln(), *direction, 0.0)
            }
            _ => None,
        };
        let (t, y) = match (&dense, ends_at, &event) {
            (Some(dense), Some(t), Some((gap, ..))) => {
                let mut y = dense.at(t);
                y[of] = gap.ln();
                (t, y)
            }
            _ => (step.t1, step.y1),
        };
        self.track_gap(step, dense.as_ref(), t, &y);
        let previous = self.now;
        let coordinates = self.motion.coordinates;
        if let Some(dense) = dense.filter(|_| samples) {
            self.record_between(t, |t| coordinates.decode(&dense.at(t), &previous));
        }
        self.unit_drift = self.unit_drift.max(coordinates.unit_drift(&y));
        self.t = t;
        let end = event.filter(|_| ends_at.is_some());
        // Until then nothing but the state itself is asked for.
        if C::WOUND || end.is_some() || self.is_watching() {
            self.now = coordinates.decode(&y, &previous);
            if let Some((gap, ..)) = end {
                self.now.gap = gap;
            }
            if let Some((_, gaps)) = self.watched.as_mut().filter(|_| turns) {
                gaps.minima += 1;
            }
            self.watch();
        }
        Ok(end.map(|(_, _, end)| end))
    }

    /// Smallest gap and time in contact over a step, up to `(t, y)`.
    fn track_gap(&mut self, step: &Step<N>, dense: Option<&Dense<N>>, t: f64, y: &[f64; N]) {
        let of = C::LN_GAP;
        let contact = CONTACT_GAP.ln();
        let mut least = step.y0[of].min(y[of]);
        let nearest = dense
            .filter(|_| step.dy0[of] < 0.0 && step.dy1[of] >= 0.0)
            .and_then(|dense| first_minimum(dense, |_, y| y[of]).map(|t| (t, dense.at(t)[of])))
            .filter(|(nearest, _)| *nearest < t);
        if let Some((_, ln_gap)) = nearest {
            least = least.min(ln_gap);
        }
        self.min_gap = self.min_gap.min(least.exp());
        let crossing = |direction| {
            dense.and_then(|dense| first_crossing(dense, |_, y| y[of] - contact, direction, 0.0))
        };
        let enters = if step.y0[of] <= contact {
            Some(step.t0)
        } else {
            crossing(Direction::Falling)
        };
        let leaves = if y[of] <= contact {
            Some(t)
        } else {
            crossing(Direction::Rising)
        };
        if let (Some(enters), Some(leaves)) = (enters, leaves) {
            self.contact_time += (leaves.min(t) - enters).max(0.0);
        }
    }

    /// The stepper's error, or the model's that caused it.
    fn failure(&mut self, error: OdeError) -> SceneError {
        self.motion.failure.take().unwrap_or(SceneError::Stepper {
            reason: error.to_string(),
        })
    }

    fn next_sample(&self, interval: f64) -> f64 {
        (self.sampled + 1) as f64 * interval
    }

    fn record_start(&mut self) {
        self.record(0.0, self.now);
    }

    /// Records the configurations at multiples of the sample interval up to the time `end`.
    fn record_between(&mut self, end: f64, at: impl Fn(f64) -> Configuration) {
        let Some(interval) = self.options.sample_interval else {
            return;
        };
        while self.next_sample(interval) < end {
            let t = self.next_sample(interval);
            self.sampled += 1;
            self.record(t, at(t));
        }
    }

    fn record(&mut self, t: f64, configuration: Configuration) {
        let repeats = self.observed.is_some_and(|last| last >= t);
        if self.options.sample_interval.is_some() && !repeats {
            self.observed = Some(t);
            (self.observe)(&Sample { t, configuration });
        }
    }
}

/// How a free flight ended.
enum Flown {
    Contact,
    Parted,
    Time,
}
