//! Stresslets and rates of work by unit causes, in the pair frame. Definitions and signs are those of [`scene::stress`].
//!
//! The flow by a cause is that of the lone sphere, in closed form, and that of a single layer of density f on both spheres which undoes it on the other one. Within
//! a sphere the layer's flow is no flow on the active one, and minus the lone flow on the other one. The fluid's traction is then, but for a
//! pressure, that of the lone sphere on the active one and nothing on the other one, less f, so that
//!
//! ```text
//! W_ij = lone + ∫ u_i.f_j dS,   S = lone - ∫ [(x f + f x)/2 - (x.f) I/3] dS.
//! ```
//!
//! Both tend to the closed form of lone spheres as the gap grows, whatever the mesh. Causes of order m go as `cos mφ`, those of swirl too once they are
//! turned, so that even orders are axial, odd ones transverse: the systems are those of the loads.
//!
//! A unit cause of sphere 2 is the mirror image of that of sphere 1, except for spin and swirl about the line of centres, where it is minus that.

mod unit;

use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;
use scene::Gap;
use scene::stress::{Block, BlockStresses, Cause, Stresses};

use crate::BemError;
use crate::pair::{Densities, Motion, Systems, Velocities};
use crate::surface::mirrored_z;
use unit::Unit;

/// Integrals against a density, node by node.
type Weights = Vec<Vector3<f64>>;

/// Solves for all blocks of squirming modes 1 to `modes` and swirl modes 1 to `swirl`, with the systems of [`Motion::ALL`].
///
/// # Errors
/// [`BemError::Residual`] if a dense system could not be solved.
pub fn solve(
    systems: &Systems<'_, 6>,
    radii: [f64; 2],
    gap: Gap,
    [modes, swirl]: [usize; 2],
) -> Result<Stresses, BemError> {
    let causes: Vec<(Block, Vec<Cause>)> = Block::all(modes, swirl)
        .map(|block| (block, block.causes(modes, swirl)))
        .collect();
    let by_motion = Motion::ALL
        .into_par_iter()
        .map(|motion| {
            let own: Vec<&(Block, Vec<Cause>)> = (causes.iter())
                .filter(|(block, _)| motion_of(*block) == motion)
                .collect();
            of_motion(systems, (radii, gap), motion, &own)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let mut blocks: Vec<BlockStresses> = by_motion.into_iter().flatten().collect();
    blocks.sort_by_key(|of| causes.iter().position(|(block, _)| *block == of.block));
    Ok(Stresses {
        gap,
        modes,
        swirl,
        blocks,
    })
}

/// The symmetry of a block's causes.
fn motion_of(block: Block) -> Motion {
    match block {
        Block::Twist => Motion::Twist,
        Block::Order(order) if order % 2 == 0 => Motion::Axial,
        Block::Order(_) => Motion::Transverse,
    }
}

/// The blocks of one kind of motion.
fn of_motion(
    systems: &Systems<'_, 6>,
    (radii, gap): ([f64; 2], Gap),
    motion: Motion,
    blocks: &[&(Block, Vec<Cause>)],
) -> Result<Vec<BlockStresses>, BemError> {
    let spheres = if systems.are_equal() { 0..1 } else { 0..2 };
    let mut velocities: Vec<Velocities<'_>> = Vec::new();
    for (block, causes) in blocks {
        for sphere in spheres.clone() {
            let [own, other] = [radii[sphere], radii[1 - sphere]];
            let distance = 1.0 + (other + gap.eps()) / own;
            for cause in causes {
                let unit = Unit {
                    block: *block,
                    cause: *cause,
                    radius: own,
                };
                // In the frame of the other one, which is the mirror image of the own one.
                let undone = Box::new(move |y: &Vector3<f64>| {
                    let point = mirrored_z(&(y * (other / own)), distance);
                    -mirrored_z(&unit.flow(&point), 0.0)
                });
                let still = Box::new(|_: &Vector3<f64>| Vector3::zeros());
                velocities.push(if sphere == 0 {
                    [still, undone]
                } else {
                    [undone, still]
                });
            }
        }
    }
    let mut densities = systems.densities_by(motion, &velocities)?.into_iter();
    let mut all = Vec::with_capacity(blocks.len());
    for (block, causes) in blocks {
        let mut by: Vec<Densities> = (&mut densities)
            .take(spheres.len() * causes.len())
            .collect();
        if systems.are_equal() {
            let swapped: Vec<Densities> = by
                .iter()
                .map(|[own, other]| [other.clone(), own.clone()])
                .collect();
            by.extend(swapped);
        }
        all.push(of_block(systems, radii, *block, causes, &by));
    }
    Ok(all)
}

/// One block, from the densities by each cause of either sphere.
fn of_block(
    systems: &Systems<'_, 6>,
    radii: [f64; 2],
    block: Block,
    causes: &[Cause],
    by: &[Densities],
) -> BlockStresses {
    let count = causes.len();
    let unit = |sphere: usize, cause: usize| Unit {
        block,
        cause: causes[cause],
        radius: radii[sphere],
    };
    let weights_of = |sphere: usize| -> Vec<Weights> {
        let of = |cause| {
            systems
                .surface(sphere)
                .work(|y| unit(sphere, cause).flow(y))
        };
        (0..count).into_par_iter().map(of).collect()
    };
    let one = weights_of(0);
    let two = if systems.are_equal() {
        one.clone()
    } else {
        weights_of(1)
    };
    let weights = [one, two];
    // Spin and swirl about the line of centres.
    let across = if block == Block::Twist { -1.0 } else { 1.0 };
    let work = DMatrix::from_fn(2 * count, 2 * count, |row, column| {
        let (on, active) = (row / count, column / count);
        let changed = radii[on] * dot(&weights[on][row % count], &by[column][on]);
        if on == active {
            unit(on, row % count).lone_work(causes[column % count]) + changed
        } else {
            across * changed
        }
    });
    let stresslets = [0, 1].map(|on| {
        let Some((strain, scale)) = strain_of(block) else {
            return DVector::zeros(0);
        };
        let weights = systems.surface(on).work(strain);
        DVector::from_fn(2 * count, |column, _| {
            let active = column / count;
            let changed = -scale * radii[on].powi(2) * dot(&weights, &by[column][on]);
            if active == on {
                unit(on, column % count).lone_stresslet() + changed
            } else if block == Block::Order(1) {
                // The axis towards the other sphere is that of the active one.
                -changed
            } else {
                changed
            }
        })
    });
    BlockStresses {
        block,
        causes: causes.to_vec(),
        work,
        stresslets,
    }
}

type Field = fn(&Vector3<f64>) -> Vector3<f64>;

/// A pure strain E as a velocity, and what `-∫ (E x).f dS` is multiplied with for the stresslet of a block, if that has one.
fn strain_of(block: Block) -> Option<(Field, f64)> {
    match block {
        Block::Order(0) => Some((|y| Vector3::new(-y.x, -y.y, 2.0 * y.z) / 3.0, 1.5)),
        Block::Order(1) => Some((|y| Vector3::new(y.z, 0.0, y.x), 0.5)),
        Block::Order(2) => Some((|y| Vector3::new(y.x, -y.y, 0.0), 0.5)),
        Block::Twist | Block::Order(_) => None,
    }
}

fn dot(weights: &[Vector3<f64>], density: &[Vector3<f64>]) -> f64 {
    weights.iter().zip(density).map(|(w, f)| w.dot(f)).sum()
}
