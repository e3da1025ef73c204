//! Loads of two equal spheres in the pair frame, from systems halved by the swap. Signs are those of [`scene::loads`].
//!
//! ```text
//! A_ij = Σ_g χ(g) [ S(x_i, g x_j) + s M S(M x_i, g x_j) ] R_g
//! ```
//!
//! with the swap's parity s and its mirror M. Sphere 2 does the mirror image of sphere 1 (or its opposite), and the load on
//! sphere 1 is the sum or the difference of the scalars for itself and for the other one: transverse
//! forces and axial torques add up for the mirror image, axial forces and transverse torques, which
//! the mirror reverses, for its opposite.

use std::f64::consts::PI;
use std::time::Instant;

use nalgebra::Vector3;
use rayon::prelude::*;
use scene::{LoadSet, PairLoads, SelfOther, SwirlLoads};

use super::assembly::{Unknowns, gathered, zeros};
use super::condition::Condition;
use super::parity::{Motion, Parity, Swap};
use super::response::{Response, Slips};
use super::side::Side;
use super::solution::{PairSolution, Seconds, added_up};
use super::systems::{Densities, Velocities};
use crate::BemError;
use crate::dense::solve_all;
use crate::mesh::MeshFamily;
use crate::surface::{Work, mirrored_z};

/// Beyond this the spheres are alone to rounding; it keeps squares finite.
pub const FARTHEST: f64 = 1e15;

/// The loads of `set` at the gap `eps`, with the meshes of `family`.
///
/// # Errors
/// [`BemError::Residual`] if a dense system could not be solved.
pub fn solve<const H: usize>(
    family: &MeshFamily<H>,
    eps: f64,
    set: LoadSet,
) -> Result<PairSolution, BemError> {
    let start = Instant::now();
    let Systems {
        side,
        classes,
        matrices,
        work,
    } = Systems::new(family, eps, parities(set));
    let assembly = start.elapsed().as_secs_f64();
    let solved = classes
        .par_iter()
        .zip(matrices)
        .map(|(class, matrix)| class.responses(&matrix, &side, set))
        .collect::<Result<Vec<_>, _>>()?;
    let solve = start.elapsed().as_secs_f64() - assembly;
    let (solved, [factorisation, substitution]) = added_up(solved);
    let parities: Vec<Parity> = classes.iter().map(|class| class.parity).collect();
    let (loads, swirl) = collect(&parities, &solved, set);
    Ok(PairSolution {
        loads,
        swirl,
        nodes: family.node_count(),
        solves: classes.len(),
        seconds: Seconds {
            assembly,
            solve,
            factorisation,
            substitution,
        },
        work,
    })
}

/// Condition numbers of the systems that [`solve`] solves.
///
/// # Errors
/// [`BemError::SingularValues`] if they cannot be found.
pub fn conditions<const H: usize>(
    family: &MeshFamily<H>,
    eps: f64,
    set: LoadSet,
) -> Result<Vec<Condition>, BemError> {
    let systems = Systems::new(family, eps, parities(set));
    (systems.classes.par_iter().zip(systems.matrices))
        .map(|(class, matrix)| {
            let swap = Some(class.parity.swap);
            Condition::new(swap, matrix, &[(&class.unknowns, &systems.side)])
        })
        .collect()
}

/// The classes that a set of loads calls for.
fn parities(set: LoadSet) -> impl Iterator<Item = Parity> {
    Parity::ALL
        .into_iter()
        .filter(move |parity| parity.is_in(set))
}

/// One symmetry class.
struct Class {
    parity: Parity,
    unknowns: Unknowns,
}

/// The systems of some classes.
pub struct Systems<'a, const H: usize> {
    /// Either sphere.
    pub side: Side<'a, H>,
    classes: Vec<Class>,
    /// Row by row.
    matrices: Vec<Vec<f64>>,
    work: Work,
}

impl<'a, const H: usize> Systems<'a, H> {
    /// Assembles the systems of the classes at the gap `eps`.
    pub fn new(
        family: &'a MeshFamily<H>,
        eps: f64,
        parities: impl Iterator<Item = Parity>,
    ) -> Self {
        let eps = eps.min(FARTHEST);
        let side = Side::new(family, eps);
        let classes: Vec<Class> = parities
            .map(|parity| Class {
                parity,
                unknowns: Unknowns::new(parity.motion, &side),
            })
            .collect();
        let (matrices, work) = assemble(&side, &classes, [2.0 + eps, 2.0 + family.smallest]);
        Self {
            side,
            classes,
            matrices,
            work,
        }
    }

    /// What each velocity of both surfaces adds to the densities by its part in the class `k`. Both spheres' numbers are in their own frames.
    ///
    /// The velocities `u1`, `u2` have the part `(u1 + s u2)/2` on sphere 1, and s times its mirror image on sphere 2.
    ///
    /// # Errors
    /// [`BemError::Residual`] if the dense system could not be solved.
    pub fn densities(
        &self,
        k: usize,
        velocities: &[Velocities],
    ) -> Result<Vec<Densities>, BemError> {
        let Class { parity, unknowns } = &self.classes[k];
        let swap = if parity.swap == Swap::Mirrored {
            1.0
        } else {
            -1.0
        };
        let right: Vec<Vec<f64>> = (velocities.iter())
            .map(|[one, two]| {
                let half = |y: &Vector3<f64>| (one(y) + two(y) * swap) * 0.5;
                unknowns.right_hand_side(&self.side, |y| parity.motion.part(half, y))
            })
            .collect();
        let solved = solve_all(&self.matrices[k], &right)?;
        let all = |density: &Vec<f64>| {
            let one = unknowns.at_all_nodes(&self.side, density);
            let two = one.iter().map(|f| f * swap).collect();
            [one, two]
        };
        Ok(solved.x.iter().map(all).collect())
    }

    /// How many classes there are, and the kind of motion of each.
    pub fn motions(&self) -> Vec<Motion> {
        self.classes
            .iter()
            .map(|class| class.parity.motion)
            .collect()
    }
}

/// Matrices of all classes for spheres whose centres are `distances` apart, here and in the reference geometry.
fn assemble<const H: usize>(
    side: &Side<'_, H>,
    classes: &[Class],
    distances: [f64; 2],
) -> (Vec<Vec<f64>>, Work) {
    let weights: Vec<Vec<f64>> = (classes.iter())
        .map(|class| class.unknowns.deflation(side))
        .collect();
    gathered(side.orbits.representatives.len(), classes.len(), |i| {
        let vertex = side.orbits.representatives[i];
        let mut work = Work::default();
        let own = side.at_node(vertex, &mut work);
        let [point, reference] = side.node(vertex);
        let mirrored = [
            mirrored_z(&point, distances[0]),
            mirrored_z(&reference, distances[1]),
        ];
        let other = side.at_point(mirrored, &mut work);
        let rows = (classes.iter().zip(&weights))
            .map(|(Class { parity, unknowns }, weights)| {
                let swap = parity.swap_signs();
                let entry = |v: usize, a: usize, c: usize| own[v][a][c] + swap[a] * other[v][a][c];
                let mut rows = zeros(unknowns.list.len());
                unknowns.fold(side, entry, 0, &mut rows);
                unknowns.deflate(side, weights, i, 0, &mut rows);
                unknowns.wanted(i, &rows)
            })
            .collect();
        (rows, work)
    })
}

impl Class {
    /// Responses to the translation and the rotation of the class, those that it has, and the seconds of
    /// factorisation and substitution.
    fn responses<const H: usize>(
        &self,
        matrix: &[f64],
        side: &Side<'_, H>,
        set: LoadSet,
    ) -> Result<(Vec<Response>, [f64; 2]), BemError> {
        let solved = solve_all(matrix, &self.unknowns.right_hand_sides(side))?;
        let slips = Slips::new(self.parity.motion, set, &side.surface);
        let response = |density: &Vec<f64>| self.unknowns.response(density, &slips, side);
        let responses = solved.x.iter().map(response).collect();
        Ok((responses, [solved.factorisation, solved.substitution]))
    }
}

/// The scalars of self and other from the two swaps, `solved` in the order of `parities`.
fn collect(parities: &[Parity], solved: &[Vec<Response>], set: LoadSet) -> (PairLoads, SwirlLoads) {
    // What is not in the set was not solved: it is left as that of lone spheres.
    let of = |motion: Motion, swap: Swap, column: usize, part: &dyn Fn(&Response) -> f64| {
        let parity = Parity { motion, swap };
        let place = parities.iter().position(|&p| p == parity);
        place.map(|place| part(&solved[place][column]))
    };
    let fill = |load: &mut SelfOther,
                motion,
                adds: Swap,
                column: usize,
                unit: f64,
                part: &dyn Fn(&Response) -> f64| {
        let mirrored = of(motion, Swap::Mirrored, column, part);
        let opposite = of(motion, Swap::Opposite, column, part);
        let (sum, difference) = match adds {
            Swap::Mirrored => (mirrored, opposite),
            Swap::Opposite => (opposite, mirrored),
        };
        load.sum = sum.map_or(load.sum, |sum| sum / unit);
        load.difference = difference.map_or(load.difference, |difference| difference / unit);
    };
    let (force, torque) = (&|r: &Response| r.force, &|r: &Response| r.torque);
    use Motion::{Axial, Transverse, Twist};
    use Swap::{Mirrored, Opposite};
    let mut loads = PairLoads::isolated(set);
    fill(&mut loads.xa, Axial, Opposite, 0, -6.0 * PI, force);
    fill(&mut loads.ya, Transverse, Mirrored, 0, -6.0 * PI, force);
    fill(&mut loads.yb, Transverse, Mirrored, 1, 4.0 * PI, force);
    fill(&mut loads.yc, Transverse, Opposite, 1, -8.0 * PI, torque);
    fill(&mut loads.xc, Twist, Mirrored, 0, -8.0 * PI, torque);
    for (k, mode) in loads.modes_mut().iter_mut().enumerate() {
        let slip = &|r: &Response| r.slip[k];
        fill(&mut mode.xf, Axial, Opposite, 0, PI, slip);
        fill(&mut mode.yf, Transverse, Mirrored, 0, PI, slip);
        fill(&mut mode.yt, Transverse, Opposite, 1, PI, slip);
    }
    let mut by_swirl = SwirlLoads::zero(set);
    for (k, mode) in by_swirl.modes_mut().iter_mut().enumerate() {
        let swirl = &|r: &Response| r.swirl[k];
        fill(&mut mode.xtc, Twist, Mirrored, 0, PI, swirl);
        fill(&mut mode.yfc, Transverse, Mirrored, 0, PI, swirl);
        // Along p_t, which is -y.
        fill(&mut mode.ytc, Transverse, Opposite, 1, -PI, swirl);
    }
    (loads, by_swirl)
}
