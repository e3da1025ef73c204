//! Which loads of a pair are wanted.

use serde::{Deserialize, Serialize};

use crate::loads::MAX_MODES;
use crate::{PairLoads, SceneError};

/// Which of the two combinations over the spheres are read: sum, difference, both or none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Parities {
    /// The sum.
    pub sum: bool,
    /// The difference.
    pub difference: bool,
}

impl Parities {
    /// Neither.
    pub const NONE: Self = Self {
        sum: false,
        difference: false,
    };
    /// The sum alone.
    pub const SUM: Self = Self {
        sum: true,
        difference: false,
    };
    /// The difference alone.
    pub const DIFFERENCE: Self = Self {
        sum: false,
        difference: true,
    };
    /// Both.
    pub const BOTH: Self = Self {
        sum: true,
        difference: true,
    };

    /// Whether any is read.
    #[must_use]
    pub const fn any(self) -> bool {
        self.sum || self.difference
    }

    const fn or(self, other: Self) -> Self {
        Self {
            sum: self.sum || other.sum,
            difference: self.difference || other.difference,
        }
    }

    const fn holds(self, other: Self) -> bool {
        (self.sum || !other.sum) && (self.difference || !other.difference)
    }

    /// The difference for the sum, and the other way round.
    pub(crate) const fn crossed(self) -> Self {
        Self {
            sum: self.difference,
            difference: self.sum,
        }
    }
}

/// The loads that a caller will read: a model computes these alone, a table has columns for what follows from
/// these.
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
    /// Axial translation and squirming: `XA, XF`.
    pub axial: Parities,
    /// Motion and squirming across the line of centres: `YA, YB, YF`; of `YC, YT` the other combinations, because opposed spins
    /// go with like translations.
    pub transverse: Parities,
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
            axial: Parities::BOTH,
            transverse: Parities::NONE,
            twist: false,
            swirl: 0,
        }
    }

    /// All ten resistance scalars and all six loads of each squirming mode.
    #[must_use]
    pub const fn all(modes: usize) -> Self {
        Self {
            twist: true,
            ..Self::planar(modes)
        }
    }

    /// The same for motion in a plane, where nothing turns about the line of centres.
    #[must_use]
    pub const fn planar(modes: usize) -> Self {
        Self {
            transverse: Parities::BOTH,
            ..Self::axial(modes)
        }
    }

    /// Axial translation and squirming, and rotation about the line of centres.
    #[must_use]
    pub const fn axial_and_twist(modes: usize) -> Self {
        Self {
            twist: true,
            ..Self::axial(modes)
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
            axial: self.axial.or(other.axial),
            transverse: self.transverse.or(other.transverse),
            twist: self.twist || other.twist,
            swirl: self.swirl.max(other.swirl),
        }
    }

    /// What is read of a pair whose second squirmer is the first turned by pi about the midpoint: differences of `XA, XF, YA, YB,
    /// YF`, sums of `YC, YT`.
    #[must_use]
    pub const fn point_symmetric(self) -> Self {
        Self {
            axial: Parities {
                sum: false,
                ..self.axial
            },
            transverse: Parities {
                sum: false,
                ..self.transverse
            },
            ..self
        }
    }

    /// What is read of a pair whose second squirmer is the mirror image of the first: differences of `XA, XF, YC, YT`, sums of `YA,
    /// YB, YF`.
    #[must_use]
    pub const fn mirror_symmetric(self) -> Self {
        Self {
            axial: Parities {
                sum: false,
                ..self.axial
            },
            transverse: Parities {
                difference: false,
                ..self.transverse
            },
            ..self
        }
    }

    /// The same with both combinations of each kind of load that there is.
    #[must_use]
    pub const fn of_any_pair(self) -> Self {
        const fn both(of: Parities) -> Parities {
            if of.any() { Parities::BOTH } else { of }
        }
        Self {
            axial: both(self.axial),
            transverse: both(self.transverse),
            ..self
        }
    }

    /// Whether every load of `other` is in this set.
    #[inline]
    #[must_use]
    pub const fn holds(self, other: Self) -> bool {
        self.modes >= other.modes
            && self.axial.holds(other.axial)
            && self.transverse.holds(other.transverse)
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
        1 + if self.transverse.any() { 3 } else { 0 } + self.twist as usize
    }

    /// Loads of a squirming mode, each for self and other, in [`PairLoads::columns`].
    pub(crate) const fn per_mode(self) -> usize {
        if self.transverse.any() { 3 } else { 1 }
    }

    /// Number of `f64` in [`PairLoads::columns`]: with both combinations of each kind of load of which one is read, and always with
    /// those along the line of centres.
    #[must_use]
    pub const fn column_count(self) -> usize {
        2 * (self.rigid() + self.per_mode() * self.modes)
    }
}

impl std::fmt::Display for LoadSet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} squirming modes", self.modes)?;
        for (of, what) in [(self.axial, "axial"), (self.transverse, "transverse")] {
            let read = match (of.sum, of.difference) {
                (true, true) => "",
                (true, false) => "sums of ",
                (false, true) => "differences of ",
                (false, false) => "no ",
            };
            write!(f, ", {read}{what}")?;
        }
        f.write_str(if self.twist { ", twist" } else { ", no twist" })?;
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
        let LoadSet { twist, .. } = self.set();
        let transverse = self.set().transverse.any();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_with_a_symmetry_reads_one_combination_of_each_kind_of_load() {
        let whole = LoadSet::all(2).with_swirl(3);
        let (turned, mirrored) = (whole.point_symmetric(), whole.mirror_symmetric());
        for of in [turned, mirrored] {
            assert!(whole.holds(of) && !of.holds(whole));
            // Along the line of centres the two push each other apart: that pushes neither pair.
            assert!(of.axial.difference && !of.axial.sum);
            assert!(of.transverse.sum != of.transverse.difference);
            // All else is as it was.
            assert_eq!((of.modes, of.twist, of.swirl), (2, true, 3));
            assert_eq!(of.of_any_pair(), whole);
        }
        // The one drifts across as one, the other one turns as one.
        assert!(mirrored.transverse.sum && turned.transverse.difference);
        let either = turned.union(mirrored);
        assert_eq!(
            (either.axial, either.transverse),
            (turned.axial, Parities::BOTH)
        );
    }

    #[test]
    fn twist_is_all_that_motion_in_a_plane_lacks() {
        let [axial, turning] = [LoadSet::axial(2), LoadSet::axial_and_twist(2)];
        assert!(turning.twist && turning.holds(axial) && !axial.holds(turning));
        assert!(!turning.transverse.any());
        assert_eq!(turning.union(LoadSet::planar(2)), LoadSet::all(2));
        assert_eq!(axial.of_any_pair(), axial);
    }

    #[test]
    fn sets_have_as_many_modes_as_loads_hold() {
        for set in [
            LoadSet::all(MAX_MODES),
            LoadSet::all(0).with_swirl(MAX_MODES),
        ] {
            assert!(set.check().is_ok());
        }
        for (set, modes) in [
            (LoadSet::all(MAX_MODES + 1), MAX_MODES + 1),
            (LoadSet::all(MAX_MODES + 3).with_swirl(1), MAX_MODES + 3),
            (LoadSet::all(1).with_swirl(MAX_MODES + 2), MAX_MODES + 2),
        ] {
            let refused = SceneError::TooManyModes {
                modes,
                allowed: MAX_MODES,
            };
            assert_eq!(set.check(), Err(refused));
        }
    }
}
