//! `judge`, the leaderboard, and the package of reference numbers.

use ::scene::{Gap, LoadSet};
use compare::columns::Columns;
use compare::judge::{
    GAPS, JudgeRow, LeaderRow, OWN_GAPS, Options, READ, judge as judged, leader_rows,
    leaderboard as cards, moving, submission_of,
};
use compare::output::csv_text;
use compare::study::maps::Grid;
use compare::submission::Submitted;
use compare::{CompareError, Method, Model as Ready, ModelOptions, Reads};
use pyo3::prelude::*;

use crate::array::{Numbers, Show};
use crate::background::in_background;
use crate::error::{input, raised};
use crate::loads;
use crate::model::Model;
use crate::table::{Parts, parts};

/// Largest error of a group of numbers at a gap: title of the group, gap, error, whether the gap lies between those of the model.
type Errors = Vec<(&'static str, f64, f64, bool)>;

/// Gaps at which a model is asked, checked.
fn checked_gaps(model: &Model, gaps: Option<Numbers<'_>>) -> PyResult<Option<Vec<f64>>> {
    let Some(gaps) = gaps else { return Ok(None) };
    if let Some(Submitted::File(_)) = model.submitted() {
        let allowed = "a table or file is judged at its own gaps: leave it out";
        return Err(input("gaps", "of a table", allowed));
    }
    let gaps = loads::checked_gaps(model, &gaps, 1.0)?;
    if gaps.is_empty() {
        return Err(input("gaps", "[]", "give at least one gap"));
    }
    Ok(Some(gaps.into_iter().map(Gap::eps).collect()))
}

/// The exact model where no collisions are run.
fn untabulated() -> Result<Ready, CompareError> {
    let options = ModelOptions {
        direct: true,
        ..ModelOptions::default()
    };
    Ready::set_up(Method::Exact, &options)
}

/// Judges a model; `exact` is the model that its collisions are compared with. The scorecard as JSON, its rows, and its errors by group.
#[pyfunction]
#[pyo3(signature = (model, exact, grid, gaps, show))]
pub(crate) fn judge<'py>(
    py: Python<'py>,
    model: &Bound<'py, Model>,
    exact: &Bound<'py, Model>,
    grid: usize,
    gaps: Option<Numbers<'py>>,
    show: Option<Show<'py>>,
) -> PyResult<(String, Parts, Errors)> {
    let (model, exact) = (model.get(), exact.get());
    let grid = match grid {
        0 => None,
        points => Some(Grid::new(points).map_err(raised)?),
    };
    let gaps = checked_gaps(model, gaps)?;
    let (method, setter, exact) = (model.method(), model.setter(), exact.setter());
    let (submitted, options) = (model.submitted().cloned(), model.options().clone());
    let card = in_background(py, show.as_ref(), move || {
        let submitted = match submitted {
            Some(submitted) => submitted,
            None => {
                let options = ModelOptions {
                    direct: true,
                    tabulated: LoadSet::all(2),
                    ..options
                };
                let own = Ready::set_up(method, &options)?;
                let gaps = gaps.as_deref().unwrap_or(&OWN_GAPS);
                let title = method.in_sentence();
                Submitted::File(submission_of(title, &*own, gaps, LoadSet::all(2))?)
            }
        };
        let reads = Reads {
            loads: Some(READ),
            ratios: vec![1.0],
        };
        let theirs = match grid {
            Some(_) => moving(method, || setter.set_up(&reads))?,
            None => Err("not asked for".to_owned()),
        };
        let options = Options {
            grid,
            gaps: gaps.as_deref().unwrap_or(&GAPS),
        };
        let theirs = theirs.as_ref().map_err(String::clone);
        let exact = match grid {
            Some(_) => exact.set_up(&reads)?,
            None => untabulated()?,
        };
        let card = judged(method.name(), &submitted, theirs, &exact, &options)?;
        let errors = card.curves().into_iter();
        let errors = errors.map(|at| (at.group.title(), at.gap, at.error, at.between));
        Ok((
            serde_json::to_string(&card.judged())?,
            csv_text(&card.rows())?,
            errors.collect::<Errors>(),
        ))
    })?;
    let (json, rows, errors) = card;
    Ok((json, parts(py, rows, JudgeRow::COLUMNS)?, errors))
}

/// The leaderboard: public codes and the models of this library, by rising score.
#[pyfunction]
#[pyo3(signature = (show))]
pub(crate) fn leaderboard(py: Python<'_>, show: Option<Show<'_>>) -> PyResult<Parts> {
    let text = in_background(py, show.as_ref(), move || {
        csv_text(&leader_rows(&cards(&untabulated()?)?))
    })?;
    parts(py, text, LeaderRow::COLUMNS)
}

/// The files of the package of reference numbers, by name.
#[pyfunction]
pub(crate) fn reference_files() -> Vec<(&'static str, &'static str)> {
    fixtures::REFERENCE.to_vec()
}
