//! Numbers that follow from the measured rows: ratios, exponents and break-even points.

use serde::Serialize;

use super::deflections::COARSE_LEVEL;
use super::profile::{RIGHT_HAND_SIDE, VELOCITY_AT_ANY_GAP};
use super::scaling::{BEM_PARTS, SWEEP};
use super::{CostRow, Part};
use crate::Method;
use crate::columns::columns;

columns! {
    /// A row for each number that follows from the measured rows.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct Finding {
        /// Name of the number.
        #[unit = "-"]
        pub finding: String,
        /// The model or the measurement that the number describes.
        #[unit = "-"]
        pub of: String,
        /// The number, in the unit of the next column. NaN if the rows do not contain it.
        #[unit = "varies"]
        pub value: f64,
        /// Unit of the number; empty for a pure number.
        #[unit = "-"]
        pub unit: &'static str,
    }
}

impl Finding {
    fn new(finding: &str, of: impl Into<String>, value: f64, unit: &'static str) -> Self {
        Self {
            finding: finding.to_owned(),
            of: of.into(),
            value,
            unit,
        }
    }
}

/// All numbers that follow from the rows.
#[must_use]
pub fn findings(rows: &[CostRow]) -> Vec<Finding> {
    let mut findings = speeds(rows);
    findings.extend(set_ups(rows));
    findings.extend((break_even(rows).into_iter()).map(|(model, trajectories)| {
        Finding::new(
            "the table has paid for itself after",
            model,
            trajectories,
            "runs",
        )
    }));
    findings.extend(BEM_PARTS.map(|model| {
        let power = exponent(rows, model);
        Finding::new("time goes as unknowns to the power", model, power, "")
    }));
    findings.extend(sweeps(rows));
    let most = (rows.iter())
        .map(|r| r.peak_memory_mib)
        .fold(f64::NAN, f64::max);
    findings.push(Finding::new("peak memory", "this measurement", most, "MiB"));
    findings
}

/// Name of the finding on the time of a collision.
pub const COLLISION: &str = "slowest collision of Fig. 6, tol 1e-8";
/// Name of the finding on the cost of a right-hand side.
pub const RIGHT_HAND_SIDES: &str = "right-hand side over lubrication's";
/// Name of the finding on the cost of solving for every load instead of reading a table.
pub const DIRECT: &str = "solved trajectory over tabulated, least";

/// Times of trajectories, right-hand sides and velocities, and their ratios.
fn speeds(rows: &[CostRow]) -> Vec<Finding> {
    let lt = Method::Lt.name();
    let coarse = format!("bem-{COARSE_LEVEL}");
    let collision = |model: &str| {
        let seconds = (rows.iter())
            .filter(|r| is_trajectory(r, model, 1e-8) && r.gap_or_case.starts_with(FIG_6))
            .map(|r| r.seconds);
        Finding::new(
            COLLISION,
            model,
            1e6 * seconds.fold(f64::NAN, f64::max),
            "µs",
        )
    };
    let right_hand_side = |model: &str| {
        (rows.iter())
            .find(|r| r.part == Part::Profile && r.model == model && r.knob == RIGHT_HAND_SIDE)
            .map_or(f64::NAN, |r| r.seconds)
    };
    let velocities = || rows.iter().filter(|r| r.knob == VELOCITY_AT_ANY_GAP);
    let most = |of: fn(&CostRow) -> f64| velocities().map(of).fold(f64::NAN, f64::max);
    let ratio = right_hand_side("exact-table") / right_hand_side(lt);
    vec![
        collision(lt),
        collision("exact-table"),
        Finding::new(RIGHT_HAND_SIDES, "exact-table", ratio, "times"),
        Finding::new(
            "slowest velocity at any gap",
            "exact-table",
            1e6 * most(|r| r.seconds),
            "µs",
        ),
        Finding::new(
            "largest error of a velocity at any gap",
            "exact-table",
            most(|r| r.error),
            "V_s",
        ),
        Finding::new(DIRECT, &*coarse, direct_over_table(rows, &coarse), "times"),
    ]
}

/// Time to build each table, once. Of tables with several tolerances, the longest time counts.
fn set_ups(rows: &[CostRow]) -> impl Iterator<Item = Finding> {
    tabulated(rows).into_iter().map(|model| {
        let seconds = (rows.iter())
            .filter(|row| row.part == Part::Deflection && row.model == model)
            .map(|row| row.set_up_seconds);
        Finding::new(
            "building the table",
            model,
            seconds.fold(f64::NAN, f64::max),
            "s",
        )
    })
}

/// The models with a table whose trajectories were timed.
fn tabulated(rows: &[CostRow]) -> Vec<&str> {
    let mut models: Vec<&str> = (rows.iter())
        .filter(|row| row.part == Part::Deflection && row.model.ends_with("-table"))
        .map(|row| row.model.as_str())
        .collect();
    models.sort_unstable();
    models.dedup();
    models
}

/// Beginning of the names of the cases of Fig. 6.
const FIG_6: &str = "head-on";

/// The tolerance at which trajectories with and without a table are compared.
const COMPARED_AT: f64 = 1e-4;

fn is_trajectory(row: &CostRow, model: &str, tolerance: f64) -> bool {
    row.part == Part::Deflection && row.model == model && (row.value / tolerance - 1.0).abs() < 1e-9
}

/// Time of a trajectory by `direct`, divided by the time by the exact table at the same tolerance: the smallest ratio
/// of all cases.
fn direct_over_table(rows: &[CostRow], direct: &str) -> f64 {
    let seconds = |case: &str| {
        (rows.iter())
            .find(|r| is_trajectory(r, "exact-table", COMPARED_AT) && r.gap_or_case == case)
            .map_or(f64::NAN, |r| r.seconds)
    };
    (rows.iter())
        .filter(|r| is_trajectory(r, direct, COMPARED_AT))
        .map(|r| r.seconds / seconds(&r.gap_or_case))
        .fold(f64::NAN, f64::min)
}

/// Speed-up by two threads instead of one.
fn sweeps(rows: &[CostRow]) -> Vec<Finding> {
    let by = |threads: &'static str| {
        (rows.iter()).filter(move |r| r.model == SWEEP && r.gap_or_case == threads)
    };
    (by("1 thread").zip(by("2 threads")))
        .map(|(one, two)| {
            let of = format!("{} trajectories", one.value);
            Finding::new(
                "two threads against one",
                of,
                one.seconds / two.seconds,
                "times",
            )
        })
        .collect()
}

/// Exponent of a power law for the times of `model` as a function of the varied quantity, by least squares of the
/// logarithms. NaN for fewer than two points.
fn exponent(rows: &[CostRow], model: &str) -> f64 {
    let points: Vec<_> = (rows.iter())
        .filter(|row| row.part == Part::Scaling && row.model == model)
        .map(|row| (row.value.ln(), row.seconds.ln()))
        .collect();
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let variance: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    covariance / variance
}

/// Number of trajectories after which a table has saved as much time as its building took: set-up time divided by the
/// time that a table saves per trajectory. Uses the median over the cases at the tolerance 1e-8, and the time of one
/// solve at the gap 0.01.
fn break_even(rows: &[CostRow]) -> Vec<(String, f64)> {
    let of = |model: &str| {
        let mine: Vec<&CostRow> = (rows.iter())
            .filter(|r| r.part == Part::Deflection && r.model == model)
            .filter(|r| (r.value.log10() + 8.0).abs() < 0.1 && r.seconds.is_finite())
            .collect();
        let middle = |of: fn(&CostRow) -> f64| {
            let mut values: Vec<f64> = mine.iter().map(|row| of(row)).collect();
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
        };
        let direct = middle(|row| row.loads) * seconds_of_solve(rows, model);
        middle(|row| row.set_up_seconds) / (direct - middle(|row| row.seconds))
    };
    (tabulated(rows).into_iter())
        .map(|model| (model.to_owned(), of(model)))
        .collect()
}

/// Seconds of one solve at the gap 0.01 by the model that is tabulated in `model`.
fn seconds_of_solve(rows: &[CostRow], model: &str) -> f64 {
    let behind = model.trim_end_matches("-table");
    let (name, value) = match behind.strip_prefix("bem-") {
        Some(level) => ("bem", level.parse().unwrap_or(f64::NAN)),
        None => (behind, 1.0),
    };
    (rows.iter())
        .filter(|r| r.part == Part::Loads && r.model == name && r.gap_or_case == "0.01")
        .find(|r| (r.value - value).abs() < 1e-9)
        .map_or(f64::NAN, |row| row.seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponent_of_a_power_law_is_found() {
        let rows: Vec<_> = [1e2, 1e3, 1e4]
            .map(|n: f64| CostRow {
                seconds: 3e-9 * n.powf(2.5),
                ..CostRow::new(Part::Scaling, "made", ("unknowns", n), "0.1")
            })
            .into();
        approx::assert_relative_eq!(exponent(&rows, "made"), 2.5, max_relative = 1e-12);
        assert!(exponent(&rows, "absent").is_nan());
    }

    #[test]
    fn findings_fit_a_terminal_of_80_columns() {
        let tables = ["exact-table", "bem-3-table"]
            .map(|model| CostRow::new(Part::Deflection, model, ("tolerance", 1e-8), "head-on"));
        let sweeps = ["1 thread", "2 threads"]
            .map(|threads| CostRow::new(Part::Scaling, SWEEP, ("trajectories", 1e4), threads));
        let found = findings(&[tables, sweeps].concat());
        assert!(found.iter().any(|f| f.of.contains("10000")), "{found:?}");
        let longest = |of: fn(&Finding) -> &str| {
            let lengths = found.iter().map(|f| of(f).chars().count());
            lengths.max().unwrap_or(0)
        };
        let texts = longest(|f| &f.finding) + longest(|f| &f.of) + longest(|f| f.unit);
        // Numbers take up to eight characters, and three blanks part the columns, with one at each end.
        assert!(texts + 8 + 5 <= 80, "{texts}");
    }
}
