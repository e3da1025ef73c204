//! How well the systems are conditioned.

use super::assembly::Unknowns;
use super::parity::{Motion, Swap};
use super::side::Side;
use crate::BemError;
use crate::dense::condition;

/// How a system is conditioned: largest over smallest singular value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// What the spheres do.
    pub motion: Motion,
    /// What sphere 2 does of that, if the swap splits the systems: it does for equal spheres.
    pub swap: Option<Swap>,
    /// Of the matrix that is solved.
    pub solved: f64,
    /// Of axial systems without the terms that fix the multiple of the normal in each density, which
    /// induces no flow (Pozrikidis 1992, section 4.2).
    pub without_deflation: Option<f64>,
}

impl Condition {
    /// Of a matrix with the unknowns of these spheres, one after the other.
    ///
    /// # Errors
    /// [`BemError::SingularValues`] if they cannot be found.
    pub(super) fn new<const H: usize>(
        swap: Option<Swap>,
        mut matrix: Vec<f64>,
        spheres: &[(&Unknowns, &Side<'_, H>)],
    ) -> Result<Self, BemError> {
        let count = spheres
            .iter()
            .map(|(unknowns, _)| unknowns.list.len())
            .sum();
        let motion = spheres.first().map_or(Motion::Axial, |(of, _)| of.motion);
        let solved = condition(&matrix, count)?;
        let mut deflated = false;
        let mut first = 0;
        for (unknowns, side) in spheres {
            let weights = unknowns.deflation(side);
            deflated |= !weights.is_empty();
            let rows = matrix.chunks_exact_mut(count).skip(first);
            for (row, &(j, a)) in rows.zip(&unknowns.list) {
                let normal = side.surface.nodes()[side.orbits.representatives[j]];
                for (entry, weight) in row[first..].iter_mut().zip(&weights) {
                    *entry -= normal[a] * weight;
                }
            }
            first += unknowns.list.len();
        }
        let without_deflation = if deflated {
            Some(condition(&matrix, count)?)
        } else {
            None
        };
        Ok(Self {
            motion,
            swap,
            solved,
            without_deflation,
        })
    }
}
