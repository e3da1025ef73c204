//! The flow about a lone squirmer in closed form.
//!
//! Outside a sphere of radius 1 with the slip `u = ∇_s Y`, Y a surface harmonic of degree n, it is Lamb's solution (Happel & Brenner 1965, section
//! 3-2; for squirmers Blake, *J. Fluid Mech.* 46 (1971) 199)
//!
//! ```text
//! u = n(n+1)/2 (r^-n - r^(-n-2)) Y n + ((2-n)/2 r^-n + n/2 r^(-n-2)) ∇_s Y,    p = n(2n-1) r^(-n-1) Y,
//! ```
//!
//! with swirl `r^(-n-1)` times that on the surface. Boundary elements have only to solve for what the other sphere changes of it, which is smoother and
//! vanishes far apart.

use nalgebra::{Matrix3, Vector3};
use scene::MovingPair;

use crate::slip;

/// The factors of the distance r, in radii, for a degree.
pub struct Radial {
    /// Of `Y n` in the velocity.
    pub along: f64,
    /// Of `∇_s Y`.
    pub across: f64,
    /// Slopes of these two.
    slopes: [f64; 2],
    /// Of Y in the pressure.
    pressure: f64,
}

impl Radial {
    /// Of the degree n at the distance r.
    pub fn new(n: usize, r: f64) -> Self {
        let (degree, outer) = (n as f64, r.powi(-(n as i32)));
        let inner = outer / (r * r);
        // d/dr of r^-n and of r^(-n-2).
        let (outer_slope, inner_slope) = (-degree * outer / r, -(degree + 2.0) * inner / r);
        let half = 0.5 * degree * (degree + 1.0);
        let (a, b) = (1.0 - 0.5 * degree, 0.5 * degree);
        Self {
            along: half * (outer - inner),
            across: a * outer + b * inner,
            slopes: [
                half * (outer_slope - inner_slope),
                a * outer_slope + b * inner_slope,
            ],
            pressure: degree * (2.0 * degree - 1.0) * outer / r,
        }
    }
}

/// Velocity, pressure and velocity gradient.
#[derive(Clone, Copy, Debug, Default)]
pub struct State {
    /// Velocity.
    pub velocity: Vector3<f64>,
    /// Pressure.
    pub pressure: f64,
    /// Velocity gradient, `d u_i / d x_j`.
    pub gradient: Matrix3<f64>,
}

impl State {
    fn add(&mut self, velocity: Vector3<f64>, pressure: f64, gradient: Matrix3<f64>) {
        self.velocity += velocity;
        self.pressure += pressure;
        self.gradient += gradient;
    }
}

/// Factors of u and of `n (n.u)` in Stokes' flow about a sphere of radius 1 and velocity u, at the distance r.
pub fn stokes(r: f64) -> [f64; 2] {
    let (one, three) = (0.75 / r, 0.25 / r.powi(3));
    [one + three, one - 3.0 * three]
}

/// Where a point is: its distance in radii and its direction from the centre.
struct Place {
    r: f64,
    normal: Vector3<f64>,
    /// Gradient of the direction, `(I - n n)/r`.
    turning: Matrix3<f64>,
}

/// The flow that a squirmer of a pair would drive alone, moving as it does, at a point outside it.
pub fn flow(pair: &MovingPair, sphere: usize, point: &Vector3<f64>) -> State {
    let radius = pair.configuration.radii[sphere];
    let apart = (point - pair.configuration.positions()[sphere]) / radius;
    let r = apart.norm();
    let normal = apart / r;
    let place = Place {
        r,
        normal,
        turning: (Matrix3::identity() - normal * normal.transpose()) / r,
    };
    let mut state = State::default();
    state.translates(&place, &pair.velocities[sphere]);
    state.turns(
        &place,
        &(pair.angular_velocities[sphere] * radius),
        1,
        [1.0, 0.0],
    );
    let p = &pair.configuration.orientations[sphere];
    let of = &pair.squirmers[sphere];
    for (n, strength) in (1..).zip(of.modes()) {
        state.squirms(&place, p, n, *strength);
    }
    let c = p.dot(&normal);
    for (n, strength) in (1..).zip(of.swirl()) {
        let [_, first, second] = slip::legendre(n, c);
        let scale = strength * 2.0 / (n * (n + 1)) as f64;
        state.turns(&place, p, n, [scale * first, scale * second]);
    }
    State {
        velocity: state.velocity,
        pressure: state.pressure / radius,
        gradient: state.gradient / radius,
    }
}

impl State {
    /// Adds Stokes' flow about a sphere of the velocity u.
    fn translates(&mut self, Place { r, normal, turning }: &Place, u: &Vector3<f64>) {
        let (one, three) = (0.75 / r, 0.25 / r.powi(3));
        let along = u.dot(normal);
        let [even, odd] = stokes(*r);
        let (even_slope, odd_slope) = (-(one + 3.0 * three) / r, -(one - 9.0 * three) / r);
        let gradient = (u * even_slope + normal * (along * odd_slope)) * normal.transpose()
            + (turning * along + normal * (turning * u).transpose()) * odd;
        let velocity = u * even + normal * (along * odd);
        self.add(velocity, 1.5 * along / (r * r), gradient);
    }

    /// Adds `r^(-n-1) w(c) p x n`, c = p.n, with w and its slope given at this c.
    fn turns(
        &mut self,
        Place { r, normal, turning }: &Place,
        p: &Vector3<f64>,
        n: usize,
        [w, slope]: [f64; 2],
    ) {
        let size = r.powi(-(n as i32) - 1);
        let around = p.cross(normal);
        let change = normal * (-(n as f64 + 1.0) * w / r) + turning * p * slope;
        let gradient = around * change.transpose() + p.cross_matrix() * turning * w;
        self.add(around * (w * size), 0.0, gradient * size);
    }

    /// Adds that of the slip of mode n, `Y = -2/(n(n+1)) P_n(c)`.
    fn squirms(
        &mut self,
        Place { r, normal, turning }: &Place,
        p: &Vector3<f64>,
        n: usize,
        strength: f64,
    ) {
        let of = Radial::new(n, *r);
        let c = p.dot(normal);
        let [y, first, second] =
            slip::legendre(n, c).map(|value| value * -2.0 / (n * (n + 1)) as f64 * strength);
        let across = p - normal * c;
        // The gradient of c is across/r, and that of across -n across/r - c (I - n n)/r.
        let change = across / *r;
        let velocity = normal * (of.along * y) + across * (of.across * first);
        let gradient = normal
            * (normal * (of.slopes[0] * y) + change * ((of.along - of.across) * first)).transpose()
            + across
                * (normal * (of.slopes[1] * first) + change * (of.across * second)).transpose()
            + turning * (of.along * y - of.across * first * c);
        self.add(velocity, of.pressure * y, gradient);
    }
}

/// The density of the single layer that drives it at the outward unit normal: of slip `∇_s Y` it is `(2n+1) (2 ∇_s Y - 3 Y n)`, of swirl 2n+1 times the
/// swirl, of a translation 3/2 and of a spin 3 times the velocity, on a sphere of radius 1.
pub fn density(pair: &MovingPair, sphere: usize, normal: &Vector3<f64>) -> Vector3<f64> {
    let p = &pair.configuration.orientations[sphere];
    let of = &pair.squirmers[sphere];
    let radius = pair.configuration.radii[sphere];
    let spin = pair.angular_velocities[sphere].cross(normal) * radius;
    let mut sum = pair.velocities[sphere] * 1.5 + spin * 3.0;
    let c = p.dot(normal);
    for (n, strength) in (1..).zip(of.modes()) {
        let y = slip::legendre(n, c)[0] * -2.0 / (n * (n + 1)) as f64;
        let slip = slip::axisymmetric(n, p, normal);
        sum += (slip * 2.0 - normal * (3.0 * y)) * ((2 * n + 1) as f64 * strength);
    }
    for (n, strength) in (1..).zip(of.swirl()) {
        sum += slip::axisymmetric_swirl(n, p, normal) * ((2 * n + 1) as f64 * strength);
    }
    sum / radius
}
