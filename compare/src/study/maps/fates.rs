//! The share of each outcome in the plane of initial directions (the paper's Figs 5a and 8g).

use scene::Outcome;
use serde::{Deserialize, Serialize};

use super::Maps;
use super::grid::Pair;
use super::scatter::{ScatterRow, line};
use crate::columns::columns;
use crate::no_run::FAILED;
use crate::output::csv_lines;
use crate::sweep::Row;
use crate::{CompareError, Method, Model};

columns! {
    /// A row for each method and pair: the share of each outcome among all points of a grid of initial angles. Shares
    /// are from 0 to 1.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct FateRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Bottom-heaviness of both squirmers; 0 if gravity does not turn them.
        #[unit = "-"]
        pub g: f64,
        /// Share of pairs that part. Under gravity: share of pairs that are apart (gap above 1) at the end, unless
        /// gravity has righted both squirmers.
        #[unit = "-"]
        pub scattered: f64,
        /// Share of pairs that stay bound at rest, facing each other.
        #[unit = "-"]
        pub standoff: f64,
        /// Share of pairs that stay bound and swim together along a straight line.
        #[unit = "-"]
        pub pairwise: f64,
        /// Share of pairs that stay bound and orbit anticlockwise.
        #[unit = "-"]
        pub anticlockwise: f64,
        /// Share of pairs that stay bound and orbit clockwise.
        #[unit = "-"]
        pub clockwise: f64,
        /// Share of pairs that have neither parted nor reached a steady state at the end of the run.
        #[unit = "-"]
        pub undecided: f64,
        /// Under gravity: share of pairs that swim upward at the end, bound or apart.
        #[unit = "-"]
        pub upward: f64,
        /// Under gravity: share of pairs that stay bound while the gap or the line of centres oscillates.
        #[unit = "-"]
        pub oscillating: f64,
        /// Under gravity: share of pairs that stay bound and swim downward at the end.
        #[unit = "-"]
        pub downward: f64,
        /// Share of runs without a result: they failed, or the gap became too small for the model.
        #[unit = "-"]
        pub failed: f64,
        /// Standard error of the share of bound pairs, as if the points were drawn at random. The error of a regular
        /// grid is smaller.
        #[unit = "-"]
        pub sampling_error: f64,
        /// Number of points of the grid.
        #[unit = "-"]
        pub points: usize,
    }
}

/// Reads one share from a row.
pub type Share = fn(&FateRow) -> f64;

impl FateRow {
    /// The name and the share of every outcome, in the order of the columns.
    pub const SHARES: [(&'static str, Share); 10] = [
        ("scattered", |row| row.scattered),
        ("standoff", |row| row.standoff),
        ("pairwise", |row| row.pairwise),
        ("anticlockwise", |row| row.anticlockwise),
        ("clockwise", |row| row.clockwise),
        ("undecided", |row| row.undecided),
        ("upward", |row| row.upward),
        ("oscillating", |row| row.oscillating),
        ("downward", |row| row.downward),
        ("failed", |row| row.failed),
    ];

    /// Share of bound pairs: at rest, swimming together or orbiting.
    #[must_use]
    pub fn bound(&self) -> f64 {
        self.standoff + self.pairwise + self.orbits()
    }

    /// Share of pairs that orbit.
    #[must_use]
    pub fn orbits(&self) -> f64 {
        self.anticlockwise + self.clockwise
    }
}

/// Number of runs with each outcome along a line of the grid. The last number counts failed runs.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct Counts([usize; Outcome::ALL.len() + 1]);

impl Counts {
    fn of(rows: &[ScatterRow]) -> Self {
        let mut counts = Self::default();
        for row in rows {
            let index = (Outcome::ALL.iter()).position(|o| Some(*o) == row.outcome());
            counts.0[index.unwrap_or(Outcome::ALL.len())] += 1;
        }
        counts
    }
}

impl Row for Counts {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::repeat_n(FAILED, self.0[Outcome::ALL.len()])
    }
}

impl Maps<'_> {
    /// The shares for every model and pair, in this order. `None` if the time limit left something out; then the same
    /// command continues. The lines are kept until the file of the maps is written.
    ///
    /// # Errors
    /// [`CompareError::Write`] if rows cannot be kept.
    pub fn fates(&self) -> Result<Option<Vec<FateRow>>, CompareError> {
        let sweep = self.sweep();
        let lines = self.lines(&sweep, |model, pair, sigma, options| {
            csv_lines(&[Counts::of(&line(model, pair, self.grid, sigma, options))])
        })?;
        let Some(lines) = lines else {
            return Ok(None);
        };
        let mut rows = Vec::new();
        self.read(&lines, &mut |model, pair, counts: Vec<Counts>| {
            rows.push(fate_row(model.method(), pair, &counts));
            Ok::<_, CompareError>(())
        })?;
        Ok(Some(rows))
    }
}

/// The shares in a finished map.
#[must_use]
pub fn fates_of(model: &Model, pair: Pair, rows: &[ScatterRow]) -> FateRow {
    fate_row(model.method(), pair, &[Counts::of(rows)])
}

fn fate_row(method: Method, pair: Pair, lines: &[Counts]) -> FateRow {
    let points: usize = lines.iter().flat_map(|counts| counts.0).sum();
    let share = |index: usize| {
        let count: usize = lines.iter().map(|counts| counts.0[index]).sum();
        count as f64 / points as f64
    };
    let of =
        |outcome: Outcome| (Outcome::ALL.iter().position(|o| *o == outcome)).map_or(0.0, share);
    let mut row = FateRow {
        method,
        beta: pair.beta,
        g: pair.g,
        scattered: of(Outcome::Scattered),
        standoff: of(Outcome::Standoff),
        pairwise: of(Outcome::Pairwise),
        anticlockwise: of(Outcome::Anticlockwise),
        clockwise: of(Outcome::Clockwise),
        undecided: of(Outcome::Undecided),
        upward: of(Outcome::Upward),
        oscillating: of(Outcome::Oscillating),
        downward: of(Outcome::Downward),
        // An unresolved outcome (the gap left the model's range) counts as failed.
        failed: share(Outcome::ALL.len()) + of(Outcome::Unresolved),
        sampling_error: 0.0,
        points,
    };
    let bound = row.bound();
    row.sampling_error = (bound * (1.0 - bound) / points as f64).sqrt();
    row
}
