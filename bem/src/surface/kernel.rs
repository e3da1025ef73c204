//! The hot loop: sums of Stokeslets over the quadrature points of a panel.
//!
//! `G = I/r + r r/r³` (Pozrikidis 1992, equation 2.2.8) is symmetric: six numbers a point, and three
//! of `G y φ`, weighted with the three hat functions. Points come as seven runs of numbers, `x.., y..,
//! z..`, the weights of the three hats (with area and 1/(8 pi) in them) and the profile φ, so that
//! distances are computed several at once.

use nalgebra::Vector3;

/// Runs of numbers that describe the points of a panel.
pub const RUNS: usize = 7;

/// For one hat function `∫ G hat` (xx, yy, zz, xy, xz, yz) and `∫ G y φ hat` (x, y, z).
pub type Sums = [f64; 9];

/// Adds the integrals of the `N` points in `points` at `target`, for the three hat functions.
#[inline]
pub fn add<const N: usize>(points: &[f64], target: &Vector3<f64>, sums: &mut [Sums; 3]) {
    let (runs, _) = points.as_chunks::<N>();
    let (px, py, pz) = (&runs[0], &runs[1], &runs[2]);
    let hats = [&runs[3], &runs[4], &runs[5]];
    let profile = &runs[RUNS - 1];
    let (mut x, mut y, mut z, mut s) = ([0.0; N], [0.0; N], [0.0; N], [0.0; N]);
    for q in 0..N {
        x[q] = target.x - px[q];
        y[q] = target.y - py[q];
        z[q] = target.z - pz[q];
        s[q] = 1.0 / (x[q] * x[q] + y[q] * y[q] + z[q] * z[q]).sqrt();
    }
    let mut total = *sums;
    for q in 0..N {
        let cube = s[q] * s[q] * s[q];
        let (cx, cy, cz) = (cube * x[q], cube * y[q], cube * z[q]);
        let along = profile[q] * (x[q] * px[q] + y[q] * py[q] + z[q] * pz[q]);
        let size = profile[q] * s[q];
        let g = [
            s[q] + cx * x[q],
            s[q] + cy * y[q],
            s[q] + cz * z[q],
            cx * y[q],
            cx * z[q],
            cy * z[q],
            size * px[q] + cx * along,
            size * py[q] + cy * along,
            size * pz[q] + cz * along,
        ];
        for (sum, hat) in total.iter_mut().zip(&hats) {
            for (t, entry) in sum.iter_mut().zip(g) {
                *t += hat[q] * entry;
            }
        }
    }
    *sums = total;
}

/// [`add`] for the product rule of `order` points in each direction.
#[inline]
pub fn add_order(order: usize, points: &[f64], target: &Vector3<f64>, sums: &mut [Sums; 3]) {
    match order {
        2 => add::<4>(points, target, sums),
        3 => add::<9>(points, target, sums),
        4 => add::<16>(points, target, sums),
        5 => add::<25>(points, target, sums),
        6 => add::<36>(points, target, sums),
        _ => add::<49>(points, target, sums),
    }
}

/// Adds the velocity by the density of a vertex, `hat (I + (y φ/φ_v - n) n)`, n the normal there.
#[inline]
pub fn add_block(sums: &Sums, normal: &Vector3<f64>, profile: f64, block: &mut [[f64; 3]; 3]) {
    let [xx, yy, zz, xy, xz, yz, ..] = *sums;
    let symmetric = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    for (a, (out, row)) in block.iter_mut().zip(&symmetric).enumerate() {
        let at_vertex = row[0] * normal.x + row[1] * normal.y + row[2] * normal.z;
        let change = sums[6 + a] / profile - at_vertex;
        for (b, slot) in out.iter_mut().enumerate() {
            *slot += row[b] + change * normal[b];
        }
    }
}
