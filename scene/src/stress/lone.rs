//! Lone squirmers, to compare pairs with: stresslet, power and efficiency in closed form.

use std::f64::consts::PI;

use nalgebra::Matrix3;

use crate::{MovingPair, Squirmer};

/// The stresslet of a lone squirmer, `4 pi mu a^2 B_2 (p p - I/3)`.
#[must_use]
pub fn lone_stresslet(pair: &MovingPair, squirmer: usize) -> Matrix3<f64> {
    let p = pair.configuration.orientations[squirmer];
    let of = &pair.squirmers[squirmer];
    let strength = 4.0 * PI * of.radius().powi(2) * of.mode(1);
    (p * p.transpose() - Matrix3::identity() / 3.0) * strength
}

/// Power of a lone squirmer that swims and spins freely: the rate of work of its slip, which the fluid dissipates, in units of viscosity 1.
///
/// ```text
/// P = mu a [ (16/3) pi B_1^2 + sum_(n >= 2) 16 pi B_n^2/(n (n+1)) + sum_(n >= 2) 16 pi (n+2) C_n^2/(n (n+1) (2n+1)) ]
/// ```
///
/// From Blake, *J. Fluid Mech.* 46 (1971) 199: the flow of mode `n` has the tangential traction `(2n+1) mu u/a` on the sphere, that of swirl mode `n`
/// has `(n+2) mu u/a`. The first squirming mode swims, the first swirl mode spins and moves no fluid.
#[must_use]
pub fn lone_power(squirmer: &Squirmer) -> f64 {
    let squirming = squirmer.modes().iter().zip(1..).map(|(b, n)| {
        let n = f64::from(n);
        let unit = if n > 1.0 {
            16.0 / (n * (n + 1.0))
        } else {
            16.0 / 3.0
        };
        unit * b * b
    });
    let swirl = squirmer.swirl().iter().zip(1..).skip(1).map(|(c, n)| {
        let n = f64::from(n);
        16.0 * (n + 2.0) / (n * (n + 1.0) * (2.0 * n + 1.0)) * c * c
    });
    PI * squirmer.radius() * (squirming.sum::<f64>() + swirl.sum::<f64>())
}

/// Power of dragging a sphere alone at a speed, `6 pi mu a U^2`: over the power of swimming it is Lighthill's efficiency, `1/(2 + beta^2)` of a lone
/// squirmer with two modes.
///
/// ```
/// use scene::Squirmer;
/// use scene::stress::{drag_power, lone_power};
/// let puller = Squirmer::with_beta(1.0, 5.0)?; // swims at speed 1
/// let efficiency = drag_power(1.0, 1.0) / lone_power(&puller);
/// assert!((efficiency - 1.0 / 27.0).abs() < 1e-15);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[must_use]
pub fn drag_power(radius: f64, speed: f64) -> f64 {
    6.0 * PI * radius * speed * speed
}
