//! Loads of two spheres of unlike radii in the pair frame. Signs are those of [`scene::active_loads`].
//!
//! Each sphere k has a frame of its own with its radius `a_k` for the unit of length and the other sphere on the side of `+z`; that of sphere 2 is
//! mirrored. The single layer over a sphere of radius a is a times that over the unit sphere, so that the unknowns are
//! `g = a f`, and a system is, with the mirror M and the place `x'` of a target in the frame of the other sphere,
//!
//! ```text
//! u(x_k) = S_k(x_k) g_k + M S_l(x_k') g_l,   x' = (x, y, 1 + q + gap/a_k - z)/q,   q = a_l/a_k.
//! ```
//!
//! The mirrors x and y split it by kind of motion. One factorisation of each gives the densities of the rigid motions of either sphere.

use std::time::Instant;

use nalgebra::Vector3;
use rayon::prelude::*;
use scene::LoadSet;

use super::active::{Active, Responses};
use super::assembly::{Unknowns, gathered, zeros};
use super::condition::Condition;
use super::equal::FARTHEST;
use super::parity::Motion;
use super::response::Slips;
use super::side::Side;
use super::solution::{EachSolution, Seconds, added_up};
use super::systems::{Densities, Velocities};
use crate::BemError;
use crate::dense::solve_all;
use crate::mesh::{Grading, MeshFamily};
use crate::surface::{Block, Work, mirror_gap, mirrored_z};

/// Meshes of two spheres for a range of gaps, each of one topology.
#[derive(Clone, Debug)]
pub struct UnlikeMeshes<const H: usize = 6> {
    ratio: f64,
    smallest: f64,
    families: [MeshFamily<H>; 2],
}

impl<const H: usize> UnlikeMeshes<H> {
    /// Meshes that follow `law(e)` on spheres whose radii are in the given `ratio`, for the gaps `smallest <= gap <= largest` (in radii of sphere 1).
    ///
    /// Each sphere has the mesh that it has beside its mirror image, at the gap of that ([`mirror_gap`]), from the smallest to the largest of which
    /// `law` is asked for. There the width of the gap is
    /// `2 q/(1 + q)` times the true one, both in its own radii, and panels that are tied to the width are tied to the true one.
    ///
    /// # Errors
    /// As [`MeshFamily::new`].
    pub fn new(
        ratio: f64,
        law: impl Fn([f64; 2]) -> (Grading, f64),
        gaps: [f64; 2],
    ) -> Result<Self, BemError> {
        let family = |[own, other]: [f64; 2]| {
            let ends = gaps.map(|gap| mirror_gap(gap, [own, other]));
            let (law, largest) = law(ends);
            let law = Grading {
                width: law.width * 0.5 * (1.0 + own / other),
                ..law
            };
            MeshFamily::new(law, ends[0], largest)
        };
        Ok(Self {
            ratio,
            smallest: gaps[0],
            families: [family([1.0, ratio])?, family([ratio, 1.0])?],
        })
    }

    /// Meshes of the two spheres.
    #[must_use]
    pub fn families(&self) -> &[MeshFamily<H>; 2] {
        &self.families
    }

    /// The same, to keep.
    pub(crate) fn into_families(self) -> [MeshFamily<H>; 2] {
        self.families
    }

    /// Its own radius and that of the other, for each sphere.
    fn radii(&self) -> [[f64; 2]; 2] {
        [[1.0, self.ratio], [self.ratio, 1.0]]
    }
}

/// The loads of `set` at the gap `eps` (in radii of sphere 1) by either sphere, sums and differences alike.
///
/// # Errors
/// [`BemError::Residual`] if a dense system could not be solved.
pub fn solve_unlike<const H: usize>(
    meshes: &UnlikeMeshes<H>,
    eps: f64,
    set: LoadSet,
) -> Result<EachSolution, BemError> {
    let start = Instant::now();
    let systems = Systems::new(meshes, eps, motions(set));
    let assembly = start.elapsed().as_secs_f64();
    let solved = (systems.classes.par_iter().zip(&systems.matrices))
        .map(|(class, matrix)| class.responses(matrix, &systems.sides, set))
        .collect::<Result<Vec<_>, _>>()?;
    let solve = start.elapsed().as_secs_f64() - assembly;
    let (solved, [factorisation, substitution]) = added_up(solved);
    let of = |motion| {
        let place = systems.classes.iter().position(|c| c.motion == motion);
        place.map(|place| &solved[place])
    };
    let found = Motion::ALL.map(of);
    Ok(EachSolution {
        loads: [0, 1].map(|k| {
            let [own, other] = meshes.radii()[k];
            Active {
                found,
                k,
                q: other / own,
            }
            .loads(set)
        }),
        nodes: meshes.families.each_ref().map(MeshFamily::node_count),
        solves: systems.classes.len(),
        seconds: Seconds {
            assembly,
            solve,
            factorisation,
            substitution,
        },
        work: systems.work,
    })
}

/// Condition numbers of the systems that [`solve_unlike`] solves.
///
/// # Errors
/// [`BemError::SingularValues`] if they cannot be found.
pub fn conditions_unlike<const H: usize>(
    meshes: &UnlikeMeshes<H>,
    eps: f64,
    set: LoadSet,
) -> Result<Vec<Condition>, BemError> {
    let systems = Systems::new(meshes, eps, motions(set));
    let [one, two] = &systems.sides;
    (systems.classes.par_iter().zip(systems.matrices))
        .map(|(class, matrix)| {
            let [a, b] = &class.unknowns;
            Condition::new(None, matrix, &[(a, one), (b, two)])
        })
        .collect()
}

/// The kinds of motion that a set of loads calls for.
fn motions(set: LoadSet) -> impl Iterator<Item = Motion> {
    Motion::ALL
        .into_iter()
        .filter(move |motion| motion.is_in(set))
}

/// The unknowns of both spheres for one kind of motion, those of sphere 1 first.
struct Class {
    motion: Motion,
    unknowns: [Unknowns; 2],
}

/// The systems of some kinds of motion.
pub struct Systems<'a, const H: usize> {
    /// The spheres.
    pub sides: [Side<'a, H>; 2],
    classes: Vec<Class>,
    /// Row by row.
    matrices: Vec<Vec<f64>>,
    work: Work,
}

impl<'a, const H: usize> Systems<'a, H> {
    /// Assembles the systems of the kinds of motion at the gap `eps`.
    pub fn new(
        meshes: &'a UnlikeMeshes<H>,
        eps: f64,
        motions: impl Iterator<Item = Motion>,
    ) -> Self {
        let eps = eps.min(FARTHEST);
        let radii = meshes.radii();
        let sides = [0, 1].map(|k| Side::new(&meshes.families[k], mirror_gap(eps, radii[k])));
        let classes: Vec<Class> = motions
            .map(|motion| Class {
                motion,
                unknowns: sides.each_ref().map(|side| Unknowns::new(motion, side)),
            })
            .collect();
        let across = [0, 1].map(|k| Across {
            radii: radii[k],
            gaps: [eps, meshes.smallest],
        });
        let (matrices, work) = assemble(&sides, &across, &classes);
        Self {
            sides,
            classes,
            matrices,
            work,
        }
    }

    /// What each velocity of both surfaces adds to the densities by its part in the kind of motion `k`. Both spheres' numbers are in their own
    /// frames.
    ///
    /// # Errors
    /// [`BemError::Residual`] if the dense system could not be solved.
    pub fn densities(
        &self,
        k: usize,
        velocities: &[Velocities],
    ) -> Result<Vec<Densities>, BemError> {
        let class = &self.classes[k];
        let right: Vec<Vec<f64>> = (velocities.iter())
            .map(|both| {
                let of = |sphere: usize| {
                    class.unknowns[sphere].right_hand_side(&self.sides[sphere], |y| {
                        class.motion.part(|y| both[sphere](y), y)
                    })
                };
                [of(0), of(1)].concat()
            })
            .collect();
        let solved = solve_all(&self.matrices[k], &right)?;
        let all = |density: &Vec<f64>| {
            let (one, two) = density.split_at(class.first()[1]);
            let of = |sphere: usize, density| {
                class.unknowns[sphere].at_all_nodes(&self.sides[sphere], density)
            };
            [of(0, one), of(1, two)]
        };
        Ok(solved.x.iter().map(all).collect())
    }

    /// How many systems there are, and the kind of motion of each.
    pub fn motions(&self) -> Vec<Motion> {
        self.classes.iter().map(|class| class.motion).collect()
    }
}

/// The way from a sphere's frame to that of the other one.
struct Across {
    /// Its own radius and that of the other.
    radii: [f64; 2],
    /// The gap, here and in the reference geometry, in the unit of the radii.
    gaps: [f64; 2],
}

impl Across {
    fn at(&self, points: [Vector3<f64>; 2]) -> [Vector3<f64>; 2] {
        let [own, other] = self.radii;
        let q = other / own;
        let place = |k: usize| mirrored_z(&points[k], 1.0 + q + self.gaps[k] / own) / q;
        [place(0), place(1)]
    }
}

/// Matrices of all kinds of motion.
fn assemble<const H: usize>(
    sides: &[Side<'_, H>; 2],
    across: &[Across; 2],
    classes: &[Class],
) -> (Vec<Vec<f64>>, Work) {
    const MIRROR: [f64; 3] = [1.0, 1.0, -1.0];
    let counts = sides.each_ref().map(|s| s.orbits.representatives.len());
    let weights: Vec<[Vec<f64>; 2]> = (classes.iter())
        .map(|class| [0, 1].map(|k| class.unknowns[k].deflation(&sides[k])))
        .collect();
    gathered(counts[0] + counts[1], classes.len(), |target| {
        let k = usize::from(target >= counts[0]);
        let i = target - if k == 1 { counts[0] } else { 0 };
        let [side, beyond] = [&sides[k], &sides[1 - k]];
        let vertex = side.orbits.representatives[i];
        let mut work = Work::default();
        let own = side.at_node(vertex, &mut work);
        let other: Vec<Block> = beyond.at_point(across[k].at(side.node(vertex)), &mut work);
        let rows = (classes.iter().zip(&weights))
            .map(|(class, weights)| {
                let first = class.first();
                let mut rows = zeros(class.count());
                let unknowns = &class.unknowns[k];
                unknowns.fold(side, |v, a, c| own[v][a][c], first[k], &mut rows);
                unknowns.deflate(side, &weights[k], i, first[k], &mut rows);
                let entry = |v: usize, a: usize, c: usize| MIRROR[a] * other[v][a][c];
                class.unknowns[1 - k].fold(beyond, entry, first[1 - k], &mut rows);
                unknowns.wanted(i, &rows)
            })
            .collect();
        (rows, work)
    })
}

impl Class {
    fn count(&self) -> usize {
        self.unknowns.iter().map(|of| of.list.len()).sum()
    }

    /// The first unknown of each sphere.
    fn first(&self) -> [usize; 2] {
        [0, self.unknowns[0].list.len()]
    }

    /// Responses to the rigid motions of either sphere, and the seconds of factorisation and substitution.
    fn responses<const H: usize>(
        &self,
        matrix: &[f64],
        sides: &[Side<'_, H>; 2],
        set: LoadSet,
    ) -> Result<(Responses, [f64; 2]), BemError> {
        let count = self.count();
        let first = self.first();
        let moved = [0, 1].map(|k| self.unknowns[k].right_hand_sides(&sides[k]));
        let right: Vec<Vec<f64>> = (moved.iter().zip(first))
            .flat_map(|(of, first)| {
                of.iter()
                    .map(move |velocity| padded(velocity, first, count))
            })
            .collect();
        let solved = solve_all(matrix, &right)?;
        let slips = sides
            .each_ref()
            .map(|side| Slips::new(self.motion, set, &side.surface));
        let response = |density: &Vec<f64>| {
            let (one, two) = density.split_at(first[1]);
            let of = |k: usize, density| self.unknowns[k].response(density, &slips[k], &sides[k]);
            [of(0, one), of(1, two)]
        };
        let (one, two) = solved.x.split_at(moved[0].len());
        let responses = [one, two].map(|of| of.iter().map(response).collect());
        Ok((responses, [solved.factorisation, solved.substitution]))
    }
}

/// Numbers from the place `first` on of a row of `count`, zeros elsewhere.
fn padded(numbers: &[f64], first: usize, count: usize) -> Vec<f64> {
    let mut row = vec![0.0; count];
    row[first..first + numbers.len()].copy_from_slice(numbers);
    row
}
