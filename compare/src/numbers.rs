//! Numbers as text. Reads lists `1,2,5`, ranges `a:b:step` and logarithmic ranges `a:b:log:count` from the command
//! line. Writes numbers for tables.

use std::ops::Range;

/// Largest number of numbers in a list.
const MOST: usize = 100_000;

/// A list of finite numbers, not empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers(pub Vec<f64>);

impl Numbers {
    /// A list, if it has one number at least, all are finite, and none is there twice.
    ///
    /// # Errors
    /// One line that says what is wrong.
    pub fn new(numbers: Vec<f64>) -> Result<Self, String> {
        if numbers.is_empty() {
            return Err("the list is empty: give one number at least".to_owned());
        }
        if numbers.len() > MOST {
            return Err(format!("the list is longer than {MOST} numbers"));
        }
        if let Some(wrong) = numbers.iter().find(|number| !number.is_finite()) {
            return Err(format!("{wrong:?} is in the list: numbers must be finite"));
        }
        let mut sorted = numbers.clone();
        sorted.sort_by(f64::total_cmp);
        match sorted
            .windows(2)
            .find(|two| two[0].total_cmp(&two[1]).is_eq())
        {
            Some(two) => Err(format!("{:?} is in the list twice: once is enough", two[0])),
            None => Ok(Self(numbers)),
        }
    }
}

/// Parses numbers, ranges `a:b:step` and logarithmic ranges `a:b:log:count`, separated by commas. Ranges contain
/// both ends.
///
/// # Errors
/// One line with the part that is wrong and with what is allowed.
///
/// ```
/// use compare::parse_numbers;
/// assert_eq!(parse_numbers("-1,0:1:0.5")?.0, [-1.0, 0.0, 0.5, 1.0]);
/// assert_eq!(parse_numbers("0.01:1:log:3")?.0, [0.01, 0.1, 1.0]);
/// assert!(parse_numbers("1,x").unwrap_err().contains("'x'"));
/// # Ok::<(), String>(())
/// ```
pub fn parse_numbers(text: &str) -> Result<Numbers, String> {
    if text.trim().is_empty() {
        return Err("the list is empty: give numbers such as 1,2,5 or a range a:b:step".to_owned());
    }
    let mut numbers = Vec::new();
    for part in text.split(',') {
        match *part.split(':').collect::<Vec<_>>() {
            [single] => numbers.push(number(single)?),
            [from, to, step] => range(number(from)?, number(to)?, number(step)?, &mut numbers)?,
            [from, to, "log", count] => {
                logarithmic(
                    number(from)?,
                    number(to)?,
                    parse_whole(count)?,
                    &mut numbers,
                )?;
            }
            _ => {
                return Err(format!(
                    "'{part}' is neither a number nor a range a:b:step or a:b:log:count"
                ));
            }
        }
        if numbers.len() > MOST {
            return Err(format!(
                "'{part}' makes the list longer than {MOST} numbers"
            ));
        }
    }
    Numbers::new(numbers)
}

fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(format!("'{text}' is not allowed: numbers must be finite")),
        Err(_) => Err(format!(
            "'{text}' is not a number: give a comma list such as 1,2,5 or a range a:b:step; decimals take a point"
        )),
    }
}

/// Parses one number, which may be infinite.
///
/// # Errors
/// One line with the text that is not a number.
pub fn parse_number(text: &str) -> Result<f64, String> {
    (text.trim().parse()).map_err(|_| format!("'{text}' is not a number{}", point_hint(text)))
}

/// Parses a whole number, 0 or more.
///
/// # Errors
/// One line with the text that is not a whole number.
pub fn parse_whole(text: &str) -> Result<usize, String> {
    (text.trim().parse()).map_err(|_| format!("'{text}' is not a whole number, 0 or more"))
}

/// A hint if `text` has a decimal comma; otherwise empty.
pub fn point_hint(text: &str) -> String {
    decimal_comma(text).map_or(String::new(), |at| {
        format!(": decimals take a point, {}", text[at].replace(',', "."))
    })
}

/// Position in `text` of the first number with a decimal comma, such as `5,0` or `-1,5e-8`. Commas between brackets
/// separate the numbers of a list.
pub(crate) fn decimal_comma(text: &str) -> Option<Range<usize>> {
    let mut depth = 0_usize;
    let mut begin = None;
    // The end of the text ends a number too.
    for (at, character) in text.char_indices().chain([(text.len(), ' ')]) {
        let is_part = character.is_ascii_digit() || ",+-.eE".contains(character);
        match (begin, is_part) {
            (None, true) => begin = Some(at),
            (Some(from), false) => {
                let comma = (text[from..at].trim_end_matches(','))
                    .split_once(',')
                    .filter(|(whole, decimals)| {
                        let starts = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
                        let value = format!("{whole}.{decimals}").parse::<f64>();
                        starts(whole.trim_start_matches(['+', '-']))
                            && starts(decimals)
                            && value.is_ok()
                    });
                if let (Some((whole, decimals)), 0) = (comma, depth) {
                    return Some(from..from + whole.len() + 1 + decimals.len());
                }
                begin = None;
            }
            _ => {}
        }
        match character {
            '[' => depth += 1,
            ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    None
}

fn range(from: f64, to: f64, step: f64, numbers: &mut Vec<f64>) -> Result<(), String> {
    let count = (to - from) / step;
    if !(count >= 0.0 && count.is_finite()) {
        return Err(format!(
            "range {} is empty: the step must lead from the first to the second number; decimals take a point",
            [from, to, step].map(written).join(":")
        ));
    }
    if count > MOST as f64 {
        return Err(format!(
            "range {} holds more than {MOST} numbers",
            [from, to, step].map(written).join(":")
        ));
    }
    // Rounding must not drop the last point.
    let last = (count + 1e-9).floor() as usize;
    numbers.extend((0..=last).map(|i| as_typed(from + i as f64 * step, step)));
    Ok(())
}

/// `count` numbers whose logarithms are evenly spread.
fn logarithmic(from: f64, to: f64, count: usize, numbers: &mut Vec<f64>) -> Result<(), String> {
    let range = || format!("{}:{}:log:{count}", written(from), written(to));
    let sign = from.signum();
    // The ratio of the ends may be too large a number.
    let [first, last] = [from, to].map(|end| (sign * end).log10());
    if !(first.is_finite() && last.is_finite()) {
        return Err(format!(
            "range {} has no logarithms: both ends must be greater than 0, or both less",
            range()
        ));
    }
    if !(2..=MOST).contains(&count) {
        return Err(format!(
            "range {} must hold from 2 to {MOST} numbers",
            range()
        ));
    }
    numbers.extend((0..count).map(|i| match i {
        0 => from,
        i if i + 1 == count => to,
        i => {
            let share = i as f64 / (count - 1) as f64;
            let value = sign * 10_f64.powf(first + (last - first) * share);
            as_typed(value, value)
        }
    }));
    Ok(())
}

/// A number as a person reads it: with an exponent where it would otherwise be a row of zeros.
#[must_use]
pub fn written(value: f64) -> String {
    // A zero has no sign.
    let value = value + 0.0;
    if is_plain(value) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// A number with at most six digits, as a person reads it: of a gap that is no round number.
#[must_use]
pub fn few_digits(value: f64) -> String {
    written(format!("{value:.5e}").parse().unwrap_or(value))
}

/// A number with `digits` digits after the point, and with an exponent where it would otherwise be a row of zeros.
#[must_use]
pub fn rounded(value: f64, digits: usize) -> String {
    let value = value + 0.0;
    if is_plain(value) {
        format!("{value:.digits$}")
    } else {
        format!("{value:.digits$e}")
    }
}

/// An error, a bound or a time, of which only the order of magnitude matters.
#[must_use]
pub fn size(value: f64) -> String {
    format!("{:.1e}", value + 0.0)
}

fn is_plain(value: f64) -> bool {
    value == 0.0 || !value.is_finite() || (1e-4..1e6).contains(&value.abs())
}

/// A number of a range as a person types it: `0.1 * 3` is not `0.3` in floating point, so digits more than twelve
/// places below the step are rounded away.
pub(crate) fn as_typed(value: f64, step: f64) -> f64 {
    let digits = 12 - step.abs().log10().floor() as i32;
    let scale = 10_f64.powi(digits.clamp(0, 300));
    let scaled = value * scale;
    // Numbers this large are whole numbers: there is nothing to round.
    if scaled.abs() < 9e15 {
        scaled.round() / scale
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_include_both_ends_and_print_as_typed() {
        let numbers = parse_numbers("0:0.5:0.1").unwrap().0;
        assert_eq!(numbers, [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]);
        assert_eq!(parse_numbers("2:-2:-2").unwrap().0, [2.0, 0.0, -2.0]);
    }

    #[test]
    fn numbers_are_read_without_rows_of_zeros() {
        for (value, text) in [
            (0.0, "0"),
            (1e-300, "1e-300"),
            (0.0001, "0.0001"),
            (999_999.0, "999999"),
            (-2.5e7, "-2.5e7"),
        ] {
            assert_eq!(written(value), text);
        }
        assert_eq!(rounded(2.5e299, 3), "2.500e299");
        assert_eq!(rounded(0.25, 3), "0.250");
        assert_eq!(rounded(-0.0, 2), "0.00");
        assert_eq!(written(-0.0), "0");
        assert_eq!(size(1.234e-6), "1.2e-6");
    }

    #[test]
    fn logarithmic_ranges_have_one_ratio_and_both_ends() {
        let numbers = parse_numbers("-3:-0.003:log:4").unwrap().0;
        assert_eq!(numbers, [-3.0, -0.3, -0.03, -0.003]);
        let numbers = parse_numbers("1e-300:1e300:log:7").unwrap().0;
        for two in numbers.windows(2) {
            assert!((two[1] / two[0] / 1e100 - 1.0).abs() < 1e-9, "{numbers:?}");
        }
        assert_eq!((numbers[0], numbers[6]), (1e-300, 1e300));
    }

    #[test]
    fn ranges_of_tiny_numbers_keep_their_digits() {
        let numbers = parse_numbers("1e-14:3e-14:1e-14").unwrap().0;
        for (found, expected) in numbers.iter().zip([1e-14, 2e-14, 3e-14]) {
            assert!((found / expected - 1.0).abs() < 1e-12, "{numbers:?}");
        }
        let numbers = parse_numbers("1e-9:1e-8:4.5e-9").unwrap().0;
        assert_eq!(numbers, [1e-9, 5.5e-9, 1e-8]);
    }

    #[test]
    fn a_number_that_is_there_twice_is_refused() {
        for text in ["1,2,1", "0:1:0.5,0.5"] {
            let error = parse_numbers(text).unwrap_err();
            assert!(error.contains("twice"), "{error}");
        }
    }

    #[test]
    fn decimal_commas_are_told_from_those_of_lists() {
        for (text, number) in [
            ("5,0", "5,0"),
            ("beta = -1,5e-8 # five", "-1,5e-8"),
            ("{ kappa1 = 10,5, kappa2 = 100 }", "10,5"),
            ("[1, 2] 0,1deg", "0,1"),
        ] {
            assert_eq!(
                decimal_comma(text).map(|at| &text[at]),
                Some(number),
                "{text}"
            );
        }
        for text in [
            "", "5.0", "[1,5, 2]", "1,2,3", "a,5", "5,b", "5,", ",5", "1, 5", "-,5", "e,5",
        ] {
            assert_eq!(decimal_comma(text), None, "{text}");
        }
        assert_eq!(
            parse_number("1,5e-8").unwrap_err(),
            "'1,5e-8' is not a number: decimals take a point, 1.5e-8"
        );
        assert_eq!(parse_number("x,5").unwrap_err(), "'x,5' is not a number");
        assert!(parse_whole("1,5").unwrap_err().contains("whole number"));
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (text, named) in [
            ("", "empty"),
            ("1,,2", "''"),
            ("nan", "'nan'"),
            ("1,inf", "'inf'"),
            ("1:2", "'1:2'"),
            ("0:1:log:3", "0:1:log:3"),
            ("-1:1:log:3", "-1:1:log:3"),
            ("1:2:log:1", "from 2"),
            ("1:2:log:x", "'x'"),
            ("1:2:ln:3", "'1:2:ln:3'"),
            ("1:2:-1", "1:2:-1"),
            ("0:1:0", "0:1:0"),
            ("0:1:1e-9", "more than"),
        ] {
            let error = parse_numbers(text).unwrap_err();
            assert!(error.contains(named), "{text}: {error}");
            assert!(!error.contains('\n'));
        }
    }
}
