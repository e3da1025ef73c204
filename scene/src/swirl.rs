//! Loads by swirl: azimuthal slip about a squirmer's axis.
//!
//! The slip `Σ C_n W_n(c) p x n` is the squirming slip of [`crate::loads`] turned by a quarter about the
//! normal. With the same `d`, `t` and `p_t`, it exerts on sphere `k`, per `pi mu a C_n` and
//! `pi mu a^2 C_n`,
//!
//! ```text
//! T_d(k) = P_n(c) XTC{k}_n,   F(k) = W_n(c) p_t YFC{k}_n along d x t,   T_t(k) = W_n(c) p_t YTC{k}_n along t.
//! ```
//!
//! `C_1` is rigid rotation about `p`: `XTC_1 = -8 XC`, `YFC_1 = -4 YB`, `YTC_1 = -8 YC`, self and other
//! alike. A squirmer cancels it by turning back at `-C_1 p`, and nothing else moves.

use crate::loads::MAX_MODES;
use crate::{LoadSet, SelfOther};

/// Columns of a swirl mode in [`SwirlLoads::columns`].
const MODE_COLUMNS: usize = 6;

/// Columns of `modes` swirl modes.
pub(crate) const fn swirl_column_count(modes: usize) -> usize {
    MODE_COLUMNS * modes
}

/// Loads by one swirl mode. See the [module](self) for definitions and signs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SwirlModeLoads {
    /// `XTC1_n, XTC2_n`, axial torque per `pi mu a^2 C_n P_n(c)`.
    pub xtc: SelfOther,
    /// `YFC1_n, YFC2_n`, transverse force along `d x t` per `pi mu a C_n W_n(c) p_t`.
    pub yfc: SelfOther,
    /// `YTC1_n, YTC2_n`, torque along `t` per `pi mu a^2 C_n W_n(c) p_t`.
    pub ytc: SelfOther,
}

/// Loads of a pair by its swirl modes at one gap. See the [module](self) for definitions and signs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwirlLoads {
    modes: [SwirlModeLoads; MAX_MODES],
    count: usize,
}

/// Mode by mode, of those that the sum holds; the other summand must hold them too.
impl std::ops::AddAssign<&Self> for SwirlLoads {
    fn add_assign(&mut self, rhs: &Self) {
        for (mode, more) in self.modes_mut().iter_mut().zip(rhs.modes()) {
            mode.xtc += more.xtc;
            mode.yfc += more.yfc;
            mode.ytc += more.ytc;
        }
    }
}

impl SwirlLoads {
    /// From the loads by each swirl mode (at most [`MAX_MODES`]), counted from 0.
    #[inline]
    #[must_use]
    pub fn from_modes(set: LoadSet, mode: impl Fn(usize) -> SwirlModeLoads) -> Self {
        let of = |n| {
            if n < set.swirl {
                mode(n)
            } else {
                SwirlModeLoads::default()
            }
        };
        Self {
            modes: std::array::from_fn(of),
            count: set.swirl.min(MAX_MODES),
        }
    }

    /// Loads of two spheres infinitely far apart: the torque of a lone sphere that `C_1` turns.
    #[must_use]
    pub fn isolated(set: LoadSet) -> Self {
        let torque = SelfOther::new(-8.0, 0.0);
        Self::from_modes(set, |n| match n {
            0 => SwirlModeLoads {
                xtc: torque,
                ytc: torque,
                ..SwirlModeLoads::default()
            },
            _ => SwirlModeLoads::default(),
        })
    }

    /// All zero.
    #[must_use]
    pub fn zero(set: LoadSet) -> Self {
        Self::from_modes(set, |_| SwirlModeLoads::default())
    }

    /// Loads by the swirl modes `n = 1, 2, ...`, in this order.
    #[inline]
    #[must_use]
    pub fn modes(&self) -> &[SwirlModeLoads] {
        &self.modes[..self.count]
    }

    /// The same, to fill in.
    pub fn modes_mut(&mut self) -> &mut [SwirlModeLoads] {
        &mut self.modes[..self.count]
    }

    /// All scalars in a fixed order (sum, difference; mode by mode), for tables.
    pub fn columns(&self) -> impl Iterator<Item = f64> + '_ {
        let modes = self.modes().iter();
        modes
            .flat_map(|m| [m.xtc, m.yfc, m.ytc])
            .flat_map(|s| [s.sum, s.difference])
    }

    /// The inverse of [`Self::columns`]; missing values are zero, surplus ones are ignored.
    #[inline]
    #[must_use]
    pub fn from_columns(set: LoadSet, columns: &[f64]) -> Self {
        let pair = |k: usize| match columns.get(2 * k..2 * k + 2) {
            Some(&[sum, difference]) => SelfOther { sum, difference },
            _ => SelfOther::default(),
        };
        Self::from_modes(set, |n| SwirlModeLoads {
            xtc: pair(3 * n),
            yfc: pair(3 * n + 1),
            ytc: pair(3 * n + 2),
        })
    }

    /// Every scalar with its name: `XTC1_1, XTC2_1, YFC1_1, ..., YTC2_n`.
    #[must_use]
    pub fn named(&self) -> Vec<(String, f64)> {
        let mut rows = Vec::with_capacity(swirl_column_count(self.count));
        for (n, mode) in (1..).zip(self.modes()) {
            for (name, s) in [("XTC", mode.xtc), ("YFC", mode.yfc), ("YTC", mode.ytc)] {
                rows.push((format!("{name}1_{n}"), s.own()));
                rows.push((format!("{name}2_{n}"), s.other()));
            }
        }
        rows
    }
}
