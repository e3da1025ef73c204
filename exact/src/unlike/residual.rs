//! What is left of the boundary values, at points that the solution does not know of.
//!
//! The answer is at rest on the active sphere and opposite to the lone sphere's flow on the other one. That flow is written out here
//! once more, in spherical coordinates about its own centre, so that the residual also tests its bispherical series.

use super::geometry::Pair;
use super::lone::{Lone, Term};
use crate::field::{SurfacePoint, Velocity, legendre_derivatives, scattered_points};

/// Largest velocity that is left at `2 count` points of each sphere, of the `flows` of either active sphere in turn: `answer` is the
/// velocity that was solved for, by sphere, point and case, `lone` that of a lone sphere at a point about it.
pub fn residual(
    pair: &Pair,
    count: usize,
    flows: &[Lone],
    answer: impl Fn(usize, &SurfacePoint, usize) -> Velocity,
    lone: impl Fn(&Lone, &Around) -> Velocity,
) -> f64 {
    let mut largest: f64 = 0.0;
    for sphere in [0, 1] {
        let geometry = pair.spheres[sphere];
        for mu in scattered_points(&geometry, count) {
            let point = SurfacePoint::new(geometry, mu);
            let around = Around::new(pair, sphere, &point);
            for (case, flow) in flows.iter().chain(flows).enumerate() {
                let active = case / flows.len();
                let expected = if active == sphere {
                    Velocity::default()
                } else {
                    lone(flow, &around).reversed()
                };
                largest = largest.max(answer(sphere, &point, case).distance(expected));
            }
        }
    }
    largest
}

/// A point on one sphere as seen from the centre of the other one, the polar axis towards the former.
pub struct Around {
    radius: f64,
    cosine: f64,
    sine: f64,
}

impl Around {
    fn new(pair: &Pair, sphere: usize, point: &SurfacePoint) -> Self {
        let (own, other) = (pair.spheres[sphere], pair.spheres[1 - sphere]);
        // In units of the other sphere's radius.
        let along = other.sinh * own.sinh / own.denominator(point.mu) + other.cosh;
        let across = point.radius() * (other.sinh / own.sinh);
        let radius = along.hypot(across);
        Self {
            radius,
            cosine: along / radius,
            sine: across / radius,
        }
    }

    fn sum(&self, order: usize, terms: &[Term]) -> f64 {
        let highest = terms.iter().map(|term| term.1).max().unwrap_or(0);
        let legendre = legendre_derivatives(self.cosine, order, highest);
        let values = terms.iter().filter(|term| term.1 >= order).map(|term| {
            let decay = self.radius.powi(-(term.1 as i32) - 1);
            term.0 * decay * legendre[term.1]
        });
        self.sine.powi(order as i32) * values.sum::<f64>()
    }

    /// Velocity in an axisymmetric flow.
    pub fn axial(&self, flow: &Lone) -> Velocity {
        let half_pressure = 0.5 * self.radius * self.sum(0, &flow.pressure);
        Velocity {
            axial: self.cosine * half_pressure + self.sum(0, &flow.along),
            radial: self.sine * half_pressure + self.sum(1, &flow.others[0]),
            azimuthal: 0.0,
        }
    }

    /// Velocity in a flow of azimuthal order 1.
    pub fn transverse(&self, flow: &Lone) -> Velocity {
        let half_pressure = 0.5 * self.radius * self.sum(1, &flow.pressure);
        let (a, b) = (self.sum(0, &flow.others[0]), self.sum(2, &flow.others[1]));
        Velocity {
            axial: self.cosine * half_pressure + self.sum(1, &flow.along),
            radial: self.sine * half_pressure + 0.5 * (b + a),
            azimuthal: 0.5 * (b - a),
        }
    }
}
