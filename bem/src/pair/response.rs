//! Right-hand sides, and what their densities tell of a sphere. Signs are those of [`scene::loads`].
//!
//! Only rigid motions are solved. The loads of slip follow from the reciprocal theorem (Stone & Samuel,
//! *Phys. Rev. Lett.* 77 (1996) 4102): with the traction `-f` (up to a constant pressure, which
//! tangential slip does not see) of a rigid motion U, Ω,
//!
//! ```text
//! F.U + T.Ω = -∫ u_slip.f dS.
//! ```

use nalgebra::Vector3;
use scene::LoadSet;

use super::assembly::Unknowns;
use super::parity::Motion;
use super::side::Side;
use crate::slip;
use crate::surface::Surface;

/// What the density on a sphere tells.
#[derive(Clone, Debug, Default)]
pub struct Response {
    /// Force on the sphere along the direction that the motion allows.
    pub force: f64,
    /// Torque on it likewise.
    pub torque: f64,
    /// By the reciprocal theorem, the load that each squirming mode of the sphere exerts along the rigid motion.
    pub slip: Vec<f64>,
    /// The same for each swirl mode.
    pub swirl: Vec<f64>,
}

type Velocity = fn(&Vector3<f64>) -> Vector3<f64>;

/// Velocities of a sphere's surface: translation, then rotation, those that the kind of motion has.
pub fn rigid_motions(motion: Motion) -> &'static [Velocity] {
    match motion {
        Motion::Axial => &[|_| Vector3::z()],
        Motion::Transverse => &[|_| Vector3::x(), |normal| Vector3::y().cross(normal)],
        Motion::Twist => &[|normal| Vector3::z().cross(normal)],
        Motion::Sideways => &[|_| Vector3::y(), |normal| Vector3::x().cross(normal)],
    }
}

/// A slip velocity integrated with the hat functions, node by node.
type Slip = Vec<Vector3<f64>>;

/// Slip of each squirming mode, and of each swirl mode with `d x p_t = x`, that has the symmetry of a motion.
pub struct Slips([Vec<Slip>; 2]);

impl Slips {
    /// Those of a set on a surface.
    pub fn new<const H: usize>(motion: Motion, set: LoadSet, surface: &Surface<H>) -> Self {
        let (d, t, turned) = (Vector3::z(), Vector3::x(), -Vector3::y());
        let squirming = (1..=set.modes).filter_map(|n| match motion {
            Motion::Axial => Some(surface.tangential_part(|y| slip::axisymmetric(n, &d, y))),
            Motion::Transverse => Some(surface.tangential_part(|y| slip::transverse(n, &d, &t, y))),
            Motion::Twist | Motion::Sideways => None,
        });
        let swirling = (1..=set.swirl).filter_map(|n| match motion {
            Motion::Axial | Motion::Sideways => None,
            Motion::Transverse => {
                Some(surface.tangential_part(|y| slip::transverse_swirl(n, &d, &turned, y)))
            }
            Motion::Twist => Some(surface.tangential_part(|y| slip::axisymmetric_swirl(n, &d, y))),
        });
        Self([squirming.collect(), swirling.collect()])
    }
}

impl Unknowns {
    /// The velocities by each rigid motion of the sphere, unknown by unknown.
    pub fn right_hand_sides<const H: usize>(&self, side: &Side<'_, H>) -> Vec<Vec<f64>> {
        rigid_motions(self.motion)
            .iter()
            .map(|u| self.right_hand_side(side, u))
            .collect()
    }

    /// The velocities of the sphere's surface, given at the unit normal, unknown by unknown.
    pub fn right_hand_side<const H: usize>(
        &self,
        side: &Side<'_, H>,
        velocity: impl Fn(&Vector3<f64>) -> Vector3<f64>,
    ) -> Vec<f64> {
        let at = |&(j, c): &(usize, usize)| {
            velocity(&side.surface.nodes()[side.orbits.representatives[j]])[c]
        };
        self.list.iter().map(at).collect()
    }

    /// The density at every node, from that of the unknowns.
    pub fn at_all_nodes<const H: usize>(
        &self,
        side: &Side<'_, H>,
        density: &[f64],
    ) -> Vec<Vector3<f64>> {
        let mut representatives = vec![Vector3::zeros(); side.orbits.representatives.len()];
        for (&(j, c), &value) in self.list.iter().zip(density) {
            representatives[j][c] = value;
        }
        let at = |image: &crate::mesh::Image| {
            representatives[image.of].component_mul(&Vector3::from(self.motion.signs(image)))
        };
        side.orbits.images.iter().map(at).collect()
    }

    /// What the density on this sphere tells.
    pub fn response<const H: usize>(
        &self,
        density: &[f64],
        slips: &Slips,
        side: &Side<'_, H>,
    ) -> Response {
        let [squirming, swirling] = &slips.0;
        let mut force = Vector3::zeros();
        let mut torque = Vector3::zeros();
        let mut slip = vec![0.0; squirming.len()];
        let mut swirl = vec![0.0; swirling.len()];
        for (&(j, c), &value) in self.list.iter().zip(density) {
            let vertex = side.orbits.representatives[j];
            let mut f = Vector3::zeros();
            f[c] = -value * side.orbits.sizes[j] as f64;
            let (df, dt) = side.surface.force_and_torque(vertex, &f);
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
        let (force, torque) = match self.motion {
            Motion::Axial => (force.z, 0.0),
            Motion::Transverse => (force.x, torque.y),
            Motion::Twist => (0.0, torque.z),
            Motion::Sideways => (force.y, torque.x),
        };
        Response {
            force,
            torque,
            slip,
            swirl,
        }
    }
}
