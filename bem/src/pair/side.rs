//! One meshed sphere of a pair: its targets, and the velocities that its densities induce.

use nalgebra::Vector3;

use crate::mesh::{MeshFamily, Nodes, Orbits};
use crate::surface::{Block, Profile, Surface, Target, Work};

/// A sphere in its own frame and its own unit of length: centre at the origin, the other sphere on the side of `+z`.
pub struct Side<'a, const H: usize> {
    /// The sphere with its quadrature points.
    pub surface: Surface<H>,
    /// Mirror orbits of its nodes.
    pub orbits: &'a Orbits,
    /// Nodes in the reference geometry, by which rules are chosen.
    reference: Vec<Vector3<f64>>,
}

impl<'a, const H: usize> Side<'a, H> {
    /// The mesh of a family beside a mirror image at the gap `eps`.
    pub fn new(family: &'a MeshFamily<H>, eps: f64) -> Self {
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
        Self {
            surface,
            orbits: family.orbits(),
            reference: Nodes::<H>::new(&reference).points,
        }
    }

    /// A node, here and in the reference geometry.
    pub fn node(&self, vertex: usize) -> [Vector3<f64>; 2] {
        [self.surface.nodes()[vertex], self.reference[vertex]]
    }

    /// Velocities at a node, block by block.
    pub fn at_node(&self, vertex: usize, work: &mut Work) -> Vec<Block> {
        let [point, reference] = self.node(vertex);
        let node = Some(vertex);
        self.row(&target(point, reference, node), work)
    }

    /// The same at a point of the other sphere, given here and in the reference geometry.
    pub fn at_point(&self, [point, reference]: [Vector3<f64>; 2], work: &mut Work) -> Vec<Block> {
        self.row(&target(point, reference, None), work)
    }

    fn row(&self, target: &Target, work: &mut Work) -> Vec<Block> {
        let mut row = vec![Block::default(); self.orbits.images.len()];
        self.surface.add_row(target, &mut row, work);
        row
    }
}

fn target(point: Vector3<f64>, reference: Vector3<f64>, node: Option<usize>) -> Target {
    Target {
        point,
        reference,
        node,
    }
}
