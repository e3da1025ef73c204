//! Conforming refinement by longest edges, the same on both sides of every mirror plane.
//!
//! After Rivara, *Int. J. Numer. Meth. Eng.* 20 (1984) 745: edges longer than the size law are
//! marked, a triangle with a marked edge gets its longest edge marked too, and triangles are split by
//! the pattern of their marks (one: bisect, two: bisect twice, three: four similar triangles). Edges
//! that tie are marked together, so that nothing depends on the order of vertices.

use std::collections::HashMap;

use super::{Mesh, polar_angle};

/// Lengths closer than this, relatively, tie.
const TIE: f64 = 1e-9;

/// Each pass halves the marked edges, so this many reach any size that makes sense.
const PASSES: usize = 60;

/// Refines until no edge is longer than `size(θ)`, θ the angle of its middle from `+z`.
#[must_use]
pub fn refine(mut mesh: Mesh, size: impl Fn(f64) -> f64) -> Mesh {
    for _ in 0..PASSES {
        let edges = Edges::new(&mesh);
        let marks = edges.mark(&mesh, &size);
        if !marks.contains(&true) {
            break;
        }
        mesh = split(mesh, &edges, &edges.close(marks));
    }
    mesh
}

/// Edges of a mesh, and for each triangle its edges opposite to its corners.
struct Edges {
    ends: Vec<(usize, usize)>,
    lengths: Vec<f64>,
    of_triangle: Vec<[usize; 3]>,
}

impl Edges {
    fn new(mesh: &Mesh) -> Self {
        let mut index = HashMap::new();
        let mut ends = Vec::new();
        let mut edge = |a: usize, b: usize| {
            let key = (a.min(b), a.max(b));
            *index.entry(key).or_insert_with(|| {
                ends.push(key);
                ends.len() - 1
            })
        };
        let of_triangle = mesh
            .triangles
            .iter()
            .map(|&[a, b, c]| [edge(b, c), edge(c, a), edge(a, b)])
            .collect();
        let lengths = ends
            .iter()
            .map(|&(a, b)| (mesh.vertices[a] - mesh.vertices[b]).norm())
            .collect();
        Self {
            ends,
            lengths,
            of_triangle,
        }
    }

    fn mark(&self, mesh: &Mesh, size: &impl Fn(f64) -> f64) -> Vec<bool> {
        self.ends
            .iter()
            .zip(&self.lengths)
            .map(|(&(a, b), &length)| {
                let middle = mesh.vertices[a] + mesh.vertices[b];
                length > size(polar_angle(&middle)) * (1.0 + TIE)
            })
            .collect()
    }

    /// Adds marks until every triangle that is split is split at its longest edges.
    fn close(&self, mut marks: Vec<bool>) -> Vec<bool> {
        loop {
            let mut changed = false;
            for edges in &self.of_triangle {
                if edges.iter().any(|&e| marks[e]) {
                    for e in self.to_mark(*edges, &marks) {
                        changed |= !marks[e];
                        marks[e] = true;
                    }
                }
            }
            if !changed {
                return marks;
            }
        }
    }

    /// The longest edges; all three edges if two or more tie as longest, or all are marked.
    fn to_mark(&self, edges: [usize; 3], marks: &[bool]) -> Vec<usize> {
        let longest = edges.iter().map(|&e| self.lengths[e]).fold(0.0, f64::max);
        let ties = |e: &usize| self.lengths[*e] >= longest * (1.0 - TIE);
        let tied: Vec<usize> = edges.into_iter().filter(ties).collect();
        if tied.len() == 1 || edges.iter().all(|&e| marks[e]) {
            tied
        } else {
            edges.to_vec()
        }
    }
}

fn split(mesh: Mesh, edges: &Edges, marks: &[bool]) -> Mesh {
    let mut vertices = mesh.vertices;
    let mut middle = vec![None; marks.len()];
    for (e, &(a, b)) in edges.ends.iter().enumerate().filter(|(e, _)| marks[*e]) {
        middle[e] = Some(vertices.len());
        vertices.push((vertices[a] + vertices[b]).normalize());
    }
    let mut triangles = Vec::with_capacity(2 * mesh.triangles.len());
    for (&corners, &opposite) in mesh.triangles.iter().zip(&edges.of_triangle) {
        let longest = (0..3)
            .max_by(|&i, &j| edges.lengths[opposite[i]].total_cmp(&edges.lengths[opposite[j]]))
            .unwrap_or(0);
        let turn = |i: usize| (longest + i) % 3;
        let corners = [0, 1, 2].map(|i| corners[turn(i)]);
        let middles = [0, 1, 2].map(|i| middle[opposite[turn(i)]]);
        split_triangle(corners, middles, &mut triangles);
    }
    Mesh {
        vertices,
        triangles,
    }
}

/// Splits `[a, b, c]`, whose longest edge is `b c`, at the middles opposite to its corners.
fn split_triangle([a, b, c]: [usize; 3], middles: [Option<usize>; 3], out: &mut Vec<[usize; 3]>) {
    match middles {
        [Some(m), Some(ca), Some(ab)] => {
            out.extend([[a, ab, ca], [ab, b, m], [ca, m, c], [m, ca, ab]]);
        }
        [Some(m), Some(ca), None] => out.extend([[a, b, m], [a, m, ca], [ca, m, c]]),
        [Some(m), None, Some(ab)] => out.extend([[a, m, c], [a, ab, m], [ab, b, m]]),
        [Some(m), None, None] => out.extend([[a, b, m], [a, m, c]]),
        // Without a marked longest edge nothing is marked: see `close`.
        _ => out.push([a, b, c]),
    }
}
