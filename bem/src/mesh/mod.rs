//! Triangulated unit spheres, finer towards the contact point `+z`, mirror-symmetric in x and y.
//!
//! A mesh is made of rings about the line of centres ([`rings`]), whose distances follow a size law
//! ([`Grading`]), and moves along its meridians with the gap ([`MeshFamily`]), so that between seams
//! loads are a smooth function of the gap. Densities live at its [`Nodes`].

mod element;
mod family;
mod grading;
mod orbits;
mod rings;

pub use element::{Nodes, hats, local_nodes};
pub use family::MeshFamily;
pub use grading::Grading;
pub use orbits::{Image, Orbits};
pub use rings::rings;

use nalgebra::Vector3;

/// A triangulation of the unit sphere; triangles are anticlockwise seen from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Points on the unit sphere.
    pub vertices: Vec<Vector3<f64>>,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[usize; 3]>,
}

impl Mesh {
    /// The corners of a triangle.
    #[must_use]
    pub fn corners(&self, triangle: [usize; 3]) -> [Vector3<f64>; 3] {
        triangle.map(|v| self.vertices[v])
    }

    /// Largest aspect ratio over all triangles: longest edge over twice the inscribed circle's
    /// radius times `sqrt 3`, which is 1 for an equilateral triangle.
    #[must_use]
    pub fn worst_aspect_ratio(&self) -> f64 {
        self.triangles
            .iter()
            .map(|&t| aspect_ratio(self.corners(t)))
            .fold(1.0, f64::max)
    }

    /// Length of the longest edge.
    #[must_use]
    pub fn longest_edge(&self) -> f64 {
        self.triangles
            .iter()
            .flat_map(|&t| edge_lengths(self.corners(t)))
            .fold(0.0, f64::max)
    }
}

fn edge_lengths([a, b, c]: [Vector3<f64>; 3]) -> [f64; 3] {
    [(b - a).norm(), (c - b).norm(), (a - c).norm()]
}

fn aspect_ratio(corners: [Vector3<f64>; 3]) -> f64 {
    let [a, b, c] = corners;
    let lengths = edge_lengths(corners);
    let twice_area = (b - a).cross(&(c - a)).norm();
    let inradius = twice_area / lengths.iter().sum::<f64>();
    lengths.into_iter().fold(0.0, f64::max) / (2.0 * 3f64.sqrt() * inradius)
}

/// Polar angle from `+z`, the contact point.
fn polar_angle(point: &Vector3<f64>) -> f64 {
    point.x.hypot(point.y).atan2(point.z)
}
