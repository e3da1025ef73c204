//! Rows of the library as columns for Python: from the text of their CSV file, so that both hold the same digits.

use std::collections::HashMap;

use compare::CompareError;
use compare::columns::Column;
use numpy::PyArray1;
use pyo3::prelude::*;
use rayon::prelude::*;

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
    Words(Words),
}

/// Cells of words, of which there are few different ones.
#[derive(Default)]
struct Words {
    different: Vec<String>,
    places: HashMap<String, usize>,
    cells: Vec<usize>,
}

impl Words {
    /// The place of a word among the different ones.
    fn place(&mut self, word: &str) -> usize {
        if let Some(place) = self.places.get(word) {
            return *place;
        }
        let place = self.different.len();
        self.different.push(word.to_owned());
        self.places.insert(word.to_owned(), place);
        place
    }
}

impl Cells {
    /// No cells, of the same kind or of the next one, which holds more.
    fn anew(&self, wider: bool) -> Self {
        match (self, wider) {
            (Self::Whole(_), false) => Self::Whole(Vec::new()),
            (Self::Whole(_), true) | (Self::Numbers(_), false) => Self::Numbers(Vec::new()),
            (Self::Numbers(_), true) | (Self::Words(_), _) => Self::Words(Words::default()),
        }
    }

    /// Adds a cell, if it is of the kind of the others.
    fn push(&mut self, cell: &str) -> Option<()> {
        match self {
            Self::Whole(cells) => cells.push(cell.parse().ok()?),
            Self::Numbers(cells) => cells.push(cell.parse().ok()?),
            Self::Words(words) => {
                let place = words.place(cell);
                words.cells.push(place);
            }
        }
        Some(())
    }

    /// Adds cells of the same kind.
    fn append(&mut self, others: Self) {
        match (self, others) {
            (Self::Whole(cells), Self::Whole(others)) => cells.extend(others),
            (Self::Numbers(cells), Self::Numbers(others)) => cells.extend(others),
            (Self::Words(words), Self::Words(others)) => {
                let places: Vec<usize> = (others.different.iter())
                    .map(|word| words.place(word))
                    .collect();
                words
                    .cells
                    .extend(others.cells.into_iter().map(|cell| places[cell]));
            }
            _ => {}
        }
    }

    fn into_python(self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        Ok(match self {
            Self::Whole(cells) => PyArray1::from_vec(py, cells).into_any().unbind(),
            Self::Numbers(cells) => PyArray1::from_vec(py, cells).into_any().unbind(),
            Self::Words(Words {
                different, cells, ..
            }) => {
                let is_truth = |word: &String| word == "true" || word == "false";
                let array = if different.iter().all(is_truth) {
                    let truths = different.iter().map(|word| word == "true").collect();
                    PyArray1::from_vec(py, truths).into_any()
                } else {
                    py.import("numpy")?.call_method1("array", (different,))?
                };
                // Indices of numpy have signs.
                let cells = cells.into_iter().map(|cell| cell as isize);
                let cells = PyArray1::from_iter(py, cells);
                array.call_method1("take", (cells,))?.unbind()
            }
        })
    }
}

/// Adds the cells of a text without a header to columns; the place of the first column that is too narrow for one.
fn fill(text: &str, columns: &mut [Cells]) -> Result<Option<usize>, csv::Error> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(text.as_bytes());
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record)? {
        let mut cells = columns.iter_mut().zip(&record);
        if let Some(narrow) = cells.position(|(column, cell)| column.push(cell).is_none()) {
            return Ok(Some(narrow));
        }
    }
    Ok(None)
}

/// Lines in as many pieces as there are threads; in one if there are quotes, which may hold ends of lines.
fn pieces(text: &str) -> Vec<&str> {
    if text.contains('"') {
        return vec![text];
    }
    let size = text.len() / rayon::current_num_threads() + 1;
    let (mut rest, mut pieces) = (text, Vec::new());
    while let Some(end) = (rest.as_bytes().iter().skip(size)).position(|byte| *byte == b'\n') {
        let (piece, behind) = rest.split_at(size + end + 1);
        pieces.push(piece);
        rest = behind;
    }
    pieces.push(rest);
    pieces
}

/// Names and cells of the columns of a CSV text. Without rows nothing tells kinds, and columns are of numbers.
fn read(text: &str) -> Result<(Vec<String>, Vec<Cells>), csv::Error> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
    let (_, rows) = text.split_once('\n').unwrap_or((text, ""));
    let mut columns: Vec<Cells> = names.iter().map(|_| Cells::Whole(Vec::new())).collect();
    if rows.is_empty() {
        let numbers = columns.iter().map(|column| column.anew(true));
        return Ok((names, numbers.collect()));
    }
    let pieces = pieces(rows);
    // The first row tells nearly all kinds. Where a later one tells another, it begins again.
    loop {
        let filled: Vec<(Vec<Cells>, Option<usize>)> = (pieces.par_iter())
            .map(|piece| {
                let mut own: Vec<Cells> = columns.iter().map(|column| column.anew(false)).collect();
                let narrow = fill(piece, &mut own)?;
                Ok((own, narrow))
            })
            .collect::<Result<_, csv::Error>>()?;
        let narrow = filled.iter().find_map(|(_, narrow)| *narrow);
        if let Some(place) = narrow {
            columns[place] = columns[place].anew(true);
            continue;
        }
        for (own, _) in filled {
            (columns.iter_mut().zip(own)).for_each(|(column, own)| column.append(own));
        }
        return Ok((names, columns));
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
