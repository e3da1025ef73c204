//! Integrals over the most difficult panels: the longest ones for their width, and those that face the other sphere.
//!
//! The density `φ n` is along the normal `n`, and `φ` is the profile of the pressure between the spheres. The mesh
//! represents this density exactly, so that the error of its flow comes from quadrature alone. The exact flow follows
//! from Legendre polynomials, `φ = Σ φ_l P_l(z)`. On the unit sphere let `V_l = ∇P_l - (l + 1) P_l n` and
//! `W_l = ∇P_l + l P_l n` (Corona & Veerapaneni, *J. Comput. Phys.* 362 (2018) 327). Then `P_l n = (W_l - V_l)/(2l + 1)`,
//! and at the distance `r` from the centre the single layer `S` of both is
//!
//! ```text
//! S V_l = l/((2l + 1)(2l + 3)) r^(-l-2) V_l,
//! S W_l = (l + 1)/((2l + 1)(2l - 1)) r^(-l) W_l + l/(4l + 2) (r^(-l-2) - r^(-l)) V_l.
//! ```

use bem::Bem;
use bem::mesh::{Mesh, Nodes};
use bem::quadrature::TOLERANCE;
use bem::surface::{Block, Profile, Surface, Target, Work, mirrored_z};
use nalgebra::Vector3;
use rayon::prelude::*;
use scene::{Gap, Hydrodynamics};

use super::Rows;
use super::rows::larger;
use crate::{CompareError, Method};

/// How many nodes nearest to contact are tested, and of how many of the longest panels.
const NEAREST: usize = 16;
const LONGEST: usize = 4;

pub(super) fn panels(rows: &mut Rows) -> Result<(), CompareError> {
    let name = Method::Bem.name();
    let why =
        "the quadrature rules are chosen for this relative error of the integral over each panel";
    for level in Bem::LEVELS.0..=Bem::LEVELS.1 {
        let model = Bem::new(level)?;
        let smallest = model.range().smallest;
        let sphere = Sphere::new(&model, smallest)?;
        for (place, across) in [("on the same sphere", false), ("across the gap", true)] {
            rows.add(
                name,
                format!("level {level}, gap {smallest:e}, flow {place}, {NEAREST} nodes nearest to contact: relative error of quadrature"),
                (TOLERANCE, why),
                sphere.error(&sphere.nearest_to_contact(), across),
            );
        }
        let (eps, ratio) = longest(&model, smallest)?;
        let sphere = Sphere::new(&model, eps)?;
        let nodes = sphere.of_longest_panels();
        rows.add(
            name,
            format!("level {level}, gap {eps:.2e}, nodes of panels with aspect ratios up to {ratio:.1}: relative error of quadrature"),
            (TOLERANCE, why),
            larger(sphere.error(&nodes, false), sphere.error(&nodes, true)),
        );
    }
    Ok(())
}

/// The gap at which a mesh of the model has the panel with the largest aspect ratio, and that ratio. Meshes stretch with
/// the gap between two seams, so that the largest ratio is at one of the ends.
fn longest(model: &Bem, smallest: f64) -> Result<(f64, f64), CompareError> {
    let ends = (model.description().seams.iter()).flat_map(|s| [*s, s.next_up()]);
    let mut worst = (smallest, 0.0);
    for eps in std::iter::once(smallest).chain(ends) {
        let ratio = (model.family(Gap::new(eps)?).at(eps)).worst_aspect_ratio();
        if ratio > worst.1 {
            worst = (eps, ratio);
        }
    }
    Ok(worst)
}

/// A meshed sphere beside its mirror image, and the reference geometry by which its quadrature rules are chosen, as in
/// the systems of equations that the model solves.
struct Sphere {
    eps: f64,
    reference_eps: f64,
    mesh: Mesh,
    nodes: Nodes<6>,
    reference: Vec<Vector3<f64>>,
    profile: Profile,
    surface: Surface,
}

impl Sphere {
    fn new(model: &Bem, eps: f64) -> Result<Self, CompareError> {
        let family = model.family(Gap::new(eps)?);
        let (mesh, made) = (family.at(eps), family.at(family.smallest));
        let profile = Profile::beside_mirror_image(eps);
        let of_reference = Profile::beside_mirror_image(family.smallest);
        Ok(Self {
            eps,
            reference_eps: family.smallest,
            nodes: Nodes::new(&mesh),
            reference: Nodes::<6>::new(&made).points,
            surface: Surface::new((mesh.clone(), profile), (&made, of_reference)),
            mesh,
            profile,
        })
    }

    fn nearest_to_contact(&self) -> Vec<usize> {
        let height = |v: &usize| self.nodes.points[*v].z;
        let mut all: Vec<_> = (0..self.nodes.points.len()).collect();
        all.sort_by(|a, b| height(b).total_cmp(&height(a)));
        all.truncate(NEAREST);
        all
    }

    fn of_longest_panels(&self) -> Vec<usize> {
        let ratio = |panel: usize| {
            let corners = self.mesh.corners(self.mesh.triangles[panel]).to_vec();
            let alone = Mesh {
                vertices: corners,
                triangles: vec![[0, 1, 2]],
            };
            alone.worst_aspect_ratio()
        };
        let mut panels: Vec<_> = (0..self.mesh.triangles.len())
            .map(|k| (k, ratio(k)))
            .collect();
        panels.sort_by(|(_, a), (_, b)| b.total_cmp(a));
        let longest = panels.into_iter().take(LONGEST);
        longest
            .flat_map(|(panel, _)| self.nodes.of_triangle[panel])
            .collect()
    }

    /// Largest error of the flow at some nodes, or at their mirror images on the other sphere, divided by the integral of
    /// the integrand's size.
    fn error(&self, nodes: &[usize], across: bool) -> f64 {
        let of = |&v: &usize| {
            let (point, reference) = (self.nodes.points[v], self.reference[v]);
            let target = if across {
                Target {
                    point: mirrored_z(&point, 2.0 + self.eps),
                    reference: mirrored_z(&reference, 2.0 + self.reference_eps),
                    node: None,
                }
            } else {
                Target {
                    point,
                    reference,
                    node: Some(v),
                }
            };
            let mut row = vec![Block::default(); self.nodes.points.len()];
            self.surface
                .add_row(&target, &mut row, &mut Work::default());
            let mut flow = Vector3::zeros();
            for (block, normal) in row.iter().zip(&self.nodes.points) {
                let density = normal * self.profile.at(normal);
                for (sum, line) in flow.iter_mut().zip(block) {
                    *sum += Vector3::from(*line).dot(&density);
                }
            }
            let (expected, size) = flow_by_profile(self.eps, &target.point);
            (flow - expected).norm() / size
        };
        nodes.par_iter().map(of).reduce(|| 0.0, larger)
    }
}

/// Flow of the density `φ n` at a point on or outside the sphere, and the integral of the largest size that the integrand
/// may have, `2 φ/(8 pi r)`: that is `Σ φ_l r^(-l-1) P_l/(2l + 1)`.
fn flow_by_profile(eps: f64, point: &Vector3<f64>) -> (Vector3<f64>, f64) {
    let r = point.norm();
    let n = point / r;
    // The unit vector of the polar angle, times the sine of that angle.
    let downward = n * n.z - Vector3::z();
    // P_l and its derivative by z, of the last two degrees.
    let (mut p, mut dp) = ([0.0, 1.0], [0.0, 0.0]);
    let (mut flow, mut size, mut fall) = (Vector3::zeros(), 0.0, 1.0);
    for (l, phi) in profile_coefficients(eps).into_iter().enumerate() {
        let degree = l as f64;
        let (along, slope) = (n * p[1], -downward * dp[1]);
        let (v, w) = (slope - along * (degree + 1.0), slope + along * degree);
        let (near, odd) = (fall / (r * r), 2.0 * degree + 1.0);
        let of_v = v * (degree / (odd * (odd + 2.0)) * near);
        let of_w = w * ((degree + 1.0) / (odd * (odd - 2.0)) * fall)
            + v * (degree / (2.0 * odd) * (near - fall));
        flow += (of_w - of_v) * (phi / odd);
        size += phi / odd * fall / r * p[1];
        let next = (odd * n.z * p[1] - degree * p[0]) / (degree + 1.0);
        let next_slope = dp[0] + odd * p[1];
        (p, dp) = ([p[1], next], [dp[1], next_slope]);
        fall /= r;
    }
    (flow, size)
}

/// Coefficients `φ_l = -(2l + 1) Q_l'(c)/4` of `1/(4 (c - z)^2)`, `c = 1 + eps/2`, until they are below rounding. `Q_l`
/// are Legendre functions of the second kind, computed by downward recurrence (Abramowitz & Stegun 8.6, 8.8.3).
fn profile_coefficients(eps: f64) -> Vec<f64> {
    let c = 1.0 + 0.5 * eps;
    let square = eps + 0.25 * eps * eps;
    // They fall as exp(-l acosh(c)).
    let decay = (0.5 * eps + square.sqrt()).ln_1p();
    let count = (40.0 / decay).ceil() as usize + 10;
    let mut q = vec![0.0; 2 * count + 2];
    q[2 * count] = f64::MIN_POSITIVE;
    for l in (1..=2 * count).rev() {
        let degree = l as f64;
        q[l - 1] = ((2.0 * degree + 1.0) * c * q[l] - (degree + 1.0) * q[l + 1]) / degree;
    }
    let scale = 0.5 * (4.0 / eps).ln_1p() / q[0];
    (0..count)
        .map(|l| {
            let degree = l as f64;
            let slope = if l == 0 {
                -1.0
            } else {
                degree * scale * (c * q[l] - q[l - 1])
            };
            -0.25 * (2.0 * degree + 1.0) * slope / square
        })
        .collect()
}
