//! The equation of motion of a pair in three dimensions with its linearisation, for some directions at once.
//!
//! A velocity is a sum of causes times coefficients (`mobility.rs`), so that its derivative is the same sum twice: with the derivatives of the causes, and
//! with those of the coefficients by `ln eps`. Slip is `B_n P_n(c)` along and `B_n W_n(c) v` across the line of centres, with `c` the cosine of the
//! heading and `v` its transverse part.

use nalgebra::Vector3;

use super::perturbation::{CHART, NUMBERS, Perturbation};
use super::response::{OfEach, Response, parts};
use super::velocity::{Driven, State, Velocity};
use crate::mobility::{External, Heading, MobilityOfEach, MobilitySet, PairVelocity};
use crate::motion::coordinates::spin_about;
use crate::motion::equations::Dynamics as _;
use crate::ode::System;
use crate::{Gap, Gravity, Hydrodynamics, MAX_MODES, Repulsion, SceneError, Squirmer};

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
        let at = State::read(y).normalized();
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
        let state = std::array::from_fn(|i| y[i]);
        let mut rates = CHART.derivative(&state, &velocity.pair);
        spin_about(&at.line, &state, &mut rates, velocity.about);
        dy[..NUMBERS].copy_from_slice(&rates);
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
