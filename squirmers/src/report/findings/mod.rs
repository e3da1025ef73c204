//! The findings of the page, in sentences. Every number in them is computed from the rows of a section.

mod maps;

use scene::{Gap, Hydrodynamics, LoadSet, Outcome, SceneError};

use crate::page::rounded;
use compare::cost::{self, Finding};
use compare::{ComparisonRow, Encounter, LoadErrorRow, Method, OffsetRow, comparison, numbers};

pub(super) use maps::{
    of_bound, of_fates, of_gravity, of_states, of_trust, of_trust_against_offset, panels,
};

/// A number with a true minus sign.
fn signed(text: String) -> String {
    text.replace('-', "\u{2212}")
}

pub(super) fn number(value: f64) -> String {
    signed(numbers::written(value))
}

pub(super) fn degrees(value: f64, digits: usize) -> String {
    let value = rounded(value, digits as i32);
    signed(format!("{value:.digits$}°"))
}

pub(super) fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// `a`, `a and b`, `a, b and c`.
pub(super) fn listed(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The row with the largest error; the first one of equal errors; `None` if all are NaN.
fn worst<R>(rows: impl IntoIterator<Item = R>, error: impl Fn(&R) -> f64) -> Option<R> {
    (rows.into_iter())
        .filter(|row| !error(row).is_nan())
        .reduce(|a, b| {
            if error(&b).abs() > error(&a).abs() {
                b
            } else {
                a
            }
        })
}

/// The errors of the deflections by lubrication theory and by boundary elements.
pub(super) fn of_encounters(encounters: &[Encounter]) -> String {
    let all = comparison(encounters);
    let parted = format!("{0} / {0}", Outcome::Scattered);
    let (alike, otherwise): (Vec<_>, Vec<_>) = (all.into_iter())
        .filter(|row| !row.outcomes.contains('–') || !row.bem_error_deg.is_nan())
        .partition(|row| row.outcomes == parted || row.outcomes.contains('–'));
    let mut sentences = Vec::new();
    if let Some(row) = worst(&alike, |row| row.lt_error_deg) {
        let wrong = (alike.iter())
            .filter(|row| row.lt_deg.abs().min(row.exact_deg.abs()) > 0.05)
            .filter(|row| row.lt_deg * row.exact_deg < 0.0);
        sentences.push(format!(
            "Deflections by lubrication theory are wrong by up to {} ({}: {} instead of {}); {} of {} squirmers turn the wrong way.",
            degrees(row.lt_error_deg.abs(), 1),
            place(row),
            degrees(row.lt_deg, 1),
            degrees(row.exact_deg, 1),
            wrong.count(),
            alike.len(),
        ));
    }
    let pairs = |rows: &[ComparisonRow]| rows.iter().filter(|row| row.squirmer == 1).count();
    if let Some(row) = otherwise.first()
        && let Some((judged, exact)) = row.outcomes.split_once(" / ")
    {
        sentences.push(format!(
            "{} of {} pairs have another outcome than by exact hydrodynamics ({}: {} instead of {}).",
            pairs(&otherwise),
            pairs(&otherwise) + pairs(&alike),
            place(row),
            judged,
            exact,
        ));
    }
    if let Some(row) = worst(alike.iter().chain(&otherwise), |row| row.bem_error_deg) {
        sentences.push(format!(
            "Deflections by boundary elements are within {}.",
            degrees(row.bem_error_deg.abs(), 3)
        ));
    }
    sentences.join(" ")
}

fn place(row: &ComparisonRow) -> String {
    format!("β = {}, δx = {}", number(row.beta), number(row.dx))
}

/// The largest changes by an offset out of the plane.
pub(super) fn of_offsets(rows: &[OffsetRow]) -> String {
    let method = if rows.iter().any(|row| row.method == Method::Exact) {
        Method::Exact
    } else {
        rows.first().map_or(Method::Lt, |row| row.method)
    };
    let scattered = Outcome::Scattered.to_string();
    let parts: Vec<&OffsetRow> = (rows.iter())
        .filter(|row| row.method == method && row.outcome == scattered)
        .filter(|row| row.outcome_in_plane == scattered)
        .collect();
    let change = |row: &OffsetRow| row.change1_deg.max(row.change2_deg);
    let most: Vec<String> = (parts.chunk_by(|a, b| a.case == b.case))
        .filter_map(|of_case| {
            let row = worst(of_case, |row| change(row))?;
            Some(format!(
                "{} ({}, β = {}, δx = {}, δz = {})",
                degrees(change(row), 1),
                row.case,
                number(row.beta),
                number(row.dx),
                number(row.dz)
            ))
        })
        .collect();
    if most.is_empty() {
        return String::new();
    }
    format!(
        "By {} an offset out of the plane changes outgoing directions by up to {}.",
        method.in_sentence(),
        listed(&most)
    )
}

/// Gap of the sentence about errors of loads, in radii.
const STATED_GAP: f64 = 0.01;

/// The load with the largest error, for each method, at one gap.
pub(super) fn of_loads(rows: &[LoadErrorRow]) -> String {
    let at_gap: Vec<&LoadErrorRow> = (rows.iter())
        .filter(|row| (row.gap / STATED_GAP).ln().abs() < 1e-9)
        .collect();
    let parts: Vec<String> = (at_gap.chunk_by(|a, b| a.method == b.method))
        .filter_map(|of_method| {
            let row = worst(of_method, |row| row.error)?;
            let error = if row.error < 1e-3 {
                signed(format!("{:.0e}", row.error))
            } else {
                percent(row.error)
            };
            Some(format!(
                "{error} by {} ({})",
                row.method.in_sentence(),
                row.name
            ))
        })
        .collect();
    if parts.is_empty() {
        return String::new();
    }
    format!(
        "At a gap of {} radii the largest error of a load is {}.",
        number(STATED_GAP),
        listed(&parts)
    )
}

/// Gaps for the slopes in the logarithm of the gap, in radii.
const SLOPE_GAPS: [f64; 2] = [1e-6, 1e-7];

/// Slopes in ln(1/gap) of the axial force on a squirmer by its own squirming modes 1 and 2.
fn axial_slopes(model: &dyn Hydrodynamics) -> Result<[f64; 2], SceneError> {
    let set = LoadSet::all(2);
    let named =
        |eps: f64| -> Result<_, SceneError> { Ok(model.loads(Gap::new(eps)?, set)?.named()) };
    let (far, near) = (named(SLOPE_GAPS[0])?, named(SLOPE_GAPS[1])?);
    let slope = |name: &str| {
        let of = |loads: &[(String, f64)]| {
            (loads.iter().find(|(n, _)| n == name)).map_or(f64::NAN, |(_, value)| *value)
        };
        (of(&near) - of(&far)).abs() / (SLOPE_GAPS[0] / SLOPE_GAPS[1]).ln()
    };
    Ok(["XF1_1", "XF1_2"].map(slope))
}

/// The slopes of several models, in words.
pub(super) fn slopes<'a>(
    models: impl Iterator<Item = (Method, &'a dyn Hydrodynamics)>,
) -> Result<String, SceneError> {
    let mut parts = Vec::new();
    for (method, model) in models {
        // A model whose range ends at larger gaps has no slope here.
        if model.range().check(Gap::new(SLOPE_GAPS[1])?).is_ok() {
            let [first, second] = axial_slopes(model)?;
            let name = method.in_sentence();
            parts.push(format!("{first:.3} and {second:.3} by {name}"));
        }
    }
    Ok(format!(
        "As the gap closes, the axial squirming force XF grows as ln(1/ε). Between gaps of {} and {} its slope for the \
         modes 1 and 2 is {}. The condition of no net flux through the gap gives 3. The rest of the error is the constant \
         next to the logarithm, which lubrication theory leaves out.",
        number(SLOPE_GAPS[0]),
        number(SLOPE_GAPS[1]),
        listed(&parts)
    ))
}

/// The cost of a better answer.
pub(super) fn of_cost(found: &[Finding]) -> String {
    let measured = |name: &str| {
        (found.iter().find(|finding| finding.finding == name))
            .map(|finding| finding.value)
            .filter(|value| value.is_finite())
    };
    let collision = measured(cost::COLLISION)
        .map(|time| format!("A collision takes at most {time:.0} µs by lubrication theory."));
    let right_hand_side = measured(cost::RIGHT_HAND_SIDES).map(|ratio| {
        format!(
            "A right-hand side from the exact table takes {ratio:.1} times as long as one by lubrication theory."
        )
    });
    let direct = measured(cost::DIRECT).map(|ratio| {
        format!(
            "Boundary elements solved at every step take {} times as long as the exact table.",
            numbers::size(ratio)
        )
    });
    let sentences = [collision, right_hand_side, direct];
    sentences
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_listed_as_people_do() {
        let parts = ["a", "b", "c"].map(str::to_owned);
        assert_eq!(listed(&parts), "a, b and c");
        assert_eq!(listed(&parts[..1]), "a");
        assert_eq!(listed(&[]), "");
    }

    #[test]
    fn slopes_near_contact_are_those_of_the_lubrication_forms() {
        let forms = [
            (lt::Form::Published, Method::Lt, 2.25),
            (lt::Form::Corrected, Method::LtCorrected, 3.0),
        ];
        for (form, method, slope) in forms {
            let model = lt::Lubrication::new(form);
            let text = slopes(std::iter::once((method, &model as &dyn Hydrodynamics))).unwrap();
            let name = method.in_sentence();
            let claim = format!("is {slope:.3} and {slope:.3} by {name}");
            assert!(text.contains(&claim), "{text}");
        }
    }

    #[test]
    fn a_page_without_runs_finds_nothing() {
        assert_eq!(of_encounters(&[]), "");
        assert_eq!(of_offsets(&[]), "");
        assert_eq!(of_loads(&[]), "");
        assert_eq!(of_fates(&[]), "");
        assert_eq!(of_trust(&[]), "");
        assert_eq!(of_cost(&[]), "");
    }

    #[test]
    fn what_was_not_measured_is_not_said() {
        let found = |finding: &str, value: f64| Finding {
            finding: finding.to_owned(),
            of: String::new(),
            value,
            unit: "",
        };
        let text = of_cost(&[found(cost::COLLISION, 24.4), found(cost::DIRECT, f64::NAN)]);
        assert_eq!(
            text,
            "A collision takes at most 24 µs by lubrication theory."
        );
    }
}
