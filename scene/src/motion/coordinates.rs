//! Coordinates in which the pair's motion is integrated.
//!
//! Both carry `ln eps` as a variable of its own, so that the spheres cannot overlap and the gap
//! keeps its digits near contact, the midpoint of the two centres, and the line of centres `d`.

use nalgebra::Vector3;
use std::f64::consts::PI;

use super::configuration::{Configuration, Rates, unwind};
use super::equations::{self, Effect, Instant};
use super::steady::Relative;
use super::swirling::{self, Swirl};
use crate::balance::{External, Heading, PairVelocity, Transverse, axial_spins, pair_velocity};
use crate::{Gap, Gravity, Hydrodynamics, PairLoads, SceneError, SelfOther, Squirmer};

/// Coordinates of dimension `N`.
pub(crate) trait Coordinates<const N: usize>: Copy {
    /// What is perpendicular to the line of centres.
    type Across: Transverse;
    /// Index of `ln eps`.
    const LN_GAP: usize;
    /// Whether angles are wound on from one step to the next, so that the configuration must be known at each.
    const WOUND: bool = false;
    /// Whether headings take sines.
    const SINES: bool = true;
    /// The variables that without gravity are a system of their own, if there are such.
    const RELATIVE: Option<Relative>;

    /// The state of a configuration.
    fn encode(&self, configuration: &Configuration) -> [f64; N];
    /// The configuration of a state, its angles wound on from those of `previous`.
    fn decode(&self, y: &[f64; N], previous: &Configuration) -> Configuration;
    /// Orientations in the pair frame.
    fn headings(&self, y: &[f64; N]) -> [Heading<Self::Across>; 2];
    /// Torques of gravity as `T x d`, per `pi mu a^2`.
    fn gravity_torques(
        &self,
        y: &[f64; N],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> [Self::Across; 2];
    /// Time derivative of the state at an instant, by its headings and the loads of its model.
    ///
    /// # Errors
    /// The model's.
    #[inline(always)]
    fn motion<H, G>(
        &self,
        y: &[f64; N],
        headings: &[Heading<Self::Across>; 2],
        at: &Instant<'_, H, G>,
    ) -> Result<[f64; N], SceneError>
    where
        H: Hydrodynamics + ?Sized,
        G: Effect<Gravity>,
    {
        equations::derivative(self, y, headings, at)
    }
    /// Velocity of the pair without swirl.
    #[inline(always)]
    fn velocity(
        gap: Gap,
        loads: &PairLoads,
        squirmers: &[Squirmer; 2],
        headings: &[Heading<Self::Across>; 2],
        external: &External<Self::Across>,
    ) -> PairVelocity<Self::Across> {
        pair_velocity(gap, loads, squirmers, headings, external)
    }
    /// Time derivative of the state for a velocity of the pair.
    fn derivative(&self, y: &[f64; N], velocity: &PairVelocity<Self::Across>) -> [f64; N];
    /// The state after the further time `t` when only position and line of centres change, at the
    /// constant rates that `dy` has in the frame of the pair; none without [`Self::RELATIVE`].
    fn carried_on(&self, y: &[f64; N], dy: &[f64; N], t: f64) -> Option<[f64; N]>;
    /// Largest departure from unit length of the directions in the state, which are integrated as vectors;
    /// zero for angles.
    fn unit_drift(&self, _y: &[f64; N]) -> f64 {
        0.0
    }
    /// How the derivative `dy` changes the configuration.
    fn rates(&self, y: &[f64; N], dy: &[f64; N]) -> Rates;
    /// `configuration` with what a symmetry of the coordinates says put right, to the last bit, where
    /// free flight in the laboratory frame has rounded it.
    fn restored(&self, configuration: Configuration) -> Configuration {
        configuration
    }
    /// What gravity adds to [`Self::derivative`]: spin about the line of centres. Nothing in a plane, to which
    /// its torques are perpendicular.
    #[inline]
    fn add_axial_spin(
        &self,
        _y: &[f64; N],
        _dy: &mut [f64; N],
        _loads: &PairLoads,
        _gravity: Gravity,
        _squirmers: &[Squirmer; 2],
    ) {
    }
}

/// Unit vector at an angle in the x-y plane.
pub(super) fn direction(angle: f64) -> Vector3<f64> {
    let (sin, cos) = angle.sin_cos();
    Vector3::new(cos, sin, 0.0)
}

/// Motion in a plane of constant z:
/// midpoint x, y; angle of the line of centres; `ln eps`; and each orientation's angle measured
/// from the direction to the other sphere (so that a facing pair has zeros, exactly).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planar {
    /// The plane.
    pub z: f64,
}

const THETA: usize = 2;

impl Coordinates<6> for Planar {
    type Across = f64;
    const LN_GAP: usize = 3;
    const RELATIVE: Option<Relative> = Some(Relative {
        variables: &[3, 4, 5],
        driven: THETA,
    });

    fn encode(&self, c: &Configuration) -> [f64; 6] {
        let theta = c.line_angle;
        // In this order a pair of opposed orientations has equal angles, exactly.
        let [a1, a2] = [c.angles[0] - theta, (c.angles[1] - PI) - theta];
        [c.midpoint.x, c.midpoint.y, theta, c.gap.ln(), a1, a2]
    }

    fn decode(&self, y: &[f64; 6], _previous: &Configuration) -> Configuration {
        let [x, y0, theta, ln_gap, a1, a2] = *y;
        let angles = [theta + a1, theta + PI + a2];
        Configuration {
            gap: Gap::from_ln(ln_gap),
            midpoint: Vector3::new(x, y0, self.z),
            line: direction(theta),
            orientations: angles.map(direction),
            line_angle: theta,
            angles,
        }
    }

    #[inline]
    fn headings(&self, y: &[f64; 6]) -> [Heading<f64>; 2] {
        let [(s1, c1), (s2, c2)] = [y[4].sin_cos(), y[5].sin_cos()];
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
            let (sin, cos) = angle.sin_cos();
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
        let (sin, cos) = y[THETA].sin_cos();
        [
            v.mean_axial * cos - v.mean_transverse * sin,
            v.mean_axial * sin + v.mean_transverse * cos,
            v.turning,
            v.opening,
            v.spin[0] - v.turning,
            v.spin[1] - v.turning,
        ]
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
pub(super) fn along_line(y: &[f64; 13]) -> Vector3<f64> {
    vector(y, LINE).normalize()
}

#[inline]
fn store(y: &mut [f64; 13], at: usize, v: Vector3<f64>) {
    y[at..at + 3].copy_from_slice(v.as_slice());
}

const MIDPOINT: usize = 0;
const LINE: usize = 3;
const ORIENTATION: [usize; 2] = [7, 10];

impl<W: Effect<Swirl>> Coordinates<13> for Spatial<W> {
    type Across = Vector3<f64>;
    const WOUND: bool = true;
    const SINES: bool = false;
    const LN_GAP: usize = SPATIAL_LN_GAP;
    const RELATIVE: Option<Relative> = None;

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
            gap: Gap::from_ln(y[SPATIAL_LN_GAP]),
            midpoint: vector(y, MIDPOINT),
            line,
            orientations,
            line_angle: azimuth(line, previous.line_angle),
            angles: [0, 1].map(|k| azimuth(orientations[k], previous.angles[k])),
        }
    }

    #[inline]
    fn headings(&self, y: &[f64; 13]) -> [Heading<Vector3<f64>>; 2] {
        let d = vector(y, LINE).normalize();
        let [along, against] = ORIENTATION.map(|at| {
            let p = vector(y, at).normalize();
            let along = p.dot(&d);
            Heading {
                cosine: along,
                transverse: p - d * along,
            }
        });
        [
            along,
            Heading {
                cosine: -against.cosine,
                ..against
            },
        ]
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
    fn motion<H, G>(
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
            None => equations::derivative(self, y, headings, at),
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

    fn carried_on(&self, _: &[f64; 13], _: &[f64; 13], _: f64) -> Option<[f64; 13]> {
        None
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

    #[inline]
    fn add_axial_spin(
        &self,
        y: &[f64; 13],
        dy: &mut [f64; 13],
        loads: &PairLoads,
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) {
        let d = vector(y, LINE).normalize();
        let [t1, t2] = spatial_torques(y, gravity, squirmers).map(|torque| torque.dot(&d));
        let torque = SelfOther::new(t1, t2);
        spin_about(&d, y, dy, axial_spins(loads, torque));
    }
}

/// Adds spins about the line of centres to a derivative.
#[inline]
pub(super) fn spin_about(d: &Vector3<f64>, y: &[f64; 13], dy: &mut [f64; 13], spins: [f64; 2]) {
    for (at, spin) in ORIENTATION.into_iter().zip(spins) {
        let turned = vector(dy, at) + d.cross(&vector(y, at)) * spin;
        store(dy, at, turned);
    }
}

/// Torques of gravity, `-(V_s G_bh/pi) p x g` per `pi mu a^2` (the paper's Eq. 9).
#[inline]
fn spatial_torques(
    y: &[f64; 13],
    gravity: Gravity,
    squirmers: &[Squirmer; 2],
) -> [Vector3<f64>; 2] {
    [0, 1].map(|k| {
        let p = vector(y, ORIENTATION[k]).normalize();
        p.cross(&gravity.direction()) * -squirmers[k].gravity_torque()
    })
}
