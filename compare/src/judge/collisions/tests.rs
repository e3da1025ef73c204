//! Shares and pairs of made-up outcomes.

use super::*;
use crate::Method;

fn row(delta: f64, outcome: &str) -> ScatterRow {
    ScatterRow {
        method: Method::Lt,
        beta: 5.0,
        g: 0.0,
        delta,
        sigma: 0.2,
        deflection1_deg: 10.0,
        deflection2_deg: 20.0,
        tau: 1.0,
        outcome: outcome.to_owned(),
        min_gap: 0.1,
    }
}

fn nothing() -> Collisions {
    Collisions {
        cases: Vec::new(),
        outcomes: Vec::new(),
        trust: Vec::new(),
        partings: Vec::new(),
        bound: [Vec::new(), Vec::new()],
        maps: Vec::new(),
    }
}

#[test]
fn shares_of_outcomes_and_of_starts_that_end_otherwise_are_counted() {
    let of = |outcomes: [&str; 5]| -> Vec<ScatterRow> {
        let deltas = (0..5).map(f64::from);
        deltas
            .zip(outcomes)
            .map(|(delta, outcome)| row(delta, outcome))
            .collect()
    };
    let theirs = of(["scattered", "pairwise", "pairwise", "standoff", "scattered"]);
    let exact = of([
        "scattered",
        "scattered",
        "scattered",
        "scattered",
        "pairwise",
    ]);
    let mut found = nothing();
    found.add_map(
        Pair {
            beta: 5.0,
            g: 0.0,
            dz: 0.0,
        },
        &theirs,
        &exact,
    );
    let outcomes: Vec<(&str, [f64; 2])> = (found.outcomes.iter())
        .map(|(_, outcome, shares)| (outcome.as_str(), *shares))
        .collect();
    assert_eq!(
        outcomes,
        [
            ("pairwise", [0.4, 0.2]),
            ("scattered", [0.4, 0.8]),
            ("standoff", [0.2, 0.0])
        ]
    );
    let partings: Vec<([&str; 2], f64, [f64; 2])> = (found.partings.iter())
        .map(|parting| {
            let [one, two] = &parting.outcomes;
            ([one.as_str(), two.as_str()], parting.share, parting.start)
        })
        .collect();
    // The most frequent first, each with its first start.
    assert_eq!(partings[0], (["pairwise", "scattered"], 0.4, [1.0, 0.2]));
    assert_eq!(partings.len(), 3);
    assert!(partings[1..].contains(&(["standoff", "scattered"], 0.2, [3.0, 0.2])));
    assert!(partings[1..].contains(&(["scattered", "pairwise"], 0.2, [4.0, 0.2])));
    assert_eq!(found.maps.len(), 5);
}

fn state(beta: f64, outcome: &str, gap: f64, growth: f64) -> BoundRow {
    BoundRow {
        method: Method::Lt,
        beta,
        outcome: outcome.to_owned(),
        gap,
        angle1_deg: 0.0,
        angle2_deg: 0.0,
        turning: 0.0,
        speed: 0.0,
        growth,
        frequency: 0.0,
        growth_off_plane: 0.0,
        stable_in_plane: "yes",
        stable_in_space: "yes",
        one_of_a_line: false,
    }
}

#[test]
fn a_bound_state_is_the_nearest_one_of_its_kind_and_stability() {
    let exact = [
        state(5.0, "pairwise", 0.1, -1.0),
        state(5.0, "pairwise", 0.4, -1.0),
        state(5.0, "standoff", 0.1, 1.0),
        state(1.0, "standoff", 0.1, 1.0),
    ];
    let theirs = [
        // Nearer to 0.4 than to 0.1, by the ratio.
        state(5.0, "pairwise", 0.25, -1.0),
        state(5.0, "pairwise", 0.11, -1.0),
        // As near, and stable.
        state(5.0, "standoff", 0.1, -1.0),
    ];
    let found = Collisions {
        bound: [theirs.into(), exact.into()],
        ..nothing()
    };
    let pairs: Vec<(Option<f64>, Option<f64>)> = (found.bound_states().iter())
        .map(|pair| {
            (
                pair.theirs.as_ref().map(|of| of.gap),
                pair.exact.as_ref().map(|of| of.gap),
            )
        })
        .collect();
    assert_eq!(
        pairs,
        [
            (Some(0.11), Some(0.1)),
            (Some(0.25), Some(0.4)),
            (None, Some(0.1)),
            (None, Some(0.1)),
            (Some(0.1), None),
        ]
    );
    let names: Vec<String> = found
        .bound_states()
        .iter()
        .map(BoundComparison::name)
        .collect();
    assert_eq!(names[0], "beta 5, pairwise, stable, gap 1.0e-1");
    assert_eq!(names[2], "beta 5, standoff, unstable, gap 1.0e-1");
    assert_eq!(names[4], "beta 5, standoff, stable, gap 1.0e-1");
    let marginal = BoundComparison {
        theirs: Some(state(5.0, "standoff", 0.1, 0.0)),
        exact: None,
    };
    assert!(marginal.name().contains(" stable"), "{}", marginal.name());
}
