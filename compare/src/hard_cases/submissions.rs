//! Submissions with numbers that nobody means: each is refused in one line, or moves a pair in finite numbers.

use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet, RunOptions, run};

use super::{Bench, Rows, until};
use crate::submission::{Submission, SubmittedModel, Values};
use crate::{Approach, Case, CompareError};

/// In the column `method`: whoever submits.
const SUBMITTED: &str = "submitted";

/// What stands in place of a value.
const VALUES: [&str; 14] = [
    "NaN", "inf", "-inf", "1e400", "1.7e308", "-1.7e308", "1e160", "5e-324", "-0", "0", "-7", "",
    "1e", "1,2",
];

/// What stands in place of a gap: also that of the row before, and the next number above it.
const GAPS: [&str; 10] = [
    "0",
    "-1",
    "5e-324",
    "1e-310",
    "1e300",
    "1.8e308",
    "NaN",
    "",
    "1e-5",
    "1.0000000000000002e-5",
];

/// Every so many-th row has a number replaced: of other quantities each time, and at gaps near and far.
const EVERY: usize = 97;

pub(super) fn cases(_: &Bench, rows: &mut Rows) {
    rows.attempt(SUBMITTED, "hostile numbers", hostile);
}

/// Gap, name and value of exact loads: six gaps a decade, from near contact to beyond where a run ends.
fn honest() -> Result<Vec<[String; 3]>, CompareError> {
    let model = Exact::new();
    let mut rows = Vec::new();
    for k in 0..40 {
        let gap = 1e-5 * 10f64.powf(f64::from(k) / 6.0);
        for (quantity, value) in
            Values::of_model(&model, Gap::new(gap)?, LoadSet::planar(2))?.iter()
        {
            rows.push([
                format!("{gap:?}"),
                quantity.name().to_owned(),
                format!("{value:?}"),
            ]);
        }
    }
    Ok(rows)
}

/// What comes of a submission.
#[derive(PartialEq)]
enum End {
    /// It moves a pair, in finite numbers.
    Moves,
    /// It, or its motion, is refused in one line.
    Refused,
    /// Numbers that are not finite, or a message of several lines.
    Wrong,
}

fn refused(error: &dyn std::fmt::Display) -> End {
    let message = error.to_string();
    if message.is_empty() || message.chars().any(char::is_control) {
        End::Wrong
    } else {
        End::Refused
    }
}

fn end(rows: &[[String; 3]]) -> Result<End, CompareError> {
    let lines = rows.iter().map(|row| row.join(",") + "\n");
    let text = "gap,name,value\n".to_owned() + &lines.collect::<String>();
    let submission = match Submission::parse(&text) {
        Ok(submission) => submission,
        Err(error) => return Ok(refused(&error)),
    };
    let model = match SubmittedModel::new(&submission) {
        Ok(model) => model,
        Err(error) => return Ok(refused(&error)),
    };
    let range = model.range();
    for share in 0..200 {
        let along = (range.largest / range.smallest).ln() * f64::from(share) / 199.0;
        let eps = (range.smallest * along.exp()).clamp(range.smallest, range.largest);
        match model.loads(Gap::new(eps)?, LoadSet::planar(2)) {
            Ok(loads) if !loads.columns().all(f64::is_finite) => return Ok(End::Wrong),
            Ok(_) => {}
            Err(error) => return Ok(refused(&error)),
        }
    }
    let case = Case {
        approach: Approach::Orthogonal,
        beta: 1.0,
        dx: 1.0,
        dz: 0.0,
    };
    let options = RunOptions {
        max_steps: 2000,
        angles_at: 12.0,
        ..until(50.0, 1e-6)
    };
    Ok(match run(&case.scene()?, &model, &options) {
        Ok(run) => {
            let numbers = run
                .deflections_rad()
                .into_iter()
                .chain([run.end_time, run.min_gap]);
            if numbers.into_iter().all(f64::is_finite) {
                End::Moves
            } else {
                End::Wrong
            }
        }
        Err(error) => refused(&error),
    })
}

fn hostile(rows: &mut Rows) -> Result<(), CompareError> {
    let honest = honest()?;
    let (mut wrong, mut tried) = (Vec::new(), 0);
    if end(&honest)? != End::Moves {
        wrong.push("as it should be".to_owned());
    }
    for place in (0..honest.len()).step_by(EVERY) {
        let replaced =
            (VALUES.iter().map(|text| (2, *text))).chain(GAPS.iter().map(|text| (0, *text)));
        for (column, text) in replaced {
            let mut all = honest.clone();
            all[place][column] = text.to_owned();
            tried += 1;
            if end(&all)? == End::Wrong {
                wrong.push(format!(
                    "{} of {} at {}",
                    text, honest[place][1], honest[place][0]
                ));
            }
        }
    }
    let mut measure = format!(
        "exact loads as a submission, and {tried} with one number replaced: those that are neither refused in one line nor move a pair in finite numbers"
    );
    if !wrong.is_empty() {
        measure = format!("{measure}: {}", wrong.join(", "));
    }
    rows.add(
        SUBMITTED,
        measure,
        (0.0, "a typed error or finite numbers"),
        wrong.len() as f64,
    );
    Ok(())
}
