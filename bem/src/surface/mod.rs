//! One meshed unit sphere: the velocity that its densities induce at a point.
//!
//! For the hat function of node v (1 there, 0 at the others, see [`crate::mesh::hats`]) and a target x,
//!
//! ```text
//! S_v(x) = 1/(8 pi) ∫ (I/r + r r/r³) T_v(y) hat_v(y) dS(y),   r = x - y,
//! T_v(y) = I + (n(y) φ(y)/φ(v) - n_v) n_v,
//! ```
//!
//! so that the part of the density along the normal turns with the normal, and is interpolated
//! relative to the pressure's own [`Profile`] φ: in a narrow gap the pressure is of size `1/eps²`, and
//! squeeze flow is what little is left after the two spheres' contributions cancel.

mod kernel;
mod layer;
mod panel;
mod profile;
mod work;

use nalgebra::Vector3;
use rayon::prelude::*;

use crate::mesh::{Mesh, Nodes, hats, local_nodes};
use crate::quadrature::{
    ORDERS, Point, TOLERANCE, corner_rule, order_for, order_limits, product_rule,
};
use kernel::{RUNS, Sums};
use panel::Panel;
use work::Stopwatch;

pub(crate) use layer::Layer;
pub use profile::{Profile, mirror_gap};
pub use work::{Share, Work};

/// Points of the rule for a target at a corner, along its rays and across them.
const CORNER: (usize, usize) = (14, 28);
pub(crate) const CORNER_POINTS: usize = CORNER.0 * CORNER.1;

/// Order of the rule for smooth velocities times hat functions.
const SMOOTH: usize = 6;

/// Deepest division of a panel near a target.
const DEEPEST: usize = 40;

/// `S_v(x)`, row by row.
pub type Block = [[f64; 3]; 3];

/// A point mirrored in the plane between two spheres whose centres are `distance` apart.
#[must_use]
pub fn mirrored_z(point: &Vector3<f64>, distance: f64) -> Vector3<f64> {
    Vector3::new(point.x, point.y, distance - point.z)
}

/// A point at which the velocity is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The point, relative to the sphere's centre.
    pub point: Vector3<f64>,
    /// Where it is in the reference geometry, which decides how many points each panel gets.
    pub reference: Vector3<f64>,
    /// The node that it is, if it is one.
    pub node: Option<usize>,
}

/// `∫ hat`, `∫ y hat`, `∫ φ hat` and `∫ y φ hat` over the surface, for one vertex.
#[derive(Clone, Copy, Debug, Default)]
struct HatIntegrals {
    area: f64,
    moment: Vector3<f64>,
    profile: f64,
    profile_moment: Vector3<f64>,
}

/// A meshed unit sphere with its quadrature points.
///
/// Rules are chosen by a reference mesh of the same topology, so that for meshes of one family
/// each integral is a smooth function of the gap: no rule switches as the gap changes.
#[derive(Clone, Debug)]
pub struct Surface<const H: usize = 6> {
    nodes: Nodes<H>,
    panels: Vec<Panel>,
    /// For each order, the quadrature points of all panels, see [`Panel::fill`].
    points: Vec<Vec<f64>>,
    rules: Vec<Vec<Point>>,
    corner: Vec<Point>,
    limits: Vec<f64>,
    profile: Profile,
    reference_profile: Profile,
    hats: Vec<HatIntegrals>,
}

impl<const H: usize> Surface<H> {
    /// The sphere with a mesh and a profile, with rules chosen on `reference`, accurate to [`TOLERANCE`].
    #[must_use]
    pub fn new(geometry: (Mesh, Profile), reference: (&Mesh, Profile)) -> Self {
        Self::with_tolerance(geometry, reference, TOLERANCE)
    }

    /// The same with integrals of relative error `tolerance` over each panel.
    #[must_use]
    pub fn with_tolerance(
        geometry: (Mesh, Profile),
        reference: (&Mesh, Profile),
        tolerance: f64,
    ) -> Self {
        let mesh = geometry.0;
        let rules: Vec<Vec<Point>> = ORDERS.map(product_rule).collect();
        let panels: Vec<Panel> = mesh
            .triangles
            .iter()
            .map(|&t| Panel::new(mesh.corners(t), reference.0.corners(t)))
            .collect();
        let points = rules
            .par_iter()
            .map(|rule| {
                let length = (RUNS + H) * rule.len();
                let mut all = vec![0.0; length * panels.len()];
                for (panel, slots) in panels.iter().zip(all.chunks_exact_mut(length)) {
                    panel.fill::<H>(rule, &geometry.1, slots);
                }
                all
            })
            .collect();
        let nodes = Nodes::<H>::new(&mesh);
        let mut surface = Self {
            hats: vec![HatIntegrals::default(); nodes.points.len()],
            profile: geometry.1,
            reference_profile: reference.1,
            nodes,
            panels,
            points,
            rules,
            corner: corner_rule(CORNER.0, CORNER.1),
            limits: order_limits(tolerance, degree::<H>()),
        };
        surface.integrate_hats();
        surface
    }

    /// The nodes, which are the places of the densities and of the velocities to match.
    #[must_use]
    pub fn nodes(&self) -> &[Vector3<f64>] {
        &self.nodes.points
    }

    /// The flow of the densities `f`, given node by node.
    pub(crate) fn layer(&self, f: &[Vector3<f64>]) -> Layer<H> {
        Layer::new(self, f)
    }

    /// The functional that is to vanish, so that the multiple of the normal in the density is fixed:
    /// `((1 - z)/2)² ∫ n.T_v f hat_v dS` for the density f at vertex v, as a vector to multiply f with.
    ///
    /// It measures away from the gap: else the pressure there would raise that everywhere else.
    #[must_use]
    pub fn deflation(&self, v: usize) -> Vector3<f64> {
        // n.(f + (n φ/φ_v - n_v)(n_v.f)) = n.f + (φ/φ_v - n.n_v)(n_v.f).
        let (hat, normal) = (&self.hats[v], self.nodes.points[v]);
        let along = hat.profile / self.profile.at(&normal) - hat.moment.dot(&normal);
        (hat.moment + normal * along) * (0.5 * (1.0 - normal.z)).powi(2)
    }

    /// Force and torque on the fluid, `∫ T_v f hat_v dS` and `∫ y x T_v f hat_v dS`, by the density f
    /// at vertex v.
    #[must_use]
    pub fn force_and_torque(&self, v: usize, f: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let (hat, normal) = (&self.hats[v], self.nodes.points[v]);
        let along = normal.dot(f);
        let turned = hat.profile_moment / self.profile.at(&normal) - normal * hat.area;
        let force = f * hat.area + turned * along;
        (force, hat.moment.cross(&(f - normal * along)))
    }

    /// `∫ u.T_v f hat_v dS` for the density f at each vertex v and a tangential velocity u given at
    /// the unit normal, as vectors to multiply f with.
    #[must_use]
    pub fn tangential_part(&self, u: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vec<Vector3<f64>> {
        // u.(f + (n φ/φ_v - n_v)(n_v.f)) = u.f - (u.n_v)(n_v.f), since u.n = 0.
        let across = |((sum, _), normal): ((Vector3<f64>, f64), &Vector3<f64>)| {
            sum - normal * normal.dot(&sum)
        };
        let sums = self.integrated(&self.rules[self.rules.len() - 1], u);
        sums.into_iter()
            .zip(&self.nodes.points)
            .map(across)
            .collect()
    }

    /// The same for any velocity u, by a rule of fewer points: it is for smooth ones.
    #[must_use]
    pub fn work(&self, u: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vec<Vector3<f64>> {
        // The normal part of u has φ/φ_v n in place of n_v.
        let part = |((sum, normal_sum), normal): ((Vector3<f64>, f64), &Vector3<f64>)| {
            sum + normal * (normal_sum / self.profile.at(normal) - normal.dot(&sum))
        };
        let sums = self.integrated(&self.rules[SMOOTH - ORDERS.start()], u);
        sums.into_iter().zip(&self.nodes.points).map(part).collect()
    }

    /// `∫ u hat_v dS` and `∫ u.n φ hat_v dS` at each vertex v.
    fn integrated(
        &self,
        rule: &[Point],
        u: impl Fn(&Vector3<f64>) -> Vector3<f64>,
    ) -> Vec<(Vector3<f64>, f64)> {
        let mut sums = vec![(Vector3::zeros(), 0.0); self.nodes.points.len()];
        for (panel, nodes) in self.panels.iter().zip(&self.nodes.of_triangle) {
            for point in rule {
                let (position, area) = panel.at(point);
                let velocity = u(&position) * area;
                let along = velocity.dot(&position) * self.profile.at(&position);
                for (&v, hat) in nodes.iter().zip(hats::<H>(point.hats)) {
                    sums[v].0 += velocity * hat;
                    sums[v].1 += along * hat;
                }
            }
        }
        sums
    }

    fn integrate_hats(&mut self) {
        let rule = &self.rules[self.rules.len() - 1];
        for (panel, nodes) in self.panels.iter().zip(&self.nodes.of_triangle) {
            for point in rule {
                let (position, area) = panel.at(point);
                let profile = self.profile.at(&position);
                for (&v, value) in nodes.iter().zip(hats::<H>(point.hats)) {
                    let hat = &mut self.hats[v];
                    hat.area += area * value;
                    hat.moment += position * (area * value);
                    hat.profile += area * value * profile;
                    hat.profile_moment += position * (area * value * profile);
                }
            }
        }
    }

    /// Adds `S_v(target)` to `row[v]` for every node v, and to `work` what that took.
    pub fn add_row(&self, target: &Target, row: &mut [Block], work: &mut Work) {
        let mut block = vec![0.0; (RUNS + H) * CORNER_POINTS];
        let mut near = Vec::new();
        let mut touching = Vec::new();
        let mut watch = Stopwatch::start();
        for (index, panel) in self.panels.iter().enumerate() {
            let nodes = &self.nodes.of_triangle[index];
            let place = target.node.and_then(|v| nodes.iter().position(|&w| w == v));
            if let Some(place) = place {
                touching.push((index, place));
            } else if let Some(order) = self.order(panel, target) {
                let mut sums = [Sums::default(); H];
                let length = (RUNS + H) * order * order;
                let points = &self.points[order - ORDERS.start()];
                let points = &points[index * length..(index + 1) * length];
                kernel::add_points(order * order, points, &target.point, &mut sums);
                self.add_sums(index, &sums, row);
            } else {
                near.push(index);
            }
        }
        work.far
            .add(self.panels.len() - near.len() - touching.len(), &mut watch);
        for &index in &near {
            let mut sums = [Sums::default(); H];
            self.add_near(&self.panels[index], target, 0, &mut block, &mut sums);
            self.add_sums(index, &sums, row);
        }
        work.near.add(near.len(), &mut watch);
        for &(index, place) in &touching {
            let mut sums = [Sums::default(); H];
            for part in self.panels[index].fan(local_nodes::<H>()[place]) {
                part.fill::<H>(&self.corner, &self.profile, &mut block);
                kernel::add_points(CORNER_POINTS, &block, &target.point, &mut sums);
            }
            self.add_sums(index, &sums, row);
        }
        work.touching.add(touching.len(), &mut watch);
    }

    fn add_sums(&self, panel: usize, sums: &[Sums; H], row: &mut [Block]) {
        for (&v, sum) in self.nodes.of_triangle[panel].iter().zip(sums) {
            let normal = &self.nodes.points[v];
            kernel::add_block(sum, normal, self.profile.at(normal), &mut row[v]);
        }
    }

    fn order(&self, panel: &Panel, target: &Target) -> Option<usize> {
        let distance = panel.distance(&target.reference, &self.reference_profile);
        order_for(&self.limits, distance)
    }

    /// Divides a panel in four until each part is far enough from the target.
    fn add_near(
        &self,
        panel: &Panel,
        target: &Target,
        depth: usize,
        block: &mut [f64],
        sums: &mut [Sums; H],
    ) {
        for part in panel.quarters() {
            match self.order(&part, target) {
                None if depth < DEEPEST => self.add_near(&part, target, depth + 1, block, sums),
                order => {
                    let order = order.unwrap_or(*ORDERS.end());
                    let block = &mut block[..(RUNS + H) * order * order];
                    part.fill::<H>(&self.rules[order - ORDERS.start()], &self.profile, block);
                    kernel::add_points(order * order, block, &target.point, sums);
                }
            }
        }
    }
}

/// Degree of the hat functions.
fn degree<const H: usize>() -> usize {
    match H {
        1 => 0,
        3 => 1,
        _ => 2,
    }
}
