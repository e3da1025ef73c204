//! Bound states of each model, and pairs that one model binds and the other does not.

use scene::{BoundState, Outcome, Repulsion, SceneError, Squirmer, bound_states};
use serde::Serialize;

use super::trust::{TrustRow, same_map};
use crate::columns::columns;
use crate::{CompareError, Method, Model};

columns! {
    /// A row for each bound state of two equal squirmers: a fixed point of the gap and of the orientations relative to
    /// the line of centres. Its mirror image, and the state with the two squirmers exchanged, are bound states too.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct BoundRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Outcome of a pair that stays in this state.
        #[unit = "-"]
        pub outcome: String,
        /// Gap between the surfaces of the squirmers.
        #[unit = "a"]
        pub gap: f64,
        /// Angle from the direction to squirmer 2 to the orientation of squirmer 1.
        #[unit = "deg"]
        pub angle1_deg: f64,
        /// Angle from the direction to squirmer 1 to the orientation of squirmer 2.
        #[unit = "deg"]
        pub angle2_deg: f64,
        /// Angular velocity of the line of centres; positive if the pair orbits anticlockwise.
        #[unit = "V_s/a"]
        pub turning: f64,
        /// Speed of the point midway between the centres.
        #[unit = "V_s"]
        pub speed: f64,
        /// Largest growth rate of a small disturbance in the plane; negative if all disturbances decay.
        #[unit = "V_s/a"]
        pub growth: f64,
        /// Angular frequency of the disturbance that grows fastest; 0 if it does not oscillate.
        #[unit = "V_s/a"]
        pub frequency: f64,
        /// Largest growth rate of a small disturbance out of the plane, other than the whole pair turned about an axis in the plane; negative if all
        /// disturbances decay.
        #[unit = "V_s/a"]
        pub growth_off_plane: f64,
        /// Whether small disturbances in the plane decay: `yes`, `no`, or `neutral` if none grows and one neither grows nor decays; `unknown` if the model does not answer nearby.
        #[unit = "-"]
        pub stable_in_plane: &'static str,
        /// The same of all small disturbances, in and out of the plane: `yes` for a state that attracts in three dimensions.
        #[unit = "-"]
        pub stable_in_space: &'static str,
        /// `true` if the state belongs to a continuous line of states, of which only this one is listed.
        #[unit = "-"]
        pub one_of_a_line: bool,
    }
}

/// Rate, in `V_s/a`, up to which a disturbance neither grows nor decays: above the error of the rates.
const NEITHER: f64 = 1e-5;

/// Whether disturbances decay, the fastest of which grows at this rate.
fn decay(growth: f64) -> &'static str {
    if growth < -NEITHER {
        "yes"
    } else if growth <= NEITHER {
        "neutral"
    } else if growth.is_nan() {
        "unknown"
    } else {
        "no"
    }
}

/// The larger of two rates; one that is not known may be any.
fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}

impl BoundRow {
    fn of(method: Method, beta: f64, state: &BoundState) -> Self {
        let [angle1_deg, angle2_deg] = state.angles_rad.map(f64::to_degrees);
        Self {
            method,
            beta,
            outcome: state.outcome.to_string(),
            gap: state.gap.eps(),
            angle1_deg,
            angle2_deg,
            turning: state.turning_rate_rad,
            speed: state.speed,
            growth: state.growth(),
            frequency: state.eigenvalues[0].im.abs(),
            growth_off_plane: state.growth_off_plane(),
            stable_in_plane: decay(state.growth()),
            stable_in_space: decay(largest(state.growth(), state.growth_off_plane())),
            one_of_a_line: state.is_neutral(),
        }
    }
}

/// The bound states of every model and squirmer parameter, sorted by model, parameter and rising growth rate.
///
/// # Errors
/// [`CompareError::Scene`] for a parameter that is not finite.
pub fn bound_rows(models: &[&Model], betas: &[f64]) -> Result<Vec<BoundRow>, CompareError> {
    let mut rows = Vec::new();
    for model in models {
        for &beta in betas {
            let squirmer = Squirmer::with_beta(1.0, beta)?;
            let states = states(model, &squirmer)?;
            rows.extend(states.iter().map(|s| BoundRow::of(model.method(), beta, s)));
        }
    }
    Ok(rows)
}

fn states(model: &Model, squirmer: &Squirmer) -> Result<Vec<BoundState>, SceneError> {
    bound_states(&**model, squirmer, Repulsion::PAPER)
}

columns! {
    /// A row for each two outcomes of a pair of which one is a bound state and the other is not: a start with these
    /// outcomes, and whether the other model has the bound state at all. If both models bind the pair, the state is the
    /// one of lubrication theory.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct BoundExample {
        /// Name of the form of lubrication theory.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Outcome by lubrication theory.
        #[unit = "-"]
        pub outcome_lt: String,
        /// Outcome by exact hydrodynamics.
        #[unit = "-"]
        pub outcome_exact: String,
        /// Share of the initial angles with these two outcomes, from 0 to 1.
        #[unit = "-"]
        pub share: f64,
        /// Difference of the initial angles of the example divided by pi, `(phi2 - phi1)/pi`.
        #[unit = "-"]
        pub delta: f64,
        /// Sum of the initial angles of the example divided by pi, `(phi2 + phi1)/pi`.
        #[unit = "-"]
        pub sigma: f64,
        /// The bound state in the other model: `absent`, `unstable`, or `not reached` (stable, but the example does not end
        /// there).
        #[unit = "-"]
        pub state: &'static str,
        /// Gap of the state in the other model. NaN if it is absent.
        #[unit = "a"]
        pub gap: f64,
        /// Largest growth rate of a small disturbance of the state in the other model. NaN if it is absent.
        #[unit = "V_s/a"]
        pub growth: f64,
    }
}

/// Whether an outcome is a bound state without gravity.
fn is_bound(outcome: &str) -> bool {
    [
        Outcome::Standoff,
        Outcome::Pairwise,
        Outcome::Anticlockwise,
        Outcome::Clockwise,
    ]
    .iter()
    .any(|bound| bound.to_string() == outcome)
}

/// The kind of a bound state without its sense of rotation, because a mirror image rotates the other way.
fn kind(outcome: &str) -> &str {
    match outcome {
        "anticlockwise" | "clockwise" => "orbit",
        other => other,
    }
}

/// The examples of every map, sorted by falling share.
#[must_use]
pub fn bound_examples(rows: &[TrustRow], states: &[BoundRow]) -> Vec<BoundExample> {
    let mut examples = Vec::new();
    for map in rows.chunk_by(same_map) {
        let mut kinds: Vec<(&str, &str)> = Vec::new();
        for row in map {
            let pair = (row.outcome_lt.as_str(), row.outcome_exact.as_str());
            let bound = is_bound(pair.0) || is_bound(pair.1);
            if bound && kind(pair.0) != kind(pair.1) && !kinds.contains(&pair) {
                kinds.push(pair);
            }
        }
        let mut found: Vec<BoundExample> = (kinds.into_iter())
            .filter_map(|pair| example(map, pair, states))
            .collect();
        found.sort_by(|a, b| b.share.total_cmp(&a.share));
        examples.extend(found);
    }
    examples
}

fn example(
    map: &[TrustRow],
    (outcome_lt, outcome_exact): (&str, &str),
    states: &[BoundRow],
) -> Option<BoundExample> {
    let alike: Vec<&TrustRow> = (map.iter())
        .filter(|row| row.outcome_lt == outcome_lt && row.outcome_exact == outcome_exact)
        .collect();
    let row = alike.get(alike.len() / 2)?;
    let (bound, other) = if is_bound(outcome_lt) {
        (outcome_lt, Method::Exact)
    } else {
        (outcome_exact, row.method)
    };
    // Stable ones come first.
    let there = (states.iter()).find(|state| {
        state.method == other
            && state.beta.total_cmp(&row.beta).is_eq()
            && kind(&state.outcome) == kind(bound)
    });
    Some(BoundExample {
        method: row.method,
        beta: row.beta,
        outcome_lt: outcome_lt.to_owned(),
        outcome_exact: outcome_exact.to_owned(),
        share: alike.len() as f64 / map.len() as f64,
        delta: row.delta,
        sigma: row.sigma,
        state: match there {
            None => "absent",
            Some(state) if state.growth > 0.0 => "unstable",
            Some(_) => "not reached",
        },
        gap: there.map_or(f64::NAN, |state| state.gap),
        growth: there.map_or(f64::NAN, |state| state.growth),
    })
}
