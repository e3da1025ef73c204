//! What a submission makes of collisions: the paper's cases, the incoming angles, bound states.

use rayon::prelude::*;
use scene::{Outcome, RunOptions};

use crate::no_run::RunNumbers;
use crate::study::maps::{
    BoundRow, Grid, Pair, ScatterRow, TrustRow, TrustShares, bound_rows, scatter_row, trust_rows,
    trust_shares,
};
use crate::watch::{Pieces, Progress};
use crate::{Approach, Case, CompareError, Defaults, Model};

/// Distance of the centres at which outgoing angles are read, of both models: further out many submissions do not reach.
pub const ANGLES_AT: f64 = 12.0;

/// Squirmer parameters of maps and bound states.
pub const BETAS: [f64; 3] = [1.0, 5.0, -5.0];

/// One of the paper's cases by both models.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseScore {
    /// The case.
    pub case: Case,
    /// Deflections of both squirmers in degrees, and the outcome, by the submission and by exact hydrodynamics.
    pub theirs: ([f64; 2], String),
    /// See [`Self::theirs`].
    pub exact: ([f64; 2], String),
}

impl CaseScore {
    /// The case in words.
    #[must_use]
    pub fn name(&self) -> String {
        let Case {
            approach, beta, dx, ..
        } = self.case;
        let approach = match approach {
            Approach::HeadOn => "opposed",
            Approach::Orthogonal => "right angles",
        };
        let [beta, dx] = [beta, dx].map(crate::numbers::written);
        format!("{approach}, beta {beta}, dx {dx}")
    }

    /// The larger error of the two deflections, in degrees, if both models part the pair.
    #[must_use]
    pub fn error_deg(&self) -> Option<f64> {
        let scattered = Outcome::Scattered.to_string();
        let both = [&self.theirs.1, &self.exact.1]
            .iter()
            .all(|outcome| **outcome == scattered);
        let error = |k: usize| (self.theirs.0[k] - self.exact.0[k]).abs();
        both.then(|| error(0).max(error(1)))
    }
}

/// Starts from which the two models do not end alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Parting {
    /// Squirmer parameter.
    pub beta: f64,
    /// Outcome by the submission and by exact hydrodynamics.
    pub outcomes: [String; 2],
    /// Share of all incoming angles.
    pub share: f64,
    /// `Delta` and `Sigma` of one of them.
    pub start: [f64; 2],
}

/// What both models make of collisions.
#[derive(Clone, Debug, PartialEq)]
pub struct Collisions {
    /// The paper's cases.
    pub cases: Vec<CaseScore>,
    /// Shares of outcomes for each `beta`: outcome, by the submission, by exact hydrodynamics.
    pub outcomes: Vec<(f64, String, [f64; 2])>,
    /// Shares of trust for each `beta`.
    pub trust: Vec<TrustShares>,
    /// Where they part, by falling share for each `beta`.
    pub partings: Vec<Parting>,
    /// Bound states by the submission and by exact hydrodynamics.
    pub bound: [Vec<BoundRow>; 2],
    /// Both outcomes at each point of the grid of incoming angles, map by map.
    pub maps: Vec<TrustRow>,
}

/// The collisions of two models.
///
/// # Errors
/// [`CompareError::Scene`] if the search for bound states fails.
pub(super) fn collisions(
    theirs: &Model,
    exact: &Model,
    grid: Grid,
) -> Result<Collisions, CompareError> {
    let options = RunOptions {
        angles_at: ANGLES_AT,
        ..RunOptions::default()
    };
    let cases = Defaults::paper_encounters()?;
    let progress = Progress::begin(
        "collisions",
        cases.len() + BETAS.len() * grid.points(),
        Pieces::Alike,
    );
    let cases = (cases.into_par_iter())
        .map(|case| {
            let of = |model: &Model| {
                let numbers = RunNumbers::of(&model.attempt(case.scene(), &options));
                (numbers.deflections_deg, numbers.outcome)
            };
            let score = CaseScore {
                case,
                theirs: of(theirs),
                exact: of(exact),
            };
            progress.advance();
            score
        })
        .collect();
    let mut found = Collisions {
        cases,
        outcomes: Vec::new(),
        trust: Vec::new(),
        partings: Vec::new(),
        bound: [
            bound_rows(&[theirs], &BETAS)?,
            bound_rows(&[exact], &BETAS)?,
        ],
        maps: Vec::new(),
    };
    let values = grid.values();
    for beta in BETAS {
        let pair = Pair {
            beta,
            g: 0.0,
            dz: 0.0,
        };
        let lines: Vec<[Vec<ScatterRow>; 2]> = (values.par_iter())
            .map(|&sigma| {
                let line = |model: &Model| -> Vec<ScatterRow> {
                    let rows = values
                        .iter()
                        .map(|&delta| scatter_row(model, pair, (delta, sigma), &options));
                    rows.collect()
                };
                let both = [line(theirs), line(exact)];
                progress.advance();
                both
            })
            .collect();
        let [mut theirs_rows, mut exact_rows] = [Vec::new(), Vec::new()];
        for [theirs, exact] in lines {
            theirs_rows.extend(theirs);
            exact_rows.extend(exact);
        }
        found.add_map(pair, &theirs_rows, &exact_rows);
    }
    Ok(found)
}

impl Collisions {
    fn add_map(&mut self, pair: Pair, theirs: &[ScatterRow], exact: &[ScatterRow]) {
        let count = theirs.len() as f64;
        let mut kinds: Vec<String> = Vec::new();
        for row in theirs.iter().chain(exact) {
            if !kinds.contains(&row.outcome) {
                kinds.push(row.outcome.clone());
            }
        }
        kinds.sort();
        for kind in kinds {
            let share = |rows: &[ScatterRow]| {
                rows.iter().filter(|row| row.outcome == kind).count() as f64 / count
            };
            let shares = [share(theirs), share(exact)];
            self.outcomes.push((pair.beta, kind, shares));
        }
        let map = trust_rows(theirs, exact, pair);
        self.trust.extend(trust_shares(&map));
        self.maps.extend(map);
        let mut partings: Vec<Parting> = Vec::new();
        for (theirs, exact) in theirs.iter().zip(exact) {
            if theirs.outcome == exact.outcome {
                continue;
            }
            let outcomes = [theirs.outcome.clone(), exact.outcome.clone()];
            match partings
                .iter_mut()
                .find(|parting| parting.outcomes == outcomes)
            {
                Some(parting) => parting.share += 1.0 / count,
                None => partings.push(Parting {
                    beta: pair.beta,
                    outcomes,
                    share: 1.0 / count,
                    start: [theirs.delta, theirs.sigma],
                }),
            }
        }
        partings.sort_by(|a, b| b.share.total_cmp(&a.share));
        self.partings.extend(partings);
    }

    /// Bound states of exact hydrodynamics and whether the submission has one of the same kind that is as stable, and those that only the submission has.
    #[must_use]
    pub fn bound_states(&self) -> Vec<BoundComparison> {
        let [theirs, exact] = &self.bound;
        let same = |a: &BoundRow, b: &BoundRow| {
            a.beta.total_cmp(&b.beta).is_eq()
                && a.outcome == b.outcome
                && (a.growth > 0.0) == (b.growth > 0.0)
        };
        let mut left: Vec<&BoundRow> = theirs.iter().collect();
        let mut all = Vec::new();
        for state in exact {
            let distance = |other: &BoundRow| (other.gap / state.gap).ln().abs();
            let nearest = (left.iter().enumerate())
                .filter(|(_, other)| same(other, state))
                .min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
            let found = nearest
                .map(|(place, _)| place)
                .map(|place| left.remove(place));
            all.push(BoundComparison {
                theirs: found.cloned(),
                exact: Some(state.clone()),
            });
        }
        all.extend(left.into_iter().map(|state| BoundComparison {
            theirs: Some(state.clone()),
            exact: None,
        }));
        all
    }
}

/// A bound state that one of the models has, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundComparison {
    /// By the submission.
    pub theirs: Option<BoundRow>,
    /// By exact hydrodynamics.
    pub exact: Option<BoundRow>,
}

impl BoundComparison {
    /// The state in words.
    #[must_use]
    pub fn name(&self) -> String {
        let Some(state) = self.exact.as_ref().or(self.theirs.as_ref()) else {
            return String::new();
        };
        let stable = if state.growth > 0.0 {
            "unstable"
        } else {
            "stable"
        };
        format!(
            "beta {}, {}, {stable}, gap {}",
            crate::numbers::written(state.beta),
            state.outcome,
            crate::numbers::size(state.gap)
        )
    }
}

#[cfg(test)]
mod tests;
