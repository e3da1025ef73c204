//! Numbers with the digits that their error leaves.

use crate::numbers::size;

/// A number as text, and how far the printed number may be off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Digits {
    /// The number, down to the digit whose unit is the smallest power of ten that is not below the error.
    pub value: String,
    /// The error with that of rounding, at most one and a half units of the last digit, rounded upward.
    pub error: String,
}

impl Digits {
    /// The digits of a number whose error is at most `error`.
    pub fn of(value: f64, error: f64) -> Self {
        if !(error > 0.0 && error.is_finite() && value.is_finite()) {
            return Self {
                value: format!("{value:e}"),
                error: format!("{error:e}"),
            };
        }
        // A power of ten is not above itself by the rounding of its logarithm.
        let place = (error.log10() - 1e-9).ceil() as i32;
        Self {
            value: down_to(value, place),
            error: upward(error + 0.5 * 10_f64.powi(place)),
        }
    }
}

/// A number with its digits down to that of `10^place`.
fn down_to(value: f64, place: i32) -> String {
    let unit = 10_f64.powi(place);
    if value.abs() < unit {
        // One unit, or none.
        let whole = (value / unit).round();
        return if whole.abs() > 0.5 {
            format!("{}e{place}", whole)
        } else {
            "0".to_owned()
        };
    }
    let first = value.abs().log10().floor() as i32;
    if place <= 0 && (-5..7).contains(&first) {
        format!("{value:.*}", place.unsigned_abs() as usize)
    } else {
        format!("{value:.*e}", (first - place).unsigned_abs() as usize)
    }
}

/// An error with two digits, rounded upward.
pub(super) fn upward(error: f64) -> String {
    if !(error > f64::MIN_POSITIVE && error.is_finite()) {
        return size(error);
    }
    let unit = 10_f64.powi(error.log10().floor() as i32 - 1);
    // Rounding of the quotient is no reason for a digit more.
    size((error / unit - 1e-9).ceil() * unit)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
    use super::*;

    #[test]
    fn digits_end_where_the_error_begins() {
        for (value, error, text, printed) in [
            (std::f64::consts::PI, 2e-4, "3.142", "7.0e-4"),
            (std::f64::consts::PI, 1e-3, "3.142", "1.5e-3"),
            (-std::f64::consts::PI, 1.1e-3, "-3.14", "6.1e-3"),
            (-1e-9, 1e-5, "0", "1.5e-5"),
            (0.0, 3e-4, "0", "8.0e-4"),
            (-7e-4, 1e-3, "-1e-3", "1.5e-3"),
            (250_003.123_456, 2e-5, "250003.1235", "7.0e-5"),
            (1.234_567e-9, 1e-13, "1.2346e-9", "1.5e-13"),
            (9.999_97e-9, 1e-13, "10.0000e-9", "1.5e-13"),
            (123_456.0, 20.0, "1.235e5", "7.0e1"),
        ] {
            let digits = Digits::of(value, error);
            let (found, wanted): (f64, f64) =
                (digits.value.parse().unwrap(), text.parse().unwrap());
            assert!(
                (found - wanted).abs() <= 1e-12 * wanted.abs(),
                "{digits:?} {text}"
            );
            assert_eq!(digits.error, printed, "{digits:?}");
            if !text.contains("e-9") {
                assert_eq!(digits.value, text);
            }
        }
    }

    #[test]
    fn a_printed_number_is_off_by_no_more_than_it_says() {
        for k in 0..2000 {
            let value = f64::from(k % 89 - 44) * 10_f64.powi(k % 23 - 15) / 7.0;
            let error = 10_f64.powf(f64::from(k % 31) / 2.0 - 14.0);
            let digits = Digits::of(value, error);
            let [printed, said]: [f64; 2] =
                [&digits.value, &digits.error].map(|text| text.parse().unwrap());
            // The difference itself is off by the rounding of the two.
            let off = (printed - value).abs() - 1e-15 * value.abs();
            assert!(off + error <= said * (1.0 + 1e-9), "{digits:?} of {value}");
            assert!(said < 17.0 * error, "{digits:?} of {value} and {error}");
        }
    }

    #[test]
    fn what_has_no_error_or_no_value_is_printed_as_it_is() {
        assert_eq!(Digits::of(0.25, 0.0).value, "2.5e-1");
        assert_eq!(Digits::of(f64::NAN, 1e-3).value, "NaN");
        assert_eq!(Digits::of(1.0, f64::INFINITY).error, "inf");
        assert_eq!([0.0, f64::INFINITY].map(upward), ["0.0e0", "inf"]);
    }
}
