//! What holds at contact, far apart, and for pairs that move as one.

use exact::{Exact, SERIES_FROM, SERIES_TO};
use scene::{Gap, Hydrodynamics, LoadSet, PairLoads, SceneError};

use crate::common::{EQUAL, at, distance};

/// Constants next to the logarithms at contact, self and other, and the unit of their last digit
/// (some are cut off, not rounded): by multipole collocation about both centres and extrapolation.
const CONTACT_CONSTANTS: [(&str, f64, f64); 22] = [
    ("X11A", 0.9954, 1e-4),
    ("X12A", -0.3502, 1e-4),
    ("Y11A", 0.9983, 1e-4),
    ("Y12A", -0.2737, 1e-4),
    ("Y11B", 0.2389, 1e-4),
    ("Y12B", -0.0016, 1e-4),
    ("X11C", 1.0518, 1e-4),
    ("X12C", -0.1503, 1e-4),
    ("Y11C", 0.7028, 1e-4),
    ("Y12C", -0.0275, 1e-4),
    ("XF1_1", 1.800, 1e-3),
    ("XF2_1", 0.920, 1e-3),
    ("YF1_1", 3.380, 1e-3),
    ("YF2_1", -0.653, 1e-3),
    ("YT1_1", -2.742, 1e-3),
    ("YT2_1", 0.766, 1e-3),
    ("XF1_2", -4.767, 1e-3),
    ("XF2_2", 4.350, 1e-3),
    ("YF1_2", -1.646, 1e-3),
    ("YF2_2", 1.354, 1e-3),
    ("YT1_2", -4.429, 1e-3),
    ("YT2_2", 1.470, 1e-3),
];

#[test]
fn val_contact_constants_are_those_of_multipole_collocation() {
    let constants = EQUAL.contact_constants(LoadSet::all(2)).unwrap();
    for ((name, own), (expected_name, expected, digit)) in
        constants.named().into_iter().zip(CONTACT_CONSTANTS)
    {
        println!("{name} {own:.8}");
        assert_eq!(name, expected_name);
        assert!((own - expected).abs() < digit, "{name}: {own} {expected}");
    }
}

#[test]
fn touching_spheres_that_fall_along_their_centre_line_have_a_drag_of_0_645141() {
    // Cooley & O'Neill, Mathematika 16 (1969) 37: 0.645 14.
    let constants = EQUAL.contact_constants(LoadSet::all(0)).unwrap();
    assert!((constants.xa.sum - 0.645_141).abs() < 1e-6);
}

#[test]
fn touching_spheres_that_twist_oppositely_have_a_torque_of_zeta_of_three() {
    let constants = EQUAL.contact_constants(LoadSet::all(0)).unwrap();
    assert!((constants.xc.difference - 1.202_056_903_159_594).abs() < 1e-10);
    assert!((constants.xc.sum - 0.75 * 1.202_056_903_159_594).abs() < 1e-10);
}

#[test]
fn slip_loads_grow_with_the_logarithm_of_the_gap_as_3_1_and_8_and_2_fifths_in_every_mode() {
    let (slopes, swirl) = EQUAL.log_slopes(LoadSet::all(3).with_swirl(3)).unwrap();
    println!("{:?}", slopes.named());
    for mode in slopes.modes() {
        for (slope, expected) in [
            (mode.xf.own(), 3.0),
            (mode.xf.other(), -3.0),
            (mode.yf.own(), 1.0),
            (mode.yf.other(), -1.0),
            (mode.yt.own(), 1.6),
            (mode.yt.other(), 0.4),
        ] {
            assert!(
                (slope - expected).abs() < 5e-4 * f64::abs(expected),
                "{slope} {expected}"
            );
        }
    }
    for mode in swirl.modes() {
        for (slope, expected) in [
            (mode.xtc.own(), 0.0),
            (mode.xtc.other(), 0.0),
            (mode.yfc.own(), 1.0),
            (mode.yfc.other(), -1.0),
            (mode.ytc.own(), -1.6),
            (mode.ytc.other(), -0.4),
        ] {
            assert!((slope - expected).abs() < 5e-4, "{slope} {expected}");
        }
    }
}

#[test]
fn the_asymptotic_form_continues_the_series_below_where_it_takes_over() {
    let exact = &*EQUAL;
    for eps in [9e-5, 3e-5, 1e-5] {
        let series = exact.series_loads(at(eps), LoadSet::all(8)).unwrap();
        let form = exact.loads(at(eps), LoadSet::all(8)).unwrap();
        println!("{eps:e}: {:.1e}", distance(&form, &series));
        // The series' own rounding grows as 1/eps.
        assert!(distance(&form, &series) < 3e-14 / eps + 1e-10, "{eps}");
    }
}

#[test]
fn loads_do_not_jump_where_one_form_hands_over_to_another() {
    let exact = &*EQUAL;
    for (seam, tolerance) in [(SERIES_FROM, 2e-10), (SERIES_TO, 1e-13)] {
        let below = exact
            .loads(Gap::from_ln(seam.ln() - 1e-13), LoadSet::all(8))
            .unwrap();
        let above = exact
            .loads(Gap::from_ln(seam.ln() + 1e-13), LoadSet::all(8))
            .unwrap();
        println!("{seam:e}: {:.1e}", distance(&below, &above));
        assert!(distance(&below, &above) < tolerance + 4e-13, "{seam}");
    }
}

#[test]
fn two_spheres_far_apart_do_not_interact() {
    let loads = EQUAL.loads(at(1e12), LoadSet::all(8)).unwrap();
    assert!(distance(&loads, &PairLoads::isolated(LoadSet::all(8))) < 1e-11);
    let infinite = EQUAL.loads(Gap::from_ln(800.0), LoadSet::all(8)).unwrap();
    assert!(distance(&infinite, &PairLoads::isolated(LoadSet::all(8))) < 1e-14);
}

#[test]
fn distant_spheres_drag_each_other_by_a_stokeslet() {
    let gap = at(1e4);
    let (r, loads) = (gap.distance(), EQUAL.loads(gap, LoadSet::all(1)).unwrap());
    assert!((loads.xa.other() * r + 1.5).abs() < 1e-6);
    assert!((loads.ya.other() * r + 0.75).abs() < 1e-6);
    assert!((loads.yb.other() * r * r - 1.5).abs() < 1e-3);
    assert!((loads.xc.other() * r.powi(3) + 1.0).abs() < 1e-2);
}

#[test]
fn a_pair_that_moves_as_one_body_feels_no_lubrication() {
    let exact = &*EQUAL;
    let contact = exact.contact_constants(LoadSet::all(0)).unwrap();
    for eps in [1e-9, 1e-6, 1e-3] {
        let gap = at(eps);
        let loads = exact.loads(gap, LoadSet::all(0)).unwrap();
        // Along the line of centres, and twist.
        assert!((loads.xa.sum - contact.xa.sum).abs() < 20.0 * eps);
        assert!((loads.xc.sum - contact.xc.sum).abs() < 20.0 * eps);
        // Turning about the middle as one: velocities omega (1 + eps/2) across, oppositely directed.
        // F1_t/(2 pi omega) = -3 (Y11A - Y12A) h + 2 (Y11B - Y12B) with U = -omega h for sphere 1.
        let h = 0.5 * gap.distance();
        let force = 3.0 * loads.ya.difference * h + 2.0 * loads.yb.difference;
        let torque = -loads.yb.difference * h - 2.0 * loads.yc.sum;
        let force_at_contact = 3.0 * contact.ya.difference + 2.0 * contact.yb.difference;
        let torque_at_contact = -contact.yb.difference - 2.0 * contact.yc.sum;
        let slack = 20.0 * eps * gap.log_inverse() + 1e-8;
        assert!((force - force_at_contact).abs() < slack, "{force}");
        assert!((torque - torque_at_contact).abs() < slack, "{torque}");
    }
}

#[test]
fn modes_beyond_the_first_do_not_propel_a_lone_squirmer() {
    let loads = EQUAL.loads(at(1e3), LoadSet::all(8)).unwrap();
    for mode in &loads.modes()[1..] {
        assert!(mode.xf.own().abs() < 1e-5 && mode.yf.own().abs() < 1e-5);
        assert!(mode.yt.own().abs() < 1e-5);
    }
}

#[test]
fn a_part_of_the_loads_has_the_bits_of_all() {
    for eps in [1e-5, 0.1, 300.0] {
        let all = EQUAL.loads(at(eps), LoadSet::all(2)).unwrap().named();
        for set in [LoadSet::axial(2), LoadSet::planar(1)] {
            let part = EQUAL.loads(at(eps), set).unwrap().named();
            assert_eq!(part.len(), set.column_count());
            // The modes asked for decide the number of terms.
            let same = |load: &(String, f64)| {
                (all.iter()).any(|(name, value)| *name == load.0 && (value - load.1).abs() < 1e-10)
            };
            assert!(part.iter().all(same), "{part:?}");
        }
        let axial = EQUAL.loads(at(eps), LoadSet::axial(2)).unwrap().named();
        assert!(axial.iter().all(|load| all.contains(load)), "{axial:?}");
    }
}

#[test]
fn gaps_that_are_not_numbers_or_not_positive_are_refused() {
    let exact = &*EQUAL;
    assert!(matches!(
        exact.loads(Gap::from_ln(f64::NAN), LoadSet::all(2)),
        Err(SceneError::GapOutsideRange { .. })
    ));
    assert!(matches!(
        exact.loads(Gap::from_ln(-1000.0), LoadSet::all(2)),
        Err(SceneError::GapOutsideRange { .. })
    ));
}

#[test]
fn more_modes_than_the_loads_hold_are_refused() {
    let error = EQUAL.loads(at(1.0), LoadSet::all(9));
    assert_eq!(
        error,
        Err(SceneError::TooManyModes {
            modes: 9,
            allowed: 8
        })
    );
    assert!(EQUAL.contact_constants(LoadSet::all(9)).is_err());
    assert!(EQUAL.log_slopes(LoadSet::all(9)).is_err());
}

#[test]
fn a_series_with_too_many_terms_is_refused() {
    assert!(EQUAL.series_loads(at(1e-12), LoadSet::all(2)).is_err());
    assert!(Exact::with_terms(0.0).is_err());
    assert!(Exact::with_terms(f64::NAN).is_err());
}
