//! Bound states in three dimensions: the laws of the motion out of their plane, and that motion itself.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::sync::LazyLock;

use compare::{Method, Model, ModelOptions};
use nalgebra::{Complex, Vector3};
use scene::{
    BoundState, LoadSet, Orientation, Perturbation, Plan, Pose, Repulsion, RunOptions, Scene,
    Squirmer, bound_states, run_plan, run_with_tangents,
};

fn model(method: Method) -> Model {
    let options = ModelOptions {
        tabulated: LoadSet::all(2),
        ..ModelOptions::default()
    };
    Model::set_up(method, &options).unwrap()
}

/// The paper's squirmer parameters.
const BETAS: [f64; 5] = [0.0, 1.0, 5.0, -1.0, -5.0];

static MODELS: LazyLock<Vec<Model>> = LazyLock::new(|| {
    [Method::Lt, Method::LtCorrected, Method::Exact]
        .map(model)
        .into()
});

/// Every bound state of the models at the paper's parameters.
fn states() -> impl Iterator<Item = (&'static Model, f64, BoundState)> {
    (MODELS.iter()).flat_map(|model| {
        BETAS.into_iter().flat_map(move |beta| {
            let squirmer = Squirmer::with_beta(1.0, beta).unwrap();
            let states = bound_states(&**model, &squirmer, Repulsion::PAPER).unwrap();
            states.into_iter().map(move |state| (model, beta, state))
        })
    })
}

/// The area between the x and the y components of the line of centres and the headings: 0 where the headings lie along the line.
fn area(state: &BoundState) -> f64 {
    let [one, two] = state.angles_rad;
    let x = Vector3::new(1.0, one.cos(), -two.cos());
    x.cross(&Vector3::new(0.0, one.sin(), -two.sin())).norm()
}

fn distance(a: Complex<f64>, b: Complex<f64>) -> f64 {
    (a - b).norm()
}

/// A state turned about an axis in its plane is the same state.
#[test]
fn two_eigenvalues_out_of_the_plane_are_those_of_turning_the_whole_pair() {
    let mut turning = 0;
    for (model, beta, state) in states() {
        let what = format!("{} {beta} {state:?}", model.method());
        let rate = Complex::new(0.0, state.turning_rate_rad);
        let eigenvalues = state.eigenvalues_off_plane();
        let axial = area(&state) < 1e-7;
        let turned: &[Complex<f64>] = if axial { &[rate] } else { &[rate, -rate] };
        for expected in turned {
            let nearest = eigenvalues.map(|e| distance(e, *expected));
            let nearest = nearest.into_iter().fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-9, "{what}: {eigenvalues:?}");
        }
        // What is left: the trace less that of the turns, and as many exponents as it takes.
        let exponents = state.exponents_off_plane();
        assert_eq!(exponents.len(), if axial { 2 } else { 1 }, "{what}");
        let sum: Complex<f64> = exponents.iter().sum();
        let off = distance(sum, Complex::from(state.off_plane.trace()));
        assert!(off < 1e-9, "{what}: {exponents:?}");
        turning += usize::from(state.turning_rate_rad > 1e-3);
    }
    assert!(turning > 8, "{turning} states turn");
}

/// About the line of centres every direction across is like every other.
#[test]
fn headings_along_the_line_of_centres_leave_it_alike_in_and_out_of_the_plane() {
    let axial: Vec<_> = states()
        .filter(|(_, _, state)| area(state) < 1e-12)
        .collect();
    assert!(axial.len() > 12, "{} states", axial.len());
    for (model, beta, state) in axial {
        for exponent in state.exponents_off_plane() {
            let nearest = state.eigenvalues.map(|e| distance(e, exponent));
            let nearest = nearest.into_iter().fold(f64::INFINITY, f64::min);
            // Those in the plane are known by differences.
            let what = format!("{} {beta} {state:?}", model.method());
            assert!(nearest < 1e-6, "{what}: {exponent}, {nearest:e}");
        }
    }
}

/// The scene that starts in a state, with these components out of the plane.
fn scene_of(state: &BoundState, beta: f64, z: Vector3<f64>) -> Scene {
    let squirmer = Squirmer::with_beta(1.0, beta).unwrap();
    let heading = |angle: f64| Vector3::new(angle.cos(), angle.sin(), 0.0);
    let [one, two] = state.angles_rad;
    let tilted = |p: Vector3<f64>, z: f64| p + Vector3::z() * z;
    let line = tilted(Vector3::x(), z[0]).normalize();
    let pose = |position, orientation| Pose {
        position,
        orientation: Orientation::Vector(orientation),
    };
    let start = [
        pose(Vector3::zeros(), tilted(heading(one), z[1])),
        pose(line * (2.0 + state.gap.eps()), tilted(-heading(two), z[2])),
    ];
    Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), None).unwrap()
}

/// A state that attracts in the plane forgets how a heading was turned in it, however long it turns.
#[test]
fn tangents_of_long_orbits_stay_on_their_spheres() {
    let mut checked = 0;
    let attract = states().filter(|(_, _, state)| !state.is_neutral() && state.growth() < 0.0);
    for (model, beta, state) in attract {
        let scene = scene_of(&state, beta, Vector3::zeros());
        let p = scene.start[0].orientation.vector().unwrap();
        let turned = Perturbation {
            orientations: [Vector3::z().cross(&p), Vector3::zeros()],
            ..Perturbation::NONE
        };
        let options = RunOptions {
            tolerance: 1e-9,
            ..RunOptions::default()
        };
        let tangents = run_with_tangents(&scene, &**model, &options, &[turned]).unwrap();
        let end = tangents.end[0].orientations.map(|p| p.norm());
        let what = format!("{} {beta} {state:?}", model.method());
        assert!(end.iter().all(|change| *change < 20.0), "{what}: {end:?}");
        checked += 1;
    }
    assert!(checked >= 4, "{checked} states");
}

#[test]
fn a_tilted_state_leaves_its_plane_as_its_matrix_says() {
    const TILT: f64 = 1e-5;
    for (model, beta, state) in states().filter(|(_, _, state)| state.gap.eps() < 0.9) {
        let z = Vector3::new(0.3, 1.0, -0.7);
        let scene = scene_of(&state, beta, z * TILT);
        let plan = Plan::new(&scene).unwrap().in_three_dimensions();
        let options = RunOptions {
            tolerance: 1e-12,
            end_time: 1.0,
            ..RunOptions::default()
        };
        let end = run_plan(&plan, &**model, &options).unwrap().end;
        let expected = (state.off_plane * options.end_time).exp() * z;
        let found = Vector3::new(end.line.z, end.orientations[0].z, end.orientations[1].z) / TILT;
        let off = (found - expected).norm() / expected.norm();
        let what = format!("{} {beta} {state:?}", model.method());
        assert!(off < 2e-5, "{what}: {found:?} {expected:?} {off:e}");
    }
}

/// What the paper's bound states are in three dimensions: swimming together at beta 1 and orbits at beta 5 attract in the plane alone.
#[test]
fn regress_bound_states_that_attract_in_the_plane_are_left_in_space_by_pullers() {
    let attract = |method: Method, beta: f64| -> Vec<f64> {
        (states().filter(|(model, of, state)| {
            model.method() == method
                && of.total_cmp(&beta).is_eq()
                && !state.is_neutral()
                && state.growth() < 0.0
        }))
        .map(|(_, _, state)| state.growth_off_plane())
        .collect()
    };
    let close = |found: &[f64], expected: f64| {
        assert!(
            found.len() == 1 && (found[0] / expected - 1.0).abs() < 1e-3,
            "{found:?} instead of {expected}"
        );
    };
    close(&attract(Method::Exact, 1.0), 0.12988);
    close(&attract(Method::Exact, 5.0), 2.0868);
    close(&attract(Method::Lt, -5.0), -0.19656);
    close(&attract(Method::LtCorrected, -5.0), -0.17064);
    for beta in [0.0, -1.0, -5.0] {
        assert_eq!(attract(Method::Exact, beta).len(), 0, "{beta}");
    }
}
