//! Numbers as a picture writes them.

use compare::numbers::written;

/// A true minus sign.
const MINUS: char = '\u{2212}';

/// A number without trailing zeros and with a true minus sign; very large and very small ones with a power of ten.
pub(super) fn number(value: f64) -> String {
    let value = value + 0.0;
    if !written(value).contains('e') {
        let rounded = (value * 1e6).round() / 1e6 + 0.0;
        return rounded.to_string().replace('-', &MINUS.to_string());
    }
    let text = format!("{value:.5e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
    let power = raised(exponent.parse().unwrap_or(0));
    let text = match mantissa {
        "1" => power,
        "-1" => format!("-{power}"),
        other => format!("{other}·{power}"),
    };
    text.replace('-', &MINUS.to_string())
}

/// `10⁻³` for -3.
pub(super) fn raised(exponent: i32) -> String {
    let plain = exponent.to_string();
    let above = plain.chars().map(|c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' | '4'..='9' => char::from_u32('⁰' as u32 + c as u32 - '0' as u32).unwrap_or(c),
        other => other,
    });
    "10".chars().chain(above).collect()
}

/// `n * 10^exponent` digit by digit, without trailing zeros and with a true minus sign.
pub(super) fn decimal(n: i64, exponent: i32) -> String {
    if n == 0 {
        return "0".to_owned();
    }
    let digits = n.unsigned_abs().to_string();
    let sign = if n < 0 {
        MINUS.to_string()
    } else {
        String::new()
    };
    let places = exponent.unsigned_abs() as usize;
    if exponent >= 0 {
        return format!("{sign}{digits}{}", "0".repeat(places));
    }
    let digits = format!("{digits:0>width$}", width = places + 1);
    let (whole, fraction) = digits.split_at(digits.len() - places);
    match fraction.trim_end_matches('0') {
        "" => format!("{sign}{whole}"),
        fraction => format!("{sign}{whole}.{fraction}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(-0.0), "0");
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(-5.0), "−5");
        assert_eq!(number(0.000_25), "0.00025");
    }

    #[test]
    fn tiny_and_huge_numbers_are_neither_zero_nor_rows_of_digits() {
        assert_eq!(number(1e-300), "10⁻³⁰⁰");
        assert_eq!(number(-1e9), "−10⁹");
        assert_eq!(number(-2.5e-7), "−2.5·10⁻⁷");
        assert_eq!(number(f64::MAX), "1.79769·10³⁰⁸");
    }

    #[test]
    fn decimals_have_the_digits_of_their_tick() {
        for (n, exponent, text) in [
            (0, -9, "0"),
            (25, -1, "2.5"),
            (-20, -1, "−2"),
            (5, -3, "0.005"),
            (12, 2, "1200"),
        ] {
            assert_eq!(decimal(n, exponent), text);
        }
    }
}
