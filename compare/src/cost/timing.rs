//! Wall-clock time of a call: the smallest of several repeats after a warm-up.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// A call that takes longer than this runs only once.
const ONCE_BEYOND: Duration = Duration::from_secs(2);

/// Calls are timed in batches of at least this duration, which is far above the resolution of the clock.
const BATCH: Duration = Duration::from_micros(50);

/// Default time for the repeats of a call, and smallest number of batches.
const BUDGET: Duration = Duration::from_millis(20);
const FEWEST: u32 = 3;

/// The measured time of a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Timing {
    /// Seconds per call.
    pub(super) seconds: f64,
    /// Number of calls that were timed.
    pub(super) repeats: u64,
}

/// Returns the value of `call` and its time.
pub(super) fn timed<T>(call: impl Fn() -> T) -> (T, Timing) {
    timed_within(BUDGET, call)
}

/// Returns the value of `call` and its time, with a given time for the repeats.
pub(super) fn timed_within<T>(budget: Duration, call: impl Fn() -> T) -> (T, Timing) {
    let started = Instant::now();
    let value = call();
    let first = started.elapsed();
    if first > ONCE_BEYOND {
        let timing = Timing {
            seconds: first.as_secs_f64(),
            repeats: 1,
        };
        return (value, timing);
    }
    let size = if first >= BATCH { 1 } else { batch_size(&call) };
    let (mut best, mut batches) = (f64::INFINITY, 0);
    let started = Instant::now();
    while batches < FEWEST || started.elapsed() < budget {
        best = best.min(batch(&call, size).as_secs_f64() / f64::from(size));
        batches += 1;
    }
    let repeats = u64::from(batches) * u64::from(size);
    let timing = Timing {
        seconds: best,
        repeats,
    };
    (value, timing)
}

fn batch_size<T>(call: &impl Fn() -> T) -> u32 {
    let mut size = 1;
    while size < 1 << 20 && batch(call, size) < BATCH {
        size *= 2;
    }
    size
}

fn batch<T>(call: &impl Fn() -> T, size: u32) -> Duration {
    let started = Instant::now();
    for _ in 0..size {
        black_box(call());
    }
    started.elapsed()
}
