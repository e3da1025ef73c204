//! Judges anybody's model of two equal spheres against exact hydrodynamics: its numbers, the laws that they must obey, what it makes of collisions,
//! and a verdict in words.

mod causes;
mod collisions;
mod contact;
mod curves;
mod faults;
mod history;
mod json;
mod laws;
mod leaderboard;
mod points;
mod rows;
mod verdict;

use std::time::Instant;

use scene::{Gap, LoadSet, SceneError};

use crate::model::check_loads;
use crate::study::maps::Grid;
use crate::submission::{
    Answer, Asked, Header, Interpolation, Quantity, Submission, SubmissionError, Submitted,
    SubmittedModel, Values, is_raised,
};
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, Model};

pub use collisions::{ANGLES_AT, BETAS, BoundComparison, CaseScore, Collisions, Parting};
pub use contact::Contact;
pub use curves::{ErrorAt, Group};
pub use faults::{Affected, FAULT, Fault, Kind};
pub use history::{
    HistoryRow, Measure, history_rows, instruction_rows, outside_bands, read_history,
};
pub use json::Judged;
pub use laws::{Decay, Law};
pub use leaderboard::{LeaderRow, OWN_GAPS, is_public, leader_rows, leaderboard, submission_of};
pub use points::{Item, Point, TRUST, Truth, trusted_down_to};
pub use rows::{JudgeRow, MEASURES};

/// Gaps at which a model that is asked is judged, within its range.
pub const GAPS: [f64; 22] = [
    0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5,
    2.0, 4.0, 10.0, 38.0, 100.0, 998.0,
];

/// Gap from which on units and signs of the far field can be checked.
pub const FAR_GAP: f64 = 38.0;

/// A model and what there is to say of it.
#[derive(Clone, Debug)]
pub struct Scorecard {
    /// The name that the user gave.
    pub name: String,
    /// What it says of itself.
    pub header: Header,
    /// Gaps at which a process has no answer, and why.
    pub unanswered: Vec<(f64, String)>,
    /// Errors at its own gaps, calibrated if it declares a calibration.
    pub points: Vec<Point>,
    /// Errors of what is by slip without the calibration; none if it declares none.
    pub raw: Vec<Point>,
    /// Errors between its gaps, by the interpolation that it declares.
    pub between: Vec<Point>,
    /// Quantities of the modes 1 and 2 that it neither gives at all gaps nor that follow from those.
    pub missing: Vec<Missing>,
    /// Worst breaches of laws by matrices, with the gap: asymmetry, unlike spheres, smallest eigenvalue.
    pub matrix_laws: Vec<Law>,
    /// Smallest eigenvalue of the mobility of scalars at each gap, 1 of lone spheres.
    pub definite: Vec<(f64, f64)>,
    /// Singular terms near contact.
    pub contacts: Vec<Contact>,
    /// Sums of singular terms that must cancel, relative to one of them.
    pub third_law: Vec<(String, f64)>,
    /// Powers of the distance with which it falls off far away, and the true ones.
    pub decays: Vec<Decay>,
    /// What is wrong with it.
    pub faults: Vec<Fault>,
    /// Collisions, or why there are none.
    pub collisions: Result<Collisions, String>,
    /// Seconds for one gap: stated, or measured of a process.
    pub seconds_per_gap: Option<f64>,
    /// The same of exact loads, measured now.
    pub exact_seconds_per_gap: f64,
}

/// A quantity that is missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Missing {
    /// Which.
    pub quantity: Quantity,
    /// At how many gaps.
    pub at: usize,
}

/// What is asked of a submission beside its numbers.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// The grid of incoming angles; none leaves collisions out.
    pub grid: Option<Grid>,
    /// Gaps at which a process or a function is asked, in radii; those outside its range are left out.
    pub gaps: &'a [f64],
}

/// Judges a submission. `exact` is the model that its collisions are compared with; `theirs` that of the submission, or why it moves no pair.
///
/// # Errors
/// [`CompareError`] if exact loads fail, or a process or a function does not answer.
pub fn judge(
    name: &str,
    submitted: &Submitted,
    theirs: Result<&Model, String>,
    exact: &Model,
    options: &Options<'_>,
) -> Result<Scorecard, CompareError> {
    let header = submitted.header().clone();
    let asked;
    let (submission, measured, unanswered) = match submitted {
        Submitted::File(submission) => (submission, None, Vec::new()),
        Submitted::Asked(source) => {
            asked = ask(name, source, options.gaps)?;
            (
                &asked.submission,
                Some(asked.seconds),
                asked.unanswered.clone(),
            )
        }
    };
    let answers = submission.answers();
    let calibrated: Vec<(Gap, Values)> = (answers.iter())
        .map(|answer| (answer.gap, answer.values.calibrated(&header)))
        .collect();
    let given = answers
        .iter()
        .flat_map(|answer| answer.values.iter().map(|(quantity, _)| quantity));
    let truth = Truth::of(given);
    let truths = truth.at_each(&calibrated)?;
    let points = points::against(&calibrated, &truths);
    if points.is_empty() {
        return Err(CompareError::input(
            "judge",
            name,
            "it has no number that can be judged",
        ));
    }
    let raw = if header.slip_calibration.is_empty() {
        Vec::new()
    } else {
        let raw: Vec<_> = answers
            .iter()
            .map(|answer| (answer.gap, answer.values.clone()))
            .collect();
        let by_slip = |point: &Point| match point.item {
            Item::Quantity(quantity) => quantity.mode().is_some(),
            Item::Approach(_) => true,
        };
        let raw = points::against(&raw, &truths);
        raw.into_iter().filter(by_slip).collect()
    };
    let between = match submitted {
        Submitted::File(submission) => between(submission, &truth)?,
        Submitted::Asked(_) => Vec::new(),
    };
    let items = points::by_item(&points);
    let contacts: Vec<Contact> = items
        .iter()
        .filter_map(|(item, points)| contact::fit(*item, points))
        .collect();
    let mut faults = causes::faults(submission, &items, &between, &contacts);
    if !faults.is_empty()
        && let Some(fault) = causes::wrong_gaps(&truth, &calibrated, &points)?
    {
        faults = vec![fault];
    }
    let collisions = match (theirs, options.grid) {
        (_, None) => Err("not asked for".to_owned()),
        (Err(reason), _) => Err(reason),
        (Ok(theirs), Some(grid)) => Ok(collisions::collisions(theirs, exact, grid)?),
    };
    let some_gaps: Vec<Gap> = answers.iter().map(|answer| answer.gap).take(20).collect();
    Ok(Scorecard {
        name: name.to_owned(),
        missing: missing(answers.len(), &points),
        matrix_laws: laws::matrix_laws(answers),
        definite: laws::definite(&points),
        third_law: contact::third_law(&contacts),
        decays: laws::decays(&items),
        seconds_per_gap: measured.or(header.seconds_per_gap),
        exact_seconds_per_gap: seconds_of(&truth, &some_gaps)?,
        header,
        unanswered,
        points,
        raw,
        between,
        contacts,
        faults,
        collisions,
    })
}

/// The loads that collisions read.
pub const READ: LoadSet = LoadSet::planar(2);

/// Sets up the model of a submission for collisions; otherwise the reason why it moves no pair.
///
/// # Errors
/// [`CompareError::Input`] for a name that is taken or not allowed; an error of a function's own.
pub fn mover(name: &str, submitted: &Submitted) -> Result<Result<Model, String>, CompareError> {
    let (model, is_dear) = match submitted.model() {
        Ok(model) => model,
        Err(error) => return Ok(Err(error.to_string())),
    };
    let method = Method::registered(name, model, is_dear)?;
    let options = crate::ModelOptions {
        tabulated: READ,
        ..crate::ModelOptions::default()
    };
    moving(method, || Model::set_up(method, &options))
}

/// The model that `set_up` makes of a method for collisions; otherwise the reason why it moves no pair.
///
/// # Errors
/// An error of a function's own.
pub fn moving(
    method: Method,
    set_up: impl FnOnce() -> Result<Model, CompareError>,
) -> Result<Result<Model, String>, CompareError> {
    // What it lacks is told in its own words.
    if let Method::Other(other) = method {
        match check_loads(other.hydrodynamics(), READ) {
            Err(error) if is_raised(&error) => return Err(error.into()),
            Err(SceneError::Model { source, .. }) => return Ok(Err(source.to_string())),
            _ => {}
        }
    }
    let smallest_needed = ANGLES_AT - 2.0;
    if method.largest_gap() < smallest_needed {
        return Ok(Err(format!(
            "its largest gap is {}, and a pair that parts is followed to a gap of {}",
            crate::numbers::written(method.largest_gap()),
            crate::numbers::written(smallest_needed)
        )));
    }
    match set_up() {
        Ok(model) => Ok(Ok(model)),
        Err(error) if is_raised(&error) => Err(error),
        Err(CompareError::Input { allowed, .. }) => Ok(Err(allowed)),
        Err(CompareError::Scene(SceneError::Model { source, .. })) => Ok(Err(source.to_string())),
        Err(other) => Ok(Err(other.in_one_line())),
    }
}

/// The method of the referee, with the loads that collisions read.
///
/// # Errors
/// As [`Model::set_up`].
pub fn referee(options: &crate::ModelOptions) -> Result<Model, CompareError> {
    let options = crate::ModelOptions {
        tabulated: READ,
        direct: false,
        ..options.clone()
    };
    Model::set_up(Method::Exact, &options)
}

/// What a model that is asked says.
struct Told {
    submission: Submission,
    /// Time of one answer.
    seconds: f64,
    /// Gaps without an answer, and why.
    unanswered: Vec<(f64, String)>,
}

/// What a model says at those of the gaps that are in its range.
fn ask(name: &str, asked: &Asked, gaps: &[f64]) -> Result<Told, CompareError> {
    let refused = |allowed: String| CompareError::input("judge", name, allowed);
    let range = asked.range();
    let mut within: Vec<Gap> = (gaps.iter())
        .filter_map(|gap| Gap::new(*gap).ok())
        .filter(|gap| range.check(*gap).is_ok())
        .collect();
    within.sort_by(|a, b| a.eps().total_cmp(&b.eps()));
    within.dedup_by(|a, b| a.eps().total_cmp(&b.eps()).is_eq());
    if within.is_empty() {
        return Err(refused(format!(
            "its range holds none of the gaps {gaps:?}"
        )));
    }
    let progress = Progress::begin("questions", within.len(), Pieces::Alike);
    let (mut answers, mut unanswered) = (Vec::new(), Vec::new());
    let started = Instant::now();
    let failed = |error: SubmissionError| match error {
        SubmissionError::Raised { .. } => SceneError::from_model("model", error).into(),
        error => refused(error.to_string()),
    };
    asked.ask_ahead(&within).map_err(failed)?;
    for gap in &within {
        match asked.answer(*gap) {
            Ok(answer) => answers.push(Answer::clone(&answer)),
            Err(SubmissionError::NoAnswer { reason, .. }) => unanswered.push((gap.eps(), reason)),
            Err(error) => return Err(failed(error)),
        }
        progress.advance();
    }
    Ok(Told {
        seconds: started.elapsed().as_secs_f64() / within.len() as f64,
        submission: Submission::of_answers(asked.header().clone(), answers),
        unanswered,
    })
}

fn seconds_of(truth: &Truth, gaps: &[Gap]) -> Result<f64, SceneError> {
    let started = Instant::now();
    for &gap in gaps {
        truth.at(gap)?;
    }
    Ok(started.elapsed().as_secs_f64() / gaps.len().max(1) as f64)
}

/// Places between two gaps, as shares of the interval of the gap's logarithm.
const SHARES: [f64; 3] = [0.25, 0.5, 0.75];

/// Number of gaps above which only the middle of each interval is looked at.
const MANY: usize = 100;

/// Errors between the gaps of a file, by the interpolation that it declares.
fn between(submission: &Submission, truth: &Truth) -> Result<Vec<Point>, SceneError> {
    let declared = submission.header().interpolation;
    if declared.is_none_or(|declared| declared == Interpolation::None) {
        return Ok(Vec::new());
    }
    let Ok(model) = SubmittedModel::new(submission) else {
        return Ok(Vec::new());
    };
    let answers = submission.answers();
    let shares = if answers.len() > MANY {
        &SHARES[1..2]
    } else {
        &SHARES[..]
    };
    let mut said = Vec::new();
    for ends in answers.windows(2) {
        let [from, to] = [0, 1].map(|k| ends[k].gap.ln());
        for share in shares {
            let gap = Gap::from_ln(from + share * (to - from));
            let mut values = Values::default();
            for quantity in Quantity::all() {
                if let Some(value) = model.quantity(gap, quantity)? {
                    values.set(quantity, value);
                }
            }
            said.push((gap, values));
        }
    }
    truth.points(&said)
}

/// Quantities of a complete submission: loads of rigid motion and of the first two modes.
fn expected() -> impl Iterator<Item = Quantity> {
    Quantity::all().filter(|quantity| {
        quantity.is_load()
            && !quantity.is_by_swirl()
            && quantity.mode().is_none_or(|mode| mode <= 2)
    })
}

fn missing(gaps: usize, points: &[Point]) -> Vec<Missing> {
    let lacks = |quantity: Quantity| {
        let there = points
            .iter()
            .filter(|point| point.item == Item::Quantity(quantity))
            .count();
        let at = gaps - there.min(gaps);
        (at > 0).then_some(Missing { quantity, at })
    };
    expected().filter_map(lacks).collect()
}

#[cfg(test)]
mod tests;
