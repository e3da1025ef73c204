//! A spherical triangle, or a part of one.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::Profile;
use super::kernel::RUNS;
use crate::quadrature::Point;

/// Part of a spherical triangle: a triangle in the flat one that it is the projection of.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    /// Vertex indices of the whole panel, whose hat functions are integrated.
    pub vertices: [usize; 3],
    /// Corners of the part in the flat panel.
    flat: [Vector3<f64>; 3],
    /// Values of the three hat functions at the corners of the part.
    hats: [[f64; 3]; 3],
    /// The same corners in the reference geometry.
    reference: [Vector3<f64>; 3],
    /// Middle and squared radius in the reference geometry.
    middle: Vector3<f64>,
    radius_squared: f64,
    /// `a.(b x c)` of the flat corners, twice the flat area times its distance from the centre.
    volume: f64,
}

impl Panel {
    /// The whole panel with the given corners, here and in the reference geometry.
    pub fn new(
        vertices: [usize; 3],
        flat: [Vector3<f64>; 3],
        reference: [Vector3<f64>; 3],
    ) -> Self {
        Self::part(
            vertices,
            flat,
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            reference,
        )
    }

    fn part(
        vertices: [usize; 3],
        flat: [Vector3<f64>; 3],
        hats: [[f64; 3]; 3],
        reference: [Vector3<f64>; 3],
    ) -> Self {
        let middle = (reference[0] + reference[1] + reference[2]).normalize();
        let radius_squared = reference
            .iter()
            .map(|corner| (corner.normalize() - middle).norm_squared())
            .fold(0.0, f64::max);
        let [a, b, c] = flat;
        Self {
            vertices,
            flat,
            hats,
            reference,
            middle,
            radius_squared,
            volume: a.dot(&b.cross(&c)),
        }
    }

    /// Squared distance of a target from the middle, relative to the radius, as far as the
    /// profile allows, and the projection from the flat panel: that is singular at distance 1.
    #[inline]
    pub fn distance(&self, target: &Vector3<f64>, profile: &Profile) -> f64 {
        let squared = (target - self.middle).norm_squared();
        squared.min(profile.width(&self.middle).min(1.0)) / self.radius_squared
    }

    /// The four similar parts.
    pub fn quarters(&self) -> [Self; 4] {
        // Corners of each part as pairs: a corner is the middle of the two.
        const PARTS: [[(usize, usize); 3]; 4] = [
            [(0, 0), (0, 1), (0, 2)],
            [(1, 1), (1, 2), (1, 0)],
            [(2, 2), (2, 0), (2, 1)],
            [(0, 1), (1, 2), (2, 0)],
        ];
        PARTS.map(|pairs| {
            let middle = |of: &[Vector3<f64>; 3]| pairs.map(|(i, j)| 0.5 * (of[i] + of[j]));
            let hats = pairs
                .map(|(i, j)| [0, 1, 2].map(|k| f64::midpoint(self.hats[i][k], self.hats[j][k])));
            Self::part(
                self.vertices,
                middle(&self.flat),
                hats,
                middle(&self.reference),
            )
        })
    }

    /// Position on the sphere and area of a quadrature point.
    pub fn at(&self, point: &Point) -> (Vector3<f64>, f64) {
        let [a, b, c] = self.flat;
        let flat = a * point.hats[0] + b * point.hats[1] + c * point.hats[2];
        let inverse = 1.0 / flat.norm();
        (
            flat * inverse,
            point.weight * self.volume * inverse * inverse * inverse,
        )
    }

    /// Writes the points of a rule as runs: x, y, z, area/(8 pi) times each hat function, and the profile.
    pub fn fill(&self, rule: &[Point], profile: &Profile, out: &mut [f64]) {
        let n = rule.len();
        for (q, point) in rule.iter().enumerate() {
            let (position, area) = self.at(point);
            let weight = area / (8.0 * PI);
            for k in 0..3 {
                let hat: f64 = (0..3)
                    .map(|corner| point.hats[corner] * self.hats[corner][k])
                    .sum();
                out[k * n + q] = position[k];
                out[(3 + k) * n + q] = weight * hat;
            }
            out[(RUNS - 1) * n + q] = profile.at(&position);
        }
    }

    /// The same for a rule whose first corner is to be the corner `corner` of a whole panel.
    pub fn fill_from_corner(
        &self,
        rule: &[Point],
        corner: usize,
        profile: &Profile,
        out: &mut [f64],
    ) {
        let turn = [corner, (corner + 1) % 3, (corner + 2) % 3];
        let turned = Self {
            flat: turn.map(|i| self.flat[i]),
            hats: turn.map(|i| self.hats[i]),
            ..*self
        };
        turned.fill(rule, profile, out);
    }
}
