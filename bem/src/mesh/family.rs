//! Meshes of one topology for a range of gaps.
//!
//! The topology is made for a reference gap. For another gap each vertex moves along its meridian so
//! that the share of panels between it and the contact point stays what it was,
//! `H(θ'; eps) / H(π; eps) = H(θ; eps_ref) / H(π; eps_ref)`, a smooth function of the gap that keeps
//! mirror images exact. Near contact it stretches the mesh evenly, as `sqrt(eps/eps_ref)`.

use nalgebra::Vector3;
use std::f64::consts::PI;

use super::{Grading, Mesh, Orbits, geodesic, polar_angle, refine};
use crate::BemError;

/// Meshes for the gaps `smallest <= eps <= largest`, all of one topology.
#[derive(Clone, Debug)]
pub struct MeshFamily {
    /// Smallest gap, in radii.
    pub smallest: f64,
    /// Largest gap, in radii; infinity for a family of one fixed mesh.
    pub largest: f64,
    law: Grading,
    made: Mesh,
    orbits: Orbits,
}

impl MeshFamily {
    /// Meshes that follow `law` with its cap set to the square root of the gap; the topology is made
    /// for the geometric mean of the ends. If `largest` is infinite the mesh is one and fixed.
    ///
    /// # Errors
    /// [`BemError::AsymmetricMesh`] if refinement lost the mirror symmetry, which it must not.
    pub fn new(law: Grading, smallest: f64, largest: f64) -> Result<Self, BemError> {
        let cap = if largest.is_finite() {
            (smallest * largest).sqrt().sqrt()
        } else {
            f64::INFINITY
        };
        let law = Grading { cap, ..law };
        // Edges of a geodesic sphere are 1.05 to 1.25 over its frequency.
        let frequency = (1.2 / law.size(PI)).ceil() as usize;
        let made = refine(geodesic(frequency), |theta| law.size(theta));
        let orbits = Orbits::new(&made)?;
        Ok(Self {
            smallest,
            largest,
            law,
            made,
            orbits,
        })
    }

    /// Mirror orbits of the vertices, the same for all gaps.
    #[must_use]
    pub fn orbits(&self) -> &Orbits {
        &self.orbits
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.made.vertices.len()
    }

    /// The mesh for the gap `eps`.
    #[must_use]
    pub fn at(&self, eps: f64) -> Mesh {
        if !self.law.cap.is_finite() {
            return self.made.clone();
        }
        let law = Grading {
            cap: eps.sqrt(),
            ..self.law
        };
        Mesh {
            vertices: self
                .made
                .vertices
                .iter()
                .map(|v| self.moved(v, &law))
                .collect(),
            triangles: self.made.triangles.clone(),
        }
    }

    fn moved(&self, vertex: &Vector3<f64>, law: &Grading) -> Vector3<f64> {
        let sine = vertex.x.hypot(vertex.y);
        if sine <= 0.0 {
            return *vertex;
        }
        let share = self.law.panels(polar_angle(vertex)) / self.law.panels(PI);
        let theta = law.angle_of_share(share);
        let stretch = theta.sin() / sine;
        Vector3::new(vertex.x * stretch, vertex.y * stretch, theta.cos())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn family() -> MeshFamily {
        let law = Grading {
            scale: 1.0,
            far: 0.35,
            slope: 0.35,
            cap: 1.0,
        };
        MeshFamily::new(law, 0.001, 0.004).unwrap()
    }

    #[test]
    fn a_graded_mesh_is_its_own_mirror_image_at_every_gap() {
        let family = family();
        for eps in [0.001, 0.0017, 0.004] {
            let orbits = Orbits::new(&family.at(eps)).unwrap();
            assert_eq!(orbits.images, family.orbits().images);
        }
    }

    #[test]
    fn a_graded_mesh_is_closed_and_covers_the_sphere() {
        let mesh = family().at(0.001);
        assert_eq!(mesh.triangles.len(), 2 * mesh.vertices.len() - 4);
        let volume: f64 = mesh
            .triangles
            .iter()
            .map(|&t| {
                let [a, b, c] = mesh.corners(t);
                let det = a.dot(&b.cross(&c));
                assert!(det > 0.0);
                det / 6.0
            })
            .sum();
        approx::assert_relative_eq!(volume, 4.0 / 3.0 * PI, max_relative = 0.05);
    }
}
