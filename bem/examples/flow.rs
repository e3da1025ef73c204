//! Errors of the flow at a level.
//!
//! First against Stokeslets and stresslets within the spheres, whose flow is known everywhere: they are `DEPTH` of the way from the centres to about 0.4
//! radii. Then of a pair of free squirmers against two levels more.
//!
//! `cargo run --release -p squirmers-bem --example flow -- [LEVEL] [DEPTH]`

use std::time::Instant;

use bem::Bem;
use nalgebra::{Matrix3, Vector3};
use scene::{Configuration, Fluid, FluidState, Gap, MovingPair, Plan, Pose, Scene, Squirmer};

type Failure = Box<dyn std::error::Error>;

/// Points by where they are.
type Places = [(&'static str, Vec<Vector3<f64>>); 4];

fn main() -> Result<(), Failure> {
    let level = std::env::args().nth(1).map_or(Ok(3), |l| l.parse())?;
    let depth = std::env::args().nth(2).map_or(Ok(0.3), |d| d.parse())?;
    for (ratio, gap) in [
        (1.0, 50.0),
        (1.0, 1.0),
        (1.0, 0.1),
        (1.0, 0.05),
        (1.0, 0.01),
        (2.0, 0.1),
    ] {
        singularities(level, depth, ratio, gap)?;
    }
    for gap in [1.0, 0.1, 0.05, 0.01] {
        squirmers(level, gap)?;
    }
    Ok(())
}

fn singularities(level: usize, depth: f64, ratio: f64, gap: f64) -> Result<(), Failure> {
    let bem = Bem::of_ratio(level, ratio)?;
    let line = Vector3::new(0.36, 0.48, -0.8);
    let of = Configuration {
        radii: [1.0, ratio],
        gap: Gap::new(gap)?,
        midpoint: Vector3::new(0.2, 0.1, -0.4),
        line,
        orientations: [line; 2],
        line_angle_rad: 0.0,
        angles_rad: [0.0; 2],
    };
    let truth = |x: &Vector3<f64>| singular(&of, depth, x);
    let surface =
        |k: usize, n: &Vector3<f64>| truth(&(of.positions()[k] + n * of.radii[k])).velocity;
    let start = Instant::now();
    let layers = bem.layers(&of, surface)?;
    let solve = start.elapsed().as_secs_f64();
    let start = Instant::now();
    print!(
        "ratio {ratio} gap {gap:5}: estimate {:.1e} ({:.1} s), solve {solve:.2} s",
        3.0 * layers.mismatch(surface),
        start.elapsed().as_secs_f64()
    );
    report(&of, |x| layers.at(x), truth);
    Ok(())
}

fn squirmers(level: usize, gap: f64) -> Result<(), Failure> {
    let squirmer = |beta: f64| Squirmer::with_beta(1.0, beta);
    let start = [
        Pose::planar(0.0, 0.0, 70.0),
        Pose::planar(2.0 + gap, 0.0, 130.0),
    ];
    let scene = Scene::new([squirmer(3.0)?, squirmer(-3.0)?], start, None, None)?;
    let plan = Plan::new(&scene)?;
    let [bem, finer] = [Bem::new(level)?, Bem::new(5.min(level + 2))?];
    let pair = MovingPair::free(&plan, &finer, plan.start())?;
    let (flow, truth) = (bem.flow(&pair)?, finer.flow(&pair)?);
    print!(
        "squirmers gap {gap:5}: estimate {:.1e}",
        flow.error_estimate()
    );
    report(&pair.configuration, |x| flow.at(x), |x| truth.at(x));
    Ok(())
}

/// Prints the largest errors of velocity and pressure, and the time of a point.
fn report(
    of: &Configuration,
    found: impl Fn(&Vector3<f64>) -> FluidState,
    truth: impl Fn(&Vector3<f64>) -> FluidState,
) {
    for (name, points) in places(of) {
        let start = Instant::now();
        let states: Vec<FluidState> = points.iter().map(&found).collect();
        let each = start.elapsed().as_secs_f64() / points.len() as f64;
        let (mut u, mut p): (f64, f64) = (0.0, 0.0);
        for (state, x) in states.iter().zip(&points) {
            let expected = truth(x);
            u = u.max((state.velocity - expected.velocity).norm());
            p = p.max((state.pressure - expected.pressure).abs());
        }
        print!("; {name} u {u:.1e} p {p:.1e} {:.2} ms", 1e3 * each);
    }
    println!();
}

fn places(of: &Configuration) -> Places {
    let (centres, gap) = (of.positions(), of.gap.eps());
    let middle = centres[0] + of.line * (of.radii[0] + 0.5 * gap);
    let across = of.line.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
    let at = |i: usize, height: f64| {
        let k = i % 2;
        centres[k] + direction(i) * (of.radii[k] + height)
    };
    let outside = |x: &Vector3<f64>| (0..2).all(|k| (x - centres[k]).norm() > of.radii[k] - 1e-9);
    let near = (0..80).map(|i| at(i, 0.3f64.powi(1 + (i / 2 % 9) as i32)));
    [
        (
            "gap",
            (0..20)
                .map(|i| middle + across * (0.02 * i as f64))
                .collect(),
        ),
        ("on", (0..60).map(|i| at(i, 0.0)).collect()),
        ("near", near.filter(outside).collect()),
        (
            "far",
            (0..40)
                .map(|i| direction(i) * (3.0 + i as f64) * (2.0 + gap))
                .collect(),
        ),
    ]
}

/// Unit vectors all over the sphere.
fn direction(i: usize) -> Vector3<f64> {
    let z = 1.0 - 2.0 * ((i as f64 * 0.618_034) % 1.0);
    let (s, c) = (i as f64 * 2.4).sin_cos();
    let r = (1.0 - z * z).sqrt();
    Vector3::new(r * c, r * s, z)
}

/// The flow of a Stokeslet and a stresslet within each sphere.
fn singular(of: &Configuration, depth: f64, x: &Vector3<f64>) -> FluidState {
    let strain = Matrix3::new(0.2, 0.5, -0.1, 0.5, 0.3, 0.4, -0.1, 0.4, -0.5);
    let mut state = FluidState::default();
    for (k, f, at) in [
        (
            0,
            Vector3::new(0.7, -0.4, 0.5),
            Vector3::new(0.2, -0.3, 0.1),
        ),
        (
            1,
            Vector3::new(-0.3, 0.8, 0.6),
            Vector3::new(-0.1, 0.2, 0.25),
        ),
    ] {
        let r = x - of.positions()[k] - at * (depth * of.radii[k]);
        let s = r.norm();
        let (along, twice) = (r.dot(&f) / s.powi(3), r.dot(&(strain * r)) / s.powi(5));
        state.velocity += f / s + r * (along - 3.0 * twice);
        state.pressure += 2.0 * along - 6.0 * twice;
    }
    state
}
