//! Collisions of swirling squirmers by tables, against solving for every load, and by boundary elements against
//! the exact series.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::sync::OnceLock;

use compare::{BEM_TABLE_TOLERANCE, EXACT_TABLE_TOLERANCE, Method, Model, ModelOptions};
use scene::{Configuration, Orientation, Plan, Pose, Repulsion, Run, RunOptions, Scene, Squirmer};

/// Coarse: direct runs solve for some hundreds of gaps.
const MESH: usize = 1;

/// Slip strengths of the first squirmer, the stronger one.
const SLIP: [f64; 3] = [1.5, 1.5, 1.0];

/// Two unlike squirmers that come from out of a plane to a gap of about 0.1; the first starts `aside`.
fn scene(aside: f64) -> Scene {
    let [b1, b2, c2] = SLIP;
    let one = Squirmer::new(&[b1, b2]).unwrap();
    let two = Squirmer::new(&[b1, -0.5 * b2]).unwrap();
    let squirmers = [
        one.with_swirl(&[0.3, c2]).unwrap(),
        two.with_swirl(&[0.0, -0.5 * c2]).unwrap(),
    ];
    let pose = |position: [f64; 3], p: [f64; 3]| Pose {
        position: position.into(),
        orientation: Orientation::Vector(p.into()),
    };
    let start = [
        pose([-1.4, aside, 0.1], [1.0, 0.2, -0.1]),
        pose([1.4, 0.0, -0.1], [-1.0, 0.3, 0.2]),
    ];
    Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap()
}

fn model(method: Method, direct: bool) -> Model {
    model_at(MESH, method, direct)
}

fn model_at(mesh: usize, method: Method, direct: bool) -> Model {
    let options = ModelOptions {
        mesh,
        direct,
        cache: None,
        ..ModelOptions::default()
    };
    Model::set_up(method, &options.for_scenes([Ok(scene(0.0))]).unwrap()).unwrap()
}

const END: f64 = 3.0;

fn ran(model: &Model, scene: &Scene, tolerance: f64) -> Run {
    let options = RunOptions {
        end_time: END,
        tolerance,
        sample_interval: Some(0.1),
        ..RunOptions::default()
    };
    let run = model.run(scene, &options).unwrap();
    assert!(run.min_gap > 0.004 && run.min_gap < 0.5, "{}", run.min_gap);
    run
}

/// Largest distance of centres, and of orientations, at the end.
fn apart(a: &Run, b: &Run) -> f64 {
    let [x, y] = [a, b].map(|run| {
        let [p, q] = run.end.positions();
        let [u, v] = run.end.orientations;
        [p, q, u, v]
    });
    (x.iter().zip(y))
        .map(|(a, b)| (a - b).norm())
        .fold(0.0, f64::max)
}

/// How much the end answers to a displacement at the start.
fn answer(model: &Model) -> f64 {
    const ASIDE: f64 = 1e-4;
    1.0 + apart(
        &ran(model, &scene(0.0), 1e-9),
        &ran(model, &scene(ASIDE), 1e-9),
    ) / ASIDE
}

/// What errors of the loads, integrated over time, may come to by the end: velocities are loads times slip over
/// drags of 6 and 8 and at least 1 a load, so that an error moves the pair by the sum of the slip times it.
fn bound(answer: f64, error: f64) -> f64 {
    answer * SLIP.iter().sum::<f64>() * error
}

/// What the steps of two runs may add up to by the end.
fn stepping(answer: f64, runs: [&Run; 2], tolerance: f64) -> f64 {
    let steps: u64 = runs.iter().map(|run| run.counters.steps).sum();
    answer * steps as f64 * tolerance * 10.0
}

/// Error of a mesh over its difference from the next finer one: errors fall by about three a level, so that it
/// is one and a half; two for the third part that they may fall short of that by.
const FINER: f64 = 2.0;

/// Largest difference of the velocities of the centres, and of the orientations, by two models.
fn motion_apart(one: &Model, other: &Model, at: &Configuration) -> f64 {
    let plan = Plan::new(&scene(0.0)).unwrap();
    let [a, b] = [one, other].map(|model| {
        let rates = model.rates(&plan, at, 1).unwrap();
        let gap = at.gap;
        let half = (rates.line * gap.distance() + at.line * (rates.ln_gap * gap.eps())) * 0.5;
        let [p, q] = rates.orientations;
        [rates.midpoint - half, rates.midpoint + half, p, q]
    });
    (a.iter().zip(b))
        .map(|(a, b)| (a - b).norm())
        .fold(0.0, f64::max)
}

/// The collision by a table and by solving for every load, which takes the same steps: where these fall wrong they do
/// so alike.
fn assert_same_collision(table: &Run, direct: &Run, allowed: f64) {
    assert_eq!(table.counters, direct.counters);
    let off = apart(table, direct);
    println!("table off direct {off:.1e}, allowed {allowed:.1e}");
    assert!(off > 0.0 && off <= allowed);
}

fn exact_table() -> &'static Model {
    static TABLE: OnceLock<Model> = OnceLock::new();
    TABLE.get_or_init(|| model(Method::Exact, false))
}

#[test]
fn val_an_exact_table_with_swirl_and_direct_series_give_the_same_collision() {
    let table = ran(exact_table(), &scene(0.0), 1e-10);
    let direct = ran(&model(Method::Exact, true), &scene(0.0), 1e-10);
    let allowed = bound(answer(exact_table()), END * EXACT_TABLE_TOLERANCE);
    assert_same_collision(&table, &direct, allowed);
}

#[test]
fn val_boundary_elements_with_swirl_by_table_direct_and_the_exact_series_give_the_same_collision() {
    const STEPS: f64 = 1e-6;
    let answer = answer(exact_table());
    let [tabulated, solved] = [false, true].map(|direct| model(Method::Bem, direct));
    let [table, direct] = [&tabulated, &solved].map(|model| ran(model, &scene(0.0), STEPS));
    assert_same_collision(&table, &direct, bound(answer, END * BEM_TABLE_TOLERANCE));

    // The mesh's own estimate of the error of the motion, integrated over the collision. By tables, which
    // the above holds against direct solves, so that steps can be as short as they need to be for this.
    const TIGHT: f64 = 1e-10;
    let [found, exact] = [&tabulated, exact_table()].map(|model| ran(model, &scene(0.0), TIGHT));
    let finer = model_at(MESH + 1, Method::Bem, true);
    let estimate: f64 = (exact.samples.windows(2))
        .map(|pair| {
            let at = &pair[1].configuration;
            FINER * motion_apart(&solved, &finer, at) * (pair[1].t - pair[0].t)
        })
        .sum();
    let tables = bound(answer, END * BEM_TABLE_TOLERANCE);
    let off = apart(&found, &exact);
    let allowed = answer * estimate + tables + stepping(answer, [&exact, &found], TIGHT);
    println!(
        "off exact {off:.1e}, allowed {allowed:.1e}, answer {answer:.1}, estimate {estimate:.1e}"
    );
    assert!(off > 0.0 && off <= allowed);

    // Without its swirl the pair ends further off than that.
    let plain = scene(0.0);
    let squirmers = plain.squirmers.map(|s| s.with_swirl(&[]).unwrap());
    let plain = Scene::new(squirmers, plain.start, plain.repulsion, None).unwrap();
    let swirl = apart(&ran(exact_table(), &plain, STEPS), &exact);
    println!("swirl moves the end by {swirl:.1e}");
    assert!(swirl > 2.0 * allowed);
}
