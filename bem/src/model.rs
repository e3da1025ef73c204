//! The model `gap -> loads` by boundary elements.

use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

use scene::{
    Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError, SwirlLoads,
};

use crate::BemError;
use crate::estimates::Estimates;
use crate::mesh::{Grading, MeshFamily};
use crate::pair::{self, Condition, PairSolution};
use crate::refinement::Refinement;

/// Gaps at which the mesh's topology changes; beyond the last one the mesh is uniform and fixed.
const SEAMS: [f64; 6] = [0.00098, 0.004, 0.016, 0.064, 0.256, 1.024];

/// Smallest gap at levels 1, 2, ...: the smallest end of a piece at which every load was found within
/// 0.5 % of `exact` (`tests/accuracy.rs`).
const SMALLEST: [f64; 5] = [0.004, 0.001, 0.00025, 0.00025, 0.00025];

/// To be raised with every change that changes loads: size laws, quadrature, basis, shifts.
const REVISION: u32 = 4;

/// Panels a quarter turn about the line of centres, in the middle of the sphere near contact, at the
/// default level. (Where the size law is `slope θ`, a whole number keeps rings regular.)
const PANELS: f64 = 6.0;

/// Panels shrink by this factor a level.
const SHRINK: f64 = 0.75;

/// The size law at the default level; see [`Grading`].
const LAW: Grading = Grading {
    scale: PI / PANELS,
    far: 2.5,
    slope: 0.5,
    core: 0.5,
    width: f64::INFINITY,
    gap: f64::INFINITY,
};

/// Edge length per width of the gap in the [pieces](WIDTH_PIECES) where it matters; see [`Grading`]. Without it
/// X11A at gap 0.001 is off by 5.8e-4, 4.5e-4, 9.1e-5 at levels 3, 4, 5; with it by 3.1e-5 and 7e-7 at levels 4
/// and 5, for a fifth more nodes.
const WIDTH: f64 = 30.0;

/// Levels from which panels are tied to the gap's width, and the largest gap of the pieces where they are.
const WIDTH_PIECES: (i32, f64) = (4, SEAMS[1]);

/// The same beyond the last seam, where the mesh is uniform.
const FAR_LAW: Grading = Grading {
    scale: 1.0 / PANELS,
    far: 2.0,
    ..LAW
};

/// Two equal spheres by boundary elements, at a level of refinement.
///
/// Panels shrink by a quarter a level, so each level has 16/9 times as many nodes.
///
/// Beyond the last seam, at the gap 1.024, the loads are those of one fixed mesh, shifted so that they tend to the closed form of lone
/// spheres:
///
/// ```text
/// loads(gap) = completed(gap) - completed(infinity) + isolated,
/// ```
///
/// where what is solved for is completed by the loads of the rigid motions that lone squirmers lack on the mesh.
/// The mesh turns a lone squirmer a little, and an error that does not fall with the distance would turn a pair flown to infinity
/// without end. It costs one more solve for each set of loads and each level.
#[derive(Debug)]
pub struct Bem {
    level: usize,
    /// That of the level, of the next coarser one and of the one after it.
    refinements: [Refinement; 3],
    solves: AtomicUsize,
}

impl Bem {
    /// The level at which every load is within 1e-4 for gaps from 0.004 and 1e-3 from 0.001, with fewer
    /// than 1,500 nodes a sphere.
    pub const DEFAULT_LEVEL: usize = 3;

    /// Lowest and highest level.
    pub const LEVELS: (usize, usize) = (1, 5);

    /// The model at a level of refinement, from [`Self::LEVELS`].
    ///
    /// # Errors
    /// [`BemError::Level`] for a level that does not exist.
    pub fn new(level: usize) -> Result<Self, BemError> {
        check_level(level)?;
        let [fine, middle, coarse] = [0, 1, 2].map(|coarser| families(level as i32 - coarser));
        Ok(Self {
            level,
            refinements: [fine?, middle?, coarse?].map(Refinement::new),
            solves: AtomicUsize::new(0),
        })
    }

    /// The level of refinement.
    #[must_use]
    pub fn level(&self) -> usize {
        self.level
    }

    /// Number of dense systems factorised so far; those of lone spheres count once for each level and set of loads.
    #[must_use]
    pub fn solves(&self) -> usize {
        self.solves.load(Ordering::Relaxed)
    }

    /// The meshes used at a gap.
    #[must_use]
    pub fn family(&self, gap: Gap) -> &MeshFamily {
        self.refinements[0].family(piece_of(gap.eps()))
    }

    /// The loads at a gap with the time that they took.
    ///
    /// # Errors
    /// As [`Hydrodynamics::loads`].
    pub fn solve(&self, gap: Gap, set: LoadSet) -> Result<PairSolution, SceneError> {
        self.solve_with(&self.refinements[0], gap, set)
    }

    /// The same with the error estimate of [`Hydrodynamics::error_estimate`], for the price of that alone.
    ///
    /// # Errors
    /// As [`Hydrodynamics::loads`].
    pub fn solve_with_estimate(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairSolution, f64), SceneError> {
        let (solution, estimates) = self.solve_with_estimates(gap, set)?;
        let largest = estimates.largest(&solution.loads, &solution.swirl);
        Ok((solution, largest))
    }

    /// The loads with the time that they took, and an error estimate for each; see [`Estimates`].
    ///
    /// # Errors
    /// As [`Hydrodynamics::loads`].
    pub fn solve_with_estimates(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairSolution, Estimates), SceneError> {
        let [fine, middle, coarse] = &self.refinements;
        let solution = self.solve_with(fine, gap, set)?;
        let of = |refinement| {
            self.solve_with(refinement, gap, set)
                .map(|s| (s.loads, s.swirl))
        };
        let fine = (solution.loads, solution.swirl);
        let levels = [&fine, &of(middle)?, &of(coarse)?];
        Ok((solution, Estimates::of_levels(self.level, set, levels)))
    }

    /// The model's own estimate of the error of each load at `gap`, absolute; see [`Estimates`].
    ///
    /// # Errors
    /// As [`Hydrodynamics::loads`].
    pub fn error_estimates(&self, gap: Gap, set: LoadSet) -> Result<Estimates, SceneError> {
        Ok(self.solve_with_estimates(gap, set)?.1)
    }

    /// Condition numbers of the systems that [`Self::solve`] solves.
    ///
    /// # Errors
    /// As [`Hydrodynamics::loads`]; [`BemError::SingularValues`] if they cannot be found.
    pub fn conditions(&self, gap: Gap, set: LoadSet) -> Result<Vec<Condition>, BemError> {
        self.check(gap)?;
        pair::conditions(self.family(gap), gap.eps(), set)
    }

    /// Refuses a gap that the meshes of this level do not resolve.
    ///
    /// # Errors
    /// [`BemError::GapUnresolved`] with the level that would do.
    pub fn check(&self, gap: Gap) -> Result<(), BemError> {
        check_gap(self.level, gap)
    }

    fn solve_with(
        &self,
        refinement: &Refinement,
        gap: Gap,
        set: LoadSet,
    ) -> Result<PairSolution, SceneError> {
        self.check(gap).map_err(failure)?;
        set.check()?;
        let (solution, factorised) =
            (refinement.solve(piece_of(gap.eps()), gap.eps(), set)).map_err(failure)?;
        self.solves.fetch_add(factorised, Ordering::Relaxed);
        Ok(solution)
    }
}

/// Noise of the quadrature between seams, relative to the larger of the load and 1.
const NOISE: f64 = 1e-11;

impl Hydrodynamics for Bem {
    fn description(&self) -> ModelDescription<'_> {
        let smallest = smallest(self.level);
        ModelDescription {
            range: GapRange::from(smallest),
            cutoff: None,
            seams: &SEAMS[piece_of(smallest.next_up())..],
            noise: NOISE,
        }
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        Ok(self.solve(gap, set)?.loads)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let solution = self.solve(gap, set)?;
        Ok((solution.loads, solution.swirl))
    }

    /// The largest of [`Bem::error_estimates`], each relative to the larger of its load and 1.
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        Ok(Some(self.solve_with_estimate(gap, set)?.1))
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

/// Gaps smaller than the first seam have the mesh of the smallest piece.
fn pieces() -> impl Iterator<Item = (f64, f64)> {
    let starts = std::iter::once(SMALLEST.into_iter().fold(f64::INFINITY, f64::min)).chain(SEAMS);
    starts.zip(SEAMS.into_iter().chain([f64::INFINITY]))
}

/// A seam belongs to the smaller gaps.
fn piece_of(eps: f64) -> usize {
    SEAMS.iter().filter(|&&seam| seam < eps).count()
}

/// The size law of a level in a piece. Levels 0 and -1 serve only as the coarser ones of levels 1 and 2.
fn law(level: i32, largest: f64) -> Grading {
    let law = if largest.is_finite() { LAW } else { FAR_LAW };
    let tied = level >= WIDTH_PIECES.0 && largest <= WIDTH_PIECES.1;
    Grading {
        scale: law.scale * SHRINK.powi(level - Bem::DEFAULT_LEVEL as i32),
        width: if tied { WIDTH } else { f64::INFINITY },
        ..law
    }
}

fn family(level: i32, (smallest, largest): (f64, f64)) -> Result<MeshFamily, BemError> {
    MeshFamily::new(law(level, largest), smallest, largest)
}

fn families(level: i32) -> Result<Vec<MeshFamily>, BemError> {
    pieces().map(|piece| family(level, piece)).collect()
}

/// The family of meshes at a level for a gap.
pub(crate) fn mesh_family(level: usize, eps: f64) -> Result<MeshFamily, BemError> {
    check_level(level)?;
    let piece = pieces().nth(piece_of(eps)).unwrap_or((eps, f64::INFINITY));
    family(level as i32, piece)
}

fn failure(error: BemError) -> SceneError {
    SceneError::from_model("bem", error)
}

/// Smallest gap that a level resolves.
pub(crate) fn smallest(level: usize) -> f64 {
    let (lowest, highest) = Bem::LEVELS;
    SMALLEST[level.clamp(lowest, highest) - lowest]
}

fn check_gap(level: usize, gap: Gap) -> Result<(), BemError> {
    // Rounding of exp(ln(eps)) must not refuse the end of the range itself.
    let resolves = |level: &usize| gap.eps() * (1.0 + 1e-12) >= smallest(*level);
    if resolves(&level) {
        return Ok(());
    }
    let (lowest, highest) = Bem::LEVELS;
    Err(BemError::GapUnresolved {
        spheres: None,
        eps: gap.eps(),
        level,
        resolved: smallest(level),
        needed: (lowest..=highest).find(resolves),
        smallest: smallest(highest),
    })
}

pub(crate) fn check_level(level: usize) -> Result<(), BemError> {
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
