//! The flow about two squirmers as if either were alone: what a flow about a pair tends to as they part.
//!
//! Each sphere of radius `a` drives the flow that it would drive alone, by its own surface velocity. With `n` the unit vector from its centre,
//! `c = p.n`, `s = a/r`:
//!
//! ```text
//! velocity U          u = (3 s/4)(U + n n.U) + (s³/4)(U - 3 n n.U),     pressure (3/2) a U.n / r²
//! angular velocity ω  u = a s² ω x n
//! B_n                 u = B_n [ (s^(n+2) - s^n) P_n n + (n/2 s^(n+2) - (n/2 - 1) s^n) W_n (c n - p) ],
//!                     pressure -B_n (4n - 2)/(n + 1) s^n P_n / r
//! C_n                 u = C_n s^(n+1) W_n p x n
//! ```
//!
//! after Blake, *J. Fluid Mech.* 46 (1971) 199, and Pak & Lauga, *J. Eng. Math.* 88 (2014) 1, with `B_1` on a sphere that is held.

use nalgebra::{Matrix3, Vector3};

use crate::{Flow, FluidState, MovingPair, legendre};

/// Step of the central differences of the velocity gradient, in radii of the sphere at hand: errors of about 1e-10.
const STEP: f64 = 1e-5;

/// Points on each sphere at which the error is measured.
const PROBES: usize = 200;

/// The sum of the flows that either squirmer of a pair would drive alone. Its error at the surfaces falls as the inverse square of the distance
/// where no force acts.
///
/// ```
/// use scene::{Flow, Isolated, LoneFlows, MovingPair, Plan, Pose, Scene, Squirmer, nalgebra::Vector3};
/// let squirmers = [Squirmer::with_beta(1.0, 0.0)?, Squirmer::new(&[])?];
/// let start = [Pose::planar(0.0, 0.0, 0.0), Pose::planar(1e6, 0.0, 0.0)];
/// let plan = Plan::new(&Scene::new(squirmers, start, None, None)?)?;
/// let flows = LoneFlows::new(MovingPair::free(&plan, &Isolated::EQUAL, plan.start())?);
/// // A neutral squirmer drives a dipole: V_s (a/r)³ ahead of it.
/// let ahead = flows.at(&Vector3::new(2.0, 0.0, 0.0)).velocity;
/// assert!((ahead - Vector3::new(0.125, 0.0, 0.0)).norm() < 1e-12);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoneFlows {
    pair: MovingPair,
    error_estimate: f64,
}

impl LoneFlows {
    /// The flows of a pair.
    #[must_use]
    pub fn new(pair: MovingPair) -> Self {
        let mut flows = Self {
            pair,
            error_estimate: 0.0,
        };
        let centres = pair.configuration.positions();
        let errors = [0, 1].into_iter().flat_map(|k| {
            (0..PROBES).map(move |probe| {
                let normal = spread(probe);
                let at = centres[k] + normal * pair.configuration.radii[k];
                (flows.at(&at).velocity - pair.surface_velocity(k, &normal)).norm()
            })
        });
        flows.error_estimate = errors.fold(0.0, f64::max);
        flows
    }

    /// The flow that squirmer `k` would drive alone, at a point.
    fn of(&self, k: usize, point: &Vector3<f64>) -> FluidState {
        let pair = &self.pair;
        let radius = pair.configuration.radii[k];
        let from = point - pair.configuration.positions()[k];
        let distance = from.norm();
        let n = from / distance;
        let s = radius / distance;
        let u = pair.velocities[k];
        let across = n * n.dot(&u);
        let mut velocity = (u + across) * (0.75 * s) + (u - across * 3.0) * (0.25 * s.powi(3));
        velocity += pair.angular_velocities[k].cross(&n) * (radius * s * s);
        let mut pressure = 1.5 * s * n.dot(&u) / distance;
        let p = pair.configuration.orientations[k];
        let squirmer = &pair.squirmers[k];
        let c = p.dot(&n);
        let modes = squirmer.modes().len().max(squirmer.swirl().len());
        // s^n of the order n.
        let mut power = s;
        for (index, order) in (0..modes).zip(legendre(c)) {
            let degree = (index + 1) as f64;
            let (b, swirl) = (squirmer.mode(index), squirmer.swirl().get(index));
            let beyond = power * s * s;
            let along = n * ((beyond - power) * order.p);
            let tangential = 0.5 * degree * beyond - (0.5 * degree - 1.0) * power;
            velocity += (along + (n * c - p) * (tangential * order.w)) * b;
            pressure -= b * (4.0 * degree - 2.0) / (degree + 1.0) * power * order.p / distance;
            velocity += p.cross(&n) * (swirl.unwrap_or(&0.0) * power * s * order.w);
            power *= s;
        }
        FluidState { velocity, pressure }
    }
}

impl Flow for LoneFlows {
    fn pair(&self) -> &MovingPair {
        &self.pair
    }

    fn at(&self, point: &Vector3<f64>) -> FluidState {
        let [one, two] = [0, 1].map(|k| self.of(k, point));
        FluidState {
            velocity: one.velocity + two.velocity,
            pressure: one.pressure + two.pressure,
        }
    }

    fn gradient(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        let [one, two] = self.pair.configuration.radii;
        let step = STEP * one.min(two);
        let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| {
            let at = |along: f64| self.at(&(point + axis * along)).velocity;
            (at(step) - at(-step)) / (2.0 * step)
        });
        Matrix3::from_columns(&columns)
    }

    fn traction(&self, sphere: usize, normal: &Vector3<f64>) -> Vector3<f64> {
        let configuration = &self.pair.configuration;
        let at = configuration.positions()[sphere] + normal * configuration.radii[sphere];
        let gradient = self.gradient(&at);
        (gradient + gradient.transpose()) * normal - normal * self.at(&at).pressure
    }

    fn density(&self, _: usize, _: &Vector3<f64>) -> Option<Vector3<f64>> {
        None
    }

    /// The largest difference between the flow and the surface velocity over the two spheres.
    fn error_estimate(&self) -> f64 {
        self.error_estimate
    }
}

/// Points spread evenly over the unit sphere, along a spiral.
fn spread(probe: usize) -> Vector3<f64> {
    let z = 1.0 - (2.0 * probe as f64 + 1.0) / PROBES as f64;
    let turn = probe as f64 * std::f64::consts::PI * (3.0 - 5_f64.sqrt());
    let across = (1.0 - z * z).sqrt();
    Vector3::new(across * turn.cos(), across * turn.sin(), z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Configuration, Gap, Squirmer};

    fn pair(distance: f64) -> MovingPair {
        let squirmer = |modes: &[f64], swirl: &[f64], radius: f64| {
            let of = Squirmer::new(modes).unwrap().with_swirl(swirl).unwrap();
            of.with_radius(radius).unwrap()
        };
        MovingPair {
            squirmers: [
                squirmer(&[1.5, -2.0, 0.7], &[0.3, 0.8], 1.0),
                squirmer(&[0.9, 1.1], &[0.1, -0.4, 0.9], 2.0),
            ],
            configuration: Configuration {
                radii: [1.0, 2.0],
                gap: Gap::new(distance - 3.0).unwrap(),
                midpoint: Vector3::zeros(),
                line: Vector3::new(0.36, 0.48, -0.8),
                orientations: [Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.48, 0.64, 0.6)],
                line_angle_rad: 0.0,
                angles_rad: [0.0; 2],
            },
            velocities: [Vector3::new(0.1, -0.5, 0.3), Vector3::new(0.7, 0.2, -0.4)],
            angular_velocities: [Vector3::new(-0.2, 0.6, 0.1), Vector3::new(0.3, 0.5, 0.9)],
            forces: Default::default(),
            torques: Default::default(),
        }
    }

    #[test]
    fn far_apart_either_surface_moves_as_the_pair_says() {
        let far = LoneFlows::new(pair(1e6)).error_estimate();
        assert!(far < 1e-5, "{far}");
        let near = LoneFlows::new(pair(30.0)).error_estimate();
        assert!(near > 1e-3 && near < 0.2, "{near}");
    }

    #[test]
    fn the_flow_has_no_divergence_and_its_pressure_balances_viscosity() {
        let flows = LoneFlows::new(pair(4.0));
        let at = Vector3::new(1.3, 2.1, -0.4);
        assert!(flows.gradient(&at).trace().abs() < 1e-8);
        let step = 1e-3;
        let mut force = Vector3::zeros();
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let state = |along: f64| flows.at(&(at + axis * along));
            let (ahead, behind) = (state(step), state(-step));
            let here = flows.at(&at).velocity;
            force += (ahead.velocity + behind.velocity - here * 2.0) / (step * step);
            force -= axis * ((ahead.pressure - behind.pressure) / (2.0 * step));
        }
        assert!(force.norm() < 1e-4, "{force}");
    }

    #[test]
    fn the_traction_of_a_translating_sphere_is_uniform() {
        let mut pair = pair(1e9);
        pair.squirmers = [Squirmer::new(&[]).unwrap(); 2];
        pair.angular_velocities = Default::default();
        let flows = LoneFlows::new(pair);
        // Central differences of coordinates of 5e8 have no digits: about the other way round.
        let mut near = pair;
        near.configuration.midpoint =
            -pair.configuration.line * (0.5 * pair.configuration.distance());
        for normal in [Vector3::x(), Vector3::new(0.48, 0.6, 0.64)] {
            let traction = flows.traction(1, &normal);
            let expected = pair.velocities[1] * (-1.5 / 2.0);
            assert!((traction - expected).norm() < 1e-6, "{traction}");
        }
        assert!(flows.density(0, &Vector3::x()).is_none());
    }
}
