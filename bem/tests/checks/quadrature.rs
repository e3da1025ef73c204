//! Panel integrals against adaptive ones.

use std::f64::consts::PI;

use bem::Bem;
use bem::mesh::{Mesh, Nodes, hats};
use bem::quadrature::{Point, TOLERANCE, product_rule};
use bem::surface::{Block, Profile, Surface, Target, Work, mirror_gap};
use nalgebra::{Matrix3, Vector3};
use scene::Gap;

type Corners = [Vector3<f64>; 3];
type Blocks = [Matrix3<f64>; 6];

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

    fn mesh(&self) -> Mesh {
        Mesh {
            vertices: self.corners.to_vec(),
            triangles: vec![[0, 1, 2]],
        }
    }

    fn surface(&self) -> Surface {
        let mesh = self.mesh();
        Surface::new((mesh.clone(), self.profile), (&mesh, self.profile))
    }

    /// The blocks of the six nodes by one rule over a part with corners `hats`.
    fn plain(&self, part: &[Vector3<f64>; 3], target: &Vector3<f64>) -> Blocks {
        let [a, b, c] = self.corners;
        let volume = a.dot(&b.cross(&c)) * Matrix3::from_columns(part).determinant().abs();
        let nodes = Nodes::<6>::new(&self.mesh()).points;
        let mut sums = [Matrix3::zeros(); 6];
        for point in &self.rule {
            let hat = part[0] * point.hats[0] + part[1] * point.hats[1] + part[2] * point.hats[2];
            let flat = a * hat[0] + b * hat[1] + c * hat[2];
            let y = flat.normalize();
            let area = point.weight * volume / flat.norm().powi(3);
            let r = target - y;
            let stokeslet = (Matrix3::identity() + r * r.transpose() / r.norm_squared()) / r.norm();
            let values = hats::<6>(hat.into());
            for (k, sum) in sums.iter_mut().enumerate() {
                let n = nodes[k];
                let ratio = self.profile.at(&y) / self.profile.at(&n);
                let turn = Matrix3::identity() + (y * ratio - n) * n.transpose();
                *sum += stokeslet * turn * (values[k] * area / (8.0 * PI));
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
    ) -> Blocks {
        let whole = self.plain(&hats, target);
        let [a, b, c] = hats;
        let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
        let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
        let add = |x: Blocks, y: Blocks| std::array::from_fn(|k| x[k] + y[k]);
        let sum =
            |f: &dyn Fn([Vector3<f64>; 3]) -> Blocks| parts.map(f).into_iter().reduce(add).unwrap();
        let divided = sum(&|part| self.plain(&part, target));
        let change: f64 = (0..6).map(|k| (whole[k] - divided[k]).norm()).sum();
        if depth == 0 || change < 1e-13 * scale {
            divided
        } else {
            sum(&|part| self.adaptive(part, target, scale, depth - 1))
        }
    }

    fn check(&self, target: Vector3<f64>, vertex: Option<usize>, tolerance: f64) {
        let mut found = [Block::default(); 6];
        self.surface().add_row(
            &Target {
                point: target,
                reference: target,
                node: vertex,
            },
            &mut found,
            &mut Work::default(),
        );
        let corners = [Vector3::x(), Vector3::y(), Vector3::z()];
        let scale = self.plain(&corners, &target)[3].norm();
        let expected = self.adaptive(corners, &target, scale, 28);
        for (found, expected) in found.iter().zip(&expected) {
            let found = Matrix3::from_fn(|a, c| found[a][c]);
            let error = (found - expected).norm() / scale;
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
        for k in 1..=60 {
            let (s, t) = spread(k);
            let [a, b, c] = panel.corners;
            // Over the panel and around it.
            let over = a + (b - a) * (2.0 * s - 0.5) + (c - a) * (2.0 * t - 0.5);
            let height = size * 10f64.powi(-((k % 6) as i32 - 1));
            panel.check(over.normalize() * (1.0 + height), None, 1e-7);
        }
    }
}

#[test]
fn a_panel_is_integrated_to_a_ten_millionth_at_its_nodes() {
    for size in [0.02, 0.3] {
        let panel = Panel::new(size, 1.0, Profile::alone());
        for (k, &node) in Nodes::<6>::new(&panel.mesh()).points.iter().enumerate() {
            panel.check(node, Some(k), 1e-8);
        }
    }
}

#[test]
fn a_panel_at_contact_is_integrated_with_the_pressures_profile() {
    let eps = 1e-3f64;
    for angle in [0.0, 0.05, 0.3] {
        let size = 0.25 * (angle + eps.sqrt());
        let panel = Panel::new(size, angle, Profile::beside_mirror_image(eps));
        for (k, &corner) in Nodes::<6>::new(&panel.mesh()).points.iter().enumerate() {
            panel.check(corner, Some(k), 1e-7);
            panel.check(
                Vector3::new(corner.x, corner.y, 2.0 + eps - corner.z),
                None,
                1e-7,
            );
        }
    }
}

/// The largest error of an entry of a row, relative to the largest entry, at a point of a sphere of `ratio` times the radius at the gap `eps`, `theta` from contact.
fn error_across(ratio: f64, eps: f64, theta: f64) -> f64 {
    let mirrored = mirror_gap(eps, [1.0, ratio]);
    let mesh = (Bem::of_ratio(1, ratio).unwrap())
        .family(Gap::new(eps).unwrap())
        .at(mirrored);
    let profile = Profile::beside_mirror_image(mirrored);
    let point = Vector3::new(
        0.6 * ratio * theta.sin(),
        0.8 * ratio * theta.sin(),
        // The other sphere's centre less what the point is above it.
        1.0 + eps + ratio * 2.0 * (0.5 * theta).sin().powi(2),
    );
    let [found, truth] = [TOLERANCE, 1e-13].map(|tolerance| {
        let surface: Surface =
            Surface::with_tolerance((mesh.clone(), profile), (&mesh, profile), tolerance);
        let mut row = vec![Block::default(); surface.nodes().len()];
        let target = Target {
            point,
            reference: point,
            node: None,
        };
        surface.add_row(&target, &mut row, &mut Work::default());
        row.into_iter().flatten().flatten().collect::<Vec<f64>>()
    });
    let largest = truth.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let off = found.iter().zip(&truth).map(|(a, b)| (a - b).abs());
    off.fold(0.0, f64::max) / largest
}

#[test]
fn panels_are_integrated_to_a_ten_millionth_on_a_sphere_of_any_other_radius() {
    for ratio in [0.01, 0.2, 5.0, 100.0] {
        for of_smaller in [0.01, 0.3, 3.0] {
            for theta in [0.0, 0.01, 0.3, 2.0] {
                let eps = of_smaller * f64::min(1.0, ratio);
                let error = error_across(ratio, eps, theta);
                assert!(error < 1e-7, "{error:e}: {ratio}, gap {eps}, angle {theta}");
            }
        }
    }
}
