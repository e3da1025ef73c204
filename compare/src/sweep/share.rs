//! The share of a sweep that one process runs.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Largest number of shares of a sweep.
const MOST: usize = 100_000;

/// Share `number` of `of`, counted from 1. A share is a contiguous range of units; sizes differ by at most one unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Share {
    /// Number of this share, from 1.
    pub number: usize,
    /// Number of shares.
    pub of: usize,
}

impl Share {
    /// The share that is the whole sweep.
    pub const ALL: Self = Self { number: 1, of: 1 };

    /// Whether there is such a share.
    pub(super) fn is_allowed(self) -> bool {
        (1..=self.of).contains(&self.number) && self.of <= MOST
    }

    /// The range of units of this share, for a sweep of `all` units.
    #[must_use]
    pub fn units(self, all: usize) -> Range<usize> {
        // The product of any two of these numbers fits into 128 bits.
        let edge = |share: usize| (share as u128 * all as u128 / self.of as u128) as usize;
        edge(self.number - 1)..edge(self.number)
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Share {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| {
            let [number, of] = [number, of].map(|part| part.trim().parse::<usize>().ok());
            Some((number?, of?))
        });
        let share = numbers.map(|(number, of)| Self { number, of });
        share.filter(|share| share.is_allowed()).ok_or_else(|| {
            format!(
                "'{text}' is not a share: give m/n, m from 1 to n and n at most {MOST}, such as 2/7"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_contiguous_and_hold_every_unit_once() {
        for all in [0, 1, 6, 7, 8, 1000, usize::MAX] {
            let mut next = 0;
            let mut lengths = Vec::new();
            for number in 1..=7 {
                let units = Share { number, of: 7 }.units(all);
                assert_eq!(units.start, next, "share {number} of {all}");
                next = units.end;
                lengths.push(units.len());
            }
            assert_eq!(next, all);
            let spread = lengths.iter().max().unwrap() - lengths.iter().min().unwrap();
            assert!(spread <= 1, "{lengths:?}");
        }
    }

    #[test]
    fn what_is_no_share_is_refused() {
        for text in [
            "", "1", "0/7", "8/7", "1/0", "-1/7", "a/7", "1/7/2", "1/100001",
        ] {
            let error = text.parse::<Share>().unwrap_err();
            assert!(error.contains(&format!("'{text}'")), "{error}");
        }
        let share: Share = " 3 / 7 ".parse().unwrap();
        assert_eq!(share.to_string(), "3/7");
        assert_eq!(share.to_string().parse(), Ok(share));
    }
}
