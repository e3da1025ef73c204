//! The findings from maps over the incoming angles and from pairs under gravity, in sentences.

use super::{listed, number, percent, worst};
use compare::Method;
use compare::study::maps::{BoundRow, FateRow, TrustShares};
use compare::study::panels::PanelRow;

/// Smallest difference of two shares of the plane that the first screen mentions.
const NOTEWORTHY: f64 = 0.05;

/// Which pairs stay bound in each model, for those beta at which the models differ much.
pub(in crate::report) fn of_bound(shares: &[FateRow]) -> String {
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
    format!("{of} by {}", row.method.in_sentence())
}

/// The beta at which the shares of bound pairs by two models differ most.
pub(in crate::report) fn of_fates(rows: &[FateRow]) -> String {
    let (exact, judged): (Vec<&FateRow>, Vec<&FateRow>) =
        (rows.iter()).partition(|row| row.method == Method::Exact);
    let pairs = judged.into_iter().filter_map(|row| {
        let of = exact.iter().find(|e| (e.beta - row.beta) == 0.0)?;
        Some((row, *of))
    });
    let Some((judged, exact)) = worst(pairs, |(a, b)| a.bound() - b.bound()) else {
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
        judged.method.in_sentence(),
        percent(exact.bound()),
    )
}

/// The share of the plane in which a model can be trusted.
pub(in crate::report) fn of_trust(shares: &[TrustShares]) -> String {
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
            let name = of_method[0].method.in_sentence();
            format!(
                "Both outgoing directions by {name} are within 15° of the exact ones over {} of the incoming angles.",
                listed(&parts)
            )
        })
        .collect();
    sentences.join(" ")
}

/// The effect of an offset out of the plane, for the beta whose outcomes in the plane agree least.
pub(in crate::report) fn of_trust_against_offset(shares: &[TrustShares]) -> String {
    let in_plane = shares.iter().filter(|row| row.dz == 0.0);
    let Some(row) = worst(in_plane, |row| row.other_outcome) else {
        return String::new();
    };
    let same = |other: &&TrustShares| {
        other.method == row.method && (other.beta - row.beta) == 0.0 && other.dz != 0.0
    };
    let off = shares.iter().filter(same);
    let Some(most) = worst(off, |row| row.other_outcome) else {
        return String::new();
    };
    format!(
        "For β = {} {} has another outcome over {} of the plane; with an offset out of the plane over at most {} (δz = {}).",
        number(row.beta),
        row.method.in_sentence(),
        percent(row.other_outcome),
        percent(most.other_outcome),
        number(most.dz)
    )
}

/// The states that attract, for each model.
pub(in crate::report) fn of_states(states: &[BoundRow]) -> String {
    let stable: Vec<String> = (states.iter())
        .filter(|state| state.growth < 0.0 && !state.one_of_a_line)
        .map(|state| {
            format!(
                "{} has {} at β = {} (gap {:.3}, disturbances decay at the rate {:.3})",
                state.method.in_sentence(),
                state.outcome,
                number(state.beta),
                state.gap,
                -state.growth
            )
        })
        .collect();
    let mut text = if stable.is_empty() {
        "No bound state is an attractor.".to_owned()
    } else {
        format!(
            "Bound states in which every small disturbance in the plane decays: {}. All others in the table are \
             saddles, or neutral.",
            stable.join("; ")
        )
    };
    if let Some(line) = states.iter().find(|state| state.one_of_a_line) {
        text += &format!(
            " Besides, {} has a line of neutral states: any two parallel squirmers side by side at a gap of {}. This gap is \
             the cut of the theory, where the loads become those of lone squirmers. Pullers swim together in these states.",
            line.method.in_sentence(),
            number((line.gap * 1e6).round() / 1e6)
        );
    }
    text
}

/// The outcome of each panel of Fig. 8 by each method.
pub(in crate::report) fn panels(rows: &[PanelRow]) -> String {
    let mut names: Vec<&str> = rows.iter().map(|row| row.panel.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let parts = names.into_iter().map(|panel| {
        let by = rows.iter().filter(|row| row.panel == panel).map(|row| {
            let mut text = format!("{} by {}", row.outcome, row.method.in_sentence());
            if row.min_gap.is_finite() {
                text += &format!(" (smallest gap {:.3}", row.min_gap);
                if row.depth_ratio.is_finite() {
                    text += &format!(
                        ", depth {:.2} times that of lone squirmers",
                        row.depth_ratio
                    );
                }
                text += ")";
            }
            text
        });
        format!("({panel}) {}", by.collect::<Vec<_>>().join(", "))
    });
    format!(
        "Outcomes of the panels: {}.",
        parts.collect::<Vec<_>>().join("; ")
    )
}

/// The number of panels of Fig. 8 with different outcomes, and the largest bottom-heaviness at which pairs orbit.
pub(in crate::report) fn of_gravity(rows: &[PanelRow], orbits: &[FateRow]) -> String {
    let [lt, exact] = [Method::Lt, Method::Exact]
        .map(|method| (rows.iter().filter(|row| row.method == method)).collect::<Vec<_>>());
    let mut text = String::new();
    if !lt.is_empty() && lt.len() == exact.len() {
        let otherwise = (lt.iter().zip(&exact)).filter(|(a, b)| a.outcome != b.outcome);
        text += &format!(
            "Under gravity {} of the {} panels of Fig. 8 have another outcome by exact hydrodynamics than by lubrication \
             theory. ",
            otherwise.count(),
            lt.len()
        );
    }
    text + &orbits_in_words(orbits)
}

/// The largest bottom-heaviness at which pairs orbit, with the share of starts that end in an orbit there.
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
                "β = {beta} by {} up to G = {g} (share at this G: {share})",
                method.in_sentence()
            ))
        })
        .collect();
    if parts.is_empty() {
        String::new()
    } else {
        format!("Starts end in orbits for {}.", listed(&parts))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(beta: f64, dz: f64, other_outcome: f64) -> TrustShares {
        TrustShares {
            method: Method::Lt,
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
}
