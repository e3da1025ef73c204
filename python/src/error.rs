//! Errors of the library as Python exceptions with the same text.

use std::error::Error;
use std::iter::successors;

use ::scene::SceneError;
use compare::submission::SubmissionError;
use compare::{CompareError, FailureKind, Mistakes};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// The module that defines the exceptions.
const MODULE: &str = "squirmers._errors";

static INPUT: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static FILE: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static COMPUTATION: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// Longest line of a message, in letters: a path may be of any length.
const LONGEST: usize = 1000;

/// The text with the beginnings of lines that are too long.
fn short(text: String) -> String {
    if text.len() <= LONGEST {
        return text;
    }
    let line = |line: &str| match line.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &line[..end]),
        None => line.to_owned(),
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

fn of_type(name: &str, text: String) -> PyErr {
    let slot = match name {
        "FileError" => &FILE,
        "ComputationError" => &COMPUTATION,
        _ => &INPUT,
    };
    Python::attach(|py| match slot.import(py, MODULE, name) {
        Ok(class) => PyErr::from_type(class.clone(), short(text)),
        Err(error) => error,
    })
}

/// A value that is not allowed: `squirmers.InputError`, a `ValueError`.
pub(crate) fn input(what: &'static str, value: impl ToString, allowed: impl Into<String>) -> PyErr {
    raised(CompareError::input(what, value, allowed))
}

/// A value that is not allowed, as a whole line says: `squirmers.InputError`.
pub(crate) fn refused(line: String) -> PyErr {
    of_type("InputError", line)
}

/// Work that cannot be done: `squirmers.ComputationError`.
pub(crate) fn impossible(line: &str) -> PyErr {
    of_type("ComputationError", line.to_owned())
}

/// What options of the command line are called in Python.
const ARGUMENTS: [(&str, &str); 15] = [
    ("--vary", "axes"),
    ("--method", "models"),
    ("--mesh", "level"),
    ("--tol", "tolerance"),
    ("--departure", "angles_at"),
    ("--time-limit", "time_limit"),
    ("--partition", "partition"),
    ("--grid", "grid"),
    ("--impact", "impact"),
    ("--count", "count"),
    ("--replications", "replications"),
    ("--out", "out"),
    ("--fresh", "fresh"),
    ("--time", "time"),
    ("--gap", "gap"),
];

/// A message whose options are arguments of Python. Words within quotes stay.
fn in_python(text: &str) -> String {
    let word = |word: &str| {
        let option = word.trim_end_matches([':', ',', ';']);
        let known = ARGUMENTS.iter().find(|(known, _)| *known == option);
        known.map_or(word.to_owned(), |(_, argument)| {
            word.replacen(option, argument, 1)
        })
    };
    let words: Vec<String> = text.split(' ').map(word).collect();
    words.join(" ")
}

/// The exception for an error. What a function of Python raised is raised as it is.
pub(crate) fn raised(error: CompareError) -> PyErr {
    let outermost: &(dyn Error + 'static) = &error;
    let causes = successors(Some(outermost), |&error| error.source());
    let mut own = causes.filter_map(|cause| cause.downcast_ref::<PyErr>());
    if let Some(own) = own.next() {
        return Python::attach(|py| own.clone_ref(py));
    }
    let text = match &error {
        // Of a model that was given as an argument.
        CompareError::Input {
            what: "--method" | "judge",
            value,
            allowed,
        } => format!("model '{value}' is not allowed: {}", in_python(allowed)),
        // It names the model itself.
        CompareError::Scene(SceneError::Model { source, .. }) if source.is::<SubmissionError>() => {
            source.to_string()
        }
        error => in_python(&error.to_string()),
    };
    match (&error, error.kind()) {
        (
            CompareError::Write { .. }
            | CompareError::Read { .. }
            | CompareError::Busy { .. }
            | CompareError::Share { .. }
            | CompareError::OtherSweep { .. },
            _,
        ) => of_type("FileError", text),
        (_, FailureKind::Input) => of_type("InputError", text),
        (_, FailureKind::Computation | FailureKind::Stopped) => of_type("ComputationError", text),
        (_, FailureKind::Interrupted) => PyKeyboardInterrupt::new_err(text),
    }
}

/// The exception for an error of a scene or a model.
pub(crate) fn of_scene(error: SceneError) -> PyErr {
    raised(error.into())
}

/// The exception for a submission that is refused.
pub(crate) fn of_submission(error: SubmissionError) -> PyErr {
    let class = match error {
        SubmissionError::Read { .. } => "FileError",
        _ => "InputError",
    };
    of_type(class, error.to_string())
}

/// The exception for mistakes in the text of a scene or family.
pub(crate) fn of_mistakes(mistakes: &Mistakes) -> PyErr {
    of_type(
        "InputError",
        format!("mistakes in the scene (line:column: key):\n{mistakes}"),
    )
}
