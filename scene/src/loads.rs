//! The loads of a pair of equal spheres: ten resistance scalars and six loads per squirming mode.
//!
//! Definitions and signs (every other crate refers to these):
//!
//! `d` is the unit vector from a sphere to the other one. Sphere 1 moves (`U` along the
//! transverse unit vector `t`, `omega` along `d x t`), sphere 2 is still, and the fluid's loads
//! are, after Kim & Karrila, *Microhydrodynamics* (2005), chapter 7, for viscosity 1 and radius 1,
//!
//! ```text
//! F1_d = -6 pi X11A U_d            F2_d = -6 pi X12A U_d
//! F1_t = -6 pi Y11A U + 4 pi Y11B omega      F2_t = -6 pi Y12A U + 4 pi Y12B omega
//! T1   =  4 pi Y11B U - 8 pi Y11C omega      T2   = -4 pi Y12B U - 8 pi Y12C omega   (along d x t)
//! T1_d = -8 pi X11C omega_d        T2_d = -8 pi X12C omega_d
//! ```
//!
//! with `Y11B < 0 < Y12B`. A squirmer (sphere 1, held still beside a still sphere 2) with
//! orientation `p`, `c = p.d`, `p_t = p.t`, and slip mode `B_n` exerts on sphere `k` through the
//! fluid, per `pi mu a B_n` and `pi mu a^2 B_n`,
//!
//! ```text
//! F_d(k) = P_n(c) XF{k}_n,   F_t(k) = W_n(c) p_t YF{k}_n,   T(k) = W_n(c) p_t YT{k}_n along d x t.
//! ```
//!
//! Each scalar comes as a pair, that of the sphere itself (11 or 1) and that of the other one
//! (12 or 2). They are stored as sum and difference, because the force balance needs only these
//! and the sum of two scalars that diverge at contact would lose its digits if it were formed late.

use crate::{LoadSet, Parities};

/// Highest squirming mode that a [`PairLoads`] can hold.
pub const MAX_MODES: usize = 8;

/// Two scalars of one kind, for the sphere itself and for the other one, as sum and difference.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SelfOther {
    /// `self + other`.
    pub sum: f64,
    /// `self - other`.
    pub difference: f64,
}

impl SelfOther {
    /// From the scalar of the sphere itself and that of the other one.
    #[must_use]
    pub fn new(own: f64, other: f64) -> Self {
        Self {
            sum: own + other,
            difference: own - other,
        }
    }

    /// The scalar of the sphere itself (subscript 11, or 1).
    #[must_use]
    pub fn own(self) -> f64 {
        0.5 * (self.sum + self.difference)
    }

    /// The scalar of the other sphere (subscript 12, or 2).
    #[must_use]
    pub fn other(self) -> f64 {
        0.5 * (self.sum - self.difference)
    }
}

impl std::ops::AddAssign for SelfOther {
    #[inline]
    fn add_assign(&mut self, rhs: Self) {
        self.sum += rhs.sum;
        self.difference += rhs.difference;
    }
}

/// Loads by one squirming mode: axial force, transverse force, torque. See the module's signs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModeLoads {
    /// `XF1_n, XF2_n`, axial force per `pi mu a B_n P_n(c)`.
    pub xf: SelfOther,
    /// `YF1_n, YF2_n`, transverse force per `pi mu a B_n W_n(c) p_t`.
    pub yf: SelfOther,
    /// `YT1_n, YT2_n`, torque per `pi mu a^2 B_n W_n(c) p_t`.
    pub yt: SelfOther,
}

/// A mode that is not there.
const NO_LOADS: ModeLoads = {
    const ZERO: SelfOther = SelfOther {
        sum: 0.0,
        difference: 0.0,
    };
    ModeLoads {
        xf: ZERO,
        yf: ZERO,
        yt: ZERO,
    }
};

/// The loads of a pair at one gap, those of a [`LoadSet`]; the others are not to be read. See the
/// [module](self) for definitions and signs.
#[derive(Clone, Copy, Debug)]
pub struct PairLoads {
    /// `X11A, X12A`, per `6 pi mu a`.
    pub xa: SelfOther,
    /// `Y11A, Y12A`, per `6 pi mu a`.
    pub ya: SelfOther,
    /// `Y11B, Y12B`, per `4 pi mu a^2`.
    pub yb: SelfOther,
    /// `X11C, X12C`, per `8 pi mu a^3`.
    pub xc: SelfOther,
    /// `Y11C, Y12C`, per `8 pi mu a^3`.
    pub yc: SelfOther,
    modes: [ModeLoads; MAX_MODES],
    set: LoadSet,
}

/// Of the loads that their sets hold.
impl PartialEq for PairLoads {
    fn eq(&self, other: &Self) -> bool {
        self.set == other.set && self.columns().eq(other.columns())
    }
}

/// Load by load, of those that the sum holds; the other summand must hold them too.
impl std::ops::AddAssign<&Self> for PairLoads {
    fn add_assign(&mut self, rhs: &Self) {
        self.xa += rhs.xa;
        self.ya += rhs.ya;
        self.yb += rhs.yb;
        self.xc += rhs.xc;
        self.yc += rhs.yc;
        for (mode, more) in self.modes_mut().iter_mut().zip(rhs.modes()) {
            mode.xf += more.xf;
            mode.yf += more.yf;
            mode.yt += more.yt;
        }
    }
}

impl PairLoads {
    /// From the resistance scalars `[xa, ya, yb, xc, yc]` and the loads by each squirming mode (at most
    /// [`MAX_MODES`]), counted from 0. What `set` does not hold may have any value.
    #[inline]
    #[must_use]
    pub fn from_parts(
        [xa, ya, yb, xc, yc]: [SelfOther; 5],
        set: LoadSet,
        mode: impl Fn(usize) -> ModeLoads,
    ) -> Self {
        // Written where it is returned to: copies of this type are what a right-hand side would
        // spend most of its time on.
        Self {
            xa,
            ya,
            yb,
            xc,
            yc,
            modes: std::array::from_fn(|n| if n < set.modes { mode(n) } else { NO_LOADS }),
            set: LoadSet {
                modes: set.modes.min(MAX_MODES),
                ..set
            },
        }
    }

    /// Loads of two spheres infinitely far apart, with at most [`MAX_MODES`] squirming modes: unit drag, thrust `4 pi mu a B_1` of the first mode, all else zero.
    #[inline]
    #[must_use]
    pub fn isolated(set: LoadSet) -> Self {
        let zero = SelfOther::default();
        let unit = SelfOther::new(1.0, 0.0);
        let thrust = SelfOther::new(4.0, 0.0);
        Self::from_parts([unit, unit, zero, unit, unit], set, |n| ModeLoads {
            xf: if n == 0 { thrust } else { zero },
            yf: if n == 0 { thrust } else { zero },
            yt: zero,
        })
    }

    /// All scalars zero, with room for at most [`MAX_MODES`] squirming modes.
    #[inline]
    #[must_use]
    pub fn zero(set: LoadSet) -> Self {
        Self::from_parts([SelfOther::default(); 5], set, |_| NO_LOADS)
    }

    /// Which of the loads these are.
    #[inline]
    #[must_use]
    pub fn set(&self) -> LoadSet {
        self.set
    }

    /// Loads by the squirming modes `n = 1, 2, ...`, in this order.
    #[inline]
    #[must_use]
    pub fn modes(&self) -> &[ModeLoads] {
        &self.modes[..self.set.modes]
    }

    /// Loads by the mode `n + 1`, zero beyond those there are; without a slice, so that a constant `n`
    /// is found at compile time.
    #[inline(always)]
    pub fn mode(&self, n: usize) -> ModeLoads {
        self.modes.get(n).copied().unwrap_or(NO_LOADS)
    }

    /// The same, to fill in.
    #[inline]
    pub fn modes_mut(&mut self) -> &mut [ModeLoads] {
        &mut self.modes[..self.set.modes]
    }

    /// The loads of `set` from the [`Self::columns`] of the set `layout`, which must hold it.
    #[inline]
    #[must_use]
    pub fn from_columns(set: LoadSet, layout: LoadSet, columns: &[f64]) -> Self {
        Self::from_column_pairs(set, layout, |k| match columns.get(2 * k..2 * k + 2) {
            Some(&[sum, difference]) => SelfOther { sum, difference },
            _ => SelfOther::default(),
        })
    }

    /// The same with `pair(k)` in place of the columns `2 k` and `2 k + 1`; it is asked for those alone
    /// that `set` holds.
    #[inline]
    #[must_use]
    pub fn from_column_pairs(
        set: LoadSet,
        layout: LoadSet,
        pair: impl Fn(usize) -> SelfOther,
    ) -> Self {
        let pair = |held: bool, k: usize| {
            if held { pair(k) } else { SelfOther::default() }
        };
        let (across, twist) = (
            set.transverse.any() && layout.transverse.any(),
            set.twist && layout.twist,
        );
        let xc = if layout.transverse.any() { 3 } else { 1 };
        let rigid = [
            pair(true, 0),
            pair(across, 1),
            pair(across, 2),
            pair(twist, xc),
            pair(across, layout.rigid() - 1),
        ];
        Self::from_parts(rigid, set, |n| {
            let k = layout.rigid() + layout.per_mode() * n;
            ModeLoads {
                xf: pair(true, k),
                yf: pair(across, k + 1),
                yt: pair(across, k + 2),
            }
        })
    }

    /// Every scalar of the set with its published name: `X11A, X12A, Y11A, ..., XF1_1, XF2_1, ...,
    /// YT2_n`; of a set for symmetric pairs the one combination that is read, such as `X11A - X12A`.
    #[must_use]
    pub fn named(&self) -> Vec<(String, f64)> {
        let LoadSet {
            axial, transverse, ..
        } = self.set;
        // Opposed spins go with like translations: loads of torques have the other parity.
        let crossed = transverse.crossed();
        let twist = if self.set.twist {
            Parities::BOTH
        } else {
            Parities::NONE
        };
        let mut rows = Vec::with_capacity(self.set.column_count());
        let mut push = |[own, other]: [String; 2], s: SelfOther, read: Parities| match (
            read.sum,
            read.difference,
        ) {
            (true, true) => rows.extend([(own, s.own()), (other, s.other())]),
            (true, false) => rows.push((format!("{own} + {other}"), s.sum)),
            (false, true) => rows.push((format!("{own} - {other}"), s.difference)),
            (false, false) => {}
        };
        for (axis, kind, s, read) in [
            ('X', 'A', self.xa, axial),
            ('Y', 'A', self.ya, transverse),
            ('Y', 'B', self.yb, transverse),
            ('X', 'C', self.xc, twist),
            ('Y', 'C', self.yc, crossed),
        ] {
            push(
                [format!("{axis}11{kind}"), format!("{axis}12{kind}")],
                s,
                read,
            );
        }
        for (n, mode) in (1..).zip(self.modes()) {
            for (name, s, read) in [
                ("XF", mode.xf, axial),
                ("YF", mode.yf, transverse),
                ("YT", mode.yt, crossed),
            ] {
                push([format!("{name}1_{n}"), format!("{name}2_{n}")], s, read);
            }
        }
        rows
    }

    /// The largest error of a scalar against `truth`, which holds the same set, and its name. Errors are
    /// relative to the larger of the load and 1; to the larger of the load and 4 for the thrusts `XF1_1` and
    /// `YF1_1`, which are 4 of a lone squirmer.
    #[must_use]
    pub fn worst_error(&self, truth: &Self) -> (String, f64) {
        let both = self.named().into_iter().zip(truth.named());
        both.map(|((name, value), (_, truth))| {
            let thrust = matches!(name.as_str(), "XF1_1" | "YF1_1");
            let scale = truth.abs().max(if thrust { 4.0 } else { 1.0 });
            (name, (value - truth).abs() / scale)
        })
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or_default()
    }
}

#[cfg(test)]
pub(crate) mod tests;
