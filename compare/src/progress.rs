//! Progress of long work on standard error: a line that is redrawn on a terminal, a plain line a minute elsewhere.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, LazyLock};
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use scene::BuildProgress;

use crate::streams::complain;

/// Time between plain lines: work that takes less has none.
const INTERVAL: Duration = Duration::from_secs(60);

/// Time between the pictures of a line on a terminal.
const REDRAWN: Duration = Duration::from_millis(200);

/// The lines of all work under way, which may be within other work.
static LINES: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// Does something while the lines of the work under way are not on the terminal.
pub(crate) fn aside(speak: impl FnOnce()) {
    LINES.suspend(speak);
}

/// Says on standard error how far some work is, until it is dropped.
pub(crate) struct Progress {
    work: Arc<Work>,
    shown: Shown,
}

enum Shown {
    Line(ProgressBar),
    Reports(Reports),
}

impl Progress {
    /// Work of `total` pieces that take about the same time each.
    pub(crate) fn of(total: usize, what: &'static str) -> Self {
        Self::show(Work::new(what, total))
    }

    /// Work of `total` pieces so different that nobody can tell from some how long the others take.
    pub(crate) fn of_unlike(total: usize, what: &'static str) -> Self {
        Self::show(Work::new(what, total).without_time_left())
    }

    /// The building of a table, which has as many pieces as it takes.
    pub(crate) fn of_table(what: &'static str) -> Self {
        Self::show(Work::table(what))
    }

    /// A run that may end at any time up to `end_time`, in `a/V_s`.
    pub(crate) fn of_run(end_time: f64) -> Self {
        let work = Work {
            of: "at most ",
            unit: " a/V_s",
            ..Work::new("run", end_time.ceil() as usize)
        };
        Self::show(work.without_time_left())
    }

    fn show(work: Work) -> Self {
        if LINES.is_hidden() {
            return Self::reporting(work, INTERVAL, |line| complain!("{line}"));
        }
        let line = LINES.add(ProgressBar::new(work.total.load(Relaxed) as u64));
        if let Ok(style) = ProgressStyle::with_template(&work.template()) {
            line.set_style(style);
        }
        line.enable_steady_tick(REDRAWN);
        Self {
            work: Arc::new(work),
            shown: Shown::Line(line),
        }
    }

    fn reporting(work: Work, interval: Duration, report: impl Fn(&str) + Send + 'static) -> Self {
        let work = Arc::new(work);
        let shown = Shown::Reports(Reports::begin(Arc::clone(&work), interval, report));
        Self { work, shown }
    }

    /// How far a table is.
    pub(crate) fn follow(&self, table: BuildProgress) {
        // Threads may report out of order; the line must not run backwards.
        self.work.done.fetch_max(table.done, Relaxed);
        self.work.total.store(table.expected, Relaxed);
        self.redraw();
    }

    /// A run is at the time `t`.
    pub(crate) fn reach(&self, t: f64) {
        self.work.done.fetch_max(t as usize, Relaxed);
        self.redraw();
    }

    /// One more piece is done.
    pub(crate) fn advance(&self) {
        self.work.done.fetch_add(1, Relaxed);
        self.redraw();
    }

    fn redraw(&self) {
        if let Shown::Line(line) = &self.shown {
            line.set_length(self.work.total.load(Relaxed) as u64);
            line.set_position(self.work.done.load(Relaxed) as u64);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        match &mut self.shown {
            Shown::Line(line) => line.finish_and_clear(),
            Shown::Reports(reports) => reports.end(),
        }
    }
}

/// Work, and how much of it is done.
struct Work {
    what: &'static str,
    /// What comes before the total, with a blank after it.
    of: &'static str,
    /// What its pieces are called, with a blank before it.
    unit: &'static str,
    done: AtomicUsize,
    total: AtomicUsize,
    /// Whether the time left follows from the time gone.
    tells_time_left: bool,
    began: Instant,
}

impl Work {
    fn new(what: &'static str, total: usize) -> Self {
        Self {
            what,
            of: "",
            unit: "",
            done: AtomicUsize::new(0),
            total: AtomicUsize::new(total),
            tells_time_left: true,
            began: Instant::now(),
        }
    }

    fn table(what: &'static str) -> Self {
        Self {
            of: "about ",
            unit: " gaps",
            ..Self::new(what, 0)
        }
    }

    fn without_time_left(self) -> Self {
        Self {
            tells_time_left: false,
            ..self
        }
    }

    /// The line on a terminal.
    fn template(&self) -> String {
        let Self { what, of, unit, .. } = self;
        let left = if self.tells_time_left {
            ", about {eta} left"
        } else {
            ""
        };
        format!("{what} {{wide_bar}} {{pos}} of {of}{{len}}{unit} [{{elapsed}}{left}]")
    }

    /// The line elsewhere, when so much time has gone.
    fn line(&self, gone: Duration) -> String {
        let Self { what, of, unit, .. } = self;
        let (done, total) = (self.done.load(Relaxed), self.total.load(Relaxed));
        let line = format!("{what}: {done} of {of}{total}{unit}, {} gone", time(gone));
        if done == 0 || !self.tells_time_left {
            return line;
        }
        let share = total.saturating_sub(done) as f64 / done as f64;
        match Duration::try_from_secs_f64(gone.as_secs_f64() * share) {
            Ok(left) => format!("{line}, about {} left", rough_time(left)),
            Err(_) => line,
        }
    }
}

/// A time to the second, or to the minute where it is hours.
fn time(time: Duration) -> String {
    let seconds = time.as_secs();
    match (seconds / 3600, seconds / 60 % 60, seconds % 60) {
        (0, 0, seconds) => format!("{seconds} s"),
        (0, minutes, seconds) => format!("{minutes} min {seconds} s"),
        (hours, minutes, _) => format!("{hours} h {minutes} min"),
    }
}

/// A time to the minute, where it is more than one.
fn rough_time(left: Duration) -> String {
    let minutes = (left.as_secs() + 30) / 60;
    match minutes {
        0 => time(left),
        1..60 => format!("{minutes} min"),
        _ => time(Duration::from_secs(60 * minutes)),
    }
}

/// A thread that reports how far some work is again and again.
struct Reports {
    /// The thread ends when this is gone.
    going_on: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Reports {
    fn begin(work: Arc<Work>, interval: Duration, report: impl Fn(&str) + Send + 'static) -> Self {
        let (going_on, ended) = channel::<()>();
        let reports = move || {
            while ended.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
                report(&work.line(work.began.elapsed()));
            }
        };
        Self {
            going_on: Some(going_on),
            // Without a thread there are no reports, and the work is done all the same.
            thread: Builder::new().spawn(reports).ok(),
        }
    }

    fn end(&mut self) {
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

    fn table(done: usize, expected: usize) -> Work {
        let work = Work::table("boundary elements");
        work.done.store(done, Relaxed);
        work.total.store(expected, Relaxed);
        work
    }

    #[test]
    fn a_line_names_the_work_what_is_done_and_what_is_left() {
        let line = |done, seconds| table(done, 130).line(Duration::from_secs(seconds));
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
        let sweep = Work::new("encounters", 12);
        sweep.done.store(6, Relaxed);
        let gone = Duration::from_secs(300);
        let told = "encounters: 6 of 12, 5 min 0 s gone";
        assert_eq!(sweep.line(gone), format!("{told}, about 5 min left"));
        assert_eq!(sweep.without_time_left().line(gone), told);
    }

    /// Lines of work that goes on for some intervals.
    fn lines(interval: Duration, intervals: u32) -> Vec<String> {
        let lines = Arc::new(Mutex::new(Vec::new()));
        let sink = Arc::clone(&lines);
        let report = move |line: &str| sink.lock().unwrap().push(line.to_owned());
        let progress = Progress::reporting(table(0, 0), interval, report);
        progress.follow(BuildProgress {
            done: 34,
            expected: 130,
        });
        std::thread::sleep(interval * intervals);
        drop(progress);
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
