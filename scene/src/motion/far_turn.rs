//! What two squirmers that part still turn by, far from each other, in closed form.
//!
//! Far away squirmer `j` is a stresslet, `u = -(B_2 a_j^2/2) (3 c^2 - 1) s/|s|^3` with `s` the way from its centre and
//! `c = p_j.s/|s|` (the leading term of Blake's flow, J. Fluid Mech. 46 (1971) 199). Faxen's law turns the other
//! one at half the vorticity, `-(3/2) B_2 a_j^2 (p_j.s) (p_j x s)/|s|^5`. On the straight paths of lone squirmers, `s = s0 + w t`,
//! this integrates to infinity in closed form; it falls as `1/(|w| s0^2)`. What is left out (source
//! dipoles have no vorticity) falls at least one order faster.

use nalgebra::{Rotation3, Vector3};

use crate::Squirmer;
use crate::frame::Configuration;

/// The configuration whose orientations have turned by all that is still to come on straight paths that
/// recede from each other; none if the two do not recede, so that there is no limit.
#[must_use]
pub fn turned_to_infinity(squirmers: &[Squirmer; 2], at: &Configuration) -> Option<Configuration> {
    let [v1, v2] = [0, 1].map(|k| at.orientations[k] * squirmers[k].swimming_speed());
    let separation = at.line * at.distance();
    let fastest = v1.norm().max(v2.norm());
    let recedes = (v2 - v1).dot(&at.line) > 8.0 * f64::EPSILON * fastest;
    if !recedes {
        return None;
    }
    let of = |j: usize, s0: Vector3<f64>, w: Vector3<f64>| {
        // The stresslet goes as the area.
        let area = squirmers[j].radius() * squirmers[j].radius();
        turn_by(squirmers[j].mode(1) * area, at.orientations[j], s0, w)
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

/// How far each squirmer is still carried by the other one on straight paths that recede from each other, besides its own swimming; with
/// `backward` how far it was carried before, on straight paths that led here. None if the two do not recede (or did not approach).
///
/// It is the integral of the flow of stresslet and source dipole, `u = (B_1 a_j^3/3) (3 c s/|s| - p)/|s|^3`, at the other one, and falls as
/// `1/(|w| |s0|)`; what is left out falls as the cube.
#[must_use]
pub fn far_drift(
    squirmers: &[Squirmer; 2],
    at: &Configuration,
    backward: bool,
) -> Option<[Vector3<f64>; 2]> {
    let sense = if backward { -1.0 } else { 1.0 };
    let [v1, v2] = [0, 1].map(|k| at.orientations[k] * (sense * squirmers[k].swimming_speed()));
    let fastest = v1.norm().max(v2.norm());
    if (v2 - v1).dot(&at.line) <= 8.0 * f64::EPSILON * fastest {
        return None;
    }
    let separation = at.line * at.distance();
    let of = |j: usize, s0: Vector3<f64>, w: Vector3<f64>| {
        let (a, p) = (squirmers[j].radius(), at.orientations[j]);
        let strengths = [
            squirmers[j].mode(0) * a.powi(3),
            squirmers[j].mode(1) * a * a,
        ];
        drift_by(strengths, p, s0, w)
    };
    Some([of(1, -separation, v1 - v2), of(0, separation, v2 - v1)])
}

/// The integral from now to infinity of the flow of a squirmer with `B_1` (times the cube of its radius), `B_2` (times the square) and orientation
/// `p` at `s0 + w t` from it.
fn drift_by(
    [b1, b2]: [f64; 2],
    p: Vector3<f64>,
    s0: Vector3<f64>,
    w: Vector3<f64>,
) -> Vector3<f64> {
    let (speed, r) = (w.norm(), s0.norm());
    let ahead = w / speed;
    // As in `turn_by`, with the integrals of x^3 (1 - q^2 + x^2)^(-5/2), and of (1 - q^2 + x^2)^(-3/2) without and with x.
    let q = s0.dot(&ahead) / r;
    let nearest = s0 / r - ahead * q;
    let i0 = (2.0 + q) / (3.0 * (1.0 + q).powi(2));
    let i1 = 1.0 / 3.0;
    let i2 = (1.0 + q + q * q) / (3.0 * (1.0 + q));
    let i3 = (2.0 + q * q) / 3.0;
    let (along, across) = (p.dot(&ahead), p.dot(&nearest));
    let moment = |a: f64, b: f64, c: f64| {
        3.0 * (across * across * a + 2.0 * across * along * b + along * along * c)
    };
    let stresslet =
        nearest * (moment(i0, i1, i2) - 1.0 / (1.0 + q)) + ahead * (moment(i1, i2, i3) - 1.0);
    let dipole = (nearest * (across * i0 + along * i1) + ahead * (across * i1 + along * i2)) * 3.0
        - p / (1.0 + q);
    stresslet * (-0.5 * b2 / (speed * r)) + dipole * (b1 / (3.0 * speed * r * r))
}

/// The integral from now to infinity of the rate at which the stresslet of a squirmer with `B_2` (times the square of its radius) and
/// orientation `p` turns a sphere at `s0 + w t` from it, a rotation vector in radians.
pub(super) fn turn_by(b2: f64, p: Vector3<f64>, s0: Vector3<f64>, w: Vector3<f64>) -> Vector3<f64> {
    // Integrals over x from q of x^n (1 - q^2 + x^2)^(-5/2), without a difference of like numbers.
    let integrals = |q: f64| {
        [
            (2.0 + q) / (3.0 * (1.0 + q).powi(2)),
            1.0 / 3.0,
            (1.0 + q + q * q) / (3.0 * (1.0 + q)),
        ]
    };
    let (speed, r) = (w.norm(), s0.norm());
    turn_along(p, s0, w, integrals) * (-1.5 * b2 / (speed * r * r))
}

/// The same of `t` times that rate.
pub(super) fn turn_moment_by(
    b2: f64,
    p: Vector3<f64>,
    s0: Vector3<f64>,
    w: Vector3<f64>,
) -> Vector3<f64> {
    // Integrals over x from q of (x - q) x^n (1 - q^2 + x^2)^(-5/2).
    let integrals = |q: f64| {
        [
            1.0 / (3.0 * (1.0 + q).powi(2)),
            1.0 / (3.0 * (1.0 + q)),
            (2.0 + q) / (3.0 * (1.0 + q)),
        ]
    };
    let (speed, r) = (w.norm(), s0.norm());
    turn_along(p, s0, w, integrals) * (-1.5 * b2 / (speed * speed * r))
}

/// The sum of `(p.s) p x s` along a path, with integrals over the place `x` on it to the powers 0, 1 and 2, as functions of the place `q` now. Places are
/// counted from the point nearest to the squirmer, in units of the distance now.
fn turn_along(
    p: Vector3<f64>,
    s0: Vector3<f64>,
    w: Vector3<f64>,
    integrals: impl Fn(f64) -> [f64; 3],
) -> Vector3<f64> {
    let (ahead, r) = (w / w.norm(), s0.norm());
    let q = s0.dot(&ahead) / r;
    let nearest = s0 / r - ahead * q;
    let [i0, i1, i2] = integrals(q);
    let (along, across) = (p.dot(&ahead), p.dot(&nearest));
    let (turn_along, turn_across) = (p.cross(&ahead), p.cross(&nearest));
    turn_across * (across * i0 + along * i1) + turn_along * (across * i1 + along * i2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gap;
    use approx::assert_relative_eq;

    /// The integral from 0 to 1 by Simpson's rule.
    fn integrated(of: impl Fn(f64) -> Vector3<f64>) -> Vector3<f64> {
        let intervals = 4000;
        let mut sum = Vector3::zeros();
        for i in 0..=intervals {
            let weight = match i {
                0 => 1.0,
                i if i == intervals => 1.0,
                i => [2.0, 4.0][i % 2],
            };
            sum += of(i as f64 / intervals as f64) * weight;
        }
        sum / (3.0 * intervals as f64)
    }

    /// The integral over all time of a rate along the path `s0 + w t`: in x = 1/(1 + t/T), which brings infinity to 0, with `T = |s0|/|w|`.
    /// `at_end` is the limit of the rate times `t^2`.
    fn along(
        (s0, w): (Vector3<f64>, Vector3<f64>),
        at_end: Vector3<f64>,
        of: impl Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Vector3<f64> {
        let scale = s0.norm() / w.norm();
        integrated(|x| {
            if x <= 0.0 {
                return at_end / scale;
            }
            of(s0 + w * (scale * (1.0 / x - 1.0))) * (scale / (x * x))
        })
    }

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
    fn val_twice_as_large_and_twice_as_far_is_as_large_a_turn_and_twice_the_drift() {
        let of = |size: f64| {
            let squirmers = [2.0, -3.0].map(|beta| {
                (Squirmer::with_beta(1.0, beta))
                    .and_then(|s| s.with_radius(size))
                    .unwrap()
            });
            let at = Configuration {
                radii: [size; 2],
                gap: Gap::new(10.0 * size).unwrap(),
                midpoint: Vector3::zeros(),
                line: Vector3::x(),
                orientations: [-1.0, 1.0].map(|x| Vector3::new(x, 0.8, 0.3).normalize()),
                line_angle_rad: 0.0,
                angles_rad: [0.0; 2],
            };
            let turned = turned_to_infinity(&squirmers, &at).unwrap();
            (
                turned.orientations,
                far_drift(&squirmers, &at, false).unwrap(),
            )
        };
        let ((turns, drifts), (same, twice)) = (of(1.0), of(2.0));
        for k in [0, 1] {
            assert_relative_eq!(turns[k], same[k], epsilon = 1e-14);
            assert_relative_eq!(2.0 * drifts[k], twice[k], epsilon = 1e-14);
        }
        assert!(drifts[0].norm() > 0.01);
    }

    #[test]
    fn val_the_drift_to_come_is_the_integral_of_the_flow() {
        let p = Vector3::new(0.3, -0.5, 0.8).normalize();
        let s0 = Vector3::new(4.0, 7.0, -2.0);
        for w in [
            Vector3::new(0.5, 1.3, 0.4),
            Vector3::new(1.0, -0.5, 0.9),
            s0 * 0.1,
        ] {
            let c: f64 = p.dot(&w) / w.norm();
            let at_end = w * (-0.5 * 7.5 * (3.0 * c * c - 1.0) / f64::powi(w.norm(), 3));
            let integral = along((s0, w), at_end, |s| {
                let (r, c) = (s.norm(), p.dot(&s) / s.norm());
                let stresslet = s * (-0.5 * 7.5 * (3.0 * c * c - 1.0));
                let dipole = (s * (3.0 * c / r) - p) * (1.5 / 3.0);
                (stresslet + dipole) / (r * r * r)
            });
            assert_relative_eq!(drift_by([1.5, 7.5], p, s0, w), integral, epsilon = 1e-7);
        }
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
            let integral = along((s0, w), Vector3::zeros(), |s| spin(7.5, p, s));
            assert_relative_eq!(turn_by(7.5, p, s0, w), integral, epsilon = 1e-7);
        }
    }

    #[test]
    fn val_the_moment_of_the_turn_is_the_integral_of_time_and_rate() {
        let p = Vector3::new(0.3, -0.5, 0.8).normalize();
        let s0 = Vector3::new(4.0, 7.0, -2.0);
        for w in [
            Vector3::new(0.5, 1.3, 0.4),
            Vector3::new(1.0, -0.5, 0.9),
            s0 * 0.1,
        ] {
            let rate = |s: Vector3<f64>| p.cross(&s) * (-1.5 * 7.5 * p.dot(&s) / s.norm().powi(5));
            let time = |s: Vector3<f64>| (s - s0).dot(&w) / w.norm_squared();
            let integral = along((s0, w), rate(w), |s| rate(s) * time(s));
            assert_relative_eq!(
                turn_moment_by(7.5, p, s0, w),
                integral,
                epsilon = 1e-6 * integral.norm()
            );
        }
    }

    #[test]
    fn headings_at_an_angle_turn_as_one_over_the_distance_squared_and_opposed_ones_as_its_cube() {
        let (beta, alpha, r0) = (5.0, 0.7_f64, 50.0);
        let pair = [Squirmer::with_beta(1.0, beta).unwrap(); 2];
        let at = |angles: [f64; 2], line_angle_rad: f64| Configuration {
            radii: [1.0; 2],
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
            radii: [1.0; 2],
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
