//! How far the loads are from the limit of infinitely many terms.

use exact::Exact;
use scene::{Hydrodynamics, LoadSet};

use crate::common::{EQUAL, at, distance};

#[test]
fn doubling_the_number_of_terms_changes_nothing() {
    let (single, double) = (&*EQUAL, Exact::with_terms(2.0).unwrap());
    for (eps, tolerance) in [
        (100.0, 1e-10),
        (20.0, 1e-10),
        (2.0, 1e-10),
        (0.5, 1e-10),
        (0.1, 1e-10),
        (0.01, 1e-10),
        (1e-3, 1e-8),
        (1e-4, 1e-6),
    ] {
        for modes in [2, 8] {
            let loads = single.series_loads(at(eps), LoadSet::all(modes)).unwrap();
            let finer = double.series_loads(at(eps), LoadSet::all(modes)).unwrap();
            let change = distance(&loads, &finer);
            println!("gap {eps:e}, {modes} modes: {change:.1e}");
            assert!(change < tolerance, "{eps}: {change:e}");
        }
    }
}

#[test]
fn the_flow_keeps_its_boundary_values_at_points_that_were_not_fitted() {
    for (eps, tolerance) in [
        (20.0, 1e-11),
        (1.0, 1e-11),
        (0.1, 1e-11),
        (0.01, 1e-10),
        (1e-3, 1e-8),
    ] {
        let residual = EQUAL.residual(at(eps), LoadSet::all(8)).unwrap();
        println!("gap {eps:e}: {residual:.1e}");
        assert!(residual < tolerance, "{eps}: {residual:e}");
    }
}

#[test]
fn too_few_terms_show_in_the_residual_and_in_the_error_estimate() {
    let coarse = Exact::with_terms(0.25).unwrap();
    let gap = at(0.01);
    let loads = coarse.loads(gap, LoadSet::all(2)).unwrap();
    let truth = EQUAL.loads(gap, LoadSet::all(2)).unwrap();
    let error = distance(&loads, &truth);
    let estimate = coarse
        .error_estimate(gap, LoadSet::all(2))
        .unwrap()
        .unwrap();
    println!("{error:e} {estimate:e}");
    assert!(error > 1e-8);
    assert!(coarse.residual(gap, LoadSet::all(2)).unwrap() > 1e-4);
    assert!(
        estimate > 0.3 * error && estimate < 30.0 * error,
        "{estimate:e} {error:e}"
    );
}

#[test]
fn the_error_estimate_stays_below_a_nanometre_a_metre() {
    for eps in [1e-12, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e3, 1e9] {
        let estimate = EQUAL
            .error_estimate(at(eps), LoadSet::all(8))
            .unwrap()
            .unwrap();
        println!("gap {eps:e}: {estimate:.1e}");
        assert!(estimate < 1e-9, "{eps}: {estimate:e}");
    }
}

#[test]
fn regress_the_reference_table_is_reproduced() {
    for line in include_str!("../../reference.csv").lines().skip(1) {
        let mut cells = line.split(',');
        let mut next = || cells.next().unwrap();
        let (eps, name, value): (f64, _, f64) =
            (next().parse().unwrap(), next(), next().parse().unwrap());
        let loads = EQUAL.loads(at(eps), LoadSet::all(2)).unwrap().named();
        let own = loads.iter().find(|l| l.0 == name).unwrap().1;
        assert!(
            (own - value).abs() < 1e-11 * value.abs().max(1.0),
            "{line}: {own}"
        );
    }
}

#[test]
fn limiting_forms_follow_the_number_of_terms_and_estimate_what_they_leave_out() {
    let coarse = Exact::with_terms(0.25).unwrap();
    let set = LoadSet::all(2);
    for eps in [1e-6, 1e-5] {
        let gap = at(eps);
        let loads = coarse.loads(gap, set).unwrap();
        let error = distance(&loads, &EQUAL.loads(gap, set).unwrap());
        let estimate = coarse.error_estimate(gap, set).unwrap().unwrap();
        println!("{eps:e}: {error:e} {estimate:e}");
        assert!(error > 1e-8, "{eps}: {error:e}");
        assert!(estimate > 0.1 * error, "{eps}: {estimate:e} {error:e}");
    }
}
