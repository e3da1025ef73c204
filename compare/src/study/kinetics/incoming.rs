//! Two squirmers of one speed before they meet: straight paths from infinity, in two sets of coordinates.
//!
//! *Impact*: the angle `between` the headings, the impact parameter `b` (distance of the paths where they are nearest) and its `roll`
//! about the relative velocity `V = p1 - p2`, from the direction of `p1 + p2`. With isotropic headings pairs come with the weight
//! `|V| = 2 sin(between/2)` times the area of the impact disc.
//!
//! *Contact*: the pair as it crosses the gap 1, at the centre distance 3. `polar1` and `polar2` are the angles between each heading and the
//! direction to the other squirmer, `azimuth` the angle about the line from 1 to 2 from `p1` to `p2`. With isotropic headings
//! pairs come with the weight `cos polar1 + cos polar2`, the speed of closing in.

use std::f64::consts::TAU;

use scene::nalgebra::{Rotation3, Vector3};

/// Distance of the centres at the gap 1, in radii: within it an encounter is close.
pub const CONTACT: f64 = 3.0;

/// Headings and paths of a pair that comes from infinity. `x` points along the relative velocity, `y` along the sum of the headings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incoming {
    /// Unit headings at minus infinity.
    pub headings: [Vector3<f64>; 2],
    /// Way from the path of squirmer 2 to that of squirmer 1 where the two are nearest, at right angles to the relative
    /// velocity, in radii.
    pub impact: Vector3<f64>,
}

/// Impact coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Angle between the headings, in radians, from 0 (excluded) to pi.
    pub between: f64,
    /// Impact parameter, in radii.
    pub b: f64,
    /// Angle of the impact vector about the relative velocity, in radians, from the sum of the headings.
    pub roll: f64,
}

/// Coordinates on the contact sphere, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Angle between each heading and the direction to the other squirmer. The pair closes in: their cosines have a positive sum.
    pub polar: [f64; 2],
    /// Angle about the line from 1 to 2, from heading 1 to heading 2.
    pub azimuth: f64,
}

impl Impact {
    /// The impact coordinates of a point in the unit cube, for impact parameters from `b.0` to `b.1`. Points that fill the cube evenly
    /// stand for equally many pairs.
    #[must_use]
    pub fn of_point([u, v, w]: [f64; 3], b: (f64, f64)) -> Self {
        // The share of pairs with sin(between/2) up to s is s^3. A speed of zero would never meet.
        let half = u.max(f64::EPSILON).cbrt();
        let area = b.0 * b.0 + v * (b.1 * b.1 - b.0 * b.0);
        Self {
            between: 2.0 * half.min(1.0).asin(),
            b: area.sqrt(),
            roll: TAU * w,
        }
    }

    /// The pair.
    #[must_use]
    pub fn incoming(&self) -> Incoming {
        let (sin, cos) = (0.5 * self.between).sin_cos();
        let (roll_sin, roll_cos) = self.roll.sin_cos();
        Incoming {
            headings: [Vector3::new(sin, cos, 0.0), Vector3::new(-sin, cos, 0.0)],
            impact: Vector3::new(0.0, roll_cos, roll_sin) * self.b,
        }
    }
}

impl Contact {
    /// The contact coordinates of a point in the unit cube. Points that fill the cube evenly stand for equally many pairs.
    #[must_use]
    pub fn of_point([u, v, w]: [f64; 3]) -> Self {
        // The sum of the cosines has the density 3/4 a (2 - a); the share up to a is (3 a^2 - a^3)/4, a cubic solved by angles.
        let u = u.clamp(f64::EPSILON, 1.0);
        let third = (TAU - (1.0 - 2.0 * u).acos()) / 3.0;
        let sum = (1.0 + 2.0 * third.cos()).clamp(f64::EPSILON, 2.0);
        // Given the sum, each cosine from `sum - 1` to 1 is as likely.
        let one = (sum - 1.0 + v * (2.0 - sum)).clamp(-1.0, 1.0);
        Self {
            polar: [one, sum - one].map(|cosine| cosine.clamp(-1.0, 1.0).acos()),
            azimuth: TAU * w,
        }
    }

    /// Headings in the frame with x along the line from 1 to 2.
    fn headings(&self) -> [Vector3<f64>; 2] {
        let [(sin1, cos1), (sin2, cos2)] = self.polar.map(f64::sin_cos);
        let (sin, cos) = self.azimuth.sin_cos();
        [
            Vector3::new(cos1, sin1, 0.0),
            Vector3::new(-cos2, sin2 * cos, sin2 * sin),
        ]
    }

    /// The straight paths that lead to this state.
    #[must_use]
    pub fn incoming(&self) -> Incoming {
        let headings = self.headings();
        let velocity = headings[0] - headings[1];
        let ahead = velocity / velocity.norm();
        let way = -Vector3::x() * CONTACT;
        Incoming {
            headings,
            impact: way - ahead * way.dot(&ahead),
        }
        .in_its_frame()
    }
}

impl Incoming {
    /// Velocity of squirmer 1 relative to squirmer 2, in swimming speeds.
    #[must_use]
    pub fn velocity(&self) -> Vector3<f64> {
        self.headings[0] - self.headings[1]
    }

    /// Way from squirmer 2 to squirmer 1 at a distance of the centres, on straight paths, before they are nearest. Not nearer than the
    /// impact parameter.
    #[must_use]
    pub fn way(&self, distance: f64) -> Vector3<f64> {
        let velocity = self.velocity();
        let behind = distance * distance - self.impact.norm_squared();
        self.impact - velocity * (behind.max(0.0).sqrt() / velocity.norm())
    }

    /// The same pair with `x` along the relative velocity and `y` along the sum of the headings.
    #[must_use]
    pub fn in_its_frame(&self) -> Self {
        let x = self.velocity().normalize();
        let sum = self.headings[0] + self.headings[1];
        // Opposed headings have no sum: any direction across is as good.
        let y = [sum, self.impact, Vector3::x(), Vector3::y()]
            .into_iter()
            .map(|v| v - x * v.dot(&x))
            .find(|v| v.norm() > 1e-12)
            .map_or(Vector3::y(), |v| v.normalize());
        let z = x.cross(&y);
        let turned = |v: Vector3<f64>| Vector3::new(v.dot(&x), v.dot(&y), v.dot(&z));
        Self {
            headings: self.headings.map(turned),
            impact: turned(self.impact),
        }
    }

    /// The impact coordinates.
    #[must_use]
    pub fn impact_coordinates(&self) -> Impact {
        let own = self.in_its_frame();
        Impact {
            between: 2.0 * (0.5 * own.velocity().norm()).min(1.0).asin(),
            b: own.impact.norm(),
            roll: own.impact.z.atan2(own.impact.y).rem_euclid(TAU),
        }
    }

    /// The contact coordinates; none for straight paths that stay beyond the gap 1.
    #[must_use]
    pub fn contact_coordinates(&self) -> Option<Contact> {
        if self.impact.norm() > CONTACT {
            return None;
        }
        let line = -self.way(CONTACT) / CONTACT;
        let [one, two] = self.headings;
        let angle = |p: Vector3<f64>, d: Vector3<f64>| p.cross(&d).norm().atan2(p.dot(&d));
        let azimuth = line
            .dot(&one.cross(&two))
            .atan2((one - line * one.dot(&line)).dot(&two));
        Some(Contact {
            polar: [angle(one, line), angle(two, -line)],
            azimuth: azimuth.rem_euclid(TAU),
        })
    }

    /// The pair with the two squirmers exchanged.
    #[must_use]
    pub fn exchanged(&self) -> Self {
        let [one, two] = self.headings;
        Self {
            headings: [two, one],
            impact: -self.impact,
        }
    }

    /// The pair in a mirror across `z`.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let of = |v: Vector3<f64>| Vector3::new(v.x, v.y, -v.z);
        Self {
            headings: self.headings.map(of),
            impact: of(self.impact),
        }
    }

    /// The pair, turned.
    #[must_use]
    pub fn turned(&self, by: Rotation3<f64>) -> Self {
        Self {
            headings: self.headings.map(|p| by * p),
            impact: by * self.impact,
        }
    }
}
