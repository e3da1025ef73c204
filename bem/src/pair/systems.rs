//! Densities by any velocity of both surfaces, for equal and for unlike spheres alike.
//!
//! A velocity is split by the mirrors into parts of each [`Motion`], of equal spheres by the swap too; each part has its own dense system, and the densities
//! add up. Frames are each sphere's own, as in [`super::unlike`]: lengths in its radius, the other sphere on the side of `+z`, that of sphere 2
//! mirrored. Densities are those of force times the sphere's radius.

use nalgebra::Vector3;
use rayon::prelude::*;

use super::parity::{Motion, Parity, Swap};
use super::{UnlikeMeshes, equal, unlike};
use crate::BemError;
use crate::mesh::MeshFamily;
use crate::surface::Surface;

/// Velocity of a sphere's surface at the unit normal, in the sphere's own frame.
type Velocity<'a> = Box<dyn Fn(&Vector3<f64>) -> Vector3<f64> + Send + Sync + 'a>;

/// Velocities of both surfaces. No fluid may flow through either as a whole: `∫ u.n dS = 0`.
pub type Velocities<'a> = [Velocity<'a>; 2];

/// Densities of both spheres, node by node, in their own frames.
pub type Densities = [Vec<Vector3<f64>>; 2];

/// The assembled systems of some kinds of motion of a pair at one gap.
pub enum Systems<'a, const H: usize> {
    /// Of equal spheres.
    Equal(Box<equal::Systems<'a, H>>),
    /// Of unlike ones.
    Unlike(Box<unlike::Systems<'a, H>>),
}

impl<'a, const H: usize> Systems<'a, H> {
    /// Of equal spheres at the gap `eps`.
    pub fn equal(family: &'a MeshFamily<H>, eps: f64, motions: &[Motion]) -> Self {
        let swaps = |&motion| [Swap::Mirrored, Swap::Opposite].map(|swap| Parity::of(motion, swap));
        let parities = motions.iter().flat_map(swaps);
        Self::Equal(Box::new(equal::Systems::new(family, eps, parities)))
    }

    /// Of unlike ones at the gap `eps`, in radii of sphere 1.
    pub fn unlike(meshes: &'a UnlikeMeshes<H>, eps: f64, motions: &[Motion]) -> Self {
        let motions = motions.iter().copied();
        Self::Unlike(Box::new(unlike::Systems::new(meshes, eps, motions)))
    }

    /// Whether the radii are equal.
    pub fn are_equal(&self) -> bool {
        matches!(self, Self::Equal(_))
    }

    /// The meshed surface of a sphere.
    pub fn surface(&self, sphere: usize) -> &Surface<H> {
        match self {
            Self::Equal(of) => &of.side.surface,
            Self::Unlike(of) => &of.sides[sphere].surface,
        }
    }

    /// Number of dense systems.
    pub fn count(&self) -> usize {
        self.motions().len()
    }

    fn motions(&self) -> Vec<Motion> {
        match self {
            Self::Equal(of) => of.motions(),
            Self::Unlike(of) => of.motions(),
        }
    }

    /// Densities by each of some velocities of both surfaces, of which all parts in these systems are solved for.
    ///
    /// # Errors
    /// [`BemError::Residual`] if a dense system could not be solved.
    pub fn densities(&self, velocities: &[Velocities]) -> Result<Vec<Densities>, BemError> {
        self.densities_of(|_| true, velocities)
    }

    /// The same for velocities that have the symmetry of one kind of motion.
    ///
    /// # Errors
    /// As [`Self::densities`].
    pub fn densities_by(
        &self,
        motion: Motion,
        velocities: &[Velocities],
    ) -> Result<Vec<Densities>, BemError> {
        self.densities_of(|of| of == motion, velocities)
    }

    fn densities_of(
        &self,
        wanted: impl Fn(Motion) -> bool,
        velocities: &[Velocities],
    ) -> Result<Vec<Densities>, BemError> {
        let wanted: Vec<usize> = (self.motions().into_iter().enumerate())
            .filter_map(|(k, motion)| wanted(motion).then_some(k))
            .collect();
        let parts = wanted
            .into_par_iter()
            .map(|k| match self {
                Self::Equal(of) => of.densities(k, velocities),
                Self::Unlike(of) => of.densities(k, velocities),
            })
            .collect::<Result<Vec<_>, _>>()?;
        let zeros = |sphere| vec![Vector3::zeros(); self.surface(sphere).nodes().len()];
        let mut sums: Vec<Densities> = velocities.iter().map(|_| [0, 1].map(zeros)).collect();
        for part in &parts {
            for (sum, part) in sums.iter_mut().flatten().zip(part.iter().flatten()) {
                for (sum, f) in sum.iter_mut().zip(part) {
                    *sum += f;
                }
            }
        }
        Ok(sums)
    }
}
