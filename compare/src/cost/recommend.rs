//! The cheapest method and tolerance that reach a target, from the measured rows.

use serde::Serialize;

use super::{CostRow, Part};
use crate::CompareError;
use crate::columns::columns;
use crate::numbers::point_hint;

columns! {
    /// A row for each case: the cheapest model that reaches the target. NaN and `none` if no measured model reaches it.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct Recommendation {
        /// The case: an encounter of Figs 6 and 7.
        #[unit = "-"]
        pub case: String,
        /// The target: the largest error of the outgoing angles that is allowed.
        #[unit = "deg"]
        pub target_deg: f64,
        /// The model with the shortest time per trajectory, without its set-up.
        #[unit = "-"]
        pub model: String,
        /// Tolerance of the integrator for this model.
        #[unit = "-"]
        pub tolerance: f64,
        /// Error of the outgoing angles by this model.
        #[unit = "deg"]
        pub error_deg: f64,
        /// Time of one trajectory by this model.
        #[unit = "s"]
        pub seconds: f64,
        /// Time to set this model up, once.
        #[unit = "s"]
        pub set_up_seconds: f64,
        /// The model with the shortest time for a single trajectory, with its set-up.
        #[unit = "-"]
        pub model_for_one: String,
    }
}

/// The cheapest method and tolerance in each case, in the order of the rows.
#[must_use]
pub fn recommend(rows: &[CostRow], target_deg: f64) -> Vec<Recommendation> {
    let deflections = || rows.iter().filter(|row| row.part == Part::Deflection);
    let mut cases: Vec<&str> = Vec::new();
    for row in deflections() {
        if !cases.contains(&row.gap_or_case.as_str()) {
            cases.push(&row.gap_or_case);
        }
    }
    let of = |case: &&str| {
        let case = *case;
        let reach =
            || deflections().filter(move |r| r.gap_or_case == case && r.error <= target_deg);
        let cheapest = |cost: fn(&CostRow) -> f64| {
            reach()
                .filter(|row| cost(row).is_finite())
                .min_by(|a, b| cost(a).total_cmp(&cost(b)))
        };
        let many = cheapest(|row| row.seconds);
        let one = cheapest(|row| row.seconds + row.set_up_seconds);
        let name = |row: Option<&CostRow>| row.map_or("none".to_owned(), |r| r.model.clone());
        let number = |of: fn(&CostRow) -> f64| many.map_or(f64::NAN, of);
        Recommendation {
            case: case.to_owned(),
            target_deg,
            model: name(many),
            tolerance: number(|row| row.value),
            error_deg: number(|row| row.error),
            seconds: number(|row| row.seconds),
            set_up_seconds: number(|row| row.set_up_seconds),
            model_for_one: name(one),
        }
    };
    cases.iter().map(of).collect()
}

/// Parses a target such as `0.1deg`, in degrees.
///
/// # Errors
/// [`CompareError::Input`] unless the text is a positive number with or without `deg`.
pub fn parse_target(text: &str) -> Result<f64, CompareError> {
    let number = text.trim().trim_end_matches("deg").trim();
    match number.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err(CompareError::input(
            "--target",
            text,
            format!(
                "give an angle greater than 0 in degrees, such as 0.1deg{}",
                point_hint(text)
            ),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(model: &str, error: f64, seconds: f64, set_up_seconds: f64) -> CostRow {
        CostRow {
            error,
            seconds,
            set_up_seconds,
            ..CostRow::new(Part::Deflection, model, ("tolerance", 1e-6), "a case")
        }
    }

    #[test]
    fn the_cheapest_that_reaches_the_target_is_recommended() {
        let rows = [
            row("rough", 5.0, 1e-6, 0.0),
            row("table", 0.01, 1e-4, 2.0),
            row("direct", 0.02, 1.0, 0.0),
            row("failed", f64::NAN, f64::NAN, 0.0),
        ];
        let [found] = &recommend(&rows, 0.1)[..] else {
            panic!("one case, one recommendation")
        };
        assert_eq!((&*found.model, &*found.model_for_one), ("table", "direct"));
        assert_eq!(recommend(&rows, 1e-9)[0].model, "none");
    }

    #[test]
    fn targets_are_angles() {
        for text in ["0.1deg", "0.1", " 0.1 deg"] {
            assert!((parse_target(text).unwrap() - 0.1).abs() < 1e-15);
        }
        for text in ["", "deg", "-1deg", "0", "nan", "1rad"] {
            assert!(parse_target(text).is_err(), "{text}");
        }
    }
}
