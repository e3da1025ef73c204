//! Anybody's loads as a hydrodynamic model: read from a file, interpolated between its gaps.

mod cubic;
mod error;
mod rows;

use std::cell::Cell;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use scene::{
    Gap, GapRange, Hydrodynamics, LoadSet, MAX_MODES, ModelDescription, PairLoads, SceneError,
    SelfOther, SwirlLoads, SwirlModeLoads, singular::Singular,
};

use self::cubic::{Cubic, PiecewiseCubic};
use self::rows::{Rows, Stated};

pub use self::error::LoadsFileError;

/// Largest size of a file, in bytes.
const LARGEST_FILE: u64 = 64 << 20;

/// Fewest gaps of a file: those of a cubic.
const FEWEST_GAPS: usize = 4;

/// To be raised with every change that changes interpolated loads.
const REVISION: u32 = 1;

/// Loads that are not by swirl, each for self and other, in the order of [`PairLoads::columns`].
const PAIRS: usize = LoadSet::all(MAX_MODES).column_count() / 2;

/// The same and the loads by swirl, in the order of [`SwirlLoads::columns`].
const ALL_PAIRS: usize = PAIRS + 3 * MAX_MODES;

/// The names of all loads that a file may hold: load `k` of the sphere itself at `2 k`, of the other one at `2 k + 1`.
fn names() -> impl Iterator<Item = String> {
    let set = LoadSet::all(MAX_MODES).with_swirl(MAX_MODES);
    let rows = PairLoads::zero(set).named().into_iter();
    rows.chain(SwirlLoads::zero(set).named())
        .map(|(name, _)| name)
}

/// Loads from a CSV file such as `loads.csv` of `squirmers loads`, as a hydrodynamic model.
///
/// # File
/// ```
/// let text = "# gap in radii; other columns may be there too
/// method,gap,name,value,error_estimate
/// mine,0.1,X11A,3.64,1e-3
/// mine,0.1,X12A,-2.49,1e-3
/// mine,0.1,XF1_1,3.7,none
/// mine,0.1,XF2_1,-0.4,none
/// ";
/// # // One gap is not enough.
/// # let error = compare::LoadsFile::parse(text).unwrap_err();
/// # assert!(matches!(error, compare::LoadsFileError::FewGaps { gaps: 1, .. }));
/// ```
/// and so on at four gaps or more. The columns `gap`, `name` and `value` are needed, in any order. The order of rows is free,
/// and lines that begin with `#` are comments.
/// - `gap`: in radii, greater than 0.
/// - `name`: a load as [`PairLoads::named`] and [`SwirlLoads::named`] call it, of a set without symmetry; signs and units are
///   those of [`scene::loads`] and [`scene::swirl`].
///   A file may leave loads out. A load that is there must be there for both spheres and at every gap.
/// - `value`: the load.
/// - `error_estimate`: the error of the load, relative to the larger of the load and 1; `none` or nothing where it is not known.
/// - `method`: the same in all rows, because a file is one model.
///
/// # Loads between gaps
/// Sum and difference of the load of the sphere itself and of the other one are piecewise cubics in `ln gap` with a continuous
/// derivative. They go through the values as they are: noise is not smoothed. Loads that diverge as `ln gap` are straight lines there. Only
/// `X11A - X12A` diverges faster. Its diverging part ([`Singular`]) is subtracted before the interpolation if what is left is
/// smoother, so that a model without lubrication is not spoiled. Exact loads at 12 gaps a decade come out with errors below 4e-6,
/// at 24 below 3e-7, relative to the larger of the load and 1.
///
/// # Range
/// From the smallest to the largest gap in the file; at any other gap loads are [`SceneError::GapOutsideRange`].
/// A run ends at the smallest gap as "unresolved". It may not leave the range at large gaps: let the
/// file reach beyond the start and the [departure distance](scene::RunOptions::departure_distance). A pair that parts is
/// followed to where its angles are read. By default this is infinity, which a file does not reach, so that the run fails with
/// [`SceneError::GapOutsideRange`]. [`RunOptions::angles_at`](scene::RunOptions::angles_at) must lie in the range:
/// `angles_at: 12.0` needs a gap of 10 or more, and leaves out the rest of the turn, which
/// [`Run::truncation_rad`](scene::Run::truncation_rad) estimates.
#[derive(Clone, Debug)]
pub struct LoadsFile {
    range: GapRange,
    /// Ascending `ln gap`.
    nodes: Vec<f64>,
    /// Place of each load among those in the file, if it is there.
    places: [Option<usize>; ALL_PAIRS],
    /// Number of loads in the file, each for both spheres.
    held: usize,
    /// Interval by interval, load by load: sum and difference.
    cubics: Vec<[Cubic; 2]>,
    /// The same for the error estimate, relative to the larger of the load and 1.
    errors: Vec<f64>,
    /// Whether the diverging part of `X11A - X12A` is subtracted from its cubics.
    subtracted: bool,
    noise: f64,
    checksum: u32,
}

impl LoadsFile {
    /// The loads in the text of a file.
    ///
    /// # Errors
    /// [`LoadsFileError`]: the first mistake.
    pub fn parse(text: &str) -> Result<Self, LoadsFileError> {
        if text.len() as u64 > LARGEST_FILE {
            return Err(LoadsFileError::TooLarge {
                allowed: LARGEST_FILE,
            });
        }
        Self::of_rows(&Rows::parse(text)?)
    }

    /// The loads in a file.
    ///
    /// # Errors
    /// [`LoadsFileError::Read`] if it cannot be read, [`LoadsFileError::InFile`] with the first mistake in it.
    pub fn read(path: &Path) -> Result<Self, LoadsFileError> {
        let in_file = |cause| LoadsFileError::InFile {
            path: path.to_owned(),
            cause: Box::new(cause),
        };
        let mut bytes = Vec::new();
        // Not by its size: devices and pipes have none.
        File::open(path)
            .and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes))
            .map_err(|source| LoadsFileError::Read {
                path: path.to_owned(),
                source,
            })?;
        let text = String::from_utf8(bytes).map_err(|_| in_file(LoadsFileError::NotText))?;
        Self::parse(&text).map_err(in_file)
    }

    fn of_rows(rows: &Rows) -> Result<Self, LoadsFileError> {
        let gaps = &rows.gaps;
        let nodes: Vec<f64> = gaps.iter().map(|gap| gap.ln()).collect();
        let (intervals, held) = (gaps.len() - 1, rows.loads.len());
        let range = GapRange {
            smallest: gaps[0].eps(),
            largest: gaps[intervals].eps(),
        };
        let rounding = ModelDescription::smooth(range).noise;
        let mut file = Self {
            range,
            places: [None; ALL_PAIRS],
            held,
            cubics: vec![[[0.0; 4]; 2]; intervals * held],
            errors: vec![0.0; intervals * held],
            subtracted: false,
            noise: (rows.stated_errors()).fold(rounding, f64::max),
            checksum: rows.checksum(),
            nodes,
        };
        for (place, &load) in rows.loads.iter().enumerate() {
            file.places[load] = Some(place);
            let [own, other] = rows.of_load(place);
            let functions = file.functions(load, gaps, &own, &other).ok_or_else(|| {
                LoadsFileError::NotInterpolated {
                    name: rows::name(2 * load),
                }
            })?;
            for interval in 0..intervals {
                let at = interval * held + place;
                let [sum, difference] = [0, 1].map(|k| functions[k].intervals[interval]);
                file.cubics[at] = [sum.0, difference.0];
                let interpolation = 0.5 * (sum.1 + difference.1);
                let of = |nodes: &[Stated]| {
                    let ends = &nodes[interval..=interval + 1];
                    let stated = ends.iter().map(|node| node.error.unwrap_or(0.0));
                    let smaller = ends[0].value.abs().min(ends[1].value.abs());
                    stated.fold(interpolation / smaller.max(1.0), f64::max)
                };
                file.errors[at] = of(&own).max(of(&other));
            }
        }
        Ok(file)
    }

    /// Sum and difference of a load, if their numbers can be interpolated. Settles what is subtracted from `X11A - X12A`.
    fn functions(
        &mut self,
        load: usize,
        gaps: &[Gap],
        own: &[Stated],
        other: &[Stated],
    ) -> Option<[PiecewiseCubic; 2]> {
        let values = |of: &dyn Fn(SelfOther) -> f64| -> Vec<f64> {
            let both = own.iter().zip(other);
            both.map(|(own, other)| of(SelfOther::new(own.value, other.value)))
                .collect()
        };
        let sum = PiecewiseCubic::through(&self.nodes, &values(&|s| s.sum))?;
        let mut values = values(&|s| s.difference);
        let difference = PiecewiseCubic::through(&self.nodes, &values)?;
        if load != 0 {
            return Some([sum, difference]);
        }
        for (value, &gap) in values.iter_mut().zip(gaps) {
            *value -= diverging(gap);
        }
        let rest = PiecewiseCubic::through(&self.nodes, &values)
            .filter(|rest| rest.worst_error() < difference.worst_error());
        self.subtracted = rest.is_some();
        Some([sum, rest.unwrap_or(difference)])
    }

    /// The interval in which `gap` lies.
    ///
    /// # Errors
    /// [`SceneError::GapOutsideRange`].
    #[inline]
    fn interval(&self, gap: Gap) -> Result<usize, SceneError> {
        self.range.check(gap)?;
        let above = self.nodes.partition_point(|&node| node <= gap.ln());
        Ok(above.clamp(1, self.nodes.len() - 1) - 1)
    }

    /// Loads of `set` and of `swirl` swirl modes, each from its index and its place among those in the file.
    ///
    /// # Errors
    /// [`LoadsFileError::NotHeld`] if the file lacks one of these loads.
    #[inline]
    fn assembled(
        &self,
        set: LoadSet,
        swirl: usize,
        pair: impl Fn(usize, usize) -> SelfOther,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let lacking = Cell::new(None);
        let of = |load: usize| match self.places[load] {
            Some(place) => pair(load, place),
            None => {
                lacking.set(lacking.get().or(Some(load)));
                SelfOther::default()
            }
        };
        let loads = PairLoads::from_column_pairs(set, LoadSet::all(MAX_MODES), of);
        let swirl = SwirlLoads::from_modes(set.with_swirl(swirl), |n| SwirlModeLoads {
            xtc: of(PAIRS + 3 * n),
            yfc: of(PAIRS + 3 * n + 1),
            ytc: of(PAIRS + 3 * n + 2),
        });
        lacking.get().map_or(Ok((loads, swirl)), |load| {
            let name = rows::name(2 * load);
            let error = LoadsFileError::NotHeld { name };
            Err(SceneError::from_model("loads from a file", error))
        })
    }

    /// Interpolated loads of `set` and of `swirl` swirl modes.
    ///
    /// # Errors
    /// [`SceneError::GapOutsideRange`], [`SceneError::TooManyModes`], [`LoadsFileError::NotHeld`].
    #[inline]
    fn interpolated(
        &self,
        gap: Gap,
        set: LoadSet,
        swirl: usize,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let set = set.check()?;
        let interval = self.interval(gap)?;
        let x = gap.ln() - self.nodes[interval];
        let cubics = &self.cubics[interval * self.held..][..self.held];
        self.assembled(set, swirl, |load, place| {
            let [sum, difference] = &cubics[place];
            let at = |c: &Cubic| c[0] + x * (c[1] + x * (c[2] + x * c[3]));
            let subtracted = self.subtracted && load == 0;
            SelfOther {
                sum: at(sum),
                difference: at(difference) + if subtracted { diverging(gap) } else { 0.0 },
            }
        })
    }
}

/// The part of `X11A - X12A` that diverges at contact.
#[inline]
fn diverging(gap: Gap) -> f64 {
    Singular::at(gap, 0.0).xa.difference
}

impl Hydrodynamics for LoadsFile {
    /// The range of the gaps in the file; the noise is the largest error estimate that it states.
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            ratio: 1.0,
            noise: self.noise,
            ..ModelDescription::smooth(self.range)
        }
    }

    /// With a checksum of the numbers: files with the same loads have the same fingerprint, whatever else is in them.
    fn fingerprint(&self) -> String {
        format!(
            "loads from a file, {} gaps, checksum {:08x}, revision {REVISION}",
            self.nodes.len(),
            self.checksum
        )
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.interpolated(gap, set, 0).map(|(loads, _)| loads)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.interpolated(gap, set, set.swirl)
    }

    /// The largest over the loads of `set` of the error that the file states at the two gaps next to `gap`, and of an estimate of
    /// the interpolation error from fourth differences. Of exact loads at 4 to 24 gaps a decade the largest estimate is 4 to
    /// 20 times the largest error; fewer gaps may not show how large their error is. Noise that the file does not state
    /// shows in the differences, a bias does not. Of a symmetric pair, too, the errors are those of the loads of each sphere.
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        let set = set.check()?;
        let from = self.interval(gap)? * self.held;
        let (loads, swirl) = self.assembled(set, set.swirl, |_, place| {
            let error = self.errors[from + place];
            SelfOther {
                sum: error,
                difference: error,
            }
        })?;
        let errors = loads.columns().chain(swirl.columns());
        Ok(Some(errors.fold(0.0, f64::max)))
    }
}

#[cfg(test)]
mod tests;
