//! What unlike radii change: outcomes over the plane of initial directions, and where lubrication theory can be trusted.
//!
//! The family `incoming-angles` has the starts, at a gap of one radius of the smaller squirmer, with a repulsion that scales with it: a pair
//! named the other way round, with the inverse ratio, is the same pair.

mod row;

pub use row::RatioRow;

use scene::{Outcome, RunOptions, Scene};
use serde::{Deserialize, Serialize};

use crate::no_run::{FAILED, RunNumbers};
use crate::output::{OutputFolder, csv_lines};
use crate::scene_file::{FamilyScene, paper_point};
use crate::study::maps::{Grid, TRUST_CLASSES, trust_class};
use crate::sweep::{self, Computed, Row, Sweep, SweepOptions};
use crate::{CompareError, Method, Model, ModelOptions};

/// Two squirmers of unlike radii.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnlikePair {
    /// Squirmer parameter `B_2/B_1` of each.
    pub beta: [f64; 2],
    /// Radius of the second over that of the first.
    pub ratio: f64,
}

/// Numbers of runs along a line of the grid: those with each outcome by the method and by exact hydrodynamics, and those in each class of
/// trust.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct Counts([usize; 5], [usize; 5], [usize; TRUST_CLASSES.len()]);

impl Row for Counts {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        let [.., failed] = self.2;
        std::iter::repeat_n(FAILED, failed)
    }
}

/// Index among [`RatioRow::OUTCOMES`].
fn kind(outcome: &str) -> Option<usize> {
    let is = |one: Outcome| one.to_string() == outcome;
    let orbits = is(Outcome::Anticlockwise) || is(Outcome::Clockwise);
    let name = if orbits { "orbiting" } else { outcome };
    RatioRow::OUTCOMES.iter().position(|known| *known == name)
}

impl UnlikePair {
    /// The scene that starts at a point of the plane.
    ///
    /// # Errors
    /// [`CompareError::FamilyPoint`] for numbers that are not finite, and for a ratio that is not allowed.
    pub fn scene(&self, delta: f64, sigma: f64) -> Result<Scene, CompareError> {
        self.point(delta, sigma).map(|point| point.scene)
    }

    fn point(&self, delta: f64, sigma: f64) -> Result<FamilyScene, CompareError> {
        let values = [
            ("beta", self.beta[0]),
            ("beta2", self.beta[1]),
            ("lambda", self.ratio),
            ("delta", delta),
            ("sigma", sigma),
        ];
        paper_point("incoming-angles", &values)
    }
}

/// Pairs of some radii, each from all over the plane of initial directions, by some models and by the exact one.
pub struct Ratios<'a> {
    /// The models that are judged.
    pub judged: Vec<&'a Model>,
    /// The exact one.
    pub exact: &'a Model,
    /// The pairs.
    pub pairs: &'a [UnlikePair],
    /// The grid of initial directions.
    pub grid: Grid,
    /// Options of each run, and the time limit.
    pub options: SweepOptions,
    /// The folder for the rows.
    pub out: &'a OutputFolder,
}

/// Name of the file of the rows, without its ending.
const NAME: &str = "ratios";

impl Ratios<'_> {
    /// Options of models for what the motion of some pairs reads.
    ///
    /// # Errors
    /// As [`UnlikePair::scene`].
    pub fn options_of(
        pairs: &[UnlikePair],
        options: ModelOptions,
    ) -> Result<ModelOptions, CompareError> {
        // A start without symmetry reads all that any other one reads.
        options.for_scenes(pairs.iter().map(|pair| pair.scene(0.3, 0.4)))
    }

    fn run_options(&self) -> RunOptions {
        RunOptions {
            sample_interval: None,
            ..self.options.run
        }
    }

    fn sweep(&self) -> Sweep<'_> {
        let pairs: Vec<_> = (self.pairs.iter())
            .map(|pair| format!("{:?}/{:?}/{:?}", pair.beta[0], pair.beta[1], pair.ratio))
            .collect();
        let (pairs, points) = (pairs.join(", "), self.grid.points());
        let rest = format!("compared with the last model; beta/beta2/ratio {pairs}; grid {points}");
        let models = self.judged.iter().copied().chain([self.exact]);
        Sweep {
            name: NAME,
            units: 0..self.judged.len() * self.pairs.len() * points,
            size: 1,
            what: "lines of the maps",
            key: sweep::key(NAME, models, &self.run_options(), &rest),
            time_limit: self.options.time_limit,
            out: self.out,
        }
    }

    /// Checks that no finished lines of other maps would be deleted.
    ///
    /// # Errors
    /// As [`Sweep::check`].
    pub fn check(&self) -> Result<(), CompareError> {
        self.sweep().check()
    }

    /// The rows for every model and pair, in this order. `None` if the time limit left something out; then the same command continues. The
    /// lines are kept until the file of the rows is written.
    ///
    /// # Errors
    /// [`CompareError::Write`] if rows cannot be kept.
    pub fn rows(&self) -> Result<Option<Vec<RatioRow>>, CompareError> {
        let (sigmas, run) = (self.grid.values(), self.run_options());
        let sweep = self.sweep();
        let of = |map: usize| {
            let (model, pair) = (map / self.pairs.len(), map % self.pairs.len());
            (self.judged[model], &self.pairs[pair])
        };
        let kept = sweep.run(|unit| {
            let (map, line) = (unit / sigmas.len(), unit % sigmas.len());
            let counts = self.line(of(map), sigmas[line], &run);
            Ok(Computed {
                lines: csv_lines(&[counts])?,
                failure: None,
            })
        })?;
        let Some(kept) = kept.complete() else {
            return Ok(None);
        };
        let mut failed = 0;
        let rows = (0..self.judged.len() * self.pairs.len()).map(|map| {
            let lines: Vec<Counts> = kept.rows(map * sigmas.len()..(map + 1) * sigmas.len())?;
            failed += lines
                .iter()
                .map(|line| line.2[TRUST_CLASSES.len() - 1])
                .sum::<usize>();
            let (model, pair) = of(map);
            Ok(row(model.method(), pair, &lines))
        });
        let rows = rows.collect::<Result<Vec<_>, CompareError>>()?;
        self.out.account().failed(failed);
        Ok(Some(rows))
    }

    /// A line of constant `Sigma`.
    fn line(
        &self,
        (model, pair): (&Model, &UnlikePair),
        sigma: f64,
        options: &RunOptions,
    ) -> Counts {
        let mut counts = Counts::default();
        for delta in self.grid.values() {
            let run = |model: &Model| {
                let point = pair.point(delta, sigma);
                // The larger of the two takes its time.
                let end_time = point
                    .as_ref()
                    .map_or(options.end_time, |point| point.run.end_time);
                let options = RunOptions {
                    end_time,
                    ..*options
                };
                RunNumbers::of(&model.attempt(point.map(|point| point.scene), &options))
            };
            let [judged, exact] = [model, self.exact].map(run);
            for (of, numbers) in [(&mut counts.0, &judged), (&mut counts.1, &exact)] {
                if let Some(kind) = kind(&numbers.outcome) {
                    of[kind] += 1;
                }
            }
            let differences = [0, 1].map(|k| judged.deflections_deg[k] - exact.deflections_deg[k]);
            counts.2[trust_class([&judged.outcome, &exact.outcome], differences)] += 1;
        }
        counts
    }
}

fn row(method: Method, pair: &UnlikePair, lines: &[Counts]) -> RatioRow {
    let points: usize = lines.iter().flat_map(|line| line.2).sum();
    let share = |count: usize| count as f64 / points as f64;
    let by = |k: usize| share(lines.iter().map(|line| line.0[k]).sum());
    let exact = |k: usize| share(lines.iter().map(|line| line.1[k]).sum());
    let class = |k: usize| share(lines.iter().map(|line| line.2[k]).sum());
    let [beta1, beta2] = pair.beta;
    RatioRow {
        method,
        beta1,
        beta2,
        ratio: pair.ratio,
        scattered: by(0),
        standoff: by(1),
        pairwise: by(2),
        orbiting: by(3),
        undecided: by(4),
        scattered_exact: exact(0),
        standoff_exact: exact(1),
        pairwise_exact: exact(2),
        orbiting_exact: exact(3),
        undecided_exact: exact(4),
        within_5_deg: class(0),
        within_15_deg: class(1),
        within_45_deg: class(2),
        beyond_45_deg: class(3),
        same_outcome: class(4),
        other_outcome: class(5),
        failed: class(6),
        points,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
    use super::*;
    use approx::assert_relative_eq;

    /// The rows of both forms of lubrication theory, one in the place of the exact model.
    fn rows(pairs: &[UnlikePair]) -> Vec<RatioRow> {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputFolder::open(folder.path()).unwrap();
        let options = Ratios::options_of(pairs, ModelOptions::default()).unwrap();
        let [lt, corrected] =
            [Method::Lt, Method::LtCorrected].map(|m| Model::set_up(m, &options).unwrap());
        let ratios = Ratios {
            judged: vec![&lt],
            exact: &corrected,
            pairs,
            grid: Grid::new(12).unwrap(),
            options: SweepOptions {
                run: RunOptions::default(),
                time_limit: None,
            },
            out: &out,
        };
        ratios.rows().unwrap().unwrap()
    }

    #[test]
    fn val_a_pair_named_the_other_way_round_has_the_same_shares() {
        let of = |one, two, ratio| UnlikePair {
            beta: [one, two],
            ratio,
        };
        let rows = rows(&[of(5.0, -1.0, 0.5), of(-1.0, 5.0, 2.0), of(5.0, -1.0, 2.0)]);
        let [one, other, unlike] = &rows[..] else {
            panic!("{rows:?}")
        };
        for exact in [false, true] {
            for (a, b) in one.outcomes(exact).into_iter().zip(other.outcomes(exact)) {
                assert_relative_eq!(a, b, epsilon = 1e-12);
            }
        }
        for (a, b) in one.trust().into_iter().zip(other.trust()) {
            assert_relative_eq!(a, b, epsilon = 1e-12);
        }
        assert!((one.scattered - unlike.scattered).abs() > 0.01);
        for row in &rows {
            assert_relative_eq!(row.trust().iter().sum::<f64>(), 1.0, epsilon = 1e-12);
            assert_relative_eq!(row.outcomes(true).iter().sum::<f64>(), 1.0, epsilon = 1e-12);
            assert!(row.other_outcome + row.within_15_deg > 0.0, "{row:?}");
        }
    }
}
