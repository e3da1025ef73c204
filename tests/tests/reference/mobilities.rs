//! Coefficients of motion against published resistance scalars and boundary elements.

use bem::Bem;
use scene::mobility::MobilitySet;
use scene::{Gap, Hydrodynamics, LoadSet};
use tests::{ResistanceRow, two_sphere_resistance};

use super::*;

/// What a row of scalars makes of the coefficients by repulsion and torques, by the balance of one sphere: the other one is its image.
fn of_scalars(row: &ResistanceRow) -> [(&'static str, f64); 7] {
    let (gap, distance) = (row.eps(), row.r_over_a);
    // Velocity and spin by a unit of torque per pi, where the other sphere has the same (sign -1) or the opposite (sign 1) in its own frame.
    let by_torque = |sign: f64| {
        let a = 6.0 * (row.Y11A + sign * row.Y12A);
        let b = 4.0 * (row.Y11B + sign * row.Y12B);
        let c = 8.0 * (row.Y11C - sign * row.Y12C);
        let determinant = a * c - b * b;
        [b / determinant, a / determinant]
    };
    let ([like, counter], [opposed, mean]) = (by_torque(1.0), by_torque(-1.0));
    [
        (
            "opening, d(ln eps)/dt by f",
            1.0 / (3.0 * gap * (row.X11A - row.X12A)),
        ),
        ("mean velocity across d by t1 - t2", 0.5 * like),
        (
            "half the difference of the spins across d by t1 - t2",
            0.5 * counter,
        ),
        ("turning of d by t1 + t2", -opposed / distance),
        ("mean spin across d by t1 + t2", 0.5 * mean),
        (
            "mean spin about d by (T1 + T2) . d",
            1.0 / (16.0 * (row.X11C + row.X12C)),
        ),
        (
            "half the difference of the spins about d by (T1 - T2) . d",
            1.0 / (16.0 * (row.X11C - row.X12C)),
        ),
    ]
}

/// The scalars of equal spheres at the distances of Jeffrey & Onishi's table that RYUON and multipole collocation filled, with how many
/// units of their last digit the coefficients may be off.
fn of_jeffrey_and_onishi() -> Vec<(ResistanceRow, f64)> {
    let rows: Vec<_> = (published(fixtures::UNEQUAL_RESISTANCE).into_iter())
        .filter(|row| (number(row, "lambda") - 1.0).abs() < 1e-12)
        .collect();
    (rows.chunk_by(|a, b| a["s_over_mean"] == b["s_over_mean"]))
        .map(|of_distance| {
            let of = |name: &str| {
                let row = of_distance.iter().find(|row| row["name"] == name);
                number(row.unwrap(), "value")
            };
            let r_over_a = number(&of_distance[0], "s_over_mean");
            let scalars = ResistanceRow {
                r_over_a,
                X11A: of("X11A"),
                X12A: of("X12A"),
                Y11A: of("Y11A"),
                Y12A: of("Y12A"),
                Y11B: of("Y11B"),
                Y12B: of("Y12B"),
                X11C: of("X11C"),
                X12C: of("X12C"),
                Y11C: of("Y11C"),
                Y12C: of("Y12C"),
            };
            (scalars, if r_over_a < 2.4 { 2e-8 } else { 2e-10 })
        })
        .collect()
}

#[test]
fn val_motion_by_forces_and_torques_is_that_of_the_published_scalars() {
    // Townsend's table has eight digits; its squeeze pair at r = 2.05 is off by 1.6e-6.
    let of_townsend = two_sphere_resistance().into_iter().map(|row| (row, 3e-6));
    let mut compared = 0;
    for (row, digits) in of_townsend.chain(of_jeffrey_and_onishi()) {
        for (name, truth) in of_scalars(&row) {
            let Some(known) = MOBILITIES.find(1.0, row.eps(), name) else {
                continue;
            };
            compared += 1;
            let off = (known.value - truth).abs();
            let allowed = digits * truth.abs().max(0.01) + known.error;
            assert!(off < allowed, "{name} at {}: {known:?} {truth}", row.eps());
        }
    }
    assert_eq!(compared, 2 * 6 * 7);
}

/// By the series of Stimson & Jeffery, Brenner and Jeffery to 25 digits: errors are what they are said to be.
#[test]
fn val_motion_along_the_line_of_centres_is_within_its_errors_of_closed_series() {
    let mut compared = 0;
    for row in published(fixtures::CONTACT_LOADS) {
        let gap = number(&row, "eps");
        let of = |column: &str| number(&row, column);
        for (name, truth) in [
            (
                "opening, d(ln eps)/dt by f",
                1.0 / (3.0 * gap * of("xa_difference")),
            ),
            (
                "mean spin about d by (T1 + T2) . d",
                1.0 / (16.0 * of("xc_sum")),
            ),
            (
                "half the difference of the spins about d by (T1 - T2) . d",
                1.0 / (16.0 * of("xc_difference")),
            ),
        ] {
            let Some(known) = MOBILITIES.find(1.0, gap, name) else {
                continue;
            };
            let off = (known.value - truth).abs();
            assert!(
                off <= known.error + 1e-15,
                "{name} at {gap}: {known:?} {truth}"
            );
            compared += 1;
        }
    }
    assert_eq!(compared, 6 * 3);
}

#[test]
fn val_motion_by_slip_is_that_of_boundary_elements() {
    let bem = Bem::new(Bem::DEFAULT_LEVEL).unwrap();
    let set = MobilitySet {
        loads: LoadSet::all(2),
        torque: true,
    };
    for gap in [0.01, 0.1, 1.0] {
        let mobility = bem.mobility(Gap::new(gap).unwrap(), set).unwrap();
        let named = mobility.named(set);
        assert_eq!(named.len(), 19);
        for (name, by_elements) in named {
            let known = MOBILITIES.at(1.0, gap, &name);
            let off = (known.value - by_elements).abs() / by_elements.abs().max(1.0);
            assert!(off < 2e-4, "{name} at {gap}: {known:?} {by_elements}");
        }
    }
}
