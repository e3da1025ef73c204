//! Panel integrals against adaptive ones.

#![allow(clippy::unwrap_used, reason = "a test may panic, its helpers too")]

use std::f64::consts::PI;

use bem::mesh::Mesh;
use bem::quadrature::{Point, product_rule};
use bem::surface::{Block, Profile, Surface, Target};
use nalgebra::{Matrix3, Vector3};

type Corners = [Vector3<f64>; 3];

struct Panel {
    corners: Corners,
    profile: Profile,
    rule: Vec<Point>,
}

impl Panel {
    /// A panel of size `size`, not quite equilateral, `angle` away from the pole +z.
    fn new(size: f64, angle: f64, profile: Profile) -> Self {
        let middle = Vector3::new(angle.sin(), 0.0, angle.cos());
        let (u, v) = (Vector3::new(angle.cos(), 0.0, -angle.sin()), Vector3::y());
        let corner = |a: f64, b: f64| (middle + (u * a + v * b) * size).normalize();
        Self {
            corners: [corner(-0.5, -0.4), corner(0.6, -0.2), corner(-0.1, 0.5)],
            profile,
            rule: product_rule(10),
        }
    }

    fn surface(&self) -> Surface {
        let mesh = Mesh {
            vertices: self.corners.to_vec(),
            triangles: vec![[0, 1, 2]],
        };
        Surface::new((mesh.clone(), self.profile), (&mesh, self.profile))
    }

    /// The blocks of the three vertices by one rule over a part with corners `hats`.
    fn plain(&self, hats: &[Vector3<f64>; 3], target: &Vector3<f64>) -> [Matrix3<f64>; 3] {
        let [a, b, c] = self.corners;
        let volume = a.dot(&b.cross(&c)) * Matrix3::from_columns(hats).determinant().abs();
        let mut sums = [Matrix3::zeros(); 3];
        for point in &self.rule {
            let hat = hats[0] * point.hats[0] + hats[1] * point.hats[1] + hats[2] * point.hats[2];
            let flat = a * hat[0] + b * hat[1] + c * hat[2];
            let y = flat.normalize();
            let area = point.weight * volume / flat.norm().powi(3);
            let r = target - y;
            let stokeslet = (Matrix3::identity() + r * r.transpose() / r.norm_squared()) / r.norm();
            for (k, sum) in sums.iter_mut().enumerate() {
                let n = self.corners[k];
                let ratio = self.profile.at(&y) / self.profile.at(&n);
                let turn = Matrix3::identity() + (y * ratio - n) * n.transpose();
                *sum += stokeslet * turn * (hat[k] * area / (8.0 * PI));
            }
        }
        sums
    }

    fn adaptive(
        &self,
        hats: [Vector3<f64>; 3],
        target: &Vector3<f64>,
        scale: f64,
        depth: usize,
    ) -> [Matrix3<f64>; 3] {
        let whole = self.plain(&hats, target);
        let [a, b, c] = hats;
        let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
        let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
        let add =
            |x: [Matrix3<f64>; 3], y: [Matrix3<f64>; 3]| [x[0] + y[0], x[1] + y[1], x[2] + y[2]];
        let sum = |f: &dyn Fn([Vector3<f64>; 3]) -> [Matrix3<f64>; 3]| {
            parts.map(f).into_iter().reduce(add).unwrap()
        };
        let divided = sum(&|part| self.plain(&part, target));
        let change: f64 = (0..3).map(|k| (whole[k] - divided[k]).norm()).sum();
        if depth == 0 || change < 1e-13 * scale {
            divided
        } else {
            sum(&|part| self.adaptive(part, target, scale, depth - 1))
        }
    }

    fn check(&self, target: Vector3<f64>, vertex: Option<usize>, tolerance: f64) {
        let mut found = [Block::default(); 3];
        self.surface().add_row(
            &Target {
                point: target,
                reference: target,
                vertex,
            },
            &mut found,
        );
        let corners = [Vector3::x(), Vector3::y(), Vector3::z()];
        let scale = self.plain(&corners, &target)[0].norm();
        let expected = self.adaptive(corners, &target, scale, 28);
        for (found, expected) in found.iter().zip(&expected) {
            let found = Matrix3::from_fn(|a, c| found[a][c]);
            let error = (found - expected).norm() / expected.norm();
            assert!(error < tolerance, "{error:e} at {target:?}");
        }
    }
}

/// Numbers in (0, 1) that look random (golden-ratio sequence).
fn spread(k: u32) -> (f64, f64) {
    (
        (f64::from(k) * 0.754_877_666).fract(),
        (f64::from(k) * 0.569_840_29).fract(),
    )
}

#[test]
fn a_panel_is_integrated_to_a_ten_millionth_however_near_the_target() {
    for size in [0.02, 0.3] {
        let panel = Panel::new(size, 1.0, Profile::alone());
        for k in 1..=24 {
            let (s, t) = spread(k);
            let [a, b, c] = panel.corners;
            // Over the panel and around it.
            let over = a + (b - a) * (2.0 * s - 0.5) + (c - a) * (2.0 * t - 0.5);
            let height = size * 10f64.powi(-((k % 6) as i32 - 1));
            panel.check(over.normalize() * (1.0 + height), None, 1e-6);
        }
    }
}

#[test]
fn a_panel_is_integrated_to_a_ten_millionth_at_its_corners() {
    for size in [0.02, 0.3] {
        let panel = Panel::new(size, 1.0, Profile::alone());
        for k in 0..3 {
            panel.check(panel.corners[k], Some(k), 1e-6);
        }
    }
}

#[test]
fn a_panel_at_contact_is_integrated_with_the_pressures_profile() {
    let eps = 1e-3f64;
    for angle in [0.0, 0.05, 0.3] {
        let size = 0.25 * (angle + eps.sqrt());
        let panel = Panel::new(size, angle, Profile::beside_mirror_image(eps));
        for k in 0..3 {
            let corner = panel.corners[k];
            panel.check(corner, Some(k), 1e-6);
            panel.check(
                Vector3::new(corner.x, corner.y, 2.0 + eps - corner.z),
                None,
                1e-6,
            );
        }
    }
}
