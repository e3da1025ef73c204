//! Finds instants of a run: a time, the first time at a gap, the closest approach, and equal steps of time.
//!
//! What a run passes between two samples is found by runs that end there, to a bracket of [`WIDTH`].

use scene::{Run, RunOptions, Sample};

use super::FlowStudy;
use crate::CompareError;
use crate::numbers::{rounded, written};

/// An instant of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Instant {
    /// The smallest gap of the run.
    #[default]
    ClosestApproach,
    /// A time from the start.
    Time(f64),
    /// The first time at which the pair has this gap.
    Gap(f64),
}

/// Width of the final bracket of a time, in `a/V_s`.
const WIDTH: f64 = 1e-9;

/// Runs that a search may take: it needs about ten.
const MOST_RUNS: usize = 60;

/// Time between samples at first, in `a/V_s`, and most samples of a run.
const SEARCHED: f64 = 0.25;
const MOST_SAMPLES: f64 = 1e6;

/// Relative difference of gaps that are taken for the same.
const SAME_GAP: f64 = 1e-6;

/// Most frames of a film: their numbers have four digits.
const MOST_FRAMES: usize = 9999;

impl FlowStudy {
    /// The configuration at an instant, its time within 1e-6.
    ///
    /// # Errors
    /// [`CompareError::Input`] for a time or a gap that the run does not reach; [`CompareError::Scene`] if the run fails.
    pub fn sample(&self, instant: Instant) -> Result<Sample, CompareError> {
        match instant {
            Instant::Time(t) => self.at_given_time(t),
            Instant::Gap(gap) => self.first_at_gap(gap),
            Instant::ClosestApproach => Ok(self.approach()?.2),
        }
    }

    /// The configurations at multiples of `interval` up to the end of the run.
    ///
    /// # Errors
    /// [`CompareError::Input`] for an interval of too many frames; [`CompareError::Scene`] if the run fails.
    pub fn samples_every(&self, interval: f64) -> Result<Vec<Sample>, CompareError> {
        let refused = |allowed: String| CompareError::input("--every", written(interval), allowed);
        if !(interval > 0.0 && interval.is_finite()) {
            return Err(refused("give a time greater than 0, in a/V_s".to_owned()));
        }
        if self.run.end_time / interval > 100.0 * MOST_FRAMES as f64 {
            let least = written(self.run.end_time / MOST_FRAMES as f64);
            return Err(refused(format!("give a time of {least} or more, in a/V_s")));
        }
        let (_, samples) = self.samples(&RunOptions {
            sample_interval: Some(interval),
            ..self.run
        })?;
        // The run hands over its end and changes of phase too.
        let is_due = |sample: &Sample| {
            let multiple = (sample.t / interval).round() * interval;
            multiple.total_cmp(&sample.t).is_eq()
        };
        let frames: Vec<_> = samples.into_iter().filter(is_due).collect();
        if frames.len() > MOST_FRAMES {
            let (count, most) = (frames.len(), MOST_FRAMES);
            return Err(refused(format!(
                "it makes {count} frames, and {most} are allowed: give a longer time"
            )));
        }
        Ok(frames)
    }

    /// The configuration at the time `t`, or at the end of the run if that comes before.
    fn run_to(&self, t: f64) -> Result<(Option<Run>, Sample), CompareError> {
        if t <= 0.0 {
            let configuration = *self.plan.start();
            return Ok((
                None,
                Sample {
                    t: 0.0,
                    configuration,
                },
            ));
        }
        let options = RunOptions {
            end_time: t,
            sample_interval: None,
            ..self.run
        };
        let run = self.model.run_observed(&self.plan, &options, &mut |_| ())?;
        let sample = Sample {
            t: run.end_time,
            configuration: run.end,
        };
        Ok((Some(run), sample))
    }

    fn at_given_time(&self, t: f64) -> Result<Sample, CompareError> {
        let refused = |allowed: String| Err(CompareError::input("--time", written(t), allowed));
        let last = self.run.end_time;
        if !(0.0..=last).contains(&t) {
            let last = written(last);
            return refused(format!(
                "the scene runs from 0 to {last} a/V_s: give a time between"
            ));
        }
        let (run, sample) = self.run_to(t)?;
        match run {
            Some(run) if sample.t < t => {
                let (end, outcome) = (rounded(run.end_time, 6), run.outcome);
                refused(format!(
                    "the run ends at {end} a/V_s ({outcome}): give a time up to then"
                ))
            }
            _ => Ok(sample),
        }
    }

    /// Samples that are close enough to tell where the run has its smallest gap, and the closest approach with the index of the sample that
    /// it comes before or is. However seldom the scene has its samples, the gap is the smallest that the run itself located.
    fn approach(&self) -> Result<(Vec<Sample>, usize, Sample), CompareError> {
        let mut interval = self.run.sample_interval.unwrap_or(SEARCHED).min(SEARCHED);
        interval = interval.max(self.run.end_time / MOST_SAMPLES);
        loop {
            let (run, samples) = self.samples(&RunOptions {
                sample_interval: Some(interval),
                ..self.run
            })?;
            let (index, closest) = self.closest(&samples)?;
            let reached = closest.configuration.gap.eps() <= run.min_gap * (1.0 + SAME_GAP);
            if reached || self.run.end_time / interval > MOST_SAMPLES {
                return Ok((samples, index, closest));
            }
            interval *= 0.25;
        }
    }

    /// The closest approach among samples, and the index of the sample that it comes before or is.
    fn closest(&self, samples: &[Sample]) -> Result<(usize, Sample), CompareError> {
        let by_gap = |a: &(usize, &Sample), b: &(usize, &Sample)| {
            let gap = |sample: &Sample| sample.configuration.gap.eps();
            gap(a.1).total_cmp(&gap(b.1))
        };
        let least = samples.iter().enumerate().min_by(by_gap);
        let Some((index, least)) = least else {
            return Ok((0, self.run_to(0.0)?.1));
        };
        let rate = |sample: &Sample| {
            let rates = self.model.rates(&self.plan, &sample.configuration, 1)?;
            Ok(rates.ln_gap)
        };
        let (Some(before), Some(after)) =
            (samples.get(index.wrapping_sub(1)), samples.get(index + 1))
        else {
            return Ok((index, *least));
        };
        if rate(before)? < 0.0 && rate(after)? > 0.0 {
            let found = self.root([before, after], rate)?;
            return Ok((index + usize::from(found.t > least.t), found));
        }
        Ok((index, *least))
    }

    fn first_at_gap(&self, gap: f64) -> Result<Sample, CompareError> {
        let refused = |allowed: String| CompareError::input("--gap", written(gap), allowed);
        if !(gap > 0.0 && gap.is_finite()) {
            return Err(refused("give a gap greater than 0, in radii".to_owned()));
        }
        let (mut samples, before, closest) = self.approach()?;
        samples.insert(before, closest);
        let beyond = |sample: &Sample| sample.configuration.gap.ln() - gap.ln();
        let crosses = |ends: &&[Sample]| beyond(&ends[0]) * beyond(&ends[1]) <= 0.0;
        match samples.windows(2).find(crosses) {
            Some(ends) => self.root([&ends[0], &ends[1]], |sample| Ok(beyond(sample))),
            None => {
                let gaps = samples.iter().map(|sample| sample.configuration.gap.eps());
                let [least, most] = [
                    gaps.clone().fold(f64::INFINITY, f64::min),
                    gaps.fold(0.0, f64::max),
                ];
                Err(refused(format!(
                    "the smallest gap of the run is {least:.6e}, the largest {most:.6e}: give one between"
                )))
            }
        }
    }

    /// Where a value changes its sign between two samples, by the Illinois method on runs that end there.
    fn root(
        &self,
        ends: [&Sample; 2],
        value: impl Fn(&Sample) -> Result<f64, CompareError>,
    ) -> Result<Sample, CompareError> {
        let mut ends = [(*ends[0], value(ends[0])?), (*ends[1], value(ends[1])?)];
        if let Some((sample, _)) = ends.iter().find(|(_, value)| *value == 0.0) {
            return Ok(*sample);
        }
        let mut previous = f64::INFINITY;
        let mut found = ends[1].0;
        for _ in 0..MOST_RUNS {
            let [(a, at_a), (b, at_b)] = ends;
            let t = b.t - at_b * (b.t - a.t) / (at_b - at_a);
            if (t - previous).abs() <= WIDTH || (b.t - a.t).abs() <= WIDTH {
                break;
            }
            previous = t;
            found = self.run_to(t)?.1;
            let here = value(&found)?;
            if here == 0.0 {
                break;
            }
            // The new end replaces the one with its sign; the other counts half where it stays twice.
            ends = if here * at_b < 0.0 {
                [ends[1], (found, here)]
            } else {
                [(a, 0.5 * at_a), (found, here)]
            };
        }
        Ok(found)
    }
}
