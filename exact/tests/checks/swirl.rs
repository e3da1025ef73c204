//! Swirl: what rigid rotation, the distance and the limiting forms say of its loads.

use scene::{Hydrodynamics, LoadSet, SelfOther};

use crate::common::{EQUAL, EVERYTHING, at};

const SET: LoadSet = LoadSet::all(0).with_swirl(8);

fn assert_close(name: &str, found: SelfOther, unit: f64, rotation: SelfOther, tolerance: f64) {
    for (found, expected) in [
        (found.sum, unit * rotation.sum),
        (found.difference, unit * rotation.difference),
    ] {
        let error = (found - expected).abs() / expected.abs().max(1.0);
        assert!(
            error < tolerance,
            "{name}: {found} {expected} ({error:.1e})"
        );
    }
}

#[test]
fn val_the_first_swirl_mode_has_the_loads_of_rigid_rotation() {
    for eps in [1e-6, 3e-4, 1e-2, 0.3, 3.0, 50.0, 1e3] {
        let (pair, swirl) = EQUAL.loads_with_swirl(at(eps), SET).unwrap();
        let first = swirl.modes()[0];
        let tolerance = 1e-10 + 1e-14 / eps.max(1e-4);
        assert_close("XTC", first.xtc, -8.0, pair.xc, tolerance);
        assert_close("YFC", first.yfc, -4.0, pair.yb, tolerance);
        assert_close("YTC", first.ytc, -8.0, pair.yc, tolerance);
    }
}

#[test]
fn val_far_apart_the_second_swirl_mode_acts_on_the_other_sphere_as_a_rotlet_dipole() {
    // The slip C_2 W_2 p x n of a lone sphere drives the flow C_2 r^-3 (p.n) p x n (harmonic), with the
    // curl C_2 r^-4 [(5 c^2 - 1) n - 2 c p], c = p.n. By Faxen's laws a sphere there feels the force
    // 6 pi times the one and the torque 4 pi times the other; reflections are smaller by r^-2.
    for r in [25.0, 50.0] {
        let (_, swirl) = EQUAL.loads_with_swirl(at(r - 2.0), SET).unwrap();
        let second = swirl.modes()[1];
        for (found, expected) in [
            (second.yfc.other() * r.powi(3), -6.0),
            (second.xtc.other() * r.powi(4), 8.0),
            (second.ytc.other() * r.powi(4), -8.0),
        ] {
            assert!(
                (found / expected - 1.0).abs() < 2.0 / (r * r),
                "{found} {expected} at {r}"
            );
        }
    }
}

#[test]
fn the_limiting_forms_vouch_for_swirl_as_for_squirming() {
    for eps in [1e-6, 1e3] {
        let plain = EQUAL
            .error_estimate(at(eps), LoadSet::all(8))
            .unwrap()
            .unwrap();
        let with = EQUAL.error_estimate(at(eps), EVERYTHING).unwrap().unwrap();
        println!("{eps:e}: {plain:.1e} without, {with:.1e} with swirl");
        assert!(with < 1e-9, "{eps}: {with:e}");
    }
}
