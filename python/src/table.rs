//! Rows of the library as columns for Python: from the text of their CSV file, so that both hold the same digits.

use std::collections::HashMap;

use compare::CompareError;
use compare::columns::Column;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyString};

use crate::error::raised;

/// Name, unit and meaning of a column.
pub(crate) type Described = (String, String, String);

/// What Python makes a table of: the columns' descriptions, their values, and the CSV text.
pub(crate) type Parts = (Vec<Described>, Vec<Py<PyAny>>, String);

/// The descriptions of columns.
pub(crate) fn described(columns: &[Column]) -> Vec<Described> {
    let own = |column: &Column| {
        let Column { name, unit, doc } = *column;
        (name.to_owned(), unit.to_owned(), doc.to_owned())
    };
    columns.iter().map(own).collect()
}

/// The cells of a column.
enum Cells {
    Whole(Vec<i64>),
    Numbers(Vec<f64>),
    /// Places of the words among the different ones.
    Words(Vec<usize>, HashMap<String, usize>),
}

impl Cells {
    /// Adds a cell, if it is of the kind of the others.
    fn push(&mut self, cell: &str) -> Option<()> {
        match self {
            Self::Whole(cells) => cells.push(cell.parse().ok()?),
            Self::Numbers(cells) => cells.push(cell.parse().ok()?),
            Self::Words(cells, words) => {
                let new = words.len();
                let place = match words.get(cell) {
                    Some(place) => *place,
                    None => *words.entry(cell.to_owned()).or_insert(new),
                };
                cells.push(place);
            }
        }
        Some(())
    }

    /// No cells, of the same kind or of the next one, which holds more.
    fn anew(&self, wider: bool) -> Self {
        match (self, wider) {
            (Self::Whole(_), false) => Self::Whole(Vec::new()),
            (Self::Whole(_), true) | (Self::Numbers(_), false) => Self::Numbers(Vec::new()),
            (Self::Numbers(_), true) | (Self::Words(..), _) => {
                Self::Words(Vec::new(), HashMap::new())
            }
        }
    }

    fn into_python(self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        Ok(match self {
            Self::Whole(cells) => PyArray1::from_vec(py, cells).into_any().unbind(),
            Self::Numbers(cells) => PyArray1::from_vec(py, cells).into_any().unbind(),
            Self::Words(cells, places) => {
                let mut words: Vec<(usize, String)> = places
                    .into_iter()
                    .map(|(word, place)| (place, word))
                    .collect();
                words.sort_unstable();
                if words
                    .iter()
                    .all(|(_, word)| word == "true" || word == "false")
                {
                    let is_true =
                        |cell: usize| words.get(cell).is_some_and(|(_, word)| word == "true");
                    let cells = cells.into_iter().map(is_true).collect();
                    return Ok(PyArray1::from_vec(py, cells).into_any().unbind());
                }
                let words: Vec<_> = (words.iter())
                    .map(|(_, word)| PyString::new(py, word))
                    .collect();
                PyList::new(py, cells.iter().map(|cell| &words[*cell]))?
                    .into_any()
                    .unbind()
            }
        })
    }
}

/// Names and cells of the columns of a CSV text. Without rows nothing tells kinds, and columns are of numbers.
fn read(text: &str) -> Result<(Vec<String>, Vec<Cells>), csv::Error> {
    let reader = || csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = reader().headers()?.iter().map(str::to_owned).collect();
    let mut columns: Vec<Cells> = names.iter().map(|_| Cells::Whole(Vec::new())).collect();
    let mut record = csv::StringRecord::new();
    // The first row tells nearly all kinds. Where a later one tells another, it begins again.
    loop {
        let mut reader = reader();
        let mut rows = 0_usize;
        let mut narrow = None;
        while narrow.is_none() && reader.read_record(&mut record)? {
            rows += 1;
            let mut cells = columns.iter_mut().zip(&record);
            narrow = cells.position(|(column, cell)| column.push(cell).is_none());
        }
        let anew =
            |(place, column): (usize, &Cells)| column.anew(rows == 0 || narrow == Some(place));
        if rows > 0 && narrow.is_none() {
            return Ok((names, columns));
        }
        columns = columns.iter().enumerate().map(anew).collect();
        if rows == 0 {
            return Ok((names, columns));
        }
    }
}

/// The columns of a CSV text whose first columns are not `known`: parameters of a family, whose units only its author knows.
pub(crate) fn parts(py: Python<'_>, text: String, known: &[Column]) -> PyResult<Parts> {
    let (names, cells) = py
        .detach(|| read(&text))
        .map_err(|error| raised(CompareError::Rows(error)))?;
    let own = names.len().saturating_sub(known.len());
    let of_parameter = |name: String| {
        let meaning = "Parameter of the family.".to_owned();
        (name, "-".to_owned(), meaning)
    };
    let head = names.into_iter().take(own).map(of_parameter);
    let columns = head.chain(described(known)).collect();
    let cells = cells.into_iter().map(|column| column.into_python(py));
    Ok((columns, cells.collect::<PyResult<_>>()?, text))
}
