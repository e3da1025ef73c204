//! A model that is asked: what a process and a function have in common.
//!
//! Whoever answers is a [`Source`]. [`Asked`] asks it within its range, once for each gap, understands its answers, and is the hydrodynamic model.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use scene::{
    Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, ModelFailure, PairLoads, SceneError,
    SwirlLoads,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{SubmissionError, shown};
use super::header::Header;
use super::matrix::{Matrix, SIZE, Slip};
use super::model::assembled;
use super::quantity::{Quantity, Values};
use super::{Answer, calibration, convert, rows};

/// Most answers that are kept; then they are asked for again.
const MOST_KEPT: usize = 10_000;

/// Relative difference of the gap in an answer to the gap of the question: enough for numbers of ten digits.
const SAME_GAP: f64 = 1e-9;

/// Smallest noise of a model whose header states none.
const NOISE: f64 = 1e-9;

/// The answer to the question for a pair: named values or a matrix, or why there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
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

/// Somebody who answers.
pub trait Source: Send + Sync {
    /// What it is in messages, such as `process`.
    fn kind(&self) -> &'static str;

    /// Its name in messages.
    fn name(&self) -> &str;

    /// Whether a question waits until the one before is answered. Without turns it may be asked from several threads, and while it answers; nobody
    /// holds a lock then.
    fn takes_turns(&self) -> bool;

    /// Asks for the pair at gaps in the unit of the header's radius, and hands on each answer with the place of its gap.
    ///
    /// # Errors
    /// [`Silence`] if there is none, or if `heard` refuses one.
    fn ask(&self, gaps: &[f64], heard: &mut Heard<'_>) -> Result<(), Silence>;
}

/// Takes the answer at the gap of a place, or says why it is none.
pub type Heard<'a> = dyn FnMut(usize, PairAnswer) -> Result<(), String> + 'a;

/// Why a [`Source`] does not answer.
#[derive(Debug)]
pub enum Silence {
    /// In words.
    Said(String),
    /// By an error of its own, which is kept whole.
    Raised(ModelFailure),
}

/// A model that is asked.
pub struct Asked {
    header: Header,
    range: GapRange,
    turn: Mutex<()>,
    /// By the bits of the gap; or that it has no answer there.
    answers: Mutex<HashMap<u64, Kept>>,
    source: Arc<dyn Source>,
}

type Kept = Result<Arc<Answer>, SubmissionError>;

pub(super) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Why an answer is none.
enum Trouble {
    /// The model has none at this gap.
    Here(String),
    /// It is not as it should be.
    Wrong(String),
}

use Trouble::{Here, Wrong};

/// The range of a header, in radii.
///
/// # Errors
/// What is wrong with it.
pub(super) fn range_of(header: &Header) -> Result<GapRange, String> {
    let Some(range) = header.range else {
        return Err("its header has no range: the smallest and the largest gap".to_owned());
    };
    let [smallest, largest] = range.map(|gap| gap / header.radius);
    if !(smallest > 0.0 && largest > smallest && largest.is_finite()) {
        return Err("its range in radii is not of two different finite gaps".to_owned());
    }
    Ok(GapRange { smallest, largest })
}

impl Asked {
    /// A model with this header that `source` answers for.
    ///
    /// # Errors
    /// [`SubmissionError::Header`] for a header that is not allowed, or has no range.
    pub fn new(source: Arc<dyn Source>, header: Header) -> Result<Self, SubmissionError> {
        let header = header.check()?;
        let range = range_of(&header).map_err(|what| SubmissionError::Header { what })?;
        Ok(Self {
            header,
            range,
            turn: Mutex::default(),
            answers: Mutex::default(),
            source,
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
    /// [`SubmissionError::NoAnswer`] if it says that it has none; [`SubmissionError::Asked`] if it does not answer as it should, also for a gap outside its
    /// range, for which it is not asked; [`SubmissionError::Raised`] for an error of its own.
    pub fn answer(&self, gap: Gap) -> Result<Arc<Answer>, SubmissionError> {
        self.check(gap)?;
        match self.kept(gap) {
            Some(kept) => kept,
            None => {
                self.ask(&[gap])?;
                self.kept(gap)
                    .unwrap_or_else(|| Err(self.failure("it gives no answer".to_owned())))
            }
        }
    }

    fn who(&self) -> String {
        format!("{} '{}'", self.source.kind(), shown(self.source.name(), 60))
    }

    fn failure(&self, what: String) -> SubmissionError {
        SubmissionError::Asked {
            who: self.who(),
            what,
        }
    }

    fn check(&self, gap: Gap) -> Result<(), SubmissionError> {
        let checked = self.range.check(gap);
        checked.map_err(|outside| self.failure(outside.to_string()))
    }

    fn kept(&self, gap: Gap) -> Option<Kept> {
        locked(&self.answers).get(&gap.eps().to_bits()).cloned()
    }

    /// Asks at all gaps in the range at once, unless the source takes turns. A gap without an answer is no error here.
    ///
    /// # Errors
    /// As [`Self::answer`].
    pub(crate) fn ask_ahead(&self, gaps: &[Gap]) -> Result<(), SubmissionError> {
        if self.source.takes_turns() {
            return Ok(());
        }
        let within: Vec<Gap> = (gaps.iter().copied())
            .filter(|gap| self.range.check(*gap).is_ok())
            .collect();
        self.ask(&within)
    }

    /// Asks at those gaps at which nothing is kept, at all of them at once.
    fn ask(&self, gaps: &[Gap]) -> Result<(), SubmissionError> {
        let _turn = self.source.takes_turns().then(|| locked(&self.turn));
        // Somebody else may have asked meanwhile.
        let mut new: Vec<Gap> = (gaps.iter().copied())
            .filter(|gap| self.kept(*gap).is_none())
            .collect();
        new.sort_by(|a, b| a.eps().total_cmp(&b.eps()));
        new.dedup_by(|a, b| a.eps().total_cmp(&b.eps()).is_eq());
        if new.is_empty() {
            return Ok(());
        }
        let in_units = |gap: &Gap| {
            let asked = gap.eps() * self.header.radius;
            // The units may take it out of the range by rounding.
            let range = self.header.range;
            range.map_or(asked, |[smallest, largest]| asked.clamp(smallest, largest))
        };
        let asked: Vec<f64> = new.iter().map(in_units).collect();
        let mut heard = Vec::with_capacity(new.len());
        let result = self.source.ask(&asked, &mut |place, said| {
            let (Some(&gap), Some(&asked)) = (new.get(place), asked.get(place)) else {
                return Err(format!("it answers {} questions", place + 1));
            };
            let kept = match understood(&self.header, gap, asked, said) {
                Ok(answer) => Ok(Arc::new(answer)),
                Err(Here(reason)) => Err(SubmissionError::NoAnswer {
                    who: self.who(),
                    gap: asked,
                    reason,
                }),
                Err(Wrong(what)) => return Err(what),
            };
            heard.push((gap.eps().to_bits(), kept));
            Ok(())
        });
        let mut answers = locked(&self.answers);
        if answers.len() + heard.len() > MOST_KEPT {
            answers.clear();
        }
        answers.extend(heard);
        result.map_err(|silence| match silence {
            Silence::Said(what) => self.failure(what),
            Silence::Raised(source) => SubmissionError::Raised {
                who: self.who(),
                source,
            },
        })
    }

    fn loads_at(
        &self,
        gap: Gap,
        set: LoadSet,
        swirl: usize,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.range.check(gap)?;
        let set = set.check()?;
        let answer = self.answer(gap).map_err(|error| self.failed(error))?;
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
            self.failed(self.failure(what))
        })
    }

    fn failed(&self, error: SubmissionError) -> SceneError {
        SceneError::from_model(self.source.kind(), error)
    }
}

fn wrong<T>(what: impl Into<String>) -> Result<T, Trouble> {
    Err(Wrong(what.into()))
}

/// What was said at `gap`, in the unit of the header's radius `asked`, if it is an answer.
fn understood(header: &Header, gap: Gap, asked: f64, said: PairAnswer) -> Result<Answer, Trouble> {
    let is_same = (said.gap - asked).abs() <= SAME_GAP * asked;
    if !is_same {
        return wrong(format!(
            "it answers for the gap {:?}, and was asked for {asked:?}",
            said.gap
        ));
    }
    if let Some(error) = said.error {
        return Err(Here(shown(&error, 120)));
    }
    read(header, gap, said)
}

/// The quantities that an answer at `gap` gives.
fn read(header: &Header, gap: Gap, said: PairAnswer) -> Result<Answer, Trouble> {
    let too_large = |error: SubmissionError| Wrong(error.to_string());
    if said.matrix.is_empty() {
        if !said.slip.is_empty() || header.matrix.is_some() {
            return wrong(
                "an answer has slip columns or a header has 'matrix', and there is no matrix",
            );
        }
        let mut values = Values::default();
        for (name, value) in said.values {
            match Quantity::named(&name) {
                Some(_) if !value.is_finite() => return Err(Here(format!("{name} is {value}"))),
                Some(quantity) => values.set(quantity, value),
                None => return wrong(rows::no_quantity(0, &name).to_string()),
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
        return wrong(
            "it answers with a matrix, and its header does not say what 'matrix' is: mobility or resistance",
        );
    };
    if !said.values.is_empty() {
        return wrong("an answer has named values and a matrix: give one of them");
    }
    let is_row = |row: &Vec<f64>| row.len() == SIZE;
    if said.matrix.len() != SIZE || !said.matrix.iter().all(is_row) {
        return wrong(format!(
            "a matrix has {SIZE} rows of {SIZE} numbers, and this one has not"
        ));
    }
    let rigid =
        nalgebra::SMatrix::<f64, SIZE, SIZE>::from_fn(|row, column| said.matrix[row][column]);
    let mut matrix = Matrix {
        rigid,
        slip: BTreeMap::new(),
    };
    let none = |row: usize, column: &str, value: f64| {
        Here(format!("row {} of column {column} is {value}", row + 1))
    };
    for row in 0..SIZE {
        for column in 0..SIZE {
            let value = rigid[(row, column)];
            if !value.is_finite() {
                return Err(none(row, &(column + 1).to_string(), value));
            }
        }
    }
    for (name, column) in said.slip {
        let slip = Slip::parse(&name).zip(<[f64; SIZE]>::try_from(column).ok());
        let Some((slip, column)) = slip else {
            return wrong(format!(
                "slip column '{}' is not allowed: give {SIZE} numbers for a column such as B1_1z",
                shown(&name, 40)
            ));
        };
        if let Some(row) = column.iter().position(|value| !value.is_finite()) {
            return Err(none(row, &name, column[row]));
        }
        matrix.slip.insert(slip, column);
    }
    matrix.answer(gap, header, kind).map_err(too_large)
}

/// The quantities that an answer at `gap` gives, of a table that holds all of them.
///
/// # Errors
/// What is wrong with it, also for numbers that are none.
pub(super) fn tabled(header: &Header, gap: Gap, said: PairAnswer) -> Result<Answer, String> {
    read(header, gap, said).map_err(|trouble| match trouble {
        Here(what) | Wrong(what) => what,
    })
}

impl std::fmt::Debug for Asked {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        (f.debug_struct("Asked"))
            .field("who", &self.who())
            .finish_non_exhaustive()
    }
}

impl Hydrodynamics for Asked {
    /// The range and the noise of the header.
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            noise: self.header.noise.unwrap_or(NOISE),
            ..ModelDescription::smooth(self.range)
        }
    }

    /// With the name: nobody knows whether it answers the same tomorrow.
    fn fingerprint(&self) -> String {
        format!("{} {}", self.source.kind(), self.source.name())
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

    fn foresee(&self, gaps: &[Gap]) -> Result<(), SceneError> {
        self.ask_ahead(gaps).map_err(|error| self.failed(error))
    }

    /// The noise of the header, if it states one.
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.loads_at(gap, set, set.swirl)?;
        Ok(self.header.noise)
    }
}

#[cfg(test)]
mod tests;
