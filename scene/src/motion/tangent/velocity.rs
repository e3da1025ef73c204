//! How a pair moves in three dimensions, and how that changes: states, what drives them, velocities.

use nalgebra::Vector3;

use crate::mobility::{External, MobilityOfEach, PairVelocity, Slip, add_swirl_by, velocity_by};

/// Line of centres, `ln eps` and orientations, or the changes of them.
#[derive(Clone, Copy)]
pub(super) struct State {
    pub line: Vector3<f64>,
    pub ln_gap: f64,
    pub orientations: [Vector3<f64>; 2],
}

impl State {
    pub fn read(y: &[f64]) -> Self {
        let vector = |at: usize| Vector3::new(y[at], y[at + 1], y[at + 2]);
        Self {
            line: vector(3),
            ln_gap: y[6],
            orientations: [vector(7), vector(10)],
        }
    }

    /// The same with vectors of unit length.
    pub fn normalized(self) -> Self {
        Self {
            line: self.line.normalize(),
            orientations: self.orientations.map(|p| p.normalize()),
            ..self
        }
    }

    /// A change without what would change the length of a unit vector of `at`. None of it is meant, and what rounding and steps leave of it would drive the
    /// rest, and itself: on a long orbit it grew exponentially.
    pub fn across(self, at: &Self) -> Self {
        let across = |change: Vector3<f64>, unit: &Vector3<f64>| change - unit * unit.dot(&change);
        Self {
            line: across(self.line, &at.line),
            orientations: [0, 1].map(|k| across(self.orientations[k], &at.orientations[k])),
            ..self
        }
    }
}

/// Forces and torques of other than hydrodynamic origin, or the changes of them.
pub(super) struct Driven {
    /// Those along and across the line of centres.
    pub external: External<Vector3<f64>>,
    /// Torques about it.
    pub about: [f64; 2],
}

impl Driven {
    pub const NOTHING: Self = Self {
        external: External {
            repulsion: 0.0,
            torque: None,
        },
        about: [0.0; 2],
    };
}

/// A velocity with the spins about the line of centres.
#[derive(Clone, Copy)]
pub(super) struct Velocity {
    pub pair: PairVelocity<Vector3<f64>>,
    pub about: [f64; 2],
}

impl Velocity {
    /// By the slip and swirl of each squirmer and by what else drives the pair.
    pub fn by(
        mobility: &MobilityOfEach,
        slip: [impl Iterator<Item = Slip<Vector3<f64>>>; 2],
        swirl: [impl Iterator<Item = Slip<Vector3<f64>>>; 2],
        driven: &Driven,
    ) -> Self {
        let mut pair = velocity_by(mobility, slip, Vector3::zeros(), &driven.external);
        let mut about = add_swirl_by(&mut pair, mobility, swirl);
        for (by, torque) in mobility.by.iter().zip(driven.about) {
            let [one, two] = by.pair.twist.spins(torque, torque);
            about = [about[0] + one, about[1] + two];
        }
        Self { pair, about }
    }

    /// The sum with `weight` times another one.
    pub fn and(self, weight: f64, other: &Self) -> Self {
        let (a, b) = (self.pair, other.pair);
        Self {
            pair: PairVelocity {
                opening: a.opening + weight * b.opening,
                mean_axial: a.mean_axial + weight * b.mean_axial,
                mean_transverse: a.mean_transverse + b.mean_transverse * weight,
                turning: a.turning + b.turning * weight,
                spin: [0, 1].map(|k| a.spin[k] + b.spin[k] * weight),
            },
            about: [0, 1].map(|k| self.about[k] + weight * other.about[k]),
        }
    }

    /// The derivative of the change of a state, with the change of the velocity.
    pub fn rates_of_change(&self, of: &State, change: (&State, &Self), into: &mut [f64]) {
        let (moved, by) = change;
        let (v, dv) = (&self.pair, &by.pair);
        let (d, dd) = (&of.line, &moved.line);
        // (d x w) x p = w (d.p) - d (w.p).
        let turned = [0, 1].map(|k| {
            let (p, dp) = (&of.orientations[k], &moved.orientations[k]);
            let (w, dw) = (&v.spin[k], &dv.spin[k]);
            let mut turned = dw * d.dot(p) + w * (dd.dot(p) + d.dot(dp))
                - d * (dw.dot(p) + w.dot(dp))
                - dd * w.dot(p);
            if self.about[k] != 0.0 || by.about[k] != 0.0 {
                turned += d.cross(p) * by.about[k] + (dd.cross(p) + d.cross(dp)) * self.about[k];
            }
            turned
        });
        let midpoint = dd * v.mean_axial + d * dv.mean_axial + dv.mean_transverse;
        store(into, [midpoint, dv.turning], dv.opening, turned);
    }
}

fn store(into: &mut [f64], first: [Vector3<f64>; 2], ln_gap: f64, last: [Vector3<f64>; 2]) {
    let mut put = |at: usize, v: Vector3<f64>| into[at..at + 3].copy_from_slice(v.as_slice());
    put(0, first[0]);
    put(3, first[1]);
    put(7, last[0]);
    put(10, last[1]);
    into[6] = ln_gap;
}
