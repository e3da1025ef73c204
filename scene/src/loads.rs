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

/// Highest squirming mode that a [`PairLoads`] can hold.
pub const MAX_MODES: usize = 8;

/// Columns of the resistance scalars in [`PairLoads::columns`].
const RIGID_COLUMNS: usize = 10;

/// Columns of one squirming mode in [`PairLoads::columns`].
const MODE_COLUMNS: usize = 6;

/// Columns of all loads with `modes` squirming modes.
pub(crate) const fn column_count(modes: usize) -> usize {
    RIGID_COLUMNS + MODE_COLUMNS * modes
}

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

/// All loads of a pair at one gap. See the [module](self) for definitions and signs.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    count: usize,
}

impl PairLoads {
    /// From the resistance scalars `[xa, ya, yb, xc, yc]` and the loads by each of `modes` squirming
    /// modes (at most [`MAX_MODES`]), counted from 0.
    #[inline]
    #[must_use]
    pub fn from_parts(
        [xa, ya, yb, xc, yc]: [SelfOther; 5],
        modes: usize,
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
            modes: std::array::from_fn(|n| if n < modes { mode(n) } else { NO_LOADS }),
            count: modes.min(MAX_MODES),
        }
    }

    /// Loads of two spheres infinitely far apart, with `modes` squirming modes (at most
    /// [`MAX_MODES`]): unit drag, thrust `4 pi mu a B_1` of the first mode, all else zero.
    #[inline]
    #[must_use]
    pub fn isolated(modes: usize) -> Self {
        let zero = SelfOther::default();
        let unit = SelfOther::new(1.0, 0.0);
        let thrust = SelfOther::new(4.0, 0.0);
        Self::from_parts([unit, unit, zero, unit, unit], modes, |n| ModeLoads {
            xf: if n == 0 { thrust } else { zero },
            yf: if n == 0 { thrust } else { zero },
            yt: zero,
        })
    }

    /// All scalars zero, with room for `modes` squirming modes (at most [`MAX_MODES`]).
    #[inline]
    #[must_use]
    pub fn zero(modes: usize) -> Self {
        Self::from_parts([SelfOther::default(); 5], modes, |_| NO_LOADS)
    }

    /// Loads by the squirming modes `n = 1, 2, ...`, in this order.
    #[inline]
    #[must_use]
    pub fn modes(&self) -> &[ModeLoads] {
        &self.modes[..self.count]
    }

    /// The same, to fill in.
    #[inline]
    pub fn modes_mut(&mut self) -> &mut [ModeLoads] {
        &mut self.modes[..self.count]
    }

    /// Number of `f64` in [`Self::columns`] for `modes` squirming modes.
    #[must_use]
    pub const fn column_count(modes: usize) -> usize {
        column_count(modes)
    }

    /// All scalars in a fixed order (sum, difference; A, B, C, then mode by mode), for tables.
    pub fn columns(&self) -> impl Iterator<Item = f64> + '_ {
        let rigid = [self.xa, self.ya, self.yb, self.xc, self.yc];
        let modes = self.modes().iter().flat_map(|m| [m.xf, m.yf, m.yt]);
        rigid
            .into_iter()
            .chain(modes)
            .flat_map(|s| [s.sum, s.difference])
    }

    /// The inverse of [`Self::columns`]; missing values stay zero, surplus ones are ignored.
    #[inline]
    #[must_use]
    pub fn from_columns(modes: usize, columns: &[f64]) -> Self {
        let pair = |k: usize| match columns.get(2 * k..2 * k + 2) {
            Some(&[sum, difference]) => SelfOther { sum, difference },
            _ => SelfOther::default(),
        };
        Self::from_parts([0, 1, 2, 3, 4].map(pair), modes, |n| {
            let k = (RIGID_COLUMNS + MODE_COLUMNS * n) / 2;
            ModeLoads {
                xf: pair(k),
                yf: pair(k + 1),
                yt: pair(k + 2),
            }
        })
    }

    /// Every scalar with its published name: `X11A, X12A, Y11A, ..., XF1_1, XF2_1, ..., YT2_n`.
    #[must_use]
    pub fn named(&self) -> Vec<(String, f64)> {
        let mut rows = Vec::with_capacity(Self::column_count(self.count));
        for (axis, kind, s) in [
            ('X', 'A', self.xa),
            ('Y', 'A', self.ya),
            ('Y', 'B', self.yb),
            ('X', 'C', self.xc),
            ('Y', 'C', self.yc),
        ] {
            rows.push((format!("{axis}11{kind}"), s.own()));
            rows.push((format!("{axis}12{kind}"), s.other()));
        }
        for (n, mode) in (1..).zip(self.modes()) {
            for (name, s) in [("XF", mode.xf), ("YF", mode.yf), ("YT", mode.yt)] {
                rows.push((format!("{name}1_{n}"), s.own()));
                rows.push((format!("{name}2_{n}"), s.other()));
            }
        }
        rows
    }
}
