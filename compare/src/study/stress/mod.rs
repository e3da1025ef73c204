//! Stresslets, power and efficiency of a pair: by gap, along a run, and over the paper's encounters.
//!
//! [`scene::stress`] has the definitions, `docs/FLUID.md` says what they are for. What a pair has is compared with two lone squirmers at the
//! orientations of the same instant: the *excess*. It falls off as `r^-3` or faster, so that its integral over a collision exists.
//!
//! A run reads [`scene::Hydrodynamics`], which has no stresses: commands that do not ask for them compute none.

mod contact;
mod encounters;
mod gaps;
mod instant;
mod integrals;
mod run;

pub use contact::{ContactLaw, Growth, contact_laws};
pub use encounters::{StressEncounterRow, stress_encounters};
pub use gaps::{StressRow, stress_rows};
pub use instant::Instant;
pub use run::{StressRun, StressRunRow, StressSummary, stress_run};

use bem::Bem;
use exact::Exact;
use scene::stress::StressTable;
use scene::{Fluid, Gap, GapRange, MovingPair, Plan, RunOptions, Sample, SceneError};

use crate::{
    BEM_TABLE_TOLERANCE, CompareError, EXACT_TABLE_TOLERANCE, Method, Model, ModelOptions,
};

/// The methods that have stresslets, which a command computes by default.
pub const METHODS: [Method; 2] = [Method::Exact, Method::Bem];

/// Refuses a method that has no stresslets.
///
/// # Errors
/// [`CompareError::Input`].
pub fn check_method(method: Method) -> Result<(), CompareError> {
    method.fluid(&ModelOptions::default(), 1.0).map(drop)
}

/// The same model with more terms or another mesh, the next coarser one that resolves the gap or else a finer one: their difference is an
/// estimate of the error. `None` for a mesh that is the finest and the only one.
fn for_comparison(
    method: Method,
    options: &ModelOptions,
    ratio: f64,
    gap: Gap,
) -> Result<Option<Box<dyn Fluid>>, CompareError> {
    if method == Method::Exact {
        let more = Exact::of_ratio(ratio).and_then(|exact| exact.times_terms(MORE_TERMS));
        return Ok(Some(Box::new(more.map_err(SceneError::from)?)));
    }
    let (coarsest, finest) = Bem::LEVELS;
    for mesh in [options.mesh.wrapping_sub(1), options.mesh + 1] {
        if (coarsest..=finest).contains(&mesh) && method.check_gap(mesh, ratio, gap).is_ok() {
            let options = ModelOptions {
                mesh,
                ..options.clone()
            };
            return method.fluid(&options, ratio).map(Some);
        }
    }
    Ok(None)
}

/// Factor on the terms of the series that are compared with.
const MORE_TERMS: f64 = 1.5;

/// A method that moves pairs of one ratio of the radii and knows their stresslets.
struct Stressed {
    model: Model,
    fluid: Box<dyn Fluid>,
}

impl Stressed {
    /// Sets up a method for `plan`, and for what else is tabulated by `options`.
    fn set_up(method: Method, plan: &Plan, options: &ModelOptions) -> Result<Self, CompareError> {
        let ratio = plan.scene().ratio();
        let options = ModelOptions {
            tabulated: MovingPair::load_set(plan).union(options.tabulated),
            ratios: vec![ratio],
            ..options.clone()
        };
        Ok(Self {
            fluid: method.fluid(&options, ratio)?,
            model: Model::set_up(method, &options)?,
        })
    }

    /// Squirming and swirl modes of the scene of a plan.
    fn modes(plan: &Plan) -> (usize, usize) {
        let set = MovingPair::load_set(plan);
        (set.modes, set.swirl)
    }

    /// Stresslets and power at the gaps of a range, of so many squirming and swirl modes.
    fn table(&self, gaps: GapRange, modes: (usize, usize)) -> Result<StressTable, CompareError> {
        let tolerance = match self.model.method() {
            Method::Bem => BEM_TABLE_TOLERANCE,
            _ => EXACT_TABLE_TOLERANCE,
        };
        let ends = [gaps.smallest, gaps.largest].map(Gap::new);
        let [smallest, largest] = ends;
        let table =
            StressTable::build(self.fluid.as_ref(), [smallest?, largest?], modes, tolerance)?;
        Ok(table)
    }

    /// The run of a plan with its samples.
    fn run(
        &self,
        plan: &Plan,
        options: &RunOptions,
    ) -> Result<(scene::Run, Vec<Sample>), SceneError> {
        let mut samples = Vec::new();
        let run = (self.model).run_observed(plan, options, &mut |sample| samples.push(*sample))?;
        Ok((run, samples))
    }
}

/// The gaps of samples; `None` without samples.
fn gaps_of<'a>(samples: impl Iterator<Item = &'a Sample>) -> Option<GapRange> {
    let gaps = samples.map(|sample| sample.configuration.gap.eps());
    let range = gaps.fold((f64::INFINITY, 0.0_f64), |(low, high), gap| {
        (low.min(gap), high.max(gap))
    });
    (range.0 <= range.1).then_some(GapRange {
        smallest: range.0,
        largest: range.1,
    })
}
