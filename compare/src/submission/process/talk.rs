//! A conversation with a process: a line to it, a line from it, in bounded time and memory, and its end.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::sync::mpsc::{
    Receiver, RecvTimeoutError, SyncSender, TryRecvError, TrySendError, channel, sync_channel,
};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use serde::Deserialize;

use super::{Question, locked};
use crate::submission::error::shown;

/// Longest line of an answer, in bytes.
const LONGEST_LINE: u64 = 1 << 20;

/// What is kept of what a process says on its standard error, in bytes.
const KEPT: usize = 300;

/// Bytes of an answer that an error shows.
const SHOWN: usize = 60;

/// Time in which a process has to end once its input is closed.
const PATIENCE: Duration = Duration::from_millis(300);

/// Time that a failed question takes while the program ends: nobody is to take that for a failure of the model.
const ENDING: Duration = Duration::from_secs(5);

/// A conversation. Its process ends when this is dropped.
pub(super) struct Talk {
    pub(super) running: Arc<Mutex<Running>>,
    /// Why the conversation is over, if it is.
    pub over: Option<String>,
    lines: Receiver<Heard>,
    said: Arc<Mutex<Vec<u8>>>,
    /// Disconnected once nothing more is said on standard error.
    hushed: Receiver<()>,
}

/// A process, for whoever ends it.
pub(super) struct Running {
    child: Child,
    /// On their way to its standard input, which is closed when this is dropped.
    questions: Option<SyncSender<Vec<u8>>>,
    is_ended: bool,
}

/// What came on standard output.
enum Heard {
    Line(Vec<u8>),
    TooLong,
    /// The end, in the middle of a line.
    Torn,
}

/// All processes that run.
static RUNNING: Mutex<Vec<Arc<Mutex<Running>>>> = Mutex::new(Vec::new());

/// Whether the program is about to end.
static IS_ENDING: AtomicBool = AtomicBool::new(false);

impl Running {
    /// How it ended, if it does so in this time.
    pub(super) fn status_within(&mut self, time: Duration) -> Option<ExitStatus> {
        let until = Instant::now() + time;
        loop {
            if let Ok(Some(status)) = self.child.try_wait() {
                return Some(status);
            }
            if Instant::now() >= until {
                return None;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Closes its input, lets it end by itself in this time, and ends what still runs of it.
    fn end(&mut self, patience: Duration) {
        self.questions = None;
        if std::mem::replace(&mut self.is_ended, true) {
            return;
        }
        self.status_within(patience);
        // Those that it started are in its group. There may be none left.
        #[cfg(unix)]
        let _ = rustix::process::kill_process_group(
            rustix::process::Pid::from_child(&self.child),
            rustix::process::Signal::KILL,
        );
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Ends all processes that answer: for a program that is about to end. Whoever still waits for an answer waits on, so that this end is not taken for a
/// failure of the model.
pub fn end_processes() {
    IS_ENDING.store(true, SeqCst);
    let all = std::mem::take(&mut *locked(&RUNNING));
    for running in &all {
        locked(running).questions = None;
    }
    for running in &all {
        locked(running).end(PATIENCE);
    }
}

impl Talk {
    pub fn begin(words: &[String]) -> std::io::Result<Self> {
        let mut command = Command::new(&words[0]);
        command
            .args(&words[1..])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn()?;
        let missing = || std::io::Error::other("it has no standard streams");
        let mut input = child.stdin.take().ok_or_else(missing)?;
        let output = child.stdout.take().ok_or_else(missing)?;
        let mut errors = child.stderr.take().ok_or_else(missing)?;
        // Not by whoever asks: a process that does not read would stop him.
        let (questions, asked) = sync_channel::<Vec<u8>>(1);
        std::thread::spawn(move || {
            for line in asked {
                if input.write_all(&line).and_then(|()| input.flush()).is_err() {
                    break;
                }
            }
        });
        let running = Arc::new(Mutex::new(Running {
            child,
            questions: Some(questions),
            is_ended: false,
        }));
        locked(&RUNNING).push(Arc::clone(&running));
        // One line at a time: a flood waits in the pipe.
        let (heard, lines) = sync_channel(1);
        std::thread::spawn(move || {
            let mut output = BufReader::new(output);
            loop {
                let mut line = Vec::new();
                let read = output
                    .by_ref()
                    .take(LONGEST_LINE)
                    .read_until(b'\n', &mut line);
                let next = match read {
                    Ok(0) | Err(_) => break,
                    Ok(_) if line.ends_with(b"\n") => Heard::Line(line),
                    Ok(length) if length as u64 >= LONGEST_LINE => Heard::TooLong,
                    Ok(_) => Heard::Torn,
                };
                let is_last = !matches!(next, Heard::Line(_));
                if heard.send(next).is_err() || is_last {
                    break;
                }
            }
        });
        let said = Arc::new(Mutex::new(Vec::new()));
        let keep = Arc::clone(&said);
        let (speaks, hushed) = channel();
        std::thread::spawn(move || {
            let _speaks: std::sync::mpsc::Sender<()> = speaks;
            let mut some = [0; 4096];
            while let Ok(length @ 1..) = errors.read(&mut some) {
                let mut kept = locked(&keep);
                kept.extend_from_slice(&some[..length]);
                let surplus = kept.len().saturating_sub(KEPT);
                kept.drain(..surplus);
            }
        });
        Ok(Self {
            running,
            over: None,
            lines,
            said,
            hushed,
        })
    }

    /// One question and what is made of its answer. After a failure whatever is asked next fails with the same reason: what comes next cannot be
    /// trusted.
    pub fn ask<A: for<'de> Deserialize<'de>, T>(
        &mut self,
        question: Question,
        limit: Duration,
        understood: impl FnOnce(A) -> Result<T, String>,
    ) -> Result<T, String> {
        let answer = self.exchange(question, limit);
        let answer = answer.and_then(|line| understood(parsed(&line)?));
        answer.inspect_err(|what| {
            if IS_ENDING.load(SeqCst) {
                std::thread::sleep(ENDING);
            }
            locked(&self.running).end(Duration::ZERO);
            self.over = Some(what.clone());
        })
    }

    /// The line that answers a question, or what happened instead.
    fn exchange(&mut self, question: Question, limit: Duration) -> Result<Vec<u8>, String> {
        if let Some(what) = &self.over {
            return Err(what.clone());
        }
        match self.lines.try_recv() {
            Err(TryRecvError::Empty) => {}
            Ok(Heard::Line(line)) => {
                return Err(format!(
                    "it says '{}' without being asked",
                    beginning(&line)
                ));
            }
            Ok(Heard::TooLong | Heard::Torn) => {
                return Err("it says part of a line without being asked".to_owned());
            }
            Err(TryRecvError::Disconnected) => {
                return Err(self.ended("it ended before it was asked"));
            }
        }
        let mut line = serde_json::to_vec(&question).map_err(|error| error.to_string())?;
        line.push(b'\n');
        let sent = locked(&self.running)
            .questions
            .as_ref()
            .map_or(Err(TrySendError::Disconnected(Vec::new())), |questions| {
                questions.try_send(line)
            });
        match sent {
            Ok(()) => {}
            Err(TrySendError::Full(_)) => return Err("it does not read its questions".to_owned()),
            Err(TrySendError::Disconnected(_)) => return Err(self.ended("it no longer listens")),
        }
        match self.lines.recv_timeout(limit) {
            Ok(Heard::Line(line)) => Ok(line),
            Ok(Heard::TooLong) => Err(format!(
                "its answer has no end: a line has at most {LONGEST_LINE} bytes"
            )),
            Ok(Heard::Torn) => Err(self.ended("its answer breaks off in the middle of a line")),
            Err(RecvTimeoutError::Timeout) => Err(format!(
                "it did not answer within {} s with a line, ended and flushed",
                crate::numbers::written(limit.as_secs_f64())
            )),
            Err(RecvTimeoutError::Disconnected) => Err(self.ended("it ended without an answer")),
        }
    }

    /// What happened, how it ended, and the last that it said on standard error.
    fn ended(&mut self, what: &str) -> String {
        let status = locked(&self.running).status_within(PATIENCE);
        let status = status.map_or(String::new(), |status| format!(" ({status})"));
        let _ = self.hushed.recv_timeout(PATIENCE);
        let said = locked(&self.said);
        let said = String::from_utf8_lossy(&said);
        let said = said.lines().rev().find(|line| !line.trim().is_empty());
        let said = said.map_or(String::new(), |line| {
            format!("; it said: {}", shown(line.trim(), 120))
        });
        format!("{what}{status}{said}")
    }
}

/// A line as JSON.
fn parsed<A: for<'de> Deserialize<'de>>(line: &[u8]) -> Result<A, String> {
    serde_json::from_slice(line).map_err(|error| {
        format!(
            "its answer '{}' is not as it should be: {}",
            beginning(line),
            shown(&error.to_string(), 120)
        )
    })
}

/// The beginning of a line, to be shown.
fn beginning(line: &[u8]) -> String {
    let text = String::from_utf8_lossy(&line[..line.len().min(2 * SHOWN)]);
    shown(text.trim_end(), SHOWN)
}

impl Drop for Talk {
    fn drop(&mut self) {
        locked(&self.running).end(PATIENCE);
        locked(&RUNNING).retain(|other| !Arc::ptr_eq(other, &self.running));
    }
}
