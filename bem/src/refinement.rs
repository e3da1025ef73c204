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

use std::sync::{Mutex, PoisonError};

use scene::{LoadSet, PairLoads, SwirlLoads};

use crate::BemError;
use crate::mesh::MeshFamily;
use crate::missing::Missing;
use crate::pair::{self, PairSolution};

/// Meshes from the smallest gaps to the largest, with the solutions for spheres infinitely far apart.
#[derive(Debug)]
pub(crate) struct Refinement {
    families: Vec<MeshFamily>,
    /// Found when they are first asked for, by sets of loads.
    shifts: Mutex<Vec<Shift>>,
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
    /// Of meshes of which the last serves for gaps without end.
    pub fn new(families: Vec<MeshFamily>) -> Self {
        Self {
            families,
            shifts: Mutex::default(),
        }
    }

    /// The meshes of a piece.
    pub fn family(&self, piece: usize) -> &MeshFamily {
        &self.families[piece]
    }

    /// The loads at the gap `eps`, which lies in `piece`, and the number of systems factorised for them. A system
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
        let mut solution = pair::solve(self.family(piece), eps, set)?;
        let mut factorised = solution.solves;
        if piece + 1 == self.families.len() {
            let (shift, solves) = self.shift(set)?;
            factorised += solves;
            shift.add_to(&mut solution.loads, &mut solution.swirl);
        }
        Ok((solution, factorised))
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
        let family = self.family(self.families.len() - 1);
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
        missing.add_to(&mut loads, &mut swirl);
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

    fn add_to(&self, loads: &mut PairLoads, swirl: &mut SwirlLoads) {
        self.missing.add_to(loads, swirl);
        *loads += &self.loads;
        *swirl += &self.swirl;
    }
}
