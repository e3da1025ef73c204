//! Coordinates of a pair that is its own image when turned by pi about its midpoint: half the state.
//!
//! The headings are formed as in the full coordinates, so that a right-hand side has the same bits.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;

use crate::elementary::sin_cos;
use crate::frame::{Configuration, Rates, across, direction};
use crate::mobility::{
    External, Heading, Image, ModeMobility, PairMobility, PairVelocity, symmetric_velocity,
};
use crate::motion::chart::Chart;
use crate::motion::equations::Dynamics;
use crate::motion::steady::Relative;
use crate::{Gap, Gravity, LoadSet, Squirmer};

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
    pub fn new(start: &Configuration) -> Self {
        let [one, two] = start.angles_rad;
        Self {
            midpoint: start.midpoint,
            ahead: PI + TAU * ((two - one - PI) / TAU).round(),
        }
    }
}

impl Chart<3> for PointSymmetric {
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
        [
            c.line_angle_rad,
            c.gap.ln(),
            c.angles_rad[0] - c.line_angle_rad,
        ]
    }

    fn decode(&self, y: &[f64; 3], previous: &Configuration) -> Configuration {
        let [theta, ln_gap, alpha] = *y;
        self.restored(Configuration {
            radii: previous.radii,
            gap: Gap::from_ln(ln_gap),
            midpoint: self.midpoint,
            line: direction(theta),
            orientations: [direction(theta + alpha); 2],
            line_angle_rad: theta,
            angles_rad: [theta + alpha; 2],
        })
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

impl Dynamics<3> for PointSymmetric {
    type Across = f64;

    #[inline(always)]
    fn read(set: LoadSet) -> LoadSet {
        LoadSet::planar(set.modes).point_symmetric()
    }

    #[inline(always)]
    fn headings(&self, y: &[f64; 3]) -> [Heading<f64>; 2] {
        let (sin, cosine) = sin_cos(y[2]);
        [sin, -sin].map(|transverse| Heading { cosine, transverse })
    }

    fn gravity_torques(&self, _: &[f64; 3], _: Gravity, _: &[Squirmer; 2]) -> [f64; 2] {
        // Gravity breaks this symmetry: no plan has both.
        [0.0; 2]
    }

    #[inline(always)]
    fn velocity(
        mobility: (&PairMobility, &[ModeMobility]),
        [squirmer, _]: &[Squirmer; 2],
        [heading, _]: &[Heading<f64>; 2],
        external: &External<f64>,
    ) -> PairVelocity<f64> {
        symmetric_velocity(Image::Point, mobility, squirmer, heading, external)
    }

    #[inline(always)]
    fn derivative(&self, _: &[f64; 3], v: &PairVelocity<f64>) -> [f64; 3] {
        [v.turning, v.opening, v.spin[0] - v.turning]
    }
}
