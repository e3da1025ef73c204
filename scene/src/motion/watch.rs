//! What is kept of a run to tell at its end in which way the pair is bound.

use super::free_flight::PairFlight;
use super::outcome::{
    GapHistory, LineHistory, Outcome, Righting, judge_bound, judge_under_gravity,
};
use super::result::Sample;
use crate::frame::Configuration;

/// Share of a run after which the pair is watched.
const WATCHED_FROM: f64 = 0.75;

/// A look at the last part of a run; under gravity at the line of centres since the pair was bound.
pub(super) struct Watch {
    righting: Option<Righting>,
    /// Time from which on the pair is watched.
    from: f64,
    /// The first configuration in the watched part of the run, and the gaps since.
    watched: Option<(Sample, GapHistory)>,
    /// Under gravity: how the line of centres has turned since the pair was bound.
    line: Option<LineHistory>,
}

impl Watch {
    pub fn new(righting: Option<Righting>, end_time: f64) -> Self {
        Self {
            righting,
            from: WATCHED_FROM * end_time,
            watched: None,
            line: None,
        }
    }

    /// Whether configurations at the time `t` are kept.
    pub fn is_on(&self, t: f64) -> bool {
        self.righting.is_some() || t >= self.from
    }

    pub fn look_at(&mut self, t: f64, configuration: &Configuration) {
        if self.righting.is_some() {
            self.line = LineHistory::follow(self.line, configuration);
        }
        let ln_gap = configuration.gap.ln();
        match &mut self.watched {
            Some((_, gaps)) => gaps.take(ln_gap),
            None if t >= self.from => {
                let sample = Sample {
                    t,
                    configuration: *configuration,
                };
                self.watched = Some((sample, GapHistory::from(ln_gap)));
            }
            None => {}
        }
    }

    /// The same on the way of a flight from the time `t` of the given duration, which may go far out and come back.
    pub fn look_at_flight(&mut self, t: f64, flight: &PairFlight, duration: f64) {
        /// Instants at which a flight is looked at.
        const LOOKS: u32 = 32;
        for look in 1..LOOKS {
            let flown = duration * f64::from(look) / f64::from(LOOKS);
            self.look_at(t + flown, &flight.at(flown));
        }
    }

    /// Counts a smallest gap, if it is in the watched part of the run.
    pub fn count_minimum(&mut self) {
        if let Some((_, gaps)) = &mut self.watched {
            gaps.minima += 1;
        }
    }

    /// In which way a pair is bound that is at `now` at the end, time `t`; `speed` is the larger swimming speed of the
    /// two.
    pub fn judge_bound(&self, t: f64, now: &Configuration, speed: f64) -> Outcome {
        let Some((watched, gaps)) = &self.watched else {
            return Outcome::Undecided;
        };
        let (earlier, duration) = (&watched.configuration, t - watched.t);
        match &self.righting {
            Some(righting) => {
                let line = self.line.as_ref();
                judge_under_gravity((earlier, now), duration, speed, gaps, line, righting)
            }
            None => judge_bound(earlier, now, duration, speed),
        }
    }
}
