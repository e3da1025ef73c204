//! Free flight from one contact to the next, in one jump.

use super::Runner;
use crate::frame::Configuration;
use crate::motion::free_flight::PairFlight;
use crate::squirmer::finite;
use crate::{Gap, SceneError};

/// How a free flight ended.
pub(super) enum Flown {
    Contact,
    Parted,
    Time,
}

impl<const N: usize> Runner<'_, '_, N> {
    /// Flies freely to the next contact at the gap `cut`, or to the end.
    pub(super) fn fly(&mut self, cut: Gap) -> Result<Flown, SceneError> {
        self.counters.flights += 1;
        self.begin_phase(true);
        let squirmers = self.motion.squirmers();
        let [one, two] = self.start.radii;
        let flight = PairFlight::new(squirmers, self.motion.gravity(), self.now);
        let chart = self.motion.chart();
        let flown = |t: f64| chart.restored(flight.at(t));
        let left = self.options.end_time - self.t;
        let contact = flight.contact(one + two + cut.eps(), left, self.options.max_steps)?;
        let nearest = flight.closest_approach(contact.unwrap_or(left));
        let distance = flight.told_distance(nearest)?;
        self.min_gap = self.min_gap.min(distance - (one + two));
        // A straight pair that misses has parted when it begins to recede; one that keeps its distance never does.
        let keeps = flight.keeps_distance();
        let parted = contact.is_none() && flight.is_straight() && nearest < left && !keeps;
        let duration = contact.unwrap_or(if parted { nearest } else { left });
        // Rounding brings no run beyond its end.
        let end = (self.t + duration).min(self.options.end_time);
        let from = self.t;
        self.recorder.record_between(end, |t| flown(t - from));
        if !flight.is_straight() || keeps {
            self.watch.look_at_flight(self.t, &flight, duration);
        }
        if contact != Some(0.0) {
            self.now = flown(duration);
        }
        flight.told_distance(duration)?;
        // Speeds may take a pair farther than numbers reach: that is no outcome.
        let Configuration { midpoint, line, .. } = self.now;
        for coordinate in midpoint.iter().chain(line.iter()) {
            finite("position after a free flight", *coordinate)?;
        }
        finite(
            "logarithm of the gap after a free flight",
            self.now.gap.ln(),
        )?;
        self.t = end;
        self.watch.look_at(self.t, &self.now);
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
}
