//! Progress of long work, on a terminal; silent elsewhere.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A line on standard error that says how far the work is.
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// Work of unknown extent, counted.
    pub(crate) fn counting(what: &'static str) -> Self {
        Self::with(
            ProgressBar::new_spinner(),
            "{spinner} {msg}: {pos} [{elapsed}]",
            what,
        )
    }

    /// Work of `total` pieces, with an estimate of the time left.
    pub(crate) fn of(total: usize, what: &'static str) -> Self {
        let template = "{msg} {wide_bar} {pos}/{len} [{elapsed}, {eta} left]";
        Self::with(ProgressBar::new(total as u64), template, what)
    }

    fn with(bar: ProgressBar, template: &str, what: &'static str) -> Self {
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(what);
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    pub(crate) fn set(&self, done: usize) {
        // Threads may report out of order; the line must not run backwards.
        self.0.set_position(self.0.position().max(done as u64));
    }

    pub(crate) fn advance(&self) {
        self.0.inc(1);
    }

    pub(crate) fn finish(&self) {
        self.0.finish_and_clear();
    }
}
