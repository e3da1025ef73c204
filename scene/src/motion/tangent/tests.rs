//! The linearised motion against differences of runs, without hydrodynamics and by made-up models.

use nalgebra::Vector3;

use super::*;
use crate::made::{Cut, Made, Unlike};
use crate::{
    Gravity, Hydrodynamics, Isolated, Orientation, Outcome, Pose, Repulsion, RunOptions, Scene,
    SceneError, Squirmer, run,
};

const MADE: Made = Made {
    seam: None,
    noise: 0.0,
};

const OPTIONS: RunOptions = RunOptions {
    tolerance: 1e-12,
    end_time: 1.5,
    departure_distance: 1e3,
    angles_at: f64::INFINITY,
    sample_interval: None,
    max_steps: 1_000_000,
};

/// What a scene has beside squirming and repulsion.
#[derive(Clone, Copy)]
struct Acts {
    gravity: bool,
    swirl: bool,
    radius: f64,
}

const PLAIN: Acts = Acts {
    gravity: false,
    swirl: false,
    radius: 1.0,
};

/// Two squirmers that close in, one above the other's side, with everything a little changed by `h`.
fn scene(acts: Acts, h: f64) -> Result<Scene, SceneError> {
    let squirmer = |beta: f64, heavy: f64, swirl: f64| {
        let mut of = Squirmer::new(&[1.5 + 0.1 * h, 1.5 * beta, 0.3 * h])?;
        if acts.swirl {
            of = of.with_swirl(&[0.2 + h, swirl - h])?;
        }
        if acts.gravity {
            of = of.bottom_heavy(heavy - h)?;
        }
        Ok::<_, SceneError>(of)
    };
    let pose = |x: [f64; 3], p: [f64; 3]| Pose {
        position: x.into(),
        orientation: Orientation::Vector(p.into()),
    };
    let start = [
        pose([0.0, h, 0.0], [1.0, 0.3 * h, 0.2]),
        pose([1.4 + acts.radius, 0.3, -0.2 - h], [-1.0, 0.4, 0.3 + h]),
    ];
    let repulsion = Repulsion::new(10.0 + h, 20.0 + 2.0 * h)?;
    let gravity = Gravity::new(Vector3::new(0.2 * h, -1.0, 0.1))?;
    let squirmers = [
        squirmer(1.0, 4.0, 0.8)?,
        squirmer(-2.0, 2.0, -0.5)?.with_radius(acts.radius)?,
    ];
    Scene::new(
        squirmers,
        start,
        Some(repulsion),
        acts.gravity.then_some(gravity),
    )
}

/// Centres and orientations at the end, and orientations when the two have parted.
fn end(acts: Acts, model: &dyn Hydrodynamics, h: f64) -> Vec<Vector3<f64>> {
    let run = run(&scene(acts, h).unwrap(), model, &OPTIONS).unwrap();
    [
        run.end.positions(),
        run.end.orientations,
        run.outgoing.orientations,
    ]
    .concat()
}

/// The derivative by Richardson's extrapolation of central differences.
fn differences(at: impl Fn(f64) -> Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
    let difference = |h: f64| -> Vec<Vector3<f64>> {
        let sides = at(h).into_iter().zip(at(-h));
        sides
            .map(|(above, below)| (above - below) / (2.0 * h))
            .collect()
    };
    let (coarse, fine) = (difference(2e-3), difference(1e-3));
    let pairs = fine.into_iter().zip(coarse);
    pairs
        .map(|(fine, coarse)| (fine * 4.0 - coarse) / 3.0)
        .collect()
}

#[track_caller]
fn assert_derivative(found: &TangentRun, expected: &[Vector3<f64>], bound: f64) {
    let (end, outgoing) = (found.end[0], found.outgoing[0]);
    let found = [end.positions, end.orientations, outgoing].concat();
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let off = (found - expected).norm() / expected.norm().max(1.0);
        assert!(off < bound, "{i}: {found}, {expected}, off by {off:e}");
        assert!(expected.norm() > 0.01, "{i}: {expected}");
    }
}

#[test]
fn val_tangents_are_differences_of_runs() {
    let heavy = Acts {
        gravity: true,
        ..PLAIN
    };
    let all = Acts {
        gravity: true,
        swirl: true,
        radius: 0.6,
    };
    let swirling = Acts {
        swirl: true,
        ..PLAIN
    };
    let cases: [(&dyn Hydrodynamics, Acts); 5] = [
        (&Isolated::EQUAL, heavy),
        (&MADE, heavy),
        (&MADE, swirling),
        (
            &Unlike(0.6),
            Acts {
                radius: 0.6,
                ..PLAIN
            },
        ),
        (&Unlike(0.6), all),
    ];
    for (case, (model, acts)) in cases.into_iter().enumerate() {
        println!("case {case}");
        let of = |h: f64| scene(acts, h);
        let direction = Perturbation::along::<SceneError>(of, 1e-2).unwrap();
        let tangents = run_with_tangents(&of(0.0).unwrap(), model, &OPTIONS, &[direction]).unwrap();
        assert!(tangents.run.min_gap < 0.3, "{}", tangents.run.min_gap);
        let expected = differences(|h| end(acts, model, h));
        assert_derivative(&tangents, &expected, 1e-7);
    }
}

#[test]
fn val_the_time_at_which_a_pair_passes_the_cut_of_a_model_changes_with_its_start() {
    let model = Cut {
        made: MADE,
        at: 0.25,
    };
    let swirling = Acts {
        swirl: true,
        ..PLAIN
    };
    let of = |h: f64| scene(swirling, h);
    let direction = Perturbation::along::<SceneError>(of, 1e-2).unwrap();
    let tangents = run_with_tangents(&of(0.0).unwrap(), &model, &OPTIONS, &[direction]).unwrap();
    let run = &tangents.run;
    assert!(run.min_gap < model.at && run.contact_time > 0.0, "{run:?}");
    println!(
        "{:?} {} {}",
        run.outcome,
        run.contact_time,
        run.end.gap.eps()
    );
    assert_derivative(&tangents, &differences(|h| end(swirling, &model, h)), 1e-7);
}

#[test]
fn val_orientations_at_infinity_change_as_those_of_runs_that_part() {
    let options = RunOptions {
        end_time: 1e6,
        departure_distance: 10.0,
        // Nothing is asked of the run but how it ends.
        sample_interval: Some(1.0),
        ..OPTIONS
    };
    let swirling = Acts {
        swirl: true,
        ..PLAIN
    };
    let cases: [(&dyn Hydrodynamics, Acts); 2] = [
        (&MADE, swirling),
        (
            &Unlike(0.6),
            Acts {
                radius: 0.6,
                ..PLAIN
            },
        ),
    ];
    for (model, acts) in cases {
        let of = |h: f64| scene(acts, h);
        let direction = Perturbation::along::<SceneError>(of, 1e-2).unwrap();
        let found = run_with_tangents(&of(0.0).unwrap(), model, &options, &[direction]).unwrap();
        assert_eq!(found.run.outcome, Outcome::Scattered);
        assert!(found.run.samples.is_empty());
        let expected = differences(|h| {
            let run = run(&of(h).unwrap(), model, &options).unwrap();
            run.outgoing.orientations.to_vec()
        });
        for (found, expected) in found.outgoing[0].iter().zip(expected) {
            let off = (found - expected).norm() / expected.norm().max(1.0);
            assert!(off < 1e-6, "{found}, {expected}, off by {off:e}");
        }
    }
}

#[test]
fn val_a_change_of_the_radii_changes_the_model_too() {
    let acts = |h: f64| Acts {
        gravity: true,
        swirl: false,
        radius: 0.6 * (1.0 + h),
    };
    let of = |h: f64| scene(acts(h), 0.0);
    let direction = Perturbation::along::<SceneError>(of, 1e-2).unwrap();
    assert!((direction.ratio - 0.6).abs() < 1e-12);
    let beside = [-0.02, -0.01, 0.01, 0.02].map(|part| Unlike(0.6 * (1.0 + part)));
    let beside = beside.each_ref().map(|of| of as &dyn Hydrodynamics);
    let found = run_with_tangents_by_ratio(
        &of(0.0).unwrap(),
        (&Unlike(0.6), &beside),
        &OPTIONS,
        &[direction],
    );
    let expected = differences(|h| {
        let model = Unlike(0.6 * (1.0 + h));
        let run = run(&of(h).unwrap(), &model, &OPTIONS).unwrap();
        [
            run.end.positions(),
            run.end.orientations,
            run.outgoing.orientations,
        ]
        .concat()
    });
    assert_derivative(&found.unwrap(), &expected, 1e-6);
}

#[test]
fn a_change_of_the_radii_needs_models_of_other_radii() {
    let wider = Perturbation {
        ratio: 1.0,
        ..Perturbation::NONE
    };
    let start = scene(PLAIN, 0.0).unwrap();
    let refused = run_with_tangents(&start, &Isolated::EQUAL, &OPTIONS, &[wider]);
    assert_eq!(refused, Err(SceneError::NoRatios));
}
