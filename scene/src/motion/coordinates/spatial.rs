//! Motion in three dimensions.

use nalgebra::Vector3;

use crate::frame::{Configuration, Rates, unwind};
use crate::mobility::{Heading, PairVelocity};
use crate::motion::chart::Chart;
use crate::motion::equations::{self, Dynamics, Effect, Instant};
use crate::motion::steady::Relative;
use crate::motion::swirling::{self, Swirl};
use crate::{Gap, Gravity, Hydrodynamics, LoadSet, SceneError, Squirmer};

/// Motion in three dimensions: midpoint, line of centres, `ln eps`, both orientations.
///
/// The vectors' lengths are preserved by the equations and only their directions enter, so a
/// drift of the length by rounding has no effect.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spatial<W> {
    /// Swirl, if it acts.
    pub swirl: W,
}

const SPATIAL_LN_GAP: usize = 6;

#[inline]
fn vector(y: &[f64; 13], at: usize) -> Vector3<f64> {
    Vector3::new(y[at], y[at + 1], y[at + 2])
}

/// Unit vector along the line of centres.
#[inline]
pub(in crate::motion) fn along_line(y: &[f64; 13]) -> Vector3<f64> {
    vector(y, LINE).normalize()
}

#[inline]
fn store(y: &mut [f64; 13], at: usize, v: Vector3<f64>) {
    y[at..at + 3].copy_from_slice(v.as_slice());
}

const MIDPOINT: usize = 0;
const LINE: usize = 3;
const ORIENTATION: [usize; 2] = [7, 10];

impl<W: Effect<Swirl>> Chart<13> for Spatial<W> {
    #[inline]
    fn ln_gap(&self) -> usize {
        SPATIAL_LN_GAP
    }

    fn is_wound(&self) -> bool {
        true
    }

    fn relative(&self) -> Option<Relative> {
        None
    }

    fn encode(&self, c: &Configuration) -> [f64; 13] {
        let mut y = [0.0; 13];
        store(&mut y, MIDPOINT, c.midpoint);
        store(&mut y, LINE, c.line);
        y[SPATIAL_LN_GAP] = c.gap.ln();
        for (at, p) in ORIENTATION.into_iter().zip(c.orientations) {
            store(&mut y, at, p);
        }
        y
    }

    fn decode(&self, y: &[f64; 13], previous: &Configuration) -> Configuration {
        let azimuth = |v: Vector3<f64>, before: f64| unwind(v.y.atan2(v.x), before);
        let line = vector(y, LINE).normalize();
        let orientations = ORIENTATION.map(|at| vector(y, at).normalize());
        Configuration {
            radii: previous.radii,
            gap: Gap::from_ln(y[SPATIAL_LN_GAP]),
            midpoint: vector(y, MIDPOINT),
            line,
            orientations,
            line_angle_rad: azimuth(line, previous.line_angle_rad),
            angles_rad: [0, 1].map(|k| azimuth(orientations[k], previous.angles_rad[k])),
        }
    }

    fn unit_drift(&self, y: &[f64; 13]) -> f64 {
        let [first, second] = ORIENTATION;
        [LINE, first, second]
            .map(|at| (vector(y, at).norm() - 1.0).abs())
            .into_iter()
            .fold(0.0, f64::max)
    }

    fn rates(&self, y: &[f64; 13], dy: &[f64; 13]) -> Rates {
        let unit_rate = |at: usize| vector(dy, at) / vector(y, at).norm();
        Rates {
            midpoint: vector(dy, MIDPOINT),
            line: unit_rate(LINE),
            ln_gap: dy[SPATIAL_LN_GAP],
            orientations: ORIENTATION.map(unit_rate),
        }
    }
}

impl<W: Effect<Swirl>> Dynamics<13> for Spatial<W> {
    type Across = Vector3<f64>;

    #[inline(always)]
    fn read(set: LoadSet) -> LoadSet {
        LoadSet {
            twist: set.twist,
            swirl: set.swirl,
            ..LoadSet::planar(set.modes)
        }
    }

    #[inline]
    fn headings(&self, y: &[f64; 13]) -> [Heading<Vector3<f64>>; 2] {
        let d = vector(y, LINE).normalize();
        Heading::of_both(&d, ORIENTATION.map(|at| vector(y, at).normalize()))
    }

    #[inline]
    fn gravity_torques(
        &self,
        y: &[f64; 13],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> [Vector3<f64>; 2] {
        let d = vector(y, LINE).normalize();
        spatial_torques(y, gravity, squirmers).map(|torque| torque.cross(&d))
    }

    #[inline(always)]
    fn motion<const M: usize, H, G>(
        &self,
        y: &[f64; 13],
        headings: &[Heading<Vector3<f64>>; 2],
        at: &Instant<'_, H, G>,
    ) -> Result<[f64; 13], SceneError>
    where
        H: Hydrodynamics + ?Sized,
        G: Effect<Gravity>,
    {
        match self.swirl.get() {
            Some(Swirl) => swirling::derivative(self, y, headings, at),
            None => equations::derivative::<M, _, _, _, 13>(self, y, headings, at),
        }
    }

    #[inline]
    fn derivative(&self, y: &[f64; 13], v: &PairVelocity<Vector3<f64>>) -> [f64; 13] {
        let line = vector(y, LINE);
        let length = line.norm();
        let d = line / length;
        let mut dy = [0.0; 13];
        store(&mut dy, MIDPOINT, d * v.mean_axial + v.mean_transverse);
        store(&mut dy, LINE, v.turning * length);
        dy[SPATIAL_LN_GAP] = v.opening;
        for (at, w) in ORIENTATION.into_iter().zip(v.spin) {
            store(&mut dy, at, d.cross(&w).cross(&vector(y, at)));
        }
        dy
    }

    #[inline]
    fn axial_torques(
        &self,
        y: &[f64; 13],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> Option<[f64; 2]> {
        let d = vector(y, LINE).normalize();
        Some(spatial_torques(y, gravity, squirmers).map(|torque| torque.dot(&d)))
    }

    #[inline]
    fn add_axial_spin(&self, y: &[f64; 13], dy: &mut [f64; 13], spins: [f64; 2]) {
        spin_about(&along_line(y), y, dy, spins);
    }

    #[inline]
    fn turned(
        &self,
        y: &[f64; 13],
        headings: &[Heading<Vector3<f64>>; 2],
    ) -> Option<[Vector3<f64>; 2]> {
        let d = along_line(y);
        (self.swirl.get()).map(|Swirl| headings.each_ref().map(|heading| heading.turned(&d)))
    }
}

/// Adds spins about the line of centres to a derivative.
#[inline]
pub(in crate::motion) fn spin_about(
    d: &Vector3<f64>,
    y: &[f64; 13],
    dy: &mut [f64; 13],
    spins: [f64; 2],
) {
    for (at, spin) in ORIENTATION.into_iter().zip(spins) {
        let turned = vector(dy, at) + d.cross(&vector(y, at)) * spin;
        store(dy, at, turned);
    }
}

/// Torques of gravity, per `pi mu a^2`.
#[inline]
fn spatial_torques(
    y: &[f64; 13],
    gravity: Gravity,
    squirmers: &[Squirmer; 2],
) -> [Vector3<f64>; 2] {
    [0, 1].map(|k| {
        let p = vector(y, ORIENTATION[k]).normalize();
        gravity.torque(&squirmers[k], &p)
    })
}
