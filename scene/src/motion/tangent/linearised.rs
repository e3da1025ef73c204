//! The equation of motion of a pair in three dimensions with its linearisation, for some directions at once.
//!
//! A velocity is a sum of causes times coefficients (`mobility.rs`), so that its derivative is the same sum twice: with the derivatives of the causes, and
//! with those of the coefficients by `ln eps`. Slip is `B_n P_n(c)` along and `B_n W_n(c) v` across the line of centres, with `c` the cosine of the
//! heading and `v` its transverse part.

use nalgebra::Vector3;

use super::perturbation::{NUMBERS, Perturbation};
use crate::legendre::legendre_with_slope;
use crate::mobility::{
    Across, External, Heading, Mobility, MobilityOfEach, MobilitySet, PairVelocity, Slip,
    add_swirl_by, velocity_by,
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
    /// Whether each of them changes a slip mode.
    pub changes_slip: Vec<bool>,
    /// Models of radii in other ratios with their weights: the weighted sum of their coefficients and the model's own is the derivative by the ratio.
    pub by_ratio: &'a [(f64, &'a dyn Hydrodynamics)],
    /// The coefficients at the gap of the last right-hand side, their derivatives by `ln eps`, and those by the ratio.
    pub read: Box<[MobilityOfEach; 3]>,
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

impl Driven {
    const NOTHING: Self = Self {
        external: External {
            repulsion: 0.0,
            torque: None,
        },
        about: [0.0; 2],
    };
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

/// One squirmer at an instant.
struct OfEach {
    heading: Heading<Vector3<f64>>,
    /// The transverse heading turned by a quarter about the line of centres.
    turned: Vector3<f64>,
    /// The orders with their slopes `dW_n/dc`.
    orders: [(Legendre, f64); MAX_MODES],
}

impl OfEach {
    /// With so many orders.
    fn new(heading: Heading<Vector3<f64>>, line: &Vector3<f64>, count: usize) -> Self {
        let mut orders = [(
            Legendre {
                p: 0.0,
                derivative: 0.0,
                w: 0.0,
            },
            0.0,
        ); MAX_MODES];
        for (to, order) in (orders.iter_mut().take(count)).zip(legendre_with_slope(heading.cosine))
        {
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
}

/// The parts of a velocity that are across the line of centres: mean velocity, turning, and the spin of each squirmer.
type AcrossParts<T> = [T; 4];

fn parts(of: &Across) -> AcrossParts<f64> {
    [
        of.mean_transverse,
        of.turning,
        of.mean_spin + of.counter_spin,
        of.mean_spin - of.counter_spin,
    ]
}

/// How the velocity of a pair answers to a change of one squirmer's heading: what all directions share.
#[derive(Clone, Copy)]
struct Response {
    /// Opening, mean velocity along the line and both spins about it, by the cosine.
    along: [f64; 4],
    /// Parts across the line, by the cosine.
    by_cosine: AcrossParts<Vector3<f64>>,
    /// The same by the transverse heading, and by that turned by a quarter.
    by_transverse: AcrossParts<f64>,
    by_turned: AcrossParts<f64>,
}

impl Response {
    /// Of a squirmer with these strengths of squirming and swirl modes.
    fn new(of: &OfEach, by: &Mobility, squirming: &[f64], swirling: &[f64]) -> Self {
        let (mut along, mut by_transverse, mut by_turned) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        let mut slopes = [[0.0; 4]; 2];
        let add = |to: &mut AcrossParts<f64>, across: &Across, weight: f64| {
            for (to, part) in to.iter_mut().zip(parts(across)) {
                *to += weight * part;
            }
        };
        for ((b, mode), (order, w_slope)) in squirming.iter().zip(&by.modes).zip(&of.orders) {
            along[0] += b * order.derivative * mode.opening;
            along[1] += b * order.derivative * mode.mean_axial;
            add(&mut by_transverse, &mode.across, b * order.w);
            add(&mut slopes[0], &mode.across, b * w_slope);
        }
        for ((c, mode), (order, w_slope)) in swirling.iter().zip(&by.swirl).zip(&of.orders) {
            let about = c * order.derivative;
            let [one, two] = mode.twist.spins(about, about);
            along[2] += one;
            along[3] += two;
            add(&mut by_turned, &mode.across, c * order.w);
            add(&mut slopes[1], &mode.across, c * w_slope);
        }
        Self {
            along,
            by_cosine: std::array::from_fn(|i| {
                of.heading.transverse * slopes[0][i] + of.turned * slopes[1][i]
            }),
            by_transverse,
            by_turned,
        }
    }
}

impl Linearised<'_> {
    /// The derivative by time of the state and of its change in each direction; further numbers stay as they are.
    ///
    /// # Errors
    /// The model's.
    pub fn rates(&mut self, y: &[f64], dy: &mut [f64]) -> Result<(), SceneError> {
        let gap = Gap::from_ln(y[6]);
        let [mobility, slope, by_ratio] = &mut *self.read;
        (self.model).interacting_mobility_with_slope(gap, self.set, [mobility, slope])?;
        let changes_ratio =
            !self.by_ratio.is_empty() && self.directions.iter().any(|of| of.ratio != 0.0);
        if changes_ratio {
            *by_ratio = MobilityOfEach::default();
            let mut beside = MobilityOfEach::default();
            for (weight, model) in self.by_ratio {
                model.interacting_mobility_of_any(gap, self.set, &mut beside)?;
                by_ratio.add(*weight, &beside, self.set);
            }
        }
        self.rates_by(gap, changes_ratio, y, dy);
        Ok(())
    }

    /// The same by the coefficients that were read.
    fn rates_by(&self, gap: Gap, changes_ratio: bool, y: &[f64], dy: &mut [f64]) {
        let raw = State::read(y);
        let at = raw.normalized();
        let [mobility, slope, by_ratio] = &*self.read;
        let [one, two] = Heading::of_both(&at.line, at.orientations);
        let count = self.set.loads.modes.max(self.set.loads.swirl);
        let of_each = [one, two].map(|heading| OfEach::new(heading, &at.line, count));
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
        let velocity = by(mobility);
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
        let by_ln_gap = by(slope);
        let by_ratio = changes_ratio.then(|| by(by_ratio));
        let repulsion = (self.repulsion).map_or([0.0; 3], |repulsion| repulsion.slopes(gap));
        let responses = [0, 1].map(|k| {
            let (squirming, swirling) = (self.read(&strengths[k]), self.swirl(&swirling[k]));
            Response::new(&of_each[k], &mobility.by[k], squirming, swirling)
        });
        let blocks = y[NUMBERS..].chunks_exact(NUMBERS);
        let rates = dy[NUMBERS..].chunks_exact_mut(NUMBERS);
        let directions = self.directions.iter().zip(&self.changes_slip);
        for (((direction, changes_slip), block), into) in directions.zip(blocks).zip(rates) {
            let change = State::read(block).across(&at);
            let mut changed =
                self.answer(mobility, repulsion, (&at, &change), (&responses, direction));
            if *changes_slip {
                let slip = [0, 1].map(|k| {
                    let of: &OfEach = &of_each[k];
                    of.slip(self.read(&direction.modes[k]), of.heading.transverse)
                });
                let swirl = [0, 1].map(|k| {
                    let of: &OfEach = &of_each[k];
                    of.slip(self.swirl(&direction.swirl[k]), of.turned)
                });
                let by_slip = Velocity::by(mobility, slip, swirl, &Driven::NOTHING);
                changed = changed.and(1.0, &by_slip);
            }
            changed = changed.and(change.ln_gap, &by_ln_gap);
            if let Some(by_ratio) = &by_ratio {
                changed = changed.and(direction.ratio, by_ratio);
            }
            velocity.rates_of_change(&at, (&change, &changed), into);
        }
    }

    /// How the velocity answers to a change of the headings, of repulsion and of gravity.
    #[inline]
    fn answer(
        &self,
        mobility: &MobilityOfEach,
        repulsion: [f64; 3],
        (at, change): (&State, &State),
        (responses, direction): (&[Response; 2], &Perturbation),
    ) -> Velocity {
        let mut along = [0.0; 4];
        let mut across = [Vector3::zeros(); 4];
        for (k, response) in responses.iter().enumerate() {
            let heading = heading_change(k, at, change);
            for (sum, by) in along.iter_mut().zip(response.along) {
                *sum += by * heading.cosine;
            }
            for (i, sum) in across.iter_mut().enumerate() {
                *sum += response.by_cosine[i] * heading.cosine
                    + heading.transverse * response.by_transverse[i];
            }
            if self.set.loads.swirl > 0 {
                let turned = change.line.cross(&(at.orientations[k]))
                    + at.line.cross(&change.orientations[k]);
                for (sum, by) in across.iter_mut().zip(response.by_turned) {
                    *sum += turned * by;
                }
            }
        }
        let driven = self.driven_change(repulsion, (at, change), direction);
        let force = driven.external.repulsion;
        along[0] += mobility.by[0].pair.repulsion * force;
        along[1] += mobility.mean_axial_by_repulsion * force;
        for (k, torque) in driven.external.torque.into_iter().flatten().enumerate() {
            let by = &mobility.by[k].pair;
            for (sum, part) in across.iter_mut().zip(parts(&by.torque)) {
                *sum += torque * part;
            }
            let about = driven.about[k];
            let [one, two] = by.twist.spins(about, about);
            along[2] += one;
            along[3] += two;
        }
        let [opening, mean_axial, one, two] = along;
        let [mean_transverse, turning, first, second] = across;
        Velocity {
            pair: PairVelocity {
                opening,
                mean_axial,
                mean_transverse,
                turning,
                spin: [first, second],
            },
            about: [one, two],
        }
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

    /// How they change; repulsion with `ln eps`, its strength and its decay.
    fn driven_change(
        &self,
        [by_ln, by_strength, by_decay]: [f64; 3],
        (at, change): (&State, &State),
        direction: &Perturbation,
    ) -> Driven {
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
