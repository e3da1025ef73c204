//! The table of a scorecard.

use serde::Serialize;

use super::points::{Point, TRUST, by_item, trusted_down_to};
use super::{Affected, LeaderRow, Scorecard, faults};
use crate::columns::columns;
use crate::numbers::{few_digits, written};

columns! {
    /// A row for each number that a judgement consists of. `docs/JUDGE.md` says what each measure is.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct JudgeRow {
        /// Name of the model.
        #[unit = "-"]
        pub model: String,
        /// What is measured.
        #[unit = "-"]
        pub measure: &'static str,
        /// Of what: a quantity, a gap, a collision, a fault.
        #[unit = "-"]
        pub case: String,
        /// The number. NaN where there is none, as of an outcome that has no deflection.
        #[unit = "varies"]
        pub value: f64,
        /// Unit of the number.
        #[unit = "-"]
        pub unit: &'static str,
    }
}

/// Every measure with its meaning.
pub const MEASURES: [(&str, &str); 33] = [
    (
        "error",
        "error at a gap of its own, divided by the larger of the exact number and its value of a lone sphere (1 for scalars, 4 for the thrusts, 2/3 for velocities by slip); of an approach speed by the exact speed",
    ),
    (
        "relative_error",
        "the same in per cent of the exact number alone",
    ),
    (
        "worst_error",
        "the largest error of a quantity at its own gaps",
    ),
    (
        "raw_error",
        "error without the declared calibration of slip",
    ),
    (
        "raw_relative_error",
        "the same in per cent of the exact number alone",
    ),
    ("raw_worst_error", "the largest of these"),
    (
        "error_between",
        "error between its gaps, by the interpolation that it declares",
    ),
    (
        "relative_error_between",
        "the same in per cent of the exact number alone",
    ),
    ("worst_error_between", "the largest of these"),
    (
        "trusted_down_to",
        "the smallest gap from which on, up to its largest gap, errors are within a bound: of all that it gives, and of each quantity",
    ),
    (
        "missing",
        "at how many of its gaps a quantity is neither given nor follows from others",
    ),
    (
        "law",
        "of a matrix: the largest differences of entries that reciprocity, or two equal spheres, make equal; and smallest eigenvalues of mobilities (1 of lone spheres, never negative)",
    ),
    (
        "contact_term",
        "factor of the strongest singular term of a load near contact, `1/gap` or `ln(1/gap)`, from a fit to gaps up to 0.11",
    ),
    ("exact_contact_term", "what that factor is"),
    ("contact_term_ratio", "the first over the second"),
    (
        "third_law",
        "what is left of singular terms that cancel because lubrication acts on both spheres with opposite forces, relative to one of them",
    ),
    (
        "far_power",
        "power of the distance of the centres between its two largest gaps",
    ),
    ("exact_far_power", "what that power is"),
    (
        "fault",
        "what is wrong with a quantity; the number that comes with it, such as a factor, or NaN",
    ),
    (
        "deflection_deg",
        "deflection in a case of the paper's Figs 6 and 7, read where the centres are 12 apart, with the outcome",
    ),
    (
        "exact_deflection_deg",
        "the same by exact hydrodynamics, read at the same distance",
    ),
    (
        "deflection_error_deg",
        "the larger error of the two squirmers; NaN unless both models part the pair",
    ),
    (
        "outcome_share",
        "share of the incoming angles with an outcome",
    ),
    ("exact_outcome_share", "the same by exact hydrodynamics"),
    (
        "trust_share",
        "share of the incoming angles in each class of difference",
    ),
    (
        "parting_share",
        "share of the incoming angles at which the two models do not end alike, by the two outcomes, with one such start",
    ),
    (
        "bound_state_gap",
        "gap of a bound state that both models have",
    ),
    ("bound_state_missing", "a bound state that it lacks; NaN"),
    (
        "bound_state_extra",
        "gap of a bound state that exact hydrodynamics lacks",
    ),
    (
        "seconds_per_gap",
        "time of one gap: as its header states, or as measured of a process",
    ),
    (
        "exact_seconds_per_gap",
        "time of one gap by exact loads, measured now",
    ),
    ("time_ratio", "the first over the second"),
    (
        "score",
        "the largest error of the ten resistance scalars at gaps from 0.01 to 2; NaN unless all are there",
    ),
];

/// Puts rows together.
struct Table<'a> {
    name: &'a str,
    rows: Vec<JudgeRow>,
}

impl Table<'_> {
    fn add(
        &mut self,
        measure: &'static str,
        case: impl Into<String>,
        value: f64,
        unit: &'static str,
    ) {
        self.rows.push(JudgeRow {
            model: self.name.to_owned(),
            measure,
            case: case.into(),
            value,
            unit,
        });
    }

    fn errors(&mut self, points: &[Point], [error, percent, worst]: [&'static str; 3]) {
        for point in points {
            let case = format!("{} at gap {}", point.item, few_digits(point.gap));
            self.add(error, case.clone(), point.error(), "-");
            self.add(percent, case, point.relative_percent(), "%");
        }
        for (item, points) in by_item(points) {
            self.add(worst, item.to_string(), faults::worst(&points).0, "-");
        }
    }
}

impl Scorecard {
    /// Everything as rows.
    #[must_use]
    pub fn rows(&self) -> Vec<JudgeRow> {
        let mut table = Table {
            name: &self.name,
            rows: Vec::new(),
        };
        table.errors(&self.points, ["error", "relative_error", "worst_error"]);
        table.errors(
            &self.raw,
            ["raw_error", "raw_relative_error", "raw_worst_error"],
        );
        table.errors(
            &self.between,
            [
                "error_between",
                "relative_error_between",
                "worst_error_between",
            ],
        );
        for bound in TRUST {
            let percent = format!("{} %", written(100.0 * bound));
            let all = self.points.iter().chain(&self.between);
            table.add(
                "trusted_down_to",
                percent.clone(),
                self.trusted(bound).unwrap_or(f64::NAN),
                "a",
            );
            for (item, _) in by_item(&self.points) {
                let of_item = all.clone().filter(|point| point.item == item);
                let down_to = trusted_down_to(of_item, bound).unwrap_or(f64::NAN);
                table.add(
                    "trusted_down_to",
                    format!("{item}, {percent}"),
                    down_to,
                    "a",
                );
            }
        }
        for missing in &self.missing {
            table.add(
                "missing",
                format!("{}, number of gaps", missing.quantity),
                missing.at as f64,
                "-",
            );
        }
        for law in &self.matrix_laws {
            let entries = if law.entries.is_empty() {
                String::new()
            } else {
                format!(", entries {}", law.entries)
            };
            table.add(
                "law",
                format!(
                    "{} of the matrix, worst at gap {}{entries}",
                    law.name,
                    few_digits(law.gap)
                ),
                law.value,
                "-",
            );
        }
        for (gap, eigenvalue) in &self.definite {
            table.add(
                "law",
                format!(
                    "smallest eigenvalue of the mobility at gap {}",
                    few_digits(*gap)
                ),
                *eigenvalue,
                "-",
            );
        }
        for contact in &self.contacts {
            let case = format!("{}, {}", contact.item, contact.term);
            table.add("contact_term", case.clone(), contact.value, "-");
            table.add("exact_contact_term", case.clone(), contact.truth, "-");
            table.add("contact_term_ratio", case, contact.ratio(), "-");
        }
        for (case, sum) in &self.third_law {
            table.add("third_law", case.clone(), *sum, "-");
        }
        for decay in &self.decays {
            table.add("far_power", decay.quantity.name(), decay.powers[0], "-");
            table.add(
                "exact_far_power",
                decay.quantity.name(),
                decay.powers[1],
                "-",
            );
        }
        for fault in &self.faults {
            for Affected { item, number, .. } in &fault.of {
                let case = format!("{}: {item}", fault.kind.name());
                table.add("fault", case, *number, "-");
            }
        }
        table.add(
            "score",
            "ten resistance scalars",
            LeaderRow::of(self).score,
            "-",
        );
        self.collision_rows(&mut table);
        if let Some(seconds) = self.seconds_per_gap {
            table.add("seconds_per_gap", "stated or measured", seconds, "s");
            table.add(
                "exact_seconds_per_gap",
                "measured now",
                self.exact_seconds_per_gap,
                "s",
            );
            table.add(
                "time_ratio",
                "seconds per gap over those of exact loads",
                seconds / self.exact_seconds_per_gap,
                "-",
            );
        }
        table.rows
    }

    fn collision_rows(&self, table: &mut Table<'_>) {
        let Ok(collisions) = &self.collisions else {
            return;
        };
        for score in &collisions.cases {
            for k in [0, 1] {
                let case = format!("squirmer {}, {}", k + 1, score.name());
                table.add(
                    "deflection_deg",
                    format!("{case}: {}", score.theirs.1),
                    score.theirs.0[k],
                    "deg",
                );
                table.add(
                    "exact_deflection_deg",
                    format!("{case}: {}", score.exact.1),
                    score.exact.0[k],
                    "deg",
                );
            }
            table.add(
                "deflection_error_deg",
                score.name(),
                score.error_deg().unwrap_or(f64::NAN),
                "deg",
            );
        }
        for (beta, outcome, [theirs, exact]) in &collisions.outcomes {
            let case = format!("beta {}, {outcome}", written(*beta));
            table.add("outcome_share", case.clone(), *theirs, "-");
            table.add("exact_outcome_share", case, *exact, "-");
        }
        for shares in &collisions.trust {
            let classes = crate::study::maps::TRUST_CLASSES;
            for (class, share) in classes.into_iter().zip(shares.in_order()) {
                table.add(
                    "trust_share",
                    format!("beta {}, {class}", written(shares.beta)),
                    share,
                    "-",
                );
            }
        }
        for parting in &collisions.partings {
            let [theirs, exact] = &parting.outcomes;
            let [delta, sigma] = parting.start.map(written);
            let case = format!(
                "beta {}, {theirs} where exact hydrodynamics has {exact}, for example at Delta {delta}, Sigma {sigma}",
                written(parting.beta)
            );
            table.add("parting_share", case, parting.share, "-");
        }
        for state in collisions.bound_states() {
            let gap = state.theirs.as_ref().map_or(f64::NAN, |state| state.gap);
            let measure = match (&state.theirs, &state.exact) {
                (Some(_), Some(_)) => "bound_state_gap",
                (None, _) => "bound_state_missing",
                (_, None) => "bound_state_extra",
            };
            table.add(measure, state.name(), gap, "a");
        }
    }

    /// Down to which gap all its errors, also those between its gaps, are within a bound. None if not even the largest gap is.
    #[must_use]
    pub fn trusted(&self, bound: f64) -> Option<f64> {
        trusted_down_to(self.points.iter().chain(&self.between), bound)
    }

    /// What spoils trust at a bound: the point at the largest gap at which an error is beyond it.
    #[must_use]
    pub fn spoiled_by(&self, bound: f64) -> Option<Point> {
        let all = self.points.iter().chain(&self.between);
        let broken = all.filter(|point| point.is_beyond(bound));
        let first = broken.max_by(|a, b| {
            let errors = a.error().abs().total_cmp(&b.error().abs());
            a.gap.total_cmp(&b.gap).then(errors)
        });
        first.copied()
    }
}

#[cfg(test)]
mod tests;
