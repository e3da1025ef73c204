//! The flow, stresslets and power by boundary elements against the exact series, which share no code but the definitions.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::sync::atomic::{AtomicUsize, Ordering};

use bem::Bem;
use exact::Exact;
use scene::nalgebra::Vector3;
use scene::stress::{StressTable, Stresses};
use scene::{
    Flow, Fluid, Gap, Hydrodynamics, LoadSet, ModelDescription, MovingPair, Orientation, PairLoads,
    Plan, Pose, Scene, SceneError, Squirmer, SwirlLoads,
};

/// Two squirmers that swim freely out of any plane.
fn free(gap: f64, ratio: f64) -> MovingPair {
    let squirmers = [
        Squirmer::with_beta(1.0, 3.0).unwrap(),
        (Squirmer::with_beta(0.8, -2.0).unwrap())
            .with_swirl(&[0.2, 0.6])
            .unwrap(),
    ];
    let squirmers = [squirmers[0], squirmers[1].with_radius(ratio).unwrap()];
    let pose = |position: [f64; 3], towards: [f64; 3]| Pose {
        position: position.into(),
        orientation: Orientation::Vector(towards.into()),
    };
    let distance = 1.0 + ratio + gap;
    let start = [
        pose([0.0; 3], [0.6, 0.7, -0.3]),
        pose([0.6 * distance, 0.8 * distance, 0.0], [-0.5, 0.3, 0.8]),
    ];
    let plan = Plan::new(&Scene::new(squirmers, start, None, None).unwrap()).unwrap();
    let model = Exact::of_ratio(ratio).unwrap();
    MovingPair::free(&plan, &model, plan.start()).unwrap()
}

/// Points between the two, within the gap, and about them, none nearer to a surface than `least`.
fn points(pair: &MovingPair, least: f64) -> Vec<Vector3<f64>> {
    let c = &pair.configuration;
    let [one, two] = c.positions();
    let neck = one + c.line * (c.radii[0] + 0.5 * c.gap.eps());
    let e1 = c.line.cross(&Vector3::z()).normalize();
    let e2 = c.line.cross(&e1);
    let mut all = Vec::new();
    for k in 0..48 {
        let k = f64::from(k);
        let (sin, cos) = (2.4 * k).sin_cos();
        let across = e1 * cos + e2 * sin;
        let height = (0.38 * k).sin();
        all.push(neck + across * (k / 48.0) + c.line * (0.35 * c.gap.eps() * height));
        all.push(c.midpoint + (across + c.line * (2.0 * height)) * (0.1 * k));
    }
    let radii = c.radii;
    all.retain(|point| {
        let apart =
            [(one, radii[0]), (two, radii[1])].map(|(centre, r)| (point - centre).norm() - r);
        apart[0].min(apart[1]) > least
    });
    assert!(all.len() > 60);
    all
}

fn difference(exact: &dyn Flow, bem: &dyn Flow, points: &[Vector3<f64>]) -> f64 {
    let of = |point| (exact.at(point).velocity - bem.at(point).velocity).norm();
    points.iter().map(of).fold(0.0, f64::max)
}

#[test]
fn val_the_flow_by_boundary_elements_is_that_by_series_and_within_its_own_estimate() {
    for (level, gap, ratio, tolerance) in [
        (3, 1.0, 1.0, 1e-5),
        (3, 0.1, 1.0, 2e-4),
        (4, 0.1, 1.0, 1e-4),
        (4, 0.1, 2.0, 1e-4),
    ] {
        let pair = free(gap, ratio);
        let exact = Exact::of_ratio(ratio).unwrap().flow(&pair).unwrap();
        let bem = Bem::of_ratio(level, ratio).unwrap().flow(&pair).unwrap();
        let worst = difference(exact.as_ref(), bem.as_ref(), &points(&pair, 0.02));
        println!(
            "gap {gap}, ratio {ratio}: {worst:.1e}, estimate {:.1e}",
            bem.error_estimate()
        );
        assert!(worst < tolerance, "gap {gap}, ratio {ratio}: {worst:e}");
        // On the surfaces too.
        let mut largest = worst;
        for k in 0..40 {
            let angle = f64::from(k);
            let normal = Vector3::new(angle.sin(), (1.7 * angle).cos(), (0.6 * angle).sin());
            let normal = normal.normalize();
            for sphere in [0, 1] {
                let centre = pair.configuration.positions()[sphere];
                let point = centre + normal * pair.configuration.radii[sphere];
                largest = largest.max(difference(exact.as_ref(), bem.as_ref(), &[point]));
            }
        }
        assert!(
            largest < bem.error_estimate(),
            "gap {gap}, ratio {ratio}: {largest:e}"
        );
    }
}

#[test]
fn val_tractions_by_boundary_elements_are_those_by_series() {
    let pair = free(0.5, 1.0);
    let exact = Exact::new().flow(&pair).unwrap();
    let bem = Bem::new(3).unwrap().flow(&pair).unwrap();
    for k in 0..30 {
        let angle = f64::from(k);
        let normal = Vector3::new(angle.cos(), (1.3 * angle).sin(), (0.7 * angle).cos());
        let normal = normal.normalize();
        for sphere in [0, 1] {
            let (found, truth) = (
                bem.traction(sphere, &normal),
                exact.traction(sphere, &normal),
            );
            // Their scale is 10.
            assert!(
                (found - truth).norm() < 0.02,
                "{sphere} {normal:?}: {found:?} {truth:?}"
            );
        }
    }
}

#[test]
fn val_stresslets_and_power_by_boundary_elements_are_those_by_series() {
    for (gap, ratio) in [(1.0, 1.0), (0.05, 1.0), (0.1, 0.5)] {
        let pair = free(gap, ratio);
        let at = Gap::new(gap).unwrap();
        let truth = Exact::of_ratio(ratio).unwrap().stresses(at, 2, 2).unwrap();
        let found = Bem::of_ratio(3, ratio).unwrap().stresses(at, 2, 2).unwrap();
        for (a, b) in found.columns().zip(truth.columns()) {
            assert!(
                (a - b).abs() < 1e-3 * b.abs().max(1.0),
                "gap {gap}, ratio {ratio}: {a} {b}"
            );
        }
        let (found, truth) = (found.of(&pair), truth.of(&pair));
        for k in [0, 1] {
            let scale = truth.stresslets[k].amax();
            let error = (found.stresslets[k] - truth.stresslets[k]).amax() / scale;
            println!("gap {gap}, ratio {ratio}, stresslet {k}: {error:.1e}");
            assert!(error < 1e-3, "gap {gap}, ratio {ratio}, {k}: {error:e}");
        }
        let error = (found.dissipation / truth.dissipation - 1.0).abs();
        assert!(error < 1e-3, "gap {gap}, ratio {ratio}: {error:e}");
    }
}

/// Exact hydrodynamics that counts how often it is asked for the fluid.
#[derive(Default)]
struct Counting {
    model: Exact,
    flows: AtomicUsize,
    stresses: AtomicUsize,
}

impl Hydrodynamics for Counting {
    fn description(&self) -> ModelDescription<'_> {
        self.model.description()
    }

    fn fingerprint(&self) -> String {
        self.model.fingerprint()
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.model.interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.model.interacting_loads_with_swirl(gap, set)
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.model.error_estimate(gap, set)
    }
}

impl Fluid for Counting {
    fn flow(&self, pair: &MovingPair) -> Result<Box<dyn Flow>, SceneError> {
        self.flows.fetch_add(1, Ordering::Relaxed);
        self.model.flow(pair)
    }

    fn stresses(&self, gap: Gap, modes: usize, swirl: usize) -> Result<Stresses, SceneError> {
        self.stresses.fetch_add(1, Ordering::Relaxed);
        self.model.stresses(gap, modes, swirl)
    }
}

impl Counting {
    fn asked(&self) -> [usize; 2] {
        [&self.flows, &self.stresses].map(|count| count.load(Ordering::Relaxed))
    }
}

#[test]
fn a_run_asks_for_no_flow_and_no_stresses_and_a_table_of_stresses_for_these_alone() {
    let model = Counting::default();
    let start = [
        Pose::planar(-0.5, 5.0, -90.0),
        Pose::planar(0.5, -5.0, 90.0),
    ];
    let pullers = [Squirmer::with_beta(1.0, 5.0).unwrap(); 2];
    let scene = Scene::new(pullers, start, Some(scene::Repulsion::PAPER), None).unwrap();
    let options = scene::RunOptions {
        tolerance: 1e-5,
        ..scene::RunOptions::default()
    };
    let run = scene::run(&scene, &model, &options).unwrap();
    assert!(run.counters.loads > 100);
    assert_eq!(model.asked(), [0, 0]);
    let plan = Plan::new(&scene).unwrap();
    let pair = MovingPair::free(&plan, &model, &run.end).unwrap();
    assert_eq!(model.asked(), [0, 0]);
    let gaps = [run.min_gap, 10.0].map(|gap| Gap::new(gap).unwrap());
    let table = StressTable::build(&model, gaps, (2, 0), 1e-6).unwrap();
    let [flows, stresses] = model.asked();
    assert!(flows == 0 && stresses >= table.evaluations());
    model.flow(&pair).unwrap();
    assert_eq!(model.asked(), [1, stresses]);
}
