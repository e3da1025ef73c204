//! The matrices of the six symmetry classes, from the rows of the representatives.
//!
//! ```text
//! A_ij = Σ_g χ(g) [ S(x_i, g x_j) + s M S(M x_i, g x_j) ] R_g
//! ```
//!
//! with the images g of the vertex j under the mirrors, their signs `χ(g) R_g`, the swap's parity s
//! and its mirror M. To the axial classes a rank-one term is added that fixes the multiple of the
//! normal in the density, which induces no flow (Pozrikidis 1992, section 4.2).

use std::f64::consts::PI;

use rayon::prelude::*;

use super::parity::{Motion, Parity};
use nalgebra::Vector3;

use crate::mesh::Orbits;
use crate::surface::{Block, Surface, Target, Work, mirrored_z};

/// Size of the rank-one term, about that of the single layer's own eigenvalues.
const DEFLATION: f64 = 1.0 / (2.0 * PI);

/// Unknowns of one symmetry class.
pub struct Class {
    /// The symmetry.
    pub parity: Parity,
    /// Representative and component of each unknown.
    pub unknowns: Vec<(usize, usize)>,
    /// Unknown of each component of each representative, if it has one.
    index: Vec<[Option<usize>; 3]>,
}

impl Class {
    /// Numbers the unknowns of a class.
    pub fn new(parity: Parity, nodes: &[Vector3<f64>], orbits: &Orbits) -> Self {
        let mut unknowns = Vec::new();
        let mut index = Vec::new();
        for (j, &vertex) in orbits.representatives.iter().enumerate() {
            let p = nodes[vertex];
            // Vertices of positive coordinates only: these are on the plane, or clearly off it.
            let allowed = parity.allowed(p.x <= 0.0, p.y <= 0.0);
            index.push([0, 1, 2].map(|component| {
                allowed[component].then(|| {
                    unknowns.push((j, component));
                    unknowns.len() - 1
                })
            }));
        }
        Self {
            parity,
            unknowns,
            index,
        }
    }

    /// Adds one target's rows to `rows` (three of them, those not wanted are dropped later).
    fn fold(&self, orbits: &Orbits, own: &[Block], other: &[Block], rows: &mut [Vec<f64>; 3]) {
        let swap = self.parity.swap_signs();
        for (image, (own, other)) in orbits.images.iter().zip(own.iter().zip(other)) {
            let signs = self.parity.signs(image);
            for (c, column) in self.index[image.of].iter().enumerate() {
                let Some(column) = *column else { continue };
                for (a, row) in rows.iter_mut().enumerate() {
                    row[column] += signs[c] * (own[a][c] + swap[a] * other[a][c]);
                }
            }
        }
    }

    fn deflate<const H: usize>(
        &self,
        surface: &Surface<H>,
        orbits: &Orbits,
        vertex: usize,
        rows: &mut [Vec<f64>; 3],
    ) {
        let normal = surface.nodes()[vertex];
        for (column, weight) in self.deflation(surface, orbits).enumerate() {
            for (a, row) in rows.iter_mut().enumerate() {
                row[column] += normal[a] * weight;
            }
        }
    }

    /// What multiplies the normal in the rank-one term, for each unknown; nothing for classes that have none.
    pub fn deflation<const H: usize>(
        &self,
        surface: &Surface<H>,
        orbits: &Orbits,
    ) -> impl Iterator<Item = f64> {
        let deflated = self.parity.motion == Motion::Axial;
        let unknowns = self.unknowns.iter().filter(move |_| deflated);
        unknowns.map(|&(j, c)| {
            let v = orbits.representatives[j];
            DEFLATION * orbits.sizes[j] as f64 * surface.deflation(v)[c]
        })
    }
}

/// Matrices of all classes, each row by row.
///
/// Each target is one task, which sums in a fixed order: the same bits for any number of threads.
pub fn assemble<const H: usize>(
    surface: &Surface<H>,
    reference: &[Vector3<f64>],
    orbits: &Orbits,
    classes: &[Class],
    distance: f64,
    reference_distance: f64,
) -> (Vec<Vec<f64>>, Work) {
    let rows: Vec<(Vec<Vec<f64>>, Work)> = orbits
        .representatives
        .par_iter()
        .enumerate()
        .map(|(i, &vertex)| {
            let point = surface.nodes()[vertex];
            let at = reference[vertex];
            let mut own = vec![Block::default(); orbits.images.len()];
            let mut other = own.clone();
            let mut work = Work::default();
            let target = Target {
                point,
                reference: at,
                node: Some(vertex),
            };
            surface.add_row(&target, &mut own, &mut work);
            let target = Target {
                point: mirrored_z(&point, distance),
                reference: mirrored_z(&at, reference_distance),
                node: None,
            };
            surface.add_row(&target, &mut other, &mut work);
            let rows = classes
                .iter()
                .map(|class| {
                    let mut rows = [(); 3].map(|()| vec![0.0; class.unknowns.len()]);
                    class.fold(orbits, &own, &other, &mut rows);
                    class.deflate(surface, orbits, vertex, &mut rows);
                    wanted(&class.index[i], rows)
                })
                .collect();
            (rows, work)
        })
        .collect();
    let mut total = Work::default();
    for (_, work) in &rows {
        total += *work;
    }
    let matrices = (0..classes.len())
        .into_par_iter()
        .map(|k| {
            rows.iter()
                .flat_map(|(of, _)| of[k].iter().copied())
                .collect()
        })
        .collect();
    (matrices, total)
}

fn wanted(index: &[Option<usize>; 3], rows: [Vec<f64>; 3]) -> Vec<f64> {
    let mut out = Vec::with_capacity(3 * rows[0].len());
    for (row, _) in rows
        .iter()
        .zip(index)
        .filter(|(_, unknown)| unknown.is_some())
    {
        out.extend_from_slice(row);
    }
    out
}
