//! Errors of the library as Python exceptions with the same text.

use ::scene::SceneError;
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

fn of_type(name: &str, text: String) -> PyErr {
    let slot = match name {
        "FileError" => &FILE,
        "ComputationError" => &COMPUTATION,
        _ => &INPUT,
    };
    Python::attach(|py| match slot.import(py, MODULE, name) {
        Ok(class) => PyErr::from_type(class.clone(), text),
        Err(error) => error,
    })
}

/// A value that is not allowed: `squirmers.InputError`, a `ValueError`.
pub(crate) fn input(what: &'static str, value: impl ToString, allowed: impl Into<String>) -> PyErr {
    raised(CompareError::input(what, value, allowed))
}

/// What an error says. Where the library names an option of the command line, in Python it is an argument.
fn text_of(error: &CompareError) -> String {
    let text = error.to_string();
    match error {
        CompareError::Input { .. } => text.trim_start_matches("--").to_owned(),
        _ => text,
    }
}

/// The exception for an error.
pub(crate) fn raised(error: CompareError) -> PyErr {
    let text = text_of(&error);
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

/// The exception for mistakes in the text of a scene or family.
pub(crate) fn of_mistakes(mistakes: &Mistakes) -> PyErr {
    of_type(
        "InputError",
        format!("mistakes in the scene (line:column: key):\n{mistakes}"),
    )
}
