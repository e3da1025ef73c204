//! Collision integrals of many squirmers by several models: parts in parallel, kept on disk as they finish.

use scene::RunOptions;

use super::collider::{Begins, Collider};
use super::integrals::{Coefficients, Means};
use super::points::MOST;
use super::rows::Estimate;
use crate::numbers::written;
use crate::output::{OutputFolder, csv_lines};
use crate::sweep::{self, Computed, Done, Sweep, SweepOptions};
use crate::watch::notice;
use crate::{CompareError, Method, Model};

/// Largest impact parameter that is allowed, in radii.
const WIDEST: f64 = 1000.0;

/// Largest number of replications.
const MOST_REPLICATIONS: usize = 1024;

/// Which encounters are averaged over.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    impacts: Vec<f64>,
    points: usize,
    replications: usize,
}

impl Sampling {
    /// Largest impact parameters, points of each ring between two of them, and independent replications.
    ///
    /// # Errors
    /// [`CompareError::Input`] for impact parameters that are not greater than 0 and at most 1000, for points other than 1 to 65,536,
    /// and for replications other than 2 to 1024.
    pub fn new(impacts: &[f64], points: usize, replications: usize) -> Result<Self, CompareError> {
        if let Some(wrong) = (impacts.iter()).find(|&&b| !(b > 0.0 && b <= WIDEST)) {
            let allowed = format!("give impact parameters greater than 0, at most {WIDEST} radii");
            return Err(CompareError::input("--impact", written(*wrong), allowed));
        }
        if !(1..=MOST).contains(&points) {
            let allowed = format!("give a number of encounters from 1 to {MOST}");
            return Err(CompareError::input("--count", points, allowed));
        }
        if !(2..=MOST_REPLICATIONS).contains(&replications) {
            let allowed =
                format!("an error needs two at least: give a number from 2 to {MOST_REPLICATIONS}");
            return Err(CompareError::input("--replications", replications, allowed));
        }
        let mut impacts = impacts.to_vec();
        impacts.sort_by(f64::total_cmp);
        impacts.dedup_by(|a, b| a.total_cmp(b).is_eq());
        Ok(Self {
            impacts,
            points,
            replications,
        })
    }

    /// The rings between the impact parameters.
    fn rings(&self) -> Vec<(f64, f64)> {
        let inner = std::iter::once(&0.0).chain(&self.impacts);
        inner.copied().zip(self.impacts.iter().copied()).collect()
    }

    /// Parts of one model and beta: each replication of each ring.
    fn parts(&self) -> usize {
        self.impacts.len() * self.replications
    }

    /// The seed of a replication of a ring. All methods and betas have the same points.
    fn seed(&self, part: usize) -> u32 {
        let (ring, replication) = (part / self.replications, part % self.replications);
        (ring * MOST_REPLICATIONS + replication) as u32
    }

    /// The coefficients of each replication up to each impact parameter, from the averages of all parts.
    fn estimates(&self, method: Method, beta: f64, parts: &[Means]) -> Vec<Estimate> {
        let rings = self.rings();
        let of = |(last, &impact): (usize, &f64)| {
            let replication = |replication: usize| {
                let up_to: Vec<_> = (0..=last)
                    .map(|ring| (rings[ring], parts[ring * self.replications + replication]))
                    .collect();
                Coefficients::of(&up_to)
            };
            Estimate {
                method,
                beta,
                impact,
                points: self.points * (last + 1),
                replications: (0..self.replications).map(replication).collect(),
            }
        };
        self.impacts.iter().enumerate().map(of).collect()
    }
}

/// Collision integrals. Models are the outer loop, then betas.
pub struct KineticsSweep<'a> {
    /// The models.
    pub models: &'a [Model],
    /// Squirmer parameters.
    pub betas: &'a [f64],
    /// The encounters.
    pub sampling: &'a Sampling,
    /// Options of each run, of which tolerance and distance at which headings are read count, and the time limit.
    pub options: SweepOptions,
    /// The folder for the rows.
    pub out: &'a OutputFolder,
}

/// Name of the file of the rows, without its ending.
const NAME: &str = "kinetics";

impl KineticsSweep<'_> {
    fn sweep(&self) -> Sweep<'_> {
        let run = RunOptions {
            sample_interval: None,
            ..self.options.run
        };
        let rest = format!(
            "paper's repulsion; betas {:?}; {:?}",
            self.betas, self.sampling
        );
        Sweep {
            name: NAME,
            units: 0..self.models.len() * self.betas.len() * self.sampling.parts(),
            size: 1,
            what: "parts of the integrals",
            key: sweep::key(NAME, self.models, &run, &rest),
            time_limit: self.options.time_limit,
            out: self.out,
        }
    }

    /// Checks that no finished parts of other integrals would be deleted.
    ///
    /// # Errors
    /// As [`Sweep::check`].
    pub fn check(&self) -> Result<(), CompareError> {
        self.sweep().check()
    }

    /// The coefficients, or `None` if the time limit left something out; then the same command continues. Parts are kept
    /// until the file of the rows is written.
    ///
    /// # Errors
    /// As [`Sweep::run`].
    pub fn run(&self) -> Result<Option<Vec<Estimate>>, CompareError> {
        let (betas, parts) = (self.betas.len(), self.sampling.parts());
        let rings = self.sampling.rings();
        let sweep = self.sweep();
        let kept = sweep.run(|unit| {
            let (of, part) = (unit / parts, unit % parts);
            let (model, beta) = (&self.models[of / betas], self.betas[of % betas]);
            let collider = Collider::new(model, beta, &self.options.run)?;
            let (means, failure) = Means::sampled(
                &|incoming| collider.collide(incoming, Begins::Infinity, true),
                rings[part / self.sampling.replications],
                self.sampling.points,
                self.sampling.seed(part),
            );
            Ok(Computed {
                lines: csv_lines(&[means])?,
                failure: failure
                    .map(|why| format!("{}, beta {}: {why}", model.method(), written(beta))),
            })
        })?;
        let Some(kept) = kept.complete() else {
            return Ok(None);
        };
        let (mut estimates, mut done) = (Vec::new(), Done::default());
        for (of, (model, beta)) in (self.models.iter())
            .flat_map(|model| self.betas.iter().map(move |&beta| (model, beta)))
            .enumerate()
        {
            let means: Vec<Means> = kept.rows(of * parts..(of + 1) * parts)?;
            means.iter().for_each(|row| done.add(row));
            estimates.extend(self.sampling.estimates(model.method(), beta, &means));
        }
        if done.failed > 0 {
            notice!("{} encounters failed", done.failed);
        }
        self.out.account().failed(done.failed);
        Ok(Some(estimates))
    }
}
