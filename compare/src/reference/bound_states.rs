//! Bound states by exact loads, each with its error.

use scene::{BoundState, Repulsion, Squirmer, bound_states};
use serde::Serialize;

use super::digits::Digits;
use super::tables::Tables;
use crate::CompareError;
use crate::columns::columns;
use crate::study::maps::{BoundRow, bound_rows};

/// Least error of a number of a state: ten times the tolerance of the usual table.
const LEAST: f64 = 1e-8;

/// Least error of a rate, which follows from differences of velocities over 1e-5.
const LEAST_OF_RATES: f64 = 1e-6;

columns! {
    /// A row for each bound state of two equal squirmers with the paper's repulsion: a fixed point of the gap and of the orientations relative to
    /// the line of centres, stable or not. Its mirror image, and the state with the two squirmers exchanged, are bound states too.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct ReferenceBoundState {
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Outcome of a pair that stays in this state.
        #[unit = "-"]
        pub outcome: String,
        /// Gap between the surfaces of the squirmers.
        #[unit = "a"]
        pub gap: String,
        /// Angle from the direction to squirmer 2 to the orientation of squirmer 1, above -180 up to 180.
        #[unit = "deg"]
        pub angle1_deg: String,
        /// Angle from the direction to squirmer 1 to the orientation of squirmer 2, above -180 up to 180.
        #[unit = "deg"]
        pub angle2_deg: String,
        /// Angular velocity of the line of centres; positive if the pair orbits anticlockwise.
        #[unit = "V_s/a"]
        pub turning: String,
        /// Speed of the point midway between the centres.
        #[unit = "V_s"]
        pub speed: String,
        /// Largest difference of a printed number before this column from the exact one, in its unit, with that of rounding.
        #[unit = "varies"]
        pub error_estimate: String,
        /// Largest growth rate of a small disturbance in the plane; negative if all disturbances decay.
        #[unit = "V_s/a"]
        pub growth: String,
        /// Angular frequency of the disturbance that grows fastest; 0 if it does not oscillate.
        #[unit = "V_s/a"]
        pub frequency: String,
        /// The same error of growth and frequency.
        #[unit = "V_s/a"]
        pub rate_error: String,
        /// `true` if the state belongs to a continuous line of states, of which only this one is listed.
        #[unit = "-"]
        pub one_of_a_line: bool,
    }
}

/// The bound states of squirmers with each of `betas`, by rising growth rate.
///
/// # Errors
/// [`CompareError::Scene`] for a parameter that is not finite.
pub fn reference_bound_states(
    tables: &Tables,
    betas: &[f64],
) -> Result<Vec<ReferenceBoundState>, CompareError> {
    let mut rows = Vec::new();
    for &beta in betas {
        let squirmer = Squirmer::with_beta(1.0, beta)?;
        let others = bound_rows(&[&tables.usual], &[beta])?;
        let states = bound_states(&tables.finer, &squirmer, Repulsion::PAPER)?;
        rows.extend(states.iter().map(|state| row(beta, state, &others)));
    }
    Ok(rows)
}

/// An angle in degrees above -180, but for the error, up to 180.
fn above_half_turn(angle_rad: f64) -> f64 {
    let angle = angle_rad.to_degrees();
    if angle < LEAST - 180.0 {
        angle + 360.0
    } else {
        angle
    }
}

fn row(beta: f64, state: &BoundState, others: &[BoundRow]) -> ReferenceBoundState {
    let [angle1, angle2] = state.angles_rad.map(above_half_turn);
    let (growth, frequency) = (state.growth(), state.eigenvalues[0].im.abs());
    let numbers = [
        state.gap.eps(),
        angle1,
        angle2,
        state.turning_rate_rad,
        state.speed,
    ];
    let outcome = state.outcome.to_string();
    let apart = |other: &BoundRow| {
        let [angle1, angle2] =
            [other.angle1_deg, other.angle2_deg].map(|angle| above_half_turn(angle.to_radians()));
        let others = [other.gap, angle1, angle2, other.turning, other.speed];
        let both = numbers.iter().zip(others);
        let rates = [growth - other.growth, frequency - other.frequency];
        [
            both.map(|(a, b)| (a - b).abs()).fold(LEAST, f64::max),
            rates
                .into_iter()
                .fold(LEAST_OF_RATES, |most, of| most.max(of.abs())),
        ]
    };
    // The same state by the usual table: the closest of its kind.
    let [error, of_rates] = (others.iter())
        .filter(|other| other.outcome == outcome)
        .map(apart)
        .min_by(|a, b| a[0].total_cmp(&b[0]))
        .unwrap_or([f64::INFINITY; 2]);
    let [gap, angle1, angle2, turning, speed] = numbers.map(|number| Digits::of(number, error));
    let [growth, frequency] = [growth, frequency].map(|rate| Digits::of(rate, of_rates));
    ReferenceBoundState {
        beta,
        outcome,
        error_estimate: gap.error,
        gap: gap.value,
        angle1_deg: angle1.value,
        angle2_deg: angle2.value,
        turning: turning.value,
        speed: speed.value,
        rate_error: growth.error,
        growth: growth.value,
        frequency: frequency.value,
        one_of_a_line: state.is_neutral(),
    }
}
