//! A model that is a process: a question a line on its standard input, an answer a line on its standard output, both in JSON.
//!
//! Nothing but the command that the user names is run, without a shell. Whatever the process does, an answer or one clear error comes
//! back in bounded time and memory: lines have a longest length, answers a time limit, and output that nobody asked for waits in the pipe.
//! The process has a group of its own (on Unix): an interrupt from the keyboard does not end it before the work that needs it, and whatever it
//! has started ends with it.

use std::collections::{BTreeMap, HashMap};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::sync::mpsc::{
    Receiver, RecvTimeoutError, SyncSender, TryRecvError, TrySendError, channel, sync_channel,
};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use scene::{
    Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError, SwirlLoads,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{SubmissionError, shown};
use super::header::Header;
use super::matrix::{Matrix, SIZE, Slip};
use super::model::assembled;
use super::quantity::{Quantity, Values};
use super::{Answer, calibration, convert, rows};

/// Longest line of an answer, in bytes.
const LONGEST_LINE: u64 = 1 << 20;

/// What is kept of what a process says on its standard error, in bytes.
const KEPT: usize = 300;

/// Bytes of an answer that an error shows.
const SHOWN: usize = 60;

/// Time in which a process has to end once its input is closed.
const PATIENCE: Duration = Duration::from_millis(300);

/// Most answers that are kept; then they are asked for again.
const MOST_KEPT: usize = 10_000;

/// Relative difference of the gap in an answer to the gap of the question: enough for numbers of ten digits.
const SAME_GAP: f64 = 1e-9;

/// Time that a failed question takes while the program ends: nobody is to take that for a failure of the model.
const ENDING: Duration = Duration::from_secs(5);

/// A question, one line of JSON.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "ask", rename_all = "kebab-case")]
pub enum Question {
    /// Comes first, once.
    Header,
    /// What is the pair like at this gap, in the unit of the header's radius?
    Pair {
        /// The gap.
        gap: f64,
    },
}

/// The answer to the question for the header.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeaderAnswer {
    /// The header, with `range`.
    pub header: Header,
}

/// The answer to the question for a pair: named values or a matrix, or why there is none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairAnswer {
    /// The gap of the question.
    pub gap: f64,
    /// Named values.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub values: BTreeMap<String, f64>,
    /// Twelve rows of twelve numbers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub matrix: Vec<Vec<f64>>,
    /// Slip columns of twelve numbers, by their names.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub slip: BTreeMap<String, Vec<f64>>,
    /// Why the model has no answer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

/// A process that answers. It ends when this is dropped, or with [`end_processes`].
pub struct Process {
    command: String,
    header: Header,
    range: GapRange,
    limit: Duration,
    talk: Mutex<Talk>,
    /// By the bits of the gap.
    answers: Mutex<HashMap<u64, Arc<Answer>>>,
}

/// A conversation. Its process ends when this is dropped.
struct Talk {
    running: Arc<Mutex<Running>>,
    /// Why the conversation is over, if it is.
    over: Option<String>,
    lines: Receiver<Heard>,
    said: Arc<Mutex<Vec<u8>>>,
    /// Disconnected once nothing more is said on standard error.
    hushed: Receiver<()>,
}

/// A process, for whoever ends it.
struct Running {
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

/// Why there is no answer.
enum Trouble {
    /// To this question alone.
    Here(String),
    /// And there will be none: what comes next cannot be trusted.
    Over(String),
}

use Trouble::{Here, Over};

fn over<T>(what: impl Into<String>) -> Result<T, Trouble> {
    Err(Over(what.into()))
}

/// All processes that run.
static RUNNING: Mutex<Vec<Arc<Mutex<Running>>>> = Mutex::new(Vec::new());

/// Whether the program is about to end.
static IS_ENDING: AtomicBool = AtomicBool::new(false);

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Running {
    /// How it ended, if it does so in this time.
    fn status_within(&mut self, time: Duration) -> Option<ExitStatus> {
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

impl Process {
    /// Starts `command`, a program and its arguments as a shell would split them, and asks for its header. Each answer may take as long as
    /// `limit`.
    ///
    /// # Errors
    /// [`SubmissionError::Process`] if it cannot be started or does not answer as it should.
    pub fn start(command: &str, limit: Duration) -> Result<Self, SubmissionError> {
        let failed = |what: String| failure(command, what);
        let words = shlex::split(command).filter(|words| !words.is_empty());
        let words = words.ok_or_else(|| {
            failed("give a program and its arguments, with closed quotes".to_owned())
        })?;
        let mut talk = Talk::begin(&words)
            .map_err(|error| failed(format!("it cannot be started: {error}")))?;
        let understood = |HeaderAnswer { header }| {
            let header = header.check().map_err(|error| Over(error.to_string()))?;
            let [smallest, largest] = match header.range {
                Some(range) => range.map(|gap| gap / header.radius),
                None => {
                    return over("its header has no range: the smallest and the largest gap");
                }
            };
            if !(smallest > 0.0 && largest > smallest && largest.is_finite()) {
                return over("its range in radii is not of two different finite gaps");
            }
            Ok((header, GapRange { smallest, largest }))
        };
        let (header, range) = talk
            .ask(Question::Header, limit, understood)
            .map_err(failed)?;
        Ok(Self {
            command: command.to_owned(),
            header,
            range,
            limit,
            talk: Mutex::new(talk),
            answers: Mutex::default(),
        })
    }

    /// What it says of itself.
    #[must_use]
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Gaps for which it answers, in radii.
    #[must_use]
    pub fn range(&self) -> GapRange {
        self.range
    }

    /// The answer at `gap`, asked for once.
    ///
    /// # Errors
    /// [`SubmissionError::NoAnswer`] if it says that it has none; [`SubmissionError::Process`] if it does not answer as it should, also for a gap outside its
    /// range, for which it is not asked.
    pub fn answer(&self, gap: Gap) -> Result<Arc<Answer>, SubmissionError> {
        if let Err(outside) = self.range.check(gap) {
            return Err(failure(&self.command, outside.to_string()));
        }
        let key = gap.eps().to_bits();
        let kept = || locked(&self.answers).get(&key).map(Arc::clone);
        if let Some(answer) = kept() {
            return Ok(answer);
        }
        let mut talk = locked(&self.talk);
        // Somebody else may have asked meanwhile.
        if let Some(answer) = kept() {
            return Ok(answer);
        }
        let mut asked = gap.eps() * self.header.radius;
        if let Some([smallest, largest]) = self.header.range {
            // The units may take it out by rounding.
            asked = asked.clamp(smallest, largest);
        }
        let answer = talk.ask(Question::Pair { gap: asked }, self.limit, |said| {
            understood(&self.header, gap, asked, said)
        });
        let answer = answer.map_err(|what| match talk.over {
            Some(_) => failure(&self.command, what),
            None => SubmissionError::NoAnswer {
                command: shown(&self.command, 60),
                gap: asked,
                reason: what,
            },
        })?;
        let answer = Arc::new(answer);
        let mut answers = locked(&self.answers);
        if answers.len() >= MOST_KEPT {
            answers.clear();
        }
        answers.insert(key, Arc::clone(&answer));
        Ok(answer)
    }

    fn loads_at(
        &self,
        gap: Gap,
        set: LoadSet,
        swirl: usize,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let failed = |error| SceneError::from_model("a process", error);
        self.range.check(gap)?;
        let set = set.check()?;
        let answer = self.answer(gap).map_err(failed)?;
        let factor = |pair: usize| calibration(&self.header, Quantity(2 * pair));
        let given = |pair: usize| {
            let (values, factor) = (answer.values.pair(pair)?, factor(pair));
            Some(scene::SelfOther {
                sum: factor * values.sum,
                difference: factor * values.difference,
            })
        };
        assembled(set, swirl, given).map_err(|load| {
            let lacking = convert::lacking(load, |pair| given(pair).is_some());
            let name = Quantity(2 * lacking).name();
            let what = format!("its answer has no {name}, which the motion needs");
            failed(failure(&self.command, what))
        })
    }
}

fn failure(command: &str, what: String) -> SubmissionError {
    SubmissionError::Process {
        command: shown(command, 60),
        what,
    }
}

/// What a process said, if it is an answer.
fn understood(header: &Header, gap: Gap, asked: f64, said: PairAnswer) -> Result<Answer, Trouble> {
    let is_same = (said.gap - asked).abs() <= SAME_GAP * asked;
    if !is_same {
        return over(format!(
            "it answers for the gap {:?}, and was asked for {asked:?}",
            said.gap
        ));
    }
    if let Some(error) = said.error {
        return Err(Here(shown(&error, 120)));
    }
    let too_large = |error: SubmissionError| Over(error.to_string());
    if said.matrix.is_empty() {
        if !said.slip.is_empty() || header.matrix.is_some() {
            return over(
                "an answer has slip columns or a header has 'matrix', and there is no matrix",
            );
        }
        let mut values = Values::default();
        for (name, value) in said.values {
            match Quantity::named(&name) {
                Some(quantity) => values.set(quantity, value),
                None => return over(rows::no_quantity(0, &name).to_string()),
            }
        }
        return Ok(Answer {
            gap,
            values: values.per_mode(gap, header).map_err(too_large)?,
            errors: Values::default(),
            laws: None,
        });
    }
    let Some(kind) = header.matrix else {
        return over(
            "it answers with a matrix, and its header does not say what 'matrix' is: mobility or resistance",
        );
    };
    if !said.values.is_empty() {
        return over("an answer has named values and a matrix: give one of them");
    }
    let is_row = |row: &Vec<f64>| row.len() == SIZE;
    if said.matrix.len() != SIZE || !said.matrix.iter().all(is_row) {
        return over(format!(
            "a matrix has {SIZE} rows of {SIZE} numbers, and this one has not"
        ));
    }
    let mut matrix = Matrix {
        rigid: nalgebra::SMatrix::from_fn(|row, column| said.matrix[row][column]),
        slip: BTreeMap::new(),
    };
    for (name, column) in said.slip {
        let slip = Slip::parse(&name).zip(column.try_into().ok());
        let Some((slip, column)) = slip else {
            return over(format!(
                "slip column '{}' is not allowed: give {SIZE} numbers for a column such as B1_1z",
                shown(&name, 40)
            ));
        };
        matrix.slip.insert(slip, column);
    }
    matrix.answer(gap, header, kind).map_err(too_large)
}

impl Talk {
    fn begin(words: &[String]) -> std::io::Result<Self> {
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

    /// One question and what is made of its answer. After a trouble that does not concern this question alone, whatever is asked next fails with the
    /// same reason.
    fn ask<A: for<'de> Deserialize<'de>, T>(
        &mut self,
        question: Question,
        limit: Duration,
        understood: impl FnOnce(A) -> Result<T, Trouble>,
    ) -> Result<T, String> {
        let answer = self.exchange(question, limit).map_err(Over);
        let answer = answer.and_then(|line| understood(parsed(&line)?));
        answer.map_err(|trouble| match trouble {
            Here(what) => what,
            Over(what) => {
                if IS_ENDING.load(SeqCst) {
                    std::thread::sleep(ENDING);
                }
                locked(&self.running).end(Duration::ZERO);
                self.over = Some(what.clone());
                what
            }
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
fn parsed<A: for<'de> Deserialize<'de>>(line: &[u8]) -> Result<A, Trouble> {
    serde_json::from_slice(line).map_err(|error| {
        Over(format!(
            "its answer '{}' is not as it should be: {}",
            beginning(line),
            shown(&error.to_string(), 120)
        ))
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

impl std::fmt::Debug for Process {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        (f.debug_struct("Process"))
            .field("command", &self.command)
            .finish_non_exhaustive()
    }
}

/// Smallest noise of a process whose header states none.
const NOISE: f64 = 1e-9;

impl Hydrodynamics for Process {
    /// The range and the noise of the header.
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            noise: self.header.noise.unwrap_or(NOISE),
            ..ModelDescription::smooth(self.range)
        }
    }

    /// With the command: nobody knows whether the process answers the same tomorrow.
    fn fingerprint(&self) -> String {
        format!("process {}", self.command)
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.loads_at(gap, set, 0).map(|(loads, _)| loads)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.loads_at(gap, set, set.swirl)
    }

    /// The noise of the header, if it states one.
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.loads_at(gap, set, set.swirl)?;
        Ok(self.header.noise)
    }
}

#[cfg(unix)]
#[cfg(test)]
mod tests;
