//! All loads of a pair from the bispherical series: two parities of two problems, and the twist.
//!
//! Sphere 1 alone moving or squirming is half the sum of the even and the odd problem, and the load
//! on sphere 2 is the mirror image of half their difference. A mirror turns round axial forces and
//! transverse torques; so the sum of the scalars of sphere 1 and 2 is the odd problem there, the
//! even one for transverse forces and axial torques.

use scene::{LoadSet, PairLoads, SelfOther, SwirlLoads};

use crate::ExactError;
use crate::axial::Axial;
use crate::error::check;
use crate::field::{SurfacePoint, axial_residual, scattered_points, transverse_residual};
use crate::geometry::{Geometry, Parity};
use crate::transverse::{ROTATION, TRANSLATION, Transverse};
use crate::twist;

/// The solved problems of one gap.
pub struct Solved {
    geometry: Geometry,
    set: LoadSet,
    axial: EvenOdd<Axial>,
    transverse: Option<EvenOdd<Transverse>>,
}

struct EvenOdd<T> {
    even: T,
    odd: T,
}

impl<T> EvenOdd<T> {
    fn new(solve: impl Fn(Parity) -> Result<T, ExactError>) -> Result<Self, ExactError> {
        Ok(Self {
            even: solve(Parity::Even)?,
            odd: solve(Parity::Odd)?,
        })
    }

    fn even_is_sum(&self, load: impl Fn(&T) -> f64) -> SelfOther {
        SelfOther {
            sum: load(&self.even),
            difference: load(&self.odd),
        }
    }

    fn odd_is_sum(&self, load: impl Fn(&T) -> f64) -> SelfOther {
        SelfOther {
            sum: load(&self.odd),
            difference: load(&self.even),
        }
    }
}

impl Solved {
    /// Solves at the gap `eps`, with `factor` times the terms that reach rounding.
    pub fn new(eps: f64, set: LoadSet, factor: f64) -> Result<Self, ExactError> {
        check(set)?;
        let modes = set.modes;
        let geometry = Geometry::new(eps, modes.max(set.swirl), factor)?;
        let across = || EvenOdd::new(|parity| Transverse::solve(geometry, parity, set));
        Ok(Self {
            geometry,
            set,
            axial: EvenOdd::new(|parity| Axial::solve(geometry, parity, modes))?,
            transverse: (set.transverse || set.swirl > 0).then(across).transpose()?,
        })
    }

    /// The loads.
    pub fn loads(&self) -> PairLoads {
        let mut loads = PairLoads::zero(self.set);
        loads.xa = self.axial.odd_is_sum(|a| a.force(0) / -6.0);
        for (k, mode) in loads.modes_mut().iter_mut().enumerate() {
            mode.xf = self.axial.odd_is_sum(|a| a.force(1 + k));
        }
        if self.set.twist {
            loads.xc = twist::axial_rotation(&self.geometry);
        }
        if let Some(transverse) = &self.transverse {
            loads.ya = transverse.even_is_sum(|t| t.force(TRANSLATION) / -6.0);
            // The force by rotation has fewer cancelling terms than the torque by translation.
            loads.yb = transverse.even_is_sum(|t| t.force(ROTATION) / 4.0);
            loads.yc = transverse.odd_is_sum(|t| t.torque(ROTATION) / -8.0);
            for (k, mode) in loads.modes_mut().iter_mut().enumerate() {
                mode.yf = transverse.even_is_sum(|t| t.force(t.squirming(1 + k)));
                mode.yt = transverse.odd_is_sum(|t| t.torque(t.squirming(1 + k)));
            }
        }
        loads
    }

    /// All columns of the loads: those of the pair, then those by swirl.
    pub fn columns(&self) -> Vec<f64> {
        let swirl = self.swirl_loads();
        self.loads().columns().chain(swirl.columns()).collect()
    }

    /// The same by a second formula where there is one.
    pub fn columns_by_second_formula(&self) -> Vec<f64> {
        let swirl = self.swirl_loads_by_second_formula();
        (self.loads_by_second_formula().columns())
            .chain(swirl.columns())
            .collect()
    }

    /// The loads by swirl.
    pub fn swirl_loads(&self) -> SwirlLoads {
        let mut loads = SwirlLoads::zero(self.set);
        let Some(transverse) = &self.transverse else {
            return loads;
        };
        let twists = twist::swirl(&self.geometry, self.set.swirl);
        for ((k, mode), xtc) in (1..).zip(loads.modes_mut()).zip(twists) {
            mode.xtc = xtc;
            mode.yfc = transverse.even_is_sum(|t| t.force(t.swirl(k)));
            // Along `p_t`, which is opposed to `d x t`.
            mode.ytc = transverse.odd_is_sum(|t| -t.torque(t.swirl(k)));
        }
        loads
    }

    /// The loads by swirl again, torques from the axial field.
    fn swirl_loads_by_second_formula(&self) -> SwirlLoads {
        let mut loads = self.swirl_loads();
        if let Some(transverse) = &self.transverse {
            for (k, mode) in (1..).zip(loads.modes_mut()) {
                mode.ytc = transverse.odd_is_sum(|t| -t.torque_by_axial_field(t.swirl(k)));
            }
        }
        loads
    }

    /// The loads again where a second formula gives them: torques from the axial field, and `YB`
    /// from the torque by translation instead of the force by rotation.
    fn loads_by_second_formula(&self) -> PairLoads {
        let mut loads = self.loads();
        if let Some(transverse) = &self.transverse {
            loads.yb = transverse.even_is_sum(|t| t.torque(TRANSLATION) / 4.0);
            loads.yc = transverse.odd_is_sum(|t| t.torque_by_axial_field(ROTATION) / -8.0);
            for (k, mode) in loads.modes_mut().iter_mut().enumerate() {
                mode.yt = transverse.odd_is_sum(|t| t.torque_by_axial_field(t.squirming(1 + k)));
            }
        }
        loads
    }
}

impl Solved {
    /// Largest difference between the solved flows and their boundary velocities (of order 1) at
    /// `2 count` surface points, none of which the solution knows of.
    pub fn residual(&self, count: usize) -> f64 {
        let points: Vec<SurfacePoint> = scattered_points(&self.geometry, count)
            .into_iter()
            .map(|mu| SurfacePoint::new(self.geometry, mu))
            .collect();
        let axial = [&self.axial.even, &self.axial.odd].map(|flow| axial_residual(flow, &points));
        let transverse = (self
            .transverse
            .iter()
            .flat_map(|flows| [&flows.even, &flows.odd]))
        .map(|flow| transverse_residual(flow, &points));
        axial.into_iter().chain(transverse).fold(0.0, f64::max)
    }
}
