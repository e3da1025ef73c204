//! What two squirmers that part still turn by, far from each other, in closed form.
//!
//! Far away squirmer `j` is a stresslet, `u = -(B_2/2) (3 c^2 - 1) s/|s|^3` with `s` the way from its centre and
//! `c = p_j.s/|s|` (the leading term of Blake's flow, J. Fluid Mech. 46 (1971) 199). Faxen's law turns the other
//! one at half the vorticity, `-(3/2) B_2 (p_j.s) (p_j x s)/|s|^5`. On the straight paths of lone squirmers, `s = s0 + w t`,
//! this integrates to infinity in closed form; it falls as `1/(|w| s0^2)`. What is left out (source
//! dipoles have no vorticity) falls at least one order faster.

use nalgebra::{Rotation3, Vector3};

use crate::Squirmer;
use crate::frame::Configuration;

/// The configuration whose orientations have turned by all that is still to come on straight paths that
/// recede from each other; none if the two do not recede, so that there is no limit.
pub(super) fn turned_to_infinity(
    squirmers: &[Squirmer; 2],
    at: &Configuration,
) -> Option<Configuration> {
    let [v1, v2] = [0, 1].map(|k| at.orientations[k] * squirmers[k].swimming_speed());
    let separation = at.line * at.gap.distance();
    let fastest = v1.norm().max(v2.norm());
    let recedes = (v2 - v1).dot(&at.line) > 8.0 * f64::EPSILON * fastest;
    if !recedes {
        return None;
    }
    let of = |j: usize, s0: Vector3<f64>, w: Vector3<f64>| {
        turn_by(squirmers[j].mode(1), at.orientations[j], s0, w)
    };
    let turns = [of(1, -separation, v1 - v2), of(0, separation, v2 - v1)];
    let mut end = *at;
    for (k, turn) in turns.into_iter().enumerate() {
        let (p, q) = (
            at.orientations[k],
            Rotation3::new(turn) * at.orientations[k],
        );
        end.orientations[k] = q;
        // The turn of the projection on the x-y plane.
        end.angles_rad[k] += (p.x * q.y - p.y * q.x).atan2(p.x * q.x + p.y * q.y);
    }
    Some(end)
}

/// The integral from now to infinity of the rate at which the stresslet of a squirmer with `B_2` and
/// orientation `p` turns a sphere at `s0 + w t` from it, a rotation vector in radians.
fn turn_by(b2: f64, p: Vector3<f64>, s0: Vector3<f64>, w: Vector3<f64>) -> Vector3<f64> {
    let (speed, r) = (w.norm(), s0.norm());
    let ahead = w / speed;
    // Along the path from the point nearest to the squirmer, in units of the distance now.
    let q = s0.dot(&ahead) / r;
    let nearest = s0 / r - ahead * q;
    // Integrals over x from q of x^n (1 - q^2 + x^2)^(-5/2), without a difference of like numbers.
    let i0 = (2.0 + q) / (3.0 * (1.0 + q).powi(2));
    let i1 = 1.0 / 3.0;
    let i2 = (1.0 + q + q * q) / (3.0 * (1.0 + q));
    let (along, across) = (p.dot(&ahead), p.dot(&nearest));
    let (turn_along, turn_across) = (p.cross(&ahead), p.cross(&nearest));
    let integral =
        turn_across * (across * i0 + along * i1) + turn_along * (across * i1 + along * i2);
    integral * (-1.5 * b2 / (speed * r * r))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gap;
    use approx::assert_relative_eq;

    /// Half the vorticity of a stresslet, from central differences of its flow.
    fn spin(b2: f64, p: Vector3<f64>, s: Vector3<f64>) -> Vector3<f64> {
        let flow = |s: Vector3<f64>| {
            let (r, c) = (s.norm(), p.dot(&s) / s.norm());
            s * (-0.5 * b2 * (3.0 * c * c - 1.0) / (r * r * r))
        };
        let h = 1e-4 * s.norm();
        let slope = |of: usize, along: usize| {
            let mut step = Vector3::zeros();
            step[along] = h;
            (flow(s + step)[of] - flow(s - step)[of]) / (2.0 * h)
        };
        0.5 * Vector3::new(
            slope(2, 1) - slope(1, 2),
            slope(0, 2) - slope(2, 0),
            slope(1, 0) - slope(0, 1),
        )
    }

    #[test]
    fn val_the_turn_to_come_is_the_integral_of_half_the_vorticity() {
        let p = Vector3::new(0.3, -0.5, 0.8).normalize();
        let s0 = Vector3::new(4.0, 7.0, -2.0);
        for w in [
            Vector3::new(0.5, 1.3, 0.4),
            Vector3::new(1.0, -0.5, 0.9),
            s0 * 0.1,
        ] {
            // Simpson's rule in x = 1/(1 + t/T), which brings infinity to 0.
            let scale = s0.norm() / w.norm();
            let intervals = 4000;
            let rate = |x: f64| {
                if x <= 0.0 {
                    return Vector3::zeros();
                }
                spin(7.5, p, s0 + w * (scale * (1.0 / x - 1.0))) * (scale / (x * x))
            };
            let mut sum = Vector3::zeros();
            for i in 0..=intervals {
                let weight = match i {
                    0 => 1.0,
                    i if i == intervals => 1.0,
                    i => [2.0, 4.0][i % 2],
                };
                sum += rate(i as f64 / intervals as f64) * weight;
            }
            let integral = sum / (3.0 * intervals as f64);
            assert_relative_eq!(turn_by(7.5, p, s0, w), integral, epsilon = 1e-7);
        }
    }

    #[test]
    fn headings_at_an_angle_turn_as_one_over_the_distance_squared_and_opposed_ones_as_its_cube() {
        let (beta, alpha, r0) = (5.0, 0.7_f64, 50.0);
        let pair = [Squirmer::with_beta(1.0, beta).unwrap(); 2];
        let at = |angles: [f64; 2], line_angle_rad: f64| Configuration {
            gap: Gap::new(r0 - 2.0).unwrap(),
            midpoint: Vector3::zeros(),
            line: Vector3::new(line_angle_rad.cos(), line_angle_rad.sin(), 0.0),
            orientations: angles.map(|a| Vector3::new(a.cos(), a.sin(), 0.0)),
            line_angle_rad,
            angles_rad: angles,
        };
        // Outgoing headings 2 alpha apart, symmetric about y, on paths from one point.
        let half_pi = std::f64::consts::FRAC_PI_2;
        let start = at([half_pi + alpha, half_pi - alpha], 0.0);
        let end = turned_to_infinity(&pair, &start).unwrap();
        let expected = 9.0 * beta / 16.0 * alpha.cos() / (r0 * r0);
        assert_relative_eq!(
            end.angles_rad[0] - start.angles_rad[0],
            expected,
            max_relative = 1e-12
        );
        assert_relative_eq!(
            end.angles_rad[1] - start.angles_rad[1],
            -expected,
            max_relative = 1e-12
        );
        // Opposed paths a small offset b apart.
        let b = 0.4;
        let start = at([std::f64::consts::PI, 0.0], (b / r0).asin());
        let end = turned_to_infinity(&pair, &start).unwrap();
        let expected = 3.0 * beta / 8.0 * b / (r0 * r0 * r0);
        assert_relative_eq!(
            (end.angles_rad[0] - start.angles_rad[0]).abs(),
            expected,
            max_relative = 1e-3
        );
    }

    #[test]
    fn pairs_that_do_not_recede_have_no_limit() {
        let pair = [Squirmer::with_beta(1.0, 1.0).unwrap(); 2];
        let start = Configuration {
            gap: Gap::new(10.0).unwrap(),
            midpoint: Vector3::zeros(),
            line: Vector3::x(),
            orientations: [Vector3::y(); 2],
            line_angle_rad: 0.0,
            angles_rad: [1.0; 2],
        };
        assert_eq!(turned_to_infinity(&pair, &start), None);
    }
}
