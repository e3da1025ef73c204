//! The parts of the pair loads that diverge at contact, for equal spheres.
//!
//! With `L = ln(1/eps)`: rigid motions after Jeffrey & Onishi (1984) and Kim & Karrila,
//! *Microhydrodynamics* (2005), chapter 9; squirming after Brumley & Pedley, Phys. Rev. Fluids 4
//! (2019) 053102. Lubrication theory adds these to the isolated loads, the near-contact
//! form of exact loads to what is left, which is smooth.

use crate::{Gap, LoadSet, ModeLoads, PairLoads, SelfOther, SwirlLoads, SwirlModeLoads};

/// Coefficient of `L` in the axial squirming force `XF1_n = -XF2_n`, every mode alike.
///
/// Zero net flux through the gap gives the pressure gradient `6 mu u_s / h^2` and with it
/// `12 lambda^2/(1 + lambda)^2`, that is 3 for equal spheres; exact solutions have this slope.
pub const AXIAL_SQUIRMING: f64 = 3.0;

/// The diverging parts at one gap; every squirming mode has the same, `X11C` and `X12C` have none.
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

impl Singular {
    /// The parts at `gap`, with the coefficient `axial_squirming` in front of the logarithm of
    /// `XF1_n`.
    #[inline]
    #[must_use]
    pub fn at(gap: Gap, axial_squirming: f64) -> Self {
        let log = gap.log_inverse();
        let opposed = |own: f64| SelfOther {
            sum: 0.0,
            difference: 2.0 * own,
        };
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

/// The diverging parts of `set` at `gap`, with the coefficient `axial_squirming` in front of the
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

/// The diverging parts of the loads by swirl, every mode alike: at the contact point the slip of each
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
