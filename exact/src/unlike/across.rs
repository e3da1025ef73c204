//! The loads across the line of centres, by one active sphere.

use std::f64::consts::SQRT_2;

use scene::{ActiveLoads, LoadSet, SelfOther};

use super::geometry::Pair;
use super::lorentz::Lorentz;
use super::series::times;
use super::system::{Charge, NOMINAL, PairSeries};
use crate::geometry::Geometry;
use crate::transverse::{self, ROTATION, TRANSLATION};

/// How loads are found: the formulas agree up to rounding and truncation.
#[derive(Clone, Copy, PartialEq)]
pub enum Formula {
    /// By the singular part of the mean velocity across, but on a much larger sphere by the reciprocal theorem.
    First,
    /// Torques from the singular part of the axial velocity.
    Second,
    /// All by a sphere's own singular parts.
    #[cfg(test)]
    Charges,
}

impl Formula {
    fn is_reciprocal(self) -> bool {
        matches!(self, Self::First | Self::Second)
    }
}

/// Radius over the active sphere's from which on a sphere's own singular parts lose digits. For like spheres they lose none, but
/// slip velocities on the active sphere, which the reciprocal theorem needs, are not resolved.
const MUCH_LARGER: f64 = 1.5;

/// The solved flows with what is needed for the loads by one sphere.
pub struct Across<'a> {
    pair: &'a Pair,
    series: &'a PairSeries,
    active: usize,
    set: LoadSet,
    formula: Formula,
    /// Loads on the other sphere, if it is much larger.
    on_larger_other: Option<Lorentz>,
    /// Loads on the active sphere, if it is the one that is much larger.
    on_larger_own: Option<Lorentz>,
}

impl<'a> Across<'a> {
    /// The loads of `set` by the sphere `active`.
    pub fn new(
        pair: &'a Pair,
        series: &'a PairSeries,
        (active, set): (usize, LoadSet),
        formula: Formula,
    ) -> Self {
        let mut across = Self {
            pair,
            series,
            active,
            set,
            formula,
            on_larger_other: None,
            on_larger_own: None,
        };
        let other_over_own = pair.spheres[active].sinh / pair.spheres[1 - active].sinh;
        if !formula.is_reciprocal() {
            return across;
        }
        if other_over_own > MUCH_LARGER {
            let case = |motion| across.other_way_round().case(motion);
            let lorentz = Lorentz::by_smaller(pair, active, (series, case), set);
            across.on_larger_other = Some(lorentz);
        } else if other_over_own < 1.0 / MUCH_LARGER {
            let case = |motion| across.case(motion);
            let lorentz = Lorentz::by_larger(pair, 1 - active, (series, case), set);
            across.on_larger_own = Some(lorentz);
        }
        across
    }

    /// The loads by the other sphere.
    fn other_way_round(&self) -> Self {
        Self {
            active: 1 - self.active,
            on_larger_other: None,
            on_larger_own: None,
            ..*self
        }
    }

    /// Adds them.
    pub fn add_to(&self, loads: &mut ActiveLoads) {
        loads.pair.ya += times(-1.0 / 6.0, self.forces(TRANSLATION));
        loads.pair.yb += times(0.25, self.forces(ROTATION));
        loads.pair.yc += times(-1.0 / 8.0, self.torques(ROTATION));
        loads.torque_on_other += 0.25 * self.torques(TRANSLATION).other();
        for (k, mode) in (1..).zip(loads.pair.modes_mut()) {
            mode.yf += self.forces(ROTATION + k);
            mode.yt += self.torques(ROTATION + k);
        }
        for (k, mode) in (1..).zip(loads.swirl.modes_mut()) {
            let case = ROTATION + self.set.modes + k;
            mode.yfc += self.forces(case);
            // Along `p_t`, which is opposed to `d x t`.
            mode.ytc += times(-1.0, self.torques(case));
        }
    }

    fn case(&self, case: usize) -> usize {
        self.active * (1 + ROTATION + self.set.modes + self.set.swirl) + case
    }

    /// Forces of the fluid along `t`, over `pi`, in units of the active sphere's radius.
    fn forces(&self, case: usize) -> SelfOther {
        let other = match &self.on_larger_other {
            Some(_) if case <= ROTATION => self.reciprocal(case).0,
            Some(lorentz) => lorentz.force(case),
            None => self.force(1 - self.active, case),
        };
        let own = match &self.on_larger_own {
            Some(lorentz) => lorentz.force(case),
            None => self.force(self.active, case),
        };
        SelfOther::new(own, other)
    }

    /// Torques of the fluid about each one's centre along `d x t`, over `pi`, in units of the active sphere's radius.
    fn torques(&self, case: usize) -> SelfOther {
        let of = |sphere| match self.formula {
            Formula::Second => self.torque_by_axial_field(sphere, case),
            _ => self.torque(sphere, case),
        };
        let other = match &self.on_larger_other {
            Some(_) if case <= ROTATION => self.reciprocal(case).1,
            Some(lorentz) => lorentz.torque(case),
            // Each sphere has its own `d`.
            None => -of(1 - self.active),
        };
        let own = match &self.on_larger_own {
            Some(lorentz) => lorentz.torque(case),
            None => of(self.active),
        };
        SelfOther::new(own, other)
    }

    /// Force and torque on the other sphere by a rigid motion, from loads on this one by motions of the other.
    fn reciprocal(&self, case: usize) -> (f64, f64) {
        let back = self.other_way_round();
        let [force, torque] = [TRANSLATION, ROTATION].map(|motion| {
            if case == TRANSLATION {
                back.force(self.active, motion)
            } else {
                // Along this sphere's own `d x t`.
                back.torque(self.active, motion)
            }
        });
        // What is measured along `d x t` of either sphere has the other sign for the other one.
        let q = self.scale() / back.scale();
        if case == TRANSLATION {
            (q * force, -q * q * torque)
        } else {
            (q * q * force, -q * q * q * torque)
        }
    }

    fn scale(&self) -> f64 {
        self.pair.spheres[self.active].sinh
    }

    fn force(&self, sphere: usize, case: usize) -> f64 {
        -4.0 * SQRT_2 * self.scale() * self.mean(sphere, case, Charge::Force)
    }

    fn torque(&self, sphere: usize, case: usize) -> f64 {
        let scale = self.scale() * (self.scale() / self.pair.spheres[sphere].sinh);
        4.0 * SQRT_2 * scale * self.mean(sphere, case, Charge::Torque)
    }

    fn torque_by_axial_field(&self, sphere: usize, case: usize) -> f64 {
        let field = transverse::Fields::new(1, NOMINAL).axial;
        let dipole = (self.series).charge(sphere, field, self.case(case), Charge::Dipole);
        let Geometry { sinh, cosh, .. } = self.pair.spheres[sphere];
        let height = cosh * (self.scale() / sinh);
        -8.0 * SQRT_2 * self.scale().powi(2) * dipole + height * self.force(sphere, case)
    }

    fn mean(&self, sphere: usize, case: usize, charge: Charge) -> f64 {
        let field = transverse::Fields::new(1, NOMINAL).mean;
        (self.series).charge(sphere, field, self.case(case), charge)
    }
}
