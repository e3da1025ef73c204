//! The same loads by a method that shares nothing with the crate's: Lamb's exterior solution about
//! both centres, least squares on points of both spheres.
//!
//! ```text
//! u = Σ_n ∇χ x r + ∇φ - (n-2)/(2n(2n-1)) r^2 ∇p + (n+1)/(n(2n-1)) r p,  p, φ, χ ~ r^-(n+1) P_n^m
//! F = -4π ∇(r^3 p_-2),  T = -8π ∇(r^3 χ_-2)   (by the fluid)
//! ```
//!
//! (Happel & Brenner, *Low Reynolds number hydrodynamics*, 1965, section 3-2). The active sphere, of radius 1,
//! is at the origin, the other one, of radius `q`, at `z = 1 + q + eps`, `d = z`, `t = x`; the former alone moves or squirms: no use is
//! made of the mirror between them, if there is one.

use std::f64::consts::PI;

use exact::Exact;
use nalgebra::DMatrix;
use scene::{ActiveLoads, Gap, Hydrodynamics, LoadSet, PairLoads, SelfOther, SwirlLoads};

/// Components along rho, phi, z, without their factors `cos`, `sin`, `cos` of `m phi`.
type Vector = [f64; 3];

const MODES: usize = 8;

const SET: LoadSet = LoadSet::all(MODES).with_swirl(MODES);

/// `P_k`, `P_k'`, `P_k''` at `x`.
fn legendre(k: usize, x: f64) -> [f64; 3] {
    let mut below = [0.0; 3];
    let mut current = [1.0, 0.0, 0.0];
    for j in 0..k {
        let n = j as f64;
        let next = [
            ((2.0 * n + 1.0) * x * current[0] - n * below[0]) / (n + 1.0),
            x * current[1] + (n + 1.0) * current[0],
            x * current[2] + (n + 2.0) * current[1],
        ];
        below = current;
        current = next;
    }
    current
}

/// Lamb's three velocities of degree `n`, order `m` at `(rho, z)` from the centre: by p, φ, χ.
fn lamb(n: usize, m: usize, rho: f64, z: f64) -> [Vector; 3] {
    let r = rho.hypot(z);
    let sine = rho / r;
    let harmonic = |n: usize| r.powi(-(n as i32) - 1) * sine.powi(m as i32) * legendre(n, z / r)[m];
    let (f, above) = (harmonic(n), harmonic(n + 1));
    let (n, m) = (n as f64, m as f64);
    let f_z = -(n - m + 1.0) * above;
    let f_rho = (-(n + 1.0) * f - z * f_z) / rho;
    let gradient = [f_rho, -m * f / rho, f_z];
    let (a, b) = (
        -(n - 2.0) / (2.0 * n * (2.0 * n - 1.0)) * r * r,
        (n + 1.0) / (n * (2.0 * n - 1.0)) * f,
    );
    let pressure = [
        a * gradient[0] + b * rho,
        a * gradient[1],
        a * gradient[2] + b * z,
    ];
    // χ goes as sin(phi) where p and φ go as cos(phi); for m = 0 it is the twist.
    let swirl = [m * z * f / rho, rho * f_z - z * f_rho, -m * f];
    [pressure, gradient, swirl]
}

/// Polar angles of collocation, crowded where the spheres are close (at angle 0).
fn angles(count: usize) -> Vec<f64> {
    (0..count)
        .map(|j| {
            let s = (j as f64 + 0.5) / count as f64;
            PI * s * (0.35 + 0.65 * s)
        })
        .collect()
}

/// Coefficients of degree 1 on both spheres, `[sphere][kind][case]`, for boundary velocities given
/// on the active sphere at polar angle θ from the other sphere, of radius `q`.
fn degree_one(
    (gap, q): (Gap, f64),
    m: usize,
    kinds: &[usize],
    rows: &[usize],
    cases: &dyn Fn(f64) -> Vec<Vector>,
) -> Vec<Vec<Vec<f64>>> {
    let degree = 24 + (40.0 * (q.max(1.0) / gap.eps()).sqrt()).ceil() as usize;
    let separation = gap.distance_at_ratio(q);
    let angles = angles(3 * degree / 2);
    let count = cases(1.0).len();
    let unknowns = 2 * degree * kinds.len();
    let height = 2 * angles.len() * rows.len();
    let mut matrix = DMatrix::zeros(height, unknowns);
    let mut rhs = DMatrix::zeros(height, count);
    for sphere in 0..2 {
        for (j, &angle) in angles.iter().enumerate() {
            let (sin, cos) = angle.sin_cos();
            let (rho, z) = if sphere == 0 {
                (sin, cos)
            } else {
                (q * sin, separation - q * cos)
            };
            let first = (sphere * angles.len() + j) * rows.len();
            for source in 0..2 {
                for n in 1..=degree {
                    let velocities = lamb(n, m, rho, z - separation * source as f64);
                    for (k, &kind) in kinds.iter().enumerate() {
                        let column = (source * degree + n - 1) * kinds.len() + k;
                        for (i, &row) in rows.iter().enumerate() {
                            matrix[(first + i, column)] = velocities[kind][row];
                        }
                    }
                }
            }
            if sphere == 0 {
                for (case, velocity) in cases(angle).into_iter().enumerate() {
                    for (i, &row) in rows.iter().enumerate() {
                        rhs[(first + i, case)] = velocity[row];
                    }
                }
            }
        }
    }
    let lengths: Vec<f64> = matrix.column_iter().map(|c| c.norm()).collect();
    for (mut column, length) in matrix.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let qr = matrix.qr();
    let solution = qr
        .r()
        .solve_upper_triangular(&qr.q().tr_mul(&rhs))
        .expect("independent columns");
    let coefficient = |sphere: usize, k: usize, case: usize| {
        let row = sphere * degree * kinds.len() + k;
        solution[(row, case)] / lengths[row]
    };
    (0..2)
        .map(|sphere| {
            (0..kinds.len())
                .map(|k| {
                    (0..count)
                        .map(|case| coefficient(sphere, k, case))
                        .collect()
                })
                .collect()
        })
        .collect()
}

/// Translation along z, then slip `W_k(c) (c n - d)`.
fn axial_cases(angle: f64) -> Vec<Vector> {
    let (sin, cos) = angle.sin_cos();
    let slip = (1..=MODES).map(|k| {
        let w = 2.0 * legendre(k, cos)[1] / (k * (k + 1)) as f64;
        [w * cos * sin, 0.0, w * (cos * cos - 1.0)]
    });
    std::iter::once([0.0, 0.0, 1.0]).chain(slip).collect()
}

/// Translation along x, rotation along y, then slip `-2/(k(k+1)) ∇_s [P_k'(n.d) n.t]`, then swirl
/// `-2/(k(k+1)) n x ∇_s [P_k'(n.d) n.t']` with `t' = -y`, so that `d x t'` is x.
fn transverse_cases(angle: f64) -> Vec<Vector> {
    let (sin, cos) = angle.sin_cos();
    let slip = (1..=MODES).map(|k| {
        let [_, first, second] = legendre(k, cos);
        let w = -2.0 / (k * (k + 1)) as f64;
        let along_theta = w * (cos * first - sin * sin * second);
        [along_theta * cos, -w * first, -along_theta * sin]
    });
    let swirl = (1..=MODES).map(|k| {
        let [_, first, second] = legendre(k, cos);
        let w = -2.0 / (k * (k + 1)) as f64;
        [
            w * first * cos,
            w * (second * sin * sin - first * cos),
            -w * first * sin,
        ]
    });
    [[1.0, -1.0, 0.0], [cos, -cos, -sin]]
        .into_iter()
        .chain(slip)
        .chain(swirl)
        .collect()
}

/// Twist, then the swirl `W_k(c) d x n`.
fn twist_cases(angle: f64) -> Vec<Vector> {
    let (sin, cos) = angle.sin_cos();
    let swirl = (1..=MODES).map(|k| {
        let w = 2.0 * legendre(k, cos)[1] / (k * (k + 1)) as f64;
        [0.0, w * sin, 0.0]
    });
    std::iter::once([0.0, sin, 0.0]).chain(swirl).collect()
}

fn loads_by_lamb(gap: Gap, q: f64) -> ActiveLoads {
    let mut loads = PairLoads::zero(LoadSet::all(MODES));
    let (p, chi) = (0, 1);
    let axial = degree_one((gap, q), 0, &[0, 1], &[0, 2], &axial_cases);
    let twist = degree_one((gap, q), 0, &[2], &[1], &twist_cases);
    let transverse = degree_one((gap, q), 1, &[0, 2, 1], &[0, 1, 2], &transverse_cases);
    // Over pi: force by the fluid -4 times, torque -8 times the coefficient of degree 1.
    let force = |c: &[Vec<Vec<f64>>], case: usize, scale: f64| {
        SelfOther::new(-4.0 * c[0][p][case] / scale, -4.0 * c[1][p][case] / scale)
    };
    let torque = |case: usize, scale: f64| {
        SelfOther::new(
            -8.0 * transverse[0][chi][case] / scale,
            -8.0 * transverse[1][chi][case] / scale,
        )
    };
    loads.xa = force(&axial, 0, -6.0);
    loads.ya = force(&transverse, 0, -6.0);
    loads.yb = force(&transverse, 1, 4.0);
    loads.yc = torque(1, -8.0);
    loads.xc = SelfOther::new(twist[0][0][0], twist[1][0][0]);
    for (k, mode) in loads.modes_mut().iter_mut().enumerate() {
        mode.xf = force(&axial, 1 + k, 1.0);
        mode.yf = force(&transverse, 2 + k, 1.0);
        mode.yt = torque(2 + k, 1.0);
    }
    let mut swirl = SwirlLoads::zero(SET);
    for (k, mode) in swirl.modes_mut().iter_mut().enumerate() {
        let by_twist = |sphere: usize| -8.0 * twist[sphere][0][1 + k];
        mode.xtc = SelfOther::new(by_twist(0), by_twist(1));
        mode.yfc = force(&transverse, 2 + MODES + k, 1.0);
        mode.ytc = torque(2 + MODES + k, -1.0);
    }
    ActiveLoads {
        pair: loads,
        torque_on_other: torque(0, 4.0).other(),
        swirl,
    }
}

fn assert_same(what: &str, exact: &ActiveLoads, lamb: &ActiveLoads) {
    for ((name, own), (_, other)) in exact.named(1).into_iter().zip(lamb.named(1)) {
        assert!(
            (own - other).abs() < 1e-10 * other.abs().max(1.0),
            "{name} at {what}: {own:.13} here, {other:.13} by Lamb's solution"
        );
    }
}

#[test]
fn val_all_loads_are_those_of_lambs_solution_about_both_centres() {
    for eps in [2.0, 1.0, 0.5] {
        let gap = Gap::new(eps).unwrap();
        let exact = Exact::new().interacting_loads_of_each(gap, SET).unwrap();
        assert_same(&format!("{eps}"), &exact[0], &loads_by_lamb(gap, 1.0));
    }
}

#[test]
fn val_all_loads_of_unlike_spheres_are_those_of_lambs_solution_about_both_centres() {
    for (q, eps) in [
        (2.0, 0.5),
        (0.5, 0.4),
        (0.3, 0.5),
        (10.0, 5.0),
        (0.1, 0.5),
        (40.0, 30.0),
    ] {
        let gap = Gap::new(eps).unwrap();
        let lamb = loads_by_lamb(gap, q);
        let model = Exact::of_ratio(q).unwrap();
        let [exact, _] = model.interacting_loads_of_each(gap, SET).unwrap();
        assert_same(&format!("{q}, {eps}"), &exact, &lamb);
        // The active sphere as sphere 2.
        let model = Exact::of_ratio(1.0 / q).unwrap();
        let gap = Gap::new(eps / q).unwrap();
        let [_, exact] = model.interacting_loads_of_each(gap, SET).unwrap();
        assert_same(&format!("{q}, {eps} as sphere 2"), &exact, &lamb);
    }
}
