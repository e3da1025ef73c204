//! Anybody's models: a function of Python that is asked, a table, a file.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::SeqCst};

use ::scene::ModelFailure;
use compare::submission::{
    Asked, Header, Heard, Interpolation, MatrixKind, PairAnswer, Silence, Source, Submission,
    Submitted,
};
use numpy::PyArray1;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::{type_hint_identifier, type_hint_subscript};

use crate::array::Numbers;
use crate::error::{input, of_submission};

/// The module that reads what functions return and tables hold.
const READER: &str = "squirmers._outside";

/// Most calls of one function at once: more are one that asks its own model.
const MOST_AT_ONCE: usize = 64;

/// A function of gaps, in any form that Python can call.
pub(crate) struct Function<'py>(pub Bound<'py, PyAny>);

impl<'a, 'py> FromPyObject<'a, 'py> for Function<'py> {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = type_hint_subscript!(
        type_hint_identifier!("collections.abc", "Callable"),
        PyStaticExpr::List {
            elts: &[type_hint_subscript!(
                type_hint_identifier!("numpy.typing", "NDArray"),
                type_hint_identifier!("numpy", "float64")
            )]
        },
        type_hint_identifier!("builtins", "object")
    );

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if !object.is_callable() {
            let value = object.repr()?.to_string();
            return Err(input("f", value, "give a function of an array of gaps"));
        }
        Ok(Self(object.to_owned()))
    }
}

/// One of a few words, or none.
fn chosen<T: Copy>(
    what: &'static str,
    word: Option<&str>,
    all: &[(&str, T)],
) -> PyResult<Option<T>> {
    let Some(word) = word else { return Ok(None) };
    let found = all.iter().find(|(name, _)| *name == word);
    let names: Vec<_> = all.iter().map(|(name, _)| *name).collect();
    let refused = || input(what, word, format!("give {}", names.join(", ")));
    found.map(|(_, chosen)| Some(*chosen)).ok_or_else(refused)
}

pub(crate) fn matrix_kind(word: Option<&str>) -> PyResult<Option<MatrixKind>> {
    let all = [
        ("mobility", MatrixKind::Mobility),
        ("resistance", MatrixKind::Resistance),
    ];
    chosen("matrix", word, &all)
}

pub(crate) fn interpolation(word: Option<&str>) -> PyResult<Option<Interpolation>> {
    let all = [
        ("linear", Interpolation::Linear),
        ("log-linear", Interpolation::LogLinear),
        ("log-cubic", Interpolation::LogCubic),
        ("none", Interpolation::None),
    ];
    chosen("interpolation", word, &all)
}

/// Numbers of slip modes, if there are any.
pub(crate) fn modes(what: &'static str, numbers: Option<Numbers<'_>>) -> PyResult<Vec<f64>> {
    numbers.map_or(Ok(Vec::new()), |numbers| numbers.list(what))
}

/// What the reader makes of an answer: names and numbers of quantities, matrices, names and numbers of slip columns, each gap after gap.
type Read<'py> = (
    Vec<String>,
    Numbers<'py>,
    Option<Numbers<'py>>,
    Vec<String>,
    Numbers<'py>,
);

/// An answer for each gap.
fn pairs(gaps: &[f64], read: &Read<'_>) -> Vec<PairAnswer> {
    let (names, values, matrices, columns, slip) = read;
    let (values, slip) = (values.flat(), slip.flat());
    let matrices = matrices.as_ref().map(Numbers::flat);
    let pair = |(at, &gap): (usize, &f64)| {
        let own = values.get(at * names.len()..).unwrap_or_default();
        let matrix = (matrices.iter())
            .flat_map(|all| all.chunks(12).skip(12 * at).take(12))
            .map(<[f64]>::to_vec);
        let of_slip = slip.chunks(12).skip(columns.len() * at);
        PairAnswer {
            gap,
            values: names.iter().cloned().zip(own.iter().copied()).collect(),
            matrix: matrix.collect(),
            slip: (columns.iter().cloned())
                .zip(of_slip.map(<[f64]>::to_vec))
                .collect::<BTreeMap<_, _>>(),
            error: None,
        }
    };
    gaps.iter().enumerate().map(pair).collect()
}

/// A function that is asked.
struct Callable {
    name: String,
    function: Py<PyAny>,
    matrix: bool,
    /// Calls that have not ended.
    calls: AtomicUsize,
}

impl Callable {
    fn call(&self, py: Python<'_>, gaps: &[f64]) -> PyResult<Vec<PairAnswer>> {
        let array = || PyArray1::from_slice(py, gaps);
        let said = self.function.call1(py, (array(),))?;
        // The function may have changed its argument.
        let read = (py.import(READER)?)
            .call_method1("answered", (said, array(), self.name.as_str(), self.matrix))?;
        Ok(pairs(gaps, &read.extract()?))
    }
}

impl Source for Callable {
    fn kind(&self) -> &'static str {
        "model"
    }

    fn name(&self) -> &str {
        &self.name
    }

    /// It may compute with this library, and whoever waits for it must not hold what that needs.
    fn takes_turns(&self) -> bool {
        false
    }

    fn ask(&self, gaps: &[f64], heard: &mut Heard<'_>) -> Result<(), Silence> {
        if self.calls.fetch_add(1, SeqCst) >= MOST_AT_ONCE {
            self.calls.fetch_sub(1, SeqCst);
            let what =
                "its function is called while it has not returned: it must not ask its own model";
            return Err(Silence::Said(what.to_owned()));
        }
        let said = Python::attach(|py| self.call(py, gaps));
        self.calls.fetch_sub(1, SeqCst);
        let said = said.map_err(|error| Silence::Raised(ModelFailure::new(error)))?;
        for (place, said) in said.into_iter().enumerate() {
            heard(place, said).map_err(Silence::Said)?;
        }
        Ok(())
    }
}

/// A model that asks a function.
pub(crate) fn of_function(
    function: Function<'_>,
    name: &str,
    header: Header,
) -> PyResult<Submitted> {
    let callable = Callable {
        name: name.to_owned(),
        function: function.0.unbind(),
        matrix: header.matrix.is_some(),
        calls: AtomicUsize::new(0),
    };
    let asked = Asked::new(Arc::new(callable), header).map_err(of_submission)?;
    Ok(Submitted::Asked(Arc::new(asked)))
}

/// A model of a table.
pub(crate) fn of_table(
    table: &Bound<'_, PyAny>,
    name: &str,
    header: Header,
) -> PyResult<Submitted> {
    let reader = table.py().import(READER)?;
    let arguments = (table, name, header.matrix.is_some());
    let read = reader.call_method1("tabled", arguments)?;
    let (gaps, read): (Numbers<'_>, Read<'_>) = read.extract()?;
    let submission = Submission::of_pairs(header, pairs(&gaps.flat(), &read));
    Ok(Submitted::File(submission.map_err(of_submission)?))
}
