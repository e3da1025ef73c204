//! The hot loop: sums of Stokeslets over the quadrature points of a panel.
//!
//! `G = I/r + r r/r³` (Pozrikidis 1992, equation 2.2.8) is symmetric: six numbers a point, and three
//! of `G y φ`, weighted with the `H` hat functions. Points come as runs of numbers, `x.., y.., z..`,
//! the profile φ, and the weights of the hats (with area and 1/(8 pi) in them), so that distances are
//! computed several at once.

use nalgebra::Vector3;

/// Runs of numbers before those of the hats.
pub const RUNS: usize = 4;

/// Numbers a point, with a zero so that they come in pairs.
const PADDED: usize = 10;

/// For one hat function `∫ G hat` (xx, yy, zz, xy, xz, yz) and `∫ G y φ hat` (x, y, z).
pub type Sums = [f64; PADDED];

/// Adds the integrals of the `N` points in `points` at `target`, for the `H` hat functions.
#[inline]
fn add<const N: usize, const H: usize>(
    points: &[f64],
    target: &Vector3<f64>,
    sums: &mut [Sums; H],
) {
    let (runs, _) = points.as_chunks::<N>();
    let (px, py, pz, profile) = (&runs[0], &runs[1], &runs[2], &runs[3]);
    let (mut x, mut y, mut z, mut s) = ([0.0; N], [0.0; N], [0.0; N], [0.0; N]);
    for q in 0..N {
        x[q] = target.x - px[q];
        y[q] = target.y - py[q];
        z[q] = target.z - pz[q];
        s[q] = 1.0 / (x[q] * x[q] + y[q] * y[q] + z[q] * z[q]).sqrt();
    }
    let mut values = [[0.0; PADDED]; N];
    for q in 0..N {
        let cube = s[q] * s[q] * s[q];
        let (cx, cy, cz) = (cube * x[q], cube * y[q], cube * z[q]);
        let along = profile[q] * (x[q] * px[q] + y[q] * py[q] + z[q] * pz[q]);
        let size = profile[q] * s[q];
        values[q] = [
            s[q] + cx * x[q],
            s[q] + cy * y[q],
            s[q] + cz * z[q],
            cx * y[q],
            cx * z[q],
            cy * z[q],
            size * px[q] + cx * along,
            size * py[q] + cy * along,
            size * pz[q] + cz * along,
            0.0,
        ];
    }
    for (sum, hat) in sums.iter_mut().zip(&runs[RUNS..]) {
        let mut total = *sum;
        for (value, weight) in values.iter().zip(hat) {
            for (t, entry) in total.iter_mut().zip(value) {
                *t += weight * entry;
            }
        }
        *sum = total;
    }
}

/// Adds the integrals of the `count` points in `points` at `target`, for the `H` hat functions.
#[inline]
pub fn add_points<const H: usize>(
    count: usize,
    points: &[f64],
    target: &Vector3<f64>,
    sums: &mut [Sums; H],
) {
    match count {
        4 => add::<4, H>(points, target, sums),
        9 => add::<9, H>(points, target, sums),
        16 => add::<16, H>(points, target, sums),
        25 => add::<25, H>(points, target, sums),
        36 => add::<36, H>(points, target, sums),
        49 => add::<49, H>(points, target, sums),
        64 => add::<64, H>(points, target, sums),
        _ => add::<{ super::CORNER_POINTS }, H>(points, target, sums),
    }
}

/// Adds the velocity by the density of a node, `hat (I + (y φ/φ_v - n) n)`, n the normal there.
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
