//! Spheres of unlike radii: what is the same pair, what holds far apart and at contact, and a sphere beside a wall.

use exact::{Exact, ExactError};
use scene::{ActiveLoads, Gap, Hydrodynamics, LoadSet, SceneError};

use crate::common::{self, EVERYTHING as SET, at, fitted, model};

fn loads(ratio: f64, eps: f64) -> [ActiveLoads; 2] {
    let [smallest, _] = model(ratio).description().seams[..] else {
        panic!("a smallest and a largest gap of the series")
    };
    let model = if eps < smallest {
        fitted(ratio)
    } else {
        model(ratio)
    };
    model
        .interacting_loads_of_each(at(eps), SET)
        .expect("loads")
}

/// Largest difference of two sets of loads, relative to the larger of the load and 1, and its name.
fn distance(a: &ActiveLoads, b: &ActiveLoads) -> (f64, String) {
    let pairs = a.named(1).into_iter().zip(b.named(1));
    let errors = pairs.map(|((name, a), (_, b))| ((a - b).abs() / b.abs().max(1.0), name));
    errors
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or_default()
}

#[test]
fn a_pair_has_the_same_loads_whichever_of_its_spheres_is_called_the_first() {
    // In radii of the smaller sphere.
    let limits = [(1e-6, 2e-9), (2e4, 1e-10)];
    let series = [(0.01, 1e-10), (1.0, 1e-10), (30.0, 1e-10)];
    // Forms take long to fit: the most unlike ratio, where errors come nearest the bound, and another one.
    for (ratio, with_limits) in [(0.01, true), (0.1, false), (0.5, true), (0.9, false)] {
        let limits = limits.iter().filter(|_| with_limits);
        for &(eps, tolerance) in limits.chain(&series) {
            let [large, small] = loads(ratio, eps * ratio);
            let [other_small, other_large] = loads(1.0 / ratio, eps);
            for (a, b) in [(small, other_small), (large, other_large)] {
                let (error, name) = distance(&b, &a);
                println!("{ratio} {eps:e}: {error:.1e} {name}");
                assert!(error < tolerance, "{name} at {ratio}, {eps:e}: {error:e}");
            }
        }
    }
}

#[test]
fn loads_of_one_sphere_by_motion_of_the_other_are_reciprocal() {
    for q in [0.01, 0.1, 0.5, 1.9, 2.0, 10.0, 100.0] {
        for eps in [0.01, 0.1, 1.0, 10.0] {
            let [one, two] = loads(q, eps * f64::min(q, 1.0));
            for (name, a, b) in [
                ("XA", one.pair.xa.other(), q * two.pair.xa.other()),
                ("YA", one.pair.ya.other(), q * two.pair.ya.other()),
                (
                    "force 2 by spin 1",
                    one.pair.yb.other(),
                    -q * q * two.torque_on_other,
                ),
                (
                    "torque 2 by motion 1",
                    one.torque_on_other,
                    -q * q * two.pair.yb.other(),
                ),
                ("XC", one.pair.xc.other(), q.powi(3) * two.pair.xc.other()),
                ("YC", one.pair.yc.other(), q.powi(3) * two.pair.yc.other()),
            ] {
                let unit = b.abs().max(q.powi(3)).max(1.0);
                assert!(
                    (a - b).abs() < 1e-10 * unit,
                    "{name} at {q}, {eps}: {a} {b}"
                );
            }
        }
    }
}

#[test]
fn the_first_swirl_mode_has_the_loads_of_rigid_rotation() {
    for ratio in [0.01, 0.5, 2.0, 100.0] {
        for eps in [1e-6, 0.01, 1.0, 1e5] {
            for of in loads(ratio, eps * f64::min(ratio, 1.0)) {
                let swirl = of.swirl.modes()[0];
                for (mode, rigid, factor) in [
                    (swirl.xtc, of.pair.xc, -8.0),
                    (swirl.yfc, of.pair.yb, -4.0),
                    (swirl.ytc, of.pair.yc, -8.0),
                ] {
                    for (a, b) in [(mode.own(), rigid.own()), (mode.other(), rigid.other())] {
                        let error = (a - factor * b).abs() / b.abs().max(1.0);
                        assert!(error < 1e-7, "{ratio} {eps:e}: {a} {}", factor * b);
                    }
                }
            }
        }
    }
}

#[test]
fn logarithms_at_contact_are_those_of_lubrication_theory_in_every_mode() {
    for ratio in [0.2, 0.5, 2.0, 7.0] {
        let model = model(ratio);
        let slopes = model
            .log_slopes_of_each(LoadSet::all(3).with_swirl(3))
            .unwrap();
        for (of, q) in slopes.iter().zip([ratio, 1.0 / ratio]) {
            let o = 1.0 + q;
            let own_force = 4.0 * q * (q + 4.0) / (5.0 * o * o);
            let (own_torque, torque) = (16.0 * q / (5.0 * o), 4.0 * q * q / (5.0 * o));
            let squeeze = 12.0 * q * q / (o * o);
            let mut rows = vec![
                (
                    of.pair.xa.own(),
                    q * (1.0 + 7.0 * q + q * q) / (5.0 * o.powi(3)),
                ),
                (
                    of.pair.ya.own(),
                    4.0 * q * (2.0 + q + 2.0 * q * q) / (15.0 * o.powi(3)),
                ),
                (of.pair.yb.own(), -own_force / 4.0),
                (of.pair.yb.other(), own_force / 4.0),
                (of.torque_on_other, -q * q * (1.0 + 4.0 * q) / (5.0 * o * o)),
                (of.pair.yc.own(), own_torque / 8.0),
                (of.pair.yc.other(), torque / 8.0),
            ];
            for mode in of.pair.modes() {
                rows.extend([
                    (mode.xf.own(), squeeze),
                    (mode.xf.other(), -squeeze),
                    (mode.yf.own(), own_force),
                    (mode.yf.other(), -own_force),
                    (mode.yt.own(), own_torque),
                    (mode.yt.other(), torque),
                ]);
            }
            for mode in of.swirl.modes() {
                rows.extend([
                    (mode.yfc.own(), own_force),
                    (mode.yfc.other(), -own_force),
                    (mode.ytc.own(), -own_torque),
                    (mode.ytc.other(), -torque),
                ]);
            }
            for (found, expected) in rows {
                let error = (found - expected).abs() / expected.abs().max(0.1);
                assert!(error < 1e-3, "{ratio}, {q}: {found} {expected}");
            }
        }
    }
}

/// Drag over `6 pi mu a U` of a sphere that moves towards a plane, H. Brenner, *Chem. Eng. Sci.* 16 (1961) 242.
fn drag_towards_a_wall(eps: f64) -> f64 {
    let alpha = (1.0 + eps).acosh();
    let (sinh, double) = (alpha.sinh(), (2.0 * alpha).sinh());
    let sum: f64 = (1..=(20.0 / alpha) as usize + 20)
        .map(|n| {
            let n = n as f64;
            let m = 2.0 * n + 1.0;
            let numerator = 2.0 * (m * alpha).sinh() + m * double;
            let denominator = 4.0 * (0.5 * m * alpha).sinh().powi(2) - (m * sinh).powi(2);
            n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * (numerator / denominator - 1.0)
        })
        .sum();
    4.0 / 3.0 * sinh * sum
}

/// `value` at large ratios differs from `wall` by something that halves as the ratio doubles.
fn assert_tends_to(name: &str, wall: f64, tolerance: f64, value: impl Fn(f64) -> f64) {
    let [first, second, last] = [25.0, 50.0, 100.0].map(value);
    // Without 1/ratio, and without its square.
    let limit = (8.0 * last - 6.0 * second + first) / 3.0;
    println!("{name}: {first:.6} {second:.6} {last:.6} -> {limit:.6}, wall {wall:.6}");
    assert!((limit - wall).abs() < tolerance, "{name}: {limit} {wall}");
    let halved = (last - limit) / (second - limit);
    assert!((halved - 0.5).abs() < 0.1, "{name}: {halved}");
}

#[test]
fn val_a_sphere_that_moves_towards_a_huge_one_has_brenners_drag_towards_a_wall() {
    for (eps, tolerance) in [(0.05, 1e-3), (0.3, 1e-3), (1.0, 1e-3)] {
        assert_tends_to(
            &format!("gap {eps}"),
            drag_towards_a_wall(eps),
            tolerance,
            |ratio| loads(ratio, eps)[0].pair.xa.own(),
        );
    }
}

#[test]
fn val_a_sphere_that_moves_along_a_huge_one_has_the_drag_along_a_wall() {
    // A. J. Goldman, R. G. Cox & H. Brenner, Chem. Eng. Sci. 22 (1967) 637, table 2: height over radius, drag.
    for (height, drag) in [
        (3.7622, 1.1738),
        (2.3524, 1.3079),
        (1.5431, 1.5675),
        (1.1276, 2.1514),
        (1.0453, 2.6475),
    ] {
        assert_tends_to(&format!("height {height}"), drag, 5e-4, |ratio| {
            loads(ratio, height - 1.0)[0].pair.ya.own()
        });
    }
}

#[test]
fn val_constants_at_contact_with_a_huge_sphere_are_those_of_a_wall() {
    // Drag (8/15) L + 0.9543 by M. E. O'Neill & K. Stewartson, J. Fluid Mech. 27 (1967) 705; force by rotation
    // (2/15) L - 0.2573 per 6 pi and torque (2/5) L + 0.3709 by M. D. A. Cooley & M. E. O'Neill, J. Inst. Maths Applics 4 (1968)
    // 163. Goldman, Cox & Brenner (1967) have 0.9588, 0.2526 and 0.3817 from tables at larger gaps.
    let constant = |ratio: f64| {
        // Of the largest ratio other tests have the form with swirl.
        let set = if ratio < 100.0 { LoadSet::all(0) } else { SET };
        model(ratio).contact_constants(set).expect("a fit")
    };
    assert_tends_to("drag", 0.9543, 1e-4, |ratio| constant(ratio).ya.own());
    assert_tends_to("force", 1.5 * 0.2573, 1e-4, |ratio| {
        constant(ratio).yb.own()
    });
    assert_tends_to("torque", 0.3709, 1e-4, |ratio| constant(ratio).yc.own());
}

#[test]
fn limiting_forms_and_series_hand_over_without_a_jump_and_know_their_error() {
    for ratio in [0.01, 0.5, 2.0, 100.0] {
        let model = fitted(ratio);
        let unlike = f64::max(ratio, 1.0 / ratio);
        let seams = model.description().seams.to_vec();
        for (seam, allowed) in seams.into_iter().zip([1e-9 * unlike, 1e-10]) {
            let side = |sign: f64| {
                let gap = Gap::from_ln(seam.ln() + sign * 1e-12);
                let loads = model.interacting_loads_of_each(gap, SET).unwrap();
                (loads, model.error_estimate(gap, SET).unwrap().unwrap())
            };
            let ((below, error), (above, other_error)) = (side(-1.0), side(1.0));
            for (a, b) in below.iter().zip(&above) {
                let (jump, name) = distance(a, b);
                println!(
                    "{ratio} {seam:e}: {name} {jump:.1e}, errors {error:.1e} {other_error:.1e}"
                );
                assert!(
                    jump < error + other_error + 1e-11,
                    "{name} at {seam:e}: {jump:e}"
                );
            }
            assert!(
                error < allowed && other_error < allowed,
                "{ratio}: {error:e} {other_error:e}"
            );
        }
    }
}

#[test]
fn rounding_of_the_series_near_contact_is_no_more_than_stated() {
    // Swirl is in the set for the sake of its form, which other tests use too.
    let set = LoadSet::all(2).with_swirl(2);
    for ratio in [2.0, 100.0] {
        let model = fitted(ratio);
        for from in [1.01e-4, 1e-3] {
            let gaps =
                (0..4).map(|k| at(from * f64::min(ratio, 1.0) * (1.0 + 0.35 * f64::from(k))));
            // Sums and differences too; the form averages the rounding of many gaps.
            let errors = gaps.map(|gap| {
                let form = model.near_contact_loads(gap, set).unwrap();
                let series = model.series_loads(gap, set).unwrap();
                let error = common::distance(&form, &series);
                let stated = model.error_estimate(gap, set).unwrap().unwrap();
                println!("{ratio} {:e}: {error:.1e}, stated {stated:.1e}", gap.eps());
                error / stated
            });
            let worst = errors.fold(0.0, f64::max);
            assert!(worst < 1.0, "{ratio}, {from:e}: {worst}");
        }
    }
}

#[test]
fn too_few_terms_show_in_the_error_estimate() {
    let fine = Exact::of_ratio(3.0).unwrap();
    let coarse = fine.clone().times_terms(0.25).unwrap();
    let set = LoadSet::all(2);
    for eps in [0.01, 0.3] {
        let of = |model: &Exact| model.interacting_loads_of_each(at(eps), set).unwrap();
        let (coarse_loads, loads) = (of(&coarse), of(&fine));
        let pairs = coarse_loads.iter().zip(&loads);
        let error = pairs.map(|(a, b)| distance(a, b).0);
        let error = error.fold(0.0, f64::max);
        let estimate = coarse.error_estimate(at(eps), set).unwrap().unwrap();
        println!("{eps}: {error:e} {estimate:e}");
        assert!(error > 1e-10, "{error:e}");
        assert!(
            estimate > 0.3 * error && estimate < 100.0 * error,
            "{estimate:e} {error:e}"
        );
    }
}

#[test]
fn distant_unlike_spheres_drag_each_other_by_a_stokeslet() {
    for ratio in [0.02, 0.5, 30.0] {
        let gap = at(1e4 * f64::max(ratio, 1.0));
        let distance = gap.distance_at_ratio(ratio);
        let [one, two] = loads(ratio, gap.eps());
        assert!((one.pair.xa.other() * distance / ratio + 1.5).abs() < 1e-3);
        assert!((two.pair.xa.other() * distance + 1.5).abs() < 1e-3);
        assert!((one.pair.ya.other() * distance / ratio + 0.75).abs() < 1e-3);
        assert!((two.pair.modes()[0].xf.own() - 4.0).abs() < 1e-3);
    }
}

#[test]
fn equal_radii_are_the_model_of_equal_spheres_to_the_last_bit() {
    let (equal, of_one) = (Exact::new(), Exact::of_ratio(1.0).unwrap());
    assert_eq!(equal.fingerprint(), of_one.fingerprint());
    let [first, second] = of_one.interacting_loads_of_each(at(0.3), SET).unwrap();
    let (pair, swirl) = equal.interacting_loads_with_swirl(at(0.3), SET).unwrap();
    assert_eq!((first.pair, first.swirl), (pair, swirl));
    assert_eq!(first, second);
}

#[test]
fn models_of_unlike_radii_say_so() {
    let model = Exact::of_ratio(2.0).unwrap();
    let near = Exact::of_ratio(2.0_f64.next_up()).unwrap();
    assert!(model.has_unlike_radii());
    assert_ne!(model.fingerprint(), near.fingerprint());
    assert_ne!(model.fingerprint(), Exact::new().fingerprint());
    let first = model.interacting_loads(at(0.3), LoadSet::all(2)).unwrap();
    assert_eq!(
        first,
        model
            .interacting_loads_of_each(at(0.3), LoadSet::all(2))
            .unwrap()[0]
            .pair
    );
}

#[test]
fn ratios_that_are_not_numbers_or_out_of_range_are_refused() {
    for ratio in [0.0099, 100.1, -1.0, f64::NAN, f64::INFINITY] {
        match Exact::of_ratio(ratio) {
            Err(error @ ExactError::InvalidRatio { .. }) => {
                assert!(error.to_string().contains("[0.01, 100]"));
            }
            other => panic!("{ratio}: {other:?}"),
        }
    }
    let model = Exact::of_ratio(3.0).unwrap();
    assert!(model.clone().times_terms(0.1).is_err());
    assert_eq!(
        model.interacting_loads_of_each(at(1.0), LoadSet::all(9)),
        Err(SceneError::TooManyModes {
            modes: 9,
            allowed: 8
        })
    );
}
