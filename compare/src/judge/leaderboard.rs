//! Who is how accurate, for how long: public codes and the models of this workspace, judged alike.

use std::sync::Arc;
use std::time::Instant;

use bem::Bem;
use exact::Exact;
use lt::{Form, Lubrication};
use scene::{Gap, Hydrodynamics, LoadSet};
use serde::Serialize;

use super::points::{Item, Point, TRUST, by_item};
use super::{Options, Scorecard, faults, judge};
use crate::columns::columns;
use crate::submission::{Answer, Header, Submission, Submitted, Values};
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Model};

/// Gaps at which models of this workspace are judged: those of most public codes.
pub const OWN_GAPS: [f64; 18] = [
    0.005, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 4.0, 10.0, 38.0,
    998.0,
];

/// Gaps over which the score is the largest error.
const SCORED: (f64, f64) = (0.01, 2.0);

columns! {
    /// A row for each public code, and each model of this workspace, from the most accurate on. Errors are the largest of the ten resistance scalars, each divided by
    /// the larger of the exact scalar and 1. NaN where scalars are missing at that gap.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct LeaderRow {
        /// Name of the file in `fixtures/peers`, or of the method.
        #[unit = "-"]
        pub model: String,
        /// Model and version, as stated.
        #[unit = "-"]
        pub title: String,
        /// The score: largest error at gaps from 0.01 to 2, also between its gaps if it states its interpolation.
        #[unit = "-"]
        pub score: f64,
        /// Largest error at gap 2.
        #[unit = "-"]
        pub error_2: f64,
        /// Largest error at gap 0.5.
        #[unit = "-"]
        pub error_05: f64,
        /// Largest error at gap 0.1.
        #[unit = "-"]
        pub error_01: f64,
        /// Largest error at gap 0.01.
        #[unit = "-"]
        pub error_001: f64,
        /// Largest error of a load by slip of the modes 1 and 2 at gaps from 0.01 to 2.
        #[unit = "-"]
        pub slip_score: f64,
        /// Gap down to which all that it gives is within 1 %.
        #[unit = "a"]
        pub trusted_1: f64,
        /// The same within 5 %.
        #[unit = "a"]
        pub trusted_5: f64,
        /// The same within 20 %.
        #[unit = "a"]
        pub trusted_20: f64,
        /// Number of faults that were found.
        #[unit = "-"]
        pub faults: usize,
        /// Time of one gap: as stated, or measured now for the models of this workspace.
        #[unit = "s"]
        pub seconds: f64,
    }
}

impl LeaderRow {
    /// The row of a scorecard.
    #[must_use]
    pub fn of(card: &Scorecard) -> Self {
        let rigid =
            |item: Item| matches!(item, Item::Quantity(q) if q.is_load() && q.mode().is_none());
        let by_slip = |item: Item| matches!(item, Item::Quantity(q) if q.is_load() && !q.is_by_swirl() && q.mode().is_some_and(|mode| mode <= 2));
        let largest = |is_meant: &dyn Fn(Item) -> bool, count: usize, (from, to): (f64, f64)| {
            let meant: Vec<Point> = (card.points.iter().chain(&card.between))
                .filter(|point| {
                    is_meant(point.item)
                        && point.gap >= from * (1.0 - 1e-9)
                        && point.gap <= to * (1.0 + 1e-9)
                })
                .copied()
                .collect();
            if by_item(&meant).len() < count {
                f64::NAN
            } else {
                faults::worst(&meant).0
            }
        };
        let at = |gap: f64| largest(&rigid, 10, (gap, gap));
        // Of a model that does not reach both ends there is no score.
        let over = |is_meant: &dyn Fn(Item) -> bool, count: usize| {
            let ends = [SCORED.0, SCORED.1].map(|gap| largest(is_meant, count, (gap, gap)));
            if ends.iter().any(|error| error.is_nan()) {
                f64::NAN
            } else {
                largest(is_meant, count, SCORED)
            }
        };
        let trusted = TRUST.map(|bound| card.trusted(bound).unwrap_or(f64::NAN));
        let [trusted_1, trusted_5, trusted_20] = trusted;
        Self {
            model: card.name.clone(),
            title: card.header.title().unwrap_or_else(|| card.name.clone()),
            score: over(&rigid, 10),
            error_2: at(2.0),
            error_05: at(0.5),
            error_01: at(0.1),
            error_001: at(0.01),
            slip_score: over(&by_slip, 12),
            trusted_1,
            trusted_5,
            trusted_20,
            faults: card.faults.len(),
            seconds: card.seconds_per_gap.unwrap_or(f64::NAN),
        }
    }
}

/// Whether a name is that of a public code in `fixtures/peers`.
#[must_use]
pub fn is_public(name: &str) -> bool {
    fixtures::peer(name).is_some()
}

/// The rows of some scorecards, by rising score; those without a score come last.
#[must_use]
pub fn leader_rows(cards: &[Scorecard]) -> Vec<LeaderRow> {
    let mut rows: Vec<LeaderRow> = cards.iter().map(LeaderRow::of).collect();
    rows.sort_by(|a, b| {
        a.score
            .total_cmp(&b.score)
            .then_with(|| a.model.cmp(&b.model))
    });
    rows
}

/// The scorecards of the public codes in `fixtures/peers` and of the models of this workspace, without collisions.
///
/// # Errors
/// [`CompareError`] if a model fails.
pub fn leaderboard(referee: &Model) -> Result<Vec<Scorecard>, CompareError> {
    let mut all: Vec<(String, Submitted)> = Vec::new();
    for (name, text) in fixtures::PEERS {
        let submission = Submission::parse(text)
            .map_err(|error| CompareError::input("judge", name, error.to_string()))?;
        all.push((name.to_owned(), Submitted::File(submission)));
    }
    let own = own_models()?;
    let progress = Progress::begin("models", all.len() + 2 * own.len(), Pieces::Unlike);
    for (name, title, model) in own {
        let submission = submission_of(&title, model.as_ref(), &OWN_GAPS, LoadSet::all(2))?;
        all.push((name, Submitted::File(submission)));
        progress.advance();
    }
    let options = Options {
        grid: None,
        gaps: &super::GAPS,
    };
    (all.iter())
        .map(|(name, submitted)| {
            let reason = Err("not asked for".to_owned());
            let card = judge(name, submitted, reason, referee, &options)?;
            progress.advance();
            Ok(card)
        })
        .collect()
}

/// Name, title and model.
pub(super) type Own = (String, String, Arc<dyn Hydrodynamics>);

pub(super) fn own_models() -> Result<Vec<Own>, CompareError> {
    let mut own: Vec<Own> = vec![
        (
            "exact".to_owned(),
            "exact series, the referee itself".to_owned(),
            Arc::new(Exact::new()),
        ),
        (
            "lt".to_owned(),
            "lubrication theory, as published".to_owned(),
            Arc::new(Lubrication::new(Form::Published)),
        ),
        (
            "lt-corrected".to_owned(),
            "lubrication theory, corrected".to_owned(),
            Arc::new(Lubrication::new(Form::Corrected)),
        ),
    ];
    for level in Bem::LEVELS.0..=Bem::DEFAULT_LEVEL {
        own.push((
            format!("bem-{level}"),
            format!("boundary elements, level {level}"),
            Arc::new(Bem::new(level)?),
        ));
    }
    Ok(own)
}

/// What a hydrodynamic model of equal spheres answers at some gaps, as a submission, with the time of one gap.
///
/// # Errors
/// Those of the model.
pub fn submission_of(
    title: &str,
    model: &dyn Hydrodynamics,
    gaps: &[f64],
    set: LoadSet,
) -> Result<Submission, CompareError> {
    let started = Instant::now();
    let mut answers = Vec::new();
    for &gap in gaps {
        let gap = Gap::new(gap)?;
        answers.push(Answer {
            gap,
            values: Values::of_model(model, gap, set)?,
            errors: Values::default(),
            laws: None,
        });
    }
    let header = Header {
        model: Some(title.to_owned()),
        version: Some(env!("CARGO_PKG_VERSION").to_owned()),
        citation: Some("this workspace".to_owned()),
        seconds_per_gap: Some(started.elapsed().as_secs_f64() / gaps.len().max(1) as f64),
        ..Header::default()
    };
    Ok(Submission::of_answers(header, answers))
}
