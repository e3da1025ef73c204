//! Stresslets and rates of work by unit causes, in the pair frame. Definitions and signs are those of [`scene::stress`].
//!
//! With the density f of force on the fluid the fluid's traction on a sphere is `t - f`, t that of the flow [within](crate::interior), so that
//!
//! ```text
//! W_ij = ∫ u_i.f_j dS - ∫ u_i.t_j dS,   S = -∫ [(x f + f x)/2 - (x.f) I/3] dS:
//! ```
//!
//! what t adds to the first moment is what `u n + n u` takes off. Slip is solved for, with the systems of the rigid motions: causes of order m go as
//! `cos mφ`, those of swirl too once they are turned, so that even orders are axial, odd ones transverse.
//!
//! A unit cause of sphere 2 is the mirror image of that of sphere 1, except for spin and swirl about the line of centres, where it is minus that.

use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;
use scene::Gap;
use scene::stress::{Block, BlockStresses, Cause, Stresses};

use crate::pair::{Densities, Motion, Systems, Velocities};
use crate::{BemError, interior, slip};

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
            of_motion(systems, radii, motion, &own)
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
    radii: [f64; 2],
    motion: Motion,
    blocks: &[&(Block, Vec<Cause>)],
) -> Result<Vec<BlockStresses>, BemError> {
    let spheres = if systems.are_equal() { 0..1 } else { 0..2 };
    let mut velocities: Vec<Velocities<'_>> = Vec::new();
    for (block, causes) in blocks {
        for sphere in spheres.clone() {
            for cause in causes {
                let (block, cause, radius) = (*block, *cause, radii[sphere]);
                let moves = Box::new(move |y: &Vector3<f64>| velocity(block, cause, radius, y));
                let still = Box::new(|_: &Vector3<f64>| Vector3::zeros());
                velocities.push(if sphere == 0 {
                    [moves, still]
                } else {
                    [still, moves]
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
    let integrated = |sphere: usize, field: &(dyn Fn(&Vector3<f64>) -> Vector3<f64> + Sync)| {
        systems.surface(sphere).work(field)
    };
    let weights_of = |sphere: usize| -> Vec<Weights> {
        let of = |&cause| integrated(sphere, &|y| velocity(block, cause, radii[sphere], y));
        causes.par_iter().map(of).collect()
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
        let outer = radii[on] * dot(&weights[on][row % count], &by[column][on]);
        if on == active {
            let inner = if row == column {
                inner_work(block, causes[row % count])
            } else {
                0.0
            };
            outer - radii[on] * inner
        } else {
            across * outer
        }
    });
    let stresslets = [0, 1].map(|on| {
        let Some((strain, scale)) = strain_of(block) else {
            return DVector::zeros(0);
        };
        let weights = integrated(on, &strain);
        DVector::from_fn(2 * count, |column, _| {
            // Of order 1 the axis of the active sphere has the other sign.
            let side = if block == Block::Order(1) && column / count != on {
                -1.0
            } else {
                1.0
            };
            -side * scale * radii[on].powi(2) * dot(&weights, &by[column][on])
        })
    });
    BlockStresses {
        block,
        causes: causes.to_vec(),
        work,
        stresslets,
    }
}

/// Velocity of a unit cause at the unit normal, in the own frame of the active sphere of the given radius.
fn velocity(block: Block, cause: Cause, radius: f64, normal: &Vector3<f64>) -> Vector3<f64> {
    let order = order_of(block);
    match cause {
        Cause::Translation if order == 0 => Vector3::z(),
        Cause::Translation => Vector3::x(),
        Cause::Rotation if order == 0 => Vector3::z().cross(normal) * radius,
        // The spin whose product with z is x.
        Cause::Rotation => Vector3::y().cross(normal) * radius,
        Cause::Squirming(n) => slip::of_order(n, order, normal),
        Cause::Swirl(n) => slip::swirl_of_order(n, order, normal),
    }
}

fn order_of(block: Block) -> usize {
    match block {
        Block::Twist => 0,
        Block::Order(order) => order,
    }
}

/// Rate of work of a cause on the flow within, over the radius.
fn inner_work(block: Block, cause: Cause) -> f64 {
    match cause {
        Cause::Translation | Cause::Rotation => 0.0,
        Cause::Squirming(n) => interior::squirming_work(n, order_of(block)),
        Cause::Swirl(n) => interior::swirl_work(n, order_of(block)),
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
