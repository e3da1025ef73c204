//! Rows of the library as columns for Python: from the text of their CSV file, so that both hold the same digits.

use compare::CompareError;
use compare::columns::Column;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyList;

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

/// The cells of a column: whole numbers, numbers, or words.
fn values<'py>(py: Python<'py>, cells: &[&str]) -> PyResult<Bound<'py, PyAny>> {
    let is_whole = |cell: &&str| cell.parse::<i64>().is_ok();
    if !cells.is_empty() && cells.iter().all(is_whole) {
        let whole: Vec<i64> = cells.iter().filter_map(|cell| cell.parse().ok()).collect();
        return Ok(PyArray1::from_vec(py, whole).into_any());
    }
    let numbers: Option<Vec<f64>> = cells.iter().map(|cell| cell.parse().ok()).collect();
    Ok(match numbers {
        Some(numbers) => PyArray1::from_vec(py, numbers).into_any(),
        None => PyList::new(py, cells)?.into_any(),
    })
}

/// The columns of a CSV text whose first columns are not `known`: parameters of a family, whose units only its author knows.
pub(crate) fn parts(py: Python<'_>, text: String, known: &[Column]) -> PyResult<Parts> {
    let failed = |error: csv::Error| raised(CompareError::Rows(error));
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = (reader.headers().map_err(failed)?.iter())
        .map(str::to_owned)
        .collect();
    let records = reader
        .records()
        .collect::<Result<Vec<_>, _>>()
        .map_err(failed)?;
    let own = names.len().saturating_sub(known.len());
    let of_parameter = |name: &String| {
        let meaning = "Parameter of the family.".to_owned();
        (name.clone(), "-".to_owned(), meaning)
    };
    let head = names.iter().take(own).map(of_parameter);
    let columns = head.chain(described(known)).collect();
    let mut cells = Vec::with_capacity(names.len());
    for column in 0..names.len() {
        let of_column: Vec<&str> = (records.iter())
            .map(|record| record.get(column).unwrap_or_default())
            .collect();
        cells.push(values(py, &of_column)?.unbind());
    }
    drop(records);
    Ok((columns, cells, text))
}
