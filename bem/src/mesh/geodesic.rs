//! Geodesic spheres: an icosahedron with each face divided into `frequency²` triangles.
//!
//! Standard orientation: corners `(0, ±1, ±φ)` and cyclic, φ the golden ratio, so that the
//! coordinate planes are mirror planes and the z axis passes through the middle of an edge.
//! Coordinates are kept as integers `m + n φ` until the end, so that mirror images are exact.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::Mesh;

/// A coordinate `m + n φ`.
type Golden = (i64, i64);

/// A point with golden coordinates.
type GoldenPoint = [Golden; 3];

/// Geodesic sphere of `10 frequency² + 2` vertices (class I, projected to the unit sphere).
#[must_use]
pub fn geodesic(frequency: usize) -> Mesh {
    let frequency = frequency.max(1);
    let mut index = HashMap::new();
    let mut mesh = Mesh {
        vertices: Vec::new(),
        triangles: Vec::new(),
    };
    for face in icosahedron() {
        add_face(face, frequency, &mut index, &mut mesh);
    }
    mesh
}

fn add_face(
    face: [GoldenPoint; 3],
    frequency: usize,
    index: &mut HashMap<GoldenPoint, usize>,
    mesh: &mut Mesh,
) {
    let mut vertex = |i: usize, j: usize| {
        let point = combine(face, [frequency - i - j, i, j]);
        *index.entry(point).or_insert_with(|| {
            mesh.vertices.push(real(point).normalize());
            mesh.vertices.len() - 1
        })
    };
    for i in 0..frequency {
        for j in 0..frequency - i {
            let (a, b, c) = (vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
            mesh.triangles.push([a, b, c]);
            if i + j + 1 < frequency {
                mesh.triangles.push([b, vertex(i + 1, j + 1), c]);
            }
        }
    }
}

fn combine(face: [GoldenPoint; 3], weights: [usize; 3]) -> GoldenPoint {
    let mut point = [(0, 0); 3];
    for (corner, weight) in face.iter().zip(weights) {
        for (sum, term) in point.iter_mut().zip(corner) {
            sum.0 += term.0 * weight as i64;
            sum.1 += term.1 * weight as i64;
        }
    }
    point
}

fn real(point: GoldenPoint) -> Vector3<f64> {
    let golden_ratio = f64::midpoint(1.0, 5f64.sqrt());
    Vector3::from(point.map(|(m, n)| m as f64 + n as f64 * golden_ratio))
}

/// The twenty faces, anticlockwise seen from outside: corners at mutual distance 2.
fn icosahedron() -> Vec<[GoldenPoint; 3]> {
    let mut corners = Vec::new();
    for axis in 0..3 {
        for (one, golden) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
            let mut corner = [(0, 0); 3];
            corner[(axis + 1) % 3] = (one, 0);
            corner[(axis + 2) % 3] = (0, golden);
            corners.push(corner);
        }
    }
    let adjacent = |a: GoldenPoint, b: GoldenPoint| (real(a) - real(b)).norm() < 2.1;
    let mut faces = Vec::new();
    for (i, &a) in corners.iter().enumerate() {
        for (j, &b) in corners.iter().enumerate().skip(i + 1) {
            for &c in corners.iter().skip(j + 1) {
                if adjacent(a, b) && adjacent(b, c) && adjacent(c, a) {
                    let outward = real(a).dot(&real(b).cross(&real(c))) > 0.0;
                    faces.push(if outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    faces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_geodesic_sphere_has_ten_frequency_squared_plus_two_vertices() {
        for frequency in [1, 2, 3, 7] {
            let mesh = geodesic(frequency);
            assert_eq!(mesh.vertices.len(), 10 * frequency * frequency + 2);
            assert_eq!(mesh.triangles.len(), 20 * frequency * frequency);
        }
    }
}
