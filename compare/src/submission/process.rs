//! A model that is a process: a question a line on its standard input, an answer a line on its standard output, both in JSON.
//!
//! Nothing but the command that the user names is run, without a shell. Whatever the process does, an answer or one clear error comes
//! back in bounded time and memory: lines have a longest length, answers a time limit, and output that nobody asked for waits in the pipe.

use std::collections::{BTreeMap, HashMap};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

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

/// Time in which a process has to end once its input is closed.
const PATIENCE: Duration = Duration::from_millis(300);

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

/// The two ends of a conversation.
struct Talk {
    child: Arc<Mutex<Child>>,
    /// None once the conversation has failed, with the reason.
    open: Result<ChildStdin, String>,
    lines: Receiver<Heard>,
    said: Arc<Mutex<Vec<u8>>>,
}

/// What came on standard output.
enum Heard {
    Line(Vec<u8>),
    TooLong,
    /// The end, in the middle of a line.
    Torn,
}

/// All processes that run.
static RUNNING: Mutex<Vec<Arc<Mutex<Child>>>> = Mutex::new(Vec::new());

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn end(child: &Mutex<Child>) {
    let mut child = locked(child);
    // It may have ended by itself.
    let _ = child.kill();
    let _ = child.wait();
}

/// Ends all processes that answer: for a program that is about to end.
pub fn end_processes() {
    for child in std::mem::take(&mut *locked(&RUNNING)) {
        end(&child);
    }
}

impl Process {
    /// Starts `command`, a program and its arguments as a shell would split them, and asks for its header. Each answer may take as long as
    /// `limit`.
    ///
    /// # Errors
    /// [`SubmissionError::Process`] if it cannot be started or does not answer as it should.
    pub fn start(command: &str, limit: Duration) -> Result<Self, SubmissionError> {
        let failed = |what: String| SubmissionError::Process {
            command: shown(command, 60),
            what,
        };
        let words = shlex::split(command).filter(|words| !words.is_empty());
        let words = words.ok_or_else(|| {
            failed("give a program and its arguments, with closed quotes".to_owned())
        })?;
        let talk = Talk::begin(&words)
            .map_err(|error| failed(format!("it cannot be started: {error}")))?;
        let mut process = Self {
            command: command.to_owned(),
            header: Header::default(),
            range: GapRange {
                smallest: 1.0,
                largest: 1.0,
            },
            limit,
            talk: Mutex::new(talk),
            answers: Mutex::default(),
        };
        let HeaderAnswer { header } = process.ask(Question::Header)?;
        process.header = header
            .check()
            .map_err(|error| process.fail(error.to_string()))?;
        let [smallest, largest] = (process.header.range).ok_or_else(|| {
            process.fail("its header has no range: the smallest and the largest gap".to_owned())
        })?;
        let radius = process.header.radius;
        process.range = GapRange {
            smallest: smallest / radius,
            largest: largest / radius,
        };
        Ok(process)
    }

    /// What it says of itself.
    #[must_use]
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Ends the conversation: whatever is asked next fails with the same reason.
    fn fail(&self, what: String) -> SubmissionError {
        let mut talk = locked(&self.talk);
        end(&talk.child);
        if talk.open.is_ok() {
            talk.open = Err(what.clone());
        }
        self.failure(what)
    }

    fn failure(&self, what: String) -> SubmissionError {
        SubmissionError::Process {
            command: shown(&self.command, 60),
            what,
        }
    }

    /// One question and its answer.
    fn ask<A: for<'de> Deserialize<'de>>(&self, question: Question) -> Result<A, SubmissionError> {
        let heard = {
            let mut talk = locked(&self.talk);
            let heard = talk.exchange(question, self.limit);
            if let Err(what) = &heard {
                end(&talk.child);
                talk.open = Err(what.clone());
            }
            heard
        };
        let line = heard.map_err(|what| self.failure(what))?;
        serde_json::from_slice(&line).map_err(|error| {
            let line = shown(&String::from_utf8_lossy(&line), 60);
            self.fail(format!(
                "its answer '{line}' is not as it should be: {error}"
            ))
        })
    }

    /// The answer at `gap`, asked for once.
    ///
    /// # Errors
    /// [`SubmissionError::Process`].
    pub fn answer(&self, gap: Gap) -> Result<Arc<Answer>, SubmissionError> {
        let key = gap.eps().to_bits();
        if let Some(answer) = locked(&self.answers).get(&key) {
            return Ok(Arc::clone(answer));
        }
        let asked = gap.eps() * self.header.radius;
        let said: PairAnswer = self.ask(Question::Pair { gap: asked })?;
        let answer = Arc::new(self.understood(gap, asked, said)?);
        locked(&self.answers).insert(key, Arc::clone(&answer));
        Ok(answer)
    }

    fn understood(
        &self,
        gap: Gap,
        asked: f64,
        said: PairAnswer,
    ) -> Result<Answer, SubmissionError> {
        if said.gap.to_bits() != asked.to_bits() {
            return Err(self.fail(format!(
                "it answers for the gap {:?}, and was asked for {asked:?}",
                said.gap
            )));
        }
        if let Some(error) = said.error {
            return Err(self.failure(format!(
                "it has no answer at the gap {asked:?}: {}",
                shown(&error, 120)
            )));
        }
        if said.matrix.is_empty() {
            if !said.slip.is_empty() || self.header.matrix.is_some() {
                return Err(self.fail(
                    "an answer has slip columns or a header has 'matrix', and there is no matrix"
                        .to_owned(),
                ));
            }
            let mut values = Values::default();
            for (name, value) in said.values {
                let quantity = Quantity::named(&name);
                let quantity =
                    quantity.ok_or_else(|| self.fail(rows::no_quantity(0, &name).to_string()))?;
                values.set(quantity, value);
            }
            return Ok(Answer {
                gap,
                values: values.per_mode(&self.header),
                errors: Values::default(),
                laws: None,
            });
        }
        let Some(kind) = self.header.matrix else {
            return Err(self.fail("it answers with a matrix, and its header does not say what 'matrix' is: mobility or resistance".to_owned()));
        };
        if !said.values.is_empty() {
            return Err(
                self.fail("an answer has named values and a matrix: give one of them".to_owned())
            );
        }
        let is_row = |row: &Vec<f64>| row.len() == SIZE;
        if said.matrix.len() != SIZE || !said.matrix.iter().all(is_row) {
            return Err(self.fail(format!(
                "a matrix has {SIZE} rows of {SIZE} numbers, and this one has not"
            )));
        }
        let mut matrix = Matrix {
            rigid: nalgebra::SMatrix::from_fn(|row, column| said.matrix[row][column]),
            slip: BTreeMap::new(),
        };
        for (name, column) in said.slip {
            let slip = Slip::parse(&name).zip(column.try_into().ok());
            let (slip, column) = slip.ok_or_else(|| {
                self.fail(format!("slip column '{}' is not allowed: give {SIZE} numbers for a column such as B1_1z", shown(&name, 40)))
            })?;
            matrix.slip.insert(slip, column);
        }
        Ok(matrix.answer(gap, &self.header, kind))
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
            let sources = convert::sources(load)
                .filter(|_| given(0).is_none())
                .unwrap_or_else(|| vec![load]);
            let lacking = sources
                .into_iter()
                .find(|&pair| given(pair).is_none())
                .unwrap_or(load);
            let name = Quantity(2 * lacking).name();
            failed(self.failure(format!("its answer has no {name}, which the motion needs")))
        })
    }
}

impl Talk {
    fn begin(words: &[String]) -> std::io::Result<Self> {
        let mut child = Command::new(&words[0])
            .args(&words[1..])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        let missing = || std::io::Error::other("it has no standard streams");
        let input = child.stdin.take().ok_or_else(missing)?;
        let output = child.stdout.take().ok_or_else(missing)?;
        let mut errors = child.stderr.take().ok_or_else(missing)?;
        let child = Arc::new(Mutex::new(child));
        locked(&RUNNING).push(Arc::clone(&child));
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
        std::thread::spawn(move || {
            let mut some = [0; 4096];
            while let Ok(length @ 1..) = errors.read(&mut some) {
                let mut kept = locked(&keep);
                kept.extend_from_slice(&some[..length]);
                let surplus = kept.len().saturating_sub(KEPT);
                kept.drain(..surplus);
            }
        });
        Ok(Self {
            child,
            open: Ok(input),
            lines,
            said,
        })
    }

    /// The line that answers a question, or what happened instead.
    fn exchange(&mut self, question: Question, limit: Duration) -> Result<Vec<u8>, String> {
        let input = match &mut self.open {
            Ok(input) => input,
            Err(what) => return Err(what.clone()),
        };
        match self.lines.try_recv() {
            Err(TryRecvError::Empty) => {}
            Ok(_) => return Err("it says more than one line for a question".to_owned()),
            Err(TryRecvError::Disconnected) => {
                return Err(self.ended("it ended before it was asked"));
            }
        }
        let mut line = serde_json::to_vec(&question).map_err(|error| error.to_string())?;
        line.push(b'\n');
        if input.write_all(&line).and_then(|()| input.flush()).is_err() {
            return Err(self.ended("it no longer listens"));
        }
        match self.lines.recv_timeout(limit) {
            Ok(Heard::Line(line)) => Ok(line),
            Ok(Heard::TooLong) => Err(format!(
                "its answer has no end: a line has at most {LONGEST_LINE} bytes"
            )),
            Ok(Heard::Torn) => Err(self.ended("its answer breaks off in the middle of a line")),
            Err(RecvTimeoutError::Timeout) => Err(format!(
                "it did not answer within {} s",
                crate::numbers::written(limit.as_secs_f64())
            )),
            Err(RecvTimeoutError::Disconnected) => Err(self.ended("it ended without an answer")),
        }
    }

    /// What happened, how it ended, and the last that it said on standard error.
    fn ended(&mut self, what: &str) -> String {
        let mut child = locked(&self.child);
        let mut status = None;
        for _ in 0..10 {
            if let Ok(Some(ended)) = child.try_wait() {
                status = Some(ended);
                break;
            }
            std::thread::sleep(PATIENCE / 10);
        }
        let status = status.map_or(String::new(), |status| format!(" ({status})"));
        let said = locked(&self.said);
        let said = String::from_utf8_lossy(&said);
        let said = said.lines().rev().find(|line| !line.trim().is_empty());
        let said = said.map_or(String::new(), |line| {
            format!("; it said: {}", shown(line.trim(), 120))
        });
        format!("{what}{status}{said}")
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let child = &locked(&self.talk).child;
        end(child);
        locked(&RUNNING).retain(|other| !Arc::ptr_eq(other, child));
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
