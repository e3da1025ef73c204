//! Directions along the path of a run: through its phases, across cuts, and out to infinity.

use nalgebra::Vector3;

use super::linearised::Linearised;
use super::perturbation::{CHART, NUMBERS, Perturbation, Variation};
use super::run::TangentRun;
use crate::frame::Configuration;
use crate::hydrodynamics::central_difference;
use crate::motion::chart::Chart as _;
use crate::motion::far_turn::turned_to_infinity;
use crate::motion::run::{MOST_DOUBLINGS, Phase};
use crate::motion::{Outcome, Run, RunOptions};
use crate::ode::{OdeError, Stepper};
use crate::{Gap, Plan, SceneError};

/// How the orientations that go out change in each direction.
type Outgoing = Vec<[Vector3<f64>; 2]>;

/// Relative change of a derivative at infinity at which it counts as known.
const KNOWN: f64 = 1e-9;

/// The path of a run, along which directions are followed.
pub(super) struct Path<'a> {
    pub plan: &'a Plan,
    pub options: &'a RunOptions,
    pub contact: Linearised<'a>,
    pub flight: Linearised<'a>,
    /// How the logarithm of the gap at the cut changes with the ratio of the radii.
    pub cut_by_ratio: f64,
}

impl<'a> Path<'a> {
    /// Follows the directions along the phases, and enters what becomes of them.
    pub fn follow<const N: usize>(
        mut self,
        phases: &[Phase],
        into: &mut TangentRun,
    ) -> Result<(), SceneError> {
        let directions = self.contact.directions;
        let run = &into.run;
        let mut y = [0.0; N];
        for (direction, block) in directions
            .iter()
            .zip(y[NUMBERS..].chunks_exact_mut(NUMBERS))
        {
            let variation = Variation {
                positions: direction.positions,
                orientations: direction.orientations,
            };
            block.copy_from_slice(&variation.encoded(direction.ratio, &run.start));
        }
        for (i, phase) in phases.iter().enumerate() {
            place(&mut y, &phase.start);
            let next = phases.get(i + 1);
            let (t, end) = next.map_or((run.end_time, run.end), |next| (next.t, next.start));
            if phase.is_free && self.plan.gravity().is_none() {
                self.fly_straight(&mut y, (&phase.start, &end), t - phase.t);
            } else {
                y = self.integrated(phase.is_free, y, (phase.t, t))?;
            }
            place(&mut y, &end);
            if next.is_some_and(|next| next.is_free != phase.is_free) {
                self.cross(phase.is_free, &mut y)?;
            }
        }
        let variations = decoded(directions, &y, &run.end);
        let goes_on = run.outcome == Outcome::Scattered
            && self.contact.model.cutoff().is_none()
            && self.plan.gravity().is_none();
        let (outgoing, truncation) = if goes_on {
            self.fly_out(y, run)?
        } else if run.has_outgoing_angles() {
            (variations.iter().map(|of| of.orientations).collect(), 0.0)
        } else {
            (vec![[Vector3::repeat(f64::NAN); 2]; directions.len()], 0.0)
        };
        into.end.extend(variations);
        into.outgoing.extend(outgoing);
        into.truncation = into.truncation.max(truncation);
        Ok(())
    }

    fn system(&mut self, is_free: bool) -> &mut Linearised<'a> {
        if is_free {
            &mut self.flight
        } else {
            &mut self.contact
        }
    }

    /// Lets the two fly straight for some time, from one configuration to another.
    fn fly_straight(&self, y: &mut [f64], of: (&Configuration, &Configuration), time: f64) {
        let (start, end) = of;
        let blocks = y[NUMBERS..].chunks_exact_mut(NUMBERS);
        for (direction, block) in self.flight.directions.iter().zip(blocks) {
            let mut variation = Variation::decoded(block, direction.ratio, start);
            for k in [0, 1] {
                let speed = self.flight.squirmers[k].swimming_speed();
                let faster = direction.modes[k][0] / 1.5;
                let velocity = variation.orientations[k] * speed + start.orientations[k] * faster;
                variation.positions[k] += velocity * time;
            }
            block.copy_from_slice(&variation.encoded(direction.ratio, end));
        }
    }

    /// The state after a phase.
    fn integrated<const N: usize>(
        &mut self,
        is_free: bool,
        y: [f64; N],
        (from, to): (f64, f64),
    ) -> Result<[f64; N], SceneError> {
        if to <= from {
            return Ok(y);
        }
        let (tolerance, most) = (self.options.tolerance, self.options.max_steps);
        let system = self.system(is_free);
        let stepper = Stepper::new(system, from, y, tolerance, to);
        let mut stepper = stepper
            .map_err(|error| failure(system, error))?
            .with_max_steps(most);
        while stepper.t() < to {
            let step = stepper.step(system, to);
            step.map_err(|error| failure(system, error))?;
        }
        Ok(*stepper.y())
    }

    /// Where a phase gives way to the other kind at a gap: what is perturbed comes there at another time, `dt = -d(ln eps) / (d(ln eps)/dt)` of the distance
    /// from the cut, and moves as before the crossing for so much longer than after it.
    fn cross<const N: usize>(
        &mut self,
        was_free: bool,
        y: &mut [f64; N],
    ) -> Result<(), SceneError> {
        let mut rates = |is_free: bool| {
            let mut dy = [0.0; N];
            self.system(is_free).rates(y, &mut dy).map(|()| dy)
        };
        let (before, after) = (rates(was_free)?, rates(!was_free)?);
        let blocks = y[NUMBERS..].chunks_exact_mut(NUMBERS);
        for (direction, block) in self.contact.directions.iter().zip(blocks) {
            let moved = self.cut_by_ratio * direction.ratio;
            let later = (moved - block[6]) / before[6];
            for ((of, before), after) in block.iter_mut().zip(&before).zip(&after) {
                *of += later * (before - after);
            }
        }
        Ok(())
    }

    /// How the orientations at infinity change, and by how much the last doubling of the distance changed that.
    fn fly_out<const N: usize>(
        &mut self,
        y: [f64; N],
        run: &Run,
    ) -> Result<(Outgoing, f64), SceneError> {
        let (tolerance, most) = (self.options.tolerance, self.options.max_steps);
        let system = &mut self.contact;
        let stepper = Stepper::new(system, run.end_time, y, tolerance, f64::MAX);
        let mut stepper = stepper
            .map_err(|error| failure(system, error))?
            .with_max_steps(most);
        let mut reached = at_infinity(system, &y, run)?;
        let (mut distance, mut last_change) = (run.end.distance(), f64::INFINITY);
        let [one, two] = run.end.radii;
        for _ in 0..MOST_DOUBLINGS {
            distance *= 2.0;
            let far = Gap::new(distance - one - two)?.ln();
            while stepper.y()[6] < far {
                let step = stepper.step(system, f64::MAX);
                step.map_err(|error| failure(system, error))?;
                if stepper.dy()[6] < 0.0 && stepper.y()[6] <= run.end.gap.ln() {
                    // It comes back: there is no limit.
                    return Ok((reached, f64::INFINITY));
                }
            }
            let next = at_infinity(system, stepper.y(), run)?;
            let change = change_of(&reached, &next);
            // As of the angles: what a table does not know adds up on the way, and once changes grow the estimate before is the best there is.
            if change >= last_change {
                break;
            }
            (reached, last_change) = (next, change);
            if change <= KNOWN {
                break;
            }
        }
        Ok((reached, last_change))
    }
}

/// The stepper's error, or the model's that caused it.
fn failure(system: &mut Linearised<'_>, error: OdeError) -> SceneError {
    let failure = system.failure.take();
    failure.unwrap_or(SceneError::Stepper { source: error })
}

/// Puts a configuration in the place of the state, and leaves its changes.
fn place(y: &mut [f64], at: &Configuration) {
    y[..NUMBERS].copy_from_slice(&CHART.encode(at));
}

fn decoded(directions: &[Perturbation], y: &[f64], at: &Configuration) -> Vec<Variation> {
    (directions.iter())
        .zip(y[NUMBERS..].chunks_exact(NUMBERS))
        .map(|(direction, block)| Variation::decoded(block, direction.ratio, at))
        .collect()
}

/// How the orientations at infinity change, as seen from a state far out: those there, and the closed form of the turn that is still to come.
fn at_infinity(system: &Linearised<'_>, y: &[f64], run: &Run) -> Result<Outgoing, SceneError> {
    let state = std::array::from_fn(|i| y[i]);
    let at = CHART.decode(&state, &run.end);
    let variations = decoded(system.directions, y, &at);
    let of = |(direction, variation): (&Perturbation, Variation)| {
        let [x1, x2] = variation.positions;
        let [p1, p2] = variation.orientations;
        let swimming = direction.modes.map(|modes| modes[0]);
        let size = ((x2 - x1).norm() / at.distance())
            .max(p1.norm())
            .max(p2.norm())
            .max(swimming[0].abs().max(swimming[1].abs()))
            .max(1.0);
        let mut sum = [Vector3::zeros(); 2];
        for (h, weight) in central_difference(STEP / size) {
            let squirmers = direction.squirmers(&system.squirmers, h)?;
            let there = variation.step(&at, direction.ratio, h);
            let there = turned_to_infinity(&squirmers, &there).unwrap_or(there);
            for (sum, p) in sum.iter_mut().zip(there.orientations) {
                *sum += p * weight;
            }
        }
        Ok(sum)
    };
    system.directions.iter().zip(variations).map(of).collect()
}

/// Step of that difference, of directions of unit size.
const STEP: f64 = 1e-3;

/// The largest change from one to the next, relative to the larger of it and 1.
fn change_of(from: &[[Vector3<f64>; 2]], to: &[[Vector3<f64>; 2]]) -> f64 {
    let of = |(a, b): (&[Vector3<f64>; 2], &[Vector3<f64>; 2])| {
        let between = |k: usize| (a[k] - b[k]).norm() / b[k].norm().max(1.0);
        between(0).max(between(1))
    };
    from.iter().zip(to).map(of).fold(0.0, f64::max)
}
