//! Starts on the surfaces where a run changes or ends, next to them, and at infinity.

use scene::nalgebra::Vector3;
use scene::{FAR_GAP, Outcome, Pose, Repulsion, Run, RunOptions, Scene, Squirmer};

use super::rows::larger;
use super::{Bench, Rows, stepping_error, until};
use crate::study::kinetics::{Begins, Collider, Impact, point};
use crate::{CompareError, Method, Model};

/// How far the starts beside a surface are off it; a unit in the last place of the distance is 4e-16 or 2e-15.
const OFF: [f64; 4] = [1e-15, -1e-15, 1e-12, -1e-12];

/// Squirmer parameters, and headings of pairs that close in without any symmetry, in degrees.
const CLOSING: [([f64; 2], [f64; 2]); 3] = [
    ([1.0, 1.0], [75.0, 150.0]),
    ([-5.0, -5.0], [-70.0, 165.0]),
    ([0.0, 5.0], [10.0, -120.0]),
];

/// Headings of pairs that swim apart.
const OPENING: [([f64; 2], [f64; 2]); 2] =
    [([1.0, 1.0], [160.0, 15.0]), ([0.0, 0.5], [-150.0, -20.0])];

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.models() {
        rows.attempt(model.method().name(), "surfaces", |rows| {
            surfaces(model, rows)
        });
    }
    for model in bench.only(&[Method::Exact, Method::Bem]) {
        rows.attempt(model.method().name(), "smallest gap", |rows| {
            smallest_gap(model, rows)
        });
    }
    for model in bench.only(&[Method::Exact]) {
        rows.attempt(model.method().name(), "infinity", |rows| {
            infinity(model, rows)
        });
    }
}

/// Tolerance of the runs from surfaces.
const TOLERANCE: f64 = 1e-10;

/// Impact parameters of pairs from infinity, and the seed of their headings.
const IMPACTS: (f64, f64) = (2.0, 4.0);
const SEED: u32 = 3;

fn collide(
    model: &Model,
    (betas, headings): ([f64; 2], [f64; 2]),
    distance: f64,
) -> Result<Run, CompareError> {
    let squirmer = |k: usize| Squirmer::with_beta(1.0, betas[k]);
    let start = [
        Pose::planar(0.0, 0.0, headings[0]),
        Pose::planar(distance, 0.0, headings[1]),
    ];
    let squirmers = [squirmer(0)?, squirmer(1)?];
    let scene = Scene::new(squirmers, start, Some(Repulsion::PAPER), None)?;
    Ok(model.run(&scene, &until(200.0, TOLERANCE))?)
}

/// Spread of what pairs turn by from starts on a surface and beside it, and the errors of the steps that allow it.
fn spread(
    model: &Model,
    pairs: &[([f64; 2], [f64; 2])],
    distance: f64,
    off: &[f64],
) -> Result<(f64, f64), CompareError> {
    let (mut worst, mut allowed) = (0.0_f64, 0.0_f64);
    for &pair in pairs {
        let on = collide(model, pair, distance)?;
        for off in off {
            let beside = collide(model, pair, distance + off)?;
            allowed = larger(
                allowed,
                stepping_error(&on, TOLERANCE) + stepping_error(&beside, TOLERANCE),
            );
            let parted = on.outcome == Outcome::Scattered && beside.outcome == Outcome::Scattered;
            let [a, b] = [&on, &beside].map(Run::deflections_rad);
            for k in [0, 1] {
                // Pairs that stay together on one side only are a difference without end.
                let apart = if parted {
                    (a[k] - b[k]).abs()
                } else {
                    f64::INFINITY
                };
                worst = larger(worst, apart);
            }
        }
    }
    Ok((worst, allowed))
}

fn surfaces(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let surfaces = match model.cutoff() {
        Some(cut) => vec![("the cut", 2.0 + cut)],
        None => vec![
            (
                "the gap where near and far stretches of the table meet",
                2.0 + FAR_GAP,
            ),
            (
                "the departure distance",
                RunOptions::default().departure_distance,
            ),
        ],
    };
    for (surface, distance) in surfaces {
        let (worst, allowed) = spread(model, &CLOSING, distance, &OFF)?;
        rows.add(
            model.method().name(),
            format!("starts on and up to 1e-12 beside {surface}, closing in: largest difference of a deflection in radians"),
            (allowed, "steps x tolerance x (1 + |y|) of both runs: nothing happens at the surface"),
            worst,
        );
    }
    Ok(())
}

fn smallest_gap(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    // The first distance whose gap is not below.
    let smallest = model.range().smallest;
    let mut distance = 2.0 + smallest;
    while distance - 2.0 < smallest {
        distance = distance.next_up();
    }
    let (worst, allowed) = spread(model, &OPENING, distance, &[1e-15, 1e-12])?;
    rows.add(
        model.method().name(),
        format!("starts on and up to 1e-12 above the smallest gap, {:.1e}, swimming apart: largest difference of a deflection in radians", distance - 2.0),
        (allowed, "steps x tolerance x (1 + |y|) of both runs"),
        worst,
    );
    Ok(())
}

/// Headings of pairs that come from infinity, by the distance at which their runs begin: each doubling changes them by an eighth at most of what the one before did.
fn infinity(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let mut slowest = 0.0_f64;
    for beta in [5.0, -5.0, 1.0] {
        for index in 0..6 {
            let incoming = Impact::of_point(point(index, SEED), IMPACTS).incoming();
            let from = |reach: f64| -> Result<_, CompareError> {
                let collider =
                    Collider::new(model, beta, &until(200.0, 1e-11))?.from_farther(reach);
                Ok((collider.collide(&incoming, Begins::Infinity, false)?).headings)
            };
            let [near, middle, far] = [from(2.0)?, from(4.0)?, from(8.0)?];
            let apart = |a: [Vector3<f64>; 2], b: [Vector3<f64>; 2]| {
                larger((a[0] - b[0]).norm(), (a[1] - b[1]).norm())
            };
            slowest = larger(slowest, apart(middle, far) / apart(near, middle));
        }
    }
    rows.add(
        model.method().name(),
        "pairs from infinity, runs that begin at 64, 128 and 256 radii or more: second difference of the headings at infinity, divided by the first",
        (
            0.125,
            "what the closed forms of way and turn at infinity leave out falls as the cube of the distance, or faster",
        ),
        slowest,
    );
    Ok(())
}
