//! Which gaps between spheres their meshes resolve.
//!
//! A mesh whose refined pole is turned to the neighbour resolves what the model of a pair does at this level. Anywhere
//! else on the mesh panels must not be more than twice as wide as the gap. Both limits are where every load of a pair was
//! found within 1 % of `exact`; at half the gap X11A is off by several per cent, at a tenth it has no right digit.

use nalgebra::Vector3;

use super::{Body, Pole};
use crate::BemError;
use crate::model::{Bem, mesh_family, smallest};

/// Widest panel beside a gap, relative to the gap.
const WIDEST: f64 = 2.0;

/// Angle between a mesh's pole and the direction of a neighbour up to which the pole is turned to it, relative
/// to the angle of the cap, `sqrt(eps)`. It is for rounding.
const ALIGNED: f64 = 0.01;

/// Refuses spheres with a gap between any two that the meshes of the level do not resolve.
///
/// # Errors
/// [`BemError::GapUnresolved`] for the pair that is furthest from being resolved.
pub fn check(level: usize, bodies: &[Body], poles: &[Pole]) -> Result<(), BemError> {
    let mut worst: Option<(f64, Contact<'_>)> = None;
    for second in 1..bodies.len() {
        for first in 0..second {
            let contact = Contact::new((first, second), bodies, poles);
            let share = contact.gap / contact.resolved(level)?;
            if worst.as_ref().is_none_or(|(least, _)| share < *least) {
                worst = Some((share, contact));
            }
        }
    }
    match worst {
        Some((share, contact)) if !is_resolved(share) => Err(contact.refused(level)?),
        _ => Ok(()),
    }
}

/// Whether a gap, relative to the smallest one, is resolved. A distance of centres carries rounding.
fn is_resolved(share: f64) -> bool {
    share * (1.0 + 1e-12) >= 1.0
}

/// Two spheres as their meshes face one another.
struct Contact<'a> {
    spheres: (usize, usize),
    gap: f64,
    /// For each sphere its mesh, and the angle of the other one from its pole.
    sides: [(&'a Pole, f64); 2],
}

impl<'a> Contact<'a> {
    fn new(spheres: (usize, usize), bodies: &[Body], poles: &'a [Pole]) -> Self {
        let (first, second) = spheres;
        let apart = bodies[second].position - bodies[first].position;
        let side = |k: usize, towards: Vector3<f64>| {
            let axis = poles[k].rotation * Vector3::z();
            let angle = axis.cross(&towards).norm().atan2(axis.dot(&towards));
            (&poles[k], angle)
        };
        Self {
            spheres,
            gap: apart.norm() - 2.0,
            sides: [side(first, apart), side(second, -apart)],
        }
    }

    /// Smallest gap that the meshes of a level resolve here.
    fn resolved(&self, level: usize) -> Result<f64, BemError> {
        let mut least: f64 = 0.0;
        for (pole, angle) in &self.sides {
            least = least.max(if *angle <= ALIGNED * self.gap.sqrt() {
                smallest(level)
            } else {
                mesh_family(level, pole.gap)?.edge(pole.gap, *angle) / WIDEST
            });
        }
        Ok(least)
    }

    fn refused(&self, level: usize) -> Result<BemError, BemError> {
        let (lowest, highest) = Bem::LEVELS;
        let mut needed = None;
        for finer in lowest..=highest {
            if needed.is_none() && is_resolved(self.gap / self.resolved(finer)?) {
                needed = Some(finer);
            }
        }
        Ok(BemError::GapUnresolved {
            spheres: Some(self.spheres),
            eps: self.gap,
            level,
            resolved: self.resolved(level)?,
            needed,
            smallest: self.resolved(highest)?,
        })
    }
}
