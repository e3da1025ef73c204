//! A unit cause on a lone sphere, in closed form.

use std::f64::consts::PI;

use nalgebra::Vector3;
use scene::stress::{Block, Cause};

use crate::lone::{Radial, stokes};
use crate::slip;

/// A unit of a cause on a sphere, in its own frame: centre at the origin, the other sphere on the side of `+z`, lengths in its radius.
#[derive(Clone, Copy)]
pub struct Unit {
    /// The block of the cause.
    pub block: Block,
    /// The cause.
    pub cause: Cause,
    /// Radius of the sphere, in radii of sphere 1.
    pub radius: f64,
}

impl Unit {
    /// Velocity of the lone sphere's fluid at a point outside or on it.
    pub fn flow(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let r = point.norm();
        let normal = point / r;
        let order = self.order();
        match self.cause {
            Cause::Translation => {
                let u = if order == 0 {
                    Vector3::z()
                } else {
                    Vector3::x()
                };
                let [even, odd] = stokes(r);
                u * even + normal * (normal.dot(&u) * odd)
            }
            Cause::Rotation => {
                // Across, the spin whose product with z is x.
                let spin = if order == 0 {
                    Vector3::z()
                } else {
                    Vector3::y()
                };
                spin.cross(&normal) * (self.radius / (r * r))
            }
            Cause::Squirming(n) => {
                let of = Radial::new(n, r);
                let along = normal * (of.along * slip::potential_of_order(n, order, &normal));
                slip::of_order(n, order, &normal) * of.across - along
            }
            Cause::Swirl(n) => slip::swirl_of_order(n, order, &normal) * r.powi(-(n as i32) - 1),
        }
    }

    /// `W` of this cause and another one of the same block on the same sphere, if it is alone.
    ///
    /// With a slip `∇_s Y` of degree n the fluid's traction is `-(2n+1) ∇_s Y + 3n Y n`, with swirl -(n+2) times the swirl, for radius 1. The first
    /// modes exert force and torque; the first swirl mode is a spin.
    pub fn lone_work(&self, other: Cause) -> f64 {
        use Cause::{Rotation, Squirming, Swirl, Translation};
        let a = self.radius;
        let turned = if self.block == Block::Twist {
            1.0
        } else {
            -1.0
        };
        match (self.cause, other) {
            (Translation, Translation) => 6.0 * PI * a,
            (Rotation, Rotation) => 8.0 * PI * a.powi(3),
            (Translation, Squirming(1)) | (Squirming(1), Translation) => -4.0 * PI * a,
            (Rotation, Swirl(1)) | (Swirl(1), Rotation) => turned * 8.0 * PI * a * a,
            (Squirming(n), Squirming(k)) if n == k => (2 * n + 1) as f64 * self.norm(n) * a,
            (Swirl(n), Swirl(k)) if n == k => (n + 2) as f64 * self.norm(n) * a,
            _ => 0.0,
        }
    }

    /// The factor of its stresslet, `4 pi a² B_2 (p p - I/3)` of all orders together, if it is alone; see [`scene::stress`].
    pub fn lone_stresslet(&self) -> f64 {
        let factor = match (self.cause, self.order()) {
            (Cause::Squirming(2), 0 | 1) => 4.0,
            (Cause::Squirming(2), 2) => 8.0,
            _ => 0.0,
        };
        factor * PI * self.radius.powi(2)
    }

    fn order(&self) -> usize {
        match self.block {
            Block::Twist => 0,
            Block::Order(order) => order,
        }
    }

    /// `∫ |u|² dΩ = 4/(n(n+1)) ∫ (P_n^m cos mφ)² dΩ` of slip or swirl.
    fn norm(&self, n: usize) -> f64 {
        let (degree, m) = (n as f64, self.order());
        let among: f64 = (n - m + 1..=n + m).map(|k| k as f64).product();
        let around = if m == 0 { 4.0 * PI } else { 2.0 * PI * among };
        4.0 / (degree * (degree + 1.0)) * around / (2.0 * degree + 1.0)
    }
}
