//! The parts of the pair loads that diverge at contact, for equal spheres.
//!
//! With `L = ln(1/eps)`: rigid motions after Jeffrey & Onishi, *J. Fluid Mech.* 139 (1984) 261, and
//! Kim & Karrila, *Microhydrodynamics* (2005), chapter 9; squirming after Ishikawa, Simmonds &
//! Pedley, *J. Fluid Mech.* 568 (2006) 119, with the axial factor 3 that zero net flux gives.

use scene::{Gap, PairLoads, SelfOther};

/// The diverging parts at `gap`, of `modes` squirming modes.
pub fn loads(gap: Gap, modes: usize) -> PairLoads {
    let log = gap.log_inverse();
    let opposed = |own: f64| SelfOther {
        sum: 0.0,
        difference: 2.0 * own,
    };
    let mut loads = PairLoads::zero(modes);
    loads.xa = opposed(0.25 / gap.eps() + 9.0 / 40.0 * log);
    loads.ya = opposed(log / 6.0);
    loads.yb = opposed(-0.25 * log);
    loads.yc = SelfOther {
        sum: 0.25 * log,
        difference: 0.15 * log,
    };
    for mode in loads.modes_mut() {
        mode.xf = opposed(3.0 * log);
        mode.yf = opposed(log);
        mode.yt = SelfOther {
            sum: 2.0 * log,
            difference: 1.2 * log,
        };
    }
    loads
}
