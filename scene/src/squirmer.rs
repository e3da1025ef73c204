//! A squirmer: a sphere with tangential surface slip.

use crate::{MAX_MODES, SceneError, checked_ratio};

/// A squirmer's radius, slip modes, squirming and swirl, and bottom-heaviness.
///
/// Slip velocity at the surface point with unit normal `n`, for orientation `p`, `c = p.n`:
/// `u_s = sum_n B_n W_n(c) (c n - p) + C_n W_n(c) p x n` (Blake 1971; Pak & Lauga 2014). A lone
/// squirmer swims at `V_s = 2 B_1/3` along `p` and spins at `-C_1` over its radius about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Squirmer {
    modes: [f64; MAX_MODES],
    count: usize,
    swirl: [f64; MAX_MODES],
    swirl_count: usize,
    bottom_heaviness: f64,
    radius: f64,
    /// Follows from the others.
    gravity_torque: f64,
}

impl Squirmer {
    /// A squirmer of radius 1 with slip modes `B_1, B_2, …` (velocities), at most [`MAX_MODES`] of them.
    ///
    /// Trailing zeros are dropped: a mode that is absent costs nothing.
    ///
    /// # Errors
    /// [`SceneError::TooManyModes`], or [`SceneError::NotFinite`] for a mode that is not finite.
    pub fn new(modes: &[f64]) -> Result<Self, SceneError> {
        let (modes, count) = padded("squirming mode", modes)?;
        Ok(Self {
            modes,
            count,
            swirl: [0.0; MAX_MODES],
            swirl_count: 0,
            bottom_heaviness: 0.0,
            radius: 1.0,
            gravity_torque: 0.0,
        })
    }

    /// The paper's squirmer: swimming speed `V_s` and `beta = B_2/B_1` (pullers have `beta > 0`).
    ///
    /// # Errors
    /// [`SceneError::NotFinite`] if either is not finite.
    ///
    /// ```
    /// let puller = scene::Squirmer::with_beta(1.0, 5.0)?;
    /// assert_eq!(puller.modes(), [1.5, 7.5]);
    /// # Ok::<(), scene::SceneError>(())
    /// ```
    pub fn with_beta(swimming_speed: f64, beta: f64) -> Result<Self, SceneError> {
        finite("swimming speed", swimming_speed)?;
        finite("beta", beta)?;
        Self::new(&[1.5 * swimming_speed, 1.5 * swimming_speed * beta])
    }

    /// The same squirmer with swirl modes `C_1, C_2, …` (velocities), at most [`MAX_MODES`] of them.
    ///
    /// # Errors
    /// As [`Self::new`].
    ///
    /// ```
    /// let corkscrew = scene::Squirmer::with_beta(1.0, 1.0)?.with_swirl(&[0.0, 2.0, 0.0])?;
    /// assert_eq!(corkscrew.swirl(), [0.0, 2.0]);
    /// # Ok::<(), scene::SceneError>(())
    /// ```
    pub fn with_swirl(self, modes: &[f64]) -> Result<Self, SceneError> {
        let (swirl, swirl_count) = padded("swirl mode", modes)?;
        Ok(Self {
            swirl,
            swirl_count,
            ..self
        })
    }

    /// The same squirmer with another radius, in radii of the first squirmer of a scene.
    ///
    /// # Errors
    /// [`SceneError::Radius`] outside 0.01 to 100.
    ///
    /// ```
    /// let cargo = scene::Squirmer::new(&[])?.with_radius(3.0)?;
    /// assert_eq!(cargo.radius(), 3.0);
    /// # Ok::<(), scene::SceneError>(())
    /// ```
    pub fn with_radius(self, radius: f64) -> Result<Self, SceneError> {
        let radius = checked_ratio(radius)?;
        Ok(Self { radius, ..self }.with_gravity_torque())
    }

    /// The same squirmer with bottom-heaviness `G_bh = 4 pi rho g a h/(3 mu V_s)`, `a` its own radius.
    ///
    /// # Errors
    /// [`SceneError::NotFinite`] if it is not finite.
    pub fn bottom_heavy(self, g_bh: f64) -> Result<Self, SceneError> {
        let bottom_heaviness = finite("bottom-heaviness G_bh", g_bh)?;
        let heavy = Self {
            bottom_heaviness,
            ..self
        };
        Ok(heavy.with_gravity_torque())
    }

    /// Slip modes `B_1, B_2, …` up to the highest that is not zero.
    #[inline]
    #[must_use]
    pub fn modes(&self) -> &[f64] {
        &self.modes[..self.count]
    }

    /// `B_{n+1}`, zero beyond the highest.
    #[inline(always)]
    pub fn mode(&self, n: usize) -> f64 {
        self.modes.get(n).copied().unwrap_or(0.0)
    }

    /// Swirl modes `C_1, C_2, …` up to the highest that is not zero.
    #[inline]
    #[must_use]
    pub fn swirl(&self) -> &[f64] {
        &self.swirl[..self.swirl_count]
    }

    /// Speed of the lone squirmer, `V_s = 2 B_1/3`, in its direction `p`.
    #[inline]
    #[must_use]
    pub fn swimming_speed(&self) -> f64 {
        self.modes[0] / 1.5
    }

    /// Radius, in radii of the first squirmer of a scene, which has 1.
    #[inline]
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Refuses to be the first squirmer of a scene, whose radius is the unit of length, with another radius than 1.
    ///
    /// # Errors
    /// [`SceneError::FirstRadius`].
    pub fn check_first(&self) -> Result<(), SceneError> {
        #[expect(clippy::float_cmp, reason = "the unit is exactly one")]
        if self.radius == 1.0 {
            Ok(())
        } else {
            Err(SceneError::FirstRadius {
                radius: self.radius,
            })
        }
    }

    /// Bottom-heaviness `G_bh`.
    #[inline]
    #[must_use]
    pub fn bottom_heaviness(&self) -> f64 {
        self.bottom_heaviness
    }

    /// `V_s G_bh / pi` times the square of the radius: the torque of gravity is this times `-p x g`, per `pi mu a^2` with `a` the radius
    /// of the first squirmer of a scene.
    #[inline]
    #[must_use]
    pub fn gravity_torque(&self) -> f64 {
        self.gravity_torque
    }

    fn with_gravity_torque(self) -> Self {
        let per_area = self.swimming_speed() * self.bottom_heaviness / std::f64::consts::PI;
        Self {
            gravity_torque: per_area * (self.radius * self.radius),
            ..self
        }
    }
}

/// Distance of the centres at which two spheres touch.
#[inline]
pub(crate) fn touching(squirmers: &[Squirmer; 2]) -> f64 {
    squirmers[0].radius + squirmers[1].radius
}

/// Modes with zeros up to [`MAX_MODES`], and how many there are up to the last that is not zero.
fn padded(what: &'static str, modes: &[f64]) -> Result<([f64; MAX_MODES], usize), SceneError> {
    let count = modes.iter().rposition(|&b| b != 0.0).map_or(0, |n| n + 1);
    if count > MAX_MODES {
        return Err(SceneError::TooManyModes {
            modes: count,
            allowed: MAX_MODES,
        });
    }
    let mut padded = [0.0; MAX_MODES];
    for (slot, &mode) in padded.iter_mut().zip(modes) {
        *slot = finite(what, mode)?;
    }
    Ok((padded, count))
}

/// `value`, if it is finite.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<f64, SceneError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(SceneError::NotFinite { what, value })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "exactly what was given")]
    use super::*;

    #[test]
    fn a_squirmer_has_what_it_was_given_and_its_torque_goes_as_the_square_of_its_radius() {
        let plain = Squirmer::with_beta(2.0, -3.0).unwrap();
        assert_eq!(plain.modes(), [3.0, -9.0]);
        assert!((plain.swimming_speed() - 2.0).abs() < 1e-15);
        assert!(
            plain.bottom_heaviness() == 0.0 && plain.radius() == 1.0 && plain.swirl().is_empty()
        );
        let heavy = plain
            .bottom_heavy(5.0)
            .and_then(|s| s.with_radius(0.5))
            .unwrap();
        assert!(heavy.bottom_heaviness() == 5.0 && heavy.radius() == 0.5);
        let torque = 2.0 * 5.0 / std::f64::consts::PI * 0.25;
        assert!(
            (heavy.gravity_torque() - torque).abs() < 1e-14,
            "{}",
            heavy.gravity_torque()
        );
        let swirling = heavy.with_swirl(&[0.0, 0.4]).unwrap();
        assert_eq!(swirling.swirl(), [0.0, 0.4]);
        // Modes up to the last that is not zero.
        assert_eq!(
            Squirmer::new(&[1.0, 0.0, 2.0, 0.0]).unwrap().modes(),
            [1.0, 0.0, 2.0]
        );
    }
}
