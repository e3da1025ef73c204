//! Mirror images of nodes: the orbits under `x -> -x` and `y -> -y`.

use std::collections::HashMap;

use nalgebra::Vector3;

use crate::BemError;

/// A vertex as an image of a representative (a vertex with `x >= 0`, `y >= 0`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Image {
    /// Index of the representative in [`Orbits::representatives`].
    pub of: usize,
    /// Whether x is reflected.
    pub mirror_x: bool,
    /// Whether y is reflected.
    pub mirror_y: bool,
}

/// Orbits of the vertices of a mesh that is exactly mirror-symmetric in x and y.
#[derive(Clone, Debug)]
pub struct Orbits {
    /// The vertices with `x >= 0` and `y >= 0`.
    pub representatives: Vec<usize>,
    /// Number of vertices in the orbit of each representative: 1, 2 or 4.
    pub sizes: Vec<usize>,
    /// For each vertex of the mesh, whose image it is.
    pub images: Vec<Image>,
}

impl Orbits {
    /// Finds the orbits.
    ///
    /// # Errors
    /// [`BemError::AsymmetricMesh`] if a vertex has no exact mirror image.
    pub fn new(points: &[Vector3<f64>]) -> Result<Self, BemError> {
        // Adding 0.0 turns -0.0 into 0.0.
        let key = |v: usize| {
            let p = &points[v];
            [p.x.abs(), p.y.abs(), p.z + 0.0].map(f64::to_bits)
        };
        let representatives: Vec<usize> = (0..points.len())
            .filter(|&v| points[v].x >= 0.0 && points[v].y >= 0.0)
            .collect();
        let index: HashMap<_, _> = representatives
            .iter()
            .zip(0..)
            .map(|(&v, i)| (key(v), i))
            .collect();
        let mut sizes = vec![0; representatives.len()];
        let mut images = Vec::with_capacity(points.len());
        for (vertex, p) in points.iter().enumerate() {
            let &of = index
                .get(&key(vertex))
                .ok_or(BemError::AsymmetricMesh { vertex })?;
            sizes[of] += 1;
            images.push(Image {
                of,
                mirror_x: p.x < 0.0,
                mirror_y: p.y < 0.0,
            });
        }
        let orbits = Self {
            representatives,
            sizes,
            images,
        };
        orbits.check(points)?;
        Ok(orbits)
    }

    fn check(&self, points: &[Vector3<f64>]) -> Result<(), BemError> {
        for (&vertex, &size) in self.representatives.iter().zip(&self.sizes) {
            let p = &points[vertex];
            let expected = if p.x > 0.0 { 2 } else { 1 } * if p.y > 0.0 { 2 } else { 1 };
            if size != expected {
                return Err(BemError::AsymmetricMesh { vertex });
            }
        }
        Ok(())
    }
}
