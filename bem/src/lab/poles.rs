//! Where the meshes of spheres are refined: towards the neighbour across the smallest gap.

use nalgebra::{UnitQuaternion, Vector3};

use super::Body;
use crate::BemError;
use crate::mesh::MeshFamily;
use crate::pieces::mesh_family;
use crate::surface::mirror_gap;

/// Where the refined pole of a sphere's mesh is, and for what gap the mesh is made.
pub struct Pole {
    /// Gap to the mirror image in the place of the nearest neighbour, in radii of the sphere; infinite for a sphere alone.
    pub gap: f64,
    /// The true gap, in the same unit, and the neighbour's radius.
    neighbour: [f64; 2],
    /// Turns the mesh's frame, whose pole is +z, into the laboratory's.
    pub rotation: UnitQuaternion<f64>,
}

impl Pole {
    /// The meshes of a level for it: those that the sphere has in a pair with its neighbour, so that the panels of both face each other.
    ///
    /// # Errors
    /// As [`MeshFamily::new`].
    pub fn family(&self, level: usize) -> Result<MeshFamily, BemError> {
        let [gap, ratio] = self.neighbour;
        mesh_family(level, gap, ratio)
    }
}

/// Another sphere, as seen from one.
struct Neighbour {
    direction: Vector3<f64>,
    gap: f64,
    radius: f64,
}

/// The pole of each sphere.
///
/// # Errors
/// [`BemError::Overlap`] if two spheres overlap.
pub fn poles(bodies: &[Body]) -> Result<Vec<Pole>, BemError> {
    let pole = |(first, body): (usize, &Body)| {
        let towards = nearest(first, bodies)?;
        let turn = towards
            .as_ref()
            .map_or(UnitQuaternion::identity(), |of| turned(&of.direction));
        let neighbour = towards.map_or([f64::INFINITY, 1.0], |of| {
            [of.gap / body.radius, of.radius / body.radius]
        });
        let [gap, ratio] = neighbour;
        Ok(Pole {
            gap: mirror_gap(gap, [1.0, ratio]),
            neighbour,
            rotation: body.mesh_rotation * turn,
        })
    };
    bodies.iter().enumerate().map(pole).collect()
}

/// The neighbour across the smallest gap, if there is one.
fn nearest(first: usize, bodies: &[Body]) -> Result<Option<Neighbour>, BemError> {
    let mut found: Option<Neighbour> = None;
    for (second, other) in bodies.iter().enumerate().filter(|&(k, _)| k != first) {
        let direction = other.position - bodies[first].position;
        let distance = direction.norm();
        let touching = bodies[first].radius + other.radius;
        // Written so that NaN is refused.
        if distance.partial_cmp(&touching) != Some(std::cmp::Ordering::Greater) {
            return Err(BemError::Overlap {
                first,
                second,
                distance,
                touching,
            });
        }
        let gap = distance - touching;
        if found.as_ref().is_none_or(|nearest| gap < nearest.gap) {
            found = Some(Neighbour {
                direction,
                gap,
                radius: other.radius,
            });
        }
    }
    Ok(found)
}

/// The rotation that turns z towards `direction`.
pub fn turned(direction: &Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between(&Vector3::z(), direction).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    })
}
