//! Tables of exact mobilities of unlike spheres against the solves that they stand for, from contact to infinity.

use std::sync::Arc;

use exact::Exact;
use scene::mobility::MobilitySet;
use scene::{
    Gap, Hydrodynamics, LoadSet, Outcome, Pose, Repulsion, Run, RunOptions, Scene, Squirmer,
    TableLimit, TableOptions, Tabulated, run,
};

use crate::common::model;

const TOLERANCE: f64 = 1e-9;

#[test]
fn val_a_table_of_unlike_spheres_is_the_direct_solve_at_any_gap() {
    let loads = LoadSet::planar(2);
    let exact = model(0.5);
    // Its form near contact is fitted before the table has a copy of it.
    exact.contact_constants_of_each(loads).unwrap();
    let set = MobilitySet {
        loads,
        torque: true,
    };
    let options = TableOptions {
        set: loads,
        tolerance: TOLERANCE,
        smallest_gap: f64::MIN_POSITIVE,
    };
    let table = Tabulated::build(Arc::new(exact.clone()), options, &|_| ()).unwrap();
    assert_eq!(table.summary().limit, TableLimit::Tolerance(TOLERANCE));
    for k in 0..90 {
        // From 1e-30 to 1e6, denser where collisions are.
        let x = f64::from(k) / 90.0;
        let gap = Gap::from_ln(if k % 3 == 0 {
            -69.0 + 83.0 * x
        } else {
            -7.0 + 10.0 * x
        });
        let [found, truth]: [Vec<(String, f64)>; 2] =
            [&table as &dyn Hydrodynamics, exact].map(|model| {
                model
                    .interacting_mobility_of_each(gap, set)
                    .unwrap()
                    .named(set)
            });
        for ((name, a), (_, b)) in found.into_iter().zip(truth) {
            // The opening is a velocity where the two are far apart, and grows as the logarithm of the gap at contact.
            let scale = if name.starts_with("opening") {
                gap.eps().max(1.0) / (1.0 + gap.log_inverse().max(0.0))
            } else {
                1.0
            };
            let error = scale * (a - b).abs() / b.abs().max(1.0);
            assert!(error < 1e-8, "{name} at {:e}: {a} {b}", gap.eps());
        }
    }
}

#[test]
fn what_else_is_asked_for_changes_no_load() {
    for ratio in [0.5, 3.0] {
        let exact = Exact::of_ratio(ratio).unwrap();
        let gap = Gap::new(0.07).unwrap();
        let whole = exact.loads_of_each(gap, LoadSet::all(2)).unwrap();
        let axial = exact.loads_of_each(gap, LoadSet::axial(0)).unwrap();
        let planar = exact.loads_of_each(gap, LoadSet::planar(1)).unwrap();
        for k in [0, 1] {
            let [whole, axial, planar] = [&whole, &axial, &planar].map(|of| &of[k]);
            for of in [axial, planar] {
                assert!((of.pair.xa.own() / whole.pair.xa.own() - 1.0).abs() < 1e-12);
                assert!((of.pair.xa.sum - whole.pair.xa.sum).abs() < 1e-12);
            }
            let (a, b) = (planar.pair.modes()[0], whole.pair.modes()[0]);
            assert!((a.yt.own() / b.yt.own() - 1.0).abs() < 1e-11);
            assert!((planar.torque_on_other / whole.torque_on_other - 1.0).abs() < 1e-11);
        }
    }
}

/// A collision by exact loads of squirmers of radii 1 and `LARGER`, the one in the place `first` named first.
fn collision(first: usize) -> (Run, f64) {
    const LARGER: f64 = 2.5;
    let radii = [1.0, LARGER];
    let unit = radii[first];
    let order = [first, 1 - first];
    let beta = [1.0, -3.0];
    let start = [([-9.0, 1.0], 0.0), ([6.0, -0.5], 175.0)];
    let squirmers = order.map(|k| {
        Squirmer::with_beta(1.0, beta[k])
            .and_then(|s| s.with_radius(radii[k] / unit))
            .unwrap()
    });
    let poses = order.map(|k| {
        let ([x, y], degrees) = start[k];
        Pose::planar(x / unit, y / unit, degrees)
    });
    // The same force in other units of length.
    let repulsion = Repulsion::new(10.0 / (unit * unit), 100.0 * unit).unwrap();
    let scene = Scene::new(squirmers, poses, Some(repulsion), None).unwrap();
    let exact = Exact::of_ratio(scene.ratio()).unwrap();
    let options = TableOptions {
        set: LoadSet::planar(2),
        tolerance: TOLERANCE,
        smallest_gap: 1e-3 / unit,
    };
    let table = Tabulated::build(Arc::new(exact), options, &|_| ()).unwrap();
    let options = RunOptions {
        tolerance: 1e-10,
        end_time: 400.0 / unit,
        ..RunOptions::default()
    };
    (run(&scene, &table, &options).unwrap(), unit)
}

#[test]
fn val_a_collision_does_not_depend_on_who_is_named_first() {
    let ((one, _), (two, unit)) = (collision(0), collision(1));
    assert!(
        one.min_gap < 0.1 && one.outcome == Outcome::Scattered,
        "{one:?}"
    );
    assert_eq!(two.outcome, Outcome::Scattered);
    let close = |a: f64, b: f64, what: &str| {
        assert!((a - b).abs() < 1e-6 * a.abs().max(1.0), "{what}: {a} {b}");
    };
    close(one.min_gap, two.min_gap * unit, "gap");
    close(
        one.contact_time,
        two.contact_time * unit,
        "interaction time",
    );
    // Where the two part, and so when.
    close(one.end_time, two.end_time * unit, "end");
    for k in [0, 1] {
        close(
            one.deflections_rad()[k],
            two.deflections_rad()[1 - k],
            "deflection",
        );
    }
    assert!(one.truncation_rad < 1e-7, "{one:?}");
}
