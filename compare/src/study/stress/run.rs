//! Stresslets, power and efficiency along a run, by the method's own motion.

use rayon::prelude::*;
use scene::{Plan, Run, RunOptions, Sample};
use serde::Serialize;

use super::instant::{Instant, components};
use super::integrals::{Integrals, lone_efficiency};
use super::{Stressed, gaps_of};
use crate::columns::columns;
use crate::scene_file::SAMPLE_INTERVAL;
use crate::{CompareError, Method, ModelOptions, SceneFile};

/// Time between the samples that integrals are taken from, at most, and most samples of a run, whose integrals are coarser.
pub(super) const STEP: f64 = 0.005;
const MOST_SAMPLES: f64 = 4e4;

columns! {
    /// A row for each method and sample of the trajectory. Stresslets are after Batchelor, positive along the axis of a puller, in the laboratory's
    /// axes; `zz` is `-xx - yy`.
    #[derive(Clone, Copy, Debug, PartialEq, Serialize)]
    pub struct StressRunRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Time from the start.
        #[unit = "a/V_s"]
        pub t: f64,
        /// Gap between the surfaces of the squirmers.
        #[unit = "a"]
        pub gap: f64,
        /// Component xx of the stresslet of squirmer 1.
        #[unit = "mu a^2 V_s"]
        pub s1_xx: f64,
        /// Component xy of the stresslet of squirmer 1.
        #[unit = "mu a^2 V_s"]
        pub s1_xy: f64,
        /// Component xz of the stresslet of squirmer 1.
        #[unit = "mu a^2 V_s"]
        pub s1_xz: f64,
        /// Component yy of the stresslet of squirmer 1.
        #[unit = "mu a^2 V_s"]
        pub s1_yy: f64,
        /// Component yz of the stresslet of squirmer 1.
        #[unit = "mu a^2 V_s"]
        pub s1_yz: f64,
        /// Component xx of the stresslet of squirmer 2.
        #[unit = "mu a^2 V_s"]
        pub s2_xx: f64,
        /// Component xy of the stresslet of squirmer 2.
        #[unit = "mu a^2 V_s"]
        pub s2_xy: f64,
        /// Component xz of the stresslet of squirmer 2.
        #[unit = "mu a^2 V_s"]
        pub s2_xz: f64,
        /// Component yy of the stresslet of squirmer 2.
        #[unit = "mu a^2 V_s"]
        pub s2_yy: f64,
        /// Component yz of the stresslet of squirmer 2.
        #[unit = "mu a^2 V_s"]
        pub s2_yz: f64,
        /// Component xx of the pair's stresslet beyond that of two lone squirmers with the orientations of this instant.
        #[unit = "mu a^2 V_s"]
        pub excess_xx: f64,
        /// Component xy of the same.
        #[unit = "mu a^2 V_s"]
        pub excess_xy: f64,
        /// Component xz of the same.
        #[unit = "mu a^2 V_s"]
        pub excess_xz: f64,
        /// Component yy of the same.
        #[unit = "mu a^2 V_s"]
        pub excess_yy: f64,
        /// Component yz of the same.
        #[unit = "mu a^2 V_s"]
        pub excess_yz: f64,
        /// Rate of work of the slip of squirmer 1 on the fluid.
        #[unit = "mu a V_s^2"]
        pub slip_power1: f64,
        /// Rate of work of the slip of squirmer 2 on the fluid.
        #[unit = "mu a V_s^2"]
        pub slip_power2: f64,
        /// Rate of work of repulsion and gravity on the pair.
        #[unit = "mu a V_s^2"]
        pub external_power: f64,
        /// What the fluid dissipates.
        #[unit = "mu a V_s^2"]
        pub dissipation: f64,
        /// Difference of the dissipation from the work of slip, repulsion and gravity, over the dissipation: it measures the errors of the model.
        #[unit = "-"]
        pub budget: f64,
        /// Lighthill's efficiency of squirmer 1, `6 pi mu a U^2` over the rate of work of its slip; NaN where its slip does no work.
        #[unit = "-"]
        pub efficiency1: f64,
        /// Lighthill's efficiency of squirmer 2.
        #[unit = "-"]
        pub efficiency2: f64,
    }
}

impl StressRunRow {
    fn new(method: Method, at: &Instant) -> Self {
        let [s1, s2] = at.stress.stresslets.each_ref().map(components);
        let excess = components(&at.excess());
        let [efficiency1, efficiency2] = at.efficiencies();
        let [slip_power1, slip_power2] = at.stress.slip_power;
        Self {
            method,
            t: at.t,
            gap: at.gap(),
            s1_xx: s1[0],
            s1_xy: s1[1],
            s1_xz: s1[2],
            s1_yy: s1[3],
            s1_yz: s1[4],
            s2_xx: s2[0],
            s2_xy: s2[1],
            s2_xz: s2[2],
            s2_yy: s2[3],
            s2_yz: s2[4],
            excess_xx: excess[0],
            excess_xy: excess[1],
            excess_xz: excess[2],
            excess_yy: excess[3],
            excess_yz: excess[4],
            slip_power1,
            slip_power2,
            external_power: at.pair.external_power(),
            dissipation: at.stress.dissipation,
            budget: at.budget(),
            efficiency1,
            efficiency2,
        }
    }
}

/// What a run has as a whole.
#[derive(Clone, Debug, PartialEq)]
pub struct StressSummary {
    /// The method.
    pub method: Method,
    /// Outcome of the run.
    pub outcome: String,
    /// Smallest gap, in radii of squirmer 1.
    pub min_gap: f64,
    /// Duration of the run, in `a/V_s`.
    pub duration: f64,
    /// Largest size of a squirmer's stresslet over that of the lone one; NaN if a lone one has none.
    pub growth: f64,
    /// Average over the run of the excess stresslet: `xx, xy, xz, yy, yz`, in `mu a^2 V_s`.
    pub mean_excess: [f64; 5],
    /// Work of slip, in `mu a^2 V_s`.
    pub slip_work: f64,
    /// The same beyond that of two lone squirmers.
    pub excess_work: f64,
    /// Work of repulsion and gravity, in `mu a^2 V_s`.
    pub external_work: f64,
    /// Efficiency of both squirmers together.
    pub efficiency: f64,
    /// That of two lone squirmers.
    pub lone_efficiency: f64,
    /// Largest difference of the dissipation from the work, over the dissipation.
    pub budget: f64,
    /// Gaps that the model was asked at for stresslets.
    pub evaluations: usize,
}

/// A run with its stresslets and power.
#[derive(Clone, Debug, PartialEq)]
pub struct StressRun {
    /// One row a sample.
    pub rows: Vec<StressRunRow>,
    /// The run as a whole.
    pub summary: StressSummary,
}

/// Runs the scene of a file by a method in place of its own, and gives the stresslets and the power along the run.
///
/// # Errors
/// [`CompareError::Input`] for a method that has no stresslets; others as [`Model::set_up`](crate::Model::set_up), for a run that fails, and for a gap
/// that is too small for the model's stresslets.
pub fn stress_run(
    file: &SceneFile,
    method: Method,
    options: &ModelOptions,
) -> Result<StressRun, CompareError> {
    let plan = Plan::new(&file.scene)?;
    let stressed = Stressed::set_up(method, &plan, &file.model_options(&plan, options.clone()))?;
    let interval = file.run.sample_interval.unwrap_or(SAMPLE_INTERVAL);
    let parts = (interval / STEP.max(file.run.end_time / MOST_SAMPLES)).ceil();
    let (run, samples) = stressed.run(
        &plan,
        &RunOptions {
            sample_interval: Some(interval / parts.max(1.0)),
            ..file.run
        },
    )?;
    let (instants, evaluations) = instants(&stressed, &plan, &samples)?;
    let last = samples.len().saturating_sub(1);
    let is_due = |(number, at): &(usize, &Instant)| {
        let multiple = (at.t / interval).round() * interval;
        (multiple - at.t).abs() <= 1e-9 * interval.max(at.t) || *number == last
    };
    let rows = instants.iter().enumerate().filter(is_due);
    Ok(StressRun {
        rows: rows.map(|(_, at)| StressRunRow::new(method, at)).collect(),
        summary: StressSummary::new(method, &run, &instants, evaluations),
    })
}

/// The instants of the samples of a run, and the gaps that the model was asked at for stresslets.
fn instants(
    stressed: &Stressed,
    plan: &Plan,
    samples: &[Sample],
) -> Result<(Vec<Instant>, usize), CompareError> {
    let Some(gaps) = gaps_of(samples.iter()) else {
        return Ok((Vec::new(), 0));
    };
    let table = stressed.table(gaps, Stressed::modes(plan))?;
    let instants = (samples.par_iter())
        .map(|sample| Instant::new(plan, &*stressed.model, &table, sample))
        .collect::<Result<_, _>>()?;
    Ok((instants, table.evaluations()))
}

impl StressSummary {
    fn new(method: Method, run: &Run, instants: &[Instant], evaluations: usize) -> Self {
        let integrals = Integrals::of(instants);
        let largest = |of: fn(&Instant) -> f64| instants.iter().map(of).fold(f64::NAN, f64::max);
        let squirmers = instants.first().map(|at| &at.pair.squirmers);
        Self {
            method,
            outcome: run.outcome.to_string(),
            min_gap: run.min_gap,
            duration: integrals.duration,
            growth: largest(Instant::growth),
            mean_excess: components(&(integrals.excess / integrals.duration)),
            slip_work: integrals.slip_work,
            excess_work: integrals.excess_work,
            external_work: integrals.external_work,
            efficiency: integrals.efficiency,
            lone_efficiency: squirmers.map_or(f64::NAN, lone_efficiency),
            budget: largest(Instant::budget),
            evaluations,
        }
    }
}
