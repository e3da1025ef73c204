//! The rows of a submission: named values, or entries of matrices.

use std::collections::BTreeSet;

use csv::{ErrorKind, ReaderBuilder, StringRecord, Trim};
use scene::{Gap, MAX_MODES};

use super::error::{SubmissionError, shown};
use super::matrix::Place;
use super::quantity::Quantity;

/// Methods that an error lists.
const LISTED: usize = 8;

/// Bytes of a field that an error shows.
const SHOWN: usize = 40;

/// The same of one of several methods.
const SHOWN_OF_SEVERAL: usize = 20;

/// A value: where it stands, its gap in the file's unit of length, and what it is.
pub(super) struct Row<T> {
    pub line: u64,
    pub gap: f64,
    pub what: T,
    pub value: f64,
    /// Relative to the larger of the value and 1.
    pub error: Option<f64>,
}

/// All rows of a file.
pub(super) enum Rows {
    Named(Vec<Row<Quantity>>),
    Matrices(Vec<Row<Place>>),
}

const NAMED: &str = "gap, name and value, and perhaps error_estimate, method and ratio";
const MATRICES: &str = "gap, row, col and value";

/// The columns of a file, by their places.
struct Columns {
    header: StringRecord,
}

impl Columns {
    fn place(&self, column: &'static str) -> Option<usize> {
        self.header.iter().position(|name| name == column)
    }

    fn needed(&self, column: &'static str, needed: &'static str) -> Result<usize, SubmissionError> {
        self.place(column)
            .ok_or(SubmissionError::NoColumn { column, needed })
    }

    /// Refuses columns that are not among these, and any that is there twice.
    fn only(&self, known: &[&str], allowed: &'static str) -> Result<(), SubmissionError> {
        for (place, name) in self.header.iter().enumerate() {
            let column = || shown(name, SHOWN);
            if !known.contains(&name) {
                return Err(SubmissionError::OtherColumn {
                    column: column(),
                    allowed,
                });
            }
            if self
                .header
                .iter()
                .take(place)
                .any(|earlier| earlier == name)
            {
                return Err(SubmissionError::TwoColumns { column: column() });
            }
        }
        Ok(())
    }
}

/// A record, and where it stands.
struct Record<'a> {
    line: u64,
    record: &'a StringRecord,
}

impl Record<'_> {
    fn field(&self, place: usize) -> &str {
        self.record.get(place).unwrap_or_default()
    }

    fn refused(
        &self,
        column: &'static str,
        place: usize,
        allowed: &'static str,
    ) -> SubmissionError {
        SubmissionError::Field {
            line: self.line,
            column,
            value: shown(self.field(place), SHOWN),
            allowed,
        }
    }

    fn number(
        &self,
        column: &'static str,
        place: usize,
        (allowed, is_allowed): (&'static str, fn(f64) -> bool),
    ) -> Result<f64, SubmissionError> {
        let number = self
            .field(place)
            .parse()
            .ok()
            .filter(|&number| is_allowed(number));
        number.ok_or_else(|| self.refused(column, place, allowed))
    }

    fn gap(&self, place: usize) -> Result<f64, SubmissionError> {
        let allowed = (
            "a finite number greater than 0",
            (|gap| Gap::new(gap).is_ok()) as fn(f64) -> bool,
        );
        self.number("gap", place, allowed)
    }

    fn value(&self, place: usize) -> Result<f64, SubmissionError> {
        self.number("value", place, ("a finite number", f64::is_finite))
    }
}

/// All rows, each allowed by itself.
pub(super) fn read(text: &str) -> Result<Rows, SubmissionError> {
    let mut reader = ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let columns = Columns {
        header: reader.headers().map_err(refused)?.clone(),
    };
    if columns.place("row").is_some() || columns.place("col").is_some() {
        let needed = |column| columns.needed(column, MATRICES);
        let [gap, row, col, value] = [
            needed("gap")?,
            needed("row")?,
            needed("col")?,
            needed("value")?,
        ];
        columns.only(&["gap", "row", "col", "value"], MATRICES)?;
        let mut rows = Vec::new();
        each(&mut reader, |record| {
            let place = Place::parse(record.field(row), record.field(col));
            rows.push(Row {
                line: record.line,
                gap: record.gap(gap)?,
                what: match place {
                    Ok(place) => place,
                    Err("row") => return Err(record.refused("row", row, Place::ROWS)),
                    Err(_) => return Err(record.refused("col", col, Place::COLUMNS)),
                },
                value: record.value(value)?,
                error: None,
            });
            Ok(())
        })?;
        return Ok(Rows::Matrices(rows));
    }
    named(&mut reader, &columns).map(Rows::Named)
}

fn named(
    reader: &mut csv::Reader<&[u8]>,
    columns: &Columns,
) -> Result<Vec<Row<Quantity>>, SubmissionError> {
    let needed = |column| columns.needed(column, NAMED);
    let [gap, name, value] = [needed("gap")?, needed("name")?, needed("value")?];
    let [error, method, ratio] =
        ["error_estimate", "method", "ratio"].map(|column| columns.place(column));
    columns.only(
        &["gap", "name", "value", "error_estimate", "method", "ratio"],
        NAMED,
    )?;
    let (mut rows, mut methods) = (Vec::new(), BTreeSet::new());
    each(reader, |record| {
        let row = Row {
            line: record.line,
            gap: record.gap(gap)?,
            what: Quantity::named(record.field(name))
                .ok_or_else(|| no_quantity(record.line, record.field(name)))?,
            value: record.value(value)?,
            error: match error.map(|place| (place, record.field(place))) {
                None | Some((_, "" | "none")) => None,
                Some((place, _)) => {
                    let allowed = "none or a finite number, at least 0";
                    let is_allowed: fn(f64) -> bool = |error| error.is_finite() && error >= 0.0;
                    Some(record.number("error_estimate", place, (allowed, is_allowed))?)
                }
            },
        };
        if let Some(place) = ratio {
            #[expect(clippy::float_cmp, reason = "equal radii, exactly")]
            let allowed = (
                "1: submissions are of spheres of equal radii",
                (|ratio| ratio == 1.0) as fn(f64) -> bool,
            );
            record.number("ratio", place, allowed)?;
        }
        rows.push(row);
        if let Some(place) = method
            && methods.len() <= LISTED
            && !methods.contains(record.field(place))
        {
            methods.insert(record.field(place).to_owned());
        }
        Ok(())
    })?;
    if methods.len() > 1 {
        let more = methods.len() > LISTED;
        let listed = (methods.iter().take(LISTED))
            .map(|method| format!("'{}'", shown(method, SHOWN_OF_SEVERAL)));
        let listed: Vec<_> = listed.chain(more.then(|| "...".to_owned())).collect();
        return Err(SubmissionError::SeveralMethods {
            methods: listed.join(", "),
        });
    }
    Ok(rows)
}

fn each(
    reader: &mut csv::Reader<&[u8]>,
    mut take: impl FnMut(&Record<'_>) -> Result<(), SubmissionError>,
) -> Result<(), SubmissionError> {
    let mut record = StringRecord::new();
    while reader.read_record(&mut record).map_err(refused)? {
        let line = record.position().map_or(0, csv::Position::line);
        take(&Record {
            line,
            record: &record,
        })?;
    }
    Ok(())
}

/// The error for a name that no quantity has.
pub(super) fn no_quantity(line: u64, name: &str) -> SubmissionError {
    let name = shown(name, SHOWN);
    if name.contains(" + ") || name.contains(" - ") {
        SubmissionError::Combination { line, name }
    } else {
        SubmissionError::UnknownName {
            line,
            name,
            modes: MAX_MODES,
        }
    }
}

/// The error for a row that the CSV reader refuses. Of text it refuses only rows of the wrong length.
fn refused(error: csv::Error) -> SubmissionError {
    match error.into_kind() {
        ErrorKind::UnequalLengths {
            pos,
            expected_len,
            len,
        } => SubmissionError::Fields {
            line: pos.map_or(0, |pos| pos.line()),
            fields: len,
            allowed: expected_len,
        },
        _ => SubmissionError::NotText,
    }
}
