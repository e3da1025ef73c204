//! The parts of the pair loads that diverge at contact.
//!
//! With `L = ln(1/eps)`: rigid motions after Jeffrey & Onishi (1984) and Kim & Karrila,
//! *Microhydrodynamics* (2005), chapter 9; squirming after Brumley & Pedley, Phys. Rev. Fluids 4
//! (2019) 053102. Lubrication theory adds these to the isolated loads, the near-contact
//! form of exact loads to what is left, which is smooth.

use crate::{
    ActiveLoads, Gap, LoadSet, ModeLoads, PairLoads, SelfOther, SwirlLoads, SwirlModeLoads,
};

/// Coefficient of `L` in the axial squirming force `XF1_n = -XF2_n`, every mode alike.
///
/// Zero net flux through the gap gives the pressure gradient `6 mu u_s / h^2` and with it
/// `12 lambda^2/(1 + lambda)^2`, that is 3 for equal spheres; exact solutions have this slope.
pub const AXIAL_SQUIRMING: f64 = 3.0;

/// The diverging parts at one gap, when one sphere moves or squirms; every squirming mode has the same, `X11C` and `X12C` have none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singular {
    /// Of `X11A, X12A`.
    pub xa: SelfOther,
    /// Of `Y11A, Y12A`.
    pub ya: SelfOther,
    /// Of `Y11B, Y12B`.
    pub yb: SelfOther,
    /// Of `Y11C, Y12C`.
    pub yc: SelfOther,
    /// Of each squirming mode.
    pub mode: ModeLoads,
}

/// Opposed loads on the two spheres.
fn opposed(own: f64) -> SelfOther {
    SelfOther {
        sum: 0.0,
        difference: 2.0 * own,
    }
}

impl Singular {
    /// The parts for equal spheres at `gap`, with the coefficient `axial_squirming` in front of the logarithm of
    /// `XF1_n`.
    #[inline]
    #[must_use]
    pub fn at(gap: Gap, axial_squirming: f64) -> Self {
        let log = gap.log_inverse();
        Self {
            xa: opposed(0.25 / gap.eps() + 9.0 / 40.0 * log),
            ya: opposed(log * (1.0 / 6.0)),
            yb: opposed(-0.25 * log),
            yc: SelfOther {
                sum: 0.25 * log,
                difference: 0.15 * log,
            },
            mode: ModeLoads {
                xf: opposed(axial_squirming * log),
                yf: opposed(log),
                yt: SelfOther {
                    sum: 2.0 * log,
                    difference: 1.2 * log,
                },
            },
        }
    }
}

/// The diverging parts of `set` for equal spheres at `gap`, with the coefficient `axial_squirming` in front of the
/// logarithm of `XF1_n`.
///
/// ```
/// use scene::{Gap, LoadSet, singular};
/// let gap = Gap::new(0.01)?;
/// let loads = singular::loads(gap, LoadSet::all(2), singular::AXIAL_SQUIRMING);
/// assert!((loads.xa.own() - (25.0 + 9.0 / 40.0 * gap.log_inverse())).abs() < 1e-13);
/// assert!((loads.modes()[1].xf.other() + 3.0 * gap.log_inverse()).abs() < 1e-13);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[inline]
#[must_use]
pub fn loads(gap: Gap, set: LoadSet, axial_squirming: f64) -> PairLoads {
    let Singular {
        xa,
        ya,
        yb,
        yc,
        mode,
    } = Singular::at(gap, axial_squirming);
    PairLoads::from_parts([xa, ya, yb, SelfOther::default(), yc], set, |_| mode)
}

/// The diverging parts of the loads of equal spheres by swirl, every mode alike: at the contact point the slip of each
/// mode is that of rigid rotation, and so are the logarithms, `YFC = -4 YB` and `YTC = -8 YC`.
///
/// ```
/// use scene::{Gap, LoadSet, singular};
/// let gap = Gap::new(0.01)?;
/// let loads = singular::swirl(gap, LoadSet::all(0).with_swirl(3));
/// assert!((loads.modes()[2].ytc.own() + 1.6 * gap.log_inverse()).abs() < 1e-13);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[inline]
#[must_use]
pub fn swirl(gap: Gap, set: LoadSet) -> SwirlLoads {
    let log = gap.log_inverse();
    let mode = SwirlModeLoads {
        xtc: SelfOther::default(),
        yfc: SelfOther {
            sum: 0.0,
            difference: 2.0 * log,
        },
        ytc: SelfOther {
            sum: -2.0 * log,
            difference: -1.2 * log,
        },
    };
    SwirlLoads::from_modes(set, |_| mode)
}

/// The diverging parts of the loads of both spheres, whose radii are in the given `ratio`, each when it is the active one; `axial_squirming` is
/// the coefficient for equal spheres. The logarithm is that of the smaller radius over the gap.
///
/// With `q` the radius of the other sphere over that of the active one and `o = 1 + q`: `XA = q^2/(o^2 eps) + q (1 + 7 q + q^2)/(5 o^3) L` with the gap in
/// radii of the active sphere, `YA = 4 q (2 + q + 2 q^2)/(15 o^3) L`, `YB = -q (4 + q)/(5 o^2) L`, `YC = 2 q/(5 o) L` and on the other
/// sphere `q^2/(10 o) L` (Jeffrey & Onishi 1984, Kim & Karrila 2005); `XF` in proportion to `q^2/o^2`, `YF = 4 q (q + 4)/(5 o^2) L`, `YT = 16 q/(5 o) L` and
/// `4 q^2/(5 o) L` (Darveniza et al. 2022).
///
/// ```
/// use scene::{Gap, LoadSet, singular};
/// let (gap, set) = (Gap::new(0.01)?, LoadSet::all(1));
/// let [small, large] = singular::of_each(gap, 2.0, set, singular::AXIAL_SQUIRMING);
/// // Forces at contact are opposed: the same on sphere 1 by either, in units of each one's radius.
/// let (by_small, by_large) = (small.pair.xa.own(), 2.0 * large.pair.xa.other());
/// assert!((by_small + by_large).abs() < 1e-12);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[must_use]
pub fn of_each(gap: Gap, ratio: f64, set: LoadSet, axial_squirming: f64) -> [ActiveLoads; 2] {
    let log = gap.log_inverse() + ratio.min(1.0).ln();
    [(1.0, ratio), (ratio, 1.0 / ratio)].map(|(active, q)| {
        let (singular, torque_on_other) = active_part(gap.eps() / active, log, q, axial_squirming);
        let [yb, yc] = [singular.yb, singular.yc];
        let rigid = [singular.xa, singular.ya, yb, SelfOther::default(), yc];
        let times = |factor: f64, s: SelfOther| SelfOther {
            sum: factor * s.sum,
            difference: factor * s.difference,
        };
        ActiveLoads {
            pair: PairLoads::from_parts(rigid, set, |_| singular.mode),
            torque_on_other,
            swirl: SwirlLoads::from_modes(set, |_| SwirlModeLoads {
                xtc: SelfOther::default(),
                yfc: times(-4.0, yb),
                ytc: times(-8.0, yc),
            }),
        }
    })
}

/// Of one active sphere, at a gap in its own radii, with the logarithm `log` and the other radius over its own, `q`; the torque on the other
/// sphere by its translation besides.
fn active_part(eps: f64, log: f64, q: f64, axial_squirming: f64) -> (Singular, f64) {
    let o = 1.0 + q;
    let (o2, o3) = (o * o, o * o * o);
    let squeeze = q * (1.0 + 7.0 * q + q * q) / (5.0 * o3);
    let shear = 4.0 * q * (2.0 + q + 2.0 * q * q) / (15.0 * o3);
    let spin = q * (4.0 + q) / (5.0 * o2);
    let of_log = |own: f64, other: f64| SelfOther::new(own * log, other * log);
    let singular = Singular {
        xa: opposed(q * q / (o2 * eps) + squeeze * log),
        ya: opposed(shear * log),
        yb: opposed(-spin * log),
        yc: of_log(2.0 * q / (5.0 * o), q * q / (10.0 * o)),
        mode: ModeLoads {
            xf: opposed(axial_squirming * 4.0 * q * q / o2 * log),
            yf: opposed(4.0 * spin * log),
            yt: of_log(16.0 * q / (5.0 * o), 4.0 * q * q / (5.0 * o)),
        },
    };
    (singular, -q * q * (1.0 + 4.0 * q) / (5.0 * o2) * log)
}
