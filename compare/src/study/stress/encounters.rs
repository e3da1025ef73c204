//! What the paper's encounters do to the stress of a suspension and to the cost of swimming: integrals over each collision.

use rayon::prelude::*;
use scene::stress::StressTable;
use scene::{Outcome, Plan, Run, RunOptions, Sample};
use serde::Serialize;

use super::instant::{Instant, components};
use super::integrals::{Integrals, beyond, lone_efficiency};
use super::run::STEP;
use super::{Stressed, gaps_of};
use crate::columns::columns;
use crate::no_run::{NoRun, RunNumbers};
use crate::watch::{Pieces, Progress};
use crate::{Case, CompareError, Method, ModelOptions, Reads};

columns! {
    /// A row for each method and encounter. The excess is the stresslet of the pair less that of two lone squirmers with the orientations of the same
    /// instant. A pair that does not part, or a run without a result, has no integrals: NaN.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct StressEncounterRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Approach: `head-on` (Fig. 6) or `orthogonal` (Fig. 7).
        #[unit = "-"]
        pub case: String,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Offset of the two paths in the plane; for opposed paths the distance between them.
        #[unit = "a"]
        pub dx: f64,
        /// Offset out of the plane.
        #[unit = "a"]
        pub dz: f64,
        /// Smallest gap during the run.
        #[unit = "a"]
        pub min_gap: f64,
        /// Interaction time: the time at gaps up to one radius.
        #[unit = "a/V_s"]
        pub tau: f64,
        /// Outcome of the run.
        #[unit = "-"]
        pub outcome: String,
        /// Integral of component xx of the excess over the run.
        #[unit = "mu a^3"]
        pub excess_xx: f64,
        /// Integral of component xy of the excess.
        #[unit = "mu a^3"]
        pub excess_xy: f64,
        /// Integral of component xz of the excess.
        #[unit = "mu a^3"]
        pub excess_xz: f64,
        /// Integral of component yy of the excess.
        #[unit = "mu a^3"]
        pub excess_yy: f64,
        /// Integral of component yz of the excess.
        #[unit = "mu a^3"]
        pub excess_yz: f64,
        /// Average of component xx of the excess over the interaction time; NaN for a pair that does not come so near.
        #[unit = "mu a^2 V_s"]
        pub mean_xx: f64,
        /// Average of component xy of the excess.
        #[unit = "mu a^2 V_s"]
        pub mean_xy: f64,
        /// Average of component xz of the excess.
        #[unit = "mu a^2 V_s"]
        pub mean_xz: f64,
        /// Average of component yy of the excess.
        #[unit = "mu a^2 V_s"]
        pub mean_yy: f64,
        /// Average of component yz of the excess.
        #[unit = "mu a^2 V_s"]
        pub mean_yz: f64,
        /// Largest size of a squirmer's stresslet during the run over that of a lone one; NaN for neutral squirmers, which have none alone.
        #[unit = "-"]
        pub growth: f64,
        /// Work of slip during the run beyond that of two lone squirmers.
        #[unit = "mu a^2 V_s"]
        pub excess_work: f64,
        /// Lighthill's efficiency of both squirmers together during the interaction time; NaN for a pair that does not come so near.
        #[unit = "-"]
        pub efficiency: f64,
        /// That of two lone squirmers, `1/(2 + beta^2)`.
        #[unit = "-"]
        pub lone_efficiency: f64,
        /// Largest difference of the dissipation from the work of slip and repulsion during the run, over the dissipation.
        #[unit = "-"]
        pub budget: f64,
        /// Estimate of the error of the integral of the excess by its samples: the largest difference of a component by half as many.
        #[unit = "mu a^3"]
        pub integration: f64,
        /// Estimate of what the excess adds to its integral before the run, which begins where the paper's does, and after it.
        #[unit = "mu a^3"]
        pub beyond: f64,
    }
}

impl StressEncounterRow {
    /// Size of the integral of the excess, in `mu a^3`.
    #[must_use]
    pub fn excess(&self) -> f64 {
        size([
            self.excess_xx,
            self.excess_xy,
            self.excess_xz,
            self.excess_yy,
            self.excess_yz,
        ])
    }

    /// Size of its average over the interaction time, in `mu a^2 V_s`.
    #[must_use]
    pub fn mean(&self) -> f64 {
        size([
            self.mean_xx,
            self.mean_xy,
            self.mean_xz,
            self.mean_yy,
            self.mean_yz,
        ])
    }
}

/// Size `(S:S)^(1/2)` of a stresslet with the components `xx, xy, xz, yy, yz`.
fn size([xx, xy, xz, yy, yz]: [f64; 5]) -> f64 {
    let zz = -xx - yy;
    (xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + xz * xz + yz * yz)).sqrt()
}

/// A case that was run.
struct Collision {
    plan: Plan,
    run: Run,
    samples: Vec<Sample>,
}

/// The rows of some encounters by some methods, methods outermost, and the messages of runs without a result.
///
/// # Errors
/// [`CompareError::Input`] for a method that has no stresslets; others as [`Model::set_up`](crate::Model::set_up), and for a gap that is too small for
/// the model's stresslets.
pub fn stress_encounters(
    methods: &[Method],
    cases: &[Case],
    run: &RunOptions,
    options: &ModelOptions,
) -> Result<(Vec<StressEncounterRow>, Vec<String>), CompareError> {
    let run = RunOptions {
        sample_interval: Some(STEP),
        ..*run
    };
    let plans = (cases.iter())
        .map(|case| Ok(Plan::new(&case.scene()?)?))
        .collect::<Result<Vec<_>, CompareError>>()?;
    let (mut rows, mut failures) = (Vec::new(), Vec::new());
    for &method in methods {
        let Some(widest) = plans.first() else { break };
        let stressed = Stressed::set_up(method, widest, &widened(&plans, options)?)?;
        let progress = Progress::begin("encounters", cases.len(), Pieces::Alike);
        let runs: Vec<_> = (plans.par_iter())
            .map(|plan| {
                let (run, samples) = stressed
                    .run(plan, &run)
                    .map_err(|error| NoRun::Failed(CompareError::from(error).in_one_line()))?;
                progress.advance();
                Ok(Collision {
                    plan: plan.clone(),
                    run,
                    samples,
                })
            })
            .collect();
        let samples = runs.iter().flatten().flat_map(|run| &run.samples);
        let modes = plans.iter().map(Stressed::modes);
        let modes = modes.fold((0, 0), |(n, m), (k, l)| (n.max(k), m.max(l)));
        let table = (gaps_of(samples))
            .map(|gaps| stressed.table(gaps, modes))
            .transpose()?;
        let of_cases: Vec<_> = (runs.par_iter().zip(cases))
            .map(|(collision, case)| row(&stressed, table.as_ref(), case, collision))
            .collect::<Result<_, _>>()?;
        for (row, (case, run)) in of_cases.into_iter().zip(cases.iter().zip(&runs)) {
            failures.extend(
                run.as_ref()
                    .err()
                    .map(|reason| format!("{case:?}: {reason}")),
            );
            rows.push(row);
        }
    }
    Ok((rows, failures))
}

/// The options, with tables for what all plans read.
fn widened(plans: &[Plan], options: &ModelOptions) -> Result<ModelOptions, CompareError> {
    let mut read = Reads::default();
    for plan in plans {
        read.add(plan.scene())?;
    }
    Ok(options.clone().for_reads(read))
}

fn row(
    stressed: &Stressed,
    table: Option<&StressTable>,
    case: &Case,
    collision: &Result<Collision, NoRun>,
) -> Result<StressEncounterRow, CompareError> {
    let numbers = RunNumbers::of(
        &collision
            .as_ref()
            .map(|of| of.run.clone())
            .map_err(Clone::clone),
    );
    let mut row = StressEncounterRow {
        method: stressed.model.method(),
        case: case.approach.to_string(),
        beta: case.beta,
        dx: case.dx,
        dz: case.dz,
        min_gap: numbers.min_gap,
        tau: numbers.tau,
        outcome: numbers.outcome,
        excess_xx: f64::NAN,
        excess_xy: f64::NAN,
        excess_xz: f64::NAN,
        excess_yy: f64::NAN,
        excess_yz: f64::NAN,
        mean_xx: f64::NAN,
        mean_xy: f64::NAN,
        mean_xz: f64::NAN,
        mean_yy: f64::NAN,
        mean_yz: f64::NAN,
        growth: f64::NAN,
        excess_work: f64::NAN,
        efficiency: f64::NAN,
        lone_efficiency: f64::NAN,
        budget: f64::NAN,
        integration: f64::NAN,
        beyond: f64::NAN,
    };
    let (Ok(of), Some(table)) = (collision, table) else {
        return Ok(row);
    };
    let instants = (of.samples.iter())
        .map(|sample| Instant::new(&of.plan, &*stressed.model, table, sample))
        .collect::<Result<Vec<_>, _>>()?;
    let largest = |of: fn(&Instant) -> f64| instants.iter().map(of).fold(f64::NAN, f64::max);
    row.growth = largest(Instant::growth);
    row.budget = largest(Instant::budget);
    row.lone_efficiency = lone_efficiency(&of.plan.scene().squirmers);
    let integrals = Integrals::of(&instants);
    row.efficiency = integrals.near_efficiency;
    let mean = components(&(integrals.near_excess / integrals.near_time));
    [
        row.mean_xx,
        row.mean_xy,
        row.mean_xz,
        row.mean_yy,
        row.mean_yz,
    ] = mean;
    if of.run.outcome == Outcome::Scattered {
        let excess = components(&integrals.excess);
        [
            row.excess_xx,
            row.excess_xy,
            row.excess_xz,
            row.excess_yy,
            row.excess_yz,
        ] = excess;
        row.excess_work = integrals.excess_work;
        let coarser = components(&Integrals::coarser(&instants).excess);
        let differences = excess.iter().zip(coarser).map(|(a, b)| (a - b).abs());
        row.integration = differences.fold(0.0, f64::max);
        row.beyond = [instants.first(), instants.last()]
            .into_iter()
            .flatten()
            .map(beyond)
            .sum();
    }
    Ok(row)
}
