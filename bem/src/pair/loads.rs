//! Right-hand sides, solves and loads in the pair frame. Signs are those of [`scene::loads`].
//!
//! Only rigid motions are solved. The loads of slip follow from the reciprocal theorem (Stone & Samuel,
//! *Phys. Rev. Lett.* 77 (1996) 4102): with the traction `-f` (up to a constant pressure, which
//! tangential slip does not see) of a rigid motion U, Ω,
//!
//! ```text
//! F.U + T.Ω = -∫ u_slip.f dS.
//! ```
//!
//! With the swap, sphere 2 does the mirror image of sphere 1 (or its opposite), and the load on
//! sphere 1 is the sum or the difference of the scalars for itself and for the other one: transverse
//! forces and axial torques add up for the mirror image, axial forces and transverse torques, which
//! the mirror reverses, for its opposite.

use std::f64::consts::PI;
use std::time::Instant;

use nalgebra::Vector3;
use rayon::prelude::*;
use scene::{LoadSet, PairLoads, SelfOther, SwirlLoads};

use super::assembly::{Class, assemble};
use super::parity::{Motion, Parity, Swap};
use crate::dense::{condition, solve_all};
use crate::mesh::{MeshFamily, Nodes};
use crate::surface::{Profile, Surface, Work};
use crate::{BemError, slip};

/// Time of the parts of a solve, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seconds {
    /// Quadrature and assembly, by the clock.
    pub assembly: f64,
    /// Factorisation and substitution, by the clock.
    pub solve: f64,
    /// Factorisation, added up over the systems, which are solved side by side.
    pub factorisation: f64,
    /// Substitution with the check of the residual, added up likewise.
    pub substitution: f64,
}

/// Loads of a pair at one gap, and what they took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairSolution {
    /// The loads.
    pub loads: PairLoads,
    /// Those by swirl.
    pub swirl: SwirlLoads,
    /// Nodes on each sphere: vertices and middles of edges.
    pub nodes: usize,
    /// Dense systems factorised.
    pub solves: usize,
    /// Wall-clock time.
    pub seconds: Seconds,
    /// What assembly was spent on.
    pub work: Work,
}

/// Beyond this the spheres are alone to rounding; it keeps squares finite.
const FARTHEST: f64 = 1e15;

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
        surface,
        classes,
        matrices,
        work,
    } = systems(family, eps, set);
    let assembly = start.elapsed().as_secs_f64();
    let solved = classes
        .par_iter()
        .zip(matrices)
        .map(|(class, matrix)| class.responses(&matrix, &surface, family, set))
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

/// How a symmetry class's system is conditioned: largest over smallest singular value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// The class.
    pub parity: Parity,
    /// Of the matrix that is solved.
    pub solved: f64,
    /// Of the axial classes without the term that fixes the multiple of the normal in the density, which
    /// induces no flow (Pozrikidis 1992, section 4.2).
    pub without_deflation: Option<f64>,
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
    let systems = systems(family, eps, set);
    let orbits = family.orbits();
    (systems.classes.par_iter().zip(systems.matrices))
        .map(|(class, mut matrix)| {
            let solved = condition(&matrix, class.unknowns.len())?;
            let weights: Vec<f64> = class.deflation(&systems.surface, orbits).collect();
            let without_deflation = if weights.is_empty() {
                None
            } else {
                let rows = matrix.chunks_exact_mut(weights.len());
                for (row, &(j, a)) in rows.zip(&class.unknowns) {
                    let normal = systems.surface.nodes()[orbits.representatives[j]];
                    for (entry, weight) in row.iter_mut().zip(&weights) {
                        *entry -= normal[a] * weight;
                    }
                }
                Some(condition(&matrix, weights.len())?)
            };
            Ok(Condition {
                parity: class.parity,
                solved,
                without_deflation,
            })
        })
        .collect()
}

/// The systems of the classes that a set of loads calls for.
struct Systems<const H: usize> {
    surface: Surface<H>,
    classes: Vec<Class>,
    /// Row by row.
    matrices: Vec<Vec<f64>>,
    work: Work,
}

fn systems<const H: usize>(family: &MeshFamily<H>, eps: f64, set: LoadSet) -> Systems<H> {
    let eps = eps.min(FARTHEST);
    let reference = family.at(family.smallest);
    // On one fixed mesh the density is one and fixed, too: what the mesh makes of a lone sphere must not change
    // with the gap.
    let profile = if family.largest.is_finite() {
        Profile::beside_mirror_image(eps)
    } else {
        Profile::alone()
    };
    let surface = Surface::<H>::new(
        (family.at(eps), profile),
        (&reference, Profile::beside_mirror_image(family.smallest)),
    );
    let orbits = family.orbits();
    let classes: Vec<Class> = (Parity::ALL.into_iter())
        .filter(|parity| parity.is_in(set))
        .map(|parity| Class::new(parity, surface.nodes(), orbits))
        .collect();
    let (matrices, work) = assemble(
        &surface,
        &Nodes::<H>::new(&reference).points,
        orbits,
        &classes,
        2.0 + eps,
        2.0 + family.smallest,
    );
    Systems {
        surface,
        classes,
        matrices,
        work,
    }
}

/// What the classes found, and the seconds of their factorisations and substitutions added up.
fn added_up(solved: Vec<(Vec<Response>, [f64; 2])>) -> (Vec<Vec<Response>>, [f64; 2]) {
    let mut seconds = [0.0; 2];
    let add = |(responses, [factorisation, substitution]): (Vec<Response>, [f64; 2])| {
        seconds[0] += factorisation;
        seconds[1] += substitution;
        responses
    };
    (solved.into_iter().map(add).collect(), seconds)
}

/// What the density of a rigid motion tells.
#[derive(Clone, Debug, Default)]
struct Response {
    /// Force on sphere 1 along the direction that the class allows.
    force: f64,
    /// Torque on sphere 1 likewise.
    torque: f64,
    /// By the reciprocal theorem, the load that each squirming mode exerts along the rigid motion.
    slip: Vec<f64>,
    /// The same for each swirl mode.
    swirl: Vec<f64>,
}

impl Class {
    /// Responses to the translation and the rotation of the class, those that it has, and the seconds of
    /// factorisation and substitution.
    fn responses<const H: usize>(
        &self,
        matrix: &[f64],
        surface: &Surface<H>,
        family: &MeshFamily<H>,
        set: LoadSet,
    ) -> Result<(Vec<Response>, [f64; 2]), BemError> {
        let orbits = family.orbits();
        let points: Vec<(Vector3<f64>, usize)> = self
            .unknowns
            .iter()
            .map(|&(j, c)| (surface.nodes()[orbits.representatives[j]], c))
            .collect();
        let right: Vec<Vec<f64>> = rigid_motions(self.parity.motion)
            .iter()
            .map(|u| points.iter().map(|(normal, c)| u(normal)[*c]).collect())
            .collect();
        let solved = solve_all(matrix, &right)?;
        let slips = slips(self.parity.motion, set, surface);
        let response = |density: &Vec<f64>| self.response(density, &slips, surface, family);
        let responses = solved.x.iter().map(response).collect();
        Ok((responses, [solved.factorisation, solved.substitution]))
    }

    fn response<const H: usize>(
        &self,
        density: &[f64],
        [squirming, swirling]: &[Vec<Slip>; 2],
        surface: &Surface<H>,
        family: &MeshFamily<H>,
    ) -> Response {
        let orbits = family.orbits();
        let mut force = Vector3::zeros();
        let mut torque = Vector3::zeros();
        let mut slip = vec![0.0; squirming.len()];
        let mut swirl = vec![0.0; swirling.len()];
        for (&(j, c), &value) in self.unknowns.iter().zip(density) {
            let vertex = orbits.representatives[j];
            let mut f = Vector3::zeros();
            f[c] = -value * orbits.sizes[j] as f64;
            let (df, dt) = surface.force_and_torque(vertex, &f);
            force += df;
            torque += dt;
            for (sum, weights) in slip.iter_mut().zip(squirming) {
                *sum += weights[vertex].dot(&f);
            }
            for (sum, weights) in swirl.iter_mut().zip(swirling) {
                *sum += weights[vertex].dot(&f);
            }
        }
        // Other components cancel over an orbit.
        let (force, torque) = match self.parity.motion {
            Motion::Axial => (force.z, 0.0),
            Motion::Transverse => (force.x, torque.y),
            Motion::Twist => (0.0, torque.z),
        };
        Response {
            force,
            torque,
            slip,
            swirl,
        }
    }
}

type Velocity = fn(&Vector3<f64>) -> Vector3<f64>;

/// Velocities of sphere 1's surface, in the order of [`Class::responses`].
fn rigid_motions(motion: Motion) -> &'static [Velocity] {
    match motion {
        Motion::Axial => &[|_| Vector3::z()],
        Motion::Transverse => &[|_| Vector3::x(), |normal| Vector3::y().cross(normal)],
        Motion::Twist => &[|normal| Vector3::z().cross(normal)],
    }
}

/// A slip velocity integrated with the hat functions, node by node.
type Slip = Vec<Vector3<f64>>;

/// Slip of each squirming mode, and of each swirl mode with `d x p_t = x`, that has the symmetry of a motion.
fn slips<const H: usize>(motion: Motion, set: LoadSet, surface: &Surface<H>) -> [Vec<Slip>; 2] {
    let (d, t, turned) = (Vector3::z(), Vector3::x(), -Vector3::y());
    let squirming = (1..=set.modes).filter_map(|n| match motion {
        Motion::Axial => Some(surface.tangential_part(|y| slip::axisymmetric(n, &d, y))),
        Motion::Transverse => Some(surface.tangential_part(|y| slip::transverse(n, &d, &t, y))),
        Motion::Twist => None,
    });
    let swirling = (1..=set.swirl).filter_map(|n| match motion {
        Motion::Axial => None,
        Motion::Transverse => {
            Some(surface.tangential_part(|y| slip::transverse_swirl(n, &d, &turned, y)))
        }
        Motion::Twist => Some(surface.tangential_part(|y| slip::axisymmetric_swirl(n, &d, y))),
    });
    [squirming.collect(), swirling.collect()]
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
