//! The linearised motion against differences of the motion itself, and the laws that it has to keep.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::TAU;
use std::sync::Arc;

use compare::{Method, Model, ModelOptions};
use exact::Exact;
use lt::{Form, UnlikeLubrication};
use nalgebra::Vector3;
use rayon::prelude::*;
use scene::{
    Configuration, Gravity, Hydrodynamics, Isolated, LoadSet, Orientation, Outcome, Perturbation,
    Plan, Pose, Repulsion, Run, RunOptions, Scene, SceneError, Squirmer, TableOptions, Tabulated,
    TangentRun, Variation, rates, run, run_with_tangents, run_with_tangents_by_ratio,
};

/// Numbers that look random, the same at each run: the golden ratio's multiples, shuffled (splitmix64).
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn vector(&mut self) -> Vector3<f64> {
        let (z, azimuth) = (self.between(-1.0, 1.0), self.between(0.0, TAU));
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * azimuth.cos(), across * azimuth.sin(), z)
    }
}

/// The numbers of a scene in space: centres, headings, slip, repulsion, gravity. A direction is the change of all of them.
#[derive(Clone, Copy, Debug)]
struct Numbers {
    positions: [Vector3<f64>; 2],
    headings: [Vector3<f64>; 2],
    modes: [[f64; 3]; 2],
    swirl: [[f64; 2]; 2],
    kappa: [f64; 2],
    heaviness: [f64; 2],
    down: Vector3<f64>,
}

/// What acts in a scene.
#[derive(Clone, Copy, Debug)]
struct Acts {
    swirl: bool,
    gravity: bool,
    radius: f64,
}

impl Numbers {
    fn random(random: &mut Random, acts: Acts) -> Self {
        let line = random.vector();
        let distance = 1.0 + acts.radius + random.between(0.1, 2.0);
        let mut heading = |towards: Vector3<f64>| (towards + random.vector() * 1.2).normalize();
        let headings = [heading(line), heading(-line)];
        let beta = random.between(-4.0, 4.0);
        Self {
            positions: [Vector3::zeros(), line * distance],
            headings,
            modes: [0, 1].map(|_| [1.5, 1.5 * beta, random.between(-0.5, 0.5)]),
            swirl: [0, 1].map(|_| [random.between(-1.0, 1.0), random.between(-1.0, 1.0)]),
            kappa: [10.0, 100.0],
            heaviness: [0, 1].map(|_| random.between(0.5, 5.0)),
            down: random.vector(),
        }
    }

    fn direction(random: &mut Random) -> Self {
        let mut number = || random.between(-1.0, 1.0);
        let mut vector = || Vector3::new(number(), number(), number());
        Self {
            positions: [vector(), vector()],
            headings: [vector(), vector()],
            modes: [vector().into(), vector().into()],
            swirl: [0, 1].map(|_| [vector().x, vector().y]),
            kappa: [vector().x, 10.0 * vector().y],
            heaviness: [vector().x, vector().y],
            down: vector(),
        }
    }

    fn scene(&self, along: &Self, h: f64, acts: Acts) -> Result<Scene, SceneError> {
        let step = |a: f64, b: f64| a + h * b;
        let steps = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| step(*a, *b)).collect()
        };
        let squirmer = |k: usize| {
            let mut squirmer = Squirmer::new(&steps(&self.modes[k], &along.modes[k]))?;
            if acts.swirl {
                squirmer = squirmer.with_swirl(&steps(&self.swirl[k], &along.swirl[k]))?;
            }
            if k == 1 {
                squirmer = squirmer.with_radius(acts.radius)?;
            }
            if acts.gravity {
                squirmer = squirmer.bottom_heavy(step(self.heaviness[k], along.heaviness[k]))?;
            }
            Ok::<_, SceneError>(squirmer)
        };
        let pose = |k: usize| Pose {
            position: self.positions[k] + along.positions[k] * h,
            orientation: Orientation::Vector(self.headings[k] + along.headings[k] * h),
        };
        let [kappa1, kappa2] = [0, 1].map(|i| step(self.kappa[i], along.kappa[i]));
        let gravity = (acts.gravity).then(|| Gravity::new(self.down + along.down * h));
        Scene::new(
            [squirmer(0)?, squirmer(1)?],
            [pose(0), pose(1)],
            Some(Repulsion::new(kappa1, kappa2)?),
            gravity.transpose()?,
        )
    }
}

const TABULATED: LoadSet = LoadSet {
    swirl: 2,
    ..LoadSet::all(3)
};

fn model(method: Method, ratio: f64) -> Model {
    let options = ModelOptions {
        tabulated: TABULATED,
        ratios: vec![ratio],
        ..ModelOptions::default()
    };
    Model::set_up(method, &options).unwrap()
}

const TIGHT: RunOptions = RunOptions {
    tolerance: 1e-12,
    end_time: 4.0,
    // No run ends by it.
    departure_distance: 1e3,
    angles_at: f64::INFINITY,
    sample_interval: None,
    max_steps: 1_000_000,
};

/// The state at the end: that of a pair that has parted beyond a cut is read at other times, and only its headings stay.
fn end(run: &Run) -> Vec<f64> {
    let positions = run.end.positions();
    let parted = run.outcome == Outcome::Scattered;
    let vectors = run.end.orientations.into_iter();
    let vectors = vectors.chain(positions.into_iter().filter(|_| !parted));
    vectors.flat_map(|v| [v.x, v.y, v.z]).collect()
}

fn numbers(tangents: &TangentRun, direction: usize) -> Vec<f64> {
    let Variation {
        positions,
        orientations,
    } = tangents.end[direction];
    let parted = tangents.run.outcome == Outcome::Scattered;
    let vectors = orientations.into_iter();
    let vectors = vectors.chain(positions.into_iter().filter(|_| !parted));
    vectors.flat_map(|v| [v.x, v.y, v.z]).collect()
}

/// The derivative of the end by Richardson's extrapolation of central differences from `h`, with the error that it claims: the best of the
/// tableau.
fn extrapolated(at: impl Fn(f64) -> Vec<f64>, h: f64) -> (Vec<f64>, f64) {
    let difference = |h: f64| -> Vec<f64> {
        let (above, below) = (at(h), at(-h));
        (above.iter().zip(&below))
            .map(|(a, b)| (a - b) / (2.0 * h))
            .collect()
    };
    let mut best = (Vec::new(), f64::INFINITY);
    let mut before: Vec<Vec<f64>> = Vec::new();
    for i in 0..7 {
        let mut row = vec![difference(h / f64::from(1 << i))];
        for j in 0..before.len() {
            let four = 4f64.powi(j as i32 + 1);
            let better = (row[j].iter().zip(&before[j]))
                .map(|(fine, coarse)| fine + (fine - coarse) / (four - 1.0))
                .collect();
            row.push(better);
        }
        if let (Some(last), Some(previous)) = (row.last(), before.last()) {
            let error =
                (last.iter().zip(previous)).fold(0.0, |e: f64, (a, b)| e.max((a - b).abs()));
            if error < best.1 {
                best = (last.clone(), error);
            }
        }
        before = row;
    }
    best
}

/// Compares a random direction of a random scene; the error relative to the larger of the derivative and 1, and how well the differences know it.
fn compared(model: &dyn Hydrodynamics, seed: u64, acts: Acts) -> (f64, f64) {
    let mut random = Random(seed);
    let of = Numbers::random(&mut random, acts);
    let along = Numbers::direction(&mut random);
    let scene = |h: f64| of.scene(&along, h, acts);
    let direction = Perturbation::along::<SceneError>(scene, 1e-2).unwrap();
    let tangents = run_with_tangents(&scene(0.0).unwrap(), model, &TIGHT, &[direction]).unwrap();
    let derivative = numbers(&tangents, 0);
    let size = derivative.iter().fold(1.0, |m: f64, d| m.max(d.abs()));
    let (differences, known) = extrapolated(
        |h| end(&run(&scene(h).unwrap(), model, &TIGHT).unwrap()),
        0.02 / size,
    );
    let error =
        (derivative.iter().zip(&differences)).fold(0.0, |e: f64, (a, b)| e.max((a - b).abs()));
    (error / size, known / size)
}

/// The kinds of scenes, each by lubrication theory and by the exact table.
fn kinds() -> Vec<(Model, Acts)> {
    let plain = Acts {
        swirl: false,
        gravity: false,
        radius: 1.0,
    };
    let kinds = [
        plain,
        Acts {
            swirl: true,
            ..plain
        },
        Acts {
            gravity: true,
            ..plain
        },
        Acts {
            radius: 0.5,
            ..plain
        },
        Acts {
            swirl: true,
            gravity: true,
            radius: 0.5,
        },
    ];
    (kinds.into_iter())
        .flat_map(|acts| {
            [Method::LtCorrected, Method::Exact].map(|method| (model(method, acts.radius), acts))
        })
        .collect()
}

#[test]
fn val_tangents_are_the_differences_of_200_random_scenes() {
    for (model, acts) in kinds() {
        (0..20).into_par_iter().for_each(|seed| {
            let (error, known) = compared(&*model, seed, acts);
            let what = format!("{}, {acts:?}, scene {seed}", model.method());
            assert!(known < 5e-7, "{what}: differences are known to {known:e}");
            assert!(error < 1e-7, "{what}: {error:e}");
        });
    }
}

/// The exact model as a table a thousand times as fine as the one that ships.
fn finely_tabulated(ratio: f64) -> Tabulated {
    let options = TableOptions {
        set: TABULATED,
        tolerance: 1e-12,
        smallest_gap: 1e-3,
    };
    let exact = Exact::of_ratio(ratio).unwrap();
    Tabulated::build(Arc::new(exact), options, &|_| {}).unwrap()
}

/// What turns a pair, or moves it, turns or moves all that becomes of it; what starts later ends later.
#[test]
fn tangents_keep_the_symmetries_of_the_motion() {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    for (shipped, acts) in kinds() {
        // What is tabulated jumps where pieces meet, by up to its interpolation error: the linearisation of either side does not know it. Exact loads of unlike
        // radii have a noise of 6e-10, and no table of them is finer.
        let tight = (shipped.method() == Method::Exact).then(|| finely_tabulated(acts.radius));
        let model: &dyn Hydrodynamics = tight.as_ref().map_or(&*shipped, |table| table);
        let method = shipped.method();
        let jumps = tight
            .as_ref()
            .map_or(0.0, |table| table.summary().interpolation_error);
        let bound = 1e-9 + 10.0 * jumps;
        (0..10).into_par_iter().for_each(|seed| {
            let of = Numbers::random(&mut Random(seed), acts);
            let scene = of.scene(&of, 0.0, acts).unwrap();
            let plan = Plan::new(&scene).unwrap().in_three_dimensions();
            let turned = axes.map(|axis| Perturbation {
                positions: of.positions.map(|x| axis.cross(&x)),
                orientations: of.headings.map(|p| axis.cross(&p)),
                gravity: scene
                    .gravity
                    .map_or(Vector3::zeros(), |g| axis.cross(&g.direction())),
                ..Perturbation::NONE
            });
            let moved = axes.map(|axis| Perturbation {
                positions: [axis; 2],
                ..Perturbation::NONE
            });
            let flow = |at: &Configuration| {
                // At the cut of a model and beyond they fly freely.
                let rates = if model
                    .cutoff()
                    .is_some_and(|cut| at.gap.eps() > cut * (1.0 - 1e-12))
                {
                    let lone = Isolated::of_ratio(acts.radius);
                    rates(&plan.clone().without_repulsion(), &lone, at, 1)
                } else {
                    rates(&plan, model, at, 1)
                };
                let rates = rates.unwrap();
                let opening = at.gap.eps() * rates.ln_gap;
                let half = (at.line * opening + rates.line * at.distance()) * 0.5;
                Variation {
                    positions: [rates.midpoint - half, rates.midpoint + half],
                    orientations: rates.orientations,
                }
            };
            let start = flow(plan.start());
            let later = Perturbation {
                positions: start.positions,
                orientations: start.orientations,
                ..Perturbation::NONE
            };
            let directions: Vec<_> = turned.into_iter().chain(moved).chain([later]).collect();
            let tangents = run_with_tangents(&scene, model, &TIGHT, &directions).unwrap();
            let end = &tangents.run.end;
            let expected = (axes.into_iter())
                .map(|axis| Variation {
                    positions: end.positions().map(|x| axis.cross(&x)),
                    orientations: end.orientations.map(|p| axis.cross(&p)),
                })
                .chain(axes.map(|axis| Variation {
                    positions: [axis; 2],
                    orientations: [Vector3::zeros(); 2],
                }))
                .chain([flow(end)]);
            for (i, (expected, found)) in expected.zip(&tangents.end).enumerate() {
                let vectors = |of: &Variation| [of.positions, of.orientations].concat();
                for (a, b) in vectors(&expected).iter().zip(vectors(found)) {
                    let off = (a - b).norm() / a.norm().max(1.0);
                    let what = format!("{}, {acts:?}, scene {seed}", method);
                    assert!(off < bound, "{what}, direction {i}: {off:e}");
                }
            }
        });
    }
}

/// Lubrication theory of any ratio of the radii.
fn lubrication(ratio: f64) -> UnlikeLubrication {
    UnlikeLubrication::new(Form::Corrected, ratio).unwrap()
}

#[test]
fn val_tangents_by_the_ratio_of_the_radii_are_differences_of_models() {
    let acts = |radius: f64| Acts {
        swirl: false,
        gravity: true,
        radius,
    };
    for radius in [0.5, 2.0] {
        let beside = [-0.02, -0.01, 0.01, 0.02].map(|part| lubrication(radius * (1.0 + part)));
        let beside = beside.each_ref().map(|of| of as &dyn Hydrodynamics);
        let model = lubrication(radius);
        (0..10).into_par_iter().for_each(|seed| {
            let of = Numbers::random(&mut Random(seed), acts(radius));
            let scene = |h: f64| of.scene(&of, 0.0, acts(radius * (1.0 + h)));
            let direction = Perturbation::along::<SceneError>(scene, 1e-2).unwrap();
            assert!((direction.ratio - radius).abs() < 1e-12);
            let start = scene(0.0).unwrap();
            let refused = run_with_tangents(&start, &model, &TIGHT, &[direction]);
            assert_eq!(refused, Err(SceneError::NoRatios));
            let tangents =
                run_with_tangents_by_ratio(&start, (&model, &beside), &TIGHT, &[direction])
                    .unwrap();
            let derivative = numbers(&tangents, 0);
            let size = derivative.iter().fold(1.0, |m: f64, d| m.max(d.abs()));
            let at = |h: f64| {
                let model = lubrication(radius * (1.0 + h));
                end(&run(&scene(h).unwrap(), &model, &TIGHT).unwrap())
            };
            let (differences, known) = extrapolated(at, 0.02 / size);
            let error = (derivative.iter().zip(&differences))
                .fold(0.0, |e: f64, (a, b)| e.max((a - b).abs()));
            assert!(known < 1e-6 * size, "scene {seed}: {known:e}");
            assert!(
                error < 1e-6 * size,
                "ratio {radius}, scene {seed}: {:e}",
                error / size
            );
        });
    }
}
