//! Which way a parted pair points at last: its deflection is a limit.
//!
//! The far field goes on turning squirmers long after they have parted, by an amount that falls only as `1/r^2`. The
//! motion is integrated on to twice the distance again and again; at each the rest of the turn is known in closed form but for
//! higher orders (`far_turn`). How much the result still changes from one distance to the next tells how far it is
//! from its limit, or from what the model's own error lets be known of it.

use super::super::far_turn::turned_to_infinity;
use super::Runner;
use crate::motion::configuration::Configuration;
use crate::motion::coordinates::Coordinates;
use crate::motion::equations::Effect;
use crate::ode::{Direction, Stepper, first_crossing};
use crate::{Gap, Gravity, Hydrodynamics, Repulsion, SceneError};

/// Change of an angle to come, in radians, at which it counts as known: a tenth of a millionth of a degree.
const KNOWN: f64 = 2e-9;

/// Doublings of the distance after which a pair that parts ever more slowly is given up: some 1e7 radii.
const MOST_DOUBLINGS: usize = 20;

/// What is left out falls at least as the cube of the distance: twice as far away it is an eighth.
const ORDER: f64 = 8.0;

/// Where angles are read, and how far they are from their limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outgoing {
    pub configuration: Configuration,
    /// Estimate of the turn still to come, in radians.
    pub truncation: f64,
}

impl Outgoing {
    /// The end of a run that has nothing more to come.
    pub fn at_end(configuration: Configuration) -> Self {
        Self {
            configuration,
            truncation: 0.0,
        }
    }
}

impl<H, C, R, G, const N: usize> Runner<'_, '_, H, C, R, G, N>
where
    H: Hydrodynamics + ?Sized,
    C: Coordinates<N>,
    R: Effect<Repulsion>,
    G: Effect<Gravity>,
{
    /// Where the angles of a pair are read that has parted just now under a model without a cut.
    pub(super) fn fly_out(&mut self) -> Result<Outgoing, SceneError> {
        let read_at = self.options.angles_at;
        let mut reached = self.estimate(self.now);
        if read_at <= self.now.gap.distance() {
            return Ok(self.still_to_come(self.now));
        }
        let y = self.motion.coordinates.encode(&self.now);
        let (options, t_end) = (self.options, f64::MAX);
        let stepper = Stepper::new(&mut self.motion, self.t, y, options.tolerance, t_end);
        let taken = (self.counters.steps + self.counters.rejected) as usize;
        let mut stepper = stepper
            .map_err(|error| self.failure(error))?
            .with_max_steps(options.max_steps.saturating_sub(taken));
        let mut distance = 2.0 * self.now.gap.distance();
        let mut previous = self.now;
        let mut doublings = 0;
        let mut last_change = f64::INFINITY;
        let outgoing = 'far: loop {
            let step = stepper.step(&mut self.motion, t_end);
            let step = step.map_err(|error| self.failure(error))?;
            self.motion.failure = None;
            while step.y1[C::LN_GAP] >= gap_at(distance.min(read_at))?.ln() {
                let gap = gap_at(distance.min(read_at))?;
                let dense = step.dense(&mut self.motion);
                let dense = dense.map_err(|error| self.failure(error))?;
                let rising = Direction::Rising;
                let t = first_crossing(&dense, |_, y| y[C::LN_GAP] - gap.ln(), rising, 0.0);
                let at =
                    (self.motion.coordinates).decode(&dense.at(t.unwrap_or(step.t0)), &previous);
                if read_at <= distance {
                    break 'far self.still_to_come(at);
                }
                let next = self.estimate(at);
                let changed = apart(&reached, &next);
                // A model's own error, such as a mesh that turns lone spheres a little, adds up on the way: once the changes
                // grow, the estimate before is the best there is.
                if changed >= last_change && !read_at.is_finite() {
                    break 'far Outgoing {
                        configuration: reached,
                        truncation: last_change,
                    };
                }
                (reached, last_change) = (next, changed);
                doublings += 1;
                let known = changed <= KNOWN || doublings == MOST_DOUBLINGS;
                if known && !read_at.is_finite() {
                    break 'far Outgoing {
                        configuration: reached,
                        truncation: changed / (ORDER - 1.0),
                    };
                }
                distance *= 2.0;
            }
            // A pair that comes back has not parted: its angles have no limit here.
            if step.dy1[C::LN_GAP] < 0.0 && step.y1[C::LN_GAP] <= self.now.gap.ln() {
                break Outgoing {
                    configuration: reached,
                    truncation: f64::INFINITY,
                };
            }
            previous = self.motion.coordinates.decode(&step.y1, &previous);
        };
        self.counters.steps += stepper.accepted() as u64;
        self.counters.rejected += stepper.rejected() as u64;
        Ok(outgoing)
    }

    /// The pair at infinity, as seen from a configuration far out.
    fn estimate(&self, at: Configuration) -> Configuration {
        let turned = turned_to_infinity(&self.motion.squirmers, &at);
        turned.map_or(at, |turned| self.motion.coordinates.restored(turned))
    }

    /// A configuration that is read as it is, with what is still to come.
    fn still_to_come(&self, configuration: Configuration) -> Outgoing {
        let turned = turned_to_infinity(&self.motion.squirmers, &configuration);
        Outgoing {
            configuration,
            truncation: turned.map_or(f64::INFINITY, |turned| apart(&configuration, &turned)),
        }
    }
}

/// The gap at a distance of the centres.
fn gap_at(distance: f64) -> Result<Gap, SceneError> {
    Gap::new(distance - 2.0)
}

/// Larger angle between the orientations of two configurations, if it is small, in radians.
fn apart(a: &Configuration, b: &Configuration) -> f64 {
    let between = |k: usize| (a.orientations[k] - b.orientations[k]).norm();
    between(0).max(between(1))
}
