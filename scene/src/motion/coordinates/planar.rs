//! Motion in a plane of constant z.

use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::elementary::{sin_cos, sines_cosines};
use crate::frame::{Configuration, Rates, direction};
use crate::mobility::{Heading, PairVelocity};
use crate::motion::chart::Chart;
use crate::motion::equations::Dynamics;
use crate::motion::steady::Relative;
use crate::{Gap, Gravity, LoadSet, Squirmer};

/// Motion in a plane of constant z:
/// midpoint x, y; angle of the line of centres; `ln eps`; and each orientation's angle measured
/// from the direction to the other sphere (so that a facing pair has zeros, exactly).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planar {
    /// The plane.
    pub z: f64,
}

const THETA: usize = 2;

impl Chart<6> for Planar {
    #[inline]
    fn ln_gap(&self) -> usize {
        3
    }

    fn relative(&self) -> Option<Relative> {
        Some(Relative {
            variables: &[3, 4, 5],
            driven: THETA,
        })
    }

    fn encode(&self, c: &Configuration) -> [f64; 6] {
        let theta = c.line_angle_rad;
        // In this order a pair of opposed orientations has equal angles, exactly.
        let [a1, a2] = [c.angles_rad[0] - theta, (c.angles_rad[1] - PI) - theta];
        [c.midpoint.x, c.midpoint.y, theta, c.gap.ln(), a1, a2]
    }

    fn decode(&self, y: &[f64; 6], previous: &Configuration) -> Configuration {
        let [x, y0, theta, ln_gap, a1, a2] = *y;
        let angles = [theta + a1, theta + PI + a2];
        Configuration {
            radii: previous.radii,
            gap: Gap::from_ln(ln_gap),
            midpoint: Vector3::new(x, y0, self.z),
            line: direction(theta),
            orientations: angles.map(direction),
            line_angle_rad: theta,
            angles_rad: angles,
        }
    }

    fn carried_on(&self, y: &[f64; 6], dy: &[f64; 6], t: f64) -> Option<[f64; 6]> {
        let turned = dy[THETA] * t;
        let (half, quarter) = (0.5 * turned, 0.5 * turned * 0.5 * turned);
        // sin(h)/h, the chord of the circle over its arc.
        let chord = if half.abs() < 1e-4 {
            1.0 - quarter / 6.0
        } else {
            half.sin() / half
        };
        // The velocity half way, turned with the pair.
        let (sin, cos) = half.sin_cos();
        let mut carried = *y;
        carried[0] += t * chord * (dy[0] * cos - dy[1] * sin);
        carried[1] += t * chord * (dy[0] * sin + dy[1] * cos);
        carried[THETA] += turned;
        Some(carried)
    }

    fn rates(&self, y: &[f64; 6], dy: &[f64; 6]) -> Rates {
        let turned = |angle: f64| Vector3::new(-angle.sin(), angle.cos(), 0.0);
        Rates {
            midpoint: Vector3::new(dy[0], dy[1], 0.0),
            line: turned(y[THETA]) * dy[THETA],
            ln_gap: dy[3],
            orientations: [
                turned(y[THETA] + y[4]) * (dy[THETA] + dy[4]),
                turned(y[THETA] + PI + y[5]) * (dy[THETA] + dy[5]),
            ],
        }
    }
}

impl Dynamics<6> for Planar {
    type Across = f64;

    #[inline(always)]
    fn read(set: LoadSet) -> LoadSet {
        LoadSet::planar(set.modes)
    }

    #[inline(always)]
    fn headings(&self, y: &[f64; 6]) -> [Heading<f64>; 2] {
        let [(s1, c1), (s2, c2)] = sines_cosines([y[4], y[5]]);
        // The second squirmer's own transverse axis is opposed to the common one.
        [
            Heading {
                cosine: c1,
                transverse: s1,
            },
            Heading {
                cosine: c2,
                transverse: -s2,
            },
        ]
    }

    #[inline]
    fn gravity_torques(
        &self,
        y: &[f64; 6],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> [f64; 2] {
        let g = gravity.direction();
        let torque = |angle: f64, squirmer: &Squirmer| {
            let (sin, cos) = sin_cos(angle);
            -squirmer.gravity_torque() * (cos * g.y - sin * g.x)
        };
        // Half a turn is a sign: added to the angle, it would round off the pair's symmetry.
        [
            torque(y[THETA] + y[4], &squirmers[0]),
            -torque(y[THETA] + y[5], &squirmers[1]),
        ]
    }

    #[inline]
    fn derivative(&self, y: &[f64; 6], v: &PairVelocity<f64>) -> [f64; 6] {
        let (sin, cos) = sin_cos(y[THETA]);
        [
            v.mean_axial * cos - v.mean_transverse * sin,
            v.mean_axial * sin + v.mean_transverse * cos,
            v.turning,
            v.opening,
            v.spin[0] - v.turning,
            v.spin[1] - v.turning,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn val_a_pair_that_turns_steadily_goes_on_along_a_circle() {
        let chart = Planar { z: 0.0 };
        let y = [1.0, -2.0, 0.3, -1.0, 0.2, 0.4];
        let (u, v) = (0.7, -0.2);
        for rate in [0.0, 1e-9, 1e-5, 1e-3, 0.4, -3.0] {
            let dy = [u, v, rate, 0.0, 0.0, 0.0];
            for t in [0.1, 1.0, 7.0] {
                let carried = chart.carried_on(&y, &dy, t).unwrap();
                let turned = rate * t;
                // The integral of the velocity as it turns.
                let [along, across] = if turned.abs() < 1e-6 {
                    [t, 0.5 * t * turned]
                } else {
                    let half = (0.5 * turned).sin();
                    [turned.sin() / rate, 2.0 * half * half / rate]
                };
                let expected = [y[0] + u * along - v * across, y[1] + u * across + v * along];
                for k in [0, 1] {
                    assert!(
                        (carried[k] - expected[k]).abs() < 1e-12 * (1.0 + t),
                        "{rate} {t}: {carried:?} {expected:?}"
                    );
                }
                assert!((carried[THETA] - y[THETA] - turned).abs() < 1e-15 * (1.0 + turned.abs()));
                assert_eq!(carried[3..], y[3..]);
            }
        }
    }
}
