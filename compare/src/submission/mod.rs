//! What anybody's model answers for a pair of equal spheres: a file of named values or of matrices, or a process or a function that is asked.
//!
//! `docs/JUDGE.md` has the format. A [`Submission`] is what a file says at its gaps, a [`SubmittedModel`] the same as a hydrodynamic model that moves pairs.

mod asked;
mod convert;
mod cubic;
mod error;
mod header;
mod matrix;
mod model;
mod process;
mod quantity;
mod rows;
mod schema;
mod still;

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use scene::{Gap, Hydrodynamics};

use crate::{CompareError, Method};

pub use asked::{Asked, Heard, PairAnswer, Silence, Source};
pub(crate) use convert::derived;
pub use error::SubmissionError;
pub(crate) use error::{is_raised, shown};
pub use header::{Header, Interpolation, MatrixKind};
pub use matrix::MatrixLaws;
pub use model::SubmittedModel;
pub use process::{HeaderAnswer, Process, Question, end_processes};
pub use quantity::{KINDS, Quantity, Values};
pub use schema::schema;

use matrix::{Column, Matrix, Place, SIZE};
use rows::{Row, Rows};

/// Largest size of a file, in bytes.
const LARGEST_FILE: u64 = 32 << 20;

/// Time that an answer of a process may take.
pub const ANSWER_LIMIT: Duration = Duration::from_secs(60);

/// Gaps that are judged, in radii.
pub const GAP_RANGE: [f64; 2] = [1e-12, 1e9];

/// Most gaps of a submission.
const MOST_GAPS: usize = 5000;

/// What a model says at one gap.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Gap, in radii.
    pub gap: Gap,
    /// The quantities, in units of radius and viscosity, slip per `B_n`, without calibration.
    pub values: Values,
    /// Their stated errors, relative to the larger of the value and 1.
    pub errors: Values,
    /// Laws that a matrix breaks by itself; none of named values.
    pub laws: Option<MatrixLaws>,
}

/// Anybody's answers at some gaps, by rising gap.
///
/// ```
/// use compare::submission::{Quantity, Submission};
/// let text = "#! model = \"far field\"
/// gap,name,value
/// 38,x12a,0.0375
/// 38,UX2_2,-6.25e-4
/// ";
/// let submission = Submission::parse(text)?;
/// let [answer] = submission.answers() else { unreachable!() };
/// let drift = Quantity::named("UX2_2").and_then(|quantity| answer.values.get(quantity));
/// assert_eq!(drift, Some(-6.25e-4));
/// # Ok::<(), compare::submission::SubmissionError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Submission {
    header: Header,
    answers: Vec<Answer>,
}

impl Submission {
    /// From the text of a file.
    ///
    /// # Errors
    /// [`SubmissionError`]: the first mistake.
    pub fn parse(text: &str) -> Result<Self, SubmissionError> {
        if text.len() as u64 > LARGEST_FILE {
            return Err(SubmissionError::TooLarge {
                allowed: LARGEST_FILE,
            });
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let header = (text.lines()).filter_map(|line| line.strip_prefix("#!"));
        let header = Header::parse(&header.collect::<Vec<_>>().join("\n"))?;
        let answers = match rows::read(text)? {
            Rows::Named(rows) => {
                if header.matrix.is_some() {
                    return Err(SubmissionError::Header {
                        what: "matrix is declared, and the file has named values: leave it out"
                            .to_owned(),
                    });
                }
                of_named(rows, &header)?
            }
            Rows::Matrices(rows) => of_matrices(rows, &header)?,
        };
        if header.range.is_some() || header.noise.is_some() {
            return Err(SubmissionError::Header {
                what: "range and noise belong to processes: a file has those of its rows"
                    .to_owned(),
            });
        }
        Ok(Self { header, answers })
    }

    /// From a file.
    ///
    /// # Errors
    /// [`SubmissionError::Read`] if it cannot be read, [`SubmissionError::InFile`] with the first mistake in it.
    pub fn read(path: &Path) -> Result<Self, SubmissionError> {
        let in_file = |cause| SubmissionError::InFile {
            path: path.to_owned(),
            cause: Box::new(cause),
        };
        let mut bytes = Vec::new();
        // Not by its size: devices and pipes have none.
        File::open(path)
            .and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes))
            .map_err(|source| SubmissionError::Read {
                path: path.to_owned(),
                reason: source.to_string(),
            })?;
        let text = String::from_utf8(bytes).map_err(|_| in_file(SubmissionError::NotText))?;
        Self::parse(&text).map_err(in_file)
    }

    /// From what is said at some gaps in the unit of the header's radius, in any order. NaN stands for a named value that is not there.
    ///
    /// # Errors
    /// [`SubmissionError`]: the first mistake.
    pub fn of_pairs(header: Header, mut pairs: Vec<PairAnswer>) -> Result<Self, SubmissionError> {
        let header = header.check()?;
        if pairs.is_empty() {
            return Err(SubmissionError::Empty);
        }
        if pairs.len() > MOST_GAPS {
            return Err(SubmissionError::ManyGaps {
                gaps: pairs.len(),
                allowed: MOST_GAPS,
            });
        }
        pairs.sort_by(|a, b| a.gap.total_cmp(&b.gap));
        let twice = (pairs.windows(2)).find(|two| two[0].gap.total_cmp(&two[1].gap).is_eq());
        if let Some([first, _]) = twice {
            return Err(SubmissionError::GapTwice { gap: first.gap });
        }
        let answer = |mut pair: PairAnswer| {
            let gap = allowed_gap(pair.gap / header.radius)?;
            pair.values.retain(|_, value| !value.is_nan());
            asked::tabled(&header, gap, pair).map_err(|what| SubmissionError::At {
                gap: gap.eps(),
                what,
            })
        };
        let answers = pairs
            .into_iter()
            .map(answer)
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Self { header, answers })
    }

    /// From answers, by rising gap.
    #[must_use]
    pub fn of_answers(header: Header, answers: Vec<Answer>) -> Self {
        Self { header, answers }
    }

    /// What it says of itself.
    #[must_use]
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The answers, by rising gap.
    #[must_use]
    pub fn answers(&self) -> &[Answer] {
        &self.answers
    }

    /// The CRC-32 of all numbers that the motion may read and of which quantities there are.
    #[must_use]
    pub fn checksum(&self) -> u32 {
        let mut crc = crc32fast::Hasher::new();
        for Answer {
            gap,
            values,
            errors,
            ..
        } in &self.answers
        {
            crc.update(&gap.eps().to_bits().to_le_bytes());
            for (quantity, value) in values.iter() {
                crc.update(quantity.name().as_bytes());
                // NaN, which no estimate is, stands for none.
                let error = errors.get(quantity).unwrap_or(f64::NAN);
                let calibration = calibration(&self.header, quantity);
                for number in [value * calibration, error] {
                    crc.update(&number.to_bits().to_le_bytes());
                }
            }
        }
        crc.finalize()
    }
}

/// Where answers come from.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there are a handful of them")]
pub enum Submitted {
    /// A file.
    File(Submission),
    /// A process or a function that is asked.
    Asked(Arc<Asked>),
}

impl Submitted {
    /// Makes it a method under a name of its own, as [`Method::register`] does.
    ///
    /// # Errors
    /// [`CompareError::Input`] for a name that is not allowed or taken, and for a submission that cannot move a pair.
    pub fn register(&self, name: &str) -> Result<Method, CompareError> {
        let refused =
            |error: SubmissionError| CompareError::input("--method", name, error.to_string());
        let (model, is_dear) = self.model().map_err(refused)?;
        Method::registered(name, model, is_dear)
    }

    /// The same, in place of an earlier model from outside of this name, as [`Method::replace`] does. A submission that cannot move a pair is a method
    /// that says so when it is to.
    ///
    /// # Errors
    /// [`CompareError::Input`] for a name that is not allowed.
    pub fn replace(&self, name: &str) -> Result<Method, CompareError> {
        let (model, is_dear): (Arc<dyn Hydrodynamics>, bool) = match self.model() {
            Ok(model) => model,
            Err(error) => (Arc::new(still::Still(error)), false),
        };
        Method::replace(name, model, is_dear)
    }

    /// From the name of a file, or from `exec:` and a command, whose answers may take as long as `limit` each.
    ///
    /// # Errors
    /// As [`Submission::read`] and [`Process::start`].
    pub fn open(source: &str, limit: Duration) -> Result<Self, SubmissionError> {
        Ok(match source.strip_prefix("exec:") {
            Some(command) => Self::Asked(Arc::new(Process::start(command, limit)?)),
            None => Self::File(Submission::read(Path::new(source))?),
        })
    }

    /// What it says of itself.
    #[must_use]
    pub fn header(&self) -> &Header {
        match self {
            Self::File(submission) => submission.header(),
            Self::Asked(asked) => asked.header(),
        }
    }

    /// The hydrodynamic model, and whether it takes so long for each gap that it is to be tabulated.
    ///
    /// # Errors
    /// As [`SubmittedModel::new`].
    pub fn model(&self) -> Result<(Arc<dyn Hydrodynamics>, bool), SubmissionError> {
        Ok(match self {
            Self::File(submission) => (Arc::new(SubmittedModel::new(submission)?), false),
            Self::Asked(asked) => (asked.clone(), true),
        })
    }
}

/// The calibration of a quantity: of its mode if it is by slip.
fn calibration(header: &Header, quantity: Quantity) -> f64 {
    quantity.mode().map_or(1.0, |mode| header.calibration(mode))
}

impl Values {
    /// With the declared calibration of slip.
    #[must_use]
    pub fn calibrated(&self, header: &Header) -> Self {
        let mut calibrated = self.clone();
        for (quantity, value) in self.iter() {
            calibrated.set(quantity, value * calibration(header, quantity));
        }
        calibrated
    }

    /// Per `B_n`.
    ///
    /// # Errors
    /// [`SubmissionError::Overflow`] if a value is no finite number then, or calibrated.
    fn per_mode(mut self, gap: Gap, header: &Header) -> Result<Self, SubmissionError> {
        let all: Vec<_> = self.iter().collect();
        for (quantity, value) in all {
            if let Some(mode) = quantity.mode() {
                self.set(quantity, value / header.mode_unit(mode));
            }
        }
        match self
            .overflow()
            .or_else(|| self.calibrated(header).overflow())
        {
            Some(quantity) => Err(SubmissionError::Overflow {
                name: quantity.name(),
                gap: gap.eps(),
            }),
            None => Ok(self),
        }
    }
}

/// The rows at one gap.
type Group<T> = (Gap, Vec<Row<T>>);

/// The groups of rows at one gap, by rising gap, each sorted by what its rows are. Refuses two rows for one number.
fn by_gap<T: Ord + Copy>(
    mut rows: Vec<Row<T>>,
    header: &Header,
    name: impl Fn(T) -> String,
) -> Result<Vec<Group<T>>, SubmissionError> {
    rows.sort_by(|a, b| {
        let gaps = a.gap.total_cmp(&b.gap);
        gaps.then(a.what.cmp(&b.what)).then(a.line.cmp(&b.line))
    });
    let same_gap = |a: &Row<T>, b: &Row<T>| a.gap.total_cmp(&b.gap).is_eq();
    let twice = rows
        .windows(2)
        .find(|two| same_gap(&two[0], &two[1]) && two[0].what == two[1].what);
    if let Some([first, second]) = twice {
        return Err(SubmissionError::Twice {
            line: second.line,
            earlier: first.line,
            name: name(second.what),
            gap: second.gap,
        });
    }
    let gaps = rows.chunk_by(same_gap).count();
    if gaps > MOST_GAPS {
        return Err(SubmissionError::ManyGaps {
            gaps,
            allowed: MOST_GAPS,
        });
    }
    let mut groups: Vec<Group<T>> = Vec::with_capacity(gaps);
    let mut last = f64::NAN;
    for row in rows {
        if row.gap.total_cmp(&last).is_ne() {
            last = row.gap;
            let gap = allowed_gap(row.gap / header.radius)?;
            groups.push((gap, Vec::new()));
        }
        if let Some((_, group)) = groups.last_mut() {
            group.push(row);
        }
    }
    if groups.is_empty() {
        return Err(SubmissionError::Empty);
    }
    Ok(groups)
}

/// A gap within [`GAP_RANGE`].
fn allowed_gap(gap: f64) -> Result<Gap, SubmissionError> {
    let [smallest, largest] = GAP_RANGE;
    let refused = SubmissionError::Gap {
        gap,
        smallest,
        largest,
    };
    let allowed = Gap::new(gap)
        .ok()
        .filter(|_| gap >= smallest && gap <= largest);
    allowed.ok_or(refused)
}

fn of_named(rows: Vec<Row<Quantity>>, header: &Header) -> Result<Vec<Answer>, SubmissionError> {
    let groups = by_gap(rows, header, |quantity| quantity.name().to_owned())?;
    let answer = |(gap, rows): (Gap, Vec<Row<Quantity>>)| {
        let (mut values, mut errors) = (Values::default(), Values::default());
        for row in rows {
            values.set(row.what, row.value);
            if let Some(error) = row.error {
                errors.set(row.what, error);
            }
        }
        Ok(Answer {
            gap,
            values: values.per_mode(gap, header)?,
            errors,
            laws: None,
        })
    };
    groups.into_iter().map(answer).collect()
}

fn of_matrices(rows: Vec<Row<Place>>, header: &Header) -> Result<Vec<Answer>, SubmissionError> {
    let Some(kind) = header.matrix else {
        return Err(SubmissionError::Header {
            what: "matrix is missing: say in a line '#! matrix = \"mobility\"' or '#! matrix = \"resistance\"' what the matrices are"
                .to_owned(),
        });
    };
    let name = |place: Place| format!("row {} of column {}", place.row + 1, place.column);
    let groups = by_gap(rows, header, name)?;
    let answer =
        |(gap, rows): (Gap, Vec<Row<Place>>)| assembled(gap, &rows)?.answer(gap, header, kind);
    groups.into_iter().map(answer).collect()
}

/// A complete matrix from its entries, sorted column by column.
fn assembled(gap: Gap, rows: &[Row<Place>]) -> Result<Matrix, SubmissionError> {
    let mut matrix = Matrix {
        rigid: Default::default(),
        slip: Default::default(),
    };
    let same_column = |a: &Row<Place>, b: &Row<Place>| a.what.column == b.what.column;
    let incomplete = |row: usize, column: Column| SubmissionError::Incomplete {
        row: row + 1,
        column: column.to_string(),
        gap: gap.eps(),
    };
    let mut columns = 0;
    for of_column in rows.chunk_by(same_column) {
        let column = of_column[0].what.column;
        let is_there = |row: usize| {
            of_column
                .get(row)
                .is_some_and(|entry| entry.what.row == row)
        };
        if let Some(row) = (0..SIZE).find(|&row| !is_there(row)) {
            return Err(incomplete(row, column));
        }
        match column {
            Column::Rigid(number) if number == columns => {
                columns += 1;
                for (row, entry) in of_column.iter().enumerate() {
                    matrix.rigid[(row, number)] = entry.value;
                }
            }
            Column::Rigid(_) => break,
            Column::Slip(slip) => {
                matrix
                    .slip
                    .insert(slip, std::array::from_fn(|row| of_column[row].value));
            }
        }
    }
    if columns < SIZE {
        return Err(incomplete(0, Column::Rigid(columns)));
    }
    Ok(matrix)
}

impl Matrix {
    fn answer(
        &self,
        gap: Gap,
        header: &Header,
        kind: MatrixKind,
    ) -> Result<Answer, SubmissionError> {
        let (values, laws) = self.read(gap, header, kind)?;
        Ok(Answer {
            gap,
            values: values.per_mode(gap, header)?,
            errors: Values::default(),
            laws: Some(laws),
        })
    }
}

#[cfg(test)]
mod page_tests;
#[cfg(test)]
mod tests;
