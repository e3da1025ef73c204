//! Names of loads and what they stand before, sets at their limits, and what says which model it is.

#![allow(clippy::float_cmp, reason = "the very numbers that were put in")]

use nalgebra::Vector3;

use crate::effects::unit;
use crate::{
    ActiveLoads, Gap, Hydrodynamics, Isolated, LoadSet, MAX_MODES, ModeLoads, PairLoads, Plan,
    Pose, Scene, SceneError, SelfOther, Squirmer, SwirlLoads, SwirlModeLoads,
};

/// Loads that count: own 1, 3, 5, ..., of the other sphere 2, 4, 6, ....
fn counted(set: LoadSet) -> (PairLoads, SwirlLoads) {
    let of = |k: usize| SelfOther::new(2.0 * k as f64 + 1.0, 2.0 * k as f64 + 2.0);
    let rigid = [of(0), of(1), of(2), of(3), of(4)];
    let mode = |n: usize| ModeLoads {
        xf: of(5 + 3 * n),
        yf: of(6 + 3 * n),
        yt: of(7 + 3 * n),
    };
    let swirl = |n: usize| SwirlModeLoads {
        xtc: of(20 + 3 * n),
        yfc: of(21 + 3 * n),
        ytc: of(22 + 3 * n),
    };
    (
        PairLoads::from_parts(rigid, set, mode),
        SwirlLoads::from_modes(set, swirl),
    )
}

#[test]
fn loads_stand_behind_their_published_names() {
    let (pair, swirl) = counted(LoadSet::all(2).with_swirl(1));
    let named = pair.named();
    let expected = [
        ("X11A", 1.0),
        ("X12A", 2.0),
        ("Y11A", 3.0),
        ("Y12A", 4.0),
        ("Y11B", 5.0),
        ("Y12B", 6.0),
        ("X11C", 7.0),
        ("X12C", 8.0),
        ("Y11C", 9.0),
        ("Y12C", 10.0),
        ("XF1_1", 11.0),
        ("XF2_1", 12.0),
        ("YF1_1", 13.0),
        ("YF2_1", 14.0),
        ("YT1_1", 15.0),
        ("YT2_1", 16.0),
        ("XF1_2", 17.0),
        ("XF2_2", 18.0),
        ("YF1_2", 19.0),
        ("YF2_2", 20.0),
        ("YT1_2", 21.0),
        ("YT2_2", 22.0),
    ];
    assert_eq!(
        named
            .iter()
            .map(|(name, value)| (name.as_str(), *value))
            .collect::<Vec<_>>(),
        expected
    );
    let named = swirl.named();
    assert_eq!(
        named
            .iter()
            .map(|(name, value)| (name.as_str(), *value))
            .collect::<Vec<_>>(),
        [
            ("XTC1_1", 41.0),
            ("XTC2_1", 42.0),
            ("YFC1_1", 43.0),
            ("YFC2_1", 44.0),
            ("YTC1_1", 45.0),
            ("YTC2_1", 46.0)
        ]
    );
    // Along the line of centres alone.
    let names = |set: LoadSet| -> Vec<String> {
        counted(set)
            .0
            .named()
            .into_iter()
            .map(|(name, _)| name)
            .collect()
    };
    assert_eq!(names(LoadSet::axial(1)), ["X11A", "X12A", "XF1_1", "XF2_1"]);
    // Of a pair that is its own image one combination each: opposed forces along the line, equal ones across it.
    let turned = names(LoadSet::all(1).point_symmetric());
    assert_eq!(
        turned,
        [
            "X11A - X12A",
            "Y11A - Y12A",
            "Y11B - Y12B",
            "X11C",
            "X12C",
            "Y11C + Y12C",
            "XF1_1 - XF2_1",
            "YF1_1 - YF2_1",
            "YT1_1 + YT2_1"
        ]
    );
    let mirrored = names(LoadSet::planar(1).mirror_symmetric());
    assert_eq!(
        mirrored,
        [
            "X11A - X12A",
            "Y11A + Y12A",
            "Y11B + Y12B",
            "Y11C - Y12C",
            "XF1_1 - XF2_1",
            "YF1_1 + YF2_1",
            "YT1_1 - YT2_1"
        ]
    );
    assert_eq!(
        counted(LoadSet::all(1).point_symmetric()).0.named()[0].1,
        -1.0
    );
}

#[test]
fn loads_of_unlike_spheres_name_the_loaded_sphere_and_then_the_active_one() {
    let (pair, swirl) = counted(LoadSet::all(1).with_swirl(1));
    let loads = ActiveLoads {
        pair,
        torque_on_other: 99.0,
        swirl,
    };
    for (active, other) in [(1, 2), (2, 1)] {
        let named = loads.named(active);
        let of = |name: String| {
            let found: Vec<f64> = named
                .iter()
                .filter(|(other, _)| *other == name)
                .map(|(_, value)| *value)
                .collect();
            assert_eq!(found.len(), 1, "{name} in {named:?}");
            found[0]
        };
        for (name, value) in [
            (format!("X{active}{active}A"), 1.0),
            (format!("X{other}{active}A"), 2.0),
            (format!("Y{active}{active}B"), 5.0),
            (format!("Y{other}{active}B"), 99.0),
            (format!("Y{other}{active}B_force"), 6.0),
            (format!("X{active}{active}C"), 7.0),
            (format!("Y{other}{active}C"), 10.0),
            (format!("XF{active}{active}_1"), 11.0),
            (format!("YT{other}{active}_1"), 16.0),
        ] {
            assert_eq!(of(name), value);
        }
    }
}

#[test]
fn sets_have_as_many_modes_as_loads_hold() {
    for set in [
        LoadSet::all(MAX_MODES),
        LoadSet::all(0).with_swirl(MAX_MODES),
    ] {
        assert!(set.check().is_ok());
    }
    for (set, modes) in [
        (LoadSet::all(MAX_MODES + 1), MAX_MODES + 1),
        (LoadSet::all(MAX_MODES + 3).with_swirl(1), MAX_MODES + 3),
        (LoadSet::all(1).with_swirl(MAX_MODES + 2), MAX_MODES + 2),
    ] {
        let refused = SceneError::TooManyModes {
            modes,
            allowed: MAX_MODES,
        };
        assert_eq!(set.check(), Err(refused));
    }
}

#[test]
fn a_direction_of_any_length_becomes_one_of_unit_length() {
    let towards = Vector3::new(1.0, -2.0, 2.0);
    for size in [1e-300, 1e-150, 1e-3, 1.0, 7.0, 1e150, 1e300] {
        let found = unit("direction", towards * size).unwrap();
        assert!((found - towards / 3.0).norm() < 1e-15, "{size:e}: {found}");
    }
    // Already of unit length: not a bit changes.
    let exact = Vector3::new(0.6, 0.8, 0.0);
    assert_eq!(unit("direction", exact).unwrap(), exact);
    for none in [
        Vector3::zeros(),
        Vector3::new(f64::NAN, 1.0, 0.0),
        Vector3::new(f64::INFINITY, 0.0, 0.0),
    ] {
        assert!(matches!(
            unit("direction", none),
            Err(SceneError::NoDirection { .. })
        ));
    }
}

#[test]
fn a_motion_is_level_if_it_stays_in_a_plane_of_constant_z() {
    let of = |headings: [[f64; 3]; 2], at: [f64; 3]| {
        let pose = |position: [f64; 3], heading: [f64; 3]| Pose {
            position: position.into(),
            orientation: crate::Orientation::Vector(heading.into()),
        };
        let squirmers = [1.0, 2.0].map(|beta| Squirmer::with_beta(1.0, beta).unwrap());
        let start = [pose([0.0; 3], headings[0]), pose(at, headings[1])];
        Plan::new(&Scene::new(squirmers, start, None, None).unwrap())
            .unwrap()
            .is_level()
    };
    let flat = [[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0]];
    assert!(of(flat, [4.0, 1.0, 0.0]));
    assert!(!of(flat, [4.0, 1.0, 0.5]));
    // Along the line of centres, level and not.
    assert!(of([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], [4.0, 0.0, 0.0]));
    assert!(!of([[0.0, 0.6, 0.8], [0.0, -0.6, -0.8]], [0.0, 2.4, 3.2]));
    // In a plane that is tilted.
    assert!(!of([[0.0, 0.6, 0.8], [1.0, 0.0, 0.0]], [0.0, 2.4, 3.2]));
}

#[test]
fn spheres_without_interaction_say_which_radii_they_have_and_have_no_error_to_state() {
    assert_eq!(Isolated::EQUAL.fingerprint(), "isolated");
    assert_eq!(
        Isolated::of_ratio(2.5).fingerprint(),
        "isolated, radii 1 to 2.5"
    );
    let gap = Gap::new(0.1).unwrap();
    assert_eq!(
        Isolated::EQUAL.error_estimate(gap, LoadSet::all(2)),
        Ok(None)
    );
    assert!(
        Isolated::EQUAL
            .error_estimate(gap, LoadSet::all(MAX_MODES + 1))
            .is_err()
    );
}
