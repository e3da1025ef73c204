//! Which gaps between spheres their meshes resolve.
//!
//! A mesh whose refined pole is turned to the neighbour resolves what the model of a pair does at this level. Anywhere
//! else on the mesh panels must not be more than twice as wide as the gap. Both limits are where every load of a pair was
//! found within 1 % of `exact`; at half the gap X11A is off by several per cent, at a tenth it has no right digit.

use nalgebra::Vector3;

use super::Body;
use super::poles::Pole;
use crate::Bem;
use crate::BemError;
use crate::pieces::smallest;
use crate::surface::mirror_gap;

/// Widest panel beside a gap, relative to the gap.
const WIDEST: f64 = 2.0;

/// Angle between a mesh's pole and the direction of a neighbour up to which the pole is turned to it, relative
/// to the angle of the cap, `sqrt(e)` of the gap e to the mirror image. It is for rounding.
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
    sides: [Facing<'a>; 2],
}

/// One of them.
struct Facing<'a> {
    pole: &'a Pole,
    /// Angle of the other one from the pole.
    angle: f64,
    radius: f64,
    /// Gap to the mirror image in the place of the other one, in radii.
    mirrored: f64,
}

impl<'a> Contact<'a> {
    fn new(spheres: (usize, usize), bodies: &[Body], poles: &'a [Pole]) -> Self {
        let (first, second) = spheres;
        let apart = bodies[second].position - bodies[first].position;
        let radii = [bodies[first].radius, bodies[second].radius];
        let gap = apart.norm() - (radii[0] + radii[1]);
        let side = |k: usize, towards: Vector3<f64>, [own, other]: [f64; 2]| {
            let axis = poles[k].rotation * Vector3::z();
            Facing {
                pole: &poles[k],
                angle: axis.cross(&towards).norm().atan2(axis.dot(&towards)),
                radius: own,
                mirrored: mirror_gap(gap, [own, other]),
            }
        };
        Self {
            spheres,
            gap,
            sides: [
                side(first, apart, radii),
                side(second, -apart, [radii[1], radii[0]]),
            ],
        }
    }

    /// Harmonic mean of the radii, the unit of the smallest gaps.
    fn mean(&self) -> f64 {
        let [a, b] = self.sides.each_ref().map(|side| side.radius);
        2.0 * a * b / (a + b)
    }

    /// Smallest gap that the meshes of a level resolve here.
    fn resolved(&self, level: usize) -> Result<f64, BemError> {
        let mut least: f64 = 0.0;
        for Facing {
            pole,
            angle,
            radius,
            mirrored,
        } in &self.sides
        {
            least = least.max(if *angle <= ALIGNED * mirrored.sqrt() {
                smallest(level) * self.mean()
            } else {
                pole.family(level)?.edge(pole.gap, *angle) * radius / WIDEST
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
