//! What can be wrong with a submission.

use std::path::PathBuf;

/// Everything for which a submission is refused, and what a model made of it lacks.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SubmissionError {
    /// The file cannot be read.
    #[error("cannot read '{}': {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        reason: String,
    },
    /// A mistake in a file with a name.
    #[error("'{}': {cause}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// The mistake.
        #[source]
        cause: Box<SubmissionError>,
    },
    /// A file that is too large.
    #[error("the file is too large: at most {allowed} bytes are allowed")]
    TooLarge {
        /// Largest size, in bytes.
        allowed: u64,
    },
    /// More gaps than a submission may have.
    #[error("{gaps} different gaps are too many: at most {allowed} are allowed")]
    ManyGaps {
        /// Number of gaps.
        gaps: usize,
        /// Largest number.
        allowed: usize,
    },
    /// Bytes that are no UTF-8.
    #[error("the file is not text in UTF-8")]
    NotText,
    /// A mistake in the header.
    #[error("header: {what}")]
    Header {
        /// The mistake, and what is allowed.
        what: String,
    },
    /// A row with more or fewer fields than the header line of the columns.
    #[error("line {line}: fields: {fields} are not allowed: there are {allowed} columns")]
    Fields {
        /// Line of the row, from 1.
        line: u64,
        /// Fields of the row.
        fields: u64,
        /// Number of columns.
        allowed: u64,
    },
    /// A needed column is missing.
    #[error("there is no column '{column}': needed are {needed}")]
    NoColumn {
        /// The column.
        column: &'static str,
        /// All that are needed.
        needed: &'static str,
    },
    /// A column that does not belong there.
    #[error("column '{column}' is not allowed: columns are {allowed}")]
    OtherColumn {
        /// The column.
        column: String,
        /// All that may be there.
        allowed: &'static str,
    },
    /// A column that is there more than once.
    #[error("there is more than one column '{column}'")]
    TwoColumns {
        /// The column.
        column: String,
    },
    /// A number or a word that is not allowed.
    #[error("line {line}: {column} '{value}' is not allowed: give {allowed}")]
    Field {
        /// Line of the row, from 1.
        line: u64,
        /// Its column.
        column: &'static str,
        /// What stands there.
        value: String,
        /// What may stand there.
        allowed: &'static str,
    },
    /// A name that no quantity has.
    #[error(
        "{}there is no quantity '{name}': names are X11A, X12A, ..., Y12C, XF1_n, ..., YTC2_n, x11a, ..., y12c, UX1_n, ..., OY2_n with n \
         from 1 to {modes}",
        place(*line)
    )]
    UnknownName {
        /// Line of the row, from 1; 0 of an answer.
        line: u64,
        /// The name.
        name: String,
        /// Highest mode.
        modes: usize,
    },
    /// A sum or a difference of two loads.
    #[error(
        "line {line}: '{name}' is a combination of two loads, as symmetric pairs need it: give each of the two loads"
    )]
    Combination {
        /// Line of the row, from 1.
        line: u64,
        /// The combination.
        name: String,
    },
    /// Rows of more than one method.
    #[error("the file has loads of several methods: {methods}; keep the rows of one")]
    SeveralMethods {
        /// The methods.
        methods: String,
    },
    /// Two rows for one number at one gap.
    #[error("line {line}: {name} at the gap {gap:?} is already in line {earlier}")]
    Twice {
        /// Line of the second row, from 1.
        line: u64,
        /// Line of the first row.
        earlier: u64,
        /// The quantity, or the place in the matrix.
        name: String,
        /// The gap, in radii.
        gap: f64,
    },
    /// A gap that is there twice, each time with all that there is at it.
    #[error("the gap {gap:?} is there twice")]
    GapTwice {
        /// The gap, in the unit of the header's radius.
        gap: f64,
    },
    /// What is wrong at a gap.
    #[error("at the gap {gap:?}: {what}")]
    At {
        /// The gap, in radii.
        gap: f64,
        /// The mistake.
        what: String,
    },
    /// No rows.
    #[error("the file has no rows")]
    Empty,
    /// A matrix, or a column of it, that is not complete.
    #[error(
        "row {row} of column {column} is missing at the gap {gap:?}: give all entries, zeros too"
    )]
    Incomplete {
        /// Row from 1 to 12.
        row: usize,
        /// Column: 1 to 12 or a slip column.
        column: String,
        /// The gap, in radii.
        gap: f64,
    },
    /// A matrix that is not one of spheres of the header's radius in a fluid of its viscosity.
    #[error(
        "the matrix at the gap {gap:?} is not one of spheres with the radius and the viscosity of the header: entry ({row}, {column}) is \
         {times:?} times that of a lone sphere"
    )]
    Units {
        /// The gap, in radii.
        gap: f64,
        /// Row from 1 to 12.
        row: usize,
        /// Column from 1 to 12.
        column: usize,
        /// Its size, in the unit that makes the diagonal of a lone sphere 1.
        times: f64,
    },
    /// A value that is no finite number once the units or the calibration of its mode are applied.
    #[error(
        "{name} at the gap {gap:?} is no finite number with the units and the calibration of the header"
    )]
    Overflow {
        /// The quantity.
        name: &'static str,
        /// The gap, in radii.
        gap: f64,
    },
    /// Fewer gaps than the interpolation needs.
    #[error("too few gaps ({gaps}): at least {needed} are needed to move a pair")]
    FewGaps {
        /// Number of gaps.
        gaps: usize,
        /// Number of gaps needed.
        needed: usize,
    },
    /// A submission without interpolation, which cannot move a pair.
    #[error(
        "the header declares that there is no interpolation: such a submission is judged at its gaps, and moves no pair"
    )]
    NoInterpolation,
    /// A quantity that some gaps have and one does not.
    #[error("{name} is missing at the gap {gap:?}, and other gaps have it")]
    Missing {
        /// The quantity.
        name: String,
        /// The gap, in radii.
        gap: f64,
    },
    /// Loads too large, or gaps too close, for an interpolation in numbers of double precision.
    #[error(
        "{name} cannot be interpolated: its values are too large, or gaps too close to each other"
    )]
    NotInterpolated {
        /// The quantity.
        name: String,
    },
    /// A quantity that the motion needs and the submission lacks.
    #[error("the file has no {name}, which the motion needs")]
    NotHeld {
        /// The quantity.
        name: String,
    },
    /// A gap that is too small or too large.
    #[error("gap {gap:?} (radii) is not allowed: give gaps from {smallest:e} to {largest:e}")]
    Gap {
        /// The gap, in radii.
        gap: f64,
        /// Smallest allowed.
        smallest: f64,
        /// Largest allowed.
        largest: f64,
    },
    /// A gap at which a model that is asked says that it has no answer.
    #[error("{who}: it has no answer at the gap {gap:?}: {reason}")]
    NoAnswer {
        /// Who was asked, such as a process with its command.
        who: String,
        /// The gap, in the unit of its radius.
        gap: f64,
        /// What it says.
        reason: String,
    },
    /// What a model that is asked did instead of answering.
    #[error("{who}: {what}")]
    Asked {
        /// Who was asked.
        who: String,
        /// What happened.
        what: String,
    },
    /// An error of its own that ended the answer.
    #[error("{who}: {source}")]
    Raised {
        /// Who was asked.
        who: String,
        /// The error, which is kept whole.
        source: scene::ModelFailure,
    },
}

/// Whether an error is one that somebody who is asked raised himself: it is to come out as it is.
pub(crate) fn is_raised(error: &(dyn std::error::Error + 'static)) -> bool {
    let causes = std::iter::successors(Some(error), |error| error.source());
    let mut causes = causes.filter_map(|error| error.downcast_ref());
    causes.any(|error| matches!(error, SubmissionError::Raised { .. }))
}

fn place(line: u64) -> String {
    match line {
        0 => String::new(),
        line => format!("line {line}: "),
    }
}

/// What stands in a file, in printable letters and short enough for a line: at most `most` bytes, and three dots for the rest.
pub(crate) fn shown(text: &str, most: usize) -> String {
    let mut short = String::new();
    for letter in text.chars() {
        let before = short.len();
        match letter {
            '\'' | '"' => short.push(letter),
            _ => short.extend(letter.escape_debug()),
        }
        if short.len() > most {
            short.truncate(before);
            short.push_str("...");
            break;
        }
    }
    short
}
