//! The meshes of one level, and what they make of a lone sphere.
//!
//! Beyond the last seam mesh and density are one and fixed, and loads are shifted so that they tend to those of lone spheres
//! as the gap grows:
//!
//! ```text
//! loads(gap) = completed(gap) - completed(infinity) + isolated,
//! completed = solved + loads of the rigid motions that lone squirmers lack on the mesh ([`Missing`]).
//! ```
//!
//! The mesh is not the same all around the sphere, so that it turns a lone squirmer that does not swim along the line
//! of centres, and gives it another speed than that of the closed form. As an error of a load this is small, but it does not fall with the
//! distance as all that the spheres do to each other does: a pair flown to infinity would turn for ever. The
//! error of the lone sphere is the same at every gap, and the difference is free of it. Without the missing motions squirmers at the
//! right speed would not be free of force on the mesh, and errors would fall as `1/r` instead of its square.
//!
//! Unlike spheres have this mesh too, both of them, so that far apart the shift of each is that of equal ones.

use std::sync::{Mutex, PoisonError};

use scene::{ActiveLoads, LoadSet, PairLoads, SelfOther, SwirlLoads};

use crate::BemError;
use crate::mesh::MeshFamily;
use crate::missing::{Missing, crossed};
use crate::pair::{self, Condition, EachSolution, Motion, PairSolution, Systems, UnlikeMeshes};
use crate::pieces::Pieces;

/// Meshes from the smallest gaps to the largest, with the solutions for spheres infinitely far apart.
#[derive(Debug)]
pub(crate) struct Refinement {
    meshes: Meshes,
    /// Found when they are first asked for, by sets of loads.
    shifts: Mutex<Vec<Shift>>,
}

/// Meshes of a pair, piece by piece.
#[derive(Debug)]
enum Meshes {
    Equal(Vec<MeshFamily>),
    Unlike(Vec<UnlikeMeshes>),
}

impl Meshes {
    /// That of sphere 1 in a piece; that of the largest gaps is the same for both.
    fn first(&self, piece: usize) -> &MeshFamily {
        match self {
            Self::Equal(families) => &families[piece],
            Self::Unlike(meshes) => &meshes[piece].families()[0],
        }
    }

    fn count(&self) -> usize {
        match self {
            Self::Equal(families) => families.len(),
            Self::Unlike(meshes) => meshes.len(),
        }
    }
}

/// What is added to the loads of a set on the mesh of the largest gaps.
#[derive(Clone, Copy, Debug)]
struct Shift {
    set: LoadSet,
    /// The velocities that the mesh gives lone squirmers wrongly.
    missing: Missing,
    loads: PairLoads,
    swirl: SwirlLoads,
}

impl Refinement {
    /// The meshes of a level for spheres of these pieces.
    ///
    /// # Errors
    /// As [`MeshFamily::new`].
    pub fn new(level: i32, pieces: &Pieces) -> Result<Self, BemError> {
        let meshes = if pieces.are_equal() {
            Meshes::Equal(pieces.families(level)?)
        } else {
            Meshes::Unlike(pieces.unlike(level)?)
        };
        Ok(Self {
            meshes,
            shifts: Mutex::default(),
        })
    }

    /// The meshes of sphere 1 in a piece.
    pub fn family(&self, piece: usize) -> &MeshFamily {
        self.meshes.first(piece)
    }

    /// The loads of sphere 1 at the gap `eps`, which lies in `piece`, and the number of systems factorised for them. A system
    /// of lone spheres counts once, when it is first solved.
    ///
    /// # Errors
    /// [`BemError::Residual`] if a dense system could not be solved.
    pub fn solve(
        &self,
        piece: usize,
        eps: f64,
        set: LoadSet,
    ) -> Result<(PairSolution, usize), BemError> {
        let Meshes::Equal(families) = &self.meshes else {
            let (solution, factorised) = self.solve_each(piece, eps, set)?;
            return Ok((solution.into(), factorised));
        };
        let mut solution = pair::solve(&families[piece], eps, set)?;
        let mut factorised = solution.solves;
        if piece + 1 == families.len() {
            let (shift, solves) = self.shift(set)?;
            factorised += solves;
            let crossed = crossed(&solution.loads);
            shift.add_to(&mut solution.loads, &mut solution.swirl, crossed);
        }
        Ok((solution, factorised))
    }

    /// The loads by either sphere; of unlike spheres those of a pair without symmetry.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub fn solve_each(
        &self,
        piece: usize,
        eps: f64,
        set: LoadSet,
    ) -> Result<(EachSolution, usize), BemError> {
        let Meshes::Unlike(meshes) = &self.meshes else {
            let (solution, factorised) = self.solve(piece, eps, set)?;
            return Ok((solution.into(), factorised));
        };
        let set = set.of_any_pair();
        let mut solution = pair::solve_unlike(&meshes[piece], eps, set)?;
        let mut factorised = solution.solves;
        if piece + 1 == meshes.len() {
            let (shift, solves) = self.shift(set)?;
            factorised += solves;
            for ActiveLoads {
                pair,
                torque_on_other,
                swirl,
            } in &mut solution.loads
            {
                let crossed = SelfOther::new(pair.yb.own(), *torque_on_other);
                shift.add_to(pair, swirl, crossed);
            }
        }
        Ok((solution, factorised))
    }

    /// Condition numbers of the systems that are solved at the gap `eps`.
    ///
    /// # Errors
    /// [`BemError::SingularValues`] if they cannot be found.
    pub fn conditions(
        &self,
        piece: usize,
        eps: f64,
        set: LoadSet,
    ) -> Result<Vec<Condition>, BemError> {
        match &self.meshes {
            Meshes::Equal(families) => pair::conditions(&families[piece], eps, set),
            Meshes::Unlike(meshes) => pair::conditions_unlike(&meshes[piece], eps, set),
        }
    }

    /// The systems of some kinds of motion at the gap `eps`, which lies in `piece`.
    pub fn systems(&self, piece: usize, eps: f64, motions: &[Motion]) -> Systems<'_, 6> {
        match &self.meshes {
            Meshes::Equal(families) => Systems::equal(&families[piece], eps, motions),
            Meshes::Unlike(meshes) => Systems::unlike(&meshes[piece], eps, motions),
        }
    }

    /// The shift of a set, and the systems that were factorised for it if it is new.
    fn shift(&self, set: LoadSet) -> Result<(Shift, usize), BemError> {
        let known = |shifts: &Vec<Shift>| shifts.iter().find(|shift| shift.set == set).copied();
        let shifts = || self.shifts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(shift) = known(&shifts()) {
            return Ok((shift, 0));
        }
        // Not under the lock: a thread that waits for its part of this solve may take up another gap in between,
        // and would wait for itself. Threads that come here at once find the same bits.
        let family = self.family(self.meshes.count() - 1);
        let solution = pair::solve(family, f64::INFINITY, set)?;
        let new = Shift::of(set, &solution);
        let mut shifts = shifts();
        Ok(match known(&shifts) {
            Some(shift) => (shift, 0),
            None => {
                shifts.push(new);
                (new, solution.solves)
            }
        })
    }
}

impl Shift {
    /// From the solution for spheres infinitely far apart.
    fn of(set: LoadSet, solution: &PairSolution) -> Self {
        let missing = Missing::of(&solution.loads, &solution.swirl);
        let (mut loads, mut swirl) = (solution.loads, solution.swirl);
        missing.add_to(&mut loads, &mut swirl, crossed(&solution.loads));
        let loads: Vec<f64> = (PairLoads::isolated(set).columns())
            .zip(loads.columns())
            .map(|(isolated, solved)| isolated - solved)
            .collect();
        let swirl: Vec<f64> = (SwirlLoads::isolated(set).columns())
            .zip(swirl.columns())
            .map(|(isolated, solved)| isolated - solved)
            .collect();
        Self {
            set,
            missing,
            loads: PairLoads::from_columns(set, set, &loads),
            swirl: SwirlLoads::from_columns(set, &swirl),
        }
    }

    fn add_to(&self, loads: &mut PairLoads, swirl: &mut SwirlLoads, crossed: SelfOther) {
        self.missing.add_to(loads, swirl, crossed);
        *loads += &self.loads;
        *swirl += &self.swirl;
    }
}
