//! Progress of long work on standard error: a line that is redrawn on a terminal, otherwise a plain line each minute.

use std::fmt::Arguments;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, LazyLock};
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

use compare::watch::{Pieces, Shown, Watch, Work};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};

use crate::streams::print_error;

/// Time between plain lines. Shorter work prints none.
const INTERVAL: Duration = Duration::from_secs(60);

/// Time after which a line on a terminal is redrawn.
const REDRAWN: Duration = Duration::from_millis(200);

/// The lines of all running work. Work may be part of other work.
static LINES: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// Calls `speak` while the lines of progress are hidden.
pub(crate) fn aside(speak: impl FnOnce()) {
    LINES.suspend(speak);
}

/// Shows work on standard error.
pub(crate) struct OnStandardError;

impl Watch for OnStandardError {
    fn begin(&self, work: Work) -> Box<dyn Shown> {
        let stretch = Stretch::new(work);
        if LINES.is_hidden() {
            return Box::new(Reports::begin(stretch, INTERVAL, |line| {
                print_error!("{line}");
            }));
        }
        let line = LINES.add(ProgressBar::new(work.total as u64));
        if let Ok(style) = ProgressStyle::with_template(&stretch.template()) {
            line.set_style(style);
        }
        line.enable_steady_tick(REDRAWN);
        Box::new(Line(line))
    }

    fn notice(&self, line: Arguments<'_>) {
        aside(|| print_error!("{line}"));
    }
}

/// A line that is redrawn on a terminal.
struct Line(ProgressBar);

impl Shown for Line {
    fn reach(&self, done: usize, total: usize) {
        self.0.set_length(total as u64);
        self.0.set_position(done as u64);
    }
}

impl Drop for Line {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// Work, and how much of it is done.
struct Stretch {
    work: Work,
    done: AtomicUsize,
    total: AtomicUsize,
    began: Instant,
}

impl Stretch {
    fn new(work: Work) -> Self {
        Self {
            work,
            done: AtomicUsize::new(0),
            total: AtomicUsize::new(work.total),
            began: Instant::now(),
        }
    }

    /// The words before the total and after it.
    fn around_total(&self) -> (&'static str, &'static str) {
        match self.work.pieces {
            Pieces::Alike | Pieces::Unlike => ("", ""),
            Pieces::Gaps => ("about ", " gaps"),
            Pieces::Time => ("at most ", " a/V_s"),
        }
    }

    /// Whether the remaining time can be estimated from the elapsed time.
    fn tells_time_left(&self) -> bool {
        matches!(self.work.pieces, Pieces::Alike | Pieces::Gaps)
    }

    /// Template of the line on a terminal.
    fn template(&self) -> String {
        let (what, (of, unit)) = (self.work.what, self.around_total());
        let left = if self.tells_time_left() {
            ", about {eta} left"
        } else {
            ""
        };
        format!("{what} {{wide_bar}} {{pos}} of {of}{{len}}{unit} [{{elapsed}}{left}]")
    }

    /// The plain line after the elapsed time `gone`.
    fn line(&self, gone: Duration) -> String {
        let (what, (of, unit)) = (self.work.what, self.around_total());
        let (done, total) = (self.done.load(Relaxed), self.total.load(Relaxed));
        let line = format!("{what}: {done} of {of}{total}{unit}, {} gone", time(gone));
        if done == 0 || !self.tells_time_left() {
            return line;
        }
        let share = total.saturating_sub(done) as f64 / done as f64;
        match Duration::try_from_secs_f64(gone.as_secs_f64() * share) {
            Ok(left) => format!("{line}, about {} left", rough_time(left)),
            Err(_) => line,
        }
    }
}

/// A time in words: in seconds, or in minutes if it is longer than an hour.
fn time(time: Duration) -> String {
    let seconds = time.as_secs();
    match (seconds / 3600, seconds / 60 % 60, seconds % 60) {
        (0, 0, seconds) => format!("{seconds} s"),
        (0, minutes, seconds) => format!("{minutes} min {seconds} s"),
        (hours, minutes, _) => format!("{hours} h {minutes} min"),
    }
}

/// A rough time in words: in minutes if it is longer than a minute.
fn rough_time(left: Duration) -> String {
    let minutes = (left.as_secs() + 30) / 60;
    match minutes {
        0 => time(left),
        1..60 => format!("{minutes} min"),
        _ => time(Duration::from_secs(60 * minutes)),
    }
}

/// A thread that reports the progress of some work at regular times.
struct Reports {
    stretch: Arc<Stretch>,
    /// The thread ends when this sender is dropped.
    going_on: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Reports {
    fn begin(stretch: Stretch, interval: Duration, report: impl Fn(&str) + Send + 'static) -> Self {
        let stretch = Arc::new(stretch);
        let (going_on, ended) = channel::<()>();
        let reported = Arc::clone(&stretch);
        let reports = move || {
            while ended.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
                report(&reported.line(reported.began.elapsed()));
            }
        };
        Self {
            stretch,
            going_on: Some(going_on),
            // If no thread can be started, the work goes on without reports.
            thread: Builder::new().spawn(reports).ok(),
        }
    }
}

impl Shown for Reports {
    fn reach(&self, done: usize, total: usize) {
        self.stretch.done.store(done, Relaxed);
        self.stretch.total.store(total, Relaxed);
    }
}

impl Drop for Reports {
    fn drop(&mut self) {
        self.going_on = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    fn stretch(what: &'static str, pieces: Pieces, done: usize, total: usize) -> Stretch {
        let stretch = Stretch::new(Work {
            what,
            total,
            pieces,
        });
        stretch.done.store(done, Relaxed);
        stretch
    }

    #[test]
    fn a_line_names_the_work_what_is_done_and_what_is_left() {
        let line = |done, seconds| {
            stretch("boundary elements", Pieces::Gaps, done, 130).line(Duration::from_secs(seconds))
        };
        assert_eq!(
            line(34, 70),
            "boundary elements: 34 of about 130 gaps, 1 min 10 s gone, about 3 min left"
        );
        assert!(line(120, 59).ends_with("59 s gone, about 4 s left"));
        assert!(line(1, 7300).ends_with("2 h 1 min gone, about 261 h 35 min left"));
        assert_eq!(
            line(0, 60),
            "boundary elements: 0 of about 130 gaps, 1 min 0 s gone"
        );
        let sweep = |pieces| stretch("encounters", pieces, 6, 12).line(Duration::from_secs(300));
        let told = "encounters: 6 of 12, 5 min 0 s gone";
        assert_eq!(sweep(Pieces::Alike), format!("{told}, about 5 min left"));
        assert_eq!(sweep(Pieces::Unlike), told);
    }

    /// Lines of work that goes on for some intervals.
    fn lines(interval: Duration, intervals: u32) -> Vec<String> {
        let lines = Arc::new(Mutex::new(Vec::new()));
        let sink = Arc::clone(&lines);
        let report = move |line: &str| sink.lock().unwrap().push(line.to_owned());
        let table = stretch("boundary elements", Pieces::Gaps, 0, 0);
        let reports = Reports::begin(table, interval, report);
        reports.reach(34, 130);
        std::thread::sleep(interval * intervals);
        drop(reports);
        Arc::into_inner(lines).unwrap().into_inner().unwrap()
    }

    #[test]
    fn without_a_terminal_there_is_a_line_for_each_interval() {
        let lines = lines(Duration::from_millis(100), 5);
        assert!((2..=5).contains(&lines.len()), "{lines:?}");
        for line in &lines {
            assert!(
                line.starts_with("boundary elements: 34 of about 130 gaps, 0 s gone, about "),
                "{line}"
            );
        }
    }

    #[test]
    fn work_that_takes_less_than_an_interval_says_nothing() {
        let began = Instant::now();
        assert!(lines(Duration::from_secs(3600), 0).is_empty());
        assert!(began.elapsed() < Duration::from_secs(60));
    }
}
