//! The equation of motion of a pair in three dimensions with its linearisation, for some directions at once.
//!
//! A velocity is a sum of causes times coefficients (`mobility.rs`), so that its derivative is the same sum twice: with the derivatives of the causes, and
//! with those of the coefficients by `ln eps`. Slip is `B_n P_n(c)` along and `B_n W_n(c) v` across the line of centres, with `c` the cosine of the
//! heading and `v` its transverse part.

use nalgebra::Vector3;

use super::perturbation::{NUMBERS, Perturbation};
use crate::legendre::legendre_with_slope;
use crate::mobility::{
    External, Heading, MobilityOfEach, MobilitySet, PairVelocity, Slip, add_swirl_by, velocity_by,
};
use crate::ode::System;
use crate::{Gap, Gravity, Hydrodynamics, Legendre, MAX_MODES, Repulsion, SceneError, Squirmer};

/// A pair of squirmers and the directions in which its motion is linearised.
pub(super) struct Linearised<'a> {
    pub model: &'a dyn Hydrodynamics,
    pub set: MobilitySet,
    pub squirmers: [Squirmer; 2],
    pub repulsion: Option<Repulsion>,
    pub gravity: Option<Gravity>,
    pub directions: &'a [Perturbation],
    /// Why the last right-hand side could not be computed, if it could not.
    pub failure: Option<SceneError>,
}

impl<const N: usize> System<N> for Linearised<'_> {
    fn rhs(&mut self, _t: f64, y: &[f64; N]) -> [f64; N] {
        let mut dy = [0.0; N];
        match self.rates(y, &mut dy) {
            Ok(()) => dy,
            Err(error) => {
                self.failure = Some(error);
                [f64::NAN; N]
            }
        }
    }
}

/// Line of centres, `ln eps` and orientations, or the changes of them.
#[derive(Clone, Copy)]
struct State {
    line: Vector3<f64>,
    ln_gap: f64,
    orientations: [Vector3<f64>; 2],
}

impl State {
    fn read(y: &[f64]) -> Self {
        let vector = |at: usize| Vector3::new(y[at], y[at + 1], y[at + 2]);
        Self {
            line: vector(3),
            ln_gap: y[6],
            orientations: [vector(7), vector(10)],
        }
    }

    /// The same with vectors of unit length.
    fn normalized(self) -> Self {
        Self {
            line: self.line.normalize(),
            orientations: self.orientations.map(|p| p.normalize()),
            ..self
        }
    }

    /// A change without what would change the length of a unit vector of `at`. None of it is meant, and what rounding and steps leave of it would drive the
    /// rest, and itself: on a long orbit it grew exponentially.
    fn across(self, at: &Self) -> Self {
        let across = |change: Vector3<f64>, unit: &Vector3<f64>| change - unit * unit.dot(&change);
        Self {
            line: across(self.line, &at.line),
            orientations: [0, 1].map(|k| across(self.orientations[k], &at.orientations[k])),
            ..self
        }
    }
}

/// Forces and torques of other than hydrodynamic origin, or the changes of them.
struct Driven {
    /// Those along and across the line of centres.
    external: External<Vector3<f64>>,
    /// Torques about it.
    about: [f64; 2],
}

/// A velocity with the spins about the line of centres.
#[derive(Clone, Copy)]
struct Velocity {
    pair: PairVelocity<Vector3<f64>>,
    about: [f64; 2],
}

impl Velocity {
    /// By the slip and swirl of each squirmer and by what else drives the pair.
    fn by(
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
    fn and(self, weight: f64, other: &Self) -> Self {
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

    /// The derivative of a state that moves so.
    fn rates(&self, of: &State, into: &mut [f64]) {
        let (v, d) = (&self.pair, &of.line);
        let turned = [0, 1].map(|k| {
            let p = &of.orientations[k];
            d.cross(&v.spin[k]).cross(p) + d.cross(p) * self.about[k]
        });
        store(
            into,
            [d * v.mean_axial + v.mean_transverse, v.turning],
            v.opening,
            turned,
        );
    }

    /// The derivative of the change of a state, with the change of the velocity.
    fn rates_of_change(&self, of: &State, change: (&State, &Self), into: &mut [f64]) {
        let (moved, by) = change;
        let (v, dv) = (&self.pair, &by.pair);
        let (d, dd) = (&of.line, &moved.line);
        let turned = [0, 1].map(|k| {
            let (p, dp) = (&of.orientations[k], &moved.orientations[k]);
            (dd.cross(&v.spin[k]) + d.cross(&dv.spin[k])).cross(p)
                + d.cross(&v.spin[k]).cross(dp)
                + d.cross(p) * by.about[k]
                + (dd.cross(p) + d.cross(dp)) * self.about[k]
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

/// One squirmer at an instant.
struct OfEach {
    heading: Heading<Vector3<f64>>,
    /// The transverse heading turned by a quarter about the line of centres.
    turned: Vector3<f64>,
    /// The orders with their slopes `dW_n/dc`.
    orders: [(Legendre, f64); MAX_MODES],
}

impl OfEach {
    fn new(heading: Heading<Vector3<f64>>, line: &Vector3<f64>) -> Self {
        let mut orders = [(
            Legendre {
                p: 0.0,
                derivative: 0.0,
                w: 0.0,
            },
            0.0,
        ); MAX_MODES];
        for (to, order) in orders.iter_mut().zip(legendre_with_slope(heading.cosine)) {
            *to = order;
        }
        Self {
            turned: heading.turned(line),
            heading,
            orders,
        }
    }

    /// What modes of these strengths do, with the vector `across` of their slip across the line of centres.
    fn slip(
        &self,
        strengths: &[f64],
        across: Vector3<f64>,
    ) -> impl Iterator<Item = Slip<Vector3<f64>>> {
        (strengths.iter().zip(&self.orders)).map(move |(b, (order, _))| Slip {
            along: b * order.p,
            across: across * (b * order.w),
        })
    }

    /// How that changes, with the strengths, the cosine and the vector.
    fn slip_change(
        &self,
        strengths: (&[f64], &[f64]),
        across: [Vector3<f64>; 2],
        cosine: f64,
    ) -> impl Iterator<Item = Slip<Vector3<f64>>> {
        let [across, change] = across;
        let of_modes = (strengths.0.iter().zip(strengths.1)).zip(&self.orders);
        of_modes.map(move |((b, db), (order, w_slope))| Slip {
            along: db * order.p + b * order.derivative * cosine,
            across: across * (db * order.w + b * w_slope * cosine) + change * (b * order.w),
        })
    }
}

impl Linearised<'_> {
    /// The derivative by time of the state and of its change in each direction; further numbers stay as they are.
    ///
    /// # Errors
    /// The model's.
    pub fn rates(&self, y: &[f64], dy: &mut [f64]) -> Result<(), SceneError> {
        let (raw, gap) = (State::read(y), Gap::from_ln(y[6]));
        let at = raw.normalized();
        let [mobility, slope] = self.model.interacting_mobility_with_slope(gap, self.set)?;
        let [one, two] = Heading::of_both(&at.line, at.orientations);
        let of_each = [OfEach::new(one, &at.line), OfEach::new(two, &at.line)];
        let strengths = [0, 1].map(|k| std::array::from_fn(|n| self.squirmers[k].mode(n)));
        let swirling = [0, 1].map(|k| padded(self.squirmers[k].swirl()));
        let driven = self.driven(gap, &at);
        let by = |mobility: &MobilityOfEach| {
            let slip = [0, 1].map(|k| {
                let of: &OfEach = &of_each[k];
                of.slip(self.read(&strengths[k]), of.heading.transverse)
            });
            let swirl =
                [0, 1].map(|k| of_each[k].slip(self.swirl(&swirling[k]), of_each[k].turned));
            Velocity::by(mobility, slip, swirl, &driven)
        };
        let velocity = by(&mobility);
        // The lengths of the vectors are kept, whatever they are.
        velocity.rates(&at, dy);
        for (from, length) in [(3, raw.line.norm())]
            .into_iter()
            .chain([7, 10].into_iter().zip(raw.orientations.map(|p| p.norm())))
        {
            for number in &mut dy[from..from + 3] {
                *number *= length;
            }
        }
        if self.directions.is_empty() {
            return Ok(());
        }
        let by_ln_gap = by(&slope);
        let blocks = y[NUMBERS..].chunks_exact(NUMBERS);
        let rates = dy[NUMBERS..].chunks_exact_mut(NUMBERS);
        for ((direction, block), into) in self.directions.iter().zip(blocks).zip(rates) {
            let change = State::read(block).across(&at);
            let headings = [0, 1].map(|k| heading_change(k, &at, &change));
            let slip = [0, 1].map(|k| {
                let of: &OfEach = &of_each[k];
                let across = [of.heading.transverse, headings[k].transverse];
                let strengths = (self.read(&strengths[k]), self.read(&direction.modes[k]));
                of.slip_change(strengths, across, headings[k].cosine)
            });
            let swirl = [0, 1].map(|k| {
                let of: &OfEach = &of_each[k];
                let turned = change.line.cross(&of.heading.transverse)
                    + at.line.cross(&headings[k].transverse);
                let strengths = (self.swirl(&swirling[k]), self.swirl(&direction.swirl[k]));
                of.slip_change(strengths, [of.turned, turned], headings[k].cosine)
            });
            let driven = self.driven_change(gap, (&at, &change), direction);
            let changed = Velocity::by(&mobility, slip, swirl, &driven);
            let changed = changed.and(change.ln_gap, &by_ln_gap);
            velocity.rates_of_change(&at, (&change, &changed), into);
        }
        Ok(())
    }

    /// The strengths of the squirming modes that are read.
    fn read<'s>(&self, strengths: &'s [f64; MAX_MODES]) -> &'s [f64] {
        &strengths[..self.set.loads.modes]
    }

    /// The same of swirl.
    fn swirl<'s>(&self, strengths: &'s [f64; MAX_MODES]) -> &'s [f64] {
        &strengths[..self.set.loads.swirl]
    }

    /// Repulsion and torques of gravity.
    fn driven(&self, gap: Gap, at: &State) -> Driven {
        let torques = self
            .gravity
            .map(|gravity| [0, 1].map(|k| gravity.torque(&self.squirmers[k], &at.orientations[k])));
        Driven {
            external: External {
                repulsion: self.repulsion.map_or(0.0, |repulsion| repulsion.force(gap)),
                torque: torques.map(|torques| torques.map(|torque| torque.cross(&at.line))),
            },
            about: torques.map_or([0.0; 2], |torques| {
                torques.map(|torque| torque.dot(&at.line))
            }),
        }
    }

    /// How they change.
    fn driven_change(
        &self,
        gap: Gap,
        (at, change): (&State, &State),
        direction: &Perturbation,
    ) -> Driven {
        let [by_ln, by_strength, by_decay] =
            (self.repulsion).map_or([0.0; 3], |repulsion| repulsion.slopes(gap));
        // The torque is -T p x g.
        let torques = self.gravity.map(|gravity| {
            let g = gravity.direction();
            [0, 1].map(|k| {
                let (p, dp) = (&at.orientations[k], &change.orientations[k]);
                let strength = -self.squirmers[k].gravity_torque();
                let torque = p.cross(&g);
                let changed = torque * -direction.gravity_torques[k]
                    + (dp.cross(&g) + p.cross(&direction.gravity)) * strength;
                (torque * strength, changed)
            })
        });
        let (d, dd) = (&at.line, &change.line);
        Driven {
            external: External {
                repulsion: by_ln * change.ln_gap
                    + by_strength * direction.repulsion[0]
                    + by_decay * direction.repulsion[1],
                torque: torques.map(|of| of.map(|(t, dt)| dt.cross(d) + t.cross(dd))),
            },
            about: torques.map_or([0.0; 2], |of| of.map(|(t, dt)| dt.dot(d) + t.dot(dd))),
        }
    }
}

/// The strengths of modes with zeros for those that are not there.
fn padded(strengths: &[f64]) -> [f64; MAX_MODES] {
    std::array::from_fn(|n| strengths.get(n).copied().unwrap_or(0.0))
}

/// How the heading of a squirmer changes.
fn heading_change(k: usize, at: &State, change: &State) -> Heading<Vector3<f64>> {
    let (p, dp) = (&at.orientations[k], &change.orientations[k]);
    let (d, dd) = (&at.line, &change.line);
    let along = p.dot(d);
    let turned = dp.dot(d) + p.dot(dd);
    Heading {
        cosine: if k == 0 { turned } else { -turned },
        transverse: dp - dd * along - d * turned,
    }
}
