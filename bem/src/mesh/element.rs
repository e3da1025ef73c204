//! Elements on a triangle: where their nodes are and what their hat functions are.
//!
//! An element has `H` nodes and as many hat functions, each 1 at its own node and 0 at the others, in
//! barycentric coordinates λ (Zienkiewicz & Taylor, *The Finite Element Method*, chapter 6):
//!
//! | `H` | density | nodes | hat functions |
//! |---|---|---|---|
//! | 1 | constant | middle | 1 |
//! | 3 | linear | corners | `λ_i` |
//! | 6 | quadratic | corners, middles of edges | `λ_i (2 λ_i - 1)`, `4 λ_j λ_k` |

use std::collections::HashMap;

use nalgebra::Vector3;

use super::Mesh;

/// Which corners the local node `k` lies between.
const fn corners<const H: usize>(k: usize) -> [bool; 3] {
    match (H, k) {
        (1, _) => [true, true, true],
        (_, 0) => [true, false, false],
        (_, 1) => [false, true, false],
        (_, 2) => [false, false, true],
        (_, 3) => [false, true, true],
        (_, 4) => [true, false, true],
        _ => [true, true, false],
    }
}

/// Barycentric coordinates of the local nodes.
#[must_use]
pub fn local_nodes<const H: usize>() -> [[f64; 3]; H] {
    std::array::from_fn(|k| {
        let between = corners::<H>(k);
        let share = 1.0 / between.iter().filter(|&&b| b).count() as f64;
        between.map(|b| if b { share } else { 0.0 })
    })
}

/// Values of the hat functions at the barycentric coordinates `l`.
#[inline]
#[must_use]
pub fn hats<const H: usize>(l: [f64; 3]) -> [f64; H] {
    std::array::from_fn(|k| match (H, k) {
        (1, _) => 1.0,
        (3, _) => l[k],
        (_, 0..3) => l[k] * (2.0 * l[k] - 1.0),
        _ => 4.0 * l[(k + 1) % 3] * l[(k + 2) % 3],
    })
}

/// The nodes of all triangles of a mesh.
#[derive(Clone, Debug)]
pub struct Nodes<const H: usize> {
    /// Points on the unit sphere.
    pub points: Vec<Vector3<f64>>,
    /// Nodes of each triangle, in the order of [`local_nodes`].
    pub of_triangle: Vec<[usize; H]>,
}

impl<const H: usize> Nodes<H> {
    /// The nodes of a mesh; mirror images of nodes are exact where those of vertices are.
    #[must_use]
    pub fn new(mesh: &Mesh) -> Self {
        let mut index = HashMap::new();
        let mut points = Vec::new();
        let of_triangle = mesh
            .triangles
            .iter()
            .map(|triangle| {
                std::array::from_fn(|k| {
                    let between = corners::<H>(k);
                    let mut key = [usize::MAX; 3];
                    for i in (0..3).filter(|&i| between[i]) {
                        key[i] = triangle[i];
                    }
                    key.sort_unstable();
                    *index.entry(key).or_insert_with(|| {
                        points.push(middle(mesh, &key));
                        points.len() - 1
                    })
                })
            })
            .collect();
        Self {
            points,
            of_triangle,
        }
    }
}

/// The middle of up to three vertices, on the sphere; a single vertex is left as it is.
fn middle(mesh: &Mesh, key: &[usize; 3]) -> Vector3<f64> {
    let ends: Vec<_> = key.iter().filter_map(|&v| mesh.vertices.get(v)).collect();
    if let [vertex] = ends[..] {
        return *vertex;
    }
    // Added by size, so that the sum for a mirror image has the same bits.
    let sum = |axis: usize| {
        let mut terms: Vec<f64> = ends.iter().map(|p| p[axis]).collect();
        terms.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        terms.iter().sum::<f64>()
    };
    Vector3::new(sum(0), sum(1), sum(2)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Grading, Orbits, rings};

    fn check<const H: usize>(expected: fn(usize, usize) -> usize) {
        for (k, node) in local_nodes::<H>().into_iter().enumerate() {
            for (j, value) in hats::<H>(node).into_iter().enumerate() {
                assert!((value - if j == k { 1.0 } else { 0.0 }).abs() < 1e-15);
            }
        }
        let sum: f64 = hats::<H>([0.2, 0.3, 0.5]).iter().sum();
        assert!((sum - 1.0).abs() < 1e-15);
        let law = Grading {
            scale: 1.0,
            far: 0.5,
            slope: 0.5,
            core: 0.5,
            width: f64::INFINITY,
            gap: 0.01,
        };
        let mesh = rings(&law);
        let nodes = Nodes::<H>::new(&mesh);
        let [vertices, triangles] = [mesh.vertices.len(), mesh.triangles.len()];
        assert_eq!(nodes.points.len(), expected(vertices, triangles));
        assert!(Orbits::new(&nodes.points).is_ok());
    }

    #[test]
    fn each_hat_function_is_one_at_its_own_node_only_and_nodes_are_shared_and_mirrored() {
        check::<1>(|_, triangles| triangles);
        check::<3>(|vertices, _| vertices);
        check::<6>(|vertices, triangles| vertices + 3 * triangles / 2);
    }
}
