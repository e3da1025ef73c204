//! What the fuzz targets share: what a message and a number have to be.

use std::fmt::Display;

use arbitrary::Arbitrary;

/// Longest message, in bytes.
const LONGEST: usize = 1500;

/// Checks that an error is one clear line: not empty, not long, without control characters.
///
/// # Panics
/// If it is not.
pub fn one_line(error: &impl Display) {
    let message = error.to_string();
    assert!(
        !message.is_empty()
            && message.len() <= LONGEST
            && !message.contains(|letter: char| letter.is_control()),
        "{} bytes: {message:?}",
        message.len()
    );
}

/// Checks that a number is finite.
///
/// # Panics
/// If it is not.
#[track_caller]
pub fn finite(what: &str, value: f64) {
    assert!(value.is_finite(), "{what} = {value}");
}

/// A number: bytes of a double alone are nearly always out of any range.
#[derive(Arbitrary, Clone, Copy, Debug)]
pub enum Number {
    /// Any double.
    Any(f64),
    /// Thousandths, to 32.
    Thousandths(i16),
    /// A whole number.
    Whole(i8),
    /// A power of ten, with a factor in hundredths.
    Power(i8, i8),
}

impl Number {
    /// Its value.
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Self::Any(value) => value,
            Self::Thousandths(value) => f64::from(value) / 1000.0,
            Self::Whole(value) => f64::from(value),
            Self::Power(factor, power) => f64::from(factor) / 100.0 * 10f64.powi(power.into()),
        }
    }
}

/// Files in one text, so that a corpus can be read and written by hand: a line `--- NAME` before each file.
pub fn files(bytes: &[u8]) -> impl Iterator<Item = (&str, &[u8])> {
    const MARK: &[u8] = b"--- ";
    let mut rest = bytes;
    std::iter::from_fn(move || {
        rest = rest.strip_prefix(MARK)?;
        let end = rest.iter().position(|byte| *byte == b'\n')?;
        let (name, after) = rest.split_at(end);
        let after = &after[1..];
        let next = (after.windows(MARK.len() + 1))
            .position(|window| window[0] == b'\n' && &window[1..] == MARK)
            .map_or(after.len(), |place| place + 1);
        let (text, following) = after.split_at(next);
        rest = following;
        Some((std::str::from_utf8(name).unwrap_or_default(), text))
    })
}
