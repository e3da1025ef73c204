//! Flight of squirmers that do not interact, in closed form.
//!
//! A lone squirmer swims along `p` at `V_s` while gravity turns `p` towards `-g` with the rate
//! `k sin(angle to -g)`, `k = V_s G_bh/(8 pi)` (the paper's Eq. 12). With `h` half the angle,
//! `tan h(t) = tan h(0) exp(-k t)`, and the displacement follows by integration.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;

use super::configuration::{Configuration, unwind};
use crate::{Gap, Gravity, SceneError, Squirmer};

/// One squirmer's free flight from time 0.
#[derive(Clone, Copy, Debug)]
struct Flight {
    position: Vector3<f64>,
    orientation: Vector3<f64>,
    speed: f64,
    turning: Option<Turning>,
}

/// How gravity turns it: `up`, the perpendicular to it in the plane of `p`, sine and cosine of
/// half the angle between `p` and `up`, and the rate `k`.
#[derive(Clone, Copy, Debug)]
struct Turning {
    up: Vector3<f64>,
    side: Vector3<f64>,
    sin_half: f64,
    cos_half: f64,
    rate: f64,
}

impl Flight {
    fn new(
        squirmer: &Squirmer,
        position: Vector3<f64>,
        orientation: Vector3<f64>,
        gravity: Option<Gravity>,
    ) -> Self {
        let turning = gravity.and_then(|gravity| {
            let rate = squirmer.gravity_torque() / 8.0;
            let up = -gravity.direction();
            let level = orientation - up * orientation.dot(&up);
            let sine = level.norm();
            // Exactly up or down: nothing turns it.
            (rate != 0.0 && sine > 0.0).then(|| {
                let half = 0.5 * sine.atan2(orientation.dot(&up));
                Turning {
                    up,
                    side: level / sine,
                    sin_half: half.sin(),
                    cos_half: half.cos(),
                    rate,
                }
            })
        });
        Self {
            position,
            orientation,
            speed: squirmer.swimming_speed(),
            turning,
        }
    }

    /// Position and orientation after the time `t`.
    fn at(&self, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        let Some(turning) = &self.turning else {
            return (
                self.position + self.orientation * (self.speed * t),
                self.orientation,
            );
        };
        let Turning {
            up,
            side,
            sin_half: s,
            cos_half: c,
            rate,
        } = *turning;
        let kt = rate * t;
        let lost = -(-kt).exp_m1(); // 1 - exp(-kt)
        let kept = 1.0 - lost;
        // Angle turned through, without cancellation when it is small.
        let turned = 2.0 * (s * c * lost).atan2(c * c + s * s * kept);
        let rise = if kt < 1.0 {
            (c * c * kt.exp_m1() - s * s * lost).ln_1p()
        } else {
            kt + (c * c + s * s * kept * kept).ln()
        };
        let angle = 2.0 * (s * kept).atan2(c);
        let scale = self.speed / rate;
        (
            self.position + side * (scale * turned) + up * (scale * rise),
            side * angle.sin() + up * angle.cos(),
        )
    }

    /// Acceleration after the time `t`, `|V k| sin(angle to up)`, and a bound on it from then on: gravity that rights a
    /// squirmer makes that angle smaller, so that within a right angle the acceleration only falls.
    fn acceleration(&self, t: f64) -> (f64, f64) {
        self.turning.map_or((0.0, 0.0), |turning| {
            let most = (self.speed * turning.rate).abs();
            let angle =
                2.0 * (turning.sin_half * (-turning.rate * t).exp()).atan2(turning.cos_half);
            let now = most * angle.sin().abs();
            if turning.rate > 0.0 && angle <= FRAC_PI_2 {
                (now, now)
            } else {
                (now, most)
            }
        })
    }

    /// Bound on how far the path after the time `t` strays from straight flight upward: that of
    /// `p` from up is `2 sin h`, at most `2 tan h(0) exp(-k t)`, integrated to the end of time.
    fn strays(&self, t: f64) -> f64 {
        self.turning.map_or(f64::INFINITY, |turning| {
            let Turning {
                sin_half,
                cos_half,
                rate,
                ..
            } = turning;
            if rate > 0.0 && cos_half > 0.0 {
                2.0 * (self.speed / rate).abs() * (sin_half / cos_half) * (-rate * t).exp()
            } else {
                f64::INFINITY
            }
        })
    }
}

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
            if self.flights[k].turning.is_none() {
                self.start.angles[k]
            } else {
                unwind(p.y.atan2(p.x), self.start.angles[k])
            }
        };
        Configuration {
            // Rounding may bring the distance of a touching pair to 2 or below.
            gap: Gap::from_ln((distance - 2.0).max(f64::MIN_POSITIVE).ln()),
            midpoint: (x1 + x2) * 0.5,
            line,
            orientations: [p1, p2],
            line_angle: unwind(line.y.atan2(line.x), self.start.line_angle),
            angles: [turned(0, p1), turned(1, p2)],
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

    /// Whether the two fly straight, so that once receding they recede for ever.
    pub(crate) fn is_straight(&self) -> bool {
        self.flights.iter().all(|flight| flight.turning.is_none())
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
    /// [`SceneError::Stepper`] if `most` advances do not settle it: gravity that turns squirmers by far
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
            // A step that no longer changes the time has as good as arrived.
            let least = 1e-13 * (1.0 + t);
            let arrived = left <= 4.0 * f64::EPSILON * contact || advance < least;
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
        Err(SceneError::Stepper {
            reason: format!("{most} advances of a free flight end {t} after its start"),
        })
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

    /// Fourth-order Runge-Kutta on the equations that the closed form solves.
    fn integrated(squirmer: &Squirmer, p: Vector3<f64>, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        let rate = squirmer.gravity_torque() / 8.0;
        let turn = |p: Vector3<f64>| (p.cross(&Gravity::DOWN.direction()) * -rate).cross(&p);
        let (mut x, mut p) = (Vector3::zeros(), p);
        let steps = 4000;
        let h = t / f64::from(steps);
        for _ in 0..steps {
            let k1 = turn(p);
            let p2 = p + k1 * (h / 2.0);
            let k2 = turn(p2);
            let p3 = p + k2 * (h / 2.0);
            let k3 = turn(p3);
            let p4 = p + k3 * h;
            let k4 = turn(p4);
            x += (p + (p2 + p3) * 2.0 + p4) * (h / 6.0 * squirmer.swimming_speed());
            p += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
        }
        (x, p)
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
                gap: Gap::from_ln(2.0),
                midpoint: Vector3::zeros(),
                line: Vector3::y(),
                orientations: [Vector3::y(); 2],
                line_angle: 0.0,
                angles: [0.0; 2],
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
        let squirmer = Squirmer::with_beta(1.0, 0.0)
            .and_then(|s| s.bottom_heavy(3.0))
            .unwrap();
        let flights = [(-1.5, 1e-9), (1.5, 2e-9)].map(|(x, tilt): (f64, f64)| {
            let p = Vector3::new(tilt.sin(), tilt.cos(), 0.0);
            Flight::new(&squirmer, Vector3::new(x, 0.0, 0.0), p, Some(Gravity::DOWN))
        });
        let start = Configuration {
            gap: Gap::from_ln(0.0),
            midpoint: Vector3::zeros(),
            line: Vector3::x(),
            orientations: [Vector3::y(); 2],
            line_angle: 0.0,
            angles: [0.0; 2],
        };
        let flight = PairFlight { start, flights };
        assert_eq!(flight.contact(3.0, 200.0, 1_000_000), Ok(None));
    }

    #[test]
    fn val_flight_under_gravity_solves_its_equation_of_motion() {
        for (g_bh, t) in [(10.0, 3.0), (1e-6, 50.0), (300.0, 2.0), (-4.0, 5.0)] {
            let squirmer = Squirmer::with_beta(1.0, 1.0)
                .and_then(|s| s.bottom_heavy(g_bh))
                .unwrap();
            for angle in [-1.5, -0.3, 0.0, 1.2, 2.9] {
                let p = Vector3::new(f64::cos(angle), f64::sin(angle), 0.0);
                let flight = Flight::new(&squirmer, Vector3::zeros(), p, Some(Gravity::DOWN));
                let (x, q) = flight.at(t);
                let (x_expected, q_expected) = integrated(&squirmer, p, t);
                assert_relative_eq!(x, x_expected, epsilon = 1e-9);
                assert_relative_eq!(q, q_expected, epsilon = 1e-9);
            }
        }
    }
}
