//! What can be wrong with a file of loads.

use std::path::PathBuf;

/// Everything for which a file of loads is refused, and a load that it does not hold.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadsFileError {
    /// The file cannot be read.
    #[error("cannot read '{}': {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A mistake in a file with a name.
    #[error("'{}': {cause}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// The mistake.
        #[source]
        cause: Box<LoadsFileError>,
    },
    /// A file that is too large.
    #[error("the file is too large: at most {allowed} bytes are allowed")]
    TooLarge {
        /// Largest size, in bytes.
        allowed: u64,
    },
    /// Bytes that are no UTF-8.
    #[error("the file is not text in UTF-8")]
    NotText,
    /// A row with more or fewer fields than the header.
    #[error("line {line}: {fields} fields are not allowed: the header has {allowed}")]
    Fields {
        /// Line of the row, from 1.
        line: u64,
        /// Fields of the row.
        fields: u64,
        /// Columns of the header.
        allowed: u64,
    },
    /// The header lacks a column.
    #[error("the header has no column '{column}': needed are gap, name and value")]
    NoColumn {
        /// The column.
        column: &'static str,
    },
    /// The header has a column more than once.
    #[error("the header has more than one column '{column}'")]
    TwoColumns {
        /// The column.
        column: &'static str,
    },
    /// A number that is not allowed.
    #[error("line {line}: {column} '{value}' is not allowed: give {allowed}")]
    Number {
        /// Line of the row, from 1.
        line: u64,
        /// Its column.
        column: &'static str,
        /// What stands there.
        value: String,
        /// What may stand there.
        allowed: &'static str,
    },
    /// A name that no load has.
    #[error(
        "line {line}: there is no load '{name}': names are X11A, X12A, Y11A, ..., Y12C, and XF1_n, XF2_n, YF1_n, ..., YT2_n, \
         XTC1_n, ..., YTC2_n with n from 1 to {modes}"
    )]
    UnknownName {
        /// Line of the row, from 1.
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
    /// Two rows for one load at one gap.
    #[error("line {line}: {name} at the gap {gap:?} is already in line {earlier}")]
    Twice {
        /// Line of the second row, from 1.
        line: u64,
        /// Line of the first row.
        earlier: u64,
        /// The load.
        name: String,
        /// The gap, in radii.
        gap: f64,
    },
    /// No rows.
    #[error("the file has no rows")]
    Empty,
    /// Fewer gaps than a cubic needs.
    #[error("{gaps} different gaps are too few: at least {needed} are needed")]
    FewGaps {
        /// Number of gaps.
        gaps: usize,
        /// Number of gaps needed.
        needed: usize,
    },
    /// A load that some gaps have and one does not.
    #[error("{name} is missing at the gap {gap:?}, and other gaps have it")]
    Missing {
        /// The load.
        name: String,
        /// The gap, in radii.
        gap: f64,
    },
    /// A load of one sphere without that of the other one.
    #[error("{name} is missing, without which {partner} is of no use")]
    Half {
        /// The load that is missing.
        name: String,
        /// The load that is there.
        partner: String,
    },
    /// Loads too large, or gaps too close, for an interpolation in numbers of double precision.
    #[error(
        "{name} cannot be interpolated: its values are too large, or gaps too close to each other"
    )]
    NotInterpolated {
        /// The load.
        name: String,
    },
    /// A load that the motion needs and the file lacks.
    #[error("the file has no load {name}, which the motion needs")]
    NotHeld {
        /// The load.
        name: String,
    },
}

/// What stands in a file, short enough for a line.
pub(super) fn shown(text: &str) -> String {
    const MOST: usize = 40;
    let mut short: String = text
        .chars()
        .take(MOST)
        .flat_map(char::escape_debug)
        .collect();
    if text.chars().nth(MOST).is_some() {
        short.push_str("...");
    }
    short
}
