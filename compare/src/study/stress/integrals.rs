//! Integrals over a run from its samples.

use scene::nalgebra::Matrix3;
use scene::stress::{drag_power, lone_power};

use super::instant::{Instant, efficiency};

/// Weights of samples: of the whole run, and of the times at gaps up to the smaller radius.
struct Weights {
    whole: Vec<f64>,
    near: Vec<f64>,
}

/// Integrals over a run by the trapezoidal rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Integrals {
    /// Of the excess stresslet.
    pub excess: Matrix3<f64>,
    /// The same at gaps up to the smaller radius.
    pub near_excess: Matrix3<f64>,
    /// Of the rate of work of slip beyond that of two lone squirmers.
    pub excess_work: f64,
    /// Of the rates of work of slip and of repulsion and gravity.
    pub slip_work: f64,
    pub external_work: f64,
    /// Duration of the run, and time at gaps up to the smaller radius.
    pub duration: f64,
    pub near_time: f64,
    /// Efficiency over the whole run and near, both squirmers together.
    pub efficiency: f64,
    pub near_efficiency: f64,
}

impl Weights {
    fn new(instants: &[&Instant]) -> Self {
        let near_gap = |at: &Instant| {
            let [one, two] = at.pair.configuration.radii;
            at.gap() - one.min(two)
        };
        let mut weights = Self {
            whole: vec![0.0; instants.len()],
            near: vec![0.0; instants.len()],
        };
        for (i, two) in instants.windows(2).enumerate() {
            let dt = two[1].t - two[0].t;
            weights.whole[i] += 0.5 * dt;
            weights.whole[i + 1] += 0.5 * dt;
            // The part of the step that is near; gaps are linear within it.
            let (from, to) = (near_gap(two[0]), near_gap(two[1]));
            let crossing = from / (from - to);
            let (start, end) = match (from <= 0.0, to <= 0.0) {
                (true, true) => (0.0, 1.0),
                (true, false) => (0.0, crossing),
                (false, true) => (crossing, 1.0),
                (false, false) => continue,
            };
            let (middle, length) = (0.5 * (start + end), (end - start) * dt);
            weights.near[i] += length * (1.0 - middle);
            weights.near[i + 1] += length * middle;
        }
        weights
    }
}

impl Integrals {
    pub(super) fn of(instants: &[Instant]) -> Self {
        Self::over(&instants.iter().collect::<Vec<_>>())
    }

    /// The same with every second sample: the difference bounds the error of the rule.
    pub(super) fn coarser(instants: &[Instant]) -> Self {
        let last = instants.len().saturating_sub(1);
        let kept = (instants.iter().enumerate()).filter(|(i, _)| i % 2 == 0 || *i == last);
        Self::over(&kept.map(|(_, instant)| instant).collect::<Vec<_>>())
    }

    fn over(instants: &[&Instant]) -> Self {
        let weights = Weights::new(instants);
        let sum = |weights: &[f64], of: fn(&Instant) -> f64| -> f64 {
            let terms = weights.iter().zip(instants);
            terms.map(|(weight, at)| weight * of(at)).sum()
        };
        let stresslet = |weights: &[f64]| -> Matrix3<f64> {
            let terms = weights.iter().zip(instants);
            terms.map(|(weight, at)| at.excess() * *weight).sum()
        };
        let drag = |at: &Instant| at.drag_power().iter().sum();
        let efficiency =
            |weights: &[f64]| efficiency(sum(weights, drag), sum(weights, Instant::slip_power));
        Self {
            excess: stresslet(&weights.whole),
            near_excess: stresslet(&weights.near),
            excess_work: sum(&weights.whole, Instant::excess_power),
            slip_work: sum(&weights.whole, Instant::slip_power),
            external_work: sum(&weights.whole, |at| at.pair.external_power()),
            duration: weights.whole.iter().sum(),
            near_time: weights.near.iter().sum(),
            efficiency: efficiency(&weights.whole),
            near_efficiency: efficiency(&weights.near),
        }
    }
}

/// Lighthill's efficiency of two lone squirmers together.
pub(super) fn lone_efficiency(squirmers: &[scene::Squirmer; 2]) -> f64 {
    let drag = (squirmers.iter()).map(|of| drag_power(of.radius(), 2.0 / 3.0 * of.mode(0)));
    efficiency(drag.sum(), squirmers.iter().map(lone_power).sum())
}

/// What an excess that falls as `r^-3` still adds beyond an instant, while the pair parts (or before it, while it comes) as at this instant: its
/// value times `r/(2 |dr/dt|)`.
pub(super) fn beyond(at: &Instant) -> f64 {
    at.excess().norm() * at.pair.configuration.distance() / (2.0 * at.parting().abs())
}
