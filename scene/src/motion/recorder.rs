//! Samples of a run at multiples of an interval, handed over as they come.

use super::result::Sample;
use crate::frame::Configuration;

/// Hands samples over in the order of their times, none twice; none at all without an interval.
pub(super) struct Recorder<'a, 'b> {
    interval: Option<f64>,
    observe: &'a mut (dyn FnMut(&Sample) + 'b),
    /// Time of the last sample.
    observed: Option<f64>,
    /// Samples taken so far at multiples of the interval.
    sampled: u64,
}

impl<'a, 'b> Recorder<'a, 'b> {
    pub fn new(interval: Option<f64>, observe: &'a mut (dyn FnMut(&Sample) + 'b)) -> Self {
        Self {
            interval,
            observe,
            observed: None,
            sampled: 0,
        }
    }

    /// Whether a multiple of the interval comes up to the time `t`.
    pub fn is_due(&self, t: f64) -> bool {
        self.interval
            .is_some_and(|interval| self.next_sample(interval) <= t)
    }

    /// Records the configurations at multiples of the interval up to the time `end`.
    pub fn record_between(&mut self, end: f64, at: impl Fn(f64) -> Configuration) {
        let Some(interval) = self.interval else {
            return;
        };
        while self.next_sample(interval) < end {
            let t = self.next_sample(interval);
            self.sampled += 1;
            self.record(t, at(t));
        }
    }

    /// Records the configuration at the time `t`, unless that was recorded already.
    pub fn record(&mut self, t: f64, configuration: Configuration) {
        let repeats = self.observed.is_some_and(|last| last >= t);
        if self.interval.is_some() && !repeats {
            self.observed = Some(t);
            (self.observe)(&Sample { t, configuration });
        }
    }

    fn next_sample(&self, interval: f64) -> f64 {
        (self.sampled + 1) as f64 * interval
    }
}
