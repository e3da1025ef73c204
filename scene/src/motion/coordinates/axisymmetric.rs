//! Coordinates of a pair whose orientations lie along the line of centres: a third of the state.

use nalgebra::Vector3;

use crate::frame::{Configuration, Rates};
use crate::mobility::{Heading, PairVelocity};
use crate::motion::chart::Chart;
use crate::motion::equations::Dynamics;
use crate::motion::steady::Relative;
use crate::{Gap, Gravity, LoadSet, Squirmer};

/// A pair whose orientations lie along the line of centres, which is fixed: position of the midpoint
/// along it and `ln eps`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axisymmetric {
    start: Configuration,
    /// `p . d_k` of each, 1 or -1.
    cosines: [f64; 2],
}

impl Axisymmetric {
    pub fn new(start: &Configuration) -> Self {
        let [one, two] = start.orientations.map(|p| p.dot(&start.line).signum());
        Self {
            start: *start,
            cosines: [one, -two],
        }
    }
}

impl Chart<2> for Axisymmetric {
    #[inline]
    fn ln_gap(&self) -> usize {
        1
    }

    fn relative(&self) -> Option<Relative> {
        Some(Relative {
            variables: &[1],
            driven: 0,
        })
    }

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

impl Dynamics<2> for Axisymmetric {
    type Across = f64;

    #[inline(always)]
    fn read(set: LoadSet) -> LoadSet {
        LoadSet {
            axial: set.axial,
            ..LoadSet::axial(set.modes)
        }
    }

    #[inline(always)]
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

    #[inline(always)]
    fn derivative(&self, _: &[f64; 2], v: &PairVelocity<f64>) -> [f64; 2] {
        [v.mean_axial, v.opening]
    }
}
