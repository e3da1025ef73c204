//! A spherical triangle, or a part of one.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::Profile;
use super::kernel::RUNS;
use crate::mesh::hats;
use crate::quadrature::Point;

/// Part of a spherical triangle: a triangle in the flat one that it is the projection of.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    /// Barycentric coordinates, in the whole panel, of the corners of the part.
    coordinates: Corners,
    /// Corners of the part in the flat panel.
    flat: [Vector3<f64>; 3],
    /// The same corners in the reference geometry.
    reference: [Vector3<f64>; 3],
    /// Middle and squared radius in the reference geometry.
    middle: Vector3<f64>,
    radius_squared: f64,
    /// `a.(b x c)` of the flat corners, twice the flat area times its distance from the centre.
    volume: f64,
}

/// Barycentric coordinates of three points.
type Corners = [[f64; 3]; 3];

const WHOLE: Corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Panel {
    /// The whole panel with the given corners, here and in the reference geometry.
    pub fn new(flat: [Vector3<f64>; 3], reference: [Vector3<f64>; 3]) -> Self {
        let middle = (reference[0] + reference[1] + reference[2]).normalize();
        let radius_squared = reference
            .iter()
            .map(|corner| (corner.normalize() - middle).norm_squared())
            .fold(0.0, f64::max);
        let [a, b, c] = flat;
        Self {
            coordinates: WHOLE,
            flat,
            reference,
            middle,
            radius_squared,
            volume: a.dot(&b.cross(&c)),
        }
    }

    /// The same with its own geometry for the reference, by which rules are chosen.
    pub fn as_it_is(&self) -> Self {
        Self {
            coordinates: self.coordinates,
            ..Self::new(self.flat, self.flat)
        }
    }

    /// The part whose corners have the barycentric coordinates `corners` in this one.
    fn part(&self, corners: Corners) -> Self {
        let place = |of: &[Vector3<f64>; 3], [a, b, c]: [f64; 3]| of[0] * a + of[1] * b + of[2] * c;
        let coordinates = corners.map(|corner| interpolated(corner, &self.coordinates));
        Self {
            coordinates,
            ..Self::new(
                corners.map(|corner| place(&self.flat, corner)),
                corners.map(|corner| place(&self.reference, corner)),
            )
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
            self.part(pairs.map(|(i, j)| {
                let mut corner = [0.0; 3];
                corner[i] += 0.5;
                corner[j] += 0.5;
                corner
            }))
        })
    }

    /// The parts that meet at the point `apex`, which is the first corner of each.
    pub fn fan(&self, apex: [f64; 3]) -> impl Iterator<Item = Self> {
        (0..3)
            .filter(move |&i| apex[i] > 0.0)
            .map(move |i| self.part([apex, WHOLE[(i + 1) % 3], WHOLE[(i + 2) % 3]]))
    }

    /// Coordinates in the whole panel of a point with these coordinates in the part.
    pub fn in_whole(&self, at: [f64; 3]) -> [f64; 3] {
        interpolated(at, &self.coordinates)
    }

    /// Barycentric coordinates in this one of the point of the flat triangle's plane that a unit normal points to; all are positive for a point
    /// within.
    pub fn barycentric(&self, normal: &Vector3<f64>) -> [f64; 3] {
        let [a, b, c] = self.flat;
        let shares = [b.cross(&c), c.cross(&a), a.cross(&b)].map(|side| side.dot(normal));
        // Taken so that the other side of the sphere is outside.
        let sum = shares.iter().sum::<f64>().abs();
        shares.map(|share| share / sum)
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

    /// Writes the points of a rule as runs: x, y, z, the profile, and area/(8 pi) times each hat function.
    pub fn fill<const H: usize>(&self, rule: &[Point], profile: &Profile, out: &mut [f64]) {
        let n = rule.len();
        for (q, point) in rule.iter().enumerate() {
            let (position, area) = self.at(point);
            let weight = area / (8.0 * PI);
            for k in 0..3 {
                out[k * n + q] = position[k];
            }
            out[3 * n + q] = profile.at(&position);
            let hats = hats::<H>(self.in_whole(point.hats));
            for (k, hat) in hats.into_iter().enumerate() {
                out[(RUNS + k) * n + q] = weight * hat;
            }
        }
    }
}

/// Coordinates of the point `at` of the triangle with these corners.
#[inline]
fn interpolated(at: [f64; 3], corners: &Corners) -> [f64; 3] {
    [0, 1, 2].map(|k| (0..3).map(|corner| at[corner] * corners[corner][k]).sum())
}
