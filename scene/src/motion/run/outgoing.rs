//! Which way a parted pair points at last: its deflection is a limit.
//!
//! The far field goes on turning squirmers long after they have parted, by an amount that falls only as `1/r^2`. The
//! motion is integrated on to twice the distance again and again; at each the rest of the turn is known in closed form but for
//! higher orders (`far_turn`). How much the result still changes from one distance to the next tells how far it is
//! from its limit, or from what the error of a table lets be known of it.

use super::Runner;
use crate::frame::Configuration;
use crate::motion::far_turn::turned_to_infinity;
use crate::ode::{Direction, first_crossing};
use crate::{Gap, SceneError};

/// Change of an angle to come, in radians, at which it counts as known: a tenth of a millionth of a degree.
const KNOWN: f64 = 2e-9;

/// Doublings of the distance after which a pair that parts ever more slowly is given up: some 1e7 radii.
pub(in crate::motion) const MOST_DOUBLINGS: usize = 20;

/// What is left out falls at least as the square of the distance: twice as far away it is a quarter. By exact loads it falls as
/// the cube; the stresslet of a squirmer on a mesh is a little off.
const ORDER: f64 = 4.0;

/// Where angles are read, and how far they are from their limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outgoing {
    pub configuration: Configuration,
    /// Estimate of the turn still to come, in radians.
    pub truncation_rad: f64,
}

impl Outgoing {
    /// The end of a run that has nothing more to come.
    pub fn at_end(configuration: Configuration) -> Self {
        Self {
            configuration,
            truncation_rad: 0.0,
        }
    }
}

impl<const N: usize> Runner<'_, '_, N> {
    /// Where the angles of a pair are read that has parted just now under a model without a cut.
    pub(super) fn fly_out(&mut self) -> Result<Outgoing, SceneError> {
        let read_at = self.options.angles_at * self.larger_radius();
        if read_at <= self.now.distance() {
            return Ok(self.still_to_come(self.now));
        }
        let (_, mut stepper) = self.stepper(f64::MAX)?;
        let mut limit = Limit::from(self.estimate(self.now));
        let mut next = self.next_after(self.now.distance(), read_at)?;
        let mut previous = self.now;
        let outgoing = 'far: loop {
            let step = self.motion.step(&mut stepper, f64::MAX);
            let step = step.map_err(|error| self.failure(error))?;
            self.motion.take_failure();
            while step.y1[self.ln_gap] >= next.gap.ln() {
                let dense = step.dense(self.motion);
                let dense = dense.map_err(|error| self.failure(error))?;
                let beyond = |_, y: &[f64; N]| y[self.ln_gap] - next.gap.ln();
                let t = first_crossing(&dense, beyond, Direction::Rising, 0.0);
                let y = dense.at(t.unwrap_or(step.t0));
                let at = self.motion.chart().decode(&y, &previous);
                if next.is_read {
                    break 'far self.still_to_come(at);
                }
                let known = limit.take(self.estimate(at));
                if let Some(outgoing) = known.filter(|_| read_at.is_infinite()) {
                    break 'far outgoing;
                }
                next = self.next_after(next.distance, read_at)?;
            }
            // A pair that comes back has not parted: its angles have no limit here.
            if step.dy1[self.ln_gap] < 0.0 && step.y1[self.ln_gap] <= self.now.gap.ln() {
                break Outgoing {
                    configuration: limit.reached,
                    truncation_rad: f64::INFINITY,
                };
            }
            previous = self.motion.chart().decode(&step.y1, &previous);
        };
        self.count(&stepper);
        Ok(outgoing)
    }

    /// At twice the distance of the centres, or where angles are read if that is nearer.
    fn next_after(&self, distance: f64, read_at: f64) -> Result<Next, SceneError> {
        let distance = 2.0 * distance;
        Ok(Next {
            distance,
            gap: self.gap_at(distance.min(read_at))?,
            is_read: read_at <= distance,
        })
    }

    /// The pair at infinity, as seen from a configuration far out.
    fn estimate(&self, at: Configuration) -> Configuration {
        let turned = turned_to_infinity(self.motion.squirmers(), &at);
        turned.map_or(at, |turned| self.motion.chart().restored(turned))
    }

    /// A configuration that is read as it is, with what is still to come.
    fn still_to_come(&self, configuration: Configuration) -> Outgoing {
        let turned = turned_to_infinity(self.motion.squirmers(), &configuration);
        Outgoing {
            configuration,
            truncation_rad: turned.map_or(f64::INFINITY, |turned| apart(&configuration, &turned)),
        }
    }
}

/// The gap at which the pair is looked at next.
struct Next {
    /// Distance of the centres to be doubled after it.
    distance: f64,
    gap: Gap,
    /// Whether its angles are read there.
    is_read: bool,
}

/// The estimates of the limit, each from twice as far out as the one before.
struct Limit {
    reached: Configuration,
    last_change: f64,
    doublings: usize,
}

impl Limit {
    fn from(estimate: Configuration) -> Self {
        Self {
            reached: estimate,
            last_change: f64::INFINITY,
            doublings: 0,
        }
    }

    /// Takes in the next estimate; the limit, once it is known as well as it can be.
    fn take(&mut self, next: Configuration) -> Option<Outgoing> {
        let change = apart(&self.reached, &next);
        let before = std::mem::replace(&mut self.reached, next);
        let change_before = std::mem::replace(&mut self.last_change, change);
        // A table's interpolation error need not fall with the distance, so that it adds up on the way: once the
        // changes grow, the estimate before is the best there is.
        if change >= change_before {
            return Some(Outgoing {
                configuration: before,
                truncation_rad: change_before,
            });
        }
        self.doublings += 1;
        (change <= KNOWN || self.doublings == MOST_DOUBLINGS).then_some(Outgoing {
            configuration: next,
            truncation_rad: change / (ORDER - 1.0),
        })
    }
}

/// Larger angle between the orientations of two configurations, if it is small, in radians.
fn apart(a: &Configuration, b: &Configuration) -> f64 {
    let between = |k: usize| (a.orientations[k] - b.orientations[k]).norm();
    between(0).max(between(1))
}
