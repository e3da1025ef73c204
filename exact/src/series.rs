//! All loads of a pair from the bispherical series: two parities of two problems, and the twist.
//!
//! Sphere 1 alone moving or squirming is half the sum of the even and the odd problem, and the load
//! on sphere 2 is the mirror image of half their difference. A mirror turns round axial forces and
//! transverse torques; so the sum of the scalars of sphere 1 and 2 is the odd problem there, the
//! even one for transverse forces and axial torques.

use scene::{LoadSet, PairLoads, Parities, SelfOther, SwirlLoads};

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

/// The problems of both parities, as far as they are called for.
struct EvenOdd<T> {
    even: Option<T>,
    odd: Option<T>,
}

impl<T> EvenOdd<T> {
    fn new(
        [even, odd]: [bool; 2],
        solve: impl Fn(Parity) -> Result<T, ExactError>,
    ) -> Result<Self, ExactError> {
        Ok(Self {
            even: even.then(|| solve(Parity::Even)).transpose()?,
            odd: odd.then(|| solve(Parity::Odd)).transpose()?,
        })
    }

    fn solved(&self) -> impl Iterator<Item = &T> {
        self.even.iter().chain(&self.odd)
    }

    /// Sets what was solved of a load whose sum is that of the even problem.
    fn even_is_sum(&self, of: &mut SelfOther, load: impl Fn(&T) -> f64) {
        of.sum = self.even.as_ref().map_or(of.sum, &load);
        of.difference = self.odd.as_ref().map_or(of.difference, &load);
    }

    fn odd_is_sum(&self, of: &mut SelfOther, load: impl Fn(&T) -> f64) {
        of.sum = self.odd.as_ref().map_or(of.sum, &load);
        of.difference = self.even.as_ref().map_or(of.difference, &load);
    }
}

impl Solved {
    /// Solves at the gap `eps`, with `factor` times the terms that reach rounding.
    pub fn new(eps: f64, set: LoadSet, factor: f64) -> Result<Self, ExactError> {
        check(set)?;
        let modes = set.modes;
        let geometry = Geometry::new(eps, modes.max(set.swirl), factor)?;
        // Axial forces are turned round by the mirror.
        let Parities { sum, difference } = set.axial;
        let across =
            [set.transverse.sum, set.transverse.difference].map(|read| read || set.swirl > 0);
        let transverse = || EvenOdd::new(across, |parity| Transverse::solve(geometry, parity, set));
        Ok(Self {
            geometry,
            set,
            axial: EvenOdd::new([difference, sum], |parity| {
                Axial::solve(geometry, parity, modes)
            })?,
            transverse: (set.transverse.any() || set.swirl > 0)
                .then(transverse)
                .transpose()?,
        })
    }

    /// The loads.
    pub fn loads(&self) -> PairLoads {
        // What was not solved is left as that of lone spheres.
        let mut loads = PairLoads::isolated(self.set);
        self.axial.odd_is_sum(&mut loads.xa, |a| a.force(0) / -6.0);
        for (k, mode) in loads.modes_mut().iter_mut().enumerate() {
            self.axial.odd_is_sum(&mut mode.xf, |a| a.force(1 + k));
        }
        if self.set.twist {
            loads.xc = twist::axial_rotation(&self.geometry);
        }
        if let Some(transverse) = &self.transverse {
            transverse.even_is_sum(&mut loads.ya, |t| t.force(TRANSLATION) / -6.0);
            // The force by rotation has fewer cancelling terms than the torque by translation.
            transverse.even_is_sum(&mut loads.yb, |t| t.force(ROTATION) / 4.0);
            transverse.odd_is_sum(&mut loads.yc, |t| t.torque(ROTATION) / -8.0);
            for (k, mode) in loads.modes_mut().iter_mut().enumerate() {
                transverse.even_is_sum(&mut mode.yf, |t| t.force(t.squirming(1 + k)));
                transverse.odd_is_sum(&mut mode.yt, |t| t.torque(t.squirming(1 + k)));
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
            transverse.even_is_sum(&mut mode.yfc, |t| t.force(t.swirl(k)));
            // Along `p_t`, which is opposed to `d x t`.
            transverse.odd_is_sum(&mut mode.ytc, |t| -t.torque(t.swirl(k)));
        }
        loads
    }

    /// The loads by swirl again, torques from the axial field.
    fn swirl_loads_by_second_formula(&self) -> SwirlLoads {
        let mut loads = self.swirl_loads();
        if let Some(transverse) = &self.transverse {
            for (k, mode) in (1..).zip(loads.modes_mut()) {
                transverse.odd_is_sum(&mut mode.ytc, |t| -t.torque_by_axial_field(t.swirl(k)));
            }
        }
        loads
    }

    /// The loads again where a second formula gives them: torques from the axial field, and `YB`
    /// from the torque by translation instead of the force by rotation.
    fn loads_by_second_formula(&self) -> PairLoads {
        let mut loads = self.loads();
        if let Some(transverse) = &self.transverse {
            transverse.even_is_sum(&mut loads.yb, |t| t.torque(TRANSLATION) / 4.0);
            transverse.odd_is_sum(&mut loads.yc, |t| t.torque_by_axial_field(ROTATION) / -8.0);
            for (k, mode) in loads.modes_mut().iter_mut().enumerate() {
                transverse.odd_is_sum(&mut mode.yt, |t| {
                    t.torque_by_axial_field(t.squirming(1 + k))
                });
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
        let axial = self
            .axial
            .solved()
            .map(|flow| axial_residual(flow, &points));
        let transverse = (self.transverse.iter().flat_map(EvenOdd::solved))
            .map(|flow| transverse_residual(flow, &points));
        axial.chain(transverse).fold(0.0, f64::max)
    }
}
