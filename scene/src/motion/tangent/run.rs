//! A run with its tangents.

use nalgebra::Vector3;

use super::linearised::Linearised;
use super::path::Path;
use super::perturbation::{NUMBERS, Perturbation, Variation};
use crate::mobility::MobilitySet;
use crate::motion::run::run_phases;
use crate::motion::{Run, RunOptions};
use crate::{Hydrodynamics, Isolated, Plan, Scene, SceneError};

/// A run, and how its end changes in each direction that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct TangentRun {
    /// The run, in three dimensions.
    pub run: Run,
    /// The derivative of the configuration at the end of the run, at a fixed time.
    pub end: Vec<Variation>,
    /// The derivative of the orientations that go out, each across its own: at infinity if the pair parted, without gravity, under a model without a cut,
    /// at the end of the run otherwise. In radians per unit of the direction.
    pub outgoing: Vec<[Vector3<f64>; 2]>,
    /// By how much the derivatives at infinity still changed at last, relative to the larger of them and 1; infinite if they have no limit. Zero where
    /// nothing is cut off.
    pub truncation: f64,
}

/// Directions that are integrated at once, at most.
const AT_ONCE: usize = 8;

/// Runs a scene in three dimensions, and integrates the linearised motion in each direction beside it.
///
/// Angles are read at infinity, whatever `options` say.
///
/// # Errors
/// As [`crate::run`]; [`SceneError::NoRatios`] for a direction that changes the radii, for which there is [`run_with_tangents_by_ratio`].
///
/// ```
/// use scene::nalgebra::Vector3;
/// use scene::{Isolated, Perturbation, Pose, RunOptions, Scene, Squirmer, run_with_tangents};
/// // Two that pass each other without interaction stay as far off the plane as one of them was raised.
/// let start = [Pose::planar(-0.5, 5.0, -90.0), Pose::planar(0.5, -5.0, 90.0)];
/// let scene = Scene::new([Squirmer::with_beta(1.0, 5.0)?; 2], start, None, None)?;
/// let raised = Perturbation { positions: [Vector3::z(), Vector3::zeros()], ..Perturbation::NONE };
/// let options = RunOptions { end_time: 4.0, ..RunOptions::default() };
/// let tangents = run_with_tangents(&scene, &Isolated::EQUAL, &options, &[raised])?;
/// assert!((tangents.end[0].positions[0] - Vector3::z()).norm() < 1e-7);
/// assert!(tangents.outgoing[0][0].norm() < 1e-7);
/// # Ok::<(), scene::SceneError>(())
/// ```
pub fn run_with_tangents(
    scene: &Scene,
    model: &dyn Hydrodynamics,
    options: &RunOptions,
    directions: &[Perturbation],
) -> Result<TangentRun, SceneError> {
    if directions.iter().any(|of| of.ratio != 0.0) {
        return Err(SceneError::NoRatios);
    }
    run_with_tangents_by_ratio(scene, (model, &[]), options, directions)
}

/// The same with directions that change the ratio of the radii: the derivatives of the coefficients by it are those of the polynomial through the model
/// and others `beside`, of other ratios; four of them at 1 and 2 % to
/// either side leave an error of about 1e-7. A cut at the smaller radius has no derivative where the radii are equal.
///
/// # Errors
/// As [`crate::run`].
pub fn run_with_tangents_by_ratio(
    scene: &Scene,
    (model, beside): (&dyn Hydrodynamics, &[&dyn Hydrodynamics]),
    options: &RunOptions,
    directions: &[Perturbation],
) -> Result<TangentRun, SceneError> {
    let turns =
        (directions.iter()).any(|of| of.gravity_torques.iter().any(|torque| *torque != 0.0));
    let plan = Plan::new(scene)?;
    let plan = if turns {
        plan.with_idle_gravity()
    } else {
        plan.without_symmetry()
    };
    let plan = plan.in_three_dimensions();
    let options = RunOptions {
        sample_interval: None,
        angles_at: f64::INFINITY,
        ..*options
    };
    let (run, phases) = run_phases(&plan, model, &options)?;
    let mut tangents = TangentRun {
        end: Vec::with_capacity(directions.len()),
        outgoing: Vec::with_capacity(directions.len()),
        truncation: 0.0,
        run,
    };
    let by_ratio = weighted(model, beside);
    let ratios: Vec<f64> = by_ratio
        .iter()
        .map(|(_, of)| of.description().ratio)
        .collect();
    let lone_beside: Vec<Isolated> = ratios.into_iter().map(Isolated::of_ratio).collect();
    let lone_by_ratio: Vec<(f64, &dyn Hydrodynamics)> = (by_ratio.iter().zip(&lone_beside))
        .map(|((weight, _), lone)| (*weight, lone as &dyn Hydrodynamics))
        .collect();
    let ln_cut = |of: &dyn Hydrodynamics| of.cutoff().map_or(0.0, f64::ln);
    let cut_by_ratio = by_ratio
        .iter()
        .map(|(weight, of)| weight * ln_cut(*of))
        .sum();
    for some in directions.chunks(AT_ONCE) {
        let lone = Isolated::of_ratio(scene.ratio());
        let path = Path {
            plan: &plan,
            options: &options,
            cut_by_ratio,
            contact: linearised(&plan, (model, &by_ratio), some),
            flight: Linearised {
                repulsion: None,
                ..linearised(&plan, (&lone, &lone_by_ratio), some)
            },
        };
        match some.len() {
            1 => path.follow::<{ 2 * NUMBERS }>(&phases, &mut tangents)?,
            2..=4 => path.follow::<{ 5 * NUMBERS }>(&phases, &mut tangents)?,
            _ => path.follow::<{ (AT_ONCE + 1) * NUMBERS }>(&phases, &mut tangents)?,
        }
    }
    Ok(tangents)
}

/// The equation of motion of a plan under a model, with the modes that change.
fn linearised<'a>(
    plan: &Plan,
    (model, by_ratio): (&'a dyn Hydrodynamics, &'a [(f64, &'a dyn Hydrodynamics)]),
    directions: &'a [Perturbation],
) -> Linearised<'a> {
    let mut loads = plan.load_set();
    for [modes, swirl] in directions.iter().map(Perturbation::modes_changed) {
        loads.modes = loads.modes.max(modes);
        // The first swirl mode alone turns a squirmer about its own axis.
        loads.swirl = loads.swirl.max(if swirl > 1 { swirl } else { 0 });
    }
    loads.twist |= loads.swirl > 0;
    Linearised {
        model,
        set: MobilitySet {
            loads,
            torque: plan.gravity().is_some(),
        },
        squirmers: plan.scene().squirmers,
        repulsion: plan.repulsion(),
        gravity: plan.gravity(),
        directions,
        changes_slip: (directions.iter())
            .map(|of| of.modes_changed() != [0; 2])
            .collect(),
        by_ratio,
        read: Box::default(),
        failure: None,
    }
}

/// All models with the weights of the derivative, at the ratio of the first, of the polynomial through them (Lagrange's formula).
fn weighted<'a>(
    model: &'a dyn Hydrodynamics,
    beside: &[&'a dyn Hydrodynamics],
) -> Vec<(f64, &'a dyn Hydrodynamics)> {
    let ratio = |of: &dyn Hydrodynamics| of.description().ratio;
    let x = ratio(model);
    let mut own = 0.0;
    let mut all = Vec::with_capacity(beside.len() + 1);
    for (i, of) in beside.iter().enumerate() {
        let others = beside.iter().enumerate().filter(|(j, _)| *j != i);
        let here = ratio(*of);
        let product: f64 = others
            .map(|(_, other)| (x - ratio(*other)) / (here - ratio(*other)))
            .product();
        all.push((product / (here - x), *of));
        own += 1.0 / (x - here);
    }
    if !beside.is_empty() {
        all.push((own, model));
    }
    all
}
