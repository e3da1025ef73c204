//! Rows of the systems, folded by the mirrors x and y.
//!
//! ```text
//! A_ij = Σ_g χ(g) S(x_i, g x_j) R_g
//! ```
//!
//! with the images g of the vertex j under the mirrors and their signs `χ(g) R_g`. To axial systems a
//! rank-one term is added for each sphere that fixes the multiple of the normal in its density, which induces no
//! flow (Pozrikidis 1992, section 4.2).

use std::f64::consts::PI;

use rayon::prelude::*;

use super::parity::Motion;
use super::side::Side;
use crate::surface::Work;

/// Size of the rank-one term, about that of the single layer's own eigenvalues.
const DEFLATION: f64 = 1.0 / (2.0 * PI);

/// The three rows of a target; those not wanted are dropped later.
pub type Rows = [Vec<f64>; 3];

/// Unknowns of one sphere for one kind of motion.
pub struct Unknowns {
    /// The kind of motion.
    pub motion: Motion,
    /// Representative and component of each unknown.
    pub list: Vec<(usize, usize)>,
    /// Unknown of each component of each representative, if it has one.
    index: Vec<[Option<usize>; 3]>,
}

impl Unknowns {
    /// Numbers the unknowns.
    pub fn new<const H: usize>(motion: Motion, side: &Side<'_, H>) -> Self {
        let mut list = Vec::new();
        let mut index = Vec::new();
        for (j, &vertex) in side.orbits.representatives.iter().enumerate() {
            let p = side.surface.nodes()[vertex];
            // Vertices of positive coordinates only: these are on the plane, or clearly off it.
            let allowed = motion.allowed(p.x <= 0.0, p.y <= 0.0);
            index.push([0, 1, 2].map(|component| {
                allowed[component].then(|| {
                    list.push((j, component));
                    list.len() - 1
                })
            }));
        }
        Self {
            motion,
            list,
            index,
        }
    }

    /// Adds one target's rows to `rows`, in the columns from `first` on; `entry(v, a, c)` is the velocity along a by the density along c
    /// at the vertex v.
    pub fn fold<const H: usize>(
        &self,
        side: &Side<'_, H>,
        entry: impl Fn(usize, usize, usize) -> f64,
        first: usize,
        rows: &mut Rows,
    ) {
        for (v, image) in side.orbits.images.iter().enumerate() {
            let signs = self.motion.signs(image);
            for (c, column) in self.index[image.of].iter().enumerate() {
                let Some(column) = *column else { continue };
                for (a, row) in rows.iter_mut().enumerate() {
                    row[first + column] += signs[c] * entry(v, a, c);
                }
            }
        }
    }

    /// Adds the rank-one term to the rows of the sphere's own representative `i`.
    pub fn deflate<const H: usize>(
        &self,
        side: &Side<'_, H>,
        weights: &[f64],
        i: usize,
        first: usize,
        rows: &mut Rows,
    ) {
        let normal = side.surface.nodes()[side.orbits.representatives[i]];
        for (column, weight) in weights.iter().enumerate() {
            for (a, row) in rows.iter_mut().enumerate() {
                row[first + column] += normal[a] * weight;
            }
        }
    }

    /// What multiplies the normal in the rank-one term, for each unknown; nothing for motions that have none.
    pub fn deflation<const H: usize>(&self, side: &Side<'_, H>) -> Vec<f64> {
        let deflated = self.motion == Motion::Axial;
        let unknowns = self.list.iter().filter(|_| deflated);
        unknowns
            .map(|&(j, c)| {
                let v = side.orbits.representatives[j];
                DEFLATION * side.orbits.sizes[j] as f64 * side.surface.deflation(v)[c]
            })
            .collect()
    }

    /// The rows of representative `i` that belong to an unknown, one after the other.
    pub fn wanted(&self, i: usize, rows: &Rows) -> Vec<f64> {
        let mut out = Vec::with_capacity(3 * rows[0].len());
        for (row, _) in (rows.iter().zip(&self.index[i])).filter(|(_, unknown)| unknown.is_some()) {
            out.extend_from_slice(row);
        }
        out
    }
}

/// Matrices of `systems` systems, each row by row, from the rows that each target has in each of them.
///
/// Each target is one task, which sums in a fixed order: the same bits for any number of threads.
pub fn gathered(
    targets: usize,
    systems: usize,
    rows_of: impl Fn(usize) -> (Vec<Vec<f64>>, Work) + Sync + Send,
) -> (Vec<Vec<f64>>, Work) {
    let rows: Vec<(Vec<Vec<f64>>, Work)> = (0..targets).into_par_iter().map(rows_of).collect();
    let mut total = Work::default();
    for (_, work) in &rows {
        total += *work;
    }
    let matrices = (0..systems)
        .into_par_iter()
        .map(|k| {
            rows.iter()
                .flat_map(|(of, _)| of[k].iter().copied())
                .collect()
        })
        .collect();
    (matrices, total)
}

/// Rows of zeros.
pub fn zeros(columns: usize) -> Rows {
    [(); 3].map(|()| vec![0.0; columns])
}
