//! The rows of unlike radii.

use serde::Serialize;

use crate::Method;
use crate::columns::columns;
use crate::study::maps::TRUST_CLASSES;

columns! {
    /// A row for each method and pair: shares of a grid of initial angles. Shares are from 0 to 1; those that end in
    /// `_exact` are by exact hydrodynamics. The difference of a pair is the larger of those of its two squirmers.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct RatioRow {
        /// Name of the method that is compared with exact hydrodynamics.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of squirmer 1; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta1: f64,
        /// Squirming parameter B2/B1 of squirmer 2.
        #[unit = "-"]
        pub beta2: f64,
        /// Radius of squirmer 2 over that of squirmer 1.
        #[unit = "-"]
        pub ratio: f64,
        /// Share of pairs that part.
        #[unit = "-"]
        pub scattered: f64,
        /// Share of pairs that stay bound at rest.
        #[unit = "-"]
        pub standoff: f64,
        /// Share of pairs that stay bound and swim together along a straight line.
        #[unit = "-"]
        pub pairwise: f64,
        /// Share of pairs that stay bound and orbit.
        #[unit = "-"]
        pub orbiting: f64,
        /// Share of pairs that have neither parted nor reached a steady state at the end of the run.
        #[unit = "-"]
        pub undecided: f64,
        /// The same by exact hydrodynamics: pairs that part.
        #[unit = "-"]
        pub scattered_exact: f64,
        /// Pairs that stay bound at rest, by exact hydrodynamics.
        #[unit = "-"]
        pub standoff_exact: f64,
        /// Pairs that swim together along a straight line, by exact hydrodynamics.
        #[unit = "-"]
        pub pairwise_exact: f64,
        /// Pairs that orbit, by exact hydrodynamics.
        #[unit = "-"]
        pub orbiting_exact: f64,
        /// Pairs that have neither parted nor reached a steady state, by exact hydrodynamics.
        #[unit = "-"]
        pub undecided_exact: f64,
        /// Share where both models part the pair, and the deflections differ by at most 5 degrees.
        #[unit = "-"]
        pub within_5_deg: f64,
        /// Share where both models part the pair, and the deflections differ by 5 to 15 degrees.
        #[unit = "-"]
        pub within_15_deg: f64,
        /// Share where both models part the pair, and the deflections differ by 15 to 45 degrees.
        #[unit = "-"]
        pub within_45_deg: f64,
        /// Share where both models part the pair, and the deflections differ by more than 45 degrees.
        #[unit = "-"]
        pub beyond_45_deg: f64,
        /// Share where both models give the same outcome, but the pair does not part.
        #[unit = "-"]
        pub same_outcome: f64,
        /// Share where the models give different outcomes.
        #[unit = "-"]
        pub other_outcome: f64,
        /// Share where one of the two runs failed.
        #[unit = "-"]
        pub failed: f64,
        /// Number of points of the grid.
        #[unit = "-"]
        pub points: usize,
    }
}

impl RatioRow {
    /// Names of the outcomes, in the order of [`Self::outcomes`].
    pub const OUTCOMES: [&'static str; 5] =
        ["scattered", "standoff", "pairwise", "orbiting", "undecided"];

    /// Shares of the outcomes by the method, or by exact hydrodynamics.
    #[must_use]
    pub fn outcomes(&self, exact: bool) -> [f64; 5] {
        if exact {
            [
                self.scattered_exact,
                self.standoff_exact,
                self.pairwise_exact,
                self.orbiting_exact,
                self.undecided_exact,
            ]
        } else {
            [
                self.scattered,
                self.standoff,
                self.pairwise,
                self.orbiting,
                self.undecided,
            ]
        }
    }

    /// Shares of the classes of trust, in the order of [`TRUST_CLASSES`].
    #[must_use]
    pub fn trust(&self) -> [f64; TRUST_CLASSES.len()] {
        [
            self.within_5_deg,
            self.within_15_deg,
            self.within_45_deg,
            self.beyond_45_deg,
            self.same_outcome,
            self.other_outcome,
            self.failed,
        ]
    }
}
