//! How sensitive a collision is: the derivative of the headings that go out by everything that a scene is made of, and how far a squirmer can be offset
//! out of the plane before they turn by some degrees.

mod case;
mod derivatives;
mod offsets;

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use scene::{RunOptions, are_unlike};
use serde::{Deserialize, Serialize};

use self::case::Unit;
use self::derivatives::beside;
use crate::columns::{self, Columns as _, columns};
use crate::model_options::Reads;
use crate::numbers::Numbers;
use crate::output::{OutputFolder, csv_lines};
use crate::sweep::{self, Computed, Done, Points, Row, RunChoices, Sweep};
use crate::{Approach, CompareError, Defaults, Family, Method, Model, NoRun};

/// Name of the file of the rows, without its ending.
const NAME: &str = "sensitivity";

/// Name of the file of all derivatives.
pub const DERIVATIVES: &str = "sensitivity-derivatives.csv";

/// Tolerance of the integrator that a study asks for at least.
pub const TOLERANCE: f64 = 1e-10;

columns! {
    /// A row for each case and method: what an offset `dz` out of the plane does. Squirmer 1 starts raised by `dz/2` along z and squirmer 2 lowered by `dz/2`.
    /// The first columns are the name of the family and the parameters that are varied. Headings are those at infinite distance if the pair
    /// parts, and those at the end of the run if it stays bound. A run without a result has NaN.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct SensitivityRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Smallest gap during the run.
        #[unit = "a"]
        pub min_gap: f64,
        /// Interaction time: the time that the pair spends at gaps up to one radius, of the smaller squirmer.
        #[unit = "a/V_s"]
        pub tau: f64,
        /// Outcome of the run.
        #[unit = "-"]
        pub outcome: String,
        /// Condition number: the largest turn of the outgoing headings, in radians, per unit change of the start, in radii of the relative position and radians
        /// of the headings (the largest singular value of the derivative).
        #[unit = "-"]
        pub condition: f64,
        /// Derivative by `dz` of the angle by which the outgoing heading of squirmer 1 rises out of the x-y plane, per radius.
        #[unit = "deg"]
        pub tilt1_per_a: f64,
        /// The same of squirmer 2.
        #[unit = "deg"]
        pub tilt2_per_a: f64,
        /// Turn of the outgoing heading of squirmer 1 in the x-y plane over the square of `dz`, as `dz` goes to zero: in the plane an offset out of it acts at second
        /// order. Per square radius.
        #[unit = "deg"]
        pub turn1_per_a2: f64,
        /// The same of squirmer 2.
        #[unit = "deg"]
        pub turn2_per_a2: f64,
        /// Offset at which an outgoing heading turns in space by 1 degree, by the derivative.
        #[unit = "a"]
        pub linear_1deg: f64,
        /// The same by the motion itself: the smallest offset found at which one of the headings turns so far; infinite if none up to ten radii does.
        #[unit = "a"]
        pub offset_1deg: f64,
        /// Offset at which an outgoing heading turns in space by 6 degrees, by the derivative.
        #[unit = "a"]
        pub linear_6deg: f64,
        /// The same by the motion itself.
        #[unit = "a"]
        pub offset_6deg: f64,
        /// Offset at which an outgoing heading turns in space by 15 degrees, by the derivative.
        #[unit = "a"]
        pub linear_15deg: f64,
        /// The same by the motion itself.
        #[unit = "a"]
        pub offset_15deg: f64,
        /// By how much the derivatives still changed when the distance at which they are read was doubled for the last time, relative to the larger of them and 1.
        #[unit = "-"]
        pub truncation: f64,
    }
}

columns! {
    /// A row for each derivative: of an angle of an outgoing heading by a number of the start or of the scene. The first columns are the name of the family
    /// and the parameters that are varied.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct DerivativeRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// What changes: `start ...` is a coordinate of squirmer 2 from squirmer 1 or the angle of a heading at the start, in the x-y plane or out of it; `offset dz` the offset of both;
        /// `beta1`, `kappa1` and so on a number of the scene; `family ...` a parameter of the family.
        #[unit = "-"]
        pub by: String,
        /// What answers: `angle1` and `angle2` are the angles of the outgoing headings in the x-y plane, anticlockwise, and `tilt1` and `tilt2` those out of it.
        #[unit = "-"]
        pub of: String,
        /// The derivative. NaN if there is no outgoing heading, if it stands on the plane, or if the scene has a kink where it is.
        #[unit = "varies"]
        pub value: f64,
        /// Its unit.
        #[unit = "-"]
        pub unit: String,
    }
}

/// The cases of one family.
pub struct Part {
    /// Name of the family.
    pub case: String,
    /// Its points.
    pub points: Points,
}

impl Part {
    /// The encounters of the paper's Figs 6 and 7, in the plane.
    ///
    /// # Errors
    /// As [`Defaults::paper`].
    pub fn paper(run: RunChoices) -> Result<Vec<Self>, CompareError> {
        let defaults = Defaults::paper()?;
        let of = |approach: Approach| {
            let encounters = defaults.encounters(approach);
            let vary = [("beta", &encounters.beta), ("dx", &encounters.dx)];
            let vary = vary.map(|(name, values)| (name.to_owned(), Numbers(values.clone())));
            let name = approach.family();
            let family = Family::named(name).cloned();
            let family =
                family.ok_or_else(|| CompareError::input("family", name, "no such family"))?;
            Ok(Self {
                case: name.to_owned(),
                points: Points::new(family, &vary, run)?,
            })
        };
        [Approach::HeadOn, Approach::Orthogonal]
            .map(of)
            .into_iter()
            .collect()
    }
}

/// What the motion of all cases and its linearisation reads of a model; where radii are unlike, of the ratios beside each too.
///
/// # Errors
/// As [`Points::reads`].
pub fn reads(parts: &[Part]) -> Result<Reads, CompareError> {
    let mut all = Reads::default();
    for part in parts {
        let Reads { loads, ratios } = part.points.reads()?;
        all.loads = match (all.loads, loads) {
            (Some(all), Some(loads)) => Some(all.union(loads)),
            (all, loads) => all.or(loads),
        };
        ratios.into_iter().for_each(|ratio| all.add_ratio(ratio));
    }
    let unlike = all
        .ratios
        .clone()
        .into_iter()
        .filter(|ratio| are_unlike(*ratio));
    for ratio in unlike.filter_map(beside).flatten() {
        all.add_ratio(ratio);
    }
    Ok(all.in_space())
}

/// A study of the cases of some families, whose varied parameters have the same names.
pub struct SensitivityStudy<'a> {
    /// The families.
    pub parts: &'a [Part],
    /// The models.
    pub models: &'a [Model],
    /// Time after which no further case begins.
    pub time_limit: Option<Duration>,
    /// The folder for the rows.
    pub out: &'a OutputFolder,
}

/// A row of `sensitivity.csv`: the case, its parameters and the numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct SensitivityCase {
    /// Name of the family.
    pub case: String,
    /// Values of the parameters that are varied.
    pub values: Vec<f64>,
    /// The numbers.
    pub row: SensitivityRow,
}

/// The same as it is read back.
#[derive(Deserialize)]
struct Line(Vec<String>);

impl Row for Line {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        let from_end = SensitivityRow::COLUMNS.len() - 3;
        let at = self.0.len().checked_sub(from_end);
        std::iter::once(at.and_then(|at| self.0.get(at)).map_or("", String::as_str))
    }
}

impl SensitivityStudy<'_> {
    /// The names of the columns of the parameters, the case first.
    fn parameters(&self) -> Vec<&str> {
        let axes = self.parts.first().map(|part| part.points.axes());
        let names = axes.into_iter().flatten().map(|axis| axis.name.as_str());
        std::iter::once("case").chain(names).collect()
    }

    fn unit(&self, number: usize) -> Option<Unit<'_>> {
        let all: usize = self.parts.iter().map(|part| part.points.count()).sum();
        let (model, mut point) = (self.models.get(number / all)?, number % all);
        for part in self.parts {
            if point < part.points.count() {
                let values = part.points.values(point);
                return Some(Unit {
                    model,
                    part,
                    values,
                });
            }
            point -= part.points.count();
        }
        None
    }

    /// Everything that the rows depend on, in one line.
    fn key(&self) -> String {
        let mut checksum = crc32fast::Hasher::new();
        for part in self.parts {
            checksum.update(part.points.family().text().as_bytes());
            checksum
                .update(format!("{:?} {:?}", part.points.axes(), part.points.choices()).as_bytes());
        }
        let rest = format!("families {:08x}", checksum.finalize());
        sweep::key(NAME, self.models, &RunOptions::default(), &rest)
    }

    /// Measures every case under every model, writes `sensitivity.csv` and [`DERIVATIVES`], and passes each row to `each`, in order.
    ///
    /// # Errors
    /// As [`Sweep::run`] and [`Kept::write`](crate::sweep::Kept::write).
    pub fn run(&self, each: &mut dyn FnMut(SensitivityCase)) -> Result<Done, CompareError> {
        let points: usize = self.parts.iter().map(|part| part.points.count()).sum();
        let units = self.models.len() * points;
        let sweep = Sweep {
            name: NAME,
            units: 0..units,
            size: 1,
            what: "cases",
            key: self.key(),
            time_limit: self.time_limit,
            out: self.out,
        };
        let parameters = self.parameters().join(",");
        let header = |columns| format!("{parameters},{}", columns::names(columns).join(","));
        let found = Mutex::new(BTreeMap::new());
        let kept = sweep.run(|number| {
            let Some(unit) = self.unit(number) else {
                return Ok(Computed::default());
            };
            let measured = unit.measured();
            let failure = measured.as_ref().err().map(|reason| unit.says(reason));
            let computed = unit.lines(&measured)?;
            let derivatives = unit.derivative_lines(&measured)?;
            let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
            found.insert(number, derivatives);
            Ok(Computed {
                lines: computed,
                failure,
            })
        })?;
        let skipped = |number: usize| {
            let lines = self
                .unit(number)
                .map(|unit| unit.lines(&Err(NoRun::Skipped)));
            Ok(Computed {
                lines: lines.transpose()?.unwrap_or_default(),
                failure: None,
            })
        };
        let varied = self.parameters().len() - 1;
        let done: Done = kept.write(
            &header(SensitivityRow::COLUMNS),
            &skipped,
            &mut |line: Line| {
                each(read(&line, varied)?);
                Ok::<_, CompareError>(())
            },
        )?;
        if done.is_complete() {
            let mut found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
            let mut text = header(DerivativeRow::COLUMNS) + "\n";
            for number in 0..units {
                // An interrupted command keeps its rows, but not these: such cases are measured again.
                let lines = match (found.remove(&number), self.unit(number)) {
                    (Some(lines), _) => lines,
                    (None, Some(unit)) => unit.derivative_lines(&unit.measured())?,
                    (None, None) => String::new(),
                };
                text.push_str(&lines);
            }
            self.out.write(DERIVATIVES, &text)?;
        }
        Ok(done)
    }
}

/// A line that was written, as typed data.
fn read(line: &Line, varied: usize) -> Result<SensitivityCase, CompareError> {
    let (values, rest) = line.0.split_at(line.0.len().min(1 + varied));
    let header = columns::names(SensitivityRow::COLUMNS).join(",");
    let text = format!("{header}\n{}", csv_lines(&[rest])?);
    let row = csv::Reader::from_reader(text.as_bytes())
        .deserialize()
        .next();
    let Some(row) = row else {
        return Err(CompareError::input(NAME, "a line", "it has too few fields"));
    };
    Ok(SensitivityCase {
        case: values.first().cloned().unwrap_or_default(),
        values: (values.iter().skip(1))
            .map(|value| value.parse().unwrap_or(f64::NAN))
            .collect(),
        row: row?,
    })
}

#[cfg(test)]
mod tests;
