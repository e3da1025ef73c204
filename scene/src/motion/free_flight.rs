//! Flight of squirmers that do not interact, in closed form: when a pair meets, and how near it comes.

mod lone;

use nalgebra::Vector3;

use self::lone::Flight;
use crate::frame::{Configuration, unwind};
use crate::{Gap, Gravity, SceneError, Squirmer};

/// Free flight of a pair from a configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairFlight {
    start: Configuration,
    flights: [Flight; 2],
}

impl PairFlight {
    pub(crate) fn new(
        squirmers: &[Squirmer; 2],
        gravity: Option<Gravity>,
        start: Configuration,
    ) -> Self {
        let positions = start.positions();
        let flights = [0, 1]
            .map(|k| Flight::new(&squirmers[k], positions[k], start.orientations[k], gravity));
        Self { start, flights }
    }

    /// The configuration after the time `t`; angles wind on.
    pub(crate) fn at(&self, t: f64) -> Configuration {
        let [(x1, p1), (x2, p2)] = [self.flights[0].at(t), self.flights[1].at(t)];
        let separation = x2 - x1;
        let distance = separation.norm();
        let line = separation / distance;
        let turned = |k: usize, p: Vector3<f64>| {
            if self.flights[k].is_straight() {
                self.start.angles_rad[k]
            } else {
                unwind(p.y.atan2(p.x), self.start.angles_rad[k])
            }
        };
        let [a1, a2] = self.start.radii;
        Configuration {
            radii: self.start.radii,
            // Rounding may bring the distance of a touching pair to that of contact or below.
            gap: Gap::from_ln((distance - (a1 + a2)).max(f64::MIN_POSITIVE).ln()),
            midpoint: (x1 + x2) * 0.5,
            line,
            orientations: [p1, p2],
            line_angle_rad: unwind(line.y.atan2(line.x), self.start.line_angle_rad),
            angles_rad: [turned(0, p1), turned(1, p2)],
        }
    }

    /// Distance of the centres and its rate of change after the time `t`.
    pub(crate) fn distance(&self, t: f64) -> (f64, f64) {
        let [(x1, p1), (x2, p2)] = [self.flights[0].at(t), self.flights[1].at(t)];
        let separation = x2 - x1;
        let velocity = p2 * self.flights[1].speed - p1 * self.flights[0].speed;
        let distance = separation.norm();
        (distance, separation.dot(&velocity) / distance)
    }

    /// The distance of the centres after the time `t`, if rounding of where they are leaves it six digits.
    ///
    /// # Errors
    /// [`SceneError::LostDistance`] if it does not.
    pub(crate) fn told_distance(&self, t: f64) -> Result<f64, SceneError> {
        /// Share of the distance that is rounding, at most.
        const LOST: f64 = 1e-6;
        let [(x1, _), (x2, _)] = [self.flights[0].at(t), self.flights[1].at(t)];
        let distance = (x2 - x1).norm();
        let reach = x1.norm().max(x2.norm());
        if reach * f64::EPSILON > LOST * distance {
            return Err(SceneError::LostDistance { reach, distance });
        }
        Ok(distance)
    }

    /// Whether the two fly straight, so that once receding they recede for ever.
    pub(crate) fn is_straight(&self) -> bool {
        self.flights.iter().all(Flight::is_straight)
    }

    /// Whether straight paths only touch: closing in at this `rate`, the two would go deeper by no
    /// more than rounding, which must not decide whether they meet.
    fn grazes(&self, rate: f64) -> bool {
        /// Closing speed over relative speed whose square, a depth over a distance, is rounding.
        const GRAZING: f64 = 1e-6;
        let [a, b] = &self.flights;
        let speed = (b.orientation * b.speed - a.orientation * a.speed).norm();
        self.is_straight() && -rate < GRAZING * speed
    }

    /// Whether the two fly straight with equal velocities, to rounding: their distance stays what it is.
    pub(crate) fn keeps_distance(&self) -> bool {
        let [a, b] = &self.flights;
        let fastest = a.speed.abs().max(b.speed.abs());
        let relative = b.orientation * b.speed - a.orientation * a.speed;
        self.is_straight() && relative.norm() <= 8.0 * f64::EPSILON * fastest
    }

    /// First time within `duration` at which the distance falls to `contact`, if it does; a pair
    /// that starts there is in contact at time 0 if it closes in, by more than a graze.
    ///
    /// Conservative advancement: the distance's second derivative is at least minus the sum `A`
    /// of the accelerations' bounds from there on, so the parabola `D + D' t - A t^2/2` bounds the distance from below
    /// and its first root is never past the contact. On straight paths this is Newton's method on
    /// a convex function. A pair on curved paths that creeps along at the distance of contact, as
    /// two that swim upward side by side, is in contact when it closes in in earnest.
    ///
    /// # Errors
    /// [`SceneError::TooManyAdvances`] if `most` advances do not settle it: gravity that turns squirmers by far
    /// faster than they swim.
    pub(crate) fn contact(
        &self,
        contact: f64,
        duration: f64,
        most: usize,
    ) -> Result<Option<f64>, SceneError> {
        /// Closing speed, in `V_s`, below which a pair on curved paths creeps.
        const CREEPING: f64 = 1e-6;
        /// Longest advance of a creeping pair, which goes deeper by `CREEPING` times this at most.
        const LONGEST_CREEP: f64 = 1e-3;
        if self.keeps_distance() {
            return Ok(None);
        }
        let fastest = (self.flights.iter().map(|f| f.speed.abs())).fold(0.0, f64::max);
        let creeping = if self.is_straight() {
            0.0
        } else {
            CREEPING * fastest
        };
        let mut t = 0.0;
        for _ in 0..most {
            if t > duration {
                return Ok(None);
            }
            let (distance, rate) = self.distance(t);
            let left = (distance - contact).max(0.0);
            let accelerations = self.flights.map(|flight| flight.acceleration(t));
            let acceleration: f64 = accelerations.iter().map(|(_, bound)| bound).sum();
            let root = (rate * rate + 2.0 * acceleration * left).sqrt();
            let advance = if rate <= 0.0 && left > 0.0 {
                2.0 * left / (root - rate)
            } else if rate > 0.0 && acceleration > 0.0 {
                (rate + root) / acceleration
            } else if rate < 0.0 || acceleration > 0.0 {
                0.0
            } else {
                return Ok(None);
            };
            // What closes in a step that no longer changes the time is as good as closed.
            let least = 1e-13 * (1.0 + t);
            let arrived = left <= (4.0 * f64::EPSILON * contact).max(2.0 * fastest * least);
            if arrived && rate < -creeping {
                return Ok((!self.grazes(rate)).then_some(t));
            }
            // Righted as good as they will be, they go no deeper than creeping would take them.
            let [one, two] = &self.flights;
            let drift = (one.speed - two.speed).abs() * (duration - t);
            let closing = one.strays(t) + two.strays(t) + drift;
            if !advance.is_finite() || closing < left + creeping * LONGEST_CREEP {
                return Ok(None);
            }
            let creep = if arrived {
                let bend: f64 = accelerations.iter().map(|(now, _)| now).sum();
                (creeping / bend).min(LONGEST_CREEP)
            } else {
                0.0
            };
            t += advance.max(least).max(creep);
        }
        Err(SceneError::TooManyAdvances { advances: most, t })
    }

    /// Time within `duration` at which the two are nearest.
    pub(crate) fn closest_approach(&self, duration: f64) -> f64 {
        if self.is_straight() {
            let [a, b] = &self.flights;
            let separation = b.position - a.position;
            let velocity = b.orientation * b.speed - a.orientation * a.speed;
            let squared = velocity.norm_squared();
            if squared > 0.0 {
                return (-separation.dot(&velocity) / squared).clamp(0.0, duration);
            }
            return 0.0;
        }
        // Curved paths: the rate of change of distance, bisected in every interval of a grid.
        const INTERVALS: u32 = 400;
        let step = duration / f64::from(INTERVALS);
        let mut nearest = [0.0, duration]
            .into_iter()
            .min_by(|a, b| self.distance(*a).0.total_cmp(&self.distance(*b).0))
            .unwrap_or(0.0);
        for i in 0..INTERVALS {
            let (mut low, mut high) = (f64::from(i) * step, f64::from(i + 1) * step);
            if self.distance(low).1 >= 0.0 || self.distance(high).1 <= 0.0 {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if self.distance(middle).1 < 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            if self.distance(low).0 < self.distance(nearest).0 {
                nearest = low;
            }
        }
        nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// A pair along x at a distance of the centres, with headings of its own, bottom-heavy or not.
    fn pair(distance: f64, heavy: f64, headings: [Vector3<f64>; 2]) -> PairFlight {
        let squirmer = Squirmer::with_beta(1.0, 0.0)
            .and_then(|s| s.bottom_heavy(heavy))
            .unwrap();
        let gravity = (heavy > 0.0).then_some(Gravity::DOWN);
        let flight = |x: f64, p| Flight::new(&squirmer, Vector3::new(x, 0.0, 0.0), p, gravity);
        let start = Configuration {
            radii: [1.0; 2],
            gap: Gap::new(distance - 2.0).unwrap(),
            midpoint: Vector3::x() * (0.5 * distance),
            line: Vector3::x(),
            orientations: headings,
            line_angle_rad: 0.0,
            angles_rad: headings.map(|p| p.y.atan2(p.x)),
        };
        let flights = [flight(0.0, headings[0]), flight(distance, headings[1])];
        PairFlight { start, flights }
    }

    #[test]
    fn paths_that_only_touch_do_not_meet() {
        let squirmer = Squirmer::with_beta(1.0, 0.0).unwrap();
        let flight = |x: f64, y: f64, up: f64| {
            let p = Vector3::new(0.0, up, 0.0);
            Flight::new(&squirmer, Vector3::new(x, y, 0.0), p, None)
        };
        let meet = |dx: f64| {
            let flights = [flight(-0.5 * dx, 5.0, -1.0), flight(0.5 * dx, -5.0, 1.0)];
            let start = Configuration {
                radii: [1.0; 2],
                gap: Gap::from_ln(2.0),
                midpoint: Vector3::zeros(),
                line: Vector3::y(),
                orientations: [Vector3::y(); 2],
                line_angle_rad: 0.0,
                angles_rad: [0.0; 2],
            };
            PairFlight { start, flights }
                .contact(3.0, 100.0, 1000)
                .unwrap()
        };
        assert_eq!(meet(3.0), None);
        let time = meet(3.0 - 1e-9).unwrap();
        assert_relative_eq!(time, 5.0, epsilon = 1e-4);
    }

    #[test]
    fn a_pair_that_swims_upward_side_by_side_at_the_distance_of_contact_does_not_meet() {
        let headings = [1e-9_f64, 2e-9].map(|tilt| Vector3::new(tilt.sin(), tilt.cos(), 0.0));
        let flight = pair(3.0, 3.0, headings);
        assert_eq!(flight.contact(3.0, 200.0, 1_000_000), Ok(None));
    }

    #[test]
    fn a_pair_that_gravity_rights_at_once_does_not_meet_from_afar() {
        let tilted = [Vector3::new(0.6, -0.8, 0.0), Vector3::new(-0.8, -0.6, 0.0)];
        for heavy in [1e10, 1e30, 1e100, 1e300] {
            let met = pair(13.0, heavy, tilted).contact(3.0, 100.0, 100_000);
            assert_eq!(met, Ok(None), "{heavy:e}");
        }
    }

    #[test]
    fn straight_paths_are_nearest_where_the_way_between_is_across_their_relative_velocity() {
        let headings = [Vector3::new(0.6, 0.8, 0.0), Vector3::new(-0.48, 0.6, 0.64)];
        let flight = pair(20.0, 0.0, headings);
        let time = flight.closest_approach(1e3);
        let apart = |t: f64| flight.distance(t).0;
        assert!(apart(time) < apart(time - 1e-3) && apart(time) < apart(time + 1e-3));
        // By hand: 20 times 1.08 over 1.08^2 + 0.2^2 + 0.64^2.
        assert_relative_eq!(time, 21.6 / 1.616, max_relative = 1e-14);
    }

    #[test]
    fn curved_paths_are_nearest_where_a_fine_grid_finds_them() {
        let headings = [
            Vector3::new(0.96, -0.28, 0.0),
            Vector3::new(-0.8, -0.48, 0.36),
        ];
        for heavy in [0.2, 1.0, 4.0] {
            let flight = pair(8.0, heavy, headings);
            for duration in [0.5, 3.0, 40.0] {
                let time = flight.closest_approach(duration);
                assert!((0.0..=duration).contains(&time), "{time} of {duration}");
                let found = flight.distance(time).0;
                let least = (0..=20_000)
                    .map(|k| flight.distance(duration * f64::from(k) / 20_000.0).0)
                    .fold(f64::INFINITY, f64::min);
                assert!(found < least + 1e-9, "{heavy} {duration}: {found} {least}");
            }
        }
    }
}
