//! Errors of the flow against Stokeslets, stresslets and source doublets within the spheres: their flow is known everywhere.
//!
//! `cargo run --release -p squirmers-bem --example flow -- [LEVEL]`

use std::time::Instant;

use bem::Bem;
use nalgebra::{Matrix3, Vector3};
use scene::{Configuration, Gap, Hydrodynamics};

/// Point singularities within the spheres.
struct Singular([Vector3<f64>; 2]);

/// Velocity and pressure of a Stokeslet of strength `f` at the distance `r` from it, 8 pi left out.
fn stokeslet(r: &Vector3<f64>, f: &Vector3<f64>) -> (Vector3<f64>, f64) {
    let s = r.norm();
    let along = r.dot(f) / s.powi(3);
    (f / s + r * along, 2.0 * along)
}

/// The same of a stresslet `e`, symmetric and without trace.
fn stresslet(r: &Vector3<f64>, e: &Matrix3<f64>) -> (Vector3<f64>, f64) {
    let s = r.norm();
    let twice = r.dot(&(e * r));
    (r * (-3.0 * twice / s.powi(5)), -6.0 * twice / s.powi(5))
}

impl Singular {
    fn at(&self, x: &Vector3<f64>) -> (Vector3<f64>, f64) {
        let f = [Vector3::new(0.7, -0.4, 0.5), Vector3::new(-0.3, 0.8, 0.6)];
        let m = Matrix3::new(0.2, 0.5, -0.1, 0.5, 0.3, 0.4, -0.1, 0.4, -0.5);
        let mut sum = (Vector3::zeros(), 0.0);
        for (k, sign) in [(0, 1.0), (1, -1.0)] {
            let r = x - self.0[k];
            for (u, p) in [stokeslet(&r, &f[k]), stresslet(&r, &(m * sign))] {
                sum = (sum.0 + u * 0.5, sum.1 + p * 0.5);
            }
        }
        sum
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let level = std::env::args().nth(1).map_or(Ok(3), |l| l.parse())?;
    let depth: f64 = std::env::args().nth(2).map_or(Ok(1.0), |l| l.parse())?;
    for (ratio, gap) in [
        (1.0, 50.0),
        (1.0, 1.0),
        (1.0, 0.1),
        (1.0, 0.05),
        (1.0, 0.01),
        (2.0, 0.1),
    ] {
        let bem = Bem::of_ratio(level, ratio)?;
        let line = Vector3::new(0.36, 0.48, -0.8);
        let configuration = Configuration {
            radii: [1.0, bem.description().ratio],
            gap: Gap::new(gap)?,
            midpoint: Vector3::new(0.2, 0.1, -0.4),
            line,
            orientations: [line; 2],
            line_angle_rad: 0.0,
            angles_rad: [0.0; 2],
        };
        let centres = configuration.positions();
        let radii = configuration.radii;
        let inside = |k: usize, at: Vector3<f64>| centres[k] + at * radii[k];
        let truth = Singular([
            inside(0, Vector3::new(0.2, -0.3, 0.1) * depth),
            inside(1, Vector3::new(-0.1, 0.2, 0.25) * depth),
        ]);
        let start = Instant::now();
        let surface = |k: usize, n: &Vector3<f64>| truth.at(&inside(k, *n)).0;
        let layers = bem.layers(&configuration, surface)?;
        let solved = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let mismatch = layers.mismatch(surface);
        let checked = start.elapsed().as_secs_f64();
        let middle = centres[0] + line * (1.0 + 0.5 * gap);
        let across = Vector3::new(0.8, -0.6, 0.0);
        let mut report = format!("ratio {ratio} gap {gap:5}: mismatch {mismatch:.1e}");
        let start = Instant::now();
        let mut count = 0;
        for (name, points) in [
            (
                "gap",
                (0..20)
                    .map(|i| middle + across * (0.02 * f64::from(i)))
                    .collect::<Vec<_>>(),
            ),
            ("on", (0..60).map(|i| inside(i % 2, turn(i))).collect()),
            (
                "near",
                (0..60)
                    .map(|i| inside(i % 2, turn(i) * (1.0 + 0.3f64.powi(1 + (i / 2 % 9) as i32))))
                    .collect(),
            ),
            (
                "far",
                (0..20)
                    .map(|i| turn(i) * (3.0 + f64::from(i as u32)) * (2.0 + gap))
                    .collect(),
            ),
        ] {
            let mut worst = [0.0f64; 3];
            for x in points
                .iter()
                .filter(|x| (0..2).all(|k| (*x - centres[k]).norm() > radii[k] - 1e-9))
            {
                let (u, p) = truth.at(x);
                let found = layers.at(x);
                let step = 1e-4;
                let mut gradient = Matrix3::zeros();
                for k in 0..3 {
                    let e = Vector3::ith(k, step);
                    gradient.set_column(
                        k,
                        &((truth.at(&(x + e)).0 - truth.at(&(x - e)).0) / (2.0 * step)),
                    );
                }
                let errors = [
                    (found.velocity - u).norm(),
                    (found.pressure - p).abs(),
                    (layers.gradient(x) - gradient).norm(),
                ];
                for (worst, error) in worst.iter_mut().zip(errors) {
                    *worst = worst.max(error);
                }
                count += 1;
            }
            report += &format!(
                "; {name} u {:.1e} p {:.1e} G {:.1e}",
                worst[0], worst[1], worst[2]
            );
        }
        let each = start.elapsed().as_secs_f64() / f64::from(count);
        println!("{report}; solve {solved:.2} s, mismatch {checked:.2} s, point {each:.1e} s");
    }
    Ok(())
}

/// Unit vectors all over the sphere.
fn turn(i: usize) -> Vector3<f64> {
    let z = 1.0 - (2.0 * ((i as f64 * 0.618_034) % 1.0));
    let (s, c) = (i as f64 * 2.4).sin_cos();
    let r = (1.0 - z * z).sqrt();
    Vector3::new(r * c, r * s, z)
}
