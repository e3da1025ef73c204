//! Flight of one squirmer.
//!
//! A lone squirmer swims along `p` at `V_s` while gravity turns `p` towards `-g` with the rate
//! `k sin(angle to -g)`, `k = V_s G_bh/(8 pi a)` (the paper's Eq. 12). With `h` half the angle,
//! `tan h(t) = tan h(0) exp(-k t)`, and the displacement follows by integration.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;

use crate::{Gravity, Squirmer};

/// One squirmer's free flight from time 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight {
    pub position: Vector3<f64>,
    pub orientation: Vector3<f64>,
    pub speed: f64,
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

/// `k t` below which a squirmer that gravity turns over is seen from below: `exp(-k t)` would leave the range of numbers.
const TURNED_OVER: f64 = -100.0;

impl Turning {
    /// The same with down for up: what turns away from the one turns towards the other.
    fn seen_from_below(self) -> Self {
        Self {
            up: -self.up,
            side: self.side,
            sin_half: self.cos_half,
            cos_half: self.sin_half,
            rate: -self.rate,
        }
    }
}

impl Flight {
    pub(super) fn new(
        squirmer: &Squirmer,
        position: Vector3<f64>,
        orientation: Vector3<f64>,
        gravity: Option<Gravity>,
    ) -> Self {
        let turning = gravity.and_then(|gravity| {
            // Over the drag on rotation, which goes as the volume.
            let rate = squirmer.gravity_torque() / (8.0 * squirmer.radius().powi(3));
            let up = -gravity.direction();
            let level = orientation - up * orientation.dot(&up);
            let sine = level.norm();
            // Exactly up or down: nothing turns it. Nor does it turn within any time if it would get farther than numbers reach before.
            let turns = rate != 0.0 && (squirmer.swimming_speed() / rate).is_finite();
            (turns && sine > 0.0).then(|| {
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

    /// Whether nothing turns it.
    pub(super) fn is_straight(&self) -> bool {
        self.turning.is_none()
    }

    /// Position and orientation after the time `t`.
    pub(super) fn at(&self, t: f64) -> (Vector3<f64>, Vector3<f64>) {
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
        } = if turning.rate * t < TURNED_OVER {
            turning.seen_from_below()
        } else {
            *turning
        };
        let kt = rate * t;
        let lost = -(-kt).exp_m1(); // 1 - exp(-kt)
        let kept = 1.0 - lost;
        // Angle turned through, without cancellation when it is small.
        let turned = 2.0 * (s * c * lost).atan2(c * c + s * s * kept);
        let rise = if kt < 1.0 {
            (c * c * kt.exp_m1() - s * s * lost).ln_1p()
        } else {
            let square = c * c + s * s * kept * kept;
            // It began so near down that the square is lost.
            kt + if square < f64::MIN_POSITIVE {
                2.0 * c.hypot(s * kept).ln()
            } else {
                square.ln()
            }
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
    pub(super) fn acceleration(&self, t: f64) -> (f64, f64) {
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
    pub(super) fn strays(&self, t: f64) -> f64 {
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
    fn a_top_heavy_squirmer_swims_down_however_long_it_has() {
        // By the rate -50 for 200 units of time: exp(10000) is no number.
        let heavy = |g_bh: f64| {
            let squirmer = Squirmer::with_beta(1.0, 1.0).and_then(|s| s.bottom_heavy(g_bh));
            let p = Vector3::new(1.0, 0.0, 0.0);
            let squirmer = squirmer.unwrap();
            Flight::new(&squirmer, Vector3::zeros(), p, Some(Gravity::DOWN))
        };
        let g_bh = -50.0 * 8.0 * std::f64::consts::PI;
        let (x, p) = heavy(g_bh).at(200.0);
        // A quarter of a turn, and what the turn takes: ln 2/k.
        let expected = Vector3::new(FRAC_PI_2 / 50.0, 2.0_f64.ln() / 50.0 - 200.0, 0.0);
        assert_relative_eq!(x, expected, epsilon = 1e-12);
        assert_relative_eq!(p, Vector3::new(0.0, -1.0, 0.0), epsilon = 1e-15);
        // Seen from below it is where it is seen from above.
        let flight = heavy(g_bh);
        let [before, after] =
            [1.0 - 1e-12, 1.0 + 1e-12].map(|s| flight.at(s * -TURNED_OVER / 50.0));
        assert_relative_eq!(before.0, after.0, epsilon = 1e-10);
        assert_relative_eq!(before.1, after.1, epsilon = 1e-14);
        // And upside down it is the bottom-heavy one.
        let (y, q) = heavy(-g_bh).at(200.0);
        assert_relative_eq!(x, Vector3::new(y.x, -y.y, y.z), epsilon = 1e-12);
        assert_relative_eq!(p, Vector3::new(q.x, -q.y, q.z), epsilon = 1e-15);
    }

    #[test]
    fn flight_under_gravity_that_hardly_acts_is_straight() {
        for g_bh in [1e-310, -1e-310, 5e-324] {
            let squirmer = Squirmer::with_beta(1.0, 1.0).and_then(|s| s.bottom_heavy(g_bh));
            let p = Vector3::new(1.0, 0.0, 0.0);
            let squirmer = squirmer.unwrap();
            let flight = Flight::new(&squirmer, Vector3::zeros(), p, Some(Gravity::DOWN));
            assert_eq!(flight.at(3.0), (p * 3.0, p), "{g_bh}");
        }
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
