//! Which loads of a pair are wanted.

use serde::{Deserialize, Serialize};

use crate::loads::MAX_MODES;
use crate::{PairLoads, SceneError};

/// The loads that a caller will read: a model computes these alone, a table has columns for these
/// alone. Axial translation and its squirming loads are in every set.
///
/// ```
/// use scene::LoadSet;
/// let planar = LoadSet { twist: false, ..LoadSet::all(2) };
/// assert!(LoadSet::all(2).holds(LoadSet::axial(1)) && !planar.holds(LoadSet::all(1)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct LoadSet {
    /// Squirming modes, 1 to this.
    pub modes: usize,
    /// Motion and squirming across the line of centres: `YA, YB, YC, YF, YT`.
    pub transverse: bool,
    /// Rotation about the line of centres: `XC`.
    pub twist: bool,
    /// Swirl modes, 1 to this: [`crate::SwirlLoads`], all three loads of each.
    pub swirl: usize,
}

impl LoadSet {
    /// Axial translation and squirming alone: pairs that face each other exactly.
    #[must_use]
    pub const fn axial(modes: usize) -> Self {
        Self {
            modes,
            transverse: false,
            twist: false,
            swirl: 0,
        }
    }

    /// All ten resistance scalars and all six loads of each squirming mode.
    #[must_use]
    pub const fn all(modes: usize) -> Self {
        Self {
            modes,
            transverse: true,
            twist: true,
            swirl: 0,
        }
    }

    /// The same for motion in a plane, where nothing turns about the line of centres.
    #[must_use]
    pub const fn planar(modes: usize) -> Self {
        Self {
            modes,
            transverse: true,
            twist: false,
            swirl: 0,
        }
    }

    /// Axial translation and squirming, and rotation about the line of centres.
    #[must_use]
    pub const fn axial_and_twist(modes: usize) -> Self {
        Self {
            modes,
            transverse: false,
            twist: true,
            swirl: 0,
        }
    }

    /// The same with the loads of the swirl modes 1 to `swirl`.
    #[must_use]
    pub const fn with_swirl(self, swirl: usize) -> Self {
        Self { swirl, ..self }
    }

    /// The loads that are in this set or in the other.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            modes: self.modes.max(other.modes),
            transverse: self.transverse || other.transverse,
            twist: self.twist || other.twist,
            swirl: self.swirl.max(other.swirl),
        }
    }

    /// Whether every load of `other` is in this set.
    #[inline]
    #[must_use]
    pub const fn holds(self, other: Self) -> bool {
        self.modes >= other.modes
            && (self.transverse || !other.transverse)
            && (self.twist || !other.twist)
            && self.swirl >= other.swirl
    }

    /// The set, unless it has more modes than [`PairLoads`] can hold.
    ///
    /// # Errors
    /// [`SceneError::TooManyModes`].
    #[inline]
    pub const fn check(self) -> Result<Self, SceneError> {
        if self.modes > MAX_MODES || self.swirl > MAX_MODES {
            return Err(SceneError::TooManyModes {
                modes: if self.modes > MAX_MODES {
                    self.modes
                } else {
                    self.swirl
                },
                allowed: MAX_MODES,
            });
        }
        Ok(self)
    }

    /// Resistance scalars, each for self and other, in [`PairLoads::columns`].
    pub(crate) const fn rigid(self) -> usize {
        1 + if self.transverse { 3 } else { 0 } + self.twist as usize
    }

    /// Loads of a squirming mode, each for self and other, in [`PairLoads::columns`].
    pub(crate) const fn per_mode(self) -> usize {
        if self.transverse { 3 } else { 1 }
    }

    /// Number of `f64` in [`PairLoads::columns`].
    #[must_use]
    pub const fn column_count(self) -> usize {
        2 * (self.rigid() + self.per_mode() * self.modes)
    }
}

impl std::fmt::Display for LoadSet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} squirming modes", self.modes)?;
        for (there, what) in [(self.transverse, "transverse"), (self.twist, "twist")] {
            write!(f, ", {}{what}", if there { "" } else { "no " })?;
        }
        if self.swirl > 0 {
            write!(f, ", {} swirl modes", self.swirl)?;
        }
        Ok(())
    }
}

/// The loads of a pair as a set holds them, in the order of [`PairLoads::columns`].
impl PairLoads {
    /// All scalars of the set in a fixed order (sum, difference; A, B, C, then mode by mode), for
    /// tables.
    pub fn columns(&self) -> impl Iterator<Item = f64> + '_ {
        let LoadSet {
            transverse, twist, ..
        } = self.set();
        let rigid = [
            (self.xa, true),
            (self.ya, transverse),
            (self.yb, transverse),
            (self.xc, twist),
            (self.yc, transverse),
        ];
        let modes = (self.modes().iter())
            .flat_map(move |m| [(m.xf, true), (m.yf, transverse), (m.yt, transverse)]);
        rigid
            .into_iter()
            .chain(modes)
            .filter(|(_, held)| *held)
            .flat_map(|(s, _)| [s.sum, s.difference])
    }
}
