//! Meshes of one topology for a range of gaps.
//!
//! The topology is made for a reference gap. For another gap each vertex moves along its meridian so
//! that the share of panels between it and the contact point stays what it was,
//! `H(θ'; eps) / H(π; eps) = H(θ; eps_ref) / H(π; eps_ref)`, a smooth function of the gap that keeps
//! mirror images exact. Near contact it stretches the mesh evenly, as `sqrt(eps/eps_ref)`.

use nalgebra::Vector3;
use std::f64::consts::PI;

use super::{Grading, Mesh, Nodes, Orbits, polar_angle, rings};
use crate::BemError;

/// Meshes for the gaps `smallest <= eps <= largest`, all of one topology.
#[derive(Clone, Debug)]
pub struct MeshFamily<const H: usize = 6> {
    /// Smallest gap, in radii.
    pub smallest: f64,
    /// Largest gap, in radii; infinity for a family of one fixed mesh.
    pub largest: f64,
    law: Grading,
    made: Mesh,
    orbits: Orbits,
}

impl<const H: usize> MeshFamily<H> {
    /// Meshes that follow `law` at each gap; the topology is made for the geometric mean of the
    /// ends. If `largest` is infinite the mesh is one and fixed.
    ///
    /// # Errors
    /// [`BemError::AsymmetricMesh`] if refinement lost the mirror symmetry, which it must not.
    pub fn new(law: Grading, smallest: f64, largest: f64) -> Result<Self, BemError> {
        let gap = (smallest * largest).sqrt();
        let law = Grading { gap, ..law };
        let made = rings(&law);
        let orbits = Orbits::new(&Nodes::<H>::new(&made).points)?;
        Ok(Self {
            smallest,
            largest,
            law,
            made,
            orbits,
        })
    }

    /// Mirror orbits of the nodes, the same for all gaps.
    #[must_use]
    pub fn orbits(&self) -> &Orbits {
        &self.orbits
    }

    /// Number of nodes.
    #[must_use]
    pub fn node_count(&self) -> usize {
        self.orbits.images.len()
    }

    /// The mesh for the gap `eps`.
    #[must_use]
    pub fn at(&self, eps: f64) -> Mesh {
        if !self.law.gap.is_finite() {
            return self.made.clone();
        }
        let law = Grading {
            gap: eps,
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

    /// Length of the edges of the mesh for the gap `eps` at the angle `theta`, in radians, from the contact point.
    #[must_use]
    pub fn edge(&self, eps: f64, theta: f64) -> f64 {
        let law = Grading {
            gap: if self.law.gap.is_finite() {
                eps
            } else {
                self.law.gap
            },
            ..self.law
        };
        // Rings keep their number as the gap changes.
        law.size(theta) * law.panels(PI) / self.law.panels(PI)
    }

    fn moved(&self, vertex: &Vector3<f64>, law: &Grading) -> Vector3<f64> {
        let sine = vertex.x.hypot(vertex.y);
        if sine <= 0.0 {
            return *vertex;
        }
        let share = self.law.panels(polar_angle(vertex)) / self.law.panels(PI);
        let theta = law.angle_of_share_rad(share);
        let stretch = theta.sin() / sine;
        Vector3::new(vertex.x * stretch, vertex.y * stretch, theta.cos())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn family() -> MeshFamily<3> {
        let law = Grading {
            scale: 1.0,
            far: 0.35,
            slope: 0.35,
            core: 0.5,
            width: f64::INFINITY,
            gap: 1.0,
        };
        MeshFamily::new(law, 0.001, 0.004).unwrap()
    }

    #[test]
    fn a_graded_mesh_is_its_own_mirror_image_at_every_gap() {
        let family = family();
        for eps in [0.001, 0.0017, 0.004] {
            let orbits = Orbits::new(&Nodes::<3>::new(&family.at(eps)).points).unwrap();
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
