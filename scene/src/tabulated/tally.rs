//! How far the building of a table is, while nobody knows yet how many gaps it will take.

use std::sync::{Mutex, PoisonError};

use crate::chebyshev::FIRST_DEGREE;

/// How far the building of a table is, in gaps at which the model is asked: the points of the interpolants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BuildProgress {
    /// Gaps done; it never falls.
    pub done: usize,
    /// Gaps in the end as far as can be told: those done, and those that each unfinished piece still takes. Pieces
    /// turn out to need more or fewer points than others did, so that it grows and shrinks. It is never less than
    /// `done`, and is `done` at the end.
    pub expected: usize,
}

/// Gaps that a piece takes if it converges at a degree above the first one, which nearly all do.
const LEAST: usize = 2 * FIRST_DEGREE + 1;

/// Counts for a [`BuildProgress`], and tells them.
pub(super) struct Tally<'a> {
    counts: Mutex<Counts>,
    tell: &'a (dyn Fn(BuildProgress) + Sync),
}

#[derive(Default)]
struct Counts {
    done: usize,
    /// Pieces not begun.
    waiting: usize,
    /// Gaps that the pieces under way still take.
    ahead: usize,
    /// Pieces finished, and the gaps that these took.
    finished: usize,
    taken: usize,
}

impl Counts {
    fn progress(&self) -> BuildProgress {
        // A piece that is not begun will be like those that are finished.
        let usual = (self.taken.checked_div(self.finished)).map_or(LEAST, |mean| mean.max(LEAST));
        BuildProgress {
            done: self.done,
            expected: self.done + self.ahead + self.waiting * usual,
        }
    }
}

impl<'a> Tally<'a> {
    pub(super) fn new(tell: &'a (dyn Fn(BuildProgress) + Sync)) -> Self {
        Self {
            counts: Mutex::default(),
            tell,
        }
    }

    fn change(&self, change: impl FnOnce(&mut Counts)) {
        change(&mut self.counts.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// So many more pieces are to be built.
    pub(super) fn wait_for(&self, pieces: usize) {
        self.change(|counts| {
            counts.waiting += pieces;
            (self.tell)(counts.progress());
        });
    }

    /// A piece is begun.
    pub(super) fn begin(&self) {
        self.change(|counts| {
            counts.waiting = counts.waiting.saturating_sub(1);
            counts.ahead += LEAST;
        });
    }

    /// The interpolant of a piece is not good enough at `degree`, the one that was tried last: the next one is twice
    /// that, and until then nobody knows whether it will do.
    pub(super) fn try_beyond(&self, degree: usize) {
        // The points of the second degree were counted when the piece began.
        if degree > FIRST_DEGREE {
            self.change(|counts| counts.ahead += degree);
        }
    }

    /// A piece that took `degree` is finished.
    pub(super) fn finish(&self, degree: usize) {
        self.change(|counts| {
            counts.finished += 1;
            counts.taken += degree + 1;
            if degree == FIRST_DEGREE {
                counts.ahead = counts.ahead.saturating_sub(FIRST_DEGREE);
                (self.tell)(counts.progress());
            }
        });
    }

    /// A piece is given up at the highest degree for its halves.
    pub(super) fn halve(&self) {
        self.change(|counts| counts.waiting += 2);
    }

    /// One more gap is done.
    pub(super) fn one_done(&self) {
        self.change(|counts| {
            counts.done += 1;
            counts.ahead = counts.ahead.saturating_sub(1);
            // Told under the lock, so that what is told never goes back.
            (self.tell)(counts.progress());
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::table_that_says;
    use super::*;

    /// What is told of a building whose pieces take these degrees, one after another.
    fn told(degrees: &[usize]) -> Vec<BuildProgress> {
        let told = Mutex::new(Vec::new());
        let tell = |progress| told.lock().unwrap().push(progress);
        let tally = Tally::new(&tell);
        tally.wait_for(degrees.len());
        for &last in degrees {
            tally.begin();
            tally.all_done(FIRST_DEGREE + 1);
            let mut degree = FIRST_DEGREE;
            while degree < last {
                tally.try_beyond(degree);
                tally.all_done(degree);
                degree *= 2;
            }
            tally.finish(degree);
        }
        told.into_inner().unwrap()
    }

    impl Tally<'_> {
        fn all_done(&self, gaps: usize) {
            (0..gaps).for_each(|_| self.one_done());
        }
    }

    #[test]
    fn what_is_expected_is_what_is_done_in_the_end() {
        for degrees in [&[4][..], &[8], &[4, 32, 8], &[16, 4, 4, 32]] {
            let told = told(degrees);
            let gaps: usize = degrees.iter().map(|degree| degree + 1).sum();
            let (done, expected) = (gaps, gaps);
            assert_eq!(told.last(), Some(&BuildProgress { done, expected }));
            let corrected = degrees.iter().filter(|&&degree| degree == FIRST_DEGREE);
            assert_eq!(told.len(), 1 + gaps + corrected.count());
        }
    }

    #[test]
    fn pieces_not_begun_are_expected_to_be_like_those_finished() {
        let told = told(&[32; 10]);
        assert_eq!(told[0].expected, 10 * LEAST);
        let one = 32 + 1;
        // With the first gap of the second piece.
        assert_eq!(told[1 + one].expected, one + LEAST + 8 * one);
    }

    #[test]
    fn a_table_tells_how_far_it_is_and_how_far_it_will_probably_go() {
        for (seam, halved) in [(None, false), (Some(0.37), true)] {
            let told = Mutex::new(Vec::new());
            let tell = |progress| told.lock().unwrap().push(progress);
            let table = table_that_says(None, seam, &tell);
            let told = told.into_inner().unwrap();
            let mut dones: Vec<_> = told.iter().map(|told| told.done).collect();
            dones.dedup();
            assert_eq!(dones, (0..dones.len()).collect::<Vec<_>>());
            assert!(told.iter().all(|told| told.expected >= told.done));
            let last = told.last().unwrap();
            assert_eq!(last.expected, last.done);
            // Groups of columns share gaps.
            assert!(last.done < table.summary().evaluations);
            assert_eq!(last.done > 500, halved, "{}", last.done);
        }
    }
}
