//! Which loads of a pair are wanted.

use serde::{Deserialize, Serialize};

use crate::loads::MAX_MODES;
use crate::{PairLoads, SceneError};

/// Which combinations of the spheres are read: the pair does not drift along its line of centres if the second
/// squirmer is an image of the first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Exchange {
    /// Sums and differences.
    #[default]
    None,
    /// The second is the first turned by pi about the midpoint: differences of `XA, XF, YA, YB, YF`, sums of
    /// `YC, YT`.
    Point,
    /// The second is the mirror image of the first: differences of `XA, XF, YC, YT`, sums of `YA, YB, YF`.
    Mirror,
}

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
    /// Which combinations of these are read. All that is said of a single sphere's load needs
    /// [`Exchange::None`].
    pub exchange: Exchange,
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
            exchange: Exchange::None,
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
            exchange: Exchange::None,
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
            exchange: Exchange::None,
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
            exchange: Exchange::None,
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
            exchange: if self.exchange == other.exchange {
                self.exchange
            } else {
                Exchange::None
            },
        }
    }

    /// The same for a pair with a symmetry, which rules out twist and swirl.
    #[must_use]
    pub const fn of_symmetric(self, exchange: Exchange) -> Self {
        Self { exchange, ..self }
    }

    /// Whether sums and differences over the spheres are read of axial forces.
    #[must_use]
    pub const fn axial_parities(self) -> [bool; 2] {
        [matches!(self.exchange, Exchange::None), true]
    }

    /// The same of transverse forces; of transverse torques by rotation and slip it is the other way round.
    #[must_use]
    pub const fn transverse_parities(self) -> [bool; 2] {
        [
            self.transverse && !matches!(self.exchange, Exchange::Point),
            self.transverse && !matches!(self.exchange, Exchange::Mirror),
        ]
    }

    /// Whether every load of `other` is in this set.
    #[inline]
    #[must_use]
    pub const fn holds(self, other: Self) -> bool {
        self.modes >= other.modes
            && (self.transverse || !other.transverse)
            && (self.twist || !other.twist)
            && self.swirl >= other.swirl
            && matches!(
                (self.exchange, other.exchange),
                (Exchange::None, _)
                    | (Exchange::Point, Exchange::Point)
                    | (Exchange::Mirror, Exchange::Mirror)
            )
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

    /// Which of the [`PairLoads::columns`] are read.
    pub(crate) fn read_columns(self) -> Vec<bool> {
        let (axial, across) = (self.axial_parities(), self.transverse_parities());
        let crossed = [across[1], across[0]];
        let rigid = [
            (axial, true),
            (across, self.transverse),
            (across, self.transverse),
            ([true; 2], self.twist),
            (crossed, self.transverse),
        ];
        let mode = [
            (axial, true),
            (across, self.transverse),
            (crossed, self.transverse),
        ];
        let modes = std::iter::repeat_n(mode, self.modes).flatten();
        (rigid.into_iter().chain(modes))
            .filter(|(_, held)| *held)
            .flat_map(|(read, _)| read)
            .collect()
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
        match self.exchange {
            Exchange::None => {}
            Exchange::Point => f.write_str(", of point-symmetric pairs")?,
            Exchange::Mirror => f.write_str(", of mirror-symmetric pairs")?,
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
