//! What happens within a step of the stepper: parting, touching, the smallest gap, time in contact.

use super::{PhaseEnd, Runner};
use crate::Gap;
use crate::motion::outcome::Outcome;
use crate::ode::{Dense, Direction, OdeError, Step, first_crossing, first_minimum};

impl<const N: usize> Runner<'_, '_, N> {
    /// Takes in one step: up to the parting or touching if that lies in it, and then says so.
    pub(super) fn follow(
        &mut self,
        step: &Step<N>,
        parting: Option<Gap>,
    ) -> Result<Option<PhaseEnd>, OdeError> {
        let of = self.ln_gap;
        let turns = step.dy0[of] < 0.0 && step.dy1[of] >= 0.0;
        let crosses = |level: f64| (step.y0[of] <= level) != (step.y1[of] <= level);
        let contact = self.ln_contact;
        let parts = parting.is_some_and(|gap| parts(step, of, gap));
        // Out and back within the step: the gap is largest inside it.
        let crests = parting.is_some() && step.dy0[of] > 0.0 && step.dy1[of] < 0.0;
        let samples = self.recorder.is_due(step.t1);
        let floor = self.model.floor;
        // A pair that rests there, or opens from there, does not close.
        let closes = step.y1[of] <= floor.gap.ln() && step.y1[of] < step.y0[of];
        let dense = if turns || crests || crosses(contact) || parts || closes || samples {
            Some(step.dense(self.motion)?)
        } else {
            None
        };
        let nearest = (dense.as_ref().filter(|_| turns))
            .and_then(|dense| first_minimum(dense, |_, y| y[of]).map(|t| (t, dense.at(t)[of])));
        let farthest = (dense.as_ref().filter(|_| crests))
            .and_then(|dense| first_minimum(dense, |_, y| -y[of]).map(|t| dense.at(t)[of]));
        let parts = parts
            || farthest
                .zip(parting)
                .is_some_and(|(ln_gap, gap)| ln_gap > gap.ln() && step.y0[of] <= gap.ln());
        // Below the range of a model nothing is known: neither may a gap dip there and open again within the step.
        let closes = closes
            || floor.outcome == Outcome::Unresolved
                && nearest.is_some_and(|(_, ln_gap)| ln_gap < floor.gap.ln());
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
                let crossing = first_crossing(dense, |_, y| y[of] - gap.ln(), *direction, 0.0);
                // Without a crossing the whole step lies beyond: it began there, or so near that what it did first
                // is rounding.
                let began_beyond = match direction {
                    Direction::Rising => step.y0[of] > gap.ln(),
                    _ => step.y0[of] < gap.ln(),
                };
                let turned = nearest.map_or(step.t1, |(t, _)| t);
                let otherwise = if began_beyond { turned } else { step.t0 };
                Some((crossing.unwrap_or(otherwise), crossing.is_some()))
            }
            _ => None,
        };
        let (t, y) = match (&dense, ends_at, &event) {
            (Some(dense), Some((t, crosses)), Some((gap, ..))) => {
                let mut y = dense.at(t);
                if crosses {
                    y[of] = gap.ln();
                }
                (t, y)
            }
            _ => (step.t1, step.y1),
        };
        self.track_gap(step, dense.as_ref(), nearest, (t, &y));
        let previous = self.now;
        let chart = self.motion.chart();
        if let Some(dense) = dense.filter(|_| samples) {
            self.recorder
                .record_between(t, |t| chart.decode(&dense.at(t), &previous));
        }
        self.unit_drift = self.unit_drift.max(chart.unit_drift(&y));
        self.t = t;
        let end = event.filter(|_| ends_at.is_some());
        // Until then nothing but the state itself is asked for.
        if chart.is_wound() || end.is_some() || self.watch.is_on(t) {
            self.now = chart.decode(&y, &previous);
            if let (Some((gap, ..)), Some((_, true))) = (&end, ends_at) {
                self.now.gap = *gap;
            }
            if turns {
                self.watch.count_minimum();
            }
            self.watch.look_at(t, &self.now);
        }
        Ok(end.map(|(_, _, end)| end))
    }

    /// Smallest gap and time in contact over a step, up to `(t, y)`; `nearest` is the time at which the gap turns
    /// within the step, and its logarithm there.
    fn track_gap(
        &mut self,
        step: &Step<N>,
        dense: Option<&Dense<N>>,
        nearest: Option<(f64, f64)>,
        (t, y): (f64, &[f64; N]),
    ) {
        let of = self.ln_gap;
        let contact = self.ln_contact;
        let mut least = step.y0[of].min(y[of]);
        if let Some((_, ln_gap)) = nearest.filter(|(nearest, _)| *nearest < t) {
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
            self.add_contact(enters, leaves.min(t));
        }
    }
}

/// Whether a pair is beyond the gap at which it parts when the step ends: it crossed that gap, or began
/// there or beyond and recedes by now. One that rests there does not part.
fn parts<const N: usize>(step: &Step<N>, of: usize, gap: Gap) -> bool {
    step.y1[of] >= gap.ln() && (step.y0[of] < gap.ln() || step.dy1[of] > 0.0)
}
