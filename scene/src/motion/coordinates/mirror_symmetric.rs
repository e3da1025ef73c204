//! Coordinates of a pair whose members are mirror images of each other: half the state.
//!
//! The headings are formed as in the full coordinates, so that a right-hand side has the same bits.

use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::elementary::sin_cos;
use crate::frame::{Configuration, Rates, across, direction, unwind};
use crate::mobility::{
    External, Heading, Image, ModeMobility, PairMobility, PairVelocity, symmetric_velocity,
};
use crate::motion::chart::Chart;
use crate::motion::equations::Dynamics;
use crate::motion::steady::Relative;
use crate::{Gap, Gravity, LoadSet, Squirmer};

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
    pub fn new(start: &Configuration) -> Self {
        let [one, two] = start.angles_rad;
        Self {
            midpoint: start.midpoint,
            line: start.line,
            line_angle_rad: start.line_angle_rad,
            sum: unwind(2.0 * start.line_angle_rad + PI, one + two),
        }
    }
}

impl Chart<3> for MirrorSymmetric {
    #[inline]
    fn ln_gap(&self) -> usize {
        1
    }

    fn relative(&self) -> Option<Relative> {
        Some(Relative {
            variables: &[1, 2],
            driven: 0,
        })
    }

    fn encode(&self, c: &Configuration) -> [f64; 3] {
        let along = (c.midpoint - self.midpoint).dot(&across(self.line));
        [along, c.gap.ln(), c.angles_rad[0] - self.line_angle_rad]
    }

    fn decode(&self, y: &[f64; 3], previous: &Configuration) -> Configuration {
        let angle = self.line_angle_rad + y[2];
        self.restored(Configuration {
            radii: previous.radii,
            gap: Gap::from_ln(y[1]),
            midpoint: self.midpoint + across(self.line) * y[0],
            line: self.line,
            orientations: [direction(angle); 2],
            line_angle_rad: self.line_angle_rad,
            angles_rad: [angle; 2],
        })
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

impl Dynamics<3> for MirrorSymmetric {
    type Across = f64;

    #[inline(always)]
    fn read(set: LoadSet) -> LoadSet {
        LoadSet::planar(set.modes).mirror_symmetric()
    }

    #[inline(always)]
    fn headings(&self, y: &[f64; 3]) -> [Heading<f64>; 2] {
        let (transverse, cosine) = sin_cos(y[2]);
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
        let torque = -squirmers[0].gravity_torque() * (sin_cos(y[2]).1 * down);
        [torque, -torque]
    }

    #[inline(always)]
    fn velocity(
        mobility: (&PairMobility, &[ModeMobility]),
        [squirmer, _]: &[Squirmer; 2],
        [heading, _]: &[Heading<f64>; 2],
        external: &External<f64>,
    ) -> PairVelocity<f64> {
        symmetric_velocity(Image::Mirror, mobility, squirmer, heading, external)
    }

    #[inline(always)]
    fn derivative(&self, _: &[f64; 3], v: &PairVelocity<f64>) -> [f64; 3] {
        [v.mean_transverse, v.opening, v.spin[0]]
    }
}
