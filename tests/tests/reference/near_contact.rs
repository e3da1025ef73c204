//! Coefficients and constants near contact against those that others found.

use super::*;

static INVERSES: LazyLock<Numbers> = LazyLock::new(|| Numbers::read("near-contact.csv", "inverse"));
static SLOPES: LazyLock<Numbers> = LazyLock::new(|| Numbers::read("near-contact.csv", "logarithm"));
static CONSTANTS: LazyLock<Numbers> =
    LazyLock::new(|| Numbers::read("near-contact.csv", "constant"));

/// Jeffrey & Onishi's coefficients, which are next to `xi = 2 gap/(a1 + a2)`, and constants by multipole collocation.
#[test]
fn val_scalars_near_contact_are_those_of_jeffrey_and_onishi_and_of_multipole_collocation() {
    for row in published(fixtures::UNEQUAL_CONTACT) {
        let ratio = number(&row, "lambda");
        let published = &row["name"];
        let sum = 1.0 + ratio;
        // Force or torque on sphere 2 by sphere 1, in units of the first radius and not of the mean one.
        let (name, factor) = match (published.contains("12"), published.chars().last().unwrap()) {
            (false, _) => (published.clone(), 1.0),
            (true, kind) => {
                let power = match kind {
                    'A' => 1,
                    'B' => 2,
                    _ => 3,
                };
                let name = if scene::are_unlike(ratio) {
                    let name = published.replace("12", "21");
                    if kind == 'B' { name + "_force" } else { name }
                } else {
                    published.clone()
                };
                (name, (2.0 / sum).powi(power))
            }
        };
        // xi = scale eps.
        let scale = 2.0 * ratio.min(1.0) / sum;
        let [inverse, slope, constant] =
            [&INVERSES, &SLOPES, &CONSTANTS].map(|of| of.at(ratio, 1.0, &name));
        let near = |found: f64, truth: f64, allowed: f64| {
            let off = (factor * found - truth).abs();
            assert!(off <= allowed, "{name} of {ratio}: {found} {truth}");
        };
        near(inverse.value * scale, number(&row, "c_inv"), 1e-11);
        near(slope.value, number(&row, "c_log"), 1e-11);
        let moved = constant.value + slope.value * scale.ln();
        let digits = number(&row, "digits_of_constant") as i32;
        let allowed = 1.5 * 10_f64.powi(-digits) + factor * constant.error;
        near(moved, number(&row, "constant"), allowed);
    }
}

/// Loads by squirming next to `ln(1/eps)`, there with the gap in radii of the active sphere, by multipole collocation.
#[test]
fn val_squirming_near_contact_is_that_of_multipole_collocation() {
    let mut compared = 0;
    for row in published(fixtures::UNEQUAL_SQUIRMING) {
        let other_over_active = number(&row, "lambda_other_over_active");
        let (load, mode) = (&row["name"], &row["mode"]);
        let (kind, of_active) = (&load[..2], load.ends_with('1'));
        // Either sphere may be the active one.
        for (ratio, active) in [(other_over_active, 1), (1.0 / other_over_active, 2)] {
            let name = if scene::are_unlike(ratio) {
                let loaded = if of_active { active } else { 3 - active };
                format!("{kind}{loaded}{active}_{mode}")
            } else {
                format!("{load}_{mode}")
            };
            let slope = SLOPES.at(ratio, 1.0, &name);
            let constant = CONSTANTS.at(ratio, 1.0, &name);
            let radius = if active == 1 { 1.0 } else { ratio };
            let truth = number(&row, "constant")
                - number(&row, "slope_of_ln_1_over_eps") * (ratio.min(1.0) / radius).ln();
            let off = (slope.value - number(&row, "slope_of_ln_1_over_eps")).abs();
            assert!(off < 1e-9, "{name} of {ratio}: {slope:?} {row:?}");
            let digit = if kind == "XF" { 1e-7 } else { 1e-8 };
            let off = (constant.value - truth).abs();
            assert!(
                off < digit + constant.error,
                "{name} of {ratio}: {constant:?} {truth}"
            );
            compared += 1;
        }
    }
    assert_eq!(compared, 72);
}

#[test]
fn loads_follow_their_form_near_contact() {
    for row in rows_of("near-contact.csv") {
        let (ratio, name) = (number(&row, "ratio"), &row["name"]);
        // A millionth of the mean radius.
        let gap = 0.5e-6 * (1.0 + ratio);
        let eps = gap / ratio.min(1.0);
        let form = number(&row, "inverse") / eps
            + number(&row, "logarithm") * (1.0 / eps).ln()
            + number(&row, "constant");
        let load = LOADS.at(ratio, gap, name);
        // What is left out is of the order eps ln(1/eps), with factors that grow as the torque on the larger sphere.
        let unlike = 1.0 + ratio.max(1.0 / ratio);
        let allowed = 3.0 * unlike * unlike * eps * (1.0 / eps).ln()
            + load.error
            + number(&row, "error_estimate");
        assert!(
            (form - load.value).abs() < allowed,
            "{name} of {ratio}: {form} {load:?}"
        );
    }
}
