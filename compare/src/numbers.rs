//! Lists of numbers on the command line: `1,2,5` and ranges `a:b:step`.

/// Most numbers that one list may hold.
const MOST: usize = 100_000;

/// A list of finite numbers, not empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers(pub Vec<f64>);

/// Parses a comma list of numbers and ranges `a:b:step` (both ends included).
///
/// # Errors
/// One line that names the part that is wrong and what is allowed.
///
/// ```
/// use compare::parse_numbers;
/// assert_eq!(parse_numbers("-1,0:1:0.5")?.0, [-1.0, 0.0, 0.5, 1.0]);
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
            _ => return Err(format!("'{part}' is neither a number nor a range a:b:step")),
        }
        if numbers.len() > MOST {
            return Err(format!(
                "'{part}' makes the list longer than {MOST} numbers"
            ));
        }
    }
    let mut sorted = numbers.clone();
    sorted.sort_by(f64::total_cmp);
    match sorted
        .windows(2)
        .find(|two| two[0].total_cmp(&two[1]).is_eq())
    {
        Some(two) => Err(format!("{:?} is in the list twice: once is enough", two[0])),
        None => Ok(Numbers(numbers)),
    }
}

fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(format!("'{text}' is not allowed: numbers must be finite")),
        Err(_) => Err(format!(
            "'{text}' is not a number: give a comma list such as 1,2,5 or a range a:b:step"
        )),
    }
}

fn range(from: f64, to: f64, step: f64, numbers: &mut Vec<f64>) -> Result<(), String> {
    let count = (to - from) / step;
    if !(count >= 0.0 && count.is_finite()) {
        return Err(format!(
            "range {from}:{to}:{step} is empty: the step must lead from the first to the second number"
        ));
    }
    if count > MOST as f64 {
        return Err(format!(
            "range {from}:{to}:{step} holds more than {MOST} numbers"
        ));
    }
    // The last point may be missed by rounding only.
    let last = (count + 1e-9).floor() as usize;
    numbers.extend((0..=last).map(|i| as_typed(from + i as f64 * step, step)));
    Ok(())
}

/// A number as a person reads it: with an exponent where it would otherwise be a row of zeros.
#[must_use]
pub(crate) fn written(value: f64) -> String {
    if is_plain(value) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// The same with a number of digits after the point.
#[must_use]
pub(crate) fn rounded(value: f64, digits: usize) -> String {
    if is_plain(value) {
        format!("{value:.digits$}")
    } else {
        format!("{value:.digits$e}")
    }
}

fn is_plain(value: f64) -> bool {
    value == 0.0 || !value.is_finite() || (1e-4..1e6).contains(&value.abs())
}

/// A number of a range as it would have been typed: 0.1 * 3 is not 0.3, so what lies twelve digits below the step is
/// rounding.
fn as_typed(value: f64, step: f64) -> f64 {
    let digits = 12 - step.abs().log10().floor() as i32;
    let scale = 10_f64.powi(digits.clamp(0, 300));
    let scaled = value * scale;
    // Where a whole number no longer tells its neighbours apart there is nothing to round.
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
    fn what_is_wrong_is_named() {
        for (text, named) in [
            ("", "empty"),
            ("1,,2", "''"),
            ("nan", "'nan'"),
            ("1,inf", "'inf'"),
            ("1:2", "'1:2'"),
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
