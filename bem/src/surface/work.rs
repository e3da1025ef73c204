//! What assembly takes, by kind of quadrature.

use std::ops::AddAssign;
use std::time::Instant;

/// Integrals over whole panels of one kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// Pairs of a target and a panel.
    pub pairs: usize,
    /// Time on all threads together, in seconds.
    pub seconds: f64,
}

/// Integrals by kind of quadrature.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// Panels far enough from the target for one rule.
    pub far: Share,
    /// Panels that are divided, because the target is near.
    pub near: Share,
    /// Panels that the target is a node of.
    pub touching: Share,
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        for (mine, others) in [
            (&mut self.far, other.far),
            (&mut self.near, other.near),
            (&mut self.touching, other.touching),
        ] {
            mine.pairs += others.pairs;
            mine.seconds += others.seconds;
        }
    }
}

impl Share {
    /// Adds `pairs` integrals and the time since the watch was last read.
    pub(super) fn add(&mut self, pairs: usize, watch: &mut Stopwatch) {
        self.pairs += pairs;
        self.seconds += watch.read();
    }
}

/// Time since it was last read.
pub(super) struct Stopwatch(Instant);

impl Stopwatch {
    pub fn start() -> Self {
        Self(Instant::now())
    }

    fn read(&mut self) -> f64 {
        let now = Instant::now();
        let seconds = now.duration_since(self.0).as_secs_f64();
        self.0 = now;
        seconds
    }
}
