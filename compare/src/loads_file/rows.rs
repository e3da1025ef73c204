//! The rows of a file of loads.

use std::collections::{BTreeSet, HashMap};

use csv::{ErrorKind, ReaderBuilder, StringRecord, Trim};
use scene::{Gap, MAX_MODES};

use super::error::{LoadsFileError, shown};
use super::{ALL_PAIRS, FEWEST_GAPS, names};

/// Methods that an error lists.
const LISTED: usize = 8;

/// The name of a load, by its index in [`names`].
pub(super) fn name(index: usize) -> String {
    names().nth(index).unwrap_or_default()
}

/// A load at a gap.
#[derive(Clone, Copy)]
pub(super) struct Stated {
    pub value: f64,
    /// Relative to the larger of the load and 1.
    pub error: Option<f64>,
}

/// A row: where it stands, its gap, and the index of its load in [`names`].
struct Row {
    line: u64,
    gap: Gap,
    load: usize,
    stated: Stated,
}

/// All loads of a file at all its gaps.
pub(super) struct Rows {
    /// Ascending.
    pub gaps: Vec<Gap>,
    /// Which loads there are, each for both spheres: those of the sphere itself are at twice this in [`names`]. Ascending.
    pub loads: Vec<usize>,
    /// Gap by gap, load by load, of the sphere itself and of the other one.
    stated: Vec<Stated>,
}

impl Rows {
    pub fn parse(text: &str) -> Result<Self, LoadsFileError> {
        let mut rows = read(text)?;
        rows.sort_by(|a, b| {
            let gaps = a.gap.eps().total_cmp(&b.gap.eps());
            gaps.then(a.load.cmp(&b.load)).then(a.line.cmp(&b.line))
        });
        if rows.is_empty() {
            return Err(LoadsFileError::Empty);
        }
        let same_gap = |a: &Row, b: &Row| a.gap == b.gap;
        let twice = rows
            .windows(2)
            .find(|two| same_gap(&two[0], &two[1]) && two[0].load == two[1].load);
        if let Some([first, second]) = twice {
            return Err(LoadsFileError::Twice {
                line: second.line,
                earlier: first.line,
                name: name(second.load),
                gap: second.gap.eps(),
            });
        }
        let gaps: Vec<Gap> = rows.chunk_by(same_gap).map(|rows| rows[0].gap).collect();
        if gaps.len() < FEWEST_GAPS {
            return Err(LoadsFileError::FewGaps {
                gaps: gaps.len(),
                needed: FEWEST_GAPS,
            });
        }
        let mut there = [false; 2 * ALL_PAIRS];
        rows.iter().for_each(|row| there[row.load] = true);
        if let Some(load) = (0..there.len()).find(|&load| !there[load] && there[load ^ 1]) {
            return Err(LoadsFileError::Half {
                name: name(load),
                partner: name(load ^ 1),
            });
        }
        let all: Vec<usize> = (0..there.len()).filter(|&load| there[load]).collect();
        for of_gap in rows.chunk_by(same_gap) {
            let missing = (all.iter().enumerate())
                .find(|(place, load)| of_gap.get(*place).is_none_or(|row| row.load != **load));
            if let Some((_, &load)) = missing {
                return Err(LoadsFileError::Missing {
                    name: name(load),
                    gap: of_gap[0].gap.eps(),
                });
            }
        }
        Ok(Self {
            gaps,
            loads: all.iter().step_by(2).map(|load| load / 2).collect(),
            stated: rows.iter().map(|row| row.stated).collect(),
        })
    }

    /// A load at all gaps, by its place in [`Self::loads`]: of the sphere itself and of the other one.
    pub fn of_load(&self, place: usize) -> [Vec<Stated>; 2] {
        let width = 2 * self.loads.len();
        [0, 1].map(|side| {
            let from = self.stated.iter().skip(2 * place + side);
            from.step_by(width).copied().collect()
        })
    }

    /// The error estimates that the file states.
    pub fn stated_errors(&self) -> impl Iterator<Item = f64> {
        self.stated.iter().filter_map(|stated| stated.error)
    }

    /// The CRC-32 of all numbers and of which loads there are, in ascending order of gaps.
    pub fn checksum(&self) -> u32 {
        let mut crc = crc32fast::Hasher::new();
        for &load in &self.loads {
            crc.update(&(load as u64).to_le_bytes());
        }
        let gaps = self.gaps.iter().map(|gap| gap.eps());
        // NaN, which no estimate is, stands for none.
        let stated = (self.stated.iter()).flat_map(|s| [s.value, s.error.unwrap_or(f64::NAN)]);
        for number in gaps.chain(stated) {
            crc.update(&number.to_bits().to_le_bytes());
        }
        crc.finalize()
    }
}

/// All rows, each allowed by itself.
fn read(text: &str) -> Result<Vec<Row>, LoadsFileError> {
    let mut reader = ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let header = reader.headers().map_err(unequal)?.clone();
    let column = |column: &'static str| {
        let mut places = (header.iter().enumerate()).filter(|(_, name)| *name == column);
        match (places.next(), places.next()) {
            (_, Some(_)) => Err(LoadsFileError::TwoColumns { column }),
            (place, None) => Ok(place.map(|(place, _)| place)),
        }
    };
    let needed =
        |name: &'static str| column(name)?.ok_or(LoadsFileError::NoColumn { column: name });
    let [gap_at, name_at, value_at] = [needed("gap")?, needed("name")?, needed("value")?];
    let (error_at, method_at) = (column("error_estimate")?, column("method")?);
    let indices: HashMap<String, usize> = names().zip(0..).collect();
    let mut methods = BTreeSet::new();
    let (mut rows, mut record) = (Vec::new(), StringRecord::new());
    while reader.read_record(&mut record).map_err(unequal)? {
        let line = record.position().map_or(0, csv::Position::line);
        let field = |place: usize| record.get(place).unwrap_or_default();
        let not_allowed = |column, value, allowed| LoadsFileError::Number {
            line,
            column,
            value: shown(value),
            allowed,
        };
        let (gap, name, value) = (field(gap_at), field(name_at), field(value_at));
        rows.push(Row {
            line,
            gap: (gap.parse().ok())
                .and_then(|gap| Gap::new(gap).ok())
                .ok_or_else(|| not_allowed("gap", gap, "a finite number greater than 0"))?,
            load: *indices.get(name).ok_or_else(|| no_load(line, name))?,
            stated: Stated {
                value: (value.parse().ok())
                    .filter(|value: &f64| value.is_finite())
                    .ok_or_else(|| not_allowed("value", value, "a finite number"))?,
                error: match error_at.map_or("", field) {
                    "" | "none" => None,
                    error => Some(
                        (error.parse().ok())
                            .filter(|error: &f64| error.is_finite() && *error >= 0.0)
                            .ok_or_else(|| {
                                let allowed = "none or a finite number, at least 0";
                                not_allowed("error_estimate", error, allowed)
                            })?,
                    ),
                },
            },
        });
        if let Some(place) = method_at
            && methods.len() <= LISTED
            && !methods.contains(field(place))
        {
            methods.insert(field(place).to_owned());
        }
    }
    if methods.len() > 1 {
        let more = methods.len() > LISTED;
        let listed = (methods.iter().take(LISTED)).map(|method| format!("'{}'", shown(method)));
        let listed: Vec<_> = listed.chain(more.then(|| "...".to_owned())).collect();
        return Err(LoadsFileError::SeveralMethods {
            methods: listed.join(", "),
        });
    }
    Ok(rows)
}

/// The error for a name that no load has.
fn no_load(line: u64, name: &str) -> LoadsFileError {
    let name = shown(name);
    if name.contains(" + ") || name.contains(" - ") {
        LoadsFileError::Combination { line, name }
    } else {
        LoadsFileError::UnknownName {
            line,
            name,
            modes: MAX_MODES,
        }
    }
}

/// The error for a row that the CSV reader refuses. Of text it refuses only rows of the wrong length.
fn unequal(error: csv::Error) -> LoadsFileError {
    match error.into_kind() {
        ErrorKind::UnequalLengths {
            pos,
            expected_len,
            len,
        } => LoadsFileError::Fields {
            line: pos.map_or(0, |pos| pos.line()),
            fields: len,
            allowed: expected_len,
        },
        _ => LoadsFileError::NotText,
    }
}
