//! A model that is a process: a question a line on its standard input, an answer a line on its standard output, both in JSON.
//!
//! Nothing but the command that the user names is run, without a shell. Whatever the process does, an answer or one clear error comes
//! back in bounded time and memory: lines have a longest length, answers a time limit, and output that nobody asked for waits in the pipe.
//! The process has a group of its own (on Unix): an interrupt from the keyboard does not end it before the work that needs it, and whatever it
//! has started ends with it.

mod talk;

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex};
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
use talk::{Here, Over, Talk, Trouble, locked, over};

pub use talk::end_processes;

/// Most answers that are kept; then they are asked for again.
const MOST_KEPT: usize = 10_000;

/// Relative difference of the gap in an answer to the gap of the question: enough for numbers of ten digits.
const SAME_GAP: f64 = 1e-9;

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
