//! The flow on the sphere, summed from its series: to check what no load can show.
//!
//! [`Axial`] and [`Transverse`] give the velocity at a surface point and, for tractions, its
//! derivative by `xi`. Boundary velocities are written out here once more, from their definition,
//! so that the residual also tests their expansions.

use crate::axial::{self, Axial};
use crate::geometry::Geometry;
use crate::system::{Field, Series};
use crate::transverse::{self, Transverse};

/// Cylindrical components of a velocity; azimuthal factors `cos`, `cos`, `sin` of `m phi` left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Velocity {
    /// Along `z`.
    pub axial: f64,
    /// Along `rho`.
    pub radial: f64,
    /// Along `phi`.
    pub azimuthal: f64,
}

impl Velocity {
    /// The opposite one.
    pub fn reversed(self) -> Self {
        Self {
            axial: -self.axial,
            radial: -self.radial,
            azimuthal: -self.azimuthal,
        }
    }

    /// Largest component of the difference.
    pub fn distance(self, other: Self) -> f64 {
        (self.axial - other.axial)
            .abs()
            .max((self.radial - other.radial).abs())
            .max((self.azimuthal - other.azimuthal).abs())
    }
}

/// A point of the sphere with the Legendre functions of all degrees there.
pub struct SurfacePoint {
    geometry: Geometry,
    /// `cos(eta)`.
    pub mu: f64,
    /// `P_n^(m)(mu)` for `m = 0, 1, 2`.
    legendre: [Vec<f64>; 3],
}

/// A quantity and its derivative by `xi`.
pub type Jet = (f64, f64);

impl SurfacePoint {
    /// The point with `mu = cos(eta)`.
    pub fn new(geometry: Geometry, mu: f64) -> Self {
        Self {
            geometry,
            mu,
            legendre: [0, 1, 2].map(|order| legendre_derivatives(mu, order, geometry.degree)),
        }
    }

    /// `x = n.d`.
    pub fn cosine(&self) -> f64 {
        self.geometry.cosine(self.mu)
    }

    /// Distance from the axis.
    pub fn radius(&self) -> f64 {
        self.geometry.sinh * self.sine() / self.geometry.denominator(self.mu)
    }

    fn sine(&self) -> f64 {
        ((1.0 - self.mu) * (1.0 + self.mu)).sqrt()
    }

    fn sum(&self, series: &Series, field: Field, case: usize) -> Jet {
        let alpha = self.geometry.alpha;
        let flipped = field.envelope.flipped();
        let terms = series.coefficients(field, case).enumerate();
        let jets = terms.map(|(n, coefficient)| {
            let lambda = n as f64 + 0.5;
            let ratio = flipped.envelope(lambda, alpha) / field.envelope.envelope(lambda, alpha);
            (coefficient, coefficient * lambda * ratio)
        });
        self.sum_of(field.order, jets)
    }

    /// The value of a field of which the coefficients are given, degree by degree with their derivatives by `xi`.
    pub fn sum_of(&self, order: usize, jets: impl Iterator<Item = Jet>) -> Jet {
        let denominator = self.geometry.denominator(self.mu);
        let (mut value, mut slope) = (0.0, 0.0);
        for (jet, legendre) in jets.zip(&self.legendre[order]).skip(order) {
            value += jet.0 * legendre;
            slope += jet.1 * legendre;
        }
        slope += value * self.geometry.sinh / (2.0 * denominator);
        let factor = denominator.sqrt() * self.sine().powi(order as i32);
        (factor * value, factor * slope)
    }

    /// `z q/2 + w` and `rho q/2` with their derivatives, lengths in units of the focal length.
    fn with_pressure(&self, pressure: Jet) -> (Jet, Jet) {
        let Geometry { sinh, cosh, .. } = self.geometry;
        let s = self.geometry.denominator(self.mu);
        let height = (sinh / s, (1.0 - self.mu * cosh) / (s * s));
        let radius = (self.sine() / s, -self.sine() * sinh / (s * s));
        let half_product = |x: Jet| {
            (
                0.5 * x.0 * pressure.0,
                0.5 * (x.1 * pressure.0 + x.0 * pressure.1),
            )
        };
        (half_product(height), half_product(radius))
    }

    /// Velocity and its derivative by `xi` in an axisymmetric flow.
    pub fn axial_flow(&self, flow: &Axial, case: usize) -> (Velocity, Velocity) {
        self.axial_velocity(&flow.fields, |field| self.sum(&flow.series, field, case))
    }

    /// The same of the fields that `sum` gives.
    pub fn axial_velocity(
        &self,
        fields: &axial::Fields,
        sum: impl Fn(Field) -> Jet,
    ) -> (Velocity, Velocity) {
        let (zq, rq) = self.with_pressure(sum(fields.pressure));
        let (w, v) = (sum(fields.axial), sum(fields.radial));
        let velocity = |zq, rq, w, v| Velocity {
            axial: zq + w,
            radial: rq + v,
            azimuthal: 0.0,
        };
        (
            velocity(zq.0, rq.0, w.0, v.0),
            velocity(zq.1, rq.1, w.1, v.1),
        )
    }

    /// Velocity and its derivative by `xi` in a flow of azimuthal order 1.
    pub fn transverse_flow(&self, flow: &Transverse, case: usize) -> (Velocity, Velocity) {
        self.transverse_velocity(&flow.fields, |field| self.sum(&flow.series, field, case))
    }

    /// The same of the fields that `sum` gives.
    pub fn transverse_velocity(
        &self,
        fields: &transverse::Fields,
        sum: impl Fn(Field) -> Jet,
    ) -> (Velocity, Velocity) {
        let (zq, rq) = self.with_pressure(sum(fields.pressure));
        let w = sum(fields.axial);
        let (a, b) = (sum(fields.mean), sum(fields.second));
        let velocity = |zq, rq, w, a, b| Velocity {
            axial: zq + w,
            radial: rq + 0.5 * (b + a),
            azimuthal: 0.5 * (b - a),
        };
        (
            velocity(zq.0, rq.0, w.0, a.0, b.0),
            velocity(zq.1, rq.1, w.1, a.1, b.1),
        )
    }

    /// Boundary velocity of [`Axial`]'s `case`: translation along `d`, then `W_k(x) (x n - d)`.
    pub fn axial_boundary(&self, case: usize) -> Velocity {
        let (x, radius) = (self.cosine(), self.radius());
        if case == 0 {
            return Velocity {
                axial: -1.0,
                ..Velocity::default()
            };
        }
        let weight = 2.0 * legendre_jet(x, case)[1] / (case * (case + 1)) as f64;
        Velocity {
            axial: weight * (1.0 - x * x),
            radial: weight * x * radius,
            azimuthal: 0.0,
        }
    }

    /// Boundary velocity of [`Transverse`]'s `case`: translation along `t`, rotation along
    /// `d x t`, then `-2/(k(k+1)) grad_s [P_k'(n.d) n.t]`, and from the case `swirl` on
    /// `-2/(k(k+1)) n x grad_s [P_k'(n.d) n.y]`.
    pub fn transverse_boundary(&self, case: usize, swirl: usize) -> Velocity {
        let (x, radius) = (self.cosine(), self.radius());
        let along_t = |axial: f64, t: f64| Velocity {
            axial,
            radial: t,
            azimuthal: -t,
        };
        match case {
            0 => along_t(0.0, 1.0),
            1 => along_t(radius, x),
            _ if case >= swirl => {
                let k = case + 1 - swirl;
                let [_, first, second] = legendre_jet(x, k);
                let weight = -2.0 / (k * (k + 1)) as f64;
                let (a, b) = (weight * second, weight * first);
                Velocity {
                    axial: radius * b,
                    radial: x * b,
                    azimuthal: a * radius * radius - x * b,
                }
            }
            _ => {
                let k = case - 1;
                let [_, first, second] = legendre_jet(x, k);
                let weight = -2.0 / (k * (k + 1)) as f64;
                let (a, b) = (weight * second, weight * first);
                Velocity {
                    axial: radius * (a * (x * x - 1.0) + b * x),
                    radial: b * x * x - a * x * radius * radius,
                    azimuthal: -b,
                }
            }
        }
    }
}

/// Values of `mu` over the sphere: half of them even in `eta`, half in the polar angle.
pub fn scattered_points(geometry: &Geometry, count: usize) -> Vec<f64> {
    (0..count)
        .flat_map(|k| {
            let angle = std::f64::consts::PI * (k as f64 + 0.37) / count as f64;
            [angle.cos(), geometry.mu(angle.cos())]
        })
        .collect()
}

/// `P_n^(m)(mu)` for `n = 0..=degree`.
pub fn legendre_derivatives(mu: f64, order: usize, degree: usize) -> Vec<f64> {
    let m = order as f64;
    let mut values = vec![0.0; degree.max(order) + 1];
    values[order] = (1..=order).map(|j| (2 * j - 1) as f64).product();
    for n in order..degree {
        let below = if n > order { values[n - 1] } else { 0.0 };
        let x = n as f64;
        values[n + 1] = ((2.0 * x + 1.0) * mu * values[n] - (x + m) * below) / (x - m + 1.0);
    }
    values
}

/// `P_k`, `P_k'`, `P_k''` at `x`.
fn legendre_jet(x: f64, k: usize) -> [f64; 3] {
    [0, 1, 2].map(|order| legendre_derivatives(x, order, k)[k])
}

/// Largest difference between the flow and its boundary values at `points`, over all cases.
pub fn axial_residual(flow: &Axial, points: &[SurfacePoint]) -> f64 {
    residual(flow.series.count(), points, |point, case| {
        point
            .axial_flow(flow, case)
            .0
            .distance(point.axial_boundary(case))
    })
}

/// The same for a flow of azimuthal order 1.
pub fn transverse_residual(flow: &Transverse, points: &[SurfacePoint]) -> f64 {
    residual(flow.series.count(), points, |point, case| {
        point
            .transverse_flow(flow, case)
            .0
            .distance(point.transverse_boundary(case, flow.swirl(1)))
    })
}

fn residual(
    cases: usize,
    points: &[SurfacePoint],
    difference: impl Fn(&SurfacePoint, usize) -> f64,
) -> f64 {
    points
        .iter()
        .flat_map(|point| (0..cases).map(move |case| (point, case)))
        .map(|(point, case)| difference(point, case))
        .fold(0.0, f64::max)
}
