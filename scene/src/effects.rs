//! Effects other than hydrodynamics that a scene may call for.

use std::f64::consts::{FRAC_1_PI, LN_2};

use nalgebra::Vector3;

use crate::elementary::exp;
use crate::squirmer::finite;
use crate::{Gap, SceneError, Squirmer};

/// `kappa2 eps` beyond which repulsion is none: it is below 1e-130 of its strength, and nobody waits for an exponential.
const NEGLIGIBLE: f64 = 300.0;

/// Short-range repulsion that keeps the spheres apart (the paper's Eq. 4, after Ishikawa &
/// Pedley 2007): `kappa1 kappa2 e/(1 - e)` with `e = exp(-kappa2 eps)`, per `mu a^2` and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repulsion {
    strength: f64,
    decay: f64,
}

impl Repulsion {
    /// The paper's `kappa1 = 10`, `kappa2 = 100`.
    pub const PAPER: Self = Self {
        strength: 10.0,
        decay: 100.0,
    };

    /// Repulsion of strength `kappa1 > 0` and decay rate `kappa2 > 0`.
    ///
    /// # Errors
    /// [`SceneError::NotFinite`] or [`SceneError::NotPositive`].
    pub fn new(kappa1: f64, kappa2: f64) -> Result<Self, SceneError> {
        for (what, value) in [("kappa1", kappa1), ("kappa2", kappa2)] {
            if finite(what, value)? <= 0.0 {
                return Err(SceneError::NotPositive { what, value });
            }
        }
        Ok(Self {
            strength: kappa1,
            decay: kappa2,
        })
    }

    /// Strength `kappa1`.
    #[must_use]
    pub fn kappa1(&self) -> f64 {
        self.strength
    }

    /// Decay rate `kappa2`.
    #[must_use]
    pub fn kappa2(&self) -> f64 {
        self.decay
    }

    /// Force on each sphere, away from the other one, per `pi mu a`.
    ///
    /// ```
    /// use scene::{Gap, Repulsion};
    /// // At small gaps it tends to kappa1/(pi eps).
    /// let force = Repulsion::PAPER.force(Gap::new(1e-9)?);
    /// assert!((force * 1e-9 * std::f64::consts::PI / 10.0 - 1.0).abs() < 1e-6);
    /// # Ok::<(), scene::SceneError>(())
    /// ```
    #[inline]
    #[must_use]
    pub fn force(&self, gap: Gap) -> f64 {
        let scale = self.strength * self.decay * FRAC_1_PI;
        let decayed = self.decay * gap.eps();
        if decayed > NEGLIGIBLE {
            return 0.0;
        }
        if decayed > LN_2 {
            // Half the time of the other form, and as accurate where e is below a half.
            let e = exp(-decayed);
            return scale * e / (1.0 - e);
        }
        // e/(1 - e) without cancellation at small gaps.
        scale / decayed.exp_m1()
    }

    /// How [`Self::force`] changes with `ln eps`, with `kappa1` and with `kappa2`.
    pub(crate) fn slopes(&self, gap: Gap) -> [f64; 3] {
        let (force, decayed) = (self.force(gap), self.decay * gap.eps());
        // By x = kappa2 eps the force goes as 1/(e^x - 1): x times its slope over itself is -x/(1 - e^-x).
        let by_ln = -force * decayed / -(-decayed).exp_m1();
        let by_strength = force / self.strength;
        [by_ln, by_strength, (force + by_ln) / self.decay]
    }
}

/// Gravity, which turns bottom-heavy squirmers upward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity {
    direction: Vector3<f64>,
}

impl Gravity {
    /// Gravity along `-y`, across the pair's initial line of centres (the paper's `alpha = 0`).
    pub const DOWN: Self = Self {
        direction: Vector3::new(0.0, -1.0, 0.0),
    };

    /// Gravity along `direction`, which need not be of unit length.
    ///
    /// # Errors
    /// [`SceneError::NoDirection`] if it has no direction.
    pub fn new(direction: Vector3<f64>) -> Result<Self, SceneError> {
        Ok(Self {
            direction: unit("gravity", direction)?,
        })
    }

    /// Unit vector along which gravity pulls.
    #[inline]
    #[must_use]
    pub fn direction(&self) -> Vector3<f64> {
        self.direction
    }

    /// Torque on a squirmer with unit orientation `p`, `-(V_s G_bh/pi) p x g` per `pi mu a^2` (the paper's Eq. 9).
    #[inline]
    #[must_use]
    pub fn torque(&self, squirmer: &Squirmer, p: &Vector3<f64>) -> Vector3<f64> {
        p.cross(&self.direction) * -squirmer.gravity_torque()
    }

    /// The same as it is seen in another frame.
    pub(crate) fn seen(self, from: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Self {
        Self {
            direction: from(self.direction),
        }
    }
}

/// `vector` at unit length, left as it is to the last bit if it has that length already.
pub(crate) fn unit(what: &'static str, vector: Vector3<f64>) -> Result<Vector3<f64>, SceneError> {
    let length = vector.norm();
    if (length - 1.0).abs() < f64::EPSILON {
        return Ok(vector);
    }
    // Squares of components beyond these overflow or lose digits.
    let largest = vector.amax();
    if (1e-140..1e140).contains(&length) {
        Ok(vector / length)
    } else if largest > 0.0 && vector.iter().all(|component| component.is_finite()) {
        let scaled = vector.map(|component| component / largest);
        Ok(scaled / scaled.norm())
    } else {
        Err(SceneError::NoDirection {
            what,
            vector: vector.into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn val_repulsion_decays_until_it_is_none() {
        let force = |decayed: f64| Repulsion::PAPER.force(Gap::new(decayed / 100.0).unwrap());
        let scale = 1000.0 * FRAC_1_PI;
        for decayed in [1e-9, 0.1, 0.69, 0.7, 5.0, 80.0, 299.0_f64] {
            let expected = scale / decayed.exp_m1();
            assert!((force(decayed) / expected - 1.0).abs() < 1e-14, "{decayed}");
        }
        assert!(force(299.0) < 1e-126 && force(299.0) > 0.0);
        assert_eq!([force(301.0), force(1e6)].map(f64::to_bits), [0; 2]);
    }

    #[test]
    fn a_direction_does_not_depend_on_its_length() {
        for length in [5e-324, 1e-200, 1e-160, 1e160, 1e200, f64::MAX] {
            let along_x = unit("heading", Vector3::new(length, 0.0, 0.0));
            assert_eq!(along_x, Ok(Vector3::x()), "length {length:e}");
        }
        assert!(unit("heading", Vector3::zeros()).is_err());
        assert!(unit("heading", Vector3::new(1.0, f64::NAN, 0.0)).is_err());
        assert!(unit("heading", Vector3::new(f64::INFINITY, 0.0, 0.0)).is_err());
    }

    #[test]
    fn a_direction_of_any_length_becomes_one_of_unit_length() {
        let towards = Vector3::new(1.0, -2.0, 2.0);
        for size in [1e-300, 1e-150, 1e-3, 1.0, 7.0, 1e150, 1e300] {
            let found = unit("direction", towards * size).unwrap();
            assert!((found - towards / 3.0).norm() < 1e-15, "{size:e}: {found}");
        }
        // Already of unit length: not a bit changes.
        let exact = Vector3::new(0.6, 0.8, 0.0);
        assert_eq!(unit("direction", exact).unwrap(), exact);
        for none in [
            Vector3::zeros(),
            Vector3::new(f64::NAN, 1.0, 0.0),
            Vector3::new(f64::INFINITY, 0.0, 0.0),
        ] {
            assert!(matches!(
                unit("direction", none),
                Err(SceneError::NoDirection { .. })
            ));
        }
    }
}
