//! The model `gap -> loads` by boundary elements.

use std::sync::atomic::{AtomicUsize, Ordering};

use scene::{
    ActiveLoads, Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError,
    SwirlLoads,
};

use crate::BemError;
use crate::estimates::Estimates;
use crate::mesh::MeshFamily;
use crate::pair::{Condition, EachSolution, Motion, PairSolution, Systems};
use crate::pieces::{DEFAULT_LEVEL, LEVELS, Pieces, check_level, check_ratio};
use crate::refinement::Refinement;

/// To be raised with every change that changes loads: size laws, quadrature, basis, shifts.
const REVISION: u32 = 4;

/// Two spheres by boundary elements, at a level of refinement.
///
/// Panels shrink by a quarter a level, so each level has 16/9 times as many nodes.
///
/// Spheres are equal, or of any radii in a [ratio](Self::of_ratio) of 1/100 to 100: then each has the mesh that it has beside its mirror image in
/// the radical plane ([`crate::surface::mirror_gap`]), and smallest gaps are in units of the harmonic mean of the radii.
///
/// Beyond the last seam, at the gap 1.024 in radii of the larger sphere, the loads are those of one fixed mesh, shifted so that they tend to the closed form of lone
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
    pieces: Pieces,
    /// That of the level, of the next coarser one and of the one after it.
    refinements: [Refinement; 3],
    solves: AtomicUsize,
}

impl Bem {
    /// The level at which every load is within 1e-4 for gaps from 0.004 and 1e-3 from 0.001, with fewer
    /// than 1,500 nodes a sphere.
    pub const DEFAULT_LEVEL: usize = DEFAULT_LEVEL;

    /// Lowest and highest level.
    pub const LEVELS: (usize, usize) = LEVELS;

    /// The model of equal spheres at a level of refinement, from [`Self::LEVELS`].
    ///
    /// # Errors
    /// [`BemError::Level`] for a level that does not exist.
    pub fn new(level: usize) -> Result<Self, BemError> {
        Self::of_ratio(level, 1.0)
    }

    /// The model of spheres whose radii are in the `ratio` (radius 2 over radius 1), from [`scene::RATIOS`]; 1 is that of equal ones.
    ///
    /// # Errors
    /// [`BemError::Level`] for a level that does not exist, [`BemError::Ratio`] for radii that are too unlike.
    pub fn of_ratio(level: usize, ratio: f64) -> Result<Self, BemError> {
        check_level(level)?;
        check_ratio(ratio)?;
        let pieces = Pieces::new(ratio);
        let [fine, middle, coarse] =
            [0, 1, 2].map(|coarser| Refinement::new(level as i32 - coarser, &pieces));
        Ok(Self {
            level,
            refinements: [fine?, middle?, coarse?],
            pieces,
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

    /// The meshes of sphere 1 used at a gap, those of both if they are equal.
    #[must_use]
    pub fn family(&self, gap: Gap) -> &MeshFamily {
        self.refinements[0].family(self.pieces.of(gap.eps()))
    }

    /// The loads at a gap, if sphere 1 is the active one, with the time that they took.
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
        let active = |of: PairSolution| ActiveLoads::of_equal(of.loads, of.swirl);
        let of = |refinement| self.solve_with(refinement, gap, set).map(active);
        let levels = [&active(solution), &of(middle)?, &of(coarse)?];
        let set = solution.loads.set();
        let of = (self.level, self.has_unlike_radii());
        Ok((solution, Estimates::of_levels(of, set, levels)))
    }

    /// The loads by either sphere, with the time that they took. Of unlike spheres they are those of a pair without
    /// symmetry ([`LoadSet::of_any_pair`]).
    ///
    /// # Errors
    /// As [`Hydrodynamics::loads`].
    pub fn solve_each(&self, gap: Gap, set: LoadSet) -> Result<EachSolution, SceneError> {
        self.solve_each_with(&self.refinements[0], gap, set)
    }

    /// The same with an error estimate for each load; see [`Estimates`].
    ///
    /// # Errors
    /// As [`Hydrodynamics::loads`].
    pub fn solve_each_with_estimates(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(EachSolution, [Estimates; 2]), SceneError> {
        let [fine, middle, coarse] = &self.refinements;
        let of = |refinement| self.solve_each_with(refinement, gap, set);
        let (fine, middle, coarse) = (of(fine)?, of(middle)?, of(coarse)?);
        let estimates = [0, 1].map(|k| {
            let levels = [&fine, &middle, &coarse].map(|of| &of.loads[k]);
            let of = (self.level, self.has_unlike_radii());
            Estimates::of_levels(of, levels[0].pair.set(), levels)
        });
        Ok((fine, estimates))
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
        self.refinements[0].conditions(self.pieces.of(gap.eps()), gap.eps(), set)
    }

    /// Refuses a gap that the meshes of this level do not resolve.
    ///
    /// # Errors
    /// [`BemError::GapUnresolved`] with the level that would do.
    pub fn check(&self, gap: Gap) -> Result<(), BemError> {
        self.pieces.check(self.level, gap)
    }

    fn solve_with(
        &self,
        refinement: &Refinement,
        gap: Gap,
        set: LoadSet,
    ) -> Result<PairSolution, SceneError> {
        self.counted(gap, set, |piece| refinement.solve(piece, gap.eps(), set))
    }

    fn solve_each_with(
        &self,
        refinement: &Refinement,
        gap: Gap,
        set: LoadSet,
    ) -> Result<EachSolution, SceneError> {
        self.counted(gap, set, |piece| {
            refinement.solve_each(piece, gap.eps(), set)
        })
    }

    /// What the systems of some kinds of motion at a gap are solved for.
    pub(crate) fn solved<S>(
        &self,
        gap: Gap,
        motions: &[Motion],
        solve: impl FnOnce(&Systems<'_, 6>) -> Result<S, BemError>,
    ) -> Result<S, SceneError> {
        let set = LoadSet::all(0);
        self.counted(gap, set, |piece| {
            let systems = self.refinements[0].systems(piece, gap.eps(), motions);
            Ok((solve(&systems)?, systems.count()))
        })
    }

    /// What is found in the piece of a gap, if the model holds what is asked for.
    fn counted<S>(
        &self,
        gap: Gap,
        set: LoadSet,
        solve: impl FnOnce(usize) -> Result<(S, usize), BemError>,
    ) -> Result<S, SceneError> {
        self.check(gap).map_err(failure)?;
        set.check()?;
        let (solution, factorised) = solve(self.pieces.of(gap.eps())).map_err(failure)?;
        self.solves.fetch_add(factorised, Ordering::Relaxed);
        Ok(solution)
    }
}

/// Noise of the quadrature between seams, relative to the larger of the load and 1.
const NOISE: f64 = 1e-11;

impl Hydrodynamics for Bem {
    fn description(&self) -> ModelDescription<'_> {
        let smallest = self.pieces.smallest(self.level);
        ModelDescription {
            ratio: self.pieces.ratio(),
            range: GapRange::from(smallest),
            cutoff: None,
            seams: &self.pieces.seams()[self.pieces.of(smallest.next_up())..],
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

    fn interacting_loads_of_each(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<[ActiveLoads; 2], SceneError> {
        Ok(self.solve_each(gap, set)?.loads)
    }

    /// The largest of [`Bem::error_estimates`], each relative to the larger of its load and 1; of unlike spheres over the loads by either.
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        if !self.has_unlike_radii() {
            return Ok(Some(self.solve_with_estimate(gap, set)?.1));
        }
        let (solution, estimates) = self.solve_each_with_estimates(gap, set)?;
        let both = estimates.iter().zip(&solution.loads);
        let largest = both.map(|(of, loads)| of.largest_of(loads));
        Ok(Some(largest.fold(0.0, f64::max)))
    }

    fn fingerprint(&self) -> String {
        let ratio = if self.has_unlike_radii() {
            format!(" ratio {:?}", self.pieces.ratio())
        } else {
            String::new()
        };
        format!("bem level {}{ratio} revision {REVISION}", self.level)
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

fn failure(error: BemError) -> SceneError {
    SceneError::from_model("bem", error)
}
