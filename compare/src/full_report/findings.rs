//! What the page found, in sentences: every number in them is computed from the rows of their section.

use scene::{Gap, Hydrodynamics, LoadSet, Outcome, SceneError};

use crate::bottom_heavy::PanelRow;
use crate::cost::{self, Finding};
use crate::maps::{BoundRow, FateRow, TrustShares};
use crate::{ComparisonRow, Encounter, LoadErrorRow, Method, OffsetRow, comparison, numbers};

/// A number with a true minus sign.
fn signed(text: String) -> String {
    text.replace('-', "\u{2212}")
}

fn number(value: f64) -> String {
    signed(numbers::written(value))
}

pub(super) fn degrees(value: f64, digits: usize) -> String {
    // Without a negative zero.
    let unit = 10_f64.powi(digits as i32);
    let value = (value * unit).round() / unit + 0.0;
    signed(format!("{value:.digits$}°"))
}

pub(super) fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// Names what a method is, within a sentence.
fn called(method: &str) -> &str {
    match Method::ALL.into_iter().find(|m| m.name() == method) {
        Some(Method::Lt) => "lubrication theory",
        Some(Method::LtCorrected) => "corrected lubrication theory",
        Some(Method::Exact) => "exact hydrodynamics",
        Some(Method::Bem) => "boundary elements",
        Some(Method::Isolated) => "no interaction",
        None => method,
    }
}

/// `a`, `a and b`, `a, b and c`.
fn listed(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

fn larger(a: f64, b: f64) -> bool {
    a.abs() > b.abs()
}

/// The row with the largest of some errors; none if all are NaN.
fn worst<R>(rows: &[R], error: impl Fn(&R) -> f64) -> Option<&R> {
    (rows.iter())
        .filter(|row| !error(row).is_nan())
        .reduce(|a, b| if larger(error(b), error(a)) { b } else { a })
}

/// How far lubrication theory and boundary elements are from the exact deflections.
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
            "Lubrication theory is up to {} off ({}: {} instead of {}) and turns {} of {} squirmers the wrong way.",
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
            "{} of {} pairs end otherwise than by exact hydrodynamics ({}: {} instead of {}).",
            pairs(&otherwise),
            pairs(&otherwise) + pairs(&alike),
            place(row),
            judged,
            exact,
        ));
    }
    let by_elements: Vec<ComparisonRow> = alike.into_iter().chain(otherwise).collect();
    if let Some(row) = worst(&by_elements, |row| row.bem_error_deg) {
        sentences.push(format!(
            "Boundary elements are within {}.",
            degrees(row.bem_error_deg.abs(), 3)
        ));
    }
    sentences.join(" ")
}

fn place(row: &ComparisonRow) -> String {
    format!("β = {}, δx = {}", number(row.beta), number(row.dx))
}

/// How much an offset out of the plane changes.
pub(super) fn of_offsets(rows: &[OffsetRow]) -> String {
    let method = if rows.iter().any(|row| row.method == Method::Exact.name()) {
        Method::Exact.name()
    } else {
        rows.first().map_or("", |row| row.method)
    };
    let scattered = Outcome::Scattered.to_string();
    let parts: Vec<OffsetRow> = (rows.iter())
        .filter(|row| row.method == method && row.outcome == scattered)
        .filter(|row| row.outcome_in_plane == scattered)
        .cloned()
        .collect();
    let change = |row: &OffsetRow| row.change1_deg.max(row.change2_deg);
    let most: Vec<String> = (parts.chunk_by(|a, b| a.case == b.case))
        .filter_map(|of_case| {
            let row = worst(of_case, change)?;
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
        called(method),
        listed(&most)
    )
}

/// Gap at which the errors of loads are summed up, in radii.
const STATED_GAP: f64 = 0.01;

/// The worst load of each method at one gap.
pub(super) fn of_loads(rows: &[LoadErrorRow]) -> String {
    let at_gap: Vec<LoadErrorRow> = (rows.iter())
        .filter(|row| (row.gap / STATED_GAP).ln().abs() < 1e-9)
        .cloned()
        .collect();
    let parts: Vec<String> = (at_gap.chunk_by(|a, b| a.method == b.method))
        .filter_map(|of_method| {
            let row = worst(of_method, |row| row.error)?;
            let error = if row.error < 1e-3 {
                signed(format!("{:.0e}", row.error))
            } else {
                percent(row.error)
            };
            Some(format!("{error} by {} ({})", called(row.method), row.name))
        })
        .collect();
    if parts.is_empty() {
        return String::new();
    }
    format!(
        "At a gap of {} radii the worst load is off by {}.",
        number(STATED_GAP),
        listed(&parts)
    )
}

/// Gaps between which slopes in the logarithm of the gap are taken, in radii.
const SLOPE_GAPS: [f64; 2] = [1e-6, 1e-7];

/// The slopes in ln(1/gap) of the axial squirming force of a squirmer's own first two modes.
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
        // A model that does not answer so near to contact has no slope there.
        if model.range().check(Gap::new(SLOPE_GAPS[1])?).is_ok() {
            let [first, second] = axial_slopes(model)?;
            let name = called(method.name());
            parts.push(format!("{first:.3} and {second:.3} by {name}"));
        }
    }
    Ok(format!(
        "As the gap closes, the axial squirming force XF grows as ln(1/ε). Between gaps of {} and {} its slope for the \
         modes 1 and 2 is {}. No net flux through the gap gives 3. The constant next to the logarithm, which \
         lubrication theory leaves out, is the rest of the error.",
        number(SLOPE_GAPS[0]),
        number(SLOPE_GAPS[1]),
        listed(&parts)
    ))
}

/// Difference of two shares of the plane that is worth a sentence on the first screen.
const NOTEWORTHY: f64 = 0.05;

/// Which pairs stay bound, model by model, where models differ much.
pub(super) fn of_bound(shares: &[FateRow]) -> String {
    let mut parts = Vec::new();
    let mut betas: Vec<f64> = shares.iter().map(|row| row.beta).collect();
    betas.sort_by(f64::total_cmp);
    betas.dedup();
    for beta in betas.into_iter().rev() {
        let of_beta: Vec<&FateRow> = (shares.iter())
            .filter(|row| (row.beta - beta) == 0.0)
            .collect();
        let ends = of_beta.iter().map(|row| row.pairwise - row.orbits());
        let (least, most) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
            (x.min(a), x.max(b))
        });
        if most - least > NOTEWORTHY {
            let by: Vec<String> = of_beta.iter().map(|row| bound_by(row)).collect();
            parts.push(format!("β = {}: {}", number(beta), listed(&by)));
        }
    }
    if parts.is_empty() {
        return "All models bind the same pairs.".to_owned();
    }
    format!(
        "Pairs that stay bound, where models differ most: {}.",
        parts.join("; ")
    )
}

fn bound_by(row: &FateRow) -> String {
    let kinds = [
        ("side by side", row.pairwise),
        ("orbiting", row.orbits()),
        ("at rest", row.standoff),
    ];
    let kinds: Vec<String> = (kinds.into_iter())
        .filter(|(_, share)| *share > 0.01)
        .map(|(kind, share)| format!("{} {kind}", percent(share)))
        .collect();
    let of = if kinds.is_empty() {
        "none".to_owned()
    } else {
        kinds.join(", ")
    };
    format!("{of} by {}", called(&row.method))
}

/// Where the bound share of two models differs most.
pub(super) fn of_fates(rows: &[FateRow]) -> String {
    let exact: Vec<&FateRow> = (rows.iter())
        .filter(|row| row.method == Method::Exact.name())
        .collect();
    let pairs: Vec<(&FateRow, &FateRow)> = (rows.iter())
        .filter(|row| row.method != Method::Exact.name())
        .filter_map(|row| {
            let of = exact.iter().find(|e| (e.beta - row.beta) == 0.0)?;
            Some((row, *of))
        })
        .collect();
    let Some((judged, exact)) = worst(&pairs, |(a, b)| a.bound() - b.bound()) else {
        return String::new();
    };
    format!(
        "Over β from {} to {} the share of bound pairs differs most at β = {}: {} by {}, {} by exact hydrodynamics.",
        number(
            rows.iter()
                .map(|row| row.beta)
                .fold(f64::INFINITY, f64::min)
        ),
        number(
            rows.iter()
                .map(|row| row.beta)
                .fold(f64::NEG_INFINITY, f64::max)
        ),
        number(judged.beta),
        percent(judged.bound()),
        called(&judged.method),
        percent(exact.bound()),
    )
}

/// Over which share of the plane a model can be trusted.
pub(super) fn of_trust(shares: &[TrustShares]) -> String {
    let methods = shares.chunk_by(|a, b| a.method == b.method);
    let sentences: Vec<String> = methods
        .map(|of_method| {
            let parts: Vec<String> = (of_method.iter())
                .map(|row| {
                    format!(
                        "{} for β = {}",
                        percent(row.within_5_deg + row.within_15_deg),
                        number(row.beta)
                    )
                })
                .collect();
            let name = called(&of_method[0].method);
            format!(
                "Both outgoing directions by {name} are within 15° of the exact ones over {} of the incoming angles.",
                listed(&parts)
            )
        })
        .collect();
    sentences.join(" ")
}

/// What an offset out of the plane does to the outcomes of the pair that is judged worst in the plane.
pub(super) fn of_trust_against_offset(shares: &[TrustShares]) -> String {
    let in_plane: Vec<TrustShares> = shares.iter().filter(|row| row.dz == 0.0).cloned().collect();
    let Some(row) = worst(&in_plane, |row| row.other_outcome) else {
        return String::new();
    };
    let same = |other: &&TrustShares| {
        other.method == row.method && (other.beta - row.beta) == 0.0 && other.dz != 0.0
    };
    let off: Vec<TrustShares> = shares.iter().filter(same).cloned().collect();
    let Some(most) = worst(&off, |row| row.other_outcome) else {
        return String::new();
    };
    format!(
        "For β = {} {} has another outcome over {} of the plane; with an offset out of it over at most {} (δz = {}).",
        number(row.beta),
        called(&row.method),
        percent(row.other_outcome),
        percent(most.other_outcome),
        number(most.dz)
    )
}

/// Which states attract, model by model.
pub(super) fn of_states(states: &[BoundRow]) -> String {
    let stable: Vec<String> = (states.iter())
        .filter(|state| state.growth < 0.0 && !state.one_of_a_line)
        .map(|state| {
            format!(
                "{} has {} at β = {} (gap {:.3}, disturbances decay at the rate {:.3})",
                called(&state.method),
                state.outcome,
                number(state.beta),
                state.gap,
                -state.growth
            )
        })
        .collect();
    let mut text = if stable.is_empty() {
        "No bound state attracts.".to_owned()
    } else {
        format!(
            "Bound states that attract every small disturbance in the plane: {}. All others in the table are \
             saddles, or neutral.",
            stable.join("; ")
        )
    };
    if let Some(line) = states.iter().find(|state| state.one_of_a_line) {
        text += &format!(
            " Besides, {} has a line of neutral states, any two squirmers side by side in parallel at a gap of {}: \
             its cut, where its loads have faded to those of lone squirmers. That is where its pullers swim together.",
            called(&line.method),
            number((line.gap * 1e6).round() / 1e6)
        );
    }
    text
}

/// What exact hydrodynamics makes of the panels of Fig. 8, panel by panel.
pub(super) fn panels(rows: &[PanelRow]) -> String {
    let mut names: Vec<&str> = rows.iter().map(|row| row.panel.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let parts = names.into_iter().map(|panel| {
        let by = rows.iter().filter(|row| row.panel == panel).map(|row| {
            let mut text = format!("{} by {}", row.outcome, called(row.method));
            if row.min_gap.is_finite() {
                text += &format!(" (smallest gap {:.3}", row.min_gap);
                if row.depth_ratio.is_finite() {
                    text += &format!(", {:.2} times as far down as alone", row.depth_ratio);
                }
                text += ")";
            }
            text
        });
        format!("({panel}) {}", by.collect::<Vec<_>>().join(", "))
    });
    format!(
        "What becomes of the panels: {}.",
        parts.collect::<Vec<_>>().join("; ")
    )
}

/// How many panels of Fig. 8 end otherwise, and up to which bottom-heaviness pairs orbit.
pub(super) fn of_gravity(rows: &[PanelRow], orbits: &[FateRow]) -> String {
    let [lt, exact] = [Method::Lt, Method::Exact]
        .map(|method| (rows.iter().filter(|row| row.method == method.name())).collect::<Vec<_>>());
    let mut text = String::new();
    if !lt.is_empty() && lt.len() == exact.len() {
        let otherwise = (lt.iter().zip(&exact)).filter(|(a, b)| a.outcome != b.outcome);
        text += &format!(
            "Under gravity {} of the {} panels of Fig. 8 end otherwise by exact hydrodynamics than by lubrication \
             theory. ",
            otherwise.count(),
            lt.len()
        );
    }
    text + &orbits_in_words(orbits)
}

/// Up to which bottom-heaviness pairs orbit, with the share of starts that do.
fn orbits_in_words(rows: &[FateRow]) -> String {
    let maps = rows.chunk_by(|a, b| a.method == b.method && (a.beta - b.beta) == 0.0);
    let parts: Vec<String> = maps
        .filter_map(|map| {
            let row = map.iter().rev().find(|row| row.orbits() > 0.0)?;
            let FateRow {
                beta, method, g, ..
            } = row;
            let (beta, g, share) = (number(*beta), number(*g), percent(row.orbits()));
            Some(format!(
                "β = {beta} by {} up to G = {g} ({share} there)",
                called(method)
            ))
        })
        .collect();
    if parts.is_empty() {
        String::new()
    } else {
        format!("Starts end in orbits for {}.", listed(&parts))
    }
}

/// What a better answer costs.
pub(super) fn of_cost(found: &[Finding]) -> String {
    let value = |name: &str| {
        (found.iter().find(|finding| finding.finding == name)).map_or(f64::NAN, |f| f.value)
    };
    let sentences = [
        (
            value(cost::COLLISION),
            format!(
                "A collision takes at most {:.0} µs by lubrication theory.",
                value(cost::COLLISION)
            ),
        ),
        (
            value(cost::RIGHT_HAND_SIDES),
            format!(
                "A right-hand side from the exact table takes {:.1} times as long as one by lubrication theory.",
                value(cost::RIGHT_HAND_SIDES)
            ),
        ),
        (
            value(cost::DIRECT),
            format!(
                "Boundary elements solved at every step take {} times as long as the exact table.",
                numbers::size(value(cost::DIRECT))
            ),
        ),
    ];
    let measured = sentences.into_iter().filter(|(value, _)| value.is_finite());
    let measured: Vec<String> = measured.map(|(_, sentence)| sentence).collect();
    measured.join(" ")
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
            let name = called(method.name());
            let claim = format!("is {slope:.3} and {slope:.3} by {name}");
            assert!(text.contains(&claim), "{text}");
        }
    }

    fn shares(beta: f64, dz: f64, other_outcome: f64) -> TrustShares {
        TrustShares {
            method: "lt".to_owned(),
            beta,
            g: 0.0,
            dz,
            within_5_deg: 0.25,
            within_15_deg: 0.5,
            within_45_deg: 0.0,
            beyond_45_deg: 0.25 - other_outcome,
            same_outcome: 0.0,
            other_outcome,
            failed: 0.0,
        }
    }

    #[test]
    fn sentences_say_what_the_rows_hold() {
        let rows = [
            shares(1.0, 0.0, 0.01),
            shares(-5.0, 0.0, 0.2),
            shares(-5.0, 0.1, 0.05),
        ];
        let text = of_trust(&rows[..2]);
        assert!(
            text.contains("75.0 % for β = 1 and 75.0 % for β = −5"),
            "{text}"
        );
        let text = of_trust_against_offset(&rows);
        assert!(
            text.contains("For β = −5 lubrication theory has another outcome over 20.0 %"),
            "{text}"
        );
        assert!(text.contains("at most 5.0 % (δz = 0.1)"), "{text}");
        assert_eq!(of_trust_against_offset(&[]), "");
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
