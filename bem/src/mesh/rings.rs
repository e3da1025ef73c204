//! Rings of vertices about the line of centres, and the triangles between them.
//!
//! The k-th of K rings lies at the angle `θ_k` with `H(θ_k) = (k/K) H(π)`, see [`Grading`], and has
//! `4 m_k` evenly spaced vertices, as many as make its edges as long as those from ring to ring. A quarter of the mesh is made, and mirrored in x and y: images are exact.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector3;

use super::{Grading, Mesh};

/// Fewest steps from pole to pole.
const FEWEST: usize = 4;

/// Most steps: beyond it no dense system could be solved.
const MOST: f64 = 1000.0;

/// One ring: its first vertex, and the number of edges in a quarter; 0 for a pole.
#[derive(Clone, Copy)]
struct Ring {
    first: usize,
    quarter: usize,
}

impl Ring {
    /// The vertex `place` edges on from the plane `y = 0`, or its image.
    fn vertex(self, place: usize, (mirror_x, mirror_y): (bool, bool)) -> usize {
        let all = 4 * self.quarter;
        if all == 0 {
            return self.first;
        }
        let place = if mirror_x { all / 2 - place } else { place };
        let place = if mirror_y { all - place } else { place };
        self.first + place % all
    }
}

/// The mesh of rings that follows a size law.
#[must_use]
pub fn rings(law: &Grading) -> Mesh {
    let steps = (law.panels(PI).min(MOST).round() as usize).max(FEWEST);
    let mut mesh = Mesh {
        vertices: Vec::new(),
        triangles: Vec::new(),
    };
    let mut before: Option<Ring> = None;
    for k in 0..=steps {
        let theta = law.angle_of_share_rad(k as f64 / steps as f64);
        let quarter = if k == 0 || k == steps {
            0
        } else {
            ((FRAC_PI_2 * theta.sin() / law.size(theta)).round() as usize).max(1)
        };
        let ring = Ring {
            first: mesh.vertices.len(),
            quarter,
        };
        let theta = if k == steps { PI } else { theta };
        add_vertices(theta, quarter, &mut mesh.vertices);
        if let Some(before) = before {
            add_triangles(before, ring, &mut mesh.triangles);
        }
        before = Some(ring);
    }
    mesh
}

fn add_vertices(theta: f64, quarter: usize, vertices: &mut Vec<Vector3<f64>>) {
    if quarter == 0 {
        vertices.push(Vector3::new(0.0, 0.0, theta.cos().signum()));
        return;
    }
    let (sine, cosine) = theta.sin_cos();
    for place in 0..4 * quarter {
        // The same angle in the first quarter.
        let within = place % quarter;
        let (turn, within) = match place / quarter {
            0 => ([1.0, 1.0], within),
            1 => ([-1.0, 1.0], quarter - within),
            2 => ([-1.0, -1.0], within),
            _ => ([1.0, -1.0], quarter - within),
        };
        let (y, x) = if within == quarter {
            (1.0, 0.0)
        } else {
            (FRAC_PI_2 * within as f64 / quarter as f64).sin_cos()
        };
        vertices.push(Vector3::new(turn[0] * sine * x, turn[1] * sine * y, cosine));
    }
}

/// Triangles between a ring and the next one, always with the shorter diagonal.
fn add_triangles(upper: Ring, lower: Ring, triangles: &mut Vec<[usize; 3]>) {
    let (m, n) = (upper.quarter, lower.quarter);
    let (mut i, mut j) = (0, 0);
    while i < m || j < n {
        let along_upper = j == n || (i < m && (2 * i + 1) * n < (2 * j + 1) * m);
        for image in [(false, false), (true, false), (true, true), (false, true)] {
            let third = if along_upper {
                upper.vertex(i + 1, image)
            } else {
                lower.vertex(j + 1, image)
            };
            let corners = [upper.vertex(i, image), lower.vertex(j, image), third];
            let [a, b, c] = corners;
            // One mirror turns a triangle round.
            triangles.push(if image.0 == image.1 {
                corners
            } else {
                [a, c, b]
            });
        }
        if along_upper { i += 1 } else { j += 1 }
    }
}
