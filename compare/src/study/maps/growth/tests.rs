#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use scene::{Plan, run_plan};

use super::*;
use crate::{Family, ModelOptions};

fn model(method: Method) -> Model {
    let pair = Pair {
        beta: 5.0,
        g: 0.0,
        dz: 0.0,
    };
    let options = ModelOptions::default().for_scenes(super::super::unsymmetric_starts(&[pair]));
    Model::set_up(method, &options.unwrap()).unwrap()
}

const TIGHT: RunOptions = RunOptions {
    tolerance: 1e-11,
    end_time: 200.0,
    departure_distance: 12.0,
    angles_at: f64::INFINITY,
    sample_interval: None,
    max_steps: 1_000_000,
};

fn pair(beta: f64, dz: f64) -> Pair {
    Pair { beta, g: 0.0, dz }
}

/// Points of the plane from which pairs part, one of them mirror-symmetric, one point-symmetric.
const POINTS: [(f64, f64, f64); 5] = [
    (1.0, 0.41, 0.63),
    (5.0, 1.0, 0.51),
    (-5.0, 0.55, 1.2),
    (-1.0, 0.6, 1.0),
    (1.0, 1.0, 0.7),
];

#[test]
fn growth_is_the_difference_of_two_runs_close_to_the_plane() {
    for model in [Method::Lt, Method::Exact].map(model) {
        for (beta, delta, sigma) in POINTS {
            let row = growth_row(&model, pair(beta, 0.0), (delta, sigma), &TIGHT);
            assert_eq!(
                (&*row.outcome, &*row.status),
                ("scattered", KNOWN),
                "{row:?}"
            );
            let h = 1e-4;
            let headings = [h, -h].map(|dz| {
                let scene = pair(beta, dz).scene(delta, sigma).unwrap();
                let plan = Plan::new(&scene).unwrap().in_three_dimensions();
                run_plan(&plan, &*model, &TIGHT)
                    .unwrap()
                    .outgoing
                    .orientations
            });
            for (k, tilt) in [row.tilt1_per_dz, row.tilt2_per_dz].into_iter().enumerate() {
                let difference = (headings[0][k].z - headings[1][k].z) / (2.0 * h);
                let off = (tilt - difference).abs() / difference.abs().max(1.0);
                assert!(off < 1e-5, "{row:?}: {difference}, off by {off:e}");
            }
        }
    }
}

/// Sign and scale, from another family of scenes: at right angles the heading of squirmer 1 turns by about 129 degrees per radius.
#[test]
fn regress_at_right_angles_lubrication_turns_a_heading_by_129_degrees_per_radius() {
    let family = Family::named("right-angles").unwrap();
    let scene = family
        .scene(&[("beta", 1.0), ("dx", 1.0), ("dz", 0.0)])
        .unwrap()
        .scene;
    let model = model(Method::Lt);
    let tangents = run_with_tangents(&scene, &*model, &TIGHT, &[raised()]).unwrap();
    let tilts = tangents.outgoing[0].map(|turned| turned.z.to_degrees());
    // The lowered one, squirmer 2, turns downward: -2.255 rad/a.
    assert!((tilts[1] + 129.2).abs() < 0.1, "{tilts:?}");
    assert!((tilts[0] - 68.7).abs() < 0.1, "{tilts:?}");
}

/// The mirror midway between the two takes Sigma to 2 - Sigma, half a turn takes Delta to 2 - Delta; both exchange the
/// squirmers, of which the first is the raised one.
#[test]
fn mirror_images_grow_alike() {
    for model in [Method::Lt, Method::Exact].map(model) {
        for (beta, delta, sigma) in POINTS {
            let at = |delta: f64, sigma: f64| {
                let row = growth_row(&model, pair(beta, 0.0), (delta, sigma), &TIGHT);
                [row.tilt1_per_dz, row.tilt2_per_dz]
            };
            let close = |a: [f64; 2], b: [f64; 2]| {
                a.iter()
                    .zip(b)
                    .all(|(a, b)| (a - b).abs() < 1e-6 * b.abs().max(1.0))
            };
            let [one, two] = at(delta, sigma);
            // Mirrored in the plane midway between them: phi1 and phi2 become pi - phi2 and pi - phi1, and the two change places and signs of z.
            let across = at(delta, 2.0 - sigma);
            assert!(close(across, [-two, -one]), "{across:?} {one} {two}");
            // Turned by half a turn about z: the two change places, phi1 and phi2 become phi2 - pi and phi1 + pi.
            let turned = at(2.0 - delta, sigma);
            assert!(close(turned, [-two, -one]), "{turned:?} {one} {two}");
        }
    }
}

#[test]
fn pairs_that_stay_have_an_exponent_and_others_have_none() {
    let model = model(Method::Lt);
    let parts = growth_row(&model, pair(1.0, 0.0), (0.41, 0.63), &TIGHT);
    assert!(parts.exponent.is_nan() && parts.growth > 0.0, "{parts:?}");
    let stays = growth_row(&model, pair(5.0, 0.0), (1.37, 0.85), &TIGHT);
    assert!(!stays.parts() && stays.exponent.is_finite(), "{stays:?}");
}

#[test]
fn what_has_no_growth_says_why() {
    let model = model(Method::Lt);
    let failed = growth_row(&model, pair(f64::NAN, 0.0), (0.5, 0.5), &TIGHT);
    assert_eq!((&*failed.outcome, &*failed.status), (FAILED, FAILED));
    assert!(failed.growth.is_nan() && failed.exponent.is_nan());
    let shares = growth_shares(&model, pair(5.0, 0.0), &[failed], 0.1);
    assert!((shares.undefined - 1.0).abs() < 1e-15 && shares.fiction() == 0.0);
    assert!(shares.median_growth.is_nan() && shares.largest_growth.is_nan());
}

#[test]
fn shares_count_what_grows_by_more_than_one_over_the_offset() {
    let model = model(Method::Lt);
    let row = growth_row(&model, pair(1.0, 0.0), (0.41, 0.63), &TIGHT);
    let at = |growth: f64, outcome: &str| GrowthRow {
        growth,
        outcome: outcome.to_owned(),
        ..row.clone()
    };
    let rows = [
        at(9.0, "scattered"),
        at(11.0, "scattered"),
        at(1e9, "pairwise"),
        at(0.0, "standoff"),
    ];
    let shares = growth_shares(&model, pair(1.0, 0.0), &rows, 0.1);
    let GrowthShares {
        parting,
        parting_fiction,
        staying,
        staying_fiction,
        median_growth,
        largest_growth,
        ..
    } = shares;
    let found = [
        parting,
        parting_fiction,
        staying,
        staying_fiction,
        median_growth,
        largest_growth,
    ];
    let expected = [0.5, 0.25, 0.5, 0.25, 11.0, 11.0];
    assert!(
        found
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-12),
        "{found:?}"
    );
}
