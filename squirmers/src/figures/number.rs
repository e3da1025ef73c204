//! Numbers in pictures: with a true minus sign, and with a power of ten if they are very large or very small.

use compare::numbers::written;

/// A number with at most six decimals, or with at most six digits before a power of ten.
pub(super) fn number(value: f64) -> String {
    if written(value).contains('e') {
        exact(format!("{value:.5e}").parse().unwrap_or(value))
    } else {
        exact((value * 1e6).round() / 1e6)
    }
}

/// A number with all its digits.
pub(super) fn exact(value: f64) -> String {
    let text = written(value);
    let Some((digits, exponent)) = text.split_once('e') else {
        return signed(&text);
    };
    let power = raised(exponent.parse().unwrap_or(0));
    match digits {
        "1" => power,
        "-1" => signed(&format!("-{power}")),
        digits => signed(&format!("{digits}·{power}")),
    }
}

/// A text with true minus signs.
pub(super) fn signed(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

/// A power of ten, such as `10⁻³` for -3.
pub(super) fn raised(exponent: i32) -> String {
    let above = |c: char| {
        let digit = c.to_digit(10).map_or(10, |digit| digit as usize);
        "⁰¹²³⁴⁵⁶⁷⁸⁹⁻".chars().nth(digit)
    };
    "10".chars()
        .chain(exponent.to_string().chars().filter_map(above))
        .collect()
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
        assert_eq!(exact(1.000_000_002e9), "1.000000002·10⁹");
    }
}
