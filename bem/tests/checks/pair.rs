//! Loads of a pair against published tables, near-contact constants and laws.

use std::error::Error;

use bem::model::difference;
use bem::{Bem, BemError};
use scene::{Gap, Hydrodynamics, LoadSet, PairLoads, SceneError};

/// Gap and X11A X12A Y11A Y12A Y11B Y12B X11C X12C Y11C Y12C; A. K. Townsend, Phys. Fluids 35 (2023),
/// doi 10.1063/5.0175697.
const TOWNSEND_2023: [(f64, [f64; 10]); 8] = [
    (
        0.05,
        [
            6.6796509,
            -6.0316169,
            1.5031168,
            -0.77418245,
            -0.54318957,
            0.77304978,
            1.0362284,
            -0.12959754,
            1.3430591,
            0.13126187,
        ],
    ),
    (
        0.1,
        [
            4.0320976,
            -3.3811975,
            1.3930063,
            -0.65987526,
            -0.39450644,
            0.61714395,
            1.0283075,
            -0.11682955,
            1.2330279,
            0.10173991,
        ],
    ),
    (
        0.2,
        [
            2.6410486,
            -1.9844942,
            1.2880376,
            -0.54675096,
            -0.26187166,
            0.47073437,
            1.0187645,
            -0.09830028,
            1.1398069,
            0.074261004,
        ],
    ),
    (
        0.5,
        [
            1.7226671,
            -1.0497516,
            1.1648647,
            -0.40107891,
            -0.12414905,
            0.29703071,
            1.0070156,
            -0.064846795,
            1.0527378,
            0.041715395,
        ],
    ),
    (
        0.8,
        [
            1.4616681,
            -0.77324752,
            1.1130867,
            -0.32971927,
            -0.074806291,
            0.21908019,
            1.0031419,
            -0.045783909,
            1.0264207,
            0.027497726,
        ],
    ),
    (
        1.0,
        [
            1.3684796,
            -0.67017504,
            1.0921018,
            -0.29717586,
            -0.056746485,
            0.18538814,
            1.0019592,
            -0.037145353,
            1.0179857,
            0.021664665,
        ],
    ),
    (
        1.5,
        [
            1.2376722,
            -0.51623618,
            1.0605336,
            -0.24114588,
            -0.032157235,
            0.13082,
            1.000703,
            -0.023345294,
            1.0080819,
            0.012989044,
        ],
    ),
    (
        2.0,
        [
            1.1694701,
            -0.42721186,
            1.043303,
            -0.20447686,
            -0.02033142,
            0.098152276,
            1.0002964,
            -0.015630696,
            1.0042257,
            0.0084580237,
        ],
    ),
];

fn gap(eps: f64) -> Gap {
    Gap::new(eps).unwrap()
}

/// Largest error over the resistance scalars, relative to the larger of the scalar and 1.
fn worst(loads: &PairLoads, truth: &[f64]) -> f64 {
    let error =
        |((_, value), truth): ((String, f64), &f64)| (value - truth).abs() / truth.abs().max(1.0);
    loads
        .named()
        .into_iter()
        .zip(truth)
        .map(error)
        .fold(0.0, f64::max)
}

#[test]
fn val_every_resistance_scalar_is_townsends_to_a_ten_thousandth() {
    let model = Bem::new(Bem::DEFAULT_LEVEL).unwrap();
    for (eps, truth) in TOWNSEND_2023 {
        let error = worst(&model.loads(gap(eps), LoadSet::all(0)).unwrap(), &truth);
        assert!(error < 1e-4, "{error:e} at gap {eps}");
    }
}

#[test]
fn val_every_resistance_scalar_comes_closer_on_finer_meshes() {
    let models = [1, 3].map(|level| Bem::new(level).unwrap());
    for (eps, truth) in TOWNSEND_2023 {
        let [coarse, fine] =
            [0, 1].map(|k| worst(&models[k].loads(gap(eps), LoadSet::all(0)).unwrap(), &truth));
        assert!(
            fine < 0.5 * coarse,
            "{fine:e} after {coarse:e} at gap {eps}"
        );
    }
}

#[test]
fn val_near_contact_the_loads_are_those_of_lubrication_with_its_constants() {
    let eps = 0.001f64;
    let log = -eps.ln();
    let squeeze = 0.25 / eps + 9.0 / 40.0 * log;
    let mut truth = vec![
        squeeze + 0.9954,
        -squeeze - 0.3502,
        log / 6.0 + 0.9983,
        -log / 6.0 - 0.2737,
        -log / 4.0 + 0.2389,
        log / 4.0 - 0.0016,
        1.0518,
        -0.1503,
        log / 5.0 + 0.7028,
        log / 20.0 - 0.0275,
    ];
    let slopes = [3.0, -3.0, 1.0, -1.0, 1.6, 0.4];
    for constants in [
        [1.800, 0.920, 3.380, -0.653, -2.742, 0.766],
        [-4.767, 4.350, -1.646, 1.354, -4.429, 1.470],
    ] {
        truth.extend(slopes.iter().zip(constants).map(|(s, c)| s * log + c));
    }
    let loads = Bem::new(2)
        .unwrap()
        .loads(gap(eps), LoadSet::all(2))
        .unwrap();
    // The next terms are of order eps ln(1/eps) = 0.007.
    let error = worst(&loads, &truth);
    assert!(error < 0.01, "{error:e}");
}

#[test]
fn two_spheres_far_apart_do_not_interact() {
    let loads = Bem::new(2)
        .unwrap()
        .loads(gap(1e9), LoadSet::all(3))
        .unwrap();
    assert!(difference(&loads, &PairLoads::isolated(LoadSet::all(3))) < 1e-3);
    let other = loads
        .named()
        .into_iter()
        .filter(|(name, _)| name.contains('2'));
    for (name, value) in other.filter(|(name, _)| name.starts_with("XF2") || name.contains("12")) {
        assert!(value.abs() < 1e-7, "{name} {value:e}");
    }
}

/// Value at `x` of the interpolant through Chebyshev nodes (barycentric formula; Berrut & Trefethen,
/// SIAM Review 46 (2004) 501).
fn interpolate(nodes: &[f64], values: &[f64], x: f64) -> f64 {
    let (mut above, mut below) = (0.0, 0.0);
    let count = nodes.len() as f64;
    for (k, (node, value)) in nodes.iter().zip(values).enumerate() {
        let angle = std::f64::consts::PI * (k as f64 + 0.5) / count;
        let weight = if k % 2 == 0 {
            angle.sin()
        } else {
            -angle.sin()
        } / (x - node);
        above += weight * value;
        below += weight;
    }
    above / below
}

#[test]
fn loads_are_a_smooth_function_of_the_gap_between_seams() {
    let model = Bem::new(1).unwrap();
    let (low, high) = (0.004f64.ln(), 0.016f64.ln());
    let count = 10;
    let nodes: Vec<f64> = (0..count)
        .map(|k| (std::f64::consts::PI * (f64::from(k) + 0.5) / f64::from(count)).cos())
        .map(|s| f64::midpoint(low, high) + 0.5 * (high - low) * s)
        .collect();
    let columns = |ln: f64| -> Vec<f64> {
        model
            .loads(Gap::from_ln(ln), LoadSet::all(2))
            .unwrap()
            .columns()
            .collect()
    };
    let rows: Vec<Vec<f64>> = nodes.iter().map(|&ln| columns(ln)).collect();
    for ln in [0.3f64, 0.47, 0.9].map(|s| low + s * (high - low)) {
        for (j, truth) in columns(ln).into_iter().enumerate() {
            let values: Vec<f64> = rows.iter().map(|row| row[j]).collect();
            let error = (interpolate(&nodes, &values, ln) - truth).abs() / truth.abs().max(1.0);
            assert!(error < 1e-6, "{error:e} in column {j} at gap {}", ln.exp());
        }
    }
}

#[test]
fn loads_have_the_same_bits_on_any_number_of_threads() {
    let model = Bem::new(1).unwrap();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| model.loads(gap(0.03), LoadSet::all(2)).unwrap())
    };
    let bits = |loads: &PairLoads| loads.columns().map(f64::to_bits).collect::<Vec<_>>();
    assert_eq!(bits(&on(1)), bits(&on(3)));
}

#[test]
fn the_error_estimate_is_above_the_error() {
    let model = Bem::new(2).unwrap();
    for (eps, truth) in TOWNSEND_2023.into_iter().step_by(2) {
        let error = worst(&model.loads(gap(eps), LoadSet::all(0)).unwrap(), &truth);
        let estimate = model
            .error_estimate(gap(eps), LoadSet::all(0))
            .unwrap()
            .unwrap();
        assert!(
            estimate > error && estimate < 100.0 * error,
            "{estimate:e} for {error:e} at {eps}"
        );
    }
}

#[test]
fn only_six_systems_are_solved_a_gap() {
    let model = Bem::new(1).unwrap();
    model.loads(gap(1.0), LoadSet::all(8)).unwrap();
    assert_eq!(model.solves(), 6);
}

#[test]
fn a_part_of_the_loads_costs_fewer_solves_and_has_the_same_bits() {
    let whole = Bem::new(1).unwrap();
    let all = whole.loads(gap(0.1), LoadSet::all(2)).unwrap().named();
    for (set, solves) in [
        (LoadSet::axial(2), 2),
        (LoadSet::axial_and_twist(2), 4),
        (LoadSet::planar(2), 4),
    ] {
        let model = Bem::new(1).unwrap();
        let part = model.loads(gap(0.1), set).unwrap().named();
        assert_eq!((model.solves(), part.len()), (solves, set.column_count()));
        assert!(part.iter().all(|load| all.contains(load)), "{part:?}");
    }
}

#[test]
fn what_the_model_does_not_hold_is_refused() {
    assert!(matches!(Bem::new(0), Err(BemError::Level { level: 0, .. })));
    let model = Bem::new(1).unwrap();
    let refused = model.check(gap(1e-3)).unwrap_err();
    assert!(
        refused.to_string().ends_with("level 2 would do"),
        "{refused}"
    );
    assert!(matches!(
        refused,
        BemError::GapUnresolved {
            level: 1,
            needed: Some(2),
            ..
        }
    ));
    let refused = model.loads(gap(1e-4), LoadSet::all(1)).unwrap_err();
    assert!(matches!(refused, SceneError::Model { model: "bem", .. }));
    let cause = refused.source().and_then(<dyn Error>::downcast_ref);
    assert_eq!(cause, model.check(gap(1e-4)).err().as_ref());
    let refused = model.loads(gap(1.0), LoadSet::all(9));
    assert_eq!(
        refused,
        Err(SceneError::TooManyModes {
            modes: 9,
            allowed: 8
        })
    );
}
