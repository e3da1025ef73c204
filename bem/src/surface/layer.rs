//! The flow of one sphere's densities, once they are known: velocity, pressure and velocity gradient anywhere.
//!
//! ```text
//! u = 1/(8 pi) ∫ (I/r + r r/r³) f dS,   p = 1/(4 pi) ∫ r.f/r³ dS,   r = x - y
//! ```
//!
//! (Pozrikidis 1992, section 2.2). A panel near a point is divided until each part is far enough from it, which works up to the surface itself for the velocity:
//! what the smallest part adds there is as small as its size. Pressure and gradient are one degree more singular and jump across the surface:
//! they are those of a point [`NEAREST`] outside.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::panel::Panel;
use super::{Profile, Surface, degree};
use crate::mesh::hats;
use crate::quadrature::{ORDERS, Point, TOLERANCE, order_for, order_limits};

/// Least distance of a point from the surface at which pressure and gradient are summed up, in radii; closer points are moved out to it.
const NEAREST: f64 = 1e-6;

/// Deepest division of a panel near a point. Parts are then of size 1e-8, and so is what is left out.
const DEEPEST: usize = 24;

/// A quadrature point: where it is, and the density there times area over 8 pi.
#[derive(Clone, Copy, Debug)]
struct Source {
    at: Vector3<f64>,
    force: Vector3<f64>,
}

/// What the sources are summed up to.
trait Sum: Default {
    /// Adds what a source does at a point.
    fn add(&mut self, source: &Source, point: &Vector3<f64>);
}

/// Velocity and pressure.
#[derive(Clone, Copy, Debug, Default)]
pub struct Motion {
    /// Velocity.
    pub velocity: Vector3<f64>,
    /// Pressure.
    pub pressure: f64,
}

impl Sum for Motion {
    #[inline]
    fn add(&mut self, source: &Source, point: &Vector3<f64>) {
        let r = point - source.at;
        let inverse = 1.0 / r.norm();
        let along = r.dot(&source.force) * inverse * inverse * inverse;
        self.velocity += source.force * inverse + r * along;
        self.pressure += 2.0 * along;
    }
}

/// Velocity gradient, `d u_i / d x_j`.
#[derive(Clone, Copy, Debug, Default)]
struct Gradient(Matrix3<f64>);

impl Sum for Gradient {
    #[inline]
    fn add(&mut self, source: &Source, point: &Vector3<f64>) {
        let r = point - source.at;
        let square = 1.0 / r.norm_squared();
        let cube = square * square.sqrt();
        let along = r.dot(&source.force) * cube;
        // -f r/r³ + I r.f/r³ + r f/r³ - 3 r r (r.f)/r⁵.
        let row = (source.force * cube) - r * (3.0 * along * square);
        self.0 += r * row.transpose() - source.force * (r * cube).transpose();
        for k in 0..3 {
            self.0[(k, k)] += along;
        }
    }
}

/// A meshed unit sphere with its densities.
#[derive(Clone, Debug)]
pub struct Layer<const H: usize = 6> {
    profile: Profile,
    panels: Vec<Panel>,
    /// For each panel and node the part of the density across the normal there, and the part along it over the profile there.
    densities: Vec<[(Vector3<f64>, f64); H]>,
    rules: Vec<Vec<Point>>,
    /// For each order, the sources of all panels.
    sources: Vec<Vec<Source>>,
    limits: Vec<f64>,
}

impl<const H: usize> Layer<H> {
    /// The densities `f`, node by node, on a surface.
    pub(super) fn new(surface: &Surface<H>, f: &[Vector3<f64>]) -> Self {
        let profile = surface.profile;
        let node = |v: usize| {
            let normal = surface.nodes.points[v];
            let along = normal.dot(&f[v]);
            (f[v] - normal * along, along / profile.at(&normal))
        };
        let mut layer = Self {
            profile,
            panels: surface.panels.iter().map(Panel::as_it_is).collect(),
            densities: (surface.nodes.of_triangle.iter())
                .map(|of| of.map(node))
                .collect(),
            rules: surface.rules.clone(),
            sources: Vec::new(),
            limits: order_limits(TOLERANCE, degree::<H>()),
        };
        layer.sources = (layer.rules.iter())
            .map(|rule| {
                let of_panel = |k: usize| layer.sources_of(k, layer.panels[k], rule);
                (0..layer.panels.len()).flat_map(of_panel).collect()
            })
            .collect();
        layer
    }

    /// Velocity and pressure at a point. On the surface the velocity is that there, the pressure the one outside.
    pub fn at(&self, point: &Vector3<f64>) -> Motion {
        let outside = moved_out(point);
        let found: Motion = self.sum(&outside);
        if outside == *point {
            return found;
        }
        let Motion { velocity, .. } = self.sum(point);
        Motion { velocity, ..found }
    }

    /// Velocity gradient at a point; on the surface that outside.
    pub fn gradient(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        self.sum::<Gradient>(&moved_out(point)).0
    }

    /// The density at a unit normal, by the hat functions of its panel.
    pub fn density(&self, normal: &Vector3<f64>) -> Vector3<f64> {
        let inside = |k: usize| {
            let at = self.panels[k].barycentric(normal);
            (k, at, at.into_iter().fold(f64::INFINITY, f64::min))
        };
        // The panel that it is deepest in: on an edge rounding may put it outside both.
        let deepest = (0..self.panels.len()).map(inside);
        let Some((k, at, _)) = deepest.max_by(|a, b| a.2.total_cmp(&b.2)) else {
            return Vector3::zeros();
        };
        self.density_in(k, at, normal)
    }

    /// A point of each panel at which the velocity is not matched: its middle and a place on an edge, by turns.
    pub fn between_nodes(&self) -> impl Iterator<Item = Vector3<f64>> {
        const PLACES: [[f64; 3]; 4] = [
            [1.0 / 3.0; 3],
            [0.75, 0.25, 0.0],
            [0.0, 0.75, 0.25],
            [0.25, 0.0, 0.75],
        ];
        let at = |(panel, hats): (&Panel, [f64; 3])| panel.at(&Point { hats, weight: 0.0 }).0;
        self.panels.iter().zip(PLACES.into_iter().cycle()).map(at)
    }

    fn density_in(&self, panel: usize, at: [f64; 3], normal: &Vector3<f64>) -> Vector3<f64> {
        let mut across = Vector3::zeros();
        let mut along = 0.0;
        for ((t, s), hat) in self.densities[panel].iter().zip(hats::<H>(at)) {
            across += t * hat;
            along += s * hat;
        }
        across + normal * (along * self.profile.at(normal))
    }

    fn sources_of<'a>(
        &'a self,
        panel: usize,
        part: Panel,
        rule: &'a [Point],
    ) -> impl Iterator<Item = Source> + 'a {
        rule.iter().map(move |point| {
            let (at, area) = part.at(point);
            let coordinates = part.in_whole(point.hats);
            Source {
                at,
                force: self.density_in(panel, coordinates, &at) * (area / (8.0 * PI)),
            }
        })
    }

    fn order(&self, panel: &Panel, point: &Vector3<f64>) -> Option<usize> {
        order_for(&self.limits, panel.distance(point, &self.profile))
    }

    fn sum<S: Sum>(&self, point: &Vector3<f64>) -> S {
        let mut sum = S::default();
        for (k, panel) in self.panels.iter().enumerate() {
            if let Some(order) = self.order(panel, point) {
                let count = order * order;
                let all = &self.sources[order - ORDERS.start()];
                for source in &all[k * count..(k + 1) * count] {
                    sum.add(source, point);
                }
            } else {
                self.add_near(k, panel, point, 0, &mut sum);
            }
        }
        sum
    }

    fn add_near<S: Sum>(
        &self,
        k: usize,
        panel: &Panel,
        point: &Vector3<f64>,
        depth: usize,
        sum: &mut S,
    ) {
        for part in panel.quarters() {
            match self.order(&part, point) {
                None if depth < DEEPEST => self.add_near(k, &part, point, depth + 1, sum),
                // The last part holds the point or touches it.
                None => {}
                Some(order) => {
                    for source in self.sources_of(k, part, &self.rules[order - ORDERS.start()]) {
                        sum.add(&source, point);
                    }
                }
            }
        }
    }
}

/// The point, or the one above it that is far enough outside if it is on the surface.
fn moved_out(point: &Vector3<f64>) -> Vector3<f64> {
    let height = point.norm() - 1.0;
    if height.abs() < NEAREST {
        point * ((1.0 + NEAREST) / (1.0 + height))
    } else {
        *point
    }
}
