//! Coordinates of pairs with a symmetry, which the motion keeps: half the state, or less.
//!
//! The headings are formed as in the full coordinates, so that a right-hand side has the same bits.

use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

use super::configuration::{Configuration, Rates, unwind};
use super::coordinates::{Coordinates, direction};
use super::steady::Relative;
use crate::balance::{External, Heading, Image, PairVelocity, symmetric_velocity};
use crate::{Gap, Gravity, PairLoads, Squirmer};

/// Unit vector a quarter turn on.
fn across(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(-v.y, v.x, 0.0)
}

/// A pair that is its own image under the rotation by pi about its midpoint, which is fixed: angle of the
/// line of centres, `ln eps`, and the angle of either orientation from the direction to the other
/// sphere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointSymmetric {
    midpoint: Vector3<f64>,
    /// What the second orientation's angle is ahead of the first one's: pi and whole turns.
    ahead: f64,
}

impl PointSymmetric {
    pub(super) fn new(start: &Configuration) -> Self {
        let [one, two] = start.angles_rad;
        Self {
            midpoint: start.midpoint,
            ahead: PI + TAU * ((two - one - PI) / TAU).round(),
        }
    }
}

impl Coordinates<3> for PointSymmetric {
    type Across = f64;
    const LN_GAP: usize = 1;
    const RELATIVE: Option<Relative> = Some(Relative {
        variables: &[1, 2],
        driven: 0,
    });

    fn encode(&self, c: &Configuration) -> [f64; 3] {
        [
            c.line_angle_rad,
            c.gap.ln(),
            c.angles_rad[0] - c.line_angle_rad,
        ]
    }

    fn decode(&self, y: &[f64; 3], _previous: &Configuration) -> Configuration {
        let [theta, ln_gap, alpha] = *y;
        self.restored(Configuration {
            gap: Gap::from_ln(ln_gap),
            midpoint: self.midpoint,
            line: direction(theta),
            orientations: [direction(theta + alpha); 2],
            line_angle_rad: theta,
            angles_rad: [theta + alpha; 2],
        })
    }

    #[inline]
    fn headings(&self, y: &[f64; 3]) -> [Heading<f64>; 2] {
        let (sin, cosine) = y[2].sin_cos();
        [sin, -sin].map(|transverse| Heading { cosine, transverse })
    }

    fn gravity_torques(&self, _: &[f64; 3], _: Gravity, _: &[Squirmer; 2]) -> [f64; 2] {
        // Gravity breaks this symmetry: no plan has both.
        [0.0; 2]
    }

    #[inline(always)]
    fn velocity(
        gap: Gap,
        loads: &PairLoads,
        [squirmer, _]: &[Squirmer; 2],
        [heading, _]: &[Heading<f64>; 2],
        external: &External<f64>,
    ) -> PairVelocity<f64> {
        symmetric_velocity(Image::Point, gap, loads, squirmer, heading, external)
    }

    #[inline]
    fn derivative(&self, _: &[f64; 3], v: &PairVelocity<f64>) -> [f64; 3] {
        [v.turning, v.opening, v.spin[0] - v.turning]
    }

    fn carried_on(&self, y: &[f64; 3], dy: &[f64; 3], t: f64) -> Option<[f64; 3]> {
        Some([y[0] + dy[0] * t, y[1], y[2]])
    }

    fn rates(&self, y: &[f64; 3], dy: &[f64; 3]) -> Rates {
        let turned = across(direction(y[0] + y[2])) * (dy[0] + dy[2]);
        Rates {
            midpoint: Vector3::zeros(),
            line: across(direction(y[0])) * dy[0],
            ln_gap: dy[1],
            orientations: [turned, -turned],
        }
    }

    fn restored(&self, c: Configuration) -> Configuration {
        let [one, _] = c.orientations;
        Configuration {
            midpoint: self.midpoint,
            orientations: [one, -one],
            angles_rad: [c.angles_rad[0], c.angles_rad[0] + self.ahead],
            ..c
        }
    }
}

/// A pair whose members are images of each other in a mirror, which is fixed: position of the midpoint
/// along the mirror, `ln eps`, and the angle of the first orientation from the direction to the other
/// sphere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MirrorSymmetric {
    midpoint: Vector3<f64>,
    line: Vector3<f64>,
    line_angle_rad: f64,
    /// Sum of the two orientations' angles.
    sum: f64,
}

impl MirrorSymmetric {
    pub(super) fn new(start: &Configuration) -> Self {
        let [one, two] = start.angles_rad;
        Self {
            midpoint: start.midpoint,
            line: start.line,
            line_angle_rad: start.line_angle_rad,
            sum: unwind(2.0 * start.line_angle_rad + PI, one + two),
        }
    }
}

impl Coordinates<3> for MirrorSymmetric {
    type Across = f64;
    const LN_GAP: usize = 1;
    const RELATIVE: Option<Relative> = Some(Relative {
        variables: &[1, 2],
        driven: 0,
    });

    fn encode(&self, c: &Configuration) -> [f64; 3] {
        let along = (c.midpoint - self.midpoint).dot(&across(self.line));
        [along, c.gap.ln(), c.angles_rad[0] - self.line_angle_rad]
    }

    fn decode(&self, y: &[f64; 3], _previous: &Configuration) -> Configuration {
        let angle = self.line_angle_rad + y[2];
        self.restored(Configuration {
            gap: Gap::from_ln(y[1]),
            midpoint: self.midpoint + across(self.line) * y[0],
            line: self.line,
            orientations: [direction(angle); 2],
            line_angle_rad: self.line_angle_rad,
            angles_rad: [angle; 2],
        })
    }

    #[inline]
    fn headings(&self, y: &[f64; 3]) -> [Heading<f64>; 2] {
        let (transverse, cosine) = y[2].sin_cos();
        [Heading { cosine, transverse }; 2]
    }

    #[inline]
    fn gravity_torques(
        &self,
        y: &[f64; 3],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> [f64; 2] {
        // Gravity lies in the mirror: `-(V_s G_bh/pi) p x g` of the first, its opposite for the second.
        let down = gravity.direction().dot(&across(self.line));
        let torque = -squirmers[0].gravity_torque() * (y[2].cos() * down);
        [torque, -torque]
    }

    #[inline(always)]
    fn velocity(
        gap: Gap,
        loads: &PairLoads,
        [squirmer, _]: &[Squirmer; 2],
        [heading, _]: &[Heading<f64>; 2],
        external: &External<f64>,
    ) -> PairVelocity<f64> {
        symmetric_velocity(Image::Mirror, gap, loads, squirmer, heading, external)
    }

    #[inline]
    fn derivative(&self, _: &[f64; 3], v: &PairVelocity<f64>) -> [f64; 3] {
        [v.mean_transverse, v.opening, v.spin[0]]
    }

    fn carried_on(&self, y: &[f64; 3], dy: &[f64; 3], t: f64) -> Option<[f64; 3]> {
        Some([y[0] + dy[0] * t, y[1], y[2]])
    }

    fn rates(&self, y: &[f64; 3], dy: &[f64; 3]) -> Rates {
        let turned = across(direction(self.line_angle_rad + y[2])) * dy[2];
        Rates {
            midpoint: across(self.line) * dy[0],
            line: Vector3::zeros(),
            ln_gap: dy[1],
            orientations: [turned, turned - self.line * (2.0 * turned.dot(&self.line))],
        }
    }

    fn restored(&self, c: Configuration) -> Configuration {
        let along = across(self.line);
        let [one, _] = c.orientations;
        Configuration {
            midpoint: self.midpoint + along * (c.midpoint - self.midpoint).dot(&along),
            line: self.line,
            line_angle_rad: self.line_angle_rad,
            orientations: [one, one - self.line * (2.0 * one.dot(&self.line))],
            angles_rad: [c.angles_rad[0], self.sum - c.angles_rad[0]],
            ..c
        }
    }
}

/// A pair whose orientations lie along the line of centres, which is fixed: position of the midpoint
/// along it and `ln eps`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axisymmetric {
    start: Configuration,
    /// `p . d_k` of each, 1 or -1.
    cosines: [f64; 2],
}

impl Axisymmetric {
    pub(super) fn new(start: &Configuration) -> Self {
        let [one, two] = start.orientations.map(|p| p.dot(&start.line).signum());
        Self {
            start: *start,
            cosines: [one, -two],
        }
    }
}

impl Coordinates<2> for Axisymmetric {
    type Across = f64;
    const LN_GAP: usize = 1;
    const RELATIVE: Option<Relative> = Some(Relative {
        variables: &[1],
        driven: 0,
    });

    fn encode(&self, c: &Configuration) -> [f64; 2] {
        let along = (c.midpoint - self.start.midpoint).dot(&self.start.line);
        [along, c.gap.ln()]
    }

    fn decode(&self, y: &[f64; 2], _previous: &Configuration) -> Configuration {
        Configuration {
            gap: Gap::from_ln(y[1]),
            midpoint: self.start.midpoint + self.start.line * y[0],
            ..self.start
        }
    }

    #[inline]
    fn headings(&self, _: &[f64; 2]) -> [Heading<f64>; 2] {
        self.cosines.map(|cosine| Heading {
            cosine,
            transverse: 0.0,
        })
    }

    fn gravity_torques(&self, _: &[f64; 2], _: Gravity, _: &[Squirmer; 2]) -> [f64; 2] {
        // No plan has both.
        [0.0; 2]
    }

    #[inline]
    fn derivative(&self, _: &[f64; 2], v: &PairVelocity<f64>) -> [f64; 2] {
        [v.mean_axial, v.opening]
    }

    fn carried_on(&self, y: &[f64; 2], dy: &[f64; 2], t: f64) -> Option<[f64; 2]> {
        Some([y[0] + dy[0] * t, y[1]])
    }

    fn rates(&self, _: &[f64; 2], dy: &[f64; 2]) -> Rates {
        Rates {
            midpoint: self.start.line * dy[0],
            line: Vector3::zeros(),
            ln_gap: dy[1],
            orientations: [Vector3::zeros(); 2],
        }
    }

    fn restored(&self, c: Configuration) -> Configuration {
        let along = (c.midpoint - self.start.midpoint).dot(&self.start.line);
        Configuration {
            gap: c.gap,
            midpoint: self.start.midpoint + self.start.line * along,
            ..self.start
        }
    }
}
