//! Swimmers past passive spheres by lubrication theory.

use std::time::Duration;

use approx::assert_relative_eq;

use super::*;
use crate::ModelOptions;

fn lt(ratios: &[f64]) -> Model {
    let options = ModelOptions {
        ratios: ratios.to_vec(),
        ..ModelOptions::default()
    };
    Model::set_up(Method::Lt, &options).unwrap()
}

fn cargo(b: f64, ratio: f64) -> Cargo {
    Cargo {
        beta: 1.0,
        ratio,
        b,
        far: 8.0,
    }
}

fn by_lubrication(ratio: f64, b: f64) -> CargoRow {
    let cargo = Cargo {
        beta: 1.0,
        ratio,
        b,
        far: 20.0,
    };
    let options = ModelOptions::default().for_scenes([cargo.scene()]).unwrap();
    let model = Model::set_up(Method::LtCorrected, &options).unwrap();
    cargo_rows(&[model], &[cargo], &RunOptions::default()).remove(0)
}

#[test]
fn a_swimmer_pushes_cargo_ahead_and_leaves_it_alone_where_it_does_not_meet_it() {
    for ratio in [0.3, 1.0, 4.0] {
        let pushed = by_lubrication(ratio, 0.3);
        assert!(pushed.along > 0.1 && pushed.min_gap < 0.1, "{pushed:?}");
        // The cut of lubrication theory is at one radius of the smaller sphere.
        let alone = by_lubrication(ratio, 1.0 + ratio + 1.01 * ratio.min(1.0));
        assert_eq!(
            [alone.along, alone.across].map(f64::to_bits),
            [0; 2],
            "{alone:?}"
        );
    }
}

#[test]
fn the_side_on_which_a_swimmer_passes_does_not_matter() {
    let [one, other] = [0.6, -0.6].map(|b| by_lubrication(2.0, b));
    assert_relative_eq!(one.along, other.along, epsilon = 1e-7);
    assert_relative_eq!(one.across, other.across, epsilon = 1e-7);
    assert_relative_eq!(one.deflection_deg, -other.deflection_deg, epsilon = 1e-4);
}

#[test]
fn cargo_that_is_almost_as_large_is_moved_as_one_that_is_as_large() {
    let [equal, unlike] = [1.0, 1.0 + 1e-10].map(|ratio| by_lubrication(ratio, 0.6));
    assert_relative_eq!(equal.along, unlike.along, epsilon = 1e-6);
    assert_relative_eq!(equal.across, unlike.across, epsilon = 1e-6);
}

#[test]
fn val_a_displacement_is_a_limit_that_the_distance_of_the_start_does_not_change() {
    let rows = [30.0, 120.0].map(|far| {
        let cargoes = [0.0, 3.0].map(|beta| Cargo {
            beta,
            ratio: 0.5,
            b: 1.5,
            far,
        });
        let options = ModelOptions {
            direct: true,
            ..ModelOptions::default()
        };
        let options = options
            .for_scenes(cargoes.iter().map(Cargo::scene))
            .unwrap();
        let model = Model::set_up(Method::Exact, &options).unwrap();
        cargo_rows(&[model], &cargoes, &RunOptions::default())
    });
    let [near, far] = &rows;
    for (a, b) in near.iter().zip(far) {
        // Without what lies beyond, the strong stresslet would be off by far more.
        let bound = 3e-3;
        assert!(a.beta < 1.0 || a.beyond > 4.0 * bound, "{a:?}");
        assert!((a.along - b.along).abs() < bound, "{a:?} {b:?}");
        assert!((a.across - b.across).abs() < bound, "{a:?} {b:?}");
    }
}

#[test]
fn a_pair_that_does_not_part_or_has_no_run_has_no_displacement() {
    let model = lt(&[1.0]);
    let none = cargo(1.0, 1.0).row(&model, &Err(NoRun::Skipped));
    assert_eq!(none.outcome, "skipped");
    assert_relative_eq!(none.reach, 8.0);
    let large = cargo(1.0, 2.0).row(&model, &Err(NoRun::Skipped));
    assert_relative_eq!(large.reach, 16.0);
    assert!(none.along.is_nan() && none.across.is_nan() && none.beyond.is_nan());
    // Head on the swimmer pushes the cargo ahead of it.
    let row = &cargo_rows(&[model], &[cargo(0.0, 1.0)], &RunOptions::default())[0];
    assert_ne!(row.outcome, "scattered");
    assert!(row.along.is_nan(), "{row:?}");
}

#[test]
fn a_sweep_has_the_same_rows_and_goes_on_after_a_time_limit() {
    let models = [lt(&[1.0])];
    let (cargoes, out) = (
        [cargo(1.0, 1.0), cargo(1.5, 1.0)],
        OutputFolder::temporary().unwrap(),
    );
    let sweep = |limit| CargoSweep {
        models: &models,
        cargoes: &cargoes,
        options: SweepOptions {
            run: RunOptions::default(),
            time_limit: limit,
        },
        out: &out,
    };
    let of = |limit| {
        let mut rows = Vec::new();
        let done = sweep(limit).run(&mut |row| rows.push(row)).unwrap();
        (done, rows)
    };
    let (done, rows) = of(Some(Duration::ZERO));
    assert!(!done && rows.iter().all(|row: &CargoRow| row.outcome == "skipped"));
    sweep(None).check().unwrap();
    let (done, rows) = of(None);
    assert!(done);
    assert_eq!(rows, cargo_rows(&models, &cargoes, &RunOptions::default()));
    let keys = [
        cargo(1.0, 1.0),
        cargo(1.1, 1.0),
        cargo(1.0, 1.1),
        Cargo {
            far: 9.0,
            ..cargo(1.0, 1.0)
        },
        Cargo {
            beta: 2.0,
            ..cargo(1.0, 1.0)
        },
    ]
    .map(|one| {
        CargoSweep {
            cargoes: &[one],
            ..sweep(None)
        }
        .sweep()
        .key
    });
    let different: std::collections::BTreeSet<_> = keys.iter().collect();
    assert_eq!(different.len(), keys.len());
}
