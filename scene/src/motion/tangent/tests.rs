//! The linearised motion of spheres that repulsion and gravity move; tests with hydrodynamics stand where the models are.

use nalgebra::Vector3;

use super::*;
use crate::{
    Gravity, Isolated, Orientation, Pose, Repulsion, RunOptions, Scene, SceneError, Squirmer, run,
};

/// Two bottom-heavy squirmers that close in, one above the other's side, with everything a little changed by `h`.
fn scene(h: f64) -> Result<Scene, SceneError> {
    let squirmer = |beta: f64, heavy: f64| {
        Squirmer::new(&[1.5 + 0.1 * h, 1.5 * beta])?.bottom_heavy(heavy - h)
    };
    let pose = |x: [f64; 3], p: [f64; 3]| Pose {
        position: x.into(),
        orientation: Orientation::Vector(p.into()),
    };
    let start = [
        pose([0.0, h, 0.0], [1.0, 0.3 * h, 0.2]),
        pose([2.4, 0.3, -0.2 - h], [-1.0, 0.4, 0.3 + h]),
    ];
    let repulsion = Repulsion::new(10.0 + h, 20.0 + 2.0 * h)?;
    let gravity = Gravity::new(Vector3::new(0.2 * h, -1.0, 0.1))?;
    let squirmers = [squirmer(1.0, 4.0)?, squirmer(-2.0, 2.0)?];
    Scene::new(squirmers, start, Some(repulsion), Some(gravity))
}

#[test]
fn val_tangents_are_differences_of_runs() {
    let options = RunOptions {
        tolerance: 1e-12,
        end_time: 1.5,
        ..RunOptions::default()
    };
    let end = |h: f64| {
        let end = run(&scene(h).unwrap(), &Isolated::EQUAL, &options)
            .unwrap()
            .end;
        [end.positions(), end.orientations].concat()
    };
    let direction = Perturbation::along::<SceneError>(scene, 1e-2).unwrap();
    let tangents = run_with_tangents(
        &scene(0.0).unwrap(),
        &Isolated::EQUAL,
        &options,
        &[direction],
    )
    .unwrap();
    assert!(tangents.run.min_gap < 0.3, "{}", tangents.run.min_gap);
    let difference = |h: f64| -> Vec<Vector3<f64>> {
        let sides = end(h).into_iter().zip(end(-h));
        sides
            .map(|(above, below)| (above - below) / (2.0 * h))
            .collect()
    };
    let (coarse, fine) = (difference(2e-3), difference(1e-3));
    let Variation {
        positions,
        orientations,
    } = tangents.end[0];
    for (i, found) in [positions, orientations].concat().iter().enumerate() {
        let expected = (fine[i] * 4.0 - coarse[i]) / 3.0;
        let off = (found - expected).norm() / expected.norm().max(1.0);
        assert!(off < 1e-7, "{i}: {found}, {expected}");
        assert!(expected.norm() > 0.01);
    }
}

#[test]
fn a_change_of_the_radii_needs_models_of_other_radii() {
    let wider = Perturbation {
        ratio: 1.0,
        ..Perturbation::NONE
    };
    let options = RunOptions::default();
    let refused = run_with_tangents(&scene(0.0).unwrap(), &Isolated::EQUAL, &options, &[wider]);
    assert_eq!(refused, Err(SceneError::NoRatios));
}
