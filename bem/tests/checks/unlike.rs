//! Pairs of unlike radii: invariants, far-field laws, and agreement with `exact`.

use bem::{Bem, BemError, Estimates};
use exact::Exact;
use scene::{
    ActiveLoads, Gap, Hydrodynamics, LoadSet, SceneError, TableLimit, TableOptions, Tabulated,
};
use std::sync::Arc;

const SET: LoadSet = LoadSet::all(2).with_swirl(2);

fn gap(eps: f64) -> Gap {
    Gap::new(eps).unwrap()
}

fn model(level: usize, ratio: f64) -> Bem {
    Bem::of_ratio(level, ratio).unwrap()
}

fn loads(level: usize, ratio: f64, eps: f64) -> [ActiveLoads; 2] {
    let model = model(level, ratio);
    model.interacting_loads_of_each(gap(eps), SET).unwrap()
}

/// All loads by either sphere.
fn named(loads: &[ActiveLoads; 2]) -> Vec<(String, f64)> {
    let of = |k: usize| loads[k].named(k + 1);
    of(0).into_iter().chain(of(1)).collect()
}

/// The largest difference of a load, relative to the larger of the load and 1.
fn worst(found: &[ActiveLoads; 2], truth: &[ActiveLoads; 2]) -> (String, f64) {
    let rows = named(found).into_iter().zip(named(truth));
    rows.map(|((name, a), (_, b))| (name, (a - b).abs() / b.abs().max(1.0)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap()
}

#[test]
fn val_every_load_is_that_of_exact_to_a_thousandth_at_a_hundredth_of_the_smaller_radius() {
    // With its inverse by the test on spheres that change places.
    let (ratio, eps) = (2.0, 0.01);
    let truth = Exact::of_ratio(ratio).unwrap();
    let truth = truth.interacting_loads_of_each(gap(eps), SET).unwrap();
    let (name, error) = worst(&loads(Bem::DEFAULT_LEVEL, ratio, eps), &truth);
    // Found: 1.6e-4.
    assert!(error < 5e-4, "{name}: {error:e}");
}

#[test]
fn val_the_most_unlike_spheres_have_loads_too() {
    let (lowest, highest) = scene::RATIOS.into_inner();
    for (ratio, eps) in [(lowest, 2e-4), (lowest, 0.2), (highest, 1.0)] {
        let truth = Exact::of_ratio(ratio).unwrap();
        let truth = truth.interacting_loads_of_each(gap(eps), SET).unwrap();
        let (name, error) = worst(&loads(2, ratio, eps), &truth);
        assert!(error < 2e-3, "{name} at {ratio}, gap {eps}: {error:e}");
    }
}

#[test]
fn nearly_equal_spheres_have_the_loads_of_equal_ones() {
    for (level, eps) in [(1, 0.005), (1, 0.1), (2, 0.7), (1, 1.02), (1, 3.0)] {
        let equal = loads(level, 1.0, eps);
        for ratio in [1.0 + 1e-9, 1.0 - 1e-9] {
            let (name, off) = worst(&loads(level, ratio, eps), &equal);
            assert!(off < 1e-8, "{name} at gap {eps}: {off:e}");
        }
    }
}

#[test]
fn the_ratio_1_is_the_model_of_equal_spheres() {
    let (equal, one) = (Bem::new(1).unwrap(), model(1, 1.0));
    assert_eq!(equal.fingerprint(), one.fingerprint());
    assert_eq!(equal.description(), one.description());
    let at = gap(0.3);
    let pair = equal.loads(at, SET).unwrap();
    assert_eq!(pair, one.loads(at, SET).unwrap());
    let [first, second] = one.interacting_loads_of_each(at, SET).unwrap();
    assert_eq!((first.pair, first), (pair, second));
}

#[test]
fn spheres_that_change_places_have_the_same_loads() {
    for (ratio, of_smaller) in [(2.0, 0.02), (2.0, 3.0), (3.0, 0.5), (30.0, 5.0)] {
        let [one, two] = loads(1, ratio, of_smaller);
        let [second, first] = loads(1, 1.0 / ratio, of_smaller / ratio);
        let (name, off) = worst(&[one, two], &[first, second]);
        // The same meshes, their rows in another order.
        assert!(off < 1e-11, "{name} at ratio {ratio}: {off:e}");
    }
}

/// Forces and torques on the other sphere in one unit, per `pi mu`: each by sphere 1 and its partner by sphere 2.
fn reciprocal(of: [&ActiveLoads; 2], ratio: f64) -> [(&'static str, [f64; 2]); 3] {
    let scaled =
        |part: fn(&ActiveLoads) -> f64, power: i32| [part(of[0]), part(of[1]) * ratio.powi(power)];
    [
        ("XA", scaled(|l| l.pair.xa.other(), 1)),
        ("YA", scaled(|l| l.pair.ya.other(), 1)),
        ("YC", scaled(|l| l.pair.yc.other(), 3)),
    ]
}

fn as_loads(of: &Estimates) -> ActiveLoads {
    ActiveLoads {
        pair: of.loads,
        torque_on_other: of.torque_on_other,
        swirl: of.swirl,
    }
}

#[test]
fn what_each_sphere_does_to_the_other_is_the_same_within_its_own_estimate() {
    for (ratio, eps) in [(0.3, 0.02), (3.0, 0.1), (2.0, 1.0), (0.5, 5.0)] {
        let model = model(2, ratio);
        let (found, estimates) = model.solve_each_with_estimates(gap(eps), SET).unwrap();
        let loads = reciprocal(found.loads.each_ref(), ratio);
        let allowed = estimates.each_ref().map(as_loads);
        let allowed = reciprocal(allowed.each_ref(), ratio);
        for ((name, [a, b]), (_, [of_a, of_b])) in loads.into_iter().zip(allowed) {
            let off = (a - b).abs();
            assert!(off <= of_a + of_b, "{name} at {ratio}: {a} {b}");
            // Solved for apart: the mesh, not the algebra, makes them agree.
            assert!(off > 0.0, "{name} at {ratio}: {a}");
        }
        // The torque on the other sphere is taken from the force by spin of that.
        for k in [0, 1] {
            let q = if k == 0 { ratio } else { 1.0 / ratio };
            let by_spin = -found.loads[1 - k].pair.yb.other() * q * q;
            let torque = found.loads[k].torque_on_other;
            approx::assert_relative_eq!(torque, by_spin, max_relative = 1e-12);
        }
    }
}

#[test]
fn a_swirl_of_the_first_mode_is_a_spin() {
    for of in loads(2, 0.4, 0.05) {
        let [first, ..] = of.swirl.modes() else {
            panic!("no swirl")
        };
        let rigid = &of.pair;
        for (swirl, spin) in [
            (
                first.xtc,
                [rigid.xc.own(), rigid.xc.other()].map(|c| -8.0 * c),
            ),
            (
                first.yfc,
                [rigid.yb.own(), rigid.yb.other()].map(|c| -4.0 * c),
            ),
            (
                first.ytc,
                [rigid.yc.own(), rigid.yc.other()].map(|c| -8.0 * c),
            ),
        ] {
            for (a, b) in [swirl.own(), swirl.other()].into_iter().zip(spin) {
                assert!((a - b).abs() < 3e-3 * b.abs().max(1.0), "{a} {b}");
            }
        }
    }
}

#[test]
fn spheres_infinitely_far_apart_are_lone_ones_and_drag_each_other_along_by_a_stokeslet_before() {
    for ratio in [0.05, 0.5, 3.0] {
        let lone = [ActiveLoads::isolated(SET); 2];
        let (name, off) = worst(&loads(1, ratio, 1e300), &lone);
        assert!(off < 1e-9, "{name} at ratio {ratio}: {off:e}");
        // F2 = -6 pi a_2 u, u = 3 a_1/(2 r) along the line of centres and half of that across: the next terms are smaller by (a/r)².
        let eps = 100.0;
        let r = 1.0 + ratio + eps;
        let size = f64::max(1.0, ratio);
        for (of, [own, other]) in loads(1, ratio, eps)
            .iter()
            .zip([[1.0, ratio], [ratio, 1.0]])
        {
            let along = -1.5 * other / r;
            let allowed = 3.0 * along.abs() * (size / r).powi(2) + 9.0 * (own * other) / (r * r);
            assert!((of.pair.xa.other() - along).abs() < allowed * along.abs().max(0.01));
            assert!((of.pair.ya.other() - 0.5 * along).abs() < allowed * along.abs().max(0.01));
        }
    }
}

#[test]
fn loads_hardly_jump_where_meshes_change() {
    let model = model(1, 3.0);
    for &seam in model.description().seams {
        let [below, above] =
            [seam, seam.next_up()].map(|at| model.solve_each_with_estimates(gap(at), SET).unwrap());
        let rows = named(&below.0.loads).into_iter().zip(named(&above.0.loads));
        let allowed = [below.1, above.1].map(|of| named(&of.each_ref().map(as_loads)));
        for (((name, a), (_, b)), (of_a, of_b)) in rows.zip(allowed[0].iter().zip(&allowed[1])) {
            let off = (a - b).abs();
            assert!(off <= of_a.1 + of_b.1, "{name} at {seam}: {a} {b}");
        }
    }
}

#[test]
fn val_the_largest_error_is_within_the_largest_estimate_at_random_ratios_and_gaps() {
    // The example `unlike` does the same with 200 pairs at a level.
    for k in 1..=8_u8 {
        let share = |of: f64| (f64::from(k) * of).fract();
        let ratio = 5f64.powf(2.0 * share(0.754_877_666_246_693) - 1.0);
        let eps = 0.02 * 250f64.powf(share(0.569_840_290_998_053)) * ratio.min(1.0);
        let model = model(1 + usize::from(k) % 2, ratio);
        let truth = Exact::of_ratio(ratio).unwrap();
        let truth = truth.interacting_loads_of_each(gap(eps), SET).unwrap();
        let found = model.interacting_loads_of_each(gap(eps), SET).unwrap();
        let estimate = model.error_estimate(gap(eps), SET).unwrap().unwrap();
        let (name, error) = worst(&found, &truth);
        assert!(
            error <= estimate,
            "{name} at ratio {ratio}, gap {eps}: {error:e} against {estimate:e}"
        );
    }
}

#[test]
fn only_three_systems_are_solved_a_gap_and_those_of_lone_spheres_once() {
    let model = model(1, 0.5);
    let mut expected = 0;
    for (eps, set, new) in [
        (0.1, SET, 3),
        (0.1, LoadSet::axial(2), 1),
        (0.1, LoadSet::planar(1).point_symmetric(), 2),
        (3.0, SET, 9),
        (4.0, SET, 3),
    ] {
        model.interacting_loads_of_each(gap(eps), set).unwrap();
        expected += new;
        assert_eq!(model.solves(), expected, "gap {eps}");
    }
}

#[test]
fn loads_have_the_same_bits_on_any_number_of_threads_and_whatever_is_read_beside() {
    let bits = |threads: usize, set: LoadSet| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let found = pool.build().unwrap().install(|| {
            let model = model(1, 2.5);
            model.interacting_loads_of_each(gap(0.2), set).unwrap()
        });
        found.map(|of| [of.pair.xa.sum, of.pair.xa.difference].map(f64::to_bits))
    };
    let truth = bits(1, SET);
    assert_eq!(bits(2, SET), truth);
    assert_eq!(bits(2, LoadSet::axial(1).mirror_symmetric()), truth);
}

#[test]
fn a_model_of_unlike_spheres_says_what_it_is() {
    let ratio = 1.0 / 3.0;
    let (one, other) = (model(2, ratio), model(2, ratio.next_up()));
    assert_eq!(one.description().ratio.to_bits(), ratio.to_bits());
    assert_ne!(one.fingerprint(), other.fingerprint());
    // The loads of a pair are those of sphere 1.
    let at = gap(0.1);
    let [first, second] = one.interacting_loads_of_each(at, SET).unwrap();
    assert_eq!(one.interacting_loads(at, SET).unwrap(), first.pair);
    assert_ne!(first.pair, second.pair);
    let smallest = one.range().smallest;
    approx::assert_relative_eq!(
        smallest,
        0.001 * 2.0 * ratio / (1.0 + ratio),
        max_relative = 1e-14
    );
    assert!(one.loads(gap(smallest), SET).is_ok());
    let refused = one.loads(gap(0.999 * smallest), SET).unwrap_err();
    assert!(matches!(refused, SceneError::Model { .. }), "{refused}");
}

#[test]
fn between_seams_loads_are_smooth_enough_for_a_table_to_a_hundred_millionth() {
    let options = TableOptions {
        set: LoadSet::axial(2),
        tolerance: 1e-8,
        smallest_gap: 0.2,
    };
    let table = Tabulated::build(Arc::new(model(1, 3.0)), options, &|_| ()).unwrap();
    assert_eq!(table.summary().limit, TableLimit::Tolerance(1e-8));
}

#[test]
fn radii_that_are_too_unlike_are_refused() {
    for ratio in [0.0099, 100.1, 0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Bem::of_ratio(1, ratio).unwrap_err();
        assert!(matches!(refused, BemError::Ratio { .. }), "{refused}");
        let told = refused.to_string();
        assert!(
            told.contains(&format!("{ratio:?}")) && told.contains("0.01 to 100"),
            "{told}"
        );
    }
}
