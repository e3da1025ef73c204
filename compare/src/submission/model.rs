//! A submission as a hydrodynamic model: its values between its gaps, and loads from whatever it gives.

use scene::{
    Gap, GapRange, Hydrodynamics, LoadSet, MAX_MODES, ModelDescription, PairLoads, SceneError,
    SelfOther, SwirlLoads, SwirlModeLoads, singular::Singular,
};

use super::convert;
use super::cubic::{Cubic, PiecewiseCubic};
use super::error::SubmissionError;
use super::header::Interpolation;
use super::quantity::{LOADS, PAIRS, Quantity, SQUIRMING};
use super::{Answer, Submission, calibration};

/// To be raised with every change that changes interpolated loads.
const REVISION: u32 = 2;

/// A file of anybody's answers as a hydrodynamic model.
///
/// # Loads between gaps
/// As the header declares them; calibrated if it declares a calibration. Where it declares nothing, sum and difference of the load of the sphere itself
/// and of the other one are piecewise cubics in `ln gap` with a continuous
/// derivative. They go through the values as they are: noise is not smoothed. Loads that diverge as `ln gap` are straight lines there. Only
/// `X11A - X12A` diverges faster. Its diverging part ([`Singular`]) is subtracted before the interpolation if what is left is
/// smoother, so that a model without lubrication is not spoiled. Exact loads at 12 gaps a decade come out with errors below 4e-6,
/// at 24 below 3e-7, relative to the larger of the load and 1.
///
/// A file of mobilities and velocities is interpolated in these, and loads follow from them at each gap.
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
pub struct SubmittedModel {
    range: GapRange,
    /// As declared.
    interpolation: Option<Interpolation>,
    /// Ascending coordinates of the gaps.
    nodes: Vec<f64>,
    /// Place of each pair of quantities among those held, if it is there at every gap.
    places: Vec<Option<usize>>,
    /// For each pair that is not held, which of the two is missing, and at which gap if others have it.
    lacked: Vec<Option<(Quantity, Option<f64>)>>,
    /// Number of pairs held.
    held: usize,
    /// Interval by interval, pair by pair: sum and difference.
    cubics: Vec<[Cubic; 2]>,
    /// The same for the error estimate, relative to the larger of the quantity and 1.
    errors: Vec<f64>,
    /// Whether the diverging part of `X11A - X12A` is subtracted from its cubics.
    subtracted: bool,
    noise: f64,
    checksum: u32,
}

/// A quantity at all gaps, with its stated errors.
type Stated = Vec<(f64, Option<f64>)>;

impl SubmittedModel {
    /// The model of a submission.
    ///
    /// # Errors
    /// [`SubmissionError`] if there are too few gaps for the interpolation, or none is declared to exist.
    pub fn new(submission: &Submission) -> Result<Self, SubmissionError> {
        let (answers, header) = (submission.answers(), submission.header());
        let needed = match header.interpolation {
            Some(Interpolation::None) => return Err(SubmissionError::NoInterpolation),
            Some(Interpolation::Linear | Interpolation::LogLinear) => 2,
            Some(Interpolation::LogCubic) | None => 4,
        };
        let ([first, .., last], true) = (answers, answers.len() >= needed) else {
            return Err(SubmissionError::FewGaps {
                gaps: answers.len(),
                needed,
            });
        };
        let range = GapRange {
            smallest: first.gap.eps(),
            largest: last.gap.eps(),
        };
        let stated =
            (answers.iter()).flat_map(|answer| answer.errors.iter().map(|(_, error)| error));
        let mut model = Self {
            range,
            interpolation: header.interpolation,
            nodes: Vec::new(),
            places: vec![None; PAIRS],
            lacked: vec![None; PAIRS],
            held: 0,
            cubics: Vec::new(),
            errors: Vec::new(),
            subtracted: false,
            noise: stated.fold(ModelDescription::smooth(range).noise, f64::max),
            checksum: submission.checksum(),
        };
        model.nodes = answers
            .iter()
            .map(|answer| model.coordinate(answer.gap))
            .collect();
        model.place(answers);
        let intervals = answers.len() - 1;
        model.cubics = vec![[[0.0; 4]; 2]; intervals * model.held];
        model.errors = vec![0.0; intervals * model.held];
        for pair in 0..PAIRS {
            if model.places[pair].is_some() {
                model.interpolate(pair, submission)?;
            }
        }
        Ok(model)
    }

    /// Finds the pairs that are there at every gap.
    fn place(&mut self, answers: &[Answer]) {
        for pair in 0..PAIRS {
            let both = [Quantity(2 * pair), Quantity(2 * pair + 1)];
            let lacks = |of: Quantity| {
                answers
                    .iter()
                    .find(|answer| answer.values.get(of).is_none())
            };
            match both.map(lacks) {
                [None, None] => {
                    self.places[pair] = Some(self.held);
                    self.held += 1;
                }
                missing => {
                    let has = |answer: &Answer, of: Quantity| answer.values.get(of).is_some();
                    let first = both
                        .into_iter()
                        .zip(missing)
                        .find_map(|(of, at)| Some((of, at?)));
                    self.lacked[pair] = first.map(|(of, at)| {
                        let elsewhere = answers.iter().any(|answer| has(answer, of));
                        (of, elsewhere.then(|| at.gap.eps()))
                    });
                }
            }
        }
    }

    /// Works out the cubics of a pair that is held.
    fn interpolate(&mut self, pair: usize, submission: &Submission) -> Result<(), SubmissionError> {
        let Some(place) = self.places[pair] else {
            return Ok(());
        };
        let (answers, header) = (submission.answers(), submission.header());
        let of = |quantity: Quantity| -> Stated {
            let factor = calibration(header, quantity);
            (answers.iter())
                .filter_map(|answer| {
                    let value = answer.values.get(quantity)?;
                    Some((value * factor, answer.errors.get(quantity)))
                })
                .collect()
        };
        let [own, other] = [of(Quantity(2 * pair)), of(Quantity(2 * pair + 1))];
        let straight = matches!(
            header.interpolation,
            Some(Interpolation::Linear | Interpolation::LogLinear)
        );
        let functions = if straight {
            self.straight(&own, &other)
        } else {
            let may_subtract = header.interpolation.is_none();
            self.curved(pair, may_subtract, answers, [&own, &other])
        };
        let functions = functions.filter(|both| self.are_numbers(both));
        let [sum, difference] = functions.ok_or_else(|| SubmissionError::NotInterpolated {
            name: Quantity(2 * pair).name().to_owned(),
        })?;
        for (interval, (sum, difference)) in sum.iter().zip(&difference).enumerate() {
            let at = interval * self.held + place;
            self.cubics[at] = [sum.0, difference.0];
            let interpolation = 0.5 * (sum.1 + difference.1);
            let of = |nodes: &Stated| {
                let ends = &nodes[interval..=interval + 1];
                let smaller = ends[0].0.abs().min(ends[1].0.abs());
                let stated = ends.iter().map(|node| node.1.unwrap_or(0.0));
                stated.fold(interpolation / smaller.max(1.0), f64::max)
            };
            self.errors[at] = of(&own).max(of(&other));
        }
        Ok(())
    }

    /// Whether sum and difference are finite numbers everywhere between the nodes, and so are their own sum and difference.
    fn are_numbers(&self, [sums, differences]: &[Vec<(Cubic, f64)>; 2]) -> bool {
        let spans = self.nodes.windows(2).map(|ends| ends[1] - ends[0]);
        let largest = |c: &Cubic, span: f64| {
            c[0].abs() + span * (c[1].abs() + span * (c[2].abs() + span * c[3].abs()))
        };
        let mut intervals = spans.zip(sums.iter().zip(differences));
        intervals.all(|(span, (sum, difference))| {
            (largest(&sum.0, span) + largest(&difference.0, span)).is_finite()
        })
    }

    /// Straight lines of sum and difference, whose error nobody states.
    fn straight(&self, own: &Stated, other: &Stated) -> Option<[Vec<(Cubic, f64)>; 2]> {
        let lines = |of: &dyn Fn(SelfOther) -> f64| {
            let values: Vec<f64> = own
                .iter()
                .zip(other)
                .map(|(a, b)| of(SelfOther::new(a.0, b.0)))
                .collect();
            let ends = values.windows(2).zip(self.nodes.windows(2));
            let line = |(values, nodes): (&[f64], &[f64])| {
                let slope = (values[1] - values[0]) / (nodes[1] - nodes[0]);
                slope
                    .is_finite()
                    .then_some(([values[0], slope, 0.0, 0.0], 0.0))
            };
            ends.map(line).collect::<Option<Vec<_>>>()
        };
        Some([lines(&|s| s.sum)?, lines(&|s| s.difference)?])
    }

    /// Cubics of sum and difference, if the numbers can be interpolated. Settles what is subtracted from `X11A - X12A`.
    fn curved(
        &mut self,
        pair: usize,
        may_subtract: bool,
        answers: &[Answer],
        [own, other]: [&Stated; 2],
    ) -> Option<[Vec<(Cubic, f64)>; 2]> {
        let values = |of: &dyn Fn(SelfOther) -> f64| -> Vec<f64> {
            let both = own.iter().zip(other);
            both.map(|(own, other)| of(SelfOther::new(own.0, other.0)))
                .collect()
        };
        let sum = PiecewiseCubic::through(&self.nodes, &values(&|s| s.sum))?;
        let mut values = values(&|s| s.difference);
        let difference = PiecewiseCubic::through(&self.nodes, &values)?;
        if pair != 0 || !may_subtract {
            return Some([sum.intervals, difference.intervals]);
        }
        for (value, answer) in values.iter_mut().zip(answers) {
            *value -= diverging(answer.gap);
        }
        let rest = PiecewiseCubic::through(&self.nodes, &values)
            .filter(|rest| rest.worst_error() < difference.worst_error());
        self.subtracted = rest.is_some();
        Some([sum.intervals, rest.unwrap_or(difference).intervals])
    }

    /// The interval in which `gap` lies.
    ///
    /// # Errors
    /// [`SceneError::GapOutsideRange`].
    #[inline]
    fn interval(&self, gap: Gap) -> Result<usize, SceneError> {
        self.range.check(gap)?;
        let x = self.coordinate(gap);
        let above = self.nodes.partition_point(|&node| node <= x);
        Ok(above.clamp(1, self.nodes.len() - 1) - 1)
    }

    #[inline]
    fn coordinate(&self, gap: Gap) -> f64 {
        match self.interpolation {
            Some(Interpolation::Linear) => gap.eps(),
            _ => gap.ln(),
        }
    }

    /// A quantity between the gaps of the file, if it is held.
    ///
    /// # Errors
    /// [`SceneError::GapOutsideRange`].
    pub(crate) fn quantity(&self, gap: Gap, quantity: Quantity) -> Result<Option<f64>, SceneError> {
        let interval = self.interval(gap)?;
        let pair = self.interpolated(gap, interval, quantity.0 / 2);
        Ok(pair.map(|pair| {
            if quantity.is_own() {
                pair.own()
            } else {
                pair.other()
            }
        }))
    }

    /// A pair of quantities in an interval, if it is held.
    #[inline]
    fn interpolated(&self, gap: Gap, interval: usize, pair: usize) -> Option<SelfOther> {
        let place = self.places[pair]?;
        let x = self.coordinate(gap) - self.nodes[interval];
        let [sum, difference] = &self.cubics[interval * self.held + place];
        let at = |c: &Cubic| c[0] + x * (c[1] + x * (c[2] + x * c[3]));
        let subtracted = self.subtracted && pair == 0;
        Some(SelfOther {
            sum: at(sum),
            difference: at(difference) + if subtracted { diverging(gap) } else { 0.0 },
        })
    }

    /// Why a pair of loads neither is held nor follows from what is.
    fn lacking(&self, load: usize) -> SceneError {
        let pair = convert::lacking(load, |pair| self.places[pair].is_some());
        let (quantity, gap) = self.lacked[pair].unwrap_or((Quantity(2 * pair), None));
        let name = quantity.name().to_owned();
        let error = match gap {
            Some(gap) => SubmissionError::Missing { name, gap },
            None => SubmissionError::NotHeld { name },
        };
        SceneError::from_model("loads from a file", error)
    }

    /// Interpolated loads of `set` and of `swirl` swirl modes.
    ///
    /// # Errors
    /// [`SceneError::GapOutsideRange`], [`SceneError::TooManyModes`], [`SubmissionError::NotHeld`].
    #[inline]
    fn loads_at(
        &self,
        gap: Gap,
        set: LoadSet,
        swirl: usize,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let set = set.check()?;
        let interval = self.interval(gap)?;
        assembled(set, swirl, |pair| self.interpolated(gap, interval, pair))
            .map_err(|load| self.lacking(load))
    }
}

/// The loads of `set` and of `swirl` swirl modes from pairs of quantities; otherwise the first pair of loads that is not there.
#[inline]
pub(super) fn assembled(
    set: LoadSet,
    swirl: usize,
    given: impl Fn(usize) -> Option<SelfOther>,
) -> Result<(PairLoads, SwirlLoads), usize> {
    let lacking = std::cell::Cell::new(None);
    let of = |load: usize| match given(load).or_else(|| convert::load(&given, load)) {
        Some(pair) => pair,
        None => {
            lacking.set(lacking.get().or(Some(load)));
            SelfOther::default()
        }
    };
    let loads = PairLoads::from_column_pairs(set, LoadSet::all(MAX_MODES), of);
    let swirl = SwirlLoads::from_modes(set.with_swirl(swirl), |n| SwirlModeLoads {
        xtc: of(SQUIRMING + 3 * n),
        yfc: of(SQUIRMING + 3 * n + 1),
        ytc: of(SQUIRMING + 3 * n + 2),
    });
    lacking.get().map_or(Ok((loads, swirl)), Err)
}

/// The part of `X11A - X12A` that diverges at contact.
#[inline]
fn diverging(gap: Gap) -> f64 {
    Singular::at(gap, 0.0).xa.difference
}

impl Hydrodynamics for SubmittedModel {
    /// The range of the gaps in the file; the noise is the largest error estimate that it states.
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            noise: self.noise,
            ..ModelDescription::smooth(self.range)
        }
    }

    /// With a checksum of the numbers: files with the same numbers have the same fingerprint, whatever else is in them.
    fn fingerprint(&self) -> String {
        let interpolation = self
            .interpolation
            .map_or("our own", Interpolation::in_words);
        format!(
            "loads from a file, {} gaps, checksum {:08x}, interpolation {interpolation}, revision {REVISION}",
            self.nodes.len(),
            self.checksum
        )
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.loads_at(gap, set, 0).map(|(loads, _)| loads)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.loads_at(gap, set, set.swirl)
    }

    /// The largest over the loads of `set` of the error that the file states at the two gaps next to `gap`, and of an estimate of
    /// the interpolation error from fourth differences (none of straight lines). Of exact loads at 4 to 24 gaps a decade the largest estimate is 4 to
    /// 20 times the largest error; fewer gaps may not show how large their error is. Noise that the file does not state
    /// shows in the differences, a bias does not. Of a symmetric pair, too, the errors are those of the loads of each sphere. None of loads that follow
    /// from mobilities.
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        let set = set.check()?;
        let interval = self.interval(gap)?;
        // Refuses what the file lacks.
        self.loads_at(gap, set, set.swirl)?;
        let error = |pair: usize| {
            let error = self.errors[interval * self.held + self.places[pair]?];
            Some(SelfOther {
                sum: error,
                difference: error,
            })
        };
        let loads = PairLoads::from_column_pairs(set, LoadSet::all(MAX_MODES), |load| {
            error(load).unwrap_or_default()
        });
        let is_held = |load: &usize| self.places[*load].is_some();
        if !(0..LOADS).any(|load| is_held(&load)) {
            return Ok(None);
        }
        let swirl =
            (SQUIRMING..SQUIRMING + 3 * set.swirl).filter_map(|load| Some(error(load)?.sum));
        Ok(Some(loads.columns().chain(swirl).fold(0.0, f64::max)))
    }
}

#[cfg(test)]
mod tests;
