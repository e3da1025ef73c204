//! A pair at one instant of a run: its stresslets, power and efficiency, and those of two lone squirmers.

use scene::nalgebra::Matrix3;
use scene::stress::{PairStress, StressTable, drag_power, lone_power, lone_stresslet};
use scene::{Fluid, Hydrodynamics, MovingPair, Plan, Sample};

use crate::CompareError;

/// The independent components of a stresslet: `xx, xy, xz, yy, yz`.
pub(super) const COMPONENTS: [(usize, usize); 5] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2)];

/// An instant of a run.
pub struct Instant {
    /// Time from the start.
    pub t: f64,
    /// The pair as it moves.
    pub pair: MovingPair,
    /// Stresslets and power.
    pub stress: PairStress,
    /// Stresslets of lone squirmers with these orientations.
    pub lone: [Matrix3<f64>; 2],
}

impl Instant {
    /// The pair of a sample, which moves as `model` says.
    pub(super) fn new(
        plan: &Plan,
        model: &dyn Hydrodynamics,
        table: &StressTable,
        sample: &Sample,
    ) -> Result<Self, CompareError> {
        let pair = MovingPair::free(plan, model, &sample.configuration)?;
        let stress = table.at(sample.configuration.gap)?.of(&pair);
        Ok(Self::of(sample.t, pair, stress))
    }

    /// A pair that moves as it does at the time `t`, its stresslets and power solved for.
    ///
    /// # Errors
    /// As [`Fluid::stresses`].
    pub fn solved(fluid: &dyn Fluid, t: f64, pair: MovingPair) -> Result<Self, CompareError> {
        let modes = pair.squirmers.iter().map(|s| s.modes().len()).max();
        let swirl = pair.squirmers.iter().map(|s| s.swirl().len()).max();
        let gap = pair.configuration.gap;
        let stresses = fluid.stresses(gap, modes.unwrap_or(0), swirl.unwrap_or(0))?;
        let stress = stresses.of(&pair);
        Ok(Self::of(t, pair, stress))
    }

    fn of(t: f64, pair: MovingPair, stress: PairStress) -> Self {
        Self {
            t,
            lone: [0, 1].map(|k| lone_stresslet(&pair, k)),
            pair,
            stress,
        }
    }

    pub(super) fn gap(&self) -> f64 {
        self.pair.configuration.gap.eps()
    }

    /// Stresslet of the pair beyond that of two lone squirmers.
    pub(super) fn excess(&self) -> Matrix3<f64> {
        let [one, two] = self.stress.stresslets;
        one + two - self.lone[0] - self.lone[1]
    }

    /// Largest size of a squirmer's stresslet over that of the lone one; NaN where a lone one has none.
    pub(super) fn growth(&self) -> f64 {
        let of = |k: usize| self.stress.stresslets[k].norm() / self.lone[k].norm();
        let (one, two) = (of(0), of(1));
        if one.is_finite() && two.is_finite() {
            one.max(two)
        } else {
            f64::NAN
        }
    }

    /// Rate of work of both squirmers' slip.
    pub(super) fn slip_power(&self) -> f64 {
        self.stress.slip_power.iter().sum()
    }

    /// The same beyond that of two lone squirmers.
    pub(super) fn excess_power(&self) -> f64 {
        self.slip_power() - self.pair.squirmers.iter().map(lone_power).sum::<f64>()
    }

    /// Power of dragging each sphere at its speed, alone: `6 pi mu a U^2`.
    pub(super) fn drag_power(&self) -> [f64; 2] {
        let radii = self.pair.configuration.radii;
        [0, 1].map(|k| drag_power(radii[k], self.pair.velocities[k].norm()))
    }

    /// Lighthill's efficiency of each squirmer; NaN where its slip does no work.
    #[must_use]
    pub fn efficiencies(&self) -> [f64; 2] {
        let drag = self.drag_power();
        [0, 1].map(|k| efficiency(drag[k], self.stress.slip_power[k]))
    }

    /// How far the dissipation is from the work of slip, repulsion and gravity, relative to it.
    #[must_use]
    pub fn budget(&self) -> f64 {
        let work = self.slip_power() + self.pair.external_power();
        (self.stress.dissipation - work).abs() / self.stress.dissipation
    }

    /// Rate at which the centres part.
    pub(super) fn parting(&self) -> f64 {
        let [one, two] = self.pair.velocities;
        (two - one).dot(&self.pair.configuration.line)
    }
}

/// Power of dragging over power of swimming; NaN where slip does no work.
pub(super) fn efficiency(drag: f64, slip: f64) -> f64 {
    if slip > 0.0 { drag / slip } else { f64::NAN }
}

/// The independent components of a stresslet.
pub(super) fn components(of: &Matrix3<f64>) -> [f64; 5] {
    COMPONENTS.map(|at| of[at])
}
