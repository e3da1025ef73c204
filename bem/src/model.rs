//! The model `gap -> loads` by boundary elements.

use std::sync::atomic::{AtomicUsize, Ordering};

use scene::{Gap, GapRange, Hydrodynamics, MAX_MODES, PairLoads, SceneError};

use crate::BemError;
use crate::mesh::{Grading, MeshFamily};
use crate::pair::{self, PairSolution};

/// Gaps at which the mesh's topology changes; beyond the last one the mesh is uniform and fixed.
const SEAMS: [f64; 5] = [0.004, 0.016, 0.064, 0.256, 1.024];

/// Smallest gap for which meshes are refined.
const SMALLEST: f64 = 0.001;

/// Factor from the difference of two levels to the error estimate.
const CAUTION: f64 = 3.0;

/// To be raised with every change that changes loads: size laws, quadrature, basis.
const REVISION: u32 = 1;

/// The size law at level 0; see [`Grading`].
const LAW: Grading = Grading {
    scale: 1.0,
    far: 1.5,
    slope: 0.5,
    cap: f64::INFINITY,
};

/// The same beyond the last seam, where the mesh is uniform.
const FAR_LAW: Grading = Grading {
    scale: 1.0,
    far: 0.45,
    slope: 1.0,
    cap: f64::INFINITY,
};

/// Two equal spheres by boundary elements, at a level of refinement.
///
/// Panels shrink by `sqrt 2` a level, so each level doubles the number of vertices.
#[derive(Debug)]
pub struct Bem {
    level: usize,
    families: Vec<MeshFamily>,
    coarser: Vec<MeshFamily>,
    solves: AtomicUsize,
}

impl Bem {
    /// The level at which every load is within 1e-4 for gaps from 0.1, and 1e-3 down to 0.001.
    pub const DEFAULT_LEVEL: usize = 3;

    /// Lowest and highest level.
    pub const LEVELS: (usize, usize) = (1, 6);

    /// The model at a level of refinement, from [`Self::LEVELS`].
    ///
    /// # Errors
    /// [`BemError::Level`] for a level that does not exist.
    pub fn new(level: usize) -> Result<Self, BemError> {
        check_level(level)?;
        Ok(Self {
            level,
            families: families(level)?,
            coarser: families(level - 1)?,
            solves: AtomicUsize::new(0),
        })
    }

    /// The level of refinement.
    #[must_use]
    pub fn level(&self) -> usize {
        self.level
    }

    /// Number of dense systems factorised so far.
    #[must_use]
    pub fn solves(&self) -> usize {
        self.solves.load(Ordering::Relaxed)
    }

    /// The meshes used at a gap.
    #[must_use]
    pub fn family(&self, gap: Gap) -> &MeshFamily {
        at_gap(&self.families, gap)
    }

    /// The loads at a gap with the time that they took.
    ///
    /// # Errors
    /// As [`Hydrodynamics::loads`].
    pub fn solve(&self, gap: Gap, modes: usize) -> Result<PairSolution, SceneError> {
        self.solve_with(&self.families, gap, modes)
    }

    fn solve_with(
        &self,
        families: &[MeshFamily],
        gap: Gap,
        modes: usize,
    ) -> Result<PairSolution, SceneError> {
        self.range().check(gap)?;
        if modes > MAX_MODES {
            return Err(SceneError::TooManyModes {
                modes,
                allowed: MAX_MODES,
            });
        }
        let solution = pair::solve(at_gap(families, gap), gap.eps(), modes).map_err(|error| {
            SceneError::Model {
                model: "bem",
                reason: error.to_string(),
            }
        })?;
        self.solves.fetch_add(solution.solves, Ordering::Relaxed);
        Ok(solution)
    }
}

impl Hydrodynamics for Bem {
    fn range(&self) -> GapRange {
        GapRange {
            smallest: SMALLEST,
            largest: f64::INFINITY,
        }
    }

    fn loads(&self, gap: Gap, modes: usize) -> Result<PairLoads, SceneError> {
        Ok(self.solve(gap, modes)?.loads)
    }

    /// Three times the difference from the next coarser level: errors fall by about two to three a
    /// level, but not steadily, so the difference alone can be less than the error.
    fn error_estimate(&self, gap: Gap, modes: usize) -> Result<f64, SceneError> {
        let fine = self.solve(gap, modes)?.loads;
        let coarse = self.solve_with(&self.coarser, gap, modes)?.loads;
        Ok(CAUTION * difference(&fine, &coarse))
    }

    fn seams(&self) -> Vec<f64> {
        SEAMS.to_vec()
    }

    fn noise(&self) -> f64 {
        1e-11
    }

    fn fingerprint(&self) -> String {
        format!("bem level {} revision {REVISION}", self.level)
    }
}

/// Largest difference of two sets of loads, relative to the larger of the load and 1.
#[must_use]
pub fn difference(loads: &PairLoads, others: &PairLoads) -> f64 {
    loads
        .named()
        .iter()
        .zip(others.named())
        .map(|((_, a), (_, b))| (a - b).abs() / a.abs().max(1.0))
        .fold(0.0, f64::max)
}

/// The ends of the pieces between seams.
fn pieces() -> impl Iterator<Item = (f64, f64)> {
    let starts = std::iter::once(SMALLEST).chain(SEAMS);
    starts.zip(SEAMS.into_iter().chain([f64::INFINITY]))
}

/// A seam belongs to the smaller gaps.
fn piece_of(eps: f64) -> usize {
    SEAMS.iter().filter(|&&seam| seam < eps).count()
}

fn family(level: usize, (smallest, largest): (f64, f64)) -> Result<MeshFamily, BemError> {
    let scale = 0.5f64.powf(0.5 * level as f64);
    let law = if largest.is_finite() { LAW } else { FAR_LAW };
    MeshFamily::new(Grading { scale, ..law }, smallest, largest)
}

fn families(level: usize) -> Result<Vec<MeshFamily>, BemError> {
    pieces().map(|piece| family(level, piece)).collect()
}

fn at_gap(families: &[MeshFamily], gap: Gap) -> &MeshFamily {
    &families[piece_of(gap.eps())]
}

/// The family of meshes at a level for a gap.
pub(crate) fn mesh_family(level: usize, eps: f64) -> Result<MeshFamily, BemError> {
    check_level(level)?;
    let piece = pieces().nth(piece_of(eps)).unwrap_or((eps, f64::INFINITY));
    family(level, piece)
}

fn check_level(level: usize) -> Result<(), BemError> {
    let (lowest, highest) = Bem::LEVELS;
    if (lowest..=highest).contains(&level) {
        Ok(())
    } else {
        Err(BemError::Level {
            level,
            lowest,
            highest,
        })
    }
}
